// SPDX-License-Identifier: Apache-2.0
// ASTC, two-dimensional blocks of the LDR profile: Khronos Data Format Specification 1.3, chapter 23.
#include "filament_core/assets/blocks/AstcColors.h"
#include "filament_core/assets/blocks/AstcPartition.h"
#include "filament_core/assets/blocks/AstcQuantization.h"
#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <array>
#include <optional>

namespace filament_core::assets::blocks {
namespace {

constexpr uint32_t kMaxAstcWeights = 64, kMaxAstcEnds = 18;

/// Section "Block Mode": the grid of weights.
struct AstcGrid {
    uint32_t width = 0, height = 0;
    uint32_t range = 0; ///< of weights, in kAstcRanges
    bool hasTwoPlanes = false;

    uint32_t weights() const { return width * height * (hasTwoPlanes ? 2 : 1); }
};

/// Width and height of the grid; the first of two tables: bits 0 and 1 of the mode are not both 0.
void sizeOfFirstTable(uint32_t mode, AstcGrid& grid) {
    const uint32_t a = mode >> 5 & 3, b = mode >> 7 & 3;
    switch (mode >> 2 & 3) {
    case 0:
        grid.width = b + 4, grid.height = a + 2;
        break;
    case 1:
        grid.width = b + 8, grid.height = a + 2;
        break;
    case 2:
        grid.width = a + 2, grid.height = b + 8;
        break;
    default:
        if (b & 2)
            grid.width = (b & 1) + 2, grid.height = a + 2;
        else
            grid.width = a + 2, grid.height = (b & 1) + 6;
    }
}

/// The second table. Returns whether the mode is one.
bool sizeOfSecondTable(uint32_t mode, AstcGrid& grid) {
    const uint32_t a = mode >> 5 & 3;
    switch (mode >> 7 & 3) {
    case 0:
        grid.width = 12, grid.height = a + 2;
        return true;
    case 1:
        grid.width = a + 2, grid.height = 12;
        return true;
    case 2:
        grid.width = a + 6, grid.height = (mode >> 9 & 3) + 6;
        return true;
    default:
        if (a > 1) return false;
        grid.width = a ? 10 : 6, grid.height = a ? 6 : 10;
        return true;
    }
}

std::optional<AstcGrid> gridOf(uint32_t mode) {
    AstcGrid grid;
    uint32_t range = mode >> 4 & 1;
    bool hasHigh = (mode >> 9 & 1) != 0;
    grid.hasTwoPlanes = (mode >> 10 & 1) != 0;
    if (mode & 3) {
        range |= (mode & 3) << 1;
        sizeOfFirstTable(mode, grid);
    } else {
        range |= (mode >> 2 & 3) << 1;
        if (range < 2 || !sizeOfSecondTable(mode, grid)) return std::nullopt;
        if ((mode >> 7 & 3) == 2) hasHigh = grid.hasTwoPlanes = false; // these bits are of the height
    }
    grid.range = range - 2 + (hasHigh ? 6 : 0);
    return grid;
}

/// "Void-Extent Blocks". Nothing where the block is an error.
std::optional<Texel8> constantColor(BlockBits const& block) {
    const bool isHdr = block.at(9, 1) != 0, hasReserved = block.at(10, 2) != 3;
    if (isHdr || hasReserved) return std::nullopt;
    std::array<uint32_t, 4> extent;
    for (uint32_t i = 0; i < 4; ++i) extent[i] = block.at(12 + 13 * i, 13);
    const bool isEverywhere = std::all_of(extent.begin(), extent.end(), [](uint32_t e) { return e == 0x1FFF; });
    if (!isEverywhere && (extent[0] >= extent[1] || extent[2] >= extent[3])) return std::nullopt;
    const auto code = [&](uint32_t channel) { return static_cast<uint8_t>(block.at(64 + 16 * channel + 8, 8)); };
    return Texel8{ code(0), code(1), code(2), code(3) };
}

/// Where the parts of a block lie, and what they are.
struct AstcLayout {
    AstcGrid grid;
    uint32_t partitions = 1, seed = 0;
    std::array<uint8_t, 4> modes{}; ///< of the ends of each partition
    uint32_t planeChannel = 4;      ///< whose weights are the second plane; 4: none
    uint32_t endsAt = 17, endsBits = 0;
};

/// "Color Endpoint Mode": one mode for all partitions, or modes of two neighbouring classes.
void readEndModes(BlockBits const& block, uint32_t weightsAt, AstcLayout& layout) {
    const uint32_t n = layout.partitions;
    const uint32_t first = block.at(23, 6);
    layout.endsAt = 29;
    uint32_t above = weightsAt;
    if ((first & 3) == 0) {
        layout.modes.fill(static_cast<uint8_t>(first >> 2));
    } else {
        const uint32_t extra = 3 * n - 4;
        above -= extra;
        uint32_t bits = first >> 2 | block.at(above, extra) << 4;
        const uint32_t base = (first & 3) - 1;
        std::array<uint32_t, 4> classes{};
        for (uint32_t i = 0; i < n; ++i, bits >>= 1) classes[i] = base + (bits & 1);
        for (uint32_t i = 0; i < n; ++i, bits >>= 2)
            layout.modes[i] = static_cast<uint8_t>(classes[i] << 2 | (bits & 3));
    }
    layout.endsBits = above;
}

/// Nothing where the block is an error.
std::optional<AstcLayout> layoutOf(BlockBits const& block, uint32_t blockWidth, uint32_t blockHeight) {
    AstcLayout layout;
    const std::optional<AstcGrid> grid = gridOf(block.at(0, 11));
    if (!grid || grid->width > blockWidth || grid->height > blockHeight || grid->weights() > kMaxAstcWeights)
        return std::nullopt;
    layout.grid = *grid;
    const uint32_t weightBits = astcSequenceBits(kAstcRanges[grid->range], grid->weights());
    if (weightBits < 24 || weightBits > 96) return std::nullopt;
    const uint32_t weightsAt = 128 - weightBits;
    layout.partitions = block.at(11, 2) + 1;
    if (layout.partitions == 4 && grid->hasTwoPlanes) return std::nullopt;
    if (layout.partitions == 1) {
        layout.modes[0] = static_cast<uint8_t>(block.at(13, 4));
        layout.endsBits = weightsAt;
    } else {
        layout.seed = block.at(13, 10);
        readEndModes(block, weightsAt, layout);
    }
    if (grid->hasTwoPlanes) {
        layout.endsBits -= 2;
        layout.planeChannel = block.at(layout.endsBits, 2);
    }
    if (layout.endsBits < layout.endsAt) return std::nullopt;
    layout.endsBits -= layout.endsAt;
    return layout;
}

using AstcEndsOfPartitions = std::array<AstcEnds, 4>;

/// "Data Size Determination": the finest range whose numbers fit. Nothing where the block is an error.
std::optional<AstcEndsOfPartitions> endsOf(BlockBits const& block, AstcLayout const& layout) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < layout.partitions; ++i) count += endCountOf(layout.modes[i]);
    if (count > kMaxAstcEnds) return std::nullopt;
    auto range = static_cast<uint32_t>(kAstcRanges.size() - 1);
    while (range >= kAstcRangeOf6 && astcSequenceBits(kAstcRanges[range], count) > layout.endsBits) --range;
    if (range < kAstcRangeOf6) return std::nullopt;
    std::array<uint8_t, kMaxAstcEnds> numbers{};
    const uint32_t bits = astcSequenceBits(kAstcRanges[range], count);
    takeAstcSequence(kAstcRanges[range], block.from(layout.endsAt).firstOf(bits), std::span(numbers).first(count));
    std::array<uint8_t, 256> const& colors = astcColorsOf(range);
    for (uint8_t& number : numbers) number = colors[number];
    AstcEndsOfPartitions ends{};
    const uint8_t* at = numbers.data();
    for (uint32_t i = 0; i < layout.partitions; at += endCountOf(layout.modes[i++]))
        ends[i] = astcEnds(layout.modes[i], at);
    return ends;
}

