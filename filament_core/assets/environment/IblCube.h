// SPDX-License-Identifier: Apache-2.0
/// IblCube: an environment as a cube of floats with its mip chain, the input of every baking step.
///   In      a sanitised equirectangular panorama.
///   Out     levels of size, size / 2, ... 1; each texel is the mean radiance over its solid angle, so the sum of
///           radiance times solid angle is the same for all levels.
///   Storage each face has a border of one texel copied from its neighbours: bilinear look-ups never cross a face.
///   Thread  built on the job system, with the same bits for any number of workers; read-only afterwards.
///   Memory  16 bytes per texel: 8.5 MiB for 256 texels per side.
///   Fails   never.  Cost: bench/filament_core/assets/IblBench.cpp
#pragma once

#include "filament_core/assets/environment/IblDirections.h"
#include "filament_core/assets/image/HdrImage.h"
#include "jobsystem/JobSystem.h"

#include <vector>

namespace filament_core::assets {

/// Four floats in one register; the fourth is unused. A GCC and Clang extension, element-wise like scalar code.
using Texel __attribute__((vector_size(16))) = float;

inline Texel splat(float value) { return Texel{ value, value, value, value }; }

class IblCubeLevel {
public:
    explicit IblCubeLevel(uint32_t size) : mSize(size), mTexels(6 * stride() * stride()) {}

    uint32_t size() const { return mSize; }
    /// x and y in [-1, size]: -1 and size are the border.
    Texel& at(uint32_t face, int x, int y) { return mTexels[index(face, x, y)]; }
    Texel const& at(uint32_t face, int x, int y) const { return mTexels[index(face, x, y)]; }

    float3 radiance(uint32_t face, int x, int y) const {
        const Texel texel = at(face, x, y);
        return { texel[0], texel[1], texel[2] };
    }

    /// Bilinear look-up.
    Texel sample(CubePoint point) const {
        const float half = 0.5f * static_cast<float>(mSize);
        const float x = point.s * half + (half + 0.5f),
                    y = point.t * half + (half + 0.5f); // 1 higher, so that truncation rounds down
        const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
        const Texel fx = splat(x - static_cast<float>(x0)), fy = splat(y - static_cast<float>(y0));
        const Texel* const row =
                &mTexels[(point.face * stride() + static_cast<size_t>(y0)) * stride() + static_cast<size_t>(x0)];
        const Texel upper = row[0] + (row[1] - row[0]) * fx;
        const Texel lower = row[stride()] + (row[stride() + 1] - row[stride()]) * fx;
        return upper + (lower - upper) * fy;
    }

    /// Copies the texels beyond each edge from the neighbouring face; corners get the mean of the three texels that
    /// meet there.
    void fillBorder();

private:
    size_t stride() const { return mSize + 2u; }
    size_t index(uint32_t face, int x, int y) const {
        return (face * stride() + static_cast<size_t>(y + 1)) * stride() + static_cast<size_t>(x + 1);
    }
    Texel beyondEdge(uint32_t face, int x, int y) const;

    uint32_t mSize;
    std::vector<Texel> mTexels;
};

using IblCube = std::vector<IblCubeLevel>;

/// `size` is a power of two.
IblCube cubeFromEquirect(HdrImage const& image, uint32_t size, jobs::JobSystem& jobs);

/// The largest level with its border, without the smaller ones.
IblCubeLevel faceLevelFromEquirect(HdrImage const& image, uint32_t size, jobs::JobSystem& jobs);

/// Solid angle in sr of each texel of one face, row by row; six times their sum is 4 pi.
std::vector<float> texelSolidAngles(uint32_t size);

/// The next smaller level: 2 x 2 texels weighted by their solid angles.
IblCubeLevel halved(IblCubeLevel const& level, jobs::JobSystem& jobs);

} // namespace filament_core::assets
