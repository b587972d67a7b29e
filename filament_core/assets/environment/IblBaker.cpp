// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/IblBaker.h"

#include "base/Assert.h"
#include "base/math/Half.h"
#include "base/math/Rgbm.h"
#include "base/math/SharedExponent.h"
#include "filament_core/assets/environment/IblTree.h"
#include "shaders/lib/LibCpp.h"

#include <bit>
#include <cstring>

namespace filament_core::assets {
namespace {

constexpr uint32_t kSmallestSpecularFace = 16;
constexpr size_t kTexelsPerJob = 8; // about 50 microseconds at 512 pieces

IblCubeLevel prefilterLevel(IblTree const& tree, uint32_t size, Lobe const& lobe, jobs::JobSystem& jobs) {
    IblCubeLevel level(size);
    const size_t faceTexels = size_t(size) * size;
    jobs::parallelFor<"prefilter">(jobs, 6 * faceTexels, kTexelsPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto face = static_cast<uint32_t>(i / faceTexels);
            const int x = static_cast<int>(i % size), y = static_cast<int>(i % faceTexels / size);
            const CubePoint centre{ face, faceCoordinate(x, size), faceCoordinate(y, size) };
            const float3 light = tree.integrate(glm::normalize(directionFromCube(centre)), lobe);
            level.at(face, x, y) = Texel{ light.x, light.y, light.z, 0 };
        }
    });
    level.fillBorder();
    return level;
}

using ShSums = std::array<double3, 9>;

// Adds radiance * solid angle * polynomial for one row of a face. The polynomials are those of irradianceSh() in
// ibl.glsl.
void projectRow(IblCubeLevel const& level, std::span<const float> solidAngles, uint32_t face, uint32_t y,
                ShSums& sums) {
    const uint32_t size = level.size();
    for (uint32_t x = 0; x < size; ++x) {
        const CubePoint centre{ face, faceCoordinate(static_cast<int>(x), size),
                                faceCoordinate(static_cast<int>(y), size) };
        const double3 n = glm::normalize(double3(directionFromCube(centre)));
        const double3 light = double3(level.radiance(face, static_cast<int>(x), static_cast<int>(y))) *
                              static_cast<double>(solidAngles[size_t(y) * size + x]);
        const std::array<double, 9> polynomials{
            1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.z * n.x, n.x * n.x - n.y * n.y
        };
        for (size_t i = 0; i < 9; ++i) sums[i] += light * polynomials[i];
    }
}

// The squared normalisation of each basis polynomial times the cosine lobe's band factor over pi (1, 2/3, 1/4). It is
// squared because projection and evaluation each need it once. Ramamoorthi and Hanrahan 2001, eqs. 3 and 8.
std::array<double, 9> shFactors() {
    constexpr double pi = std::numbers::pi;
    constexpr double band0 = 1.0 / (4 * pi), band1 = 2.0 / 3 * 3 / (4 * pi), band2 = 0.25 * 15 / (4 * pi);
    return { band0, band1, band1, band1, band2, band2, band2 / 12, band2, band2 / 4 };
}

float maximumOf(backend::Format format, int component) {
    if (format == backend::Format::RGBA16F) return kMaxHalf;
    if (format == backend::Format::RGB9E5) return kMaxRgb9E5;
    if (format == backend::Format::RGBA8) return kMaxRgbm;
    return component < 2 ? kMaxFloat11 : kMaxFloat10;
}

void encodeTexel(float3 color, backend::Format format, std::byte* out) {
    if (format == backend::Format::RGBA16F) {
        constexpr uint16_t kOne = 0x3C00;
        const std::array<uint16_t, 4> halves{ halfFromFloat(color.x), halfFromFloat(color.y), halfFromFloat(color.z),
                                              kOne };
        std::memcpy(out, halves.data(), sizeof(halves));
    } else {
        const uint32_t packed = format == backend::Format::RGB9E5  ? packRgb9E5(color)
                                : format == backend::Format::RGBA8 ? packRgbm(color)
                                                                   : packR11G11B10F(color);
        std::memcpy(out, &packed, sizeof(packed));
    }
}

