// SPDX-License-Identifier: Apache-2.0
/// Ktx2File: what a KTX 2.0 file says about its texture, before anything is decoded. KTX File Format Specification 2.0.
///   In      the bytes of a file, untrusted; `name` is used in error messages.
///   Out     spans point into the bytes. Every range lies in the file, and every size is within the limits below.
///   Thread  any; pure.
///   Limits  two dimensions; 16384 a side; 2048 layers; 2^28 texels of the first level with its layers.
///   Fails   Corrupt or Unsupported: one line with the file, the field and the cure.
#pragma once

#include "base/Result.h"

#include <filament_core/Math.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::assets {

enum class Ktx2Compression : uint32_t { None, BasisLz, Zstandard, Zlib };

/// The part of the data format descriptor that a reader needs. Khronos Data Format Specification 1.3, chapter 5.
struct Ktx2Description {
    static constexpr uint8_t kEtc1s = 163, kUastc = 166; ///< colour models
    static constexpr uint8_t kLinear = 1, kSrgb = 2;     ///< transfer functions
    uint8_t model = 0, transfer = kLinear;
    bool isPremultiplied = false;
    std::vector<uint8_t> channels; ///< what each sample is: numbers of the colour model
};

struct Ktx2Level {
    std::span<const std::byte> bytes;
    uint64_t plainBytes = 0; ///< when decompressed, as the file says
};

/// One of the key/value pairs of a file. The text of the key lies in the file, without its final zero.
struct Ktx2Value {
    std::string_view key;
    std::span<const std::byte> value; ///< of texts with their final zero
};

struct Ktx2File {
    uint32_t format = 0; ///< VkFormat; 0: Description::model says
    uint32_t width = 0, height = 0;
    uint32_t layers = 1; ///< images of a level: elements of an array, times 6 for cubes
    bool isCube = false, isArray = false;
    Ktx2Compression compression = Ktx2Compression::None;
    Ktx2Description description;
    std::vector<Ktx2Level> levels; ///< the largest first
    std::span<const std::byte> globalData;
    std::array<char, 4> swizzle{ 'r', 'g', 'b', 'a' }; ///< r, g, b, a, 0 or 1 for each channel
    bool isFlippedX = false, isFlippedY = false;       ///< the first texel is at the right, at the bottom
    std::vector<Ktx2Value> values;                     ///< all of them, in the order of the file

    /// The bytes of the first pair with this key; nothing if there is none.
    std::optional<std::span<const std::byte>> value(std::string_view key) const;
};

bool isKtx2(std::span<const std::byte> bytes);
/// As its header says; {0, 0} if there is none.
uint2 ktx2Size(std::span<const std::byte> bytes);

Result<Ktx2File> readKtx2(std::span<const std::byte> bytes, std::string_view name);

} // namespace filament_core::assets
