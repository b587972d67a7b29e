// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/StateProperties.h"

#include "shaders/compiler/PropertyReader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace filament_core::shader {
namespace {

/// The words for the enumerators of a property.
template <class E>
struct Words;

template <class E>
using Word = std::pair<std::string_view, E>;

template <>
struct Words<MaterialDomain> {
    static constexpr Word<MaterialDomain> kList[] = { { "surface", MaterialDomain::Surface },
                                                      { "postprocess", MaterialDomain::PostProcess } };
};

template <>
struct Words<ShadingModel> {
    static constexpr Word<ShadingModel> kList[] = { { "lit", ShadingModel::Lit },
                                                    { "unlit", ShadingModel::Unlit },
                                                    { "subsurface", ShadingModel::Subsurface },
                                                    { "cloth", ShadingModel::Cloth },
                                                    { "specularGlossiness", ShadingModel::SpecularGlossiness } };
};

template <>
struct Words<Blending> {
    static constexpr Word<Blending> kList[] = {
        { "opaque", Blending::Opaque }, { "masked", Blending::Masked }, { "transparent", Blending::Transparent },
        { "fade", Blending::Fade },     { "add", Blending::Add },       { "multiply", Blending::Multiply },
        { "screen", Blending::Screen }, { "custom", Blending::Custom },
    };
};

template <>
struct Words<PostLightingBlending> {
    static constexpr Word<PostLightingBlending> kList[] = { { "opaque", PostLightingBlending::Opaque },
                                                            { "transparent", PostLightingBlending::Transparent },
                                                            { "add", PostLightingBlending::Add },
                                                            { "multiply", PostLightingBlending::Multiply },
                                                            { "screen", PostLightingBlending::Screen } };
};

template <>
struct Words<TransparencyMode> {
    static constexpr Word<TransparencyMode> kList[] = {
        { "default", TransparencyMode::Default },
        { "twoPassesOneSide", TransparencyMode::TwoPassesOneSide },
        { "twoPassesTwoSides", TransparencyMode::TwoPassesTwoSides },
    };
};

template <>
struct Words<backend::BlendFactor> {
    using Factor = backend::BlendFactor;
    static constexpr Word<Factor> kList[] = {
        { "zero", Factor::Zero },
        { "one", Factor::One },
        { "srcColor", Factor::SrcColor },
        { "oneMinusSrcColor", Factor::OneMinusSrcColor },
        { "dstColor", Factor::DstColor },
        { "oneMinusDstColor", Factor::OneMinusDstColor },
        { "srcAlpha", Factor::SrcAlpha },
        { "oneMinusSrcAlpha", Factor::OneMinusSrcAlpha },
        { "dstAlpha", Factor::DstAlpha },
        { "oneMinusDstAlpha", Factor::OneMinusDstAlpha },
        { "srcAlphaSaturate", Factor::SrcAlphaSaturate },
    };
};

template <>
struct Words<Culling> {
    static constexpr Word<Culling> kList[] = { { "none", Culling::None },
                                               { "front", Culling::Front },
                                               { "back", Culling::Back },
                                               { "frontAndBack", Culling::FrontAndBack } };
};

template <>
struct Words<VertexDomain> {
    static constexpr Word<VertexDomain> kList[] = { { "object", VertexDomain::Object },
                                                    { "world", VertexDomain::World },
                                                    { "view", VertexDomain::View },
                                                    { "device", VertexDomain::Device } };
};

template <>
struct Words<Interpolation> {
    static constexpr Word<Interpolation> kList[] = { { "smooth", Interpolation::Smooth },
                                                     { "flat", Interpolation::Flat } };
};

template <>
struct Words<RefractionMode> {
    static constexpr Word<RefractionMode> kList[] = { { "none", RefractionMode::None },
                                                      { "cubemap", RefractionMode::Cubemap },
                                                      { "screenspace", RefractionMode::ScreenSpace } };
};

template <>
struct Words<RefractionType> {
    static constexpr Word<RefractionType> kList[] = { { "solid", RefractionType::Solid },
                                                      { "thin", RefractionType::Thin } };
};

template <>
struct Words<Reflections> {
    static constexpr Word<Reflections> kList[] = { { "default", Reflections::Default },
                                                   { "screenspace", Reflections::ScreenSpace } };
};

template <>
struct Words<MaterialQuality> {
    static constexpr Word<MaterialQuality> kList[] = { { "default", MaterialQuality::Default },
                                                       { "low", MaterialQuality::Low },
                                                       { "normal", MaterialQuality::Normal },
                                                       { "high", MaterialQuality::High } };
};

template <>
struct Words<ClothDistribution> {
    static constexpr Word<ClothDistribution> kList[] = { { "charlie", ClothDistribution::Charlie },
                                                         { "ashikhmin", ClothDistribution::Ashikhmin } };
};

template <>
struct Words<SpecularAmbientOcclusion> {
    static constexpr Word<SpecularAmbientOcclusion> kList[] = { { "none", SpecularAmbientOcclusion::None },
                                                                { "simple", SpecularAmbientOcclusion::Simple },
                                                                { "bentNormals",
                                                                  SpecularAmbientOcclusion::BentNormals } };
};

template <class T>
Result<void> readValue(JsonValue const& value, std::string_view name, T& out) {
    if constexpr (std::is_same_v<T, bool>) {
        return readBool(value, name, out);
    } else if constexpr (std::is_same_v<T, float>) {
        return readNumber(value, name, 0, 1, out); // all fractional numbers of the guide are in [0, 1]
    } else {
        return readEnum(value, name, Words<T>::kList, out);
    }
}

template <class E, size_t N>
std::string listOf(Word<E> const (&words)[N]) {
    std::string list;
    for (auto const& [word, value] : words) {
        if (!list.empty()) list += ", ";
        list += word;
    }
    return list;
}

template <class T>
std::string valuesOf() {
    if constexpr (std::is_same_v<T, bool>) {
        return "true, false";
    } else if constexpr (std::is_same_v<T, float>) {
        return "a number in [0, 1]";
    } else {
        return listOf(Words<T>::kList);
    }
}

template <class T>
std::string wordOf(T value) {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, float>) {
        return fmt::format("{}", value);
    } else {
        auto const& words = Words<T>::kList;
        return std::string(std::ranges::find(words, value, &Word<T>::second)->first);
    }
}

