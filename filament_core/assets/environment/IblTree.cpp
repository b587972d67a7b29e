// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/IblTree.h"

#include "base/Assert.h"
#include "base/math/Elementary.h"

namespace filament_core::assets {
namespace {

constexpr size_t kQuadsPerJob = 64;

using Mask __attribute__((vector_size(16))) = int32_t;

Texel masked(Texel value, Mask keep) { return reinterpret_cast<Texel>(reinterpret_cast<Mask>(value) & keep); }

bool any(Mask m) { return ((m[0] | m[1]) | (m[2] | m[3])) != 0; }

float sumOf(Texel t) { return (t[0] + t[1]) + (t[2] + t[3]); }

// The lobe's weight as a function of the cosine c with its axis, up to a factor: D(noh) n.l with noh^2 = (1 + c) / 2,
// since h is half way.
struct LobeWeight {
    float sum, difference; // 1 + alpha^2, 1 - alpha^2
    explicit LobeWeight(float alpha) : sum(1 + alpha * alpha), difference(1 - alpha * alpha) {}
    Texel operator()(Texel cosine) const {
        const Texel denominator = splat(sum) - splat(difference) * cosine;
        return masked(cosine / (denominator * denominator), cosine > splat(0.0f));
    }
};

double luminanceOf(double red, double green, double blue) { return 0.2126 * red + 0.7152 * green + 0.0722 * blue; }

} // namespace

struct IblTree::Sums {
    Texel red{}, green{}, blue{}, weight{};
};

// For small lobes the pieces form rings: 2 pi / opening^2 nodes each time the distance from the lobe's core, of width 2
// alpha, grows by a factor of e, up to the horizon.
Lobe Lobe::ofPieces(float alpha, uint32_t pieces) {
    const float horizon = 0.5f * kPi;
    const float rings = 0.5f + elementary::log(horizon / std::min(2 * alpha, horizon));
    return { alpha, std::sqrt(2 * kPi * rings / static_cast<float>(pieces)) };
}

IblTree::Level IblTree::leavesOf(IblCubeLevel const& texels, jobs::JobSystem& jobs) {
    const uint32_t size = texels.size(), half = size / 2;
    const std::vector<float> solidAngles = texelSolidAngles(size);
    Level level{ size, std::vector<Quad>(size_t(6) * half * half) };
    jobs::parallelFor<"light tree">(jobs, level.quads.size(), kQuadsPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Quad& quad = level.quads[i];
            const auto face = static_cast<uint32_t>(i / (size_t(half) * half));
            for (int corner = 0; corner < 4; ++corner) {
                const int x = static_cast<int>(i % half) * 2 + (corner & 1);
                const int y = static_cast<int>(i / half % half) * 2 + (corner >> 1);
                const float3 d =
                        glm::normalize(directionFromCube({ face, faceCoordinate(x, size), faceCoordinate(y, size) }));
                const float angle = solidAngles[static_cast<size_t>(y) * size + static_cast<size_t>(x)];
                const float3 energy = texels.radiance(face, x, y) * angle;
                quad.x[corner] = quad.energyX[corner] = d.x;
                quad.y[corner] = quad.energyY[corner] = d.y;
                quad.z[corner] = quad.energyZ[corner] = d.z;
                quad.red[corner] = energy.x;
                quad.green[corner] = energy.y;
                quad.blue[corner] = energy.z;
                quad.solidAngle[corner] = angle;
            }
        }
    });
    return level;
}

IblTree::Level IblTree::parentsOf(Level const& children, jobs::JobSystem& jobs) {
    const uint32_t size = children.size / 2, half = size / 2;
    Level level{ size, std::vector<Quad>(size_t(6) * half * half) };
    jobs::parallelFor<"light tree">(jobs, level.quads.size(), kQuadsPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Quad& quad = level.quads[i];
            const size_t face = i / (size_t(half) * half);
            for (int corner = 0; corner < 4; ++corner) {
                const size_t x = i % half * 2 + (corner & 1),
                             y = i / half % half * 2 + (static_cast<size_t>(corner) >> 1);
                Quad const& from = children.quads[(face * size + y) * size + x];
                double3 middle(0.0), centre(0.0);
                for (int c = 0; c < 4; ++c) {
                    const double angle = from.solidAngle[c];
                    middle += double3(from.x[c], from.y[c], from.z[c]) * angle;
                    // the small term proportional to the solid angle puts the centre of a black node in its middle
                    const double light = luminanceOf(from.red[c], from.green[c], from.blue[c]) + 1e-12 * angle;
                    centre += double3(from.energyX[c], from.energyY[c], from.energyZ[c]) * light;
                }
                middle = glm::normalize(middle);
                centre = glm::normalize(centre);
                quad.x[corner] = static_cast<float>(middle.x);
                quad.y[corner] = static_cast<float>(middle.y);
                quad.z[corner] = static_cast<float>(middle.z);
                quad.energyX[corner] = static_cast<float>(centre.x);
                quad.energyY[corner] = static_cast<float>(centre.y);
                quad.energyZ[corner] = static_cast<float>(centre.z);
                quad.red[corner] = sumOf(from.red);
                quad.green[corner] = sumOf(from.green);
                quad.blue[corner] = sumOf(from.blue);
                quad.solidAngle[corner] = sumOf(from.solidAngle);
            }
        }
    });
    return level;
}