struct RowLoss {
    uint64_t clippedTexels = 0;
    double energy = 0, lost = 0;
};

RowLoss encodeRow(IblCubeLevel const& level, std::span<const float> solidAngles, uint32_t face, uint32_t y,
                  backend::Format format, std::byte* out) {
    RowLoss loss;
    const size_t texelBytes = backend::formatInfo(format).bytesPerBlock;
    for (uint32_t x = 0; x < level.size(); ++x) {
        const float3 color = level.radiance(face, static_cast<int>(x), static_cast<int>(y));
        const double solidAngle = solidAngles[size_t(y) * level.size() + x];
        bool clipped = false;
        for (int c = 0; c < 3; ++c) {
            const float excess = color[c] - maximumOf(format, c);
            clipped = clipped || excess > 0;
            loss.energy += solidAngle * color[c];
            loss.lost += excess > 0 ? solidAngle * excess : 0.0;
        }
        loss.clippedTexels += clipped ? 1 : 0;
        encodeTexel(color, format, out + x * texelBytes);
    }
    return loss;
}

} // namespace

bool isEnvironmentFormat(backend::Format format) {
    return format == backend::Format::RGBA16F || format == backend::Format::R11G11B10F ||
           format == backend::Format::RGB9E5 || format == backend::Format::RGBA8;
}

uint32_t specularLevelCount(uint32_t faceSize) {
    const uint32_t steps = faceSize > kSmallestSpecularFace ? std::bit_width(faceSize / kSmallestSpecularFace) : 1u;
    return std::max(steps, 2u);
}

std::vector<IblCubeLevel> prefilterSpecular(IblCube const& cube, uint32_t faceSize, uint32_t pieces,
                                            jobs::JobSystem& jobs, IblProgress const& progress,
                                            RoughnessMapping mapping) {
    FILAMENT_ASSERT(std::has_single_bit(faceSize) && faceSize >= 2,
                    "the size of a cube face is a power of two, 2 or more");
    FILAMENT_ASSERT(faceSize <= cube.front().size(), "a specular cube is no finer than the environment it comes from");
    FILAMENT_ASSERT(pieces > 0, "a lobe is integrated over one piece of the sky or more");
    const uint32_t count = specularLevelCount(faceSize);
    const auto last = static_cast<float>(count - 1);
    const IblTree tree(cube, jobs);
    // Level 0 is the mirror: a lobe of roughness 0 has no width, so the environment itself is its answer.
    std::vector<IblCubeLevel> levels{ cube[std::bit_width(cube.front().size() / faceSize) - 1u] };
    for (uint32_t i = 1; i < count; ++i) {
        if (progress) progress(i, count);
        const float roughness =
                shader::lib::perceptualRoughnessFromLevel(static_cast<float>(i), last, static_cast<int>(mapping));
        const float alpha = shader::lib::alphaFromPerceptual(shader::lib::clampPerceptualRoughness(roughness));
        levels.push_back(prefilterLevel(tree, faceSize >> i, Lobe::ofPieces(alpha, pieces), jobs));
    }
    if (progress) progress(count, count);
    return levels;
}

