// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/DefinitionRules.h"

#include "shaders/compiler/FeatureLevels.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>

namespace filament::shader {
namespace {

bool blends(Blending blending) { return blending != Blending::Opaque && blending != Blending::Masked; }
bool isUnlit(MaterialDefinition const& definition) { return definition.package.shading == ShadingModel::Unlit; }
bool refracts(MaterialDefinition const& definition) {
    return definition.package.refractionMode != RefractionMode::None;
}
/// The models of surface/lit_shading.glsl.
bool hasStandardText(MaterialDefinition const& definition) {
    const ShadingModel model = definition.package.shading;
    return model == ShadingModel::Lit || model == ShadingModel::SpecularGlossiness;
}
bool isPost(MaterialDefinition const& definition) { return definition.package.domain == MaterialDomain::PostProcess; }
bool hasTwoPasses(MaterialDefinition const& definition) {
    return definition.package.transparency != TransparencyMode::Default;
}

/// What must not be so, the property that is to blame, and what to do about it.
struct Contradiction {
    bool (*isSo)(MaterialDefinition const&);
    std::string_view property;
    const char* message;
};

constexpr Contradiction kContradictions[] = {
    { [](MaterialDefinition const& d) { return isPost(d) && !isUnlit(d); }, "shadingModel",
      "a material of the domain postprocess cannot be lit" },
    { [](MaterialDefinition const& d) { return isPost(d) && d.vertex.has_value(); }, "domain",
      "a material of the domain postprocess has no vertex block" },
    { [](MaterialDefinition const& d) { return isPost(d) && (d.requiredAttributes != 0 || !d.variables.empty()); },
      "domain", "a material of the domain postprocess reads no attributes and has no variables" },
    { [](MaterialDefinition const& d) { return d.halfPrecision && !hasStandardText(d); }, "halfPrecision",
      "halfPrecision is for lit materials and specularGlossiness: nothing else is computed in 16 bits" },
    { [](MaterialDefinition const& d) {
         return d.fullScreenTriangle && d.package.vertexDomain != VertexDomain::Device;
     },
      "fullScreenTriangle", "fullScreenTriangle needs vertexDomain : device" },
    { [](MaterialDefinition const& d) { return d.package.instanced && d.fullScreenTriangle; }, "instanced",
      "a full-screen triangle has no instances; leave out instanced" },
    { [](MaterialDefinition const& d) {
         return d.find("blendFunction") != nullptr && d.package.blending != Blending::Custom;
     },
      "blendFunction", "blendFunction is only read with blending : custom; set that, or leave the function out" },
    { [](MaterialDefinition const& d) {
         return d.find("blendFunction") == nullptr && d.package.blending == Blending::Custom;
     },
      "blending", "blending : custom needs a blendFunction : { srcRGB : ..., srcA : ..., dstRGB : ..., dstA : ... }" },
    { [](MaterialDefinition const& d) { return hasTwoPasses(d) && !blends(d.package.blending); }, "transparency",
      "two passes are for what is blended; set a blending, for instance transparent" },
    { [](MaterialDefinition const& d) {
         return d.package.transparency == TransparencyMode::TwoPassesOneSide && !d.package.depthCulling;
     },
      "transparency", "twoPassesOneSide finds out what is nearest by the depth test; leave out depthCulling : false" },
    { [](MaterialDefinition const& d) { return hasTwoPasses(d) && refracts(d); }, "transparency",
      "two passes are for materials that do not refract; leave out transparency or refractionMode" },
    { [](MaterialDefinition const& d) { return refracts(d) && isUnlit(d); }, "refractionMode",
      "an unlit material refracts nothing; use shadingModel : lit" },
    { [](MaterialDefinition const& d) { return refracts(d) && d.package.shading == ShadingModel::Cloth; },
      "refractionMode", "the threads of cloth let light through without bending it; use shadingModel : lit" },
    { [](MaterialDefinition const& d) { return refracts(d) && d.package.shading == ShadingModel::Subsurface; },
      "refractionMode",
      "light below a subsurface material is scattered, and its thickness is a share; to refract, use shadingModel : "
      "lit" },
    { [](MaterialDefinition const& d) { return refracts(d) && blends(d.package.blending); }, "refractionMode",
      "what refracts is drawn opaque, because it shows what is behind it by itself; leave out blending" },
    { [](MaterialDefinition const& d) { return d.package.shadowMultiplier && !isUnlit(d); }, "shadowMultiplier",
      "shadowMultiplier is for shadingModel : unlit; lit materials receive shadows anyway" },
    { [](MaterialDefinition const& d) { return d.customSurfaceShading && d.package.shading != ShadingModel::Lit; },
      "customSurfaceShading", "customSurfaceShading works with shadingModel : lit only" },
    { [](MaterialDefinition const& d) {
         return d.find("clothDistribution") != nullptr && d.package.shading != ShadingModel::Cloth;
     },
      "clothDistribution", "clothDistribution is for shadingModel : cloth" },
    { [](MaterialDefinition const& d) { return d.package.reflections != Reflections::Default && isUnlit(d); },
      "reflections", "an unlit material reflects nothing; use shadingModel : lit" },
};

uint32_t texturesOfPass(MaterialPackage const& package) {
    const backend::BindGroupLayout pass = passGroupLayout(passKind(package.domain, package.shading));
    return static_cast<uint32_t>(std::count_if(
            pass.bindings.begin(), pass.bindings.begin() + pass.count,
            [](backend::BindingDesc const& binding) { return binding.type == backend::BindingType::SampledTexture; }));
}

/// Chapter 7 of the guide, without this engine's own limits.
uint32_t budgetOfLevel(MaterialDefinition const& definition) {
    MaterialPackage const& package = definition.package;
    if (package.featureLevel == 3) return 16;
    const bool readsScreen =
            package.refractionMode == RefractionMode::ScreenSpace || package.reflections == Reflections::ScreenSpace;
    const uint32_t fogTexture = (package.filteredVariants & kVariantFog) != 0 ? 1 : 0;
    return (isUnlit(definition) ? 12u : readsScreen ? 8u : 9u) + fogTexture;
}

Result<void> checkSamplers(MaterialDefinition const& definition) {
    const uint32_t budget = samplerBudget(definition);
    uint32_t count = 0;
    for (size_t i = 0; i < definition.package.parameters.size(); ++i) {
        Parameter const& parameter = definition.package.parameters[i];
        if (!isTexture(parameter.type) || ++count <= budget) continue;
        const char* const cure = definition.package.featureLevel < 3 ? "; a higher featureLevel allows more" : "";
        return errorAt(definition.parameterSources[i].at,
                       fmt::format("sampler '{}' is one too many: a material of this kind and featureLevel {} has at "
                                   "most {}{}",
                                   parameter.name, definition.package.featureLevel, budget, cure));
    }
    return {};
}

} // namespace

uint32_t samplerBudget(MaterialDefinition const& definition) {
    constexpr uint32_t kTexturesOfAStage = 16; // what both APIs offer to every fragment stage
    const uint32_t room = std::min(kTexturesOfAStage - texturesOfPass(definition.package),
                                   uint32_t{ backend::kMaxBindings } - 1); // the first is the block of parameters
    return std::min(room, budgetOfLevel(definition));
}

Result<void> checkRules(MaterialDefinition const& definition) {
    for (Contradiction const& contradiction : kContradictions) {
        if (contradiction.isSo(definition)) return definition.errorAbout(contradiction.property, contradiction.message);
    }
    if (Result<void> samplers = checkSamplers(definition); !samplers) return samplers;
    return checkFeatureLevel(definition);
}

} // namespace filament::shader
