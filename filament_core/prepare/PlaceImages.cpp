// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PlaceImages.h"

#include <algorithm>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;
using shader::ImagedLight;
using Table = std::span<const uint32_t>;

// Room for records comes in steps, so that lights stay where they are while some come and go.
constexpr uint32_t kRecordStep = 16;

struct ImageAxes {
    float3 right{ 0.0f }, down{ 0.0f };
};

/// Across the direction, which stays where it is if a node with unequal scales turns the side towards it.
ImageAxes axesOf(LightRecord const& light) {
    const float3 right = light.sideWorld - light.directionWorld * glm::dot(light.sideWorld, light.directionWorld);
    const float length = glm::length(right);
    if (!(length > 1e-6f)) return {};
    return { right / length, glm::cross(light.directionWorld, right / length) };
}

float4 rowOf(float3 axis, double offset) { return { axis, static_cast<float>(offset) }; }

/// Texels a metre where z is 1. Of an octahedral map the mean of all directions, sqrt(columns^2 / 4 pi), times three,
/// because z is twice the sum of three components.
float densityOf(LightRecord const& light) {
    const auto columns = static_cast<float>((*light.image)[0]), rows = static_cast<float>((*light.image)[1]);
    if (light.type == LightRecord::Type::Point) return 0.84f * columns;
    return std::max(columns * light.imageScale.x, rows * light.imageScale.y);
}

ImagedLight imagedLight(LightRecord const& light, double3 cameraWorld, uint32_t table) {
    ImagedLight placed{};
    placed.offset.x = static_cast<float>(table);
    if (light.isArea()) return placed; // the light itself has the corners
    const ImageAxes axes = axesOf(light);
    const float3 right = axes.right * light.imageScale.x, down = axes.down * light.imageScale.y;
    shader::ImageMapping mapping = shader::kImageProjected;
    if (light.type == LightRecord::Type::Sun) {
        mapping = shader::kImageTiled;
        const double2 camera(glm::dot(double3(right), cameraWorld), glm::dot(double3(down), cameraWorld));
        const double2 offset = glm::fract(camera + double2(light.imageOffset));
        placed.positionRange = rowOf(right, offset.x);
        placed.colorIntensity = rowOf(down, offset.y);
        placed.directionScale = rowOf(float3(0), 1);
    } else {
        // (x, y) / z of a projection is 0.5 in the middle.
        const bool isPoint = light.type == LightRecord::Type::Point;
        if (isPoint) mapping = shader::kImageOctahedral;
        const float3 middle = isPoint ? float3(0) : 0.5f * light.directionWorld;
        placed.positionRange = rowOf(right + middle, 0);
        placed.colorIntensity = rowOf(down + middle, 0);
        placed.directionScale = rowOf(light.directionWorld, 0);
    }
    placed.offset.y = static_cast<float>(mapping);
    placed.offset.z = densityOf(light);
    return placed;
}

class ImageList {
public:
    ImageList(Arena& arena, uint32_t lights, double3 cameraWorld)
            : mCameraWorld(cameraWorld), mRecords(arena.array<ImagedLight>(roomFor(lights))),
              mTables(arena.arrayForOverwrite<Table>(lights)), mPlaces(arena.arrayForOverwrite<uint32_t>(lights)) {}

    /// Counted from 1; 0: the image does not fit.
    uint32_t add(LightRecord const& light) {
        if (mLights == shader::kMaxImagedLights) return 0;
        const uint32_t table = placeOf(*light.image);
        if (table == 0) return 0;
        mRecords[mLights] = imagedLight(light, mCameraWorld, table);
        return ++mLights;
    }
    LightImageLists lists(uint8_t terms) const {
        return { .records = mRecords, .tables = mTables.first(mCount), .words = mNext, .terms = terms };
    }

private:
    static uint32_t roomFor(uint32_t lights) {
        const uint32_t placed = std::min(lights, shader::kMaxImagedLights);
        return (placed + kRecordStep - 1) / kRecordStep * kRecordStep;
    }

    uint32_t placeOf(Table table) {
        const auto sameData = [&](Table known) { return known.data() == table.data(); };
        const auto known = std::ranges::find_if(mTables.first(mCount), sameData);
        const auto at = static_cast<size_t>(known - mTables.begin());
        if (at < mCount) return mPlaces[at];
        if (table.size() > shader::kMaxImageWords - mNext) return 0;
        mTables[mCount] = table;
        mPlaces[mCount++] = mNext;
        mNext += static_cast<uint32_t>(table.size());
        return mPlaces[mCount - 1];
    }

    double3 mCameraWorld;
    std::span<ImagedLight> mRecords;
    std::span<Table> mTables;
    std::span<uint32_t> mPlaces;
    size_t mCount = 0;
    uint32_t mLights = 0;
    uint32_t mNext = shader::kFirstImageWord;
};

} // namespace

void placeImages(Arena& arena, scene::Lights const& lights, std::span<const uint32_t> records, double3 cameraWorld,
                 ViewPacket& packet) {
    const std::span<shader::PunctualLight> placed = arena.copy(packet.lights);
    ImageList list(arena, packet.counts.imagedLights, cameraWorld);
    uint32_t terms = 0;
    for (size_t i = 0; i < placed.size(); ++i) {
        LightRecord const& light = lights.records[records[i]];
        if (!light.image) continue;
        const uint32_t own = list.add(light);
        if (own == 0) {
            placed[i].colorIntensity = float4(0, 0, 0, placed[i].colorIntensity.w);
            ++packet.counts.imagesOverLimit;
        } else if (light.isArea()) {
            placed[i].colorIntensity.w += static_cast<float>(own * shader::kShapeImaged);
        } else {
            placed[i].offset.w += static_cast<float>(own * shader::kImagedLightStep);
        }
        terms |= light.isArea() ? shader::kAreaImages : shader::kLightCookies;
    }
    packet.lights = placed;
    packet.images = list.lists(static_cast<uint8_t>(terms));
}

} // namespace filament_core::prepare
