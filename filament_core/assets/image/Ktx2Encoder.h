// SPDX-License-Identifier: Apache-2.0
/// encodeKtx2: an image as a KTX 2.0 file with its texels as they are. KTX File Format Specification 2.0; the data
/// format descriptor is that of the Khronos Data Format Specification 1.3, chapter 5.
///   In      an image (one layer) or a cube (six), with any number of levels; R8, RGBA8 (data), RGBA8Srgb, RGBA16F,
///           RGBA32F, R11G11B10F, RGB9E5, or blocks of BC4 and BC6HUfloat. Other shapes and formats are bugs of the
///           caller.
///   Out     the file; the same bytes for the same input. readKtx2() finds every level and pair as it was given.
///   Thread  any; pure.  Memory: the file.  Fails: never.
#pragma once

#include "filament_core/assets/image/Image.h"
#include "filament_core/assets/image/Ktx2File.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::assets {

/// A pair of a text; its value ends with a zero, as the specification wants. Both must outlive the result.
Ktx2Value ktx2Text(std::string_view key, const char* text);

/// `values` in any order; keys differ. KTXorientation is added.
std::vector<std::byte> encodeKtx2(Image const& image, std::span<const Ktx2Value> values = {});

/// The format that encodeKtx2() writes as this VkFormat; nothing for others.
std::optional<backend::Format> formatOfVkFormat(uint32_t vkFormat);

} // namespace filament_core::assets
