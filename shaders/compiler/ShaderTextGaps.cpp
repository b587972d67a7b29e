// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/ShaderTextGaps.h"

#include <algorithm>

namespace filament::shader {
namespace {

struct Gap {
    bool (*isAskedFor)(MaterialDefinition const&);
    std::string_view property;
    std::string_view what;
};

constexpr Gap kGaps[] = {
    { [](MaterialDefinition const& d) { return d.package.shading == ShadingModel::Subsurface; }, "shadingModel",
      "the shading model subsurface" },
    { [](MaterialDefinition const& d) { return d.package.shading == ShadingModel::Cloth; }, "shadingModel",
      "the shading model cloth" },
    { [](MaterialDefinition const& d) { return d.package.refractionMode != RefractionMode::None; }, "refractionMode",
      "refraction" },
    { [](MaterialDefinition const& d) { return d.customSurfaceShading; }, "customSurfaceShading",
      "customSurfaceShading" },
};

} // namespace

Result<void> checkShaderText(MaterialDefinition const& definition) {
    const auto gap = std::ranges::find_if(kGaps, [&](Gap const& at) { return at.isAskedFor(definition); });
    if (gap == std::end(kGaps)) return {};
    return definition.errorAbout(gap->property, fmt::format("{} is known but not supported by this version", gap->what),
                                 ErrorCode::Unsupported);
}

} // namespace filament::shader
