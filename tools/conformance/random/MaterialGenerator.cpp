// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/random/MaterialGenerator.h"

#include "tools/conformance/random/RandomCode.h"

#include <fmt/core.h>

#include <array>
#include <set>

namespace filament_core::conformance {
namespace {

struct Parameter {
    const char *type, *glsl, *value;
};
constexpr std::array kParameters{
    Parameter{ "float", "float", "0.37" },
    Parameter{ "float2", "vec2", "0.2,-1.7" },
    Parameter{ "float3", "vec3", "0.9,0.3,0.1" },
    Parameter{ "float4", "vec4", "0.1,0.6,-0.4,2" },
    Parameter{ "int", "int", "3" },
    Parameter{ "uint", "uint", "5" },
    Parameter{ "bool", "bool", "true" },
    Parameter{ "int3", "ivec3", "1,-2,3" },
    Parameter{ "float3x3", "mat3", "0,1,0,1,0,0,0,0,1" },
    Parameter{ "float4x4", "mat4", "1,0,0,0,0,2,0,0,0,0,1,0,0.2,0,0,1" },
};
constexpr std::array kPictures{ "brick/color", "wood/color", "dimple/normal", "checker/color", "waves/height" };
constexpr std::array kShadings{ "unlit", "unlit", "lit", "lit", "subsurface", "cloth", "specularGlossiness" };
constexpr std::array kBlendings{ "masked", "transparent", "fade", "add", "multiply", "screen" };
constexpr std::array kVariables{ "va", "vb", "vc" };

struct Member {
    const char *name, *type;
    const char* shadings; ///< empty: all
};
constexpr std::array kMembers{
    Member{ "emissive", "vec4", "" },
    Member{ "postLightingColor", "vec4", "" },
    Member{ "roughness", "float", "lit subsurface cloth" },
    Member{ "metallic", "float", "lit subsurface" },
    Member{ "reflectance", "float", "lit subsurface" },
    Member{ "ambientOcclusion", "float", "lit subsurface cloth specularGlossiness" },
    Member{ "sheenColor", "vec3", "lit cloth specularGlossiness" },
    Member{ "clearCoat", "float", "lit specularGlossiness" },
    Member{ "clearCoatRoughness", "float", "lit specularGlossiness" },
    Member{ "anisotropy", "float", "lit specularGlossiness" },
    Member{ "iridescence", "float", "lit" },
    Member{ "specularFactor", "float", "lit" },
    Member{ "specularColor", "vec3", "specularGlossiness" },
    Member{ "glossiness", "float", "specularGlossiness" },
    Member{ "subsurfaceColor", "vec3", "subsurface cloth" },
    Member{ "thickness", "float", "subsurface" },
};

/// What every part of one material agrees on.
struct Plan {
    std::string shading;
    std::vector<Parameter> parameters;
    std::vector<const char*> pictures;
    std::set<std::string> attributes;
    size_t variables = 0;
    bool hasVertexBlock = false;
    int featureLevel = 1;
    bool sun = false, lamp = false;
};

Plan planned(Dice& dice) {
    Plan plan{ .shading = dice.one(kShadings) };
    for (Parameter const& parameter : kParameters) {
        if (dice.chance(35)) plan.parameters.push_back(parameter);
    }
    for (size_t i = dice.below(3); i > 0; --i) plan.pictures.push_back(dice.one(kPictures));
    for (const char* name : { "uv0", "uv1", "color", "custom0", "custom3" }) {
        if (dice.chance(50)) plan.attributes.insert(name);
    }
    plan.attributes.insert("uv0");
    plan.attributes.insert("tangents");
    plan.sun = dice.chance(50), plan.lamp = dice.chance(30);
    plan.featureLevel = dice.chance(40) ? 2 : 1;
    plan.hasVertexBlock = dice.chance(60);
    if (plan.hasVertexBlock) plan.variables = dice.below(kVariables.size() + 1);
    return plan;
}

MaterialTree shown(Dice& dice, Plan const& plan) {
    static constexpr std::array kMeshes{ "sphere", "plane", "box", "torus" };
    MaterialTree list = listOf(" ");
    list.children.push_back(piece(fmt::format("mesh={}", dice.one(kMeshes))));
    for (size_t i = 0; i < plan.parameters.size(); ++i)
        list.children.push_back(piece(fmt::format("p{}={}", i, plan.parameters[i].value)));
    for (size_t i = 0; i < plan.pictures.size(); ++i)
        list.children.push_back(piece(fmt::format("t{}={}", i, plan.pictures[i])));
    return list;
}

MaterialTree named(const char* property, std::vector<std::string> const& words) {
    MaterialTree list = listOf(", ");
    for (std::string const& word : words) list.children.push_back(piece(word));
    return piece(std::string(property) + " : [ $0 ]", { list });
}

MaterialTree parameters(Plan const& plan) {
    std::vector<std::string> words;
    for (size_t i = 0; i < plan.parameters.size(); ++i)
        words.push_back(fmt::format("{{ name : p{}, type : {} }}", i, plan.parameters[i].type));
    for (size_t i = 0; i < plan.pictures.size(); ++i)
        words.push_back(fmt::format("{{ name : t{}, type : sampler2d }}", i));
    return named("parameters", words);
}

void addState(Dice& dice, MaterialTree& list) {
    if (dice.chance(35)) list.children.push_back(piece(std::string("blending : ") + dice.one(kBlendings)));
    for (const char* setting : { "doubleSided : true", "interpolation : flat", "flipUV : false", "culling : none",
                                 "quality : high", "depthWrite : true" }) {
        if (dice.chance(10)) list.children.push_back(piece(setting));
    }
}

MaterialTree properties(Dice& dice, Plan const& plan) {
    MaterialTree list = listOf(",\n    ");
    list.children = { piece("name : Random"), piece("shadingModel : " + plan.shading),
                      piece(fmt::format("featureLevel : {}", plan.featureLevel)), parameters(plan),
                      named("requires", { plan.attributes.begin(), plan.attributes.end() }) };
    std::vector<std::string> variables;
    for (size_t i = 0; i < plan.variables; ++i) variables.emplace_back(kVariables[i]);
    list.children.push_back(named("variables", variables));
    std::vector<std::string> filtered{ "skinning", "shadowReceiver", "fog", "vsm", "ssr", "stereo" };
    if (!plan.lamp) filtered.emplace_back("dynamicLighting");
    if (!plan.sun) filtered.emplace_back("directionalLighting");
    list.children.push_back(named("variantFilter", filtered));
    addState(dice, list);
    return list;
}

void addParameters(RandomCode& code, Plan const& plan) {
    for (size_t i = 0; i < plan.parameters.size(); ++i)
        code.addLeaf(plan.parameters[i].glsl, fmt::format("materialParams.p{}", i));
}

MaterialTree vertexBlock(Dice& dice, Plan const& plan) {
    RandomCode code(dice, true, plan.featureLevel);
    addParameters(code, plan);
    code.addLeaf("vec4", "getPosition()");
    code.addLeaf("vec3", "material.worldNormal");
    code.addLeaf("vec2", "material.uv0");
    for (const char* name : { "0", "3" }) {
        if (plan.attributes.contains(std::string("custom") + name))
            code.addLeaf("vec4", fmt::format("getCustom{}()", name));
    }
    if (plan.attributes.contains("color")) code.addLeaf("vec4", "material.color");
    MaterialTree list = code.wholeBlock(1 + dice.below(5));
    const auto add = [&](std::string text, const char* type) {
        list.children.push_back(piece(std::move(text), { code.expression(type, 3) }));
    };
    for (size_t i = 0; i < plan.variables; ++i) {
        const std::string target = std::string("material.") + kVariables[i];
        if (dice.chance(30))
            add(target + " = vec4($0, 1.0);", "vec3");
        else
            add(target + " = $0;", "vec4");
    }
    if (dice.chance(30)) add("material.worldPosition.xyz += 0.1 * clamp($0, -1.0, 1.0);", "vec3");
    if (dice.chance(30)) add("material.uv0 += $0;", "vec2");
    if (dice.chance(20)) add("material.worldNormal = normalize(material.worldNormal + 0.2 * sin($0));", "vec3");
    if (plan.attributes.contains("color") && dice.chance(30)) add("material.color.rg = $0;", "vec2");
    return piece("vertex {\n    void materialVertex(inout MaterialVertexInputs material) {\n$0\n    }\n}\n", { list });
}

void addInputs(RandomCode& code, Plan const& plan) {
    code.addLeaf("vec2", "getUV0()");
    if (plan.attributes.contains("uv1")) code.addLeaf("vec2", "getUV1()");
    if (plan.attributes.contains("color")) code.addLeaf("vec4", "getColor()");
    code.addLeaf("vec3", "getWorldPosition()");
    code.addLeaf("vec3", "getWorldNormalVector()");
    code.addLeaf("vec3", "getWorldViewVector()");
    code.addLeaf("vec3", "getNormalizedViewportCoord()");
    code.addLeaf("float", "getNdotV()");
    code.addLeaf("bool", "gl_FrontFacing");
    for (size_t i = 0; i < plan.variables; ++i) code.addLeaf("vec4", fmt::format("variable_{}", kVariables[i]));
}

void addTextures(RandomCode& code, Plan const& plan) {
    for (size_t i = 0; i < plan.pictures.size(); ++i) {
        const std::string name = fmt::format("materialParams_t{}", i);
        code.addLeaf("vec4", fmt::format("texture({}, getUV0())", name));
        code.addProduction({ "vec4", "texture(" + name + ", $0)", { "vec2" } });
        code.addProduction({ "vec4", "texture(" + name + ", $0, $1)", { "vec2", "float" } });
        code.addProduction({ "vec4", "textureLod(" + name + ", $0, $1)", { "vec2", "float" } });
        code.addProduction({ "vec4", "textureGrad(" + name + ", $0, $1, $2)", { "vec2", "vec2", "vec2" } });
        code.addProduction({ "vec4", "texelFetch(" + name + ", clamp($0, ivec2(0), ivec2(63)), 0)", { "ivec2" } });
        code.addProduction({ "ivec2", "textureSize(" + name + ", 0)", {} });
    }
}

MaterialTree memberValue(Dice& dice, RandomCode& code, std::string const& target, std::string const& type) {
    static constexpr std::array kForms{ "clamp($0, 0.0, 1.0)", "fract($0)", "(0.5 + 0.5 * sin($0))", "$0" };
    return piece(target + " = " + dice.one(kForms) + ";", { code.expression(type, 5) });
}

MaterialTree fragmentBlock(Dice& dice, Plan const& plan) {
    RandomCode code(dice, false, plan.featureLevel);
    addParameters(code, plan);
    MaterialTree helpers = listOf("\n");
    for (uint32_t i = dice.below(3); i > 0; --i) helpers.children.push_back(code.helper(fmt::format("help{}", i)));
    addInputs(code, plan);
    addTextures(code, plan);
    MaterialTree list = listOf("\n");
    if (plan.shading != "unlit" && dice.chance(25)) {
        list.children.push_back(
                piece("{ int zero = 0; material.normal = normalize(vec3(0.0, 0.0, 1.0) + 0.3 * sin($0)); }",
                      { code.expression("vec3", 3) }));
    }
    list.children.push_back(piece("prepareMaterial(material);"));
    list.children.push_back(code.wholeBlock(2 + dice.below(8)));
    list.children.push_back(memberValue(dice, code, "material.baseColor.rgb", "vec3"));
    if (dice.chance(40)) list.children.push_back(memberValue(dice, code, "material.baseColor.a", "float"));
    if (dice.chance(10)) list.children.push_back(piece("if ($0) discard;", { code.expression("bool", 3) }));
    if (dice.chance(10)) list.children.push_back(piece("if ($0) return;", { code.expression("bool", 3) }));
    for (Member const& member : kMembers) {
        const bool has = std::string_view(member.shadings).empty() ||
                         std::string_view(member.shadings).find(plan.shading) != std::string_view::npos;
        if (has && dice.chance(25))
            list.children.push_back(memberValue(dice, code, std::string("material.") + member.name, member.type));
    }
    return piece("fragment {\n$0\n    void material(inout MaterialInputs material) {\n$1\n    }\n}\n",
                 { helpers, list });
}

} // namespace

MaterialTree generateMaterial(uint64_t seed) {
    Dice dice(seed);
    const Plan plan = planned(dice);
    MaterialTree vertex = listOf("\n");
    MaterialTree values = shown(dice, plan), head = properties(dice, plan);
    if (plan.hasVertexBlock) vertex.children.push_back(vertexBlock(dice, plan));
    return piece("// show: $0\nmaterial {\n    $1\n}\n$2\n$3", { values, head, vertex, fragmentBlock(dice, plan) });
}

std::string generateScene(uint64_t seed, std::string const& material) {
    Dice dice(seed);
    const Plan plan = planned(dice);
    const char* sun = plan.sun ? R"(  "suns": [{"direction": [-0.4, -1, -0.6], "lux": 40000}],)"
                                 "\n"
                               : "";
    const char* lamp = plan.lamp ? R"(  "points": [{"at": [1.5, 0.2, 1.8], "candela": 30000}],)"
                                   "\n"
                                 : "";
    const char* view = dice.chance(20)   ? R"({"size": [64, 64], "linear": true, "samples": 4})"
                       : dice.chance(80) ? R"({"size": [64, 64], "linear": true})"
                                         : R"({"size": [64, 64]})";
    return fmt::format("{{\n  \"description\": \"Generated from seed {}.\",\n  \"model\": {{\"material\": \"{}\"}},\n"
                       "  \"environment\": {{\"file\": \"studio\", \"lux\": 10000}},\n{}{}"
                       "  \"camera\": {{\"eye\": [0.9, 0.7, 2.0]}},\n  \"view\": {}\n}}\n",
                       seed, material, sun, lamp, view);
}

} // namespace filament_core::conformance
