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
    { [](MaterialDefinition const& d) { return d.package.reflections == Reflections::ScreenSpace; }, "reflections",
      "reflection of the picture" },
    // The pipelines draw each object once.
    { [](MaterialDefinition const& d) { return d.package.transparency != TransparencyMode::Default; }, "transparency",
      "transparency in two passes" },
    // Vulkan takes the first vertex of a triangle and OpenGL ES the last.
    { [](MaterialDefinition const& d) { return d.package.interpolation == Interpolation::Flat; }, "interpolation",
      "flat interpolation" },
    { [](MaterialDefinition const& d) { return d.package.instanced; }, "instanced", "getInstanceIndex()" },
    { [](MaterialDefinition const& d) { return d.package.shadowMultiplier; }, "shadowMultiplier", "a shadow" },
    { [](MaterialDefinition const& d) { return d.customSurfaceShading; }, "customSurfaceShading",
      "customSurfaceShading" },
    { [](MaterialDefinition const& d) {
         return std::ranges::count(d.package.parameters, SamplerFormat::Int, &Parameter::format) > 0;
     },
      "parameters", "a sampler of format int" },
};

} // namespace

Result<void> checkShaderText(MaterialDefinition const& definition) {
    const auto gap = std::ranges::find_if(kGaps, [&](Gap const& at) { return at.isAskedFor(definition); });
    if (gap == std::end(kGaps)) return {};
    return definition.errorAbout(gap->property, fmt::format("{} is known but not supported by this version", gap->what),
                                 ErrorCode::Unsupported);
}

} // namespace filament::shader
