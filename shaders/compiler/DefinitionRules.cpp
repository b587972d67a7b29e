// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/DefinitionRules.h"

#include "shaders/compiler/FeatureLevels.h"
#include "shaders/compiler/GlslSuggestions.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>

namespace filament_core::shader {
namespace {

/// Fading scales all light, so alpha can say how much of a refracting surface is there.
bool blendsRefraction(Blending blending) { return blends(blending) && blending != Blending::Fade; }
bool isUnlit(MaterialDefinition const& definition) { return definition.package.shading == ShadingModel::Unlit; }
/// The models of surface/lit_shading.glsl.
bool hasStandardText(MaterialDefinition const& definition) {
    const ShadingModel model = definition.package.shading;
    return model == ShadingModel::Lit || model == ShadingModel::SpecularGlossiness;
}
bool isPost(MaterialDefinition const& definition) { return definition.package.domain == MaterialDomain::PostProcess; }
bool isSurfaceWithOutputs(MaterialDefinition const& definition) {
    return !isPost(definition) && !definition.outputs.empty();
}
bool hasOutputNamedAsMember(MaterialDefinition const& definition) {
    return std::ranges::any_of(definition.outputs, [&](EffectOutput const& output) {
        return std::ranges::any_of(materialMembers(), [&](MaterialMember const& member) {
            return member.name == output.name && member.isMemberOf(definition);
        });
    });
}
bool hasTwoPasses(MaterialDefinition const& definition) {
    return definition.package.transparency != TransparencyMode::Default;
}

/// A condition that must not hold, the property at fault, and the remedy.
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
    { [](MaterialDefinition const& d) { return isSurfaceWithOutputs(d) && !isUnlit(d); }, "outputs",
      "outputs are for the domain postprocess and for surfaces without light; say shadingModel : unlit, and draw them "
      "by a mesh pass" },
    { [](MaterialDefinition const& d) {
         return isSurfaceWithOutputs(d) && std::ranges::any_of(d.outputs, &EffectOutput::isDepth);
     },
      "outputs", "the depth of a surface is that of its geometry; set pixelDepthOffset to move it" },
    { [](MaterialDefinition const& d) {
         return isSurfaceWithOutputs(d) &&
                std::ranges::none_of(d.outputs, [](EffectOutput const& output) { return output.location == 0; });
     },
      "outputs", "one of the outputs of a surface has location 0" },
    { [](MaterialDefinition const& d) { return isSurfaceWithOutputs(d) && hasOutputNamedAsMember(d); }, "outputs",
      "MaterialInputs has a member with the name of an output; give it another" },
    { [](MaterialDefinition const& d) { return d.halfPrecision && !hasStandardText(d); }, "halfPrecision",
      "halfPrecision is only for lit materials and specularGlossiness: no others are computed in 16 bits" },
    { [](MaterialDefinition const& d) {
         return d.fullScreenTriangle && d.package.vertexDomain != VertexDomain::Device;
     },
      "fullScreenTriangle", "fullScreenTriangle needs vertexDomain : device" },
    { [](MaterialDefinition const& d) { return d.package.instanced && d.fullScreenTriangle; }, "instanced",
      "a full-screen triangle has no instances; leave out instanced" },
    { [](MaterialDefinition const& d) { return d.wideLines && !d.needsAttribute(kAttributeCustom0); }, "wideLines",
      "wideLines finds the other end of a segment in custom0; add requires : [ custom0 ], and make the mesh with "
      "makeLineQuads() of <filament_core/Lines.h>" },
    { [](MaterialDefinition const& d) { return d.wideLines && d.package.vertexDomain == VertexDomain::Device; },
      "wideLines", "wideLines needs positions in space; leave out vertexDomain : device" },
    { [](MaterialDefinition const& d) { return d.sizedPoints && d.package.vertexDomain == VertexDomain::Device; },
      "sizedPoints", "sizedPoints needs positions in space; leave out vertexDomain : device" },
    { [](MaterialDefinition const& d) { return d.sizedPoints && d.wideLines; }, "sizedPoints",
      "a mesh holds points or lines; leave out sizedPoints or wideLines" },
    { [](MaterialDefinition const& d) { return d.package.sectionPlanes && isPost(d); }, "sectionPlanes",
      "section planes cut surfaces of the scene; leave out domain : postprocess" },
    { [](MaterialDefinition const& d) {
         return d.package.sectionPlanes &&
                (d.package.vertexDomain == VertexDomain::View || d.package.vertexDomain == VertexDomain::Device);
     },
      "sectionPlanes", "section planes are in the world; leave out vertexDomain, or set object or world" },
    { [](MaterialDefinition const& d) {
         return d.find("blendFunction") != nullptr && d.package.blending != Blending::Custom;
     },
      "blendFunction", "blendFunction is only read with blending : custom; set that, or leave the function out" },
    { [](MaterialDefinition const& d) {
         return d.find("blendFunction") == nullptr && d.package.blending == Blending::Custom;
     },
      "blending", "blending : custom needs a blendFunction : { srcRGB : ..., srcA : ..., dstRGB : ..., dstA : ... }" },
    { [](MaterialDefinition const& d) { return hasTwoPasses(d) && !blends(d.package.blending); }, "transparency",
      "two passes need a blended material; set a blending, for instance transparent" },
    { [](MaterialDefinition const& d) {
         return d.package.transparency == TransparencyMode::TwoPassesOneSide && !d.package.depthCulling;
     },
      "transparency",
      "twoPassesOneSide needs the depth test to find the nearest surface; leave out depthCulling : false" },
    { [](MaterialDefinition const& d) { return hasTwoPasses(d) && refracts(d); }, "transparency",
      "two passes are for materials that do not refract; leave out transparency or refractionMode" },
    { [](MaterialDefinition const& d) { return refracts(d) && isUnlit(d); }, "refractionMode",
      "an unlit material cannot refract; use shadingModel : lit" },
    { [](MaterialDefinition const& d) { return refracts(d) && d.package.shading == ShadingModel::Cloth; },
      "refractionMode", "cloth lets light through without refraction; use shadingModel : lit" },
    { [](MaterialDefinition const& d) { return refracts(d) && d.package.shading == ShadingModel::Subsurface; },
      "refractionMode",
      "a subsurface material scatters light, and its thickness is a fraction; to refract, use shadingModel : "
      "lit" },
    { [](MaterialDefinition const& d) { return refracts(d) && blendsRefraction(d.package.blending); }, "refractionMode",
      "a refracting material shows the background itself; leave out blending, or set blending : fade where alpha is "
      "coverage" },
    { [](MaterialDefinition const& d) {
         return d.package.shadowMultiplier && !isUnlit(d) && d.package.shading != ShadingModel::Lit;
     },
      "shadowMultiplier", "shadowMultiplier is for shadingModel : unlit or lit" },
    { [](MaterialDefinition const& d) {
         return d.package.shadowMultiplier && !isUnlit(d) && d.package.blending != Blending::Transparent;
     },
      "shadowMultiplier", "a lit surface that only shows shadows is transparent; set blending : transparent" },
    { [](MaterialDefinition const& d) { return d.package.shadowMultiplier && (d.customSurfaceShading || refracts(d)); },
      "shadowMultiplier",
      "the shares of shadows are those of the standard model; leave out customSurfaceShading and refractionMode" },
    { [](MaterialDefinition const& d) { return d.customSurfaceShading && d.package.shading != ShadingModel::Lit; },
      "customSurfaceShading", "customSurfaceShading works with shadingModel : lit only" },
    { [](MaterialDefinition const& d) {
         return d.find("clothDistribution") != nullptr && d.package.shading != ShadingModel::Cloth;
     },
      "clothDistribution", "clothDistribution is for shadingModel : cloth" },
};

bool hasFog(MaterialPackage const& package) { return (package.filteredVariants & kVariantFog) == 0; }

/// Chapter 7 of the guide. The first binding of a group is the block of parameters.
uint32_t budgetOfLevel(MaterialPackage const& package) {
    if (package.featureLevel == 3) return uint32_t{ backend::kMaxBindings } - 1;
    const uint32_t guaranteed = package.shading == ShadingModel::Unlit ? 12u : readsScreen(package) ? 8u : 9u;
    return guaranteed + (hasFog(package) ? 0 : 1);
}

/// "7 are the engine's: environment, lighting tables, ..."
std::string engineShare(MaterialPackage const& package) {
    const PassKind kind = passKind(package);
    const uint32_t count = samplersOfEngine(kind, hasFog(package));
    std::string names;
    for (EngineTexture const& texture : kEngineTextures) {
        if (!isReadBy(texture, kind) || (!hasFog(package) && (texture.readers & kReadForFog) != 0)) continue;
        names += fmt::format("{}{}", names.empty() ? ": " : ", ", texture.name);
    }
    return fmt::format("{} are the engine's{}", count, names);
}

Result<void> checkSamplers(MaterialDefinition const& definition) {
    MaterialPackage const& package = definition.package;
    const uint32_t budget = samplerBudget(definition);
    uint32_t count = 0;
    for (size_t i = 0; i < package.parameters.size(); ++i) {
        Parameter const& parameter = package.parameters[i];
        if (!isTexture(parameter.type)) continue;
        count += definition.parameterSources[i].isExternal ? 2 : 1;
        if (count <= budget) continue;
        const std::string why =
                package.featureLevel < 3
                        ? fmt::format("every device has {} a stage, of which {}; featureLevel : 3 allows more, where a "
                                      "device has more",
                                      kSamplersOfEveryDevice, engineShare(package))
                        : "a bind group holds no more";
        return errorAt(definition.parameterSources[i].at,
                       fmt::format("sampler '{}' is one too many: a material of this kind and featureLevel {} has at "
                                   "most {}; {}",
                                   parameter.name, package.featureLevel, budget, why));
    }
    return {};
}

} // namespace

uint32_t samplerBudget(MaterialDefinition const& definition) { return budgetOfLevel(definition.package); }

void leaveOutReflections(MaterialDefinition& definition) {
    MaterialPackage& package = definition.package;
    const bool isMirror = package.shading == ShadingModel::Lit || package.shading == ShadingModel::SpecularGlossiness;
    if (package.reflections == Reflections::Default || isMirror) return;
    package.reflections = Reflections::Default;
    definition.warnings.push_back(
            definition.errorAbout("reflections", "this shadingModel mirrors nothing: reflections has no effect")
                    .message);
}

Result<void> checkRules(MaterialDefinition const& definition) {
    std::vector<Error> errors;
    for (Contradiction const& contradiction : kContradictions) {
        if (contradiction.isSo(definition))
            errors.push_back(definition.errorAbout(contradiction.property, contradiction.message));
    }
    for (Result<void> const& checked : { checkSamplers(definition), checkFeatureLevel(definition) }) {
        if (!checked) errors.push_back(checked.error());
    }
    if (!errors.empty()) return joined(errors);
    return {};
}

} // namespace filament_core::shader
