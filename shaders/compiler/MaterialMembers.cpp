// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialMembers.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace filament_core::shader {
namespace {

using Definition = MaterialDefinition;

ShadingModel modelOf(Definition const& d) { return d.package.shading; }
bool always(Definition const&) { return true; }
bool isShaded(Definition const& d) { return modelOf(d) != ShadingModel::Unlit; }
bool isLit(Definition const& d) { return modelOf(d) == ShadingModel::Lit; }
bool isSubsurface(Definition const& d) { return modelOf(d) == ShadingModel::Subsurface; }
bool isCloth(Definition const& d) { return modelOf(d) == ShadingModel::Cloth; }
bool isGlossy(Definition const& d) { return modelOf(d) == ShadingModel::SpecularGlossiness; }
bool isMetallic(Definition const& d) { return isLit(d) || isSubsurface(d); }
bool isLayered(Definition const& d) { return isLit(d) || isGlossy(d); }
bool refractsShaded(Definition const& d) { return isShaded(d) && d.package.refractionMode != RefractionMode::None; }
bool isThin(Definition const& d) { return refractsShaded(d) && d.package.refractionType == RefractionType::Thin; }
bool hasThickness(Definition const& d) { return isSubsurface(d) || refractsShaded(d); }
bool isSolidLit(Definition const& d) { return isLit(d) && refractsShaded(d) && !isThin(d); }
bool hasIor(Definition const& d) { return isLit(d) || refractsShaded(d); }

constexpr float kAny = std::numeric_limits<float>::quiet_NaN();
constexpr std::array<float, 4> kZero{}, kOne{ 1, 1, 1, 1 }, kUp{ 0, 0, 1, 0 }, kDark{ 0, 0, 0, kAny };
constexpr auto kNeutral = Absent::Neutral, kUntouched = Absent::Untouched;

// clang-format off
// The guide says 0 for ambientOcclusion; that is a misprint: everything would be black.
constexpr MaterialMember kMembers[] = {
    { "baseColor",
      "the colour that is diffused, of metals the colour of the reflection; linear, [0, 1]; w is alpha",
      4, kOne, always },
    { "emissive",
      "light of its own, nits; w is 1 for lamps that the exposure affects, 0 for light that looks alike in every exposure",
      4, { 0, 0, 0, 1 }, always, kNeutral, "HAS_EMISSIVE", kDark },
    { "postLightingColor",
      "a colour and its alpha, combined with the lit colour as `postLightingBlending` says",
      4, kZero, always, kNeutral, "HAS_POST_LIGHTING_COLOR", kZero },
    { "postLightingMixFactor",
      "how much of what `postLightingBlending` makes of the lit colour replaces it, [0, 1]",
      1, kOne, always, kNeutral, "HAS_POST_LIGHTING_MIX", kOne },
    { "pixelDepthOffset",
      "metres, at least 0, by which the visible point lies behind the surface along the view ray: depth, shadows and "
      "light are those of that point. In shadow maps the rays are those of the light",
      1, kZero, always, kNeutral, "HAS_PIXEL_DEPTH_OFFSET", kZero },
    { "roughness", "perceptual, [0, 1]: its square is the alpha of GGX", 1, kOne, isShaded },
    { "metallic", "0 of dielectrics, 1 of metals", 1, kZero, isMetallic },
    { "reflectance",
      "of dielectrics at normal incidence: 0.16 times its square, [0, 1]",
      1, { 0.5f }, isMetallic, kUntouched, "HAS_REFLECTANCE" },
    { "ambientOcclusion",
      "the part of the ambient light that arrives, [0, 1]",
      1, kOne, isShaded, kNeutral, "HAS_AMBIENT_OCCLUSION", kOne },
    { "normal",
      "shading normal in tangent space, before prepareMaterial()",
      3, kUp, isShaded, kNeutral, "HAS_NORMAL", kUp, true },
    { "bentNormal",
      "mean direction from which ambient light arrives, in tangent space, before prepareMaterial()",
      3, kUp, isShaded, kNeutral, "HAS_BENT_NORMAL", kUp, true },
    { "sheenColor",
      "how much light the fibres over the surface reflect, by colour, [0, 1]",
      3, kZero, isLayered, kNeutral, "HAS_SHEEN", kZero },
    { "sheenRoughness", "of the fibres, perceptual, [0, 1]", 1, kZero, isLayered },
    { "clearCoat",
      "strength of a clear layer over the surface, [0, 1]; none if not set",
      1, kOne, isLayered, kNeutral, "HAS_CLEAR_COAT", kZero },
    { "clearCoatRoughness", "of the clear layer, perceptual, [0, 1]", 1, kZero, isLayered },
    { "clearCoatNormal",
      "normal of the clear layer in tangent space, before prepareMaterial()",
      3, kUp, isLayered, kNeutral, "HAS_CLEAR_COAT_NORMAL", kUp, true },
    { "anisotropy",
      "stretches highlights: along the direction if positive, across it if negative, [-1, 1]",
      1, kZero, isLayered, kNeutral, "HAS_ANISOTROPY", kZero, false, true },
    { "anisotropyDirection", "the direction of the grain, in tangent space", 3, { 1 }, isLayered },
    { "thickness",
      "of a refracting body its diameter in metres; of subsurface how much of the light stops, at least 0",
      1, { 0.5f }, hasThickness, kUntouched, "HAS_THICKNESS" },
    { "subsurfacePower",
      "how narrow the lobe of the light that passes through is, at least 0",
      1, { 12.234f }, isSubsurface },
    { "subsurfaceColor", "colour of the light that passes through, [0, 1]", 3, kOne, isSubsurface },
    { "sheenColor",
      "the colour of the fibres, [0, 1]; the square root of `baseColor` if not set",
      3, kOne, isCloth, kUntouched, "HAS_SHEEN_COLOR" }, // untouched: sqrt(baseColor)
    { "subsurfaceColor",
      "colour of light that is scattered below the fibres, [0, 1]",
      3, kZero, isCloth, kNeutral, "HAS_SUBSURFACE_COLOR", kZero },
    { "specularColor", "reflectance at normal incidence, [0, 1]", 3, kZero, isGlossy },
    { "glossiness", "1 - roughness, [0, 1]", 1, kZero, isGlossy },
    { "transmission",
      "the part of the light below the surface that passes through instead of being diffused, [0, 1]",
      1, kOne, refractsShaded, kNeutral, "HAS_TRANSMISSION", kOne },
    { "absorption",
      "by colour, 1 / m along the path through the body; a part in [0, 1] if no thickness is set",
      3, kZero, refractsShaded, kNeutral, "HAS_ABSORPTION", kZero },
    { "ior",
      "index of refraction, at least 1; without refraction it sets `reflectance`",
      1, { 1.5f }, hasIor, kNeutral, "HAS_IOR", { 1.5f } },
    { "microThickness",
      "metres of the wall of a thin shell: the path to which `absorption` applies",
      1, kZero, isThin, kNeutral, "HAS_MICRO_THICKNESS", kZero },
    { "dispersion",
      "20 / Abbe number: how far the colours are refracted apart",
      1, kZero, refractsShaded, kNeutral, "HAS_DISPERSION", kZero },
    // Not in the guide: added for glTF's extensions.
    { "specularFactor",
      "scales the reflectance of dielectrics, [0, 1]",
      1, kOne, isLit, kNeutral, "HAS_SPECULAR_FACTOR", kOne },
    { "specularColorFactor",
      "colours the reflectance of dielectrics at normal incidence",
      3, kOne, isLit, kNeutral, "HAS_SPECULAR_COLOR_FACTOR", kOne },
    { "iridescence",
      "strength of a thin film over the surface, [0, 1]",
      1, kZero, isLit, kNeutral, "HAS_IRIDESCENCE", kZero },
    { "iridescenceIor", "index of refraction of the film", 1, { 1.3f }, isLit },
    { "iridescenceThickness", "of the film, nanometres", 1, { 400 }, isLit }, // nanometres
    { "bakedLight",
      "irradiance, times the exposure, in place of the environment's diffuse light; w is the part of the sky that is "
      "seen, [0, 1], and -1 where nothing is baked",
      4, { 0, 0, 0, -1 }, isLit, kNeutral, "HAS_BAKED_LIGHT", { 0, 0, 0, -1 } },
    { "diffuseTransmission",
      "the part of the diffused light that leaves on the other side, [0, 1]",
      1, kZero, isLit, kNeutral, "HAS_DIFFUSE_TRANSMISSION", kZero },
    { "diffuseTransmissionColor", "its colour, [0, 1]", 3, kOne, isLit },
    { "multiscatterColor",
      "colour of the light that is scattered, not absorbed, where `absorption` attenuates it in a body of some "
      "`thickness`: that of a very thick body, [0, 1]",
      3, kZero, isSolidLit, kNeutral, "HAS_VOLUME_SCATTER", kZero },
    { "scatterAnisotropy",
      "mean cosine of the angle by which scattering turns light: forwards if positive, (-1, 1)",
      1, kZero, isSolidLit },
};
// clang-format on
static_assert(std::size(kMembers) <= 64, "a term is a bit");
static_assert(std::ranges::none_of(kMembers, [](MaterialMember const& each) { return each.meaning.empty(); }),
              "docs/material-language.md says what each member means");

} // namespace

