// SPDX-License-Identifier: Apache-2.0
/// ExrBlock: OpenEXR stores some rows of an image, or a tile, as one block, each compressed on its own. Private to
/// this folder.
///   Out     whole rows; a row has all samples of its first channel, then all of the second, ...
///   Fails   false if the packed bytes are not exactly such a block.
///   Memory  a few times that of the block, whatever the packed bytes say.
///   Thread  any.
///   Bits    the same on every CPU, also of what is lossy (DWAA, DWAB), which OpenEXR's own library does not promise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace filament_core::assets {

/// As in files.
enum class ExrCompression : uint8_t { None, Rle, Zips, Zip, Piz, Pxr24, B44, B44a, Dwaa, Dwab, Count };
enum class ExrType : uint32_t { Uint, Half, Float };

struct ExrChannel {
    std::string name;
    ExrType type = ExrType::Half;
    bool isPerceptual = false; ///< "pLinear": B44 and DWA treat its values as evenly spaced to the eye
    size_t bytes() const { return type == ExrType::Half ? 2 : 4; }
};

struct ExrBlock {
    std::span<const ExrChannel> channels; ///< alphabetical, as in files
    size_t width = 0, rows = 0;

    size_t rowBytes() const;
    size_t bytes() const { return rowBytes() * rows; }
};

/// `out`: block.bytes() of them.
bool unpackExrBlock(ExrCompression compression, ExrBlock const& block, std::span<const std::byte> packed,
                    std::span<std::byte> out);

// ---------------------------------------------------------------------------------------------- parts of it

bool expandPiz(ExrBlock const& block, std::span<const std::byte> packed, std::span<std::byte> out);
bool expandDwa(ExrBlock const& block, std::span<const std::byte> packed, std::span<std::byte> out);

/// Huffman-coded words, of which there must be exactly so many.
bool expandHuffman(std::span<const std::byte> packed, std::span<uint16_t> words);
/// The same for run lengths.
bool expandRuns(std::span<const std::byte> packed, std::span<std::byte> out);
/// RLE and ZIP store differences between neighbours, even bytes before odd ones.
void undoPredictor(std::span<std::byte> bytes);

} // namespace filament_core::assets
