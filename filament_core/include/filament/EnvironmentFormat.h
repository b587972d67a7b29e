// SPDX-License-Identifier: Apache-2.0
/// Names of the formats that can store the light of an environment.
#pragma once

#include <filament/Format.h>

#include <optional>
#include <string_view>

namespace filament {

/// "RGBA16F", "R11G11B10F", "RGB9E5" or "RGBM" (which is stored as RGBA8).
const char* environmentFormatName(Format format);
std::optional<Format> environmentFormatFromName(std::string_view name);

} // namespace filament