template <class Owner, class T>
T memberTypeOf(T Owner::*);
template <class Owner, class T>
Owner ownerOf(T Owner::*);

/// The part of a definition, const or not, that has the member.
template <auto Member, class Definition>
auto& valueIn(Definition& definition) {
    using Owner = decltype(ownerOf(Member));
    if constexpr (std::is_same_v<Owner, MaterialPackage>) {
        return definition.package.*Member;
    } else if constexpr (std::is_same_v<Owner, SpecularAntiAliasing>) {
        return definition.specularAntiAliasing.*Member;
    } else {
        return definition.*Member;
    }
}

template <auto Member>
Result<void> readMember(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    return readValue(value, name, valueIn<Member>(out));
}

template <auto Member>
std::string shownMember(MaterialDefinition const& definition) {
    return wordOf(valueIn<Member>(definition));
}

template <auto Member>
constexpr StateProperty property(std::string_view name, std::string_view meaning) {
    return { name, meaning, readMember<Member>, valuesOf<decltype(memberTypeOf(Member))>, shownMember<Member> };
}

Result<void> readName(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    const bool isScalar = value.kind != JsonValue::Kind::Array && value.kind != JsonValue::Kind::Object;
    if (!isScalar) return expectKind(value, JsonValue::Kind::String, name);
    out.package.name = value.text;
    return {};
}

Result<void> readFeatureLevel(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    float level = 0;
    if (Result<void> done = readNumber(value, name, 0, 3, level); !done) return done;
    if (level != std::floor(level)) return errorAt(value.at, "'featureLevel' is 0, 1, 2 or 3");
    out.package.featureLevel = static_cast<uint8_t>(std::max(level, 1.0f)); // every device has level 1
    return {};
}

