// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/SplatData.h"

#include "base/OutOfMemory.h"

#include <cmath>

namespace filament_core {
namespace scene {
namespace {

bool isFinite(float3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The first fault of the lists, by their lengths.
Result<void> checkLengths(SplatCloudDesc const& desc) {
    const size_t count = desc.positions.size();
    if (count == 0)
        return fail(ErrorCode::InvalidArgument, "splats '{}': there are none; give at least one", desc.name);
    if (desc.degree > 3)
        return fail(ErrorCode::InvalidArgument, "splats '{}': degree {} of harmonics; 0 to 3 are possible", desc.name,
                    desc.degree);
    const size_t perSplat = size_t{ desc.degree + 1 } * (desc.degree + 1);
    const auto check = [&](const char* list, size_t size, size_t expected) -> Result<void> {
        if (size == expected) return {};
        return fail(ErrorCode::InvalidArgument, "splats '{}': {} {} for {} splats; give {}", desc.name, size, list,
                    count, expected);
    };
    if (auto fits = check("rotations", desc.rotations.size(), count); !fits) return fits;
    if (auto fits = check("scales", desc.scales.size(), count); !fits) return fits;
    if (auto fits = check("opacities", desc.opacities.size(), count); !fits) return fits;
    return check("harmonics", desc.harmonics.size(), count * perSplat);
}

bool isScale(float3 scale) {
    const auto isLength = [](float s) { return s >= 0 && s <= kMaxSplatScale; };
    return isLength(scale.x) && isLength(scale.y) && isLength(scale.z);
}

/// What is wrong with a splat; null: nothing.
const char* faultOf(SplatCloudDesc const& desc, size_t i, size_t perSplat) {
    const float4 q = desc.rotations[i];
    const float length2 = glm::dot(q, q);
    if (!isFinite(desc.positions[i])) return "its position is not finite";
    if (!(length2 > 1e-30f && std::isfinite(length2))) return "its rotation has no length; 0, 0, 0, 1 rotates nothing";
    if (!isScale(desc.scales[i])) return "its scales are not from 0 to 1e15";
    if (!(desc.opacities[i] >= 0 && desc.opacities[i] <= 1)) return "its opacity is not from 0 to 1";
    for (size_t k = 0; k < perSplat; ++k)
        if (!isFinite(desc.harmonics[i * perSplat + k])) return "its harmonics are not finite";
    return nullptr;
}

/// The box around the ellipsoid of kSplatReach standard deviations.
void growBounds(MinMax& bounds, float3 position, Covariance const& covariance) {
    const float3 reach = kSplatReach * glm::sqrt(float3(covariance.xx, covariance.yy, covariance.zz));
    bounds.add(glm::max(position - reach, float3(-3e38f)));
    bounds.add(glm::min(position + reach, float3(3e38f)));
}

} // namespace

Covariance splatCovariance(float4 rotation, float3 scale) {
    const double4 q = glm::normalize(double4(rotation));
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    const double3 s(scale);
    // rows of R S
    const double3 a = double3(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)) * s;
    const double3 b = double3(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)) * s;
    const double3 c = double3(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)) * s;
    const auto product = [](double3 const& p, double3 const& r) { return static_cast<float>(glm::dot(p, r)); };
    return { product(a, a), product(b, b), product(c, c), product(a, b), product(a, c), product(b, c) };
}

Result<std::shared_ptr<const SplatData>> makeSplatData(SplatCloudDesc const& desc) {
    if (const Result<void> fits = checkLengths(desc); !fits) return fits.error();
    const size_t count = desc.positions.size(), perSplat = size_t{ desc.degree + 1 } * (desc.degree + 1);
    for (size_t i = 0; i < count; ++i) {
        if (const char* fault = faultOf(desc, i, perSplat))
            return fail(ErrorCode::InvalidArgument, "splats '{}': splat {}: {}", desc.name, i, fault);
    }
    auto data = std::make_shared<SplatData>();
    data->positions.assign(desc.positions.begin(), desc.positions.end());
    data->opacities.assign(desc.opacities.begin(), desc.opacities.end());
    data->harmonics.assign(desc.harmonics.begin(), desc.harmonics.end());
    data->degree = desc.degree;
    data->colors = desc.colors;
    data->covariances.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        data->covariances.push_back(splatCovariance(desc.rotations[i], desc.scales[i]));
        growBounds(data->bounds, desc.positions[i], data->covariances[i]);
    }
    return std::shared_ptr<const SplatData>(std::move(data));
}

} // namespace scene

Result<SplatCloud> SplatCloud::create(SplatCloudDesc const& desc) {
    return orOutOfMemory("splats", desc.name, [&]() -> Result<SplatCloud> {
        Result<std::shared_ptr<const scene::SplatData>> data = scene::makeSplatData(desc);
        if (!data) return data.error();
        return SplatCloud(std::move(*data));
    });
}

size_t SplatCloud::count() const { return mData ? mData->count() : 0; }

} // namespace filament_core
