// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/IgnoredNames.h"

#include "shaders/compiler/PropertyReader.h"

#include <algorithm>
#include <array>
#include <utility>

namespace filament_core::shader {
namespace {

using JsonKind = JsonValue::Kind;

constexpr std::array kIgnored{
    IgnoredName{ "property", "apiLevel", JsonKind::Number, "1", "there is one level of functions" },
    IgnoredName{ "property", "coloredPenumbra", JsonKind::Bool, "false",
                 "the edge of a shadow has the colour of its light" },
    IgnoredName{ "property", "defines", std::nullopt, "",
                 "macros are given with `matc -D NAME=VALUE`, or by `#define` in a block" },
    IgnoredName{ "property", "framebufferFetch", JsonKind::Bool, "false",
                 "a parameter with `currentPixel : true` reads the pixel that is written" },
    IgnoredName{ "property", "legacyMorphing", JsonKind::Bool, "false",
                 "morph targets are those of the renderable, any number of them" },
    IgnoredName{ "property", "linearFog", JsonKind::Bool, "false", "fog is that of the view for all materials" },
    IgnoredName{ "property", "shadowFarAttenuation", JsonKind::Bool, "false",
                 "shadows of the sun do not fade with the distance from the camera" },
    IgnoredName{ "property", "stereoscopicEyeCount", JsonKind::Number, "1", "a view has one eye" },
    IgnoredName{ "property", "stereoscopicType", JsonKind::String, "none", "a view has one eye" },
    IgnoredName{ "parameter", "stages", std::nullopt, "", "both blocks can read every parameter" },
    IgnoredName{ "constant", "mutable", JsonKind::Bool, "false",
                 "constants are set when the material is loaded; load it once for each value" },
};

constexpr std::pair<std::string_view, std::string_view> kRefused[] = {
    { "buffers", "materials have no storage buffers; use parameters that are arrays, or a texture" },
    { "groupSize", "there are no materials of compute stages" },
    { "subpasses", "declare it as a parameter of the type subpassInput" },
};

std::string shownName(IgnoredName const& ignored) {
    const bool isProperty = ignored.of == "property";
    return isProperty ? fmt::format("property '{}'", ignored.name)
                      : fmt::format("field '{}' of a {}", ignored.name, ignored.of);
}

} // namespace

std::span<const IgnoredName> ignoredNames() { return kIgnored; }

Result<bool> ignores(std::string_view of, std::string_view name, JsonValue const& value,
                     std::vector<std::string>& warnings) {
    const auto known =
            std::ranges::find_if(kIgnored, [&](IgnoredName const& each) { return each.of == of && each.name == name; });
    if (known == kIgnored.end()) return false;
    if (known->kind) {
        if (Result<void> isKind = expectKind(value, *known->kind, name); !isKind) return isKind.error();
    }
    if (known->asItIs.empty() || !equalIgnoringCase(value.text, known->asItIs))
        warnings.push_back(
                errorAt(value.at, fmt::format("the {} has no effect: {}", shownName(*known), known->reason)).message);
    return true;
}

std::string_view reasonAgainst(std::string_view property) {
    const auto known = std::ranges::find(kRefused, property, [](auto const& each) { return each.first; });
    return known == std::end(kRefused) ? std::string_view{} : known->second;
}

} // namespace filament_core::shader