std::span<const MaterialMember> materialMembers() { return kMembers; }

std::string_view floatType(uint32_t components) {
    static constexpr std::string_view kTypes[] = { "float", "vec2", "vec3", "vec4" };
    return kTypes[components - 1];
}

std::string floatLiteral(std::span<const float> components) {
    std::string list;
    for (const float component : components) {
        if (!list.empty()) list += ", ";
        std::string number = fmt::format("{}", component);
        if (number.find('.') == std::string::npos) number += ".0";
        list += number;
    }
    return fmt::format("{}({})", floatType(static_cast<uint32_t>(components.size())), list);
}

std::string initialOutput(uint32_t components) {
    return components == 4 ? "vec4(0.0, 0.0, 0.0, 1.0)" : fmt::format("{}(0.0)", floatType(components));
}

void declareMaterialInputs(StageText& out, MaterialDefinition const& definition) {
    out.line("struct MaterialInputs {");
    for (MaterialMember const& member : kMembers) {
        if (member.isMemberOf(definition))
            out.line(fmt::format("    {} {};", floatType(member.components), member.name));
    }
    for (EffectOutput const& output : definition.outputs)
        out.line(fmt::format("    {} {};", floatType(output.components), output.name));
    out.line("};");
    out.line("void initMaterial(out MaterialInputs material) {");
    for (MaterialMember const& member : kMembers) {
        if (!member.isMemberOf(definition)) continue;
        const auto initial = std::span(member.initial).first(member.components);
        out.line(fmt::format("    material.{} = {};", member.name, floatLiteral(initial)));
    }
    for (EffectOutput const& output : definition.outputs)
        out.line(fmt::format("    material.{} = {};", output.name, initialOutput(output.components)));
    out.line("}");
}

void defineObserverMain(StageText& out, MaterialDefinition const& definition) {
    static constexpr std::string_view kSwizzles[] = { "x", "xy", "xyz", "xyzw" };
    out.line("void main() { MaterialInputs observed; initMaterial(observed); computeShadingGeometry();");
    out.line("material(observed); fragment_color = vec4(0.0);");
    for (MaterialMember const& member : kMembers) {
        if (!member.isMemberOf(definition)) continue;
        out.line(fmt::format("fragment_color.{} += observed.{};", kSwizzles[member.components - 1], member.name));
    }
    for (EffectOutput const& output : definition.outputs)
        out.line(fmt::format("fragment_color.{} += observed.{};", kSwizzles[output.components - 1], output.name));
    out.line("}");
}

} // namespace filament_core::shader
