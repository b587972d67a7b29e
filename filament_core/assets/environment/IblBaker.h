// SPDX-License-Identifier: Apache-2.0
/// IblBaker: computes what image-based lighting looks up from an environment.
///   In      an IblCube (radiance with mip chain).
///   Out     prefilterSpecular(): one cube level per roughness, see shaders/lib/ibl.glsl for the mapping;
///           irradianceSh(): nine coefficients in exactly the form that shaders/lib/ibl.glsl evaluates;
///           encodeCube(): any levels as texels of a GPU format.
///   Source  split sum with V = N, the sky weighted by D and n.l: Karis 2013, "Real Shading in Unreal Engine 4"; the
///           sky is cut into pieces by IblTree. SH: Ramamoorthi and Hanrahan 2001; no windowing.
///   Thread  runs on the job system; sums have a fixed order, so the bits do not depend on the workers.
///   Memory  the results, 16 bytes per texel before encoding.
///   Fails   never.  Cost: bench/filament_core/assets/IblBench.cpp
#pragma once

#include "filament_core/assets/environment/IblCube.h"
#include "filament_core/assets/image/Image.h"

#include <filament_core/Quality.h>

#include <array>
#include <functional>
#include <span>

namespace filament_core::assets {

/// Levels of a specular cube: down to 16 texels per side, the minimum that looks smooth at roughness 1; at least 2
/// levels.
uint32_t specularLevelCount(uint32_t faceSize);

/// Called on the calling thread after each level: levels done, and the total.
using IblProgress = std::function<void(size_t done, size_t total)>;

/// `faceSize` is a power of two from 2 to cube[0].size(); each texel's lobe is cut into about `pieces` pieces.
std::vector<IblCubeLevel> prefilterSpecular(IblCube const& cube, uint32_t faceSize, uint32_t pieces,
                                            jobs::JobSystem& jobs, IblProgress const& progress = {},
                                            RoughnessMapping mapping = RoughnessMapping::Quadratic);

/// Irradiance / pi around each texel of a cube of `faceSize` texels: a plain sum over `level`, normalised so that a
/// constant environment stays constant. A level of 64 texels per side is fine enough for a lobe of 120 degrees.
IblCubeLevel irradianceCube(IblCubeLevel const& level, uint32_t faceSize, jobs::JobSystem& jobs);

/// Irradiance / pi as polynomial coefficients; w is 0. A constant environment L gives (L, 0, 0, ...).
std::array<float4, 9> irradianceSh(IblCubeLevel const& level, jobs::JobSystem& jobs);

/// What a GPU format could not represent.
struct EncodeLoss {
    uint64_t clippedTexels = 0; ///< with at least one component above the format's maximum
    double lostEnergy = 0;      ///< fraction of radiance * solid angle lost by clipping, over all encoded levels
};

struct EncodedCube {
    Image image;
    EncodeLoss loss;
};

/// RGBA16F (alpha 1), R11G11B10F, RGB9E5 (9 bits for the brightest component, where R11G11B10F has 6), and RGBA8, which
/// means RGBM (Rgbm.h).
bool isEnvironmentFormat(backend::Format format);

/// Each of `levels` has half the size of the one before; `format` is one of the above. Clamps at the format's maximum,
/// so that a sun never becomes infinite.
EncodedCube encodeCube(std::span<const IblCubeLevel> levels, backend::Format format, jobs::JobSystem& jobs);

} // namespace filament_core::assets
