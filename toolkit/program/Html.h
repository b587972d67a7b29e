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

} // namespace filament_core::tools