struct BlendField {
    std::string_view name;
    backend::BlendFactor BlendFunction::*factor;
};
constexpr BlendField kBlendFields[] = { { "srcRGB", &BlendFunction::sourceColor },
                                        { "srcA", &BlendFunction::sourceAlpha },
                                        { "dstRGB", &BlendFunction::targetColor },
                                        { "dstA", &BlendFunction::targetAlpha } };

Result<void> readBlendFunction(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    static constexpr std::string_view kNames[] = { kBlendFields[0].name, kBlendFields[1].name, kBlendFields[2].name,
                                                   kBlendFields[3].name };
    if (Result<void> isObject = expectKind(value, JsonValue::Kind::Object, name); !isObject) return isObject;
    if (Result<void> known = expectOnly(value, kNames, name, out.warnings); !known) return known;
    for (BlendField const& field : kBlendFields) {
        JsonValue const* factor = findMember(value, field.name);
        if (!factor) return errorAt(value.at, fmt::format("blendFunction needs the field '{}'", field.name));
        if (Result<void> done = readValue(*factor, field.name, out.package.blendFunction.*field.factor); !done)
            return done;
    }
    return {};
}

std::string shownBlendFunction(MaterialDefinition const& definition) {
    std::string text;
    for (BlendField const& field : kBlendFields) {
        text += fmt::format("{}{} : {}", text.empty() ? "" : ", ", field.name,
                            wordOf(definition.package.blendFunction.*field.factor));
    }
    return "{ " + text + " }";
}

/// Accepts true and false besides the words: they mean simple and none.
Result<void> readSpecularOcclusion(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    if (value.kind != JsonValue::Kind::Bool) return readValue(value, name, out.specularAmbientOcclusion);
    out.specularAmbientOcclusion = value.boolean ? SpecularAmbientOcclusion::Simple : SpecularAmbientOcclusion::None;
    return {};
}

