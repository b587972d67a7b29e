// SPDX-License-Identifier: Apache-2.0
// Materials as people write who come from other engines: with their own helpers, names and macros.
#include "shaders/compiler/MaterialCompiler.h"
#include "tests/shaders/compiler/SpirvTools.h"

#include <gtest/gtest.h>

#include <iterator>
#include <string>

namespace filament_core::shader {
namespace {

constexpr const char* kMaterials[] = {
    // value noise with the usual names
    R"(material { name : Clouds, shadingModel : unlit, requires : [ uv0 ],
    parameters : [ { type : float, name : scale }, { type : float2, name : wind } ] }
fragment {
    #define OCTAVES 5
    #define PI 3.14159265359
    float hash(float2 p) { return fract(sin(dot(p, float2(12.9898, 78.233))) * 43758.5453); }
    float noise(in vec2 p) {
        vec2 i = floor(p), f = fract(p);
        vec2 u = f * f * (3.0 - 2.0 * f);
        return mix(mix(hash(i), hash(i + vec2(1, 0)), u.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1)), u.x), u.y);
    }
    float fbm(vec2 p) {
        float sum = 0.0, amplitude = 0.5;
        for (int i = 0; i < OCTAVES; i++) { sum += amplitude * noise(p); p *= 2.0; amplitude *= 0.5; }
        return sum;
    }
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        vec2 p = getUV0() * materialParams.scale + materialParams.wind * getUserTime().x;
        material.baseColor.rgb = vec3(fbm(p + sin(PI * p.yx)));
    }
})",
    // lights of one's own
    R"(material { name : Toon, shadingModel : lit, customSurfaceShading : true }
fragment {
    struct Light { vec3 color; float intensity; };
    Light makeLight(const LightData data) { return Light(data.colorIntensity.rgb, data.colorIntensity.w); }
    float saturate(float x) { return min(max(x, 0.0), 1.0); }
    void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = vec4(0.2, 0.5, 0.3, 1.0); }
    vec3 surfaceShading(const MaterialInputs materialInputs, const ShadingData shadingData, const LightData lightData) {
        Light light = makeLight(lightData);
        float steps = floor(saturate(lightData.NdotL) * 3.0) / 3.0;
        return shadingData.diffuseColor * light.color * light.intensity * lightData.attenuation * steps;
    }
})",
    // an older style: HLSL names as macros
    R"(material { name : Ported, shadingModel : lit, requires : [ uv0, color ], doubleSided : true, blending : masked,
    parameters : [ { type : sampler2d, name : mainTex }, { type : float4, name : tint }, { type : float, name : cutoff } ] }
fragment {
    #define lerp mix
    #define frac fract
    #define saturate(x) clamp(x, 0.0, 1.0)
    #define float3 vec3
    #define SAMPLE(t, uv) texture(t, uv)
    #define HAS_NORMAL 0
    void material(inout MaterialInputs m) {
        prepareMaterial(m);
        vec4 c = SAMPLE(materialParams_mainTex, frac(getUV0())) * getColor();
        m.baseColor = vec4(lerp(c.rgb, float3(saturate(materialParams.tint.r)), 0.5), c.a - materialParams.cutoff);
    }
})",
    // triplanar mapping
    R"(material { name : Triplanar, shadingModel : lit,
    parameters : [ { type : sampler2d, name : ground }, { type : sampler2d, name : wall } ] }
fragment {
    vec3 triplanar(sampler2D map, vec3 position, vec3 weights) {
        return texture(map, position.yz).rgb * weights.x + texture(map, position.xz).rgb * weights.y +
               texture(map, position.xy).rgb * weights.z;
    }
    void material(inout MaterialInputs material) {
        vec3 weights = pow(abs(getWorldGeometricNormalVector()), vec3(4.0));
        weights /= weights.x + weights.y + weights.z;
        material.baseColor.rgb = weights.y > 0.5 ? triplanar(materialParams_ground, getUserWorldPosition(), weights)
                                                 : triplanar(materialParams_wall, getUserWorldPosition(), weights);
        prepareMaterial(material);
    }
})",
    // vertices without attributes of their own
    R"(material { name : Grass, shadingModel : unlit, variables : [ tip, { name : shade, precision : medium } ],
    parameters : [ { type : float4[16], name : bends } ], requires : [ custom0, custom1 ] }
