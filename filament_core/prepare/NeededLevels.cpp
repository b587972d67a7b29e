// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/NeededLevels.h"

#include "base/math/Elementary.h"
#include "filament_core/prepare/ChooseLevels.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::prepare {
namespace {

/// Levels: devices interpolate the logarithm between powers of 2 of the squared scale, which is 0.043 too little.
constexpr double kLevelMargin = 0.0625;
constexpr double kAnisotropicLevels = 2.5, kDeformedLevels = 1;

/// The area of the world behind a pixel.
struct PixelArea {
    float3 alongView{ 0.0f }; ///< w of a place relative to the camera: its product, and `constant`
    float constant = 1;
    float nearest = 0; ///< the smallest w
    double atOne = 0;  ///< square metres at w = 1, or anywhere in a parallel view

    double of(float3 center, float3 halfExtent) const {
        if (alongView == float3(0)) return atOne;
        const float middle = glm::dot(alongView, center) + constant;
        const double w = std::max(middle - glm::dot(glm::abs(alongView), halfExtent), nearest);
        return atOne * w * w;
    }
};

PixelArea pixelAreaOf(float4x4 const& clip, uint2 size) {
    const auto row = [&](int i) { return float3(clip[0][i], clip[1][i], clip[2][i]); };
    const double3 x(row(0)), y(row(1)), w(row(3));
    const double pixels = static_cast<double>(size.x) * size.y / 4; // clip coordinates go from -1 to 1
    PixelArea area{ .alongView = row(3), .constant = clip[3][3] };
    if (row(3) == float3(0)) { // parallel
        area.atOne = 1 / (pixels * glm::length(glm::cross(x, y)));
        return area;
    }
    // Rays with w = 1: the inverse maps (x, y, 1) of the image to them.
    const double3x3 rayFromClip = glm::inverse(glm::transpose(double3x3(x, y, w)));
    double leastCosine = 1;
    for (const double cornerX : { -1.0, 1.0 }) {
        for (const double cornerY : { -1.0, 1.0 }) {
            const double3 ray = rayFromClip * double3(cornerX, cornerY, 1);
            leastCosine = std::min(leastCosine, 1 / (glm::length(ray) * glm::length(w)));
        }
    }
    area.atOne = glm::length(glm::cross(rayFromClip[0], rayFromClip[1])) / pixels * leastCosine;
    // With reversed depth and no far plane, z of clip coordinates is the distance of the near plane.
    area.nearest = row(2) == float3(0) ? clip[3][2] : 0.0f;
    return area;
}

/// How much the area of a surface grows from the object to the world, at most: the largest stretch of the cofactors.
double areaScaleOf(scene::SceneData const& scene, uint32_t at, uint32_t deformation) {
    auto const& rows = scene.renderables.placement[at].rows;
    const double own =
            largestStretch(glm::cross(rows[1], rows[2]), glm::cross(rows[2], rows[0]), glm::cross(rows[0], rows[1]));
    if (deformation == scene::kNotDeformed) return own;
    const Skin skin = scene.deformations.all()[deformation].skin;
    if (!skin) return own;
    double largest = 0;
    for (shader::BoneData const& bone : scene.deformations.skin(skin).bones) {
        const double stretch = largestStretch(float3(bone.row0), float3(bone.row1), float3(bone.row2));
        largest = std::max(largest, stretch * stretch);
    }
    return own * largest;
}

double determinantOf(scene::MaterialInstance const& instance, StreamedMap const& map) {
    if (map.matrix == StreamedMap::kNoMatrix) return 1;
    std::array<float, 6> columns; // std140: the first two of three columns of four floats
    std::memcpy(columns.data(), instance.parameters.data() + map.matrix, 8);
    std::memcpy(columns.data() + 2, instance.parameters.data() + map.matrix + 16, 8);
    return std::abs(static_cast<double>(columns[0]) * columns[3] - static_cast<double>(columns[1]) * columns[2]);
}

/// Not negative, so that their bits have their order.
void lower(std::atomic<uint32_t>& least, double lod) {
    const uint32_t bits = std::bit_cast<uint32_t>(static_cast<float>(std::max(lod, 0.0)));
    uint32_t known = least.load(std::memory_order_relaxed);
    while (bits < known && !least.compare_exchange_weak(known, bits, std::memory_order_relaxed)) {
    }
}

class Needs {
public:
    Needs(Arena& arena, scene::SceneData const& scene, StreamedTextures const& streamed, double bias)
            : mScene(scene), mStreamed(streamed), mBias(bias),
              mLeast(arena.array<std::atomic<uint32_t>>(streamed.textures.size())) {
        const auto none = std::bit_cast<uint32_t>(std::numeric_limits<float>::infinity());
        for (std::atomic<uint32_t>& least : mLeast) least.store(none, std::memory_order_relaxed);
    }

