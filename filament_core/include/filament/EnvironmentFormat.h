// SPDX-License-Identifier: Apache-2.0
/// The formats in which the light of an environment may be stored, by name.
#pragma once

#include <filament/Format.h>

#include <optional>
#include <string_view>

namespace filament {

/// "RGBA16F", "R11G11B10F", "RGB9E5" and "RGBM", which is RGBA8: the formats of an environment.
const char* environmentFormatName(Format format);
std::optional<Format> environmentFormatFromName(std::string_view name);

} // namespace filament
