// SPDX-License-Identifier: Apache-2.0
/// BasisLz: textures of ETC1S blocks that share codebooks of ends and selectors, as KTX 2.0 files keep them. KTX 2.0
/// Specification, appendices "BasisLZ Global Data" and "BasisLZ/ETC1S Bitstream".
///   In      the supercompression global data of a file, and the bytes of a slice; both are untrusted.
///   Out     the texels of a slice: red, green, blue, and alpha 255.
///   Thread  read(): one. decodeSlice(): any.
///   Memory  6 bytes for each codebook entry, 2 for each block of two rows.
///   Limits  no video: images that refer to the one before are for the caller to refuse.
///   Fails   with a reason in plain words, without the name of the file: Corrupt.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/blocks/BasisBits.h"
#include "filament_core/assets/blocks/BlockTexels.h"

#include <span>
#include <vector>

namespace filament_core::assets::blocks {

/// Where the slices of an image lie in the bytes of its level.
struct BasisImage {
    uint32_t flags = 0;
    uint32_t colorOffset = 0, colorLength = 0;
    uint32_t alphaOffset = 0, alphaLength = 0; ///< 0: there is none

    bool refersToPrevious() const { return (flags & 2) != 0; }
};

class BasisLz {
public:
    static Result<BasisLz> read(std::span<const std::byte> globalData, uint32_t imageCount);

    std::span<const BasisImage> images() const { return mImages; }

    /// `texels` has width * height. What sticks out of the image is dropped.
    Result<void> decodeSlice(std::span<const std::byte> bytes, uint32_t width, uint32_t height,
                             std::span<Texel8> texels) const;

private:
    struct Ends {
        uint8_t r, g, b, table; ///< 5 bits each, 3 bits
    };

    Result<void> readEnds(std::span<const std::byte> bytes, uint32_t count);
    Result<void> readSelectors(std::span<const std::byte> bytes, uint32_t count);
    Result<void> readTables(std::span<const std::byte> bytes);
    friend class BasisSlice;

    std::vector<BasisImage> mImages;
    std::vector<Ends> mEnds;
    std::vector<uint32_t> mSelectors; ///< 2 bits for each texel, the first in the lowest ones
    BasisHuffman mPredictions, mEndDeltas, mSelectorCodes, mRuns;
    uint32_t mHistorySize = 0;
};

} // namespace filament_core::assets::blocks
