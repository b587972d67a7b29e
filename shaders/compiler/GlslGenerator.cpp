// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslGenerator.h"

#include "shaders/compiler/GlslDeclarations.h"
#include "shaders/compiler/MaterialAnalysis.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/compiler/StageText.h"
#include "shaders/compiler/Variants.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>
#include <initializer_list>

namespace filament_core::shader {
namespace {

const char* blendDefine(Blending blending) {
    static constexpr const char* kNames[] = { "BLEND_MODE_OPAQUE", "BLEND_MODE_MASKED", "BLEND_MODE_TRANSPARENT",
                                              "BLEND_MODE_FADE",   "BLEND_MODE_ADD",    "BLEND_MODE_MULTIPLY",
                                              "BLEND_MODE_SCREEN", "BLEND_MODE_CUSTOM" };
    return kNames[static_cast<size_t>(blending)];
}

const char* postLightingDefine(PostLightingBlending blending) {
    static constexpr const char* kNames[] = { "POST_LIGHTING_OPAQUE", "POST_LIGHTING_TRANSPARENT", "POST_LIGHTING_ADD",
                                              "POST_LIGHTING_MULTIPLY", "POST_LIGHTING_SCREEN" };
    return kNames[static_cast<size_t>(blending)];
}

const char* shadingDefine(ShadingModel model) {
    static constexpr const char* kNames[] = { "SHADING_MODEL_UNLIT", "SHADING_MODEL_LIT", "SHADING_MODEL_SUBSURFACE",
                                              "SHADING_MODEL_CLOTH", "SHADING_MODEL_SPECULAR_GLOSSINESS" };
    return kNames[static_cast<size_t>(model)];
}

/// The text that implements the interface of shading models (shaders/material/README.md).
std::string_view shadingText(ShadingModel model) {
    switch (model) {
    case ShadingModel::Cloth:
        return "shaders/material/surface/cloth_shading.glsl";
    case ShadingModel::Subsurface:
        return "shaders/material/surface/subsurface_shading.glsl";
    default:
        return "shaders/material/surface/lit_shading.glsl";
    }
}

const char* vertexDomainDefine(VertexDomain domain) {
    static constexpr const char* kNames[] = { "VERTEX_DOMAIN_OBJECT", "VERTEX_DOMAIN_WORLD", "VERTEX_DOMAIN_VIEW",
                                              "VERTEX_DOMAIN_DEVICE" };
    return kNames[static_cast<size_t>(domain)];
}

void defineIf(StageText& out, bool condition, std::string_view name) {
    if (condition) out.define(name);
}

Result<void> includeAll(StageText& out, std::initializer_list<std::string_view> paths) {
    for (const std::string_view path : paths) {
        if (Result<void> done = out.include(path); !done) return done;
    }
    return {};
}

StageText newStageText(MaterialNeeds const& needs, IncludeResolver const& includes) {
    return StageText(includes, &needs.prefixed);
}

/// Functions of AMD_shader_trinary_minmax, which glslang declares always and lets no one declare again.
constexpr std::string_view kUndeclarable[] = { "max3", "mid3", "min3" };

/// After the helpers that the author's names have hidden.
Result<void> authorsBlock(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs,
                          bool isFragment) {
    const auto& own = isFragment ? needs.fragmentDeclarations : needs.vertexDeclarations;
    declareTransforms(out, definition);
    std::string end;
    for (const std::string_view name : kUndeclarable) {
        const auto declared = std::ranges::find(own, name, &GlslDeclaration::name);
        if (declared == own.end() || declared->kind == GlslDeclaration::Kind::Macro) continue;
        out.asItIs(fmt::format("#define {0} author_{0}\n", name));
        end += fmt::format("#undef {}\n", name);
    }
    out.asItIs(restoredHelpers(needs.prefixed, own, isFragment && needs.colors));
    const size_t begin = out.text().size();
    Result<void> done = out.block(isFragment ? definition.fragment : *definition.vertex);
    for (ParameterSource const& source : definition.parameterSources) {
        if (!source.transformName.empty())
            out.rename(begin, "materialParams." + source.transformName, "materialParams_" + source.transformName);
    }
    out.asItIs(end);
    return done;
}

void beginStage(StageText& out, std::string_view varying) {
    out.line("#version 450");
    out.line("#extension GL_GOOGLE_cpp_style_line_directive : require");
    out.define("VARYING", varying);
}

/// Both stages must agree on these, because they decide which varyings exist.
void defineSurface(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs) {
    MaterialPackage const& package = definition.package;
    out.define(shadingDefine(package.shading));
    out.define(blendDefine(package.blending));
    out.define(vertexDomainDefine(package.vertexDomain));
    defineIf(out, package.vertexDomainDeviceJittered, "VERTEX_DOMAIN_DEVICE_JITTERED");
    defineIf(out, definition.flipUv, "FLIP_UV");
    defineIf(out, definition.fullScreenTriangle, "FULL_SCREEN_TRIANGLE");
    defineIf(out, definition.wideLines, "WIDE_LINES");
    defineIf(out, definition.sizedPoints, "SIZED_POINTS");
    const bool isSwitched = package.findParameter(kDoubleSidedParameter) != nullptr;
    defineIf(out, isSwitched, "DOUBLE_SIDED_BY_PARAMETER");
    defineIf(out, package.doubleSided && !isSwitched, "DOUBLE_SIDED");
    defineIf(out, package.instanced, "INSTANCED");
    defineIf(out, needs.instanceIndex, "NEEDS_INSTANCE_INDEX");
    out.define("INTERPOLATION", package.interpolation == Interpolation::Flat ? "flat" : "");
    defineIf(out, definition.needsAttribute(kAttributeColor), "HAS_COLOR");
    defineIf(out, definition.needsAttribute(kAttributeUv0), "HAS_UV0");
    defineIf(out, definition.needsAttribute(kAttributeUv1), "HAS_UV1");
    defineIf(out, needs.worldPosition, "NEEDS_WORLD_POSITION");
    defineIf(out, needs.normal, "NEEDS_NORMAL");
    defineIf(out, needs.tangent, "NEEDS_TANGENT");
    const auto members = materialMembers();
    for (size_t i = 0; i < members.size(); ++i) defineIf(out, (needs.terms & termBit(i)) != 0, members[i].term);
    defineIf(out, package.sectionPlanes, "HAS_SECTION_PLANES");
    defineIf(out, needs.clipSpaceTransform, "HAS_CLIP_SPACE_TRANSFORM");
    defineIf(out, needs.clipSpacePosition, "HAS_CLIP_SPACE_POSITION");
    defineIf(out, !needs.callsPrepare && package.shading != ShadingModel::Unlit, "PREPARE_AFTER_MATERIAL");
}

bool reflectsPicture(MaterialPackage const& package) { return package.reflections == Reflections::ScreenSpace; }

/// Whether some variant of the material has what the bit stands for.
bool mayHave(MaterialDefinition const& definition, VariantBit bit) {
    return (selectableBits(definition) & ~definition.package.filteredVariants & bit) != 0;
}

void defineFragment(StageText& out, MaterialDefinition const& definition, uint16_t variantKey) {
    defineIf(out, mayHave(definition, kVariantSun), "HAS_SUN");
    defineIf(out, mayHave(definition, kVariantPunctual), "HAS_LIGHT_LIST");
    defineIf(out, mayHave(definition, kVariantShadowReceiver), "RECEIVES_SHADOWS");
    defineIf(out, (variantKey & kVariantHalf) != 0, "HALF_PRECISION");
    defineIf(out, definition.package.quality == MaterialQuality::Low, "QUALITY_LOW");
    defineIf(out, definition.package.alphaToCoverage, "ALPHA_TO_COVERAGE");
    defineIf(out, definition.package.shadowMultiplier, "SHADOW_MULTIPLIER");
    out.define(postLightingDefine(definition.package.postLightingBlending));
    const bool isThin = definition.package.refractionType == RefractionType::Thin;
    defineIf(out, refracts(definition), "REFRACTION");
    defineIf(out, refracts(definition) && isThin, "REFRACTION_THIN");
    defineIf(out, definition.package.refractionMode == RefractionMode::ScreenSpace, "REFRACTION_OF_PICTURE");
    defineIf(out, reflectsPicture(definition.package), "REFLECTION_OF_PICTURE");
    defineIf(out, definition.customSurfaceShading, "CUSTOM_SURFACE_SHADING");
    defineIf(out, definition.clothDistribution == ClothDistribution::Ashikhmin, "CLOTH_ASHIKHMIN");
    defineIf(out, definition.specularAmbientOcclusion != SpecularAmbientOcclusion::None, "SPECULAR_AMBIENT_OCCLUSION");
    defineIf(out, definition.specularAmbientOcclusion == SpecularAmbientOcclusion::BentNormals,
             "SPECULAR_OCCLUSION_BENT_NORMALS");
    defineIf(out, definition.multiBounceAmbientOcclusion, "MULTI_BOUNCE_AMBIENT_OCCLUSION");
    defineIf(out, definition.clearCoatIorChange, "CLEAR_COAT_IOR_CHANGE");
    SpecularAntiAliasing const& antiAliasing = definition.specularAntiAliasing;
    if (!antiAliasing.enabled) return;
    out.define("SPECULAR_ANTI_ALIASING");
    out.define("SPECULAR_ANTI_ALIASING_VARIANCE", fmt::format("float({})", antiAliasing.variance));
    out.define("SPECULAR_ANTI_ALIASING_THRESHOLD", fmt::format("float({})", antiAliasing.threshold));
}

void declareCustomAttributes(StageText& out, MaterialDefinition const& definition) {
    for (uint32_t i = 0; i < 8; ++i) {
        if ((definition.requiredAttributes >> (kAttributeCustom0 + i) & 1) == 0) continue;
        out.line(fmt::format("layout(location = {}) in vec4 mesh_custom{};", kAttributeCustom0 + i, i));
        out.line(fmt::format("vec4 getCustom{0}() {{ return mesh_custom{0}; }}", i));
    }
}

/// Joints 5 to 8 take the places of two custom attributes; materials that use those have four joints per vertex.
void defineDeformation(StageText& out, MaterialDefinition const& definition) {
    out.define("VARIANT_SKINNING");
    const bool placesAreFree =
            !definition.needsAttribute(kAttributeJoints1) && !definition.needsAttribute(kAttributeWeights1);
    defineIf(out, placesAreFree, "EIGHT_JOINTS");
}

/// As many texels of a shadow map as the material is opaque.
bool castsThroughDither(MaterialDefinition const& definition) {
    const Blending blending = definition.package.blending;
    return definition.package.transparentShadow && blending != Blending::Opaque && blending != Blending::Masked;
}

/// Whether the author's code decides where a variant of depth alone leaves it.
bool shapesDepth(MaterialDefinition const& definition, MaterialNeeds const& needs) {
    return fragmentsDecideDepth(definition, needs) || transmitsLight(definition.package);
}

Result<std::string> surfaceVertex(MaterialDefinition const& definition, MaterialNeeds const& needs, uint16_t variantKey,
                                  IncludeResolver const& includes) {
    const bool deforms = (variantKey & kVariantSkinning) != 0;
    StageText out = newStageText(needs, includes);
    beginStage(out, "out");
    defineSurface(out, definition, needs);
    if (deforms) defineDeformation(out, definition);
    const bool isOfMotion = (variantKey & kVariantMotion) != 0;
    const bool isOfDepth = (variantKey & kVariantDepth) != 0 && !shapesDepth(definition, needs);
    defineIf(out, isOfMotion, "VARIANT_MOTION");
    defineIf(out, isOfDepth, "POSITION_ALONE");
    const bool hasBlock = definition.vertex.has_value() && !(isOfDepth && definition.useDefaultDepthVariant);
    defineIf(out, hasBlock, "HAS_MATERIAL_VERTEX");
    defineVariableMacros(out, definition);
    Result<void> done = includeAll(out, { "shaders/lib/math.glsl", "shaders/lib/tangent.glsl",
                                          "shaders/interface/interface.glsl", "shaders/material/api.glsl" });
    const bool hasVaryings = !isOfMotion && !isOfDepth;
    if (done && hasVaryings) done = out.include("shaders/material/varyings.glsl");
    if (!done) return done.error();
    declareInterface(out, definition);
    if (hasVaryings) {
        declareVariables(out, definition, needs);
        declareCustomVaryings(out, definition, needs);
    }
    declareCustomAttributes(out, definition);
    if (needs.words.contains("toTangentFrame")) done = out.include("shaders/material/tangents.glsl");
    if (done && deforms)
        done = includeAll(out, { "shaders/interface/deformation.glsl", "shaders/material/surface/deform.glsl" });
    if (done) done = out.include("shaders/material/surface/vertex_api.glsl");
    if (done && hasBlock) done = authorsBlock(out, definition, needs, false);
    if (done) done = out.include("shaders/material/surface/vertex_main.glsl");
    if (!done) return done.error();
    return std::move(out).take();
}

/// What a shading model includes if its material sets this term.
struct Layer {
    std::string_view term, text;
};
constexpr Layer kLayers[] = { { "HAS_ANISOTROPY", "shaders/material/surface/anisotropy.glsl" },
                              { "HAS_IRIDESCENCE", "shaders/material/surface/iridescence.glsl" },
                              { "HAS_SHEEN", "shaders/material/surface/sheen.glsl" },
                              { "HAS_CLEAR_COAT", "shaders/material/surface/coat.glsl" } };

Result<void> includeShadows(StageText& out, MaterialPackage const& package) {
    Result<void> done = out.include("shaders/lib/noise.glsl");
    if (done && (package.filteredVariants & kVariantVsm) == 0) {
        out.define("HAS_SHADOW_MOMENTS");
        done = out.include("shaders/lib/moments.glsl");
    }
    return done ? out.include("shaders/material/surface/shadows.glsl") : done;
}

/// How fog applies to what a material draws: shaders/material/surface/apply_fog.glsl.
const char* fogDefine(MaterialPackage const& package) {
    using backend::BlendFactor;
    BlendFunction const& custom = package.blendFunction;
    switch (package.blending) {
    case Blending::Opaque:
    case Blending::Masked:
        return "FOG_REPLACES";
    case Blending::Transparent:
    case Blending::Fade:
        return "FOG_COVERS";
    case Blending::Add:
    case Blending::Screen:
        return "FOG_ADDS";
    case Blending::Multiply:
        return "FOG_FILTERS";
    case Blending::Custom:
        if (custom.sourceColor == BlendFactor::Zero || custom.sourceColor == BlendFactor::DstColor)
            return "FOG_FILTERS";
        if (custom.targetColor == BlendFactor::One || custom.targetColor == BlendFactor::OneMinusSrcColor)
            return "FOG_ADDS";
        return custom.sourceColor == BlendFactor::SrcAlpha ? "FOG_REPLACES"
                                                           : "FOG_COVERS"; // SrcAlpha: the device weights
    }
    return "FOG_REPLACES";
}

/// Not in materials compiled without fog.
Result<void> includeFog(StageText& out, MaterialPackage const& package) {
    if ((package.filteredVariants & kVariantFog) != 0) return {};
    out.define("HAS_FOG");
    out.define(fogDefine(package));
    defineIf(out, package.shading != ShadingModel::Unlit, "FOG_POINT_IS_KNOWN");
    return includeAll(out, { "shaders/lib/ibl.glsl", "shaders/material/surface/fog.glsl",
                             "shaders/material/surface/apply_fog.glsl" });
}

/// Only in materials whose surfaces may be composed in any order.
Result<void> includeTransparency(StageText& out, MaterialPackage const& package) {
    if (!blendsInAnyOrder(package)) return {};
    out.define("BLENDS_IN_ANY_ORDER");
    return includeAll(out, { "shaders/lib/distance.glsl", "shaders/lib/transparency.glsl",
                             "shaders/material/surface/transparency.glsl" });
}

bool isStandard(MaterialDefinition const& definition) {
    const ShadingModel shading = definition.package.shading;
    return shading == ShadingModel::Lit || shading == ShadingModel::SpecularGlossiness;
}

/// Authors' models, cloth and subsurface have no transformed lobe.
Result<void> areaLights(StageText& out, MaterialDefinition const& definition) {
    Result<void> done = out.include("shaders/material/surface/area_lights.glsl");
    if (!done || !isStandard(definition) || definition.customSurfaceShading) return done;
    out.define("AREA_LIGHTS_BY_LTC");
    return out.include("shaders/material/surface/lit_area.glsl");
}

/// Follows the author's code. Everything that is unsafe in 16 bits (distances, f0 near 1, derivatives, nits) precedes
/// the line after which kVariantHalf computes in 16 bits.
Result<void> litFragment(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs,
                         uint16_t variantKey) {
    declareQuality(out);
    declareVariants(out);
    const bool hasLightList = mayHave(definition, kVariantPunctual);
    Result<void> done = includeAll(out, { "shaders/lib/light.glsl", "shaders/lib/fresnel.glsl", "shaders/lib/ibl.glsl",
                                          "shaders/lib/probes.glsl", "shaders/lib/field.glsl" });
    if (done && isStandard(definition)) done = out.include("shaders/lib/look_ups.glsl");
    if (done && hasLightList) done = includeAll(out, { "shaders/lib/ltc.glsl", "shaders/lib/profiles.glsl" });
    if (done && definition.specularAntiAliasing.enabled) done = out.include("shaders/lib/aa.glsl");
    if (done)
        done = includeAll(out,
                          { "shaders/lib/occlusion.glsl", "shaders/lib/ao.glsl", "shaders/lib/screen_occlusion.glsl" });
    if (done && needs.has("HAS_IRIDESCENCE"))
        done = includeAll(out, { "shaders/lib/iridescence.glsl", "shaders/lib/refraction.glsl" });
    if (done && refracts(definition))
        done = includeAll(out, { "shaders/lib/specular.glsl", "shaders/lib/refraction.glsl" });
    if (done) done = out.include("shaders/material/surface/output.glsl");
    if (done) done = includeTransparency(out, definition.package);
    if (done) done = includeFog(out, definition.package);
    if (done && mayHave(definition, kVariantShadowReceiver)) done = includeShadows(out, definition.package);
    if (done)
        done = includeAll(out, { "shaders/lib/noise.glsl", "shaders/material/surface/facet.glsl",
                                 "shaders/material/surface/contact_shadows.glsl" });
    if (done && (variantKey & kVariantHalf) != 0) done = out.include("shaders/material/surface/half.glsl");
    if (!done) return done;
    done = includeAll(out, { "shaders/lib/brdf.glsl", "shaders/material/surface/quality.glsl",
                             "shaders/material/surface/object_field.glsl", "shaders/material/surface/probe_shares.glsl",
                             "shaders/material/surface/incoming.glsl", "shaders/material/surface/parameters.glsl",
                             "shaders/material/surface/occlusion.glsl" });
    for (Layer const& layer : kLayers) {
        if (done && needs.has(layer.term)) done = out.include(layer.text);
    }
    if (done && refracts(definition)) done = out.include("shaders/material/surface/refraction.glsl");
    if (done && reflectsPicture(definition.package))
        done = includeAll(out, { "shaders/lib/reflection.glsl", "shaders/material/surface/reflections.glsl" });
    if (done) done = out.include(shadingText(definition.package.shading));
    if (done && definition.customSurfaceShading) done = out.include("shaders/material/surface/custom_light.glsl");
    if (done && definition.package.shadowMultiplier)
        done = includeAll(out, { "shaders/lib/color.glsl", "shaders/material/surface/shadow_catcher.glsl" });
    if (done && hasLightList) done = out.include("shaders/material/surface/light_images.glsl");
    if (done && hasLightList) done = areaLights(out, definition);
    if (done && hasLightList) done = out.include("shaders/material/surface/profiles.glsl");
    if (done) done = includeAll(out, { "shaders/material/surface/lights.glsl", "shaders/material/surface/main.glsl" });
    return done;
}

/// Everything before the author's code.
Result<void> beginSurfaceFragment(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs,
                                  uint16_t variantKey) {
    beginStage(out, "in");
    defineSurface(out, definition, needs);
    defineFragment(out, definition, variantKey);
    if ((variantKey & kVariantDepth) != 0) out.define("DEPTH_RUNS_MATERIAL");
    Result<void> done = includeAll(out, { "shaders/lib/math.glsl", "shaders/interface/interface.glsl",
                                          "shaders/material/api.glsl", "shaders/material/varyings.glsl" });
    if (!done) return done;
    declareInterface(out, definition);
    declareVariables(out, definition, needs);
    declareCustomVaryings(out, definition, needs);
    for (uint32_t i = 0; i < 8; ++i) {
        if ((needs.fragmentCustoms >> i & 1) != 0)
            out.line(fmt::format("vec4 getCustom{0}() {{ return vertex_custom{0}; }}", i));
    }
    declareMaterialInputs(out, definition);
    if (needs.colors) done = out.include("shaders/lib/color.glsl");
    if (done && definition.package.sectionPlanes) done = out.include("shaders/material/surface/section_api.glsl");
    if (done && definition.customSurfaceShading) done = out.include("shaders/material/surface/custom_api.glsl");
    if (done) done = out.include("shaders/material/surface/fragment_api.glsl");
    if (done && definition.package.hasTextures()) done = out.include("shaders/material/surface/texture_bias.glsl");
    if (done && needs.bump) done = out.include("shaders/material/bump.glsl");
    if (done && needs.words.contains("toTangentFrame")) done = out.include("shaders/material/tangents.glsl");
    return done;
}

/// The author's code of a surface, and where its points are.
Result<void> surfaceBlock(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs) {
    Result<void> done = authorsBlock(out, definition, needs, true);
    if (done && definition.package.sectionPlanes) done = out.include("shaders/material/surface/section.glsl");
    const bool movesDepth = needs.has("HAS_PIXEL_DEPTH_OFFSET");
    return done && movesDepth ? out.include("shaders/material/surface/depth_offset.glsl") : done;
}

Result<void> includeTransmission(StageText& out) {
    declareQuality(out);
    out.define("TRANSMITS_DEPTH");
    return includeAll(out, { "shaders/lib/brdf.glsl", "shaders/lib/specular.glsl", "shaders/lib/refraction.glsl",
                             "shaders/material/surface/transmission.glsl" });
}

Result<std::string> depthFragment(MaterialDefinition const& definition, MaterialNeeds const& needs, uint16_t variantKey,
                                  IncludeResolver const& includes) {
    StageText out = newStageText(needs, includes);
    Result<void> done;
    if (shapesDepth(definition, needs)) {
        done = beginSurfaceFragment(out, definition, needs, variantKey);
        defineIf(out, castsThroughDither(definition), "DITHERS_DEPTH");
        if (done) done = out.include("shaders/lib/noise.glsl");
        if (done) done = surfaceBlock(out, definition, needs);
        if (done && transmitsLight(definition.package)) done = includeTransmission(out);
    } else {
        beginStage(out, "in");
    }
    if (done) done = out.include("shaders/material/surface/depth_main.glsl");
    if (!done) return done.error();
    return std::move(out).take();
}

Result<std::string> motionFragment(MaterialNeeds const& needs, IncludeResolver const& includes) {
    StageText out = newStageText(needs, includes);
    beginStage(out, "in");
    if (Result<void> done =
                includeAll(out, { "shaders/interface/interface.glsl", "shaders/material/surface/motion_main.glsl" });
        !done)
        return done.error();
    return std::move(out).take();
}

Result<std::string> debugFragment(MaterialDefinition const& definition, MaterialNeeds const& needs, uint16_t variantKey,
                                  IncludeResolver const& includes) {
    StageText out = newStageText(needs, includes);
    Result<void> done = beginSurfaceFragment(out, definition, needs, variantKey);
    if (done) done = surfaceBlock(out, definition, needs);
    const bool hasHoles = definition.package.blending == Blending::Masked || definition.package.alphaToCoverage ||
                          definition.package.sectionPlanes;
    if (done && hasHoles) done = out.include("shaders/material/surface/output.glsl");
    if (done)
        done = includeAll(out, { "shaders/lib/color.glsl", "shaders/lib/brdf.glsl", "shaders/lib/plausible.glsl",
                                 "shaders/material/debug_views.glsl", "shaders/material/surface/debug_main.glsl" });
    if (!done) return done.error();
    return std::move(out).take();
}

Result<std::string> surfaceFragment(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                    uint16_t variantKey, IncludeResolver const& includes) {
    if ((variantKey & kVariantDepth) != 0) return depthFragment(definition, needs, variantKey, includes);
    if ((variantKey & kVariantMotion) != 0) return motionFragment(needs, includes);
    if ((variantKey & kVariantDebug) != 0) return debugFragment(definition, needs, variantKey, includes);
    const bool isLit = definition.package.shading != ShadingModel::Unlit;
    StageText out = newStageText(needs, includes);
    Result<void> done = beginSurfaceFragment(out, definition, needs, variantKey);
    if (done) done = surfaceBlock(out, definition, needs);
    if (done && isLit) done = litFragment(out, definition, needs, variantKey);
    const bool isShadowed = mayHave(definition, kVariantShadowReceiver) && !isLit;
    if (isShadowed) {
        declareQuality(out);
        declareVariants(out);
    } else if (!isLit) {
        declareUnlitQuality(out);
    }
    if (done && isShadowed) done = includeShadows(out, definition.package);
    if (done && !isLit) done = includeFog(out, definition.package);
    if (done && !isLit) done = out.include("shaders/material/surface/output.glsl");
    if (done && !definition.outputs.empty()) {
        declareSurfaceOutputs(out, definition);
        done = out.include("shaders/material/surface/outputs_main.glsl");
    } else {
        if (done && !isLit) done = includeTransparency(out, definition.package);
        if (done && !isLit) done = out.include("shaders/material/surface/unlit_main.glsl");
    }
    if (!done) return done.error();
    return std::move(out).take();
}

Result<std::string> postVertex(MaterialNeeds const& needs, IncludeResolver const& includes) {
    StageText out = newStageText(needs, includes);
    beginStage(out, "out");
    if (Result<void> done = out.include("shaders/post/post_vertex_main.glsl"); !done) return done.error();
    return std::move(out).take();
}

Result<std::string> postFragment(MaterialDefinition const& definition, MaterialNeeds const& needs, uint16_t variantKey,
                                 IncludeResolver const& includes) {
    StageText out = newStageText(needs, includes);
    beginStage(out, "in");
    const auto inputs = std::ranges::count_if(definition.package.parameters, [&](Parameter const& parameter) {
        return isSubpassInput(parameter, variantKey);
    });
    defineIf(out, (variantKey & kVariantMerged) != 0, "VARIANT_MERGED");
    Result<void> done = includeAll(
            out, { "shaders/lib/math.glsl", "shaders/interface/interface.glsl", "shaders/material/api.glsl" });
    if (!done) return done.error();
    declareInterface(out, definition, variantKey);
    declareOutputs(out, definition, static_cast<uint32_t>(inputs));
    done = out.include("shaders/post/post_fragment_api.glsl");
    if (done) done = authorsBlock(out, definition, needs, true);
    if (done) done = out.include("shaders/post/post_fragment_main.glsl");
    if (!done) return done.error();
    return std::move(out).take();
}

} // namespace

bool fragmentsDecideDepth(MaterialDefinition const& definition, MaterialNeeds const& needs) {
    return definition.package.blending == Blending::Masked || needs.words.contains("discard") ||
           castsThroughDither(definition) || needs.has("HAS_PIXEL_DEPTH_OFFSET") || definition.package.sectionPlanes;
}

uint16_t variantBits(MaterialDefinition const& definition, MaterialNeeds const& needs, backend::ShaderStage stage) {
    if (stage == backend::ShaderStage::Fragment) return kAllVariantBits & ~(kVariantSkinning | kVariantConstantBits);
    const bool hasOwnDepth = definition.package.domain == MaterialDomain::Surface && !shapesDepth(definition, needs);
    return static_cast<uint16_t>(kVariantSkinning | kVariantMotion | (hasOwnDepth ? kVariantDepth : 0));
}

bool MaterialNeeds::has(std::string_view term) const {
    const auto members = materialMembers();
    for (size_t i = 0; i < members.size(); ++i) {
        if (members[i].term == term && (terms & termBit(i)) != 0) return true;
    }
    return false;
}

Result<std::string> generateProbe(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                  IncludeResolver const& includes) {
    StageText out = newStageText(needs, includes);
    if (Result<void> done = beginSurfaceFragment(out, definition, needs, 0); !done) return done.error();
    declareProbe(out, definition);
    if (Result<void> done = authorsBlock(out, definition, needs, true); !done) return done.error();
    defineProbeMain(out, definition);
    return std::move(out).take();
}

Result<std::string> generateObserver(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                     IncludeResolver const& includes) {
    if (definition.package.domain == MaterialDomain::PostProcess) return postFragment(definition, needs, 0, includes);
    if (definition.customSurfaceShading) return surfaceFragment(definition, needs, 0, includes);
    StageText out = newStageText(needs, includes);
    if (Result<void> done = beginSurfaceFragment(out, definition, needs, 0); !done) return done.error();
    if (Result<void> done = authorsBlock(out, definition, needs, true); !done) return done.error();
    defineObserverMain(out, definition);
    return std::move(out).take();
}

Result<std::string> generateVertex(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                   uint16_t variantKey, IncludeResolver const& includes) {
    return definition.package.domain == MaterialDomain::PostProcess
                   ? postVertex(needs, includes)
                   : surfaceVertex(definition, needs, variantKey, includes);
}

Result<std::string> generateFragment(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                     uint16_t variantKey, IncludeResolver const& includes) {
    return definition.package.domain == MaterialDomain::PostProcess
                   ? postFragment(definition, needs, variantKey, includes)
                   : surfaceFragment(definition, needs, variantKey, includes);
}

backend::ProgramLayout materialLayout(MaterialDefinition const& definition, MaterialNeeds const& needs) {
    using backend::BindingType;
    using backend::ShaderStage;
    backend::ProgramLayout layout{};
    layout[kGroupView] = viewGroupLayout();
    layout[kGroupPass] = passGroupLayout(passKind(definition.package));
    backend::BindGroupLayout& group = layout[kGroupMaterial];
    if (definition.package.uniformBytes > 0)
        group.bindings[group.count++] = { .binding = 0, .type = BindingType::UniformBuffer };
    uint8_t attachment = 0;
    for (Parameter const& parameter : definition.package.parameters) {
        if (!isTexture(parameter.type)) continue;
        const bool isInput = parameter.type == ParameterType::SubpassInput;
        group.bindings[group.count++] = { .binding = parameter.binding,
                                          .type = isInput ? BindingType::InputAttachment : BindingType::SampledTexture,
                                          .stages = needs.vertexTextures && !isInput ? ShaderStage::Both
                                                                                     : ShaderStage::Fragment,
                                          .inputAttachment = isInput ? attachment++ : uint8_t{ 0 },
                                          .isMultisampled = parameter.type == ParameterType::Sampler2DMS };
    }
    return layout;
}

} // namespace filament_core::shader
