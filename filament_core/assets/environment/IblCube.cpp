// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/IblCube.h"

#include "base/Assert.h"
#include "base/math/Elementary.h"

#include <bit>

namespace filament_core::assets {
namespace {

constexpr uint32_t kCubeRowsPerJob = 4;
constexpr uint32_t kLeastSubSamples = 4; // per axis: the source's bilinear kernel gets 4 samples per texel
constexpr uint32_t kMostSubSamples = 32;

// Towards the poles the rows of a panorama are stretched: a pixel covers 1 / sin(polar) times less azimuth than at the
// equator. Averaging that many pixels of a row makes every row as sharp as the equator, and preserves its sum.
HdrImage widenedTowardsPoles(HdrImage const& image, jobs::JobSystem& jobs) {
    HdrImage wide{ .width = image.width, .height = image.height, .pixels = {}, .repairs = {} };
    wide.pixels.resize(image.pixels.size());
    jobs::parallelFor<"environment rows">(jobs, image.height, kCubeRowsPerJob, [&](size_t begin, size_t end) {
        const auto width = static_cast<int>(image.width);
        // A span may be as wide as a turn and begin at any column, so it reaches into the turn before and the turn
        // after. Doubles, because a mean is the difference of two sums over all of the row.
        std::vector<double3> sums(static_cast<size_t>(width) * 3 + 1); // running sums of three turns
        for (size_t y = begin; y < end; ++y) {
            const float3* const row = &image.at(0, static_cast<uint32_t>(y));
            for (int x = 0; x < 3 * width; ++x) {
                sums[static_cast<size_t>(x) + 1] = sums[static_cast<size_t>(x)] + double3(row[x % width]);
            }
            const double polar = (static_cast<double>(y) + 0.5) / image.height * std::numbers::pi;
            const double span = std::clamp(1.0 / elementary::sin(polar), 1.0, static_cast<double>(width));
            const auto sumBefore = [&](double position) { // sum of the pixels left of a fractional position
                const double at = std::floor(position), fraction = position - at;
                const auto i = static_cast<size_t>(at);
                return sums[i] + (sums[i + 1] - sums[i]) * fraction;
            };
            for (int x = 0; x < width; ++x) {
                const double centre = width + x + 0.5;
                const double3 total = sumBefore(centre + 0.5 * span) - sumBefore(centre - 0.5 * span);
                wide.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y)) = float3(total / span);
            }
        }
    });
    return wide;
}

// Bilinear; columns wrap around, rows end at the poles.
float3 sampleEquirect(HdrImage const& image, float2 uv) {
    const auto width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    const float x = uv.x * static_cast<float>(width) - 0.5f, y = uv.y * static_cast<float>(height) - 0.5f;
    const float floorX = std::floor(x), floorY = std::floor(y);
    const float fx = x - floorX, fy = y - floorY;
    const int column = static_cast<int>(floorX), row = static_cast<int>(floorY);
    const auto wrap = [&](int i) { return static_cast<uint32_t>(i < 0 ? i + width : i >= width ? i - width : i); };
    const auto clampRow = [&](int i) { return static_cast<uint32_t>(std::clamp(i, 0, height - 1)); };
    const float3* const upper = &image.at(0, clampRow(row));
    const float3* const lower = &image.at(0, clampRow(row + 1));
    const uint32_t left = wrap(column), right = wrap(column + 1);
    return (upper[left] * (1 - fx) + upper[right] * fx) * (1 - fy) + (lower[left] * (1 - fx) + lower[right] * fx) * fy;
}

// Enough samples that their spacing is a quarter of a source pixel or of a texel, whichever is smaller.
uint32_t subSamplesFor(HdrImage const& image, uint32_t size) {
    const uint32_t pixelsPerTexel = (image.width / 4 + size - 1) / size;
    return std::clamp(kLeastSubSamples * pixelsPerTexel, kLeastSubSamples, kMostSubSamples);
}

Texel meanRadiance(HdrImage const& image, uint32_t face, int x, int y, uint32_t size, uint32_t subSamples) {
    float3 sum(0.0f);
    float weights = 0;
    const float step = 2.0f / static_cast<float>(size * subSamples);
    const float s0 = 2.0f * static_cast<float>(x) / static_cast<float>(size) - 1.0f + 0.5f * step;
    const float t0 = 2.0f * static_cast<float>(y) / static_cast<float>(size) - 1.0f + 0.5f * step;
    for (uint32_t j = 0; j < subSamples; ++j) {
        for (uint32_t i = 0; i < subSamples; ++i) {
            const CubePoint point{ face, s0 + static_cast<float>(i) * step, t0 + static_cast<float>(j) * step };
            const float3 onCube = directionFromCube(point);
            const float inverseLength = 1.0f / std::sqrt(glm::dot(onCube, onCube));
            const float weight = inverseLength * inverseLength * inverseLength; // solid angle of a piece of the face
            sum += sampleEquirect(image, equirectFromDirection(onCube * inverseLength)) * weight;
            weights += weight;
        }
    }
    return Texel{ sum.x, sum.y, sum.z, 0 } / splat(weights);
}

} // namespace