/// Weights of the texels, one plane.
class AstcWeights {
public:
    AstcWeights(BlockBits const& block, AstcGrid const& grid) : mGrid(grid), mPlanes(grid.hasTwoPlanes ? 2 : 1) {
        const AstcRange range = kAstcRanges[grid.range];
        std::array<uint8_t, kMaxAstcWeights> numbers{};
        takeAstcSequence(range, block.reversed().firstOf(astcSequenceBits(range, grid.weights())),
                         std::span(numbers).first(grid.weights()));
        std::array<uint8_t, 32> const& weights = astcWeightsOf(grid.range);
        for (size_t i = 0; i < numbers.size(); ++i) mWeights[i] = weights[numbers[i]];
    }

    /// "Weight Infill": between the four nearest points of the grid; `atX` and `atY` are in 16ths of its cells.
    uint32_t at(uint32_t atX, uint32_t atY, uint32_t plane) const {
        const uint32_t fx = atX & 15, fy = atY & 15, both = (fx * fy + 8) >> 4;
        const uint32_t point = (atX >> 4) + (atY >> 4) * mGrid.width;
        const uint32_t sum = of(point, plane) * (16 - fx - fy + both) + of(point + 1, plane) * (fx - both) +
                             of(point + mGrid.width, plane) * (fy - both) + of(point + mGrid.width + 1, plane) * both;
        return (sum + 8) >> 4;
    }

private:
    uint32_t of(uint32_t point, uint32_t plane) const { return mWeights[point * mPlanes + plane]; }

