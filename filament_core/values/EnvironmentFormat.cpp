// SPDX-License-Identifier: Apache-2.0
#include <filament/EnvironmentFormat.h>

#include "base/Assert.h"

#include <algorithm>
#include <utility>

namespace filament {
namespace {

using NamedFormat = std::pair<std::string_view, Format>;
constexpr NamedFormat kFormats[] = { { "RGBA16F", Format::RGBA16F },
                                     { "R11G11B10F", Format::R11G11B10F },
                                     { "RGB9E5", Format::RGB9E5 },
                                     { "RGBM", Format::RGBA8 } };

} // namespace

const char* environmentFormatName(Format format) {
    const auto found = std::ranges::find(kFormats, format, &NamedFormat::second);
    FILAMENT_ASSERT(found != std::end(kFormats), "an environment is stored as RGBA16F, R11G11B10F, RGB9E5 or RGBM");
    return found->first.data();
}

std::optional<Format> environmentFormatFromName(std::string_view name) {
    const auto found = std::ranges::find(kFormats, name, &NamedFormat::first);
    return found == std::end(kFormats) ? std::nullopt : std::optional(found->second);
}

} // namespace filament