vertex {
    const int kCount = 16;
    mat3 rotationAround(vec3 axis, float angle) {
        float s = sin(angle), c = cos(angle), d = 1.0 - c;
        return mat3(c + axis.x * axis.x * d, axis.x * axis.y * d + axis.z * s, axis.x * axis.z * d - axis.y * s,
                    axis.x * axis.y * d - axis.z * s, c + axis.y * axis.y * d, axis.y * axis.z * d + axis.x * s,
                    axis.x * axis.z * d + axis.y * s, axis.y * axis.z * d - axis.x * s, c + axis.z * axis.z * d);
    }
    void materialVertex(inout MaterialVertexInputs material) {
        vec4 bend = materialParams.bends[gl_VertexID % kCount];
        material.worldPosition.xyz += rotationAround(vec3(0, 1, 0), bend.w) * bend.xyz * getCustom0().y;
        material.tip = getCustom1();
        material.shade = vec4(float(gl_InstanceID) * 0.1 + 0.5);
    }
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.baseColor = variable_tip * variable_shade.x * getCustom0();
    }
})",
    // video
    R"(material { name : Screen, shadingModel : unlit, requires : [ uv0 ], parameters : [
    { type : samplerExternal, name : video }, { type : float, name : brightness } ] }
fragment {
    float luminance(vec4 c) { return luminance(c.rgb); }
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        vec4 c = texture(materialParams_video, uvToRenderTargetUV(getUV0()));
        c.rgb = inverseTonemapSRGB(c.rgb) * materialParams.brightness;
        material.baseColor = luminance(c) > 0.001 ? c : vec4(0.0, 0.0, 0.0, 1.0);
    }
})",
    // car paint: functions named as in textbooks, which the engine has too
    R"(material { name : Flakes, shadingModel : lit, requires : [ uv0 ], parameters : [ { type : float, name : density } ] }
fragment {
    struct Surface { vec3 normal; float mask; };
    float max3(float a, float b, float c) { return max(a, max(b, c)); }
    vec3 hash3(vec2 p) { vec3 q = fract(p.xyx * vec3(0.1031, 0.1030, 0.0973)); q += dot(q, q.yxz + 33.33); return fract(q); }
    float distributionGGX(float nh, float a) { float f = (nh * a - nh) * nh + 1.0; return a / (PI * f * f); }
    vec3 fresnelSchlick(float cosTheta, vec3 F0) { return F0 + (1.0 - F0) * pow5(1.0 - cosTheta); }
    Surface flake(vec2 uv) {
        vec3 r = hash3(floor(uv)) * 2.0 - 1.0;
        return Surface(normalize(vec3(r.xy * 0.2, 1.0)), max3(r.x, r.y, r.z));
    }
    void material(inout MaterialInputs material) {
        Surface s = flake(getUV0() * materialParams.density);
        material.normal = s.normal;
        prepareMaterial(material);
        material.metallic = 1.0;
        material.clearCoat = 1.0;
        material.baseColor.rgb = fresnelSchlick(getNdotV(), vec3(0.6, 0.1, 0.1)) * s.mask +
                                 vec3(0.01) * distributionGGX(getNdotV(), 0.3);
    }
})",
};

TEST(ForeignMaterials, AllCompile) {
    size_t compiled = 0;
    for (const char* text : kMaterials) {
        const Result<MaterialPackage> package = compileMaterial(text, "foreign.mat");
        EXPECT_TRUE(package) << text << "\n" << package.error().message;
        if (!package) continue;
        ++compiled;
        for (Variant const& variant : package->variants) {
            EXPECT_EQ(test::validationErrors(variant.vertex->spirv), "") << text;
            EXPECT_EQ(test::validationErrors(variant.fragment->spirv), "") << text;
        }
    }
    std::printf("%zu of %zu materials in the style of other engines compile\n", compiled, std::size(kMaterials));
    EXPECT_EQ(compiled, std::size(kMaterials));
}

} // namespace
} // namespace filament_core::shader