IblCubeLevel irradianceCube(IblCubeLevel const& level, uint32_t faceSize, jobs::JobSystem& jobs) {
    struct Source {
        float3 direction, light;
        float solidAngle;
    };
    std::vector<Source> sources;
    const std::vector<float> solidAngles = texelSolidAngles(level.size());
    for (uint32_t face = 0; face < 6; ++face) {
        for (size_t i = 0; i < solidAngles.size(); ++i) {
            const auto x = static_cast<int>(i % level.size()), y = static_cast<int>(i / level.size());
            const CubePoint centre{ face, faceCoordinate(x, level.size()), faceCoordinate(y, level.size()) };
            sources.push_back(
                    { glm::normalize(directionFromCube(centre)), level.radiance(face, x, y), solidAngles[i] });
        }
    }
    IblCubeLevel irradiance(faceSize);
    const size_t faceTexels = size_t(faceSize) * faceSize;
    jobs::parallelFor<"irradiance">(jobs, 6 * faceTexels, kTexelsPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto face = static_cast<uint32_t>(i / faceTexels);
            const int x = static_cast<int>(i % faceSize), y = static_cast<int>(i % faceTexels / faceSize);
            const float3 normal = glm::normalize(
                    directionFromCube({ face, faceCoordinate(x, faceSize), faceCoordinate(y, faceSize) }));
            float3 light(0.0f);
            float weights = 0;
            for (Source const& source : sources) {
                const float weight = std::max(glm::dot(normal, source.direction), 0.0f) * source.solidAngle;
                light += source.light * weight;
                weights += weight;
            }
            // The sum of the weights is pi only up to the error of the quadrature. Dividing by it keeps a constant sky
            // constant.
            irradiance.at(face, x, y) = Texel{ light.x, light.y, light.z, 0 } / splat(weights);
        }
    });
    irradiance.fillBorder();
    return irradiance;
}

std::array<float4, 9> irradianceSh(IblCubeLevel const& level, jobs::JobSystem& jobs) {
    const uint32_t size = level.size();
    const std::vector<float> solidAngles = texelSolidAngles(size);
    // Every row has its own sums, which one thread adds up afterwards: the order of additions, and with it the last
    // bits, must not depend on the number of workers.
    std::vector<ShSums> rows(size_t(6) * size);
    jobs::parallelFor<"project SH">(jobs, rows.size(), 4, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            rows[row].fill(double3(0.0));
            projectRow(level, solidAngles, static_cast<uint32_t>(row / size), static_cast<uint32_t>(row % size),
                       rows[row]);
        }
    });
    const std::array<double, 9> factors = shFactors();
    std::array<float4, 9> coefficients{};
    for (size_t i = 0; i < 9; ++i) {
        double3 sum(0.0);
        for (ShSums const& row : rows) sum += row[i];
        coefficients[i] = float4(float3(sum * factors[i]), 0.0f);
    }
    return coefficients;
}

EncodedCube encodeCube(std::span<const IblCubeLevel> levels, backend::Format format, jobs::JobSystem& jobs) {
    FILAMENT_ASSERT(isEnvironmentFormat(format), "an environment is stored as RGBA16F, R11G11B10F, RGB9E5 or RGBM");
    FILAMENT_ASSERT(!levels.empty(), "a cube has at least one level");
    const uint32_t size = levels.front().size();
    EncodedCube result;
    result.image = { .width = size,
                     .height = size,
                     .layers = 6,
                     .levels = static_cast<uint32_t>(levels.size()),
                     .format = format,
                     .data = {} };
    result.image.data.resize(result.image.levelOffset(result.image.levels));
    double energy = 0, lost = 0;
    for (uint32_t i = 0; i < levels.size(); ++i) {
        const uint32_t levelSize = levels[i].size();
        FILAMENT_ASSERT(levelSize == std::max(1u, size >> i),
                        "each level of a cube is half the size of the one before");
        const std::vector<float> solidAngles = texelSolidAngles(levelSize);
        std::byte* const out = result.image.data.data() + result.image.levelOffset(i);
        const size_t rowBytes = size_t(levelSize) * backend::formatInfo(format).bytesPerBlock;
        // As in irradianceSh(): sums by row, so that the statistics do not depend on the number of workers.
        std::vector<RowLoss> rows(size_t(6) * levelSize);
        jobs::parallelFor<"encode cube">(jobs, rows.size(), 2, [&](size_t begin, size_t end) {
            for (size_t row = begin; row < end; ++row) {
                rows[row] = encodeRow(levels[i], solidAngles, static_cast<uint32_t>(row / levelSize),
                                      static_cast<uint32_t>(row % levelSize), format, out + row * rowBytes);
            }
        });
        for (RowLoss const& row : rows) {
            result.loss.clippedTexels += row.clippedTexels;
            energy += row.energy;
            lost += row.lost;
        }
    }
    result.loss.lostEnergy = energy > 0 ? lost / energy : 0.0;
    return result;
}

} // namespace filament_core::assets
