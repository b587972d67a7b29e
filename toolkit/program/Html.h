// SPDX-License-Identifier: Apache-2.0
/// Html: encodes text and bytes for an HTML page.
///   Thread  any; pure.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace filament_core::tools {

/// For text and for quoted attributes.
std::string escapedHtml(std::string_view text);
/// RFC 4648, section 4: for data: URLs.
std::string base64(std::span<const std::byte> bytes);
/// A PNG inside of the page, with its title below it. `name`: the class of the image, for style sheets.
std::string figureOfPng(std::span<const std::byte> png, std::string_view title, std::string_view name = {});

} // namespace filament_core::tools
