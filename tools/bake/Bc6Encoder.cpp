// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Bc6Encoder.h"

#include "base/math/Math.h"
#include "filament_core/assets/blocks/BlockTexels.h"
#include "filament_core/assets/blocks/BptcPartitions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace filament_core::bake {
namespace {

constexpr int kTexels = 16, kMostCode = 0x7BFF; // of the largest half
constexpr double kWide = 64.0 / 31.0;           // numbers of 16 bits for each code of a half

/// A mode with one line: the first end has `bits`, the second one as many, or a difference of `widths` bits.
struct LineMode {
    uint32_t code, bits, width;
    bool isDelta;
};
constexpr std::array<LineMode, 4> kLineModes{
    { { 0b00011, 10, 10, false }, { 0b00111, 11, 9, true }, { 0b01011, 12, 8, true }, { 0b01111, 16, 4, true } }
};

using Codes = std::array<double3, kTexels>; // of halves
using Ends = std::array<int3, 2>;           // quantized

class BlockWriter {
public:
    void put(uint64_t value, uint32_t count) {
        for (uint32_t i = 0; i < count; ++i, ++mAt) {
            if (value >> i & 1) mBytes[mAt / 8] |= std::byte{ static_cast<uint8_t>(1u << (mAt % 8)) };
        }
    }
    std::array<std::byte, 16> const& bytes() const { return mBytes; }

private:
    std::array<std::byte, 16> mBytes{};
    uint32_t mAt = 0;
};

int unquantized(int value, uint32_t bits) {
    if (bits >= 15 || value == 0) return value;
    if (value == (1 << bits) - 1) return 0xFFFF;
    return ((value << 16) + 0x8000) >> bits;
}

int quantized(double code, uint32_t bits) {
    const int most = (1 << bits) - 1;
    const double wide = (std::clamp(code, 0.0, double(kMostCode)) + 0.5) * kWide; // decoders round down
    const int guess = std::clamp(static_cast<int>(wide * double(1 << bits) / 65536.0), 0, most);
    int best = guess;
    for (const int value : { guess - 1, guess + 1 }) {
        if (value < 0 || value > most) continue;
        if (std::abs(unquantized(value, bits) - wide) < std::abs(unquantized(best, bits) - wide)) best = value;
    }
    return best;
}

/// Nearest ends that the mode has: of a difference that is too large, the largest.
Ends quantizedEnds(LineMode const& mode, double3 first, double3 second) {
    Ends ends{};
    for (int c = 0; c < 3; ++c) {
        ends[0][c] = quantized(first[c], mode.bits);
        ends[1][c] = quantized(second[c], mode.bits);
        if (!mode.isDelta) continue;
        const int reach = 1 << (mode.width - 1);
        ends[1][c] = ends[0][c] + std::clamp(ends[1][c] - ends[0][c], -reach, reach - 1);
    }
    return ends;
}

struct Line {
    Ends ends{};
    std::array<uint8_t, kTexels> indices{};
    double error = 1e300;
};

Line withNearestIndices(LineMode const& mode, Ends const& ends, Codes const& codes) {
    std::array<double3, 16> palette;
    for (size_t i = 0; i < palette.size(); ++i) {
        const int weight = assets::blocks::bptcWeights(4)[i];
        for (int c = 0; c < 3; ++c) {
            const int first = unquantized(ends[0][c], mode.bits), second = unquantized(ends[1][c], mode.bits);
            palette[i][c] = double(((first * (64 - weight) + second * weight + 32) >> 6) * 31 >> 6);
        }
    }
    Line line{ ends, {}, 0 };
    for (size_t t = 0; t < codes.size(); ++t) {
        double least = 1e300;
        for (size_t i = 0; i < palette.size(); ++i) {
            const double3 off = codes[t] - palette[i];
            const double squared = glm::dot(off, off);
            if (squared < least) least = squared, line.indices[t] = static_cast<uint8_t>(i);
        }
        line.error += least;
    }
    return line;
}

/// Ends of the line that is nearest to the codes, where their places on it are given; unchanged if those are all one.
void fitEnds(Line const& line, Codes const& codes, double3& first, double3& second) {
    double aa = 0, ab = 0, bb = 0;
    double3 a(0.0), b(0.0);
    for (size_t t = 0; t < codes.size(); ++t) {
        const double s = assets::blocks::bptcWeights(4)[line.indices[t]] / 64.0;
        aa += (1 - s) * (1 - s), ab += s * (1 - s), bb += s * s;
        a += (1 - s) * codes[t], b += s * codes[t];
    }
    const double determinant = aa * bb - ab * ab;
    if (determinant < 1e-9) return;
    first = (bb * a - ab * b) / determinant;
    second = (aa * b - ab * a) / determinant;
}

/// The first principal component, by the power method.
void principalEnds(Codes const& codes, double3& first, double3& second) {
    double3 mean(0.0);
    for (double3 const& code : codes) mean += code / double(kTexels);
    std::array<double3, 3> covariance{};
    double3 axis(0.0);
    for (double3 const& code : codes) {
        const double3 off = code - mean;
        for (size_t c = 0; c < 3; ++c) covariance[c] += off[static_cast<int>(c)] * off;
        if (glm::dot(off, off) > glm::dot(axis, axis)) axis = off;
    }
    for (int step = 0; step < 8 && glm::length(axis) > 0; ++step) {
        axis = glm::normalize(axis);
        axis = double3(glm::dot(covariance[0], axis), glm::dot(covariance[1], axis), glm::dot(covariance[2], axis));
    }
    const double length = glm::length(axis);
    if (length > 0) axis /= length;
    double low = 0, high = 0;
    for (double3 const& code : codes) {
        const double along = glm::dot(code - mean, axis);
        low = std::min(low, along), high = std::max(high, along);
    }
    first = mean + low * axis, second = mean + high * axis;
}

Line bestLine(LineMode const& mode, Codes const& codes, double3 first, double3 second) {
    constexpr int kSteps = 3;
    Line best;
    for (int step = 0; step <= kSteps; ++step) {
        const Line line = withNearestIndices(mode, quantizedEnds(mode, first, second), codes);
        if (line.error < best.error) best = line;
        fitEnds(line, codes, first, second);
    }
    return best;
}

/// Bits as the specification's table has them: ten of the first end, those of the second, and then the highest ones of
/// the first, from the highest on.
std::array<std::byte, 16> packed(LineMode const& mode, Line line) {
    if (line.indices[0] >= 8) { // the first index has three bits
        std::swap(line.ends[0], line.ends[1]);
        for (uint8_t& index : line.indices) index = static_cast<uint8_t>(15 - index);
    }
    BlockWriter bits;
    bits.put(mode.code, 5);
    for (int c = 0; c < 3; ++c) bits.put(static_cast<uint64_t>(line.ends[0][c]) & 0x3FF, 10);
    for (int c = 0; c < 3; ++c) {
        const int second = mode.isDelta ? line.ends[1][c] - line.ends[0][c] : line.ends[1][c];
        bits.put(static_cast<uint64_t>(static_cast<uint32_t>(second)) & ((1u << mode.width) - 1), mode.width);
        for (uint32_t bit = mode.bits; bit-- > 10;) bits.put(static_cast<uint64_t>(line.ends[0][c]) >> bit & 1, 1);
    }
    for (size_t t = 0; t < line.indices.size(); ++t) bits.put(line.indices[t], t == 0 ? 3 : 4);
    return bits.bytes();
}

/// Swapped ends must have a difference that the mode can hold, too.
bool canSwap(LineMode const& mode, Ends const& ends) {
    if (!mode.isDelta) return true;
    const int reach = 1 << (mode.width - 1);
    for (int c = 0; c < 3; ++c) {
        if (ends[0][c] - ends[1][c] >= reach) return false;
    }
    return true;
}

std::array<std::byte, 16> encodedBlock(Codes const& codes) {
    double3 first, second;
    principalEnds(codes, first, second);
    Line best;
    LineMode const* bestMode = &kLineModes[0];
    for (LineMode const& mode : kLineModes) {
        const Line line = bestLine(mode, codes, first, second);
        const bool fits = line.indices[0] < 8 || canSwap(mode, line.ends);
        if (fits && line.error < best.error) best = line, bestMode = &mode;
    }
    return packed(*bestMode, best);
}

std::array<std::byte, 8> encodedChannel(std::array<int, kTexels> const& codes) {
    const auto [low, high] = std::ranges::minmax(codes);
    std::array<std::byte, 8> block{ static_cast<std::byte>(high), static_cast<std::byte>(low) };
    if (low == high) return block; // index 0 is the first end
    uint64_t indices = 0;
    for (size_t t = 0; t < codes.size(); ++t) {
        const auto parts = static_cast<uint64_t>(std::lround(7.0 * double(high - codes[t]) / double(high - low)));
        const uint64_t index = parts == 0 ? 0 : parts == 7 ? 1 : parts + 1; // the ends are 0 and 1
        indices |= index << (3 * t);
    }
    for (size_t i = 0; i < 6; ++i) block[2 + i] = static_cast<std::byte>(indices >> (8 * i));
    return block;
}

/// Calls `at(t, x, y)` for the texels of each block, then `done()`.
template <class At, class Done>
void forBlocks(uint32_t width, uint32_t height, At const& at, Done const& done) {
    for (uint32_t y = 0; y < height; y += 4) {
        for (uint32_t x = 0; x < width; x += 4) {
            for (uint32_t t = 0; t < kTexels; ++t)
                at(t, std::min(x + t % 4, width - 1), std::min(y + t / 4, height - 1));
            done();
        }
    }
}

} // namespace