    void add(jobs::JobSystem& jobs, ViewPacket const& view, PixelArea const& area) {
        constexpr size_t kObjectsOfJob = 1024;
        jobs::parallelFor<"texture levels">(jobs, view.objects.size(), kObjectsOfJob, [&](size_t begin, size_t end) {
            addObjects(view, area, view.objects.order.subspan(begin, end - begin));
        });
    }

    std::span<const float> take(Arena& arena) const {
        const auto levels = arena.arrayForOverwrite<float>(mLeast.size());
        for (size_t i = 0; i < levels.size(); ++i)
            levels[i] = std::bit_cast<float>(mLeast[i].load(std::memory_order_relaxed));
        return levels;
    }

private:
    /// Objects of one draw follow each other, and share what is looked up.
    struct Draw {
        std::vector<StreamedMap> const* maps = nullptr; ///< null: nothing of it is streamed
        scene::Drawable const* drawable = nullptr;
        scene::UvDensity density{};
    };

    Draw find(ViewPacket const& view, uint32_t number) const {
        Draw draw{ .drawable = &mScene.renderables.drawables[number] };
        scene::MaterialInstance const* const material = draw.drawable->material;
        if (!material) return draw;
        // Without light, only what cuts out is sampled.
        if (!isShaded(view.kind) && material->material->package.blending == shader::Blending::Opaque) return draw;
        const auto maps = mStreamed.maps.find(material->id);
        if (maps == mStreamed.maps.end()) return draw;
        draw.maps = &maps->second;
        const auto density = mStreamed.densities.find(draw.drawable->geometry.vertices.bits);
        if (density != mStreamed.densities.end()) draw.density = density->second;
        return draw;
    }

    void addObjects(ViewPacket const& view, PixelArea const& area, std::span<const SortItem> items) const {
        uint32_t last = ~0u;
        Draw draw;
        for (SortItem const& item : items) {
            const uint32_t number = drawableOf(item.draw);
            if (number != last) draw = find(view, number);
            last = number;
            if (draw.maps) addObject(view, area, item.renderable, draw);
        }
    }

    void addObject(ViewPacket const& view, PixelArea const& area, uint32_t at, Draw const& draw) const {
        scene::Renderables const& renderables = mScene.renderables;
        const bool hasBounds = (renderables.flags[at] & scene::kCulled) != 0;
        double pixel = 0;
        if (hasBounds)
            pixel = area.of(float3(renderables.bounds.centerAt(at) - view.objects.cameraWorld),
                            renderables.bounds.halfExtentAt(at));
        const uint32_t deformation = scene::deformationAt(renderables, at);
        const double deformed = deformation == scene::kNotDeformed ? 0 : kDeformedLevels;
        const double perTexture = pixel / areaScaleOf(mScene, at, deformation);
        scene::MaterialInstance const& instance = *draw.drawable->material;
        for (StreamedMap const& map : *draw.maps) {
            StreamedTextures::Texture const& texture = mStreamed.textures[map.texture];
            if (!texture.handle || instance.textures[map.slot].texture != texture.handle) continue;
            const double density = draw.density[map.uvSet];
            const double texels = perTexture * density * density * texture.texels * determinantOf(instance, map);
            lower(mLeast[map.texture], texels > 0 ? elementary::log2(texels) / 2 - mBias - deformed : 0.0);
        }
    }

    scene::SceneData const& mScene;
    StreamedTextures const& mStreamed;
    double mBias = 0; ///< levels more
    std::span<std::atomic<uint32_t>> mLeast;
};

} // namespace

std::span<const float> neededLevels(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                                    FramePacket const& packet, StreamedTextures const& streamed) {
    FrameSettings const& settings = packet.settings;
    const bool isAnisotropic = settings.quality.textureFilter == TextureFilter::Anisotropic;
    Needs needs(arena, scene, streamed,
                kLevelMargin - static_cast<double>(settings.mipBias) + (isAnisotropic ? kAnisotropicLevels : 0.0));
    needs.add(jobs, packet.mainView(), pixelAreaOf(packet.mainView().uniforms.clipFromWorld, settings.size));
    for (ShadowMapPacket const& map : packet.shadows.maps) {
        if (map.view == kKeptMap) continue;
        ViewPacket const& view = packet.views[map.view];
        needs.add(jobs, view, pixelAreaOf(view.uniforms.clipFromWorld, uint2(map.held.tile.size)));
    }
    return needs.take(arena);
}

} // namespace filament_core::prepare