    AstcGrid mGrid;
    uint32_t mPlanes;
    std::array<uint8_t, kMaxAstcWeights + 32> mWeights{}; // behind the grid are zeros, whose share is 0
};

/// Positions of texels in the grid of weights, in 16ths of its cells.
std::array<uint32_t, 12> positionsIn(uint32_t points, uint32_t texels) {
    const uint32_t step = (1024 + texels / 2) / (texels - 1);
    std::array<uint32_t, 12> positions{};
    for (uint32_t i = 0; i < texels; ++i) positions[i] = (step * i * (points - 1) + 32) >> 6;
    return positions;
}

} // namespace

void decodeAstc(const std::byte* bytes, uint32_t blockWidth, uint32_t blockHeight, bool isSrgb, Texel8* texels) {
    const BlockBits block(bytes);
    const auto fill = [&](Texel8 texel) { std::fill_n(texels, blockWidth * blockHeight, texel); };
    if (block.at(0, 9) == 0x1FC) return fill(constantColor(block).value_or(kAstcError));
    const std::optional<AstcLayout> layout = layoutOf(block, blockWidth, blockHeight);
    if (!layout) return fill(kAstcError);
    const std::optional<AstcEndsOfPartitions> ends = endsOf(block, *layout);
    if (!ends) return fill(kAstcError);
    const AstcWeights weights(block, layout->grid);
    const auto columns = positionsIn(layout->grid.width, blockWidth),
               rows = positionsIn(layout->grid.height, blockHeight);
    const AstcPartition partition(std::max(layout->partitions, 2u), layout->seed, blockWidth * blockHeight < 31);
    for (uint32_t y = 0; y < blockHeight; ++y) {
        for (uint32_t x = 0; x < blockWidth; ++x) {
            Texel8& texel = texels[y * blockWidth + x];
            const uint32_t part = layout->partitions == 1 ? 0 : partition.at(x, y);
            if (isHdrMode(layout->modes[part])) {
                texel = kAstcError; // an error of these texels alone
                continue;
            }
            std::array<uint32_t, 4> shares;
            shares.fill(weights.at(columns[x], rows[y], 0));
            if (layout->planeChannel < 4) shares[layout->planeChannel] = weights.at(columns[x], rows[y], 1);
            texel = astcTexel((*ends)[part], shares, isSrgb);
        }
    }
}

} // namespace filament_core::assets::blocks