std::vector<std::byte> encodeBc6(std::span<const std::byte> halves, uint32_t width, uint32_t height) {
    std::vector<std::byte> blocks;
    Codes codes;
    const auto take = [&](uint32_t t, uint32_t x, uint32_t y) {
        std::array<uint16_t, 3> texel;
        std::memcpy(texel.data(), &halves[(size_t{ y } * width + x) * 8], sizeof(texel));
        for (size_t c = 0; c < 3; ++c) codes[t][static_cast<int>(c)] = std::min<int>(texel[c], kMostCode);
    };
    forBlocks(width, height, take, [&] {
        const std::array<std::byte, 16> block = encodedBlock(codes);
        blocks.insert(blocks.end(), block.begin(), block.end());
    });
    return blocks;
}

std::vector<std::byte> encodeBc4(std::span<const std::byte> codes, uint32_t width, uint32_t height) {
    std::vector<std::byte> blocks;
    std::array<int, kTexels> block{};
    forBlocks(
            width, height,
            [&](uint32_t t, uint32_t x, uint32_t y) {
                block[t] = std::to_integer<int>(codes[size_t{ y } * width + x]);
            },
            [&] {
                const std::array<std::byte, 8> encoded = encodedChannel(block);
                blocks.insert(blocks.end(), encoded.begin(), encoded.end());
            });
    return blocks;
}

} // namespace filament_core::bake
