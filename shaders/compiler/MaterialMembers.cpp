// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialMembers.h"

#include <fmt/core.h>

#include <limits>

namespace filament::shader {
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
bool refracts(Definition const& d) { return isShaded(d) && d.package.refractionMode != RefractionMode::None; }
bool isThin(Definition const& d) { return refracts(d) && d.package.refractionType == RefractionType::Thin; }
bool hasThickness(Definition const& d) { return isSubsurface(d) || refracts(d); }
bool hasIor(Definition const& d) { return isLit(d) || refracts(d); }

constexpr float kAny = std::numeric_limits<float>::quiet_NaN();
constexpr std::array<float, 4> kZero{}, kOne{ 1, 1, 1, 1 }, kUp{ 0, 0, 1, 0 }, kDark{ 0, 0, 0, kAny };
constexpr auto kNeutral = Absent::Neutral, kUntouched = Absent::Untouched, kNever = Absent::Never;

// clang-format off
// The guide says 0 for ambientOcclusion; that is a misprint: everything would be black.
constexpr MaterialMember kMembers[] = {
    { "baseColor", 4, kOne, always },
    { "emissive", 4, { 0, 0, 0, 1 }, always, kNeutral, "HAS_EMISSIVE", kDark },
    { "postLightingColor", 4, kZero, always, kNeutral, "HAS_POST_LIGHTING_COLOR", kZero },
    { "roughness", 1, kOne, isShaded },
    { "metallic", 1, kZero, isMetallic },
    { "reflectance", 1, { 0.5f }, isMetallic, kUntouched, "HAS_REFLECTANCE" },
    { "ambientOcclusion", 1, kOne, isShaded, kNeutral, "HAS_AMBIENT_OCCLUSION", kOne },
    { "normal", 3, kUp, isShaded, kNeutral, "HAS_NORMAL", kUp, true },
    { "bentNormal", 3, kUp, isShaded, kNeutral, "HAS_BENT_NORMAL", kUp, true },
    { "sheenColor", 3, kZero, isLayered, kNeutral, "HAS_SHEEN", kZero },
    { "sheenRoughness", 1, kZero, isLayered },
    { "clearCoat", 1, kOne, isLayered, kNeutral, "HAS_CLEAR_COAT", kZero },
    { "clearCoatRoughness", 1, kZero, isLayered },
    { "clearCoatNormal", 3, kUp, isLayered, kNeutral, "HAS_CLEAR_COAT_NORMAL", kUp, true },
    { "anisotropy", 1, kZero, isLayered, kNeutral, "HAS_ANISOTROPY", kZero, false, true },
    { "anisotropyDirection", 3, { 1 }, isLayered },
    { "thickness", 1, { 0.5f }, hasThickness, kUntouched, "HAS_THICKNESS" },
    { "subsurfacePower", 1, { 12.234f }, isSubsurface },
    { "subsurfaceColor", 3, kOne, isSubsurface },
    { "sheenColor", 3, kOne, isCloth, kUntouched, "HAS_SHEEN_COLOR" }, // untouched: sqrt(baseColor)
    { "subsurfaceColor", 3, kZero, isCloth, kNeutral, "HAS_SUBSURFACE_COLOR", kZero },
    { "specularColor", 3, kZero, isGlossy },
    { "glossiness", 1, kZero, isGlossy },
    { "transmission", 1, kOne, refracts, kNeutral, "HAS_TRANSMISSION", kOne },
    { "absorption", 3, kZero, refracts, kNeutral, "HAS_ABSORPTION", kZero },
    { "ior", 1, { 1.5f }, hasIor, kNeutral, "HAS_IOR", { 1.5f } },
    { "microThickness", 1, kZero, isThin, kNeutral, "HAS_MICRO_THICKNESS", kZero },
    { "dispersion", 1, kZero, refracts, kNeutral, "HAS_DISPERSION", kZero },
    // Not in the guide: added for glTF's extensions.
    { "specularFactor", 1, kOne, isLit, kNeutral, "HAS_SPECULAR_FACTOR", kOne },
    { "specularColorFactor", 3, kOne, isLit, kNeutral, "HAS_SPECULAR_COLOR_FACTOR", kOne },
    { "iridescence", 1, kZero, isLit, kNeutral, "HAS_IRIDESCENCE", kZero },
    { "iridescenceIor", 1, { 1.3f }, isLit },
    { "iridescenceThickness", 1, { 400 }, isLit }, // nanometres
    { "diffuseTransmission", 1, kZero, isLit, kNeutral, "HAS_DIFFUSE_TRANSMISSION", kZero },
    { "diffuseTransmissionColor", 3, kOne, isLit },
};
// clang-format on
static_assert(std::size(kMembers) <= 64, "a term is a bit");

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

void declareMaterialInputs(StageText& out, MaterialDefinition const& definition) {
    out.line("struct MaterialInputs {");
    for (MaterialMember const& member : kMembers) {
        if (member.isMemberOf(definition))
            out.line(fmt::format("    {} {};", floatType(member.components), member.name));
    }
    out.line("};");
    out.line("void initMaterial(out MaterialInputs material) {");
    for (MaterialMember const& member : kMembers) {
        if (!member.isMemberOf(definition)) continue;
        const auto initial = std::span(member.initial).first(member.components);
        out.line(fmt::format("    material.{} = {};", member.name, floatLiteral(initial)));
    }
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
    out.line("}");
}

} // namespace filament::shader
