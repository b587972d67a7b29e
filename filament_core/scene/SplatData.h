// SPDX-License-Identifier: Apache-2.0
/// SplatData: the splats of a cloud as frames read them (<filament_core/Splats.h>).
///   In      a SplatCloudDesc.   Out: covariances instead of rotations and scales, and the box of all ellipsoids.
///   Thread  any; never changes.   Memory: on the heap, shared.   Fails: InvalidArgument, std::bad_alloc.
#pragma once

#include "base/Result.h"
#include "base/math/Math.h"
#include "filament_core/scene/Deformations.h"

#include <filament_core/Splats.h>

#include <memory>
#include <vector>

namespace filament_core::scene {

/// A Gaussian ends at three standard deviations: the kernel `ellipse` of KHR_gaussian_splatting.
inline constexpr float kSplatReach = 3;
inline constexpr float kMaxSplatScale = 1e15f; ///< its square is a float

/// A symmetric matrix: xx, yy, zz on the diagonal.
struct Covariance {
    float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

struct SplatData {
    std::vector<float3> positions;
    std::vector<Covariance> covariances;
    std::vector<float> opacities;
    std::vector<float3> harmonics; ///< (degree + 1)^2 for each splat
    uint32_t degree = 0;
    SplatColors colors = SplatColors::Srgb;
    MinMax bounds{};

    size_t count() const { return positions.size(); }
};

Result<std::shared_ptr<const SplatData>> makeSplatData(SplatCloudDesc const& desc);

/// Sigma = R S S^T R^T. `rotation` need not have the length 1.
Covariance splatCovariance(float4 rotation, float3 scale);

} // namespace filament_core::scene