// In the order of the guide; domain, fullScreenTriangle, wideLines, sizedPoints, halfPrecision and clothDistribution
// are additions of this engine.
constexpr std::array kProperties{
    StateProperty{ "name", "what messages and tools call it", readName, [] { return std::string("any text"); },
                   [](MaterialDefinition const& definition) { return definition.package.name; } },
    property<&MaterialPackage::domain>("domain", "a surface of the scene, or an effect over the whole picture"),
    StateProperty{
            "featureLevel", "what devices must offer: it limits the number of samplers", readFeatureLevel,
            [] { return std::string("0, 1, 2, 3"); },
            [](MaterialDefinition const& definition) { return std::to_string(definition.package.featureLevel); } },
    property<&MaterialPackage::shading>("shadingModel",
                                        "how light is reflected, and which members of `MaterialInputs` there are"),
    property<&MaterialDefinition::flipUv>(
            "flipUV", "texture coordinates count from the lower edge of a picture, as in OpenGL: v becomes 1 - v"),
    property<&MaterialPackage::quality>("quality", "`low`: a visibility term that is cheaper and slightly wrong"),
    property<&MaterialPackage::instanced>("instanced", "`getInstanceIndex()` exists"),
    property<&MaterialPackage::vertexDomainDeviceJittered>(
            "vertexDomainDeviceJittered", "positions in clip space follow the jitter of temporal anti-aliasing"),
    property<&MaterialPackage::vertexDomain>("vertexDomain", "the space of the positions in the mesh"),
    property<&MaterialPackage::interpolation>(
            "interpolation", "of attributes and variables across a triangle; `flat`: those of its last vertex"),
    property<&MaterialDefinition::fullScreenTriangle>(
            "fullScreenTriangle", "one triangle over the view, without vertices; needs `vertexDomain : device`"),
    property<&MaterialDefinition::wideLines>(
            "wideLines", "the mesh holds corners of line segments, which are spread to `lineWidth` pixels"),
    property<&MaterialDefinition::sizedPoints>(
            "sizedPoints", "the mesh holds corners of points, which are spread to `pointPixels` or `pointMeters`"),
    property<&MaterialDefinition::halfPrecision>("halfPrecision",
                                                 "also compiles variants that are lit with 16-bit numbers"),
    property<&MaterialPackage::blending>("blending", "how the surface covers what is behind it"),
    StateProperty{ "blendFunction", "the factors of `blending : custom`", readBlendFunction,
                   [] { return "srcRGB, srcA, dstRGB, dstA, each: " + valuesOf<backend::BlendFactor>(); },
                   shownBlendFunction },
    property<&MaterialPackage::postLightingBlending>("postLightingBlending",
                                                     "how `postLightingColor` is put over the lit colour"),
    property<&MaterialPackage::transparency>("transparency",
                                             "which sides of a blended surface are drawn, and in how many passes"),
    property<&MaterialPackage::maskThreshold>("maskThreshold", "alpha below which `blending : masked` leaves holes"),
    property<&MaterialPackage::refractionMode>(
            "refractionMode", "what is seen through the surface: nothing, the environment, or the picture"),
    property<&MaterialPackage::refractionType>("refractionType",
                                               "a solid object, whose surface bends light, or a thin sheet"),
    property<&MaterialPackage::culling>("culling", "the sides that are not drawn"),
    property<&MaterialPackage::colorWrite>("colorWrite", "writes colour"),
    property<&MaterialPackage::depthWrite>("depthWrite", "writes depth"),
    property<&MaterialPackage::depthCulling>("depthCulling", "what is behind other surfaces is not drawn"),
    property<&MaterialPackage::doubleSided>(
            "doubleSided", "back faces are lit as front faces; where it is given, instances can change it"),
    property<&MaterialPackage::sectionPlanes>(
            "sectionPlanes", "the [section planes](sections.md) of a view cut it, and caps close what is solid"),
    property<&MaterialPackage::alphaToCoverage>(
            "alphaToCoverage", "with several samples a pixel, alpha is the share of them that is covered"),
    property<&MaterialPackage::reflections>("reflections", "`screenspace`: the surface reflects the picture"),
    property<&MaterialPackage::shadowMultiplier>(
            "shadowMultiplier",
            "a surface that only shows shadows: unlit, colour and alpha are scaled by that of the brightest sun; lit, "
            "alpha is "
            "scaled by the share of all light that shadows take, and screen-space reflections are added"),
    property<&MaterialPackage::transparentShadow>("transparentShadow",
                                                  "blended surfaces cast dithered shadows, as dense as their alpha"),
    property<&MaterialDefinition::clearCoatIorChange>(
            "clearCoatIorChange",
            "below a clear coat the base reflects less, because it borders on the coat and not on air"),
    property<&MaterialDefinition::multiBounceAmbientOcclusion>(
            "multiBounceAmbientOcclusion", "bright surfaces are occluded less, and in their own colour"),
    StateProperty{ "specularAmbientOcclusion", "how occlusion dims reflections; `true` is `simple`, `false` is `none`",
                   readSpecularOcclusion, valuesOf<SpecularAmbientOcclusion>,
                   shownMember<&MaterialDefinition::specularAmbientOcclusion> },
    property<&SpecularAntiAliasing::enabled>("specularAntiAliasing",
                                             "widens highlights where normals vary within a pixel"),
    property<&SpecularAntiAliasing::variance>("specularAntiAliasingVariance",
                                              "how strongly the variation of normals widens them"),
    property<&SpecularAntiAliasing::threshold>("specularAntiAliasingThreshold", "the most by which it does"),
    property<&MaterialDefinition::useDefaultDepthVariant>(
            "useDefaultDepthVariant",
            "shadow maps are drawn without the vertex block; only if it leaves `worldPosition` as it is"),
    property<&MaterialDefinition::customSurfaceShading>(
            "customSurfaceShading", "the fragment block defines `surfaceShading()`, which shades for each light"),
    property<&MaterialDefinition::clothDistribution>("clothDistribution", "of the fibres of `shadingModel : cloth`"),
};

} // namespace

std::span<const StateProperty> stateProperties() { return kProperties; }

} // namespace filament_core::shader
