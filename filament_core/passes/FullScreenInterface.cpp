// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FullScreenInterface.h"

#include "base/Suggest.h"

#include <algorithm>

namespace filament_core::passes {
namespace {

using shader::Parameter;

Result<void> checkGiven(scene::Material const& material, std::string_view pass, FullScreenParameter const& given,
                        bool isInput) {
    Parameter const* parameter = material.package.findParameter(given.name);
    const char* const what = isInput ? "input" : "value";
    if (!parameter || shader::isTexture(parameter->type) != isInput) {
        return fail(ErrorCode::NotFound, "material '{}' has no {} '{}', which pass '{}' gives it{}", material.name,
                    what, given.name, pass, suggestion(given.name, namesOf(material.package.parameters)));
    }
    if (isInput || (parameter->type == given.type && parameter->arraySize == 0)) return {};
    return fail(ErrorCode::InvalidArgument, "material '{}': value '{}' is {}{}, but pass '{}' gives {}", material.name,
                given.name, toString(parameter->type), parameter->arraySize > 0 ? "[]" : "", pass,
                toString(given.type));
}

Result<void> checkNeeded(scene::Material const& material, FullScreenInterface const& given,
                         Parameter const& parameter) {
    const bool isInput = shader::isTexture(parameter.type);
    if (isInput && !parameter.isBound) return {};
    if (parameter.type == ParameterType::SubpassInput) {
        return fail(ErrorCode::InvalidArgument,
                    "material '{}': input '{}' is a subpassInput, so pass '{}' cannot draw it unless it is merged; "
                    "make it type : sampler2d, currentPixel : true",
                    material.name, parameter.name, given.pass);
    }
    const bool isGiven = isInput ? std::ranges::count(given.inputs, parameter.name) > 0
                                 : std::ranges::count(given.values, parameter.name, &FullScreenParameter::name) > 0;
    if (isGiven) return {};
    return fail(ErrorCode::InvalidArgument, "material '{}' has the {} '{}', which pass '{}' does not give it",
                material.name, isInput ? "input" : "value", parameter.name, given.pass);
}

} // namespace

Result<void> checkFullScreenMaterial(scene::Material const& material, FullScreenInterface const& given) {
    if (material.package.domain != shader::MaterialDomain::PostProcess) {
        return fail(ErrorCode::InvalidArgument,
                    "material '{}' is of domain surface, and pass '{}' draws a picture; say domain : postprocess in it",
                    material.name, given.pass);
    }
    for (const std::string_view name : given.inputs) {
        if (Result<void> exists = checkGiven(material, given.pass, { name }, true); !exists) return exists;
    }
    for (FullScreenParameter const& value : given.values) {
        if (Result<void> exists = checkGiven(material, given.pass, value, false); !exists) return exists;
    }
    for (Parameter const& parameter : material.package.parameters) {
        if (Result<void> isGiven = checkNeeded(material, given, parameter); !isGiven) return isGiven;
    }
    return {};
}

} // namespace filament_core::passes
