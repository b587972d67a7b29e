// SPDX-License-Identifier: Apache-2.0
#include "tests/samples/materials/SampleTable.h"

namespace filament::samples {

std::vector<Sample> samples() {
    constexpr auto kBrighter = Effect::Brighter, kDarker = Effect::Darker;
    // clang-format off
    return {
        { "alpha_to_coverage", { "alphaToCoverage : true", "alphaToCoverage : false" }, Effect::Differs, 4 },
        { "ambient_occlusion", { "material.ambientOcclusion = texture(materialParams_occlusionMap, getUV0()).r", "" }, kDarker },
        { "ambient_occlusion_multi_bounce", { "multiBounceAmbientOcclusion : true", "multiBounceAmbientOcclusion : false" }, kBrighter },
        { "anisotropy", { "anisotropy=0.85", "anisotropy=0" } },
        { "anisotropy_direction", { "material.anisotropyDirection = ", "vec3 ignored = " } },
        { "attributes", { "material.baseColor = getColor();", "" } },
        { "bent_normals", { "specularAmbientOcclusion : bentNormals", "specularAmbientOcclusion : none" }, kDarker },
        { "blend_add", { "blending : add", "blending : opaque" }, kBrighter },
        { "blend_custom", { "srcRGB : dstColor", "srcRGB : one" }, kDarker },
        { "blend_fade", { "blending : fade", "blending : transparent" }, kDarker },
        { "blend_masked", { "maskThreshold : 0.6", "maskThreshold : 0.0" } },
        { "blend_multiply", { "blending : multiply", "blending : opaque" }, kDarker },
        { "blend_screen", { "blending : screen", "blending : add" }, kDarker },
        { "blend_transparent", { "blending : transparent", "blending : opaque" } },
        { "clear_coat", { "strength=1", "strength=0" } },
        { "clear_coat_ior_change", { "clearCoatIorChange : false", "clearCoatIorChange : true" }, kBrighter },
        { "clear_coat_normal", { "material.clearCoatNormal = ", "vec3 ignored = " } },
        { "color_write", { "colorWrite : false", "colorWrite : true" }, kDarker },
        { "constants", { "materialConstants_gloss", "0.8" } },
        { "culling_front", { "culling : front", "culling : back" } },
        { "depth_culling", { "depthCulling : false", "depthCulling : true" } },
        { "depth_write", { "depthWrite : true", "depthWrite : false" } },
        { "diffuse_transmission", { "material.diffuseTransmission = 0.7;", "" } },
        { "domain_device", { "clipSpaceTransform[3].x = 0.3", "clipSpaceTransform[3].x = 0.0" } },
        { "domain_view", { "vertexDomain : view", "vertexDomain : object" } },
        { "domain_world", { "vertexDomain : world", "vertexDomain : view" } },
        { "double_sided", { "doubleSided : true", "culling : none" } },
        { "emissive", { "20000.0, 1.0", "0.0, 1.0" }, kBrighter },
        { "flat", { "interpolation : flat", "interpolation : smooth" } },
        { "flip_uv", { "flipUV : false", "flipUV : true" } },
        { "frame_constants", { "getUserTimeMod(3.0)", "0.0" }, kDarker },
        { "index_of_refraction", { "material.ior = 2.42;", "" }, kBrighter },
        { "instanced", { "getInstanceIndex()", "0" } },
        { "iridescence", { "material.iridescence = 1.0;", "" } },
        { "normal_blend_reoriented", { "blendNormalsReoriented(base, detail)", "base" } },
        { "normal_blend_udn", { "blendNormalsUdn(base, detail)", "base" } },
        { "normal_map", { "material.normal = ", "vec3 ignored = " } },
        { "parallax_occlusion", { "parallaxOcclusion(getUV0(), normalize(view), 0.08, 8).xy", "getUV0()" } },
        { "parallax_plain", { "parallaxPlain(getUV0(), normalize(view), 0.08)", "getUV0()" } },
        { "parallax_steep", { "parallaxSteep(getUV0(), normalize(view), 0.08, 24).xy", "getUV0()" } },
        { "parameter_types", { "three=0.9,0.2,0.6", "three=0,0,0" }, kBrighter },
        { "post_lighting", { "material.postLightingColor = ", "vec4 ignored = " }, kBrighter },
        { "reflectance", { "material.reflectance = 1.0", "material.reflectance = 0.5" }, kBrighter },
        { "reflections_screen", {} },
        { "sampler_int", { "index % 8", "index % 4" }, kBrighter },
        { "shadow_multiplier", { "shadowMultiplier : true", "shadowMultiplier : false" }, kBrighter },
        { "sheen", { "color=0.8,0.6,0.9", "color=0,0,0" }, kBrighter },
        { "specular_anti_aliasing", { "specularAntiAliasing : true", "specularAntiAliasing : false" } },
        { "specular_glossiness", { "glossiness=0.75", "glossiness=0.25" } },
        { "specular_weight", { "material.specularFactor = 0.9;", "material.specularFactor = 0.0;" }, kBrighter },
        { "standard", {} },
        { "texture_kinds", { "step(0.5, uv.y)", "0.0" } },
        { "textures", { "material.metallic = surface.b", "material.metallic = 0.0" } },
        { "transparent_shadow", {} },
        { "two_passes_one_side", { "transparency : twoPassesOneSide", "transparency : default" } },
        { "two_passes_two_sides", { "transparency : twoPassesTwoSides", "transparency : default" } },
        { "unlit", { "shadingModel : unlit", "shadingModel : lit" } },
        { "variables", { "height=0.15", "height=0" } },
        { "variant_filter", {}, Effect::Differs, 1, false },
    };
    // clang-format on
}

} // namespace filament::samples