IblTree::IblTree(IblCube const& cube, jobs::JobSystem& jobs) {
    size_t leaf = 0;
    // At 53 bytes a texel, leaves of 1024 texels a side would take 330 MB.
    while (cube[leaf].size() > kMaxLeafSize) ++leaf;
    FILAMENT_ASSERT(cube[leaf].size() >= kCoarsestSize, "an environment has 8 texels a face side or more");
    mLevels.push_back(leavesOf(cube[leaf], jobs));
    while (mLevels.back().size > kCoarsestSize) mLevels.push_back(parentsOf(mLevels.back(), jobs));
    // Built from the leaves up, walked from the root down.
    std::reverse(mLevels.begin(), mLevels.end());
}

void IblTree::addQuad(size_t levelIndex, size_t quadIndex, float3 axis, Lobe const& lobe, Sums& sums) const {
    Level const& level = mLevels[levelIndex];
    Quad const& quad = level.quads[quadIndex];
    const Texel cosine = quad.x * splat(axis.x) + quad.y * splat(axis.y) + quad.z * splat(axis.z);
    const float size = 2.0f / static_cast<float>(level.size); // radians, at the largest texels of a face
    // A node below the horizon by more than its size has no part above it.
    const Mask above = cosine > splat(-size);
    Mask whole = above;
    if (levelIndex + 1 < mLevels.size()) {
        // squared distance (as a chord) and squared size; the lobe's core, of width 2 alpha, is flat
        const float opening2 = lobe.openingAngle * lobe.openingAngle, core2 = 4 * lobe.alpha * lobe.alpha;
        const Texel distance2 = splat(2.0f) - splat(2.0f) * cosine;
        const Texel reach2 = distance2 > splat(core2) ? distance2 : splat(core2);
        whole = above & (splat(size * size) <= reach2 * splat(opening2));
        const Mask open = above & ~whole;
        if (any(open)) {
            const size_t half = level.size / 2, row = quadIndex / half, column = quadIndex % half; // of all six faces
            const size_t first = row * 2 * level.size + column * 2;
            if (open[0]) addQuad(levelIndex + 1, first, axis, lobe, sums);
            if (open[1]) addQuad(levelIndex + 1, first + 1, axis, lobe, sums);
            if (open[2]) addQuad(levelIndex + 1, first + level.size, axis, lobe, sums);
            if (open[3]) addQuad(levelIndex + 1, first + level.size + 1, axis, lobe, sums);
        }
    }
    if (!any(whole)) return;
    const LobeWeight weight(lobe.alpha);
    const Texel energyCosine =
            quad.energyX * splat(axis.x) + quad.energyY * splat(axis.y) + quad.energyZ * splat(axis.z);
    const Texel light = masked(weight(energyCosine), whole);
    sums.red += light * quad.red;
    sums.green += light * quad.green;
    sums.blue += light * quad.blue;
    sums.weight += masked(weight(cosine), whole) * quad.solidAngle;
}

float3 IblTree::integrate(float3 axis, Lobe const& lobe) const {
    Sums sums;
    for (size_t quad = 0; quad < mLevels.front().quads.size(); ++quad) addQuad(0, quad, axis, lobe, sums);
    // The same nodes are in both sums, so what the pieces miss of the lobe cancels, and a constant sky stays constant
    // up to rounding.
    return float3(sumOf(sums.red), sumOf(sums.green), sumOf(sums.blue)) / sumOf(sums.weight);
}

} // namespace filament_core::assets