Texel IblCubeLevel::beyondEdge(uint32_t face, int x, int y) const {
    // Slightly outside the edge, to hit the neighbour's first row at the same place along the edge.
    constexpr float kBeyond = 1.0f + 1e-4f;
    const auto coordinate = [&](int i) {
        if (i < 0) return -kBeyond;
        return i >= static_cast<int>(mSize) ? kBeyond : faceCoordinate(i, mSize);
    };
    const CubePoint point = cubeFromDirection(directionFromCube({ face, coordinate(x), coordinate(y) }));
    const auto texel = [&](float c) {
        return std::clamp(static_cast<int>((c * 0.5f + 0.5f) * static_cast<float>(mSize)), 0,
                          static_cast<int>(mSize) - 1);
    };
    return at(point.face, texel(point.s), texel(point.t));
}

void IblCubeLevel::fillBorder() {
    const int last = static_cast<int>(mSize) - 1;
    for (uint32_t face = 0; face < 6; ++face) {
        for (int i = 0; i <= last; ++i) {
            at(face, i, -1) = beyondEdge(face, i, -1);
            at(face, i, last + 1) = beyondEdge(face, i, last + 1);
            at(face, -1, i) = beyondEdge(face, -1, i);
            at(face, last + 1, i) = beyondEdge(face, last + 1, i);
        }
        // Corners come after the edges, from which they are computed: three faces meet there, so there is no fourth
        // texel.
        for (const int y : { -1, last + 1 }) {
            for (const int x : { -1, last + 1 }) {
                const int inX = std::clamp(x, 0, last), inY = std::clamp(y, 0, last);
                at(face, x, y) = (at(face, inX, inY) + at(face, x, inY) + at(face, inX, y)) / splat(3.0f);
            }
        }
    }
}

IblCubeLevel faceLevelFromEquirect(HdrImage const& image, uint32_t size, jobs::JobSystem& jobs) {
    FILAMENT_ASSERT(std::has_single_bit(size), "the size of a cube face is a power of two");
    FILAMENT_ASSERT(image.width > 0 && image.pixels.size() == size_t(image.width) * image.height,
                    "an environment has width * height pixels, more than none");
    const HdrImage wide = widenedTowardsPoles(image, jobs);
    const uint32_t subSamples = subSamplesFor(image, size);
    IblCubeLevel level(size);
    jobs::parallelFor<"cube rows">(jobs, size_t(6) * size, 1, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            const auto face = static_cast<uint32_t>(row / size);
            const auto y = static_cast<int>(row % size);
            for (int x = 0; x < static_cast<int>(size); ++x) {
                level.at(face, x, y) = meanRadiance(wide, face, x, y, size, subSamples);
            }
        }
    });
    level.fillBorder();
    return level;
}

std::vector<float> texelSolidAngles(uint32_t size) {
    const size_t corners = size_t(size) + 1;
    std::vector<double> sums(corners * corners); // from the centre of the face
    for (size_t y = 0; y < corners; ++y) {
        for (size_t x = 0; x < corners; ++x) {
            const double s = 2.0 * static_cast<double>(x) / size - 1.0, t = 2.0 * static_cast<double>(y) / size - 1.0;
            // The corners of a texel are shared by four, so the solid angle from the centre of the face to a corner is
            // computed once and differences follow.
            sums[y * corners + x] = cornerSolidAngle(s, t);
        }
    }
    std::vector<float> angles(size_t(size) * size);
    for (size_t y = 0; y < size; ++y) {
        for (size_t x = 0; x < size; ++x) {
            const double* const at = &sums[y * corners + x];
            angles[y * size + x] = static_cast<float>(at[0] - at[1] - at[corners] + at[corners + 1]);
        }
    }
    return angles;
}

IblCubeLevel halved(IblCubeLevel const& level, jobs::JobSystem& jobs) {
    FILAMENT_ASSERT(level.size() >= 2, "a level of one texel has no smaller one");
    const uint32_t size = level.size() / 2;
    const std::vector<float> weights = texelSolidAngles(level.size());
    IblCubeLevel half(size);
    jobs::parallelFor<"cube mips">(jobs, size_t(6) * size, kCubeRowsPerJob, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            const auto face = static_cast<uint32_t>(row / size), y = static_cast<uint32_t>(row % size);
            for (uint32_t x = 0; x < size; ++x) {
                Texel sum{};
                float weightSum = 0;
                for (uint32_t corner = 0; corner < 4; ++corner) {
                    const uint32_t fromX = 2 * x + (corner & 1), fromY = 2 * y + (corner >> 1);
                    // Texels near the corners of a face cover less of the sphere. Plain means would make the light of a
                    // level differ from that of the level before.
                    const float weight = weights[size_t(fromY) * level.size() + fromX];
                    sum += level.at(face, static_cast<int>(fromX), static_cast<int>(fromY)) * splat(weight);
                    weightSum += weight;
                }
                half.at(face, static_cast<int>(x), static_cast<int>(y)) = sum / splat(weightSum);
            }
        }
    });
    half.fillBorder();
    return half;
}

IblCube cubeFromEquirect(HdrImage const& image, uint32_t size, jobs::JobSystem& jobs) {
    IblCube cube;
    cube.push_back(faceLevelFromEquirect(image, size, jobs));
    while (cube.back().size() > 1) cube.push_back(halved(cube.back(), jobs));
    return cube;
}

} // namespace filament_core::assets
