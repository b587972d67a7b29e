// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/StateProperties.h"

#include "shaders/compiler/PropertyReader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace filament::shader {
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

template <class Owner, class T>
T typeOf(T Owner::*);

template <auto Member>
std::string valuesOfMember() {
    return valuesOf<decltype(typeOf(Member))>();
}

template <auto Member>
Result<void> readState(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    return readValue(value, name, out.package.*Member);
}

template <auto Member>
Result<void> readSetting(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    return readValue(value, name, out.*Member);
}

template <auto Member>
Result<void> readFilter(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    return readValue(value, name, out.specularAntiAliasing.*Member);
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

Result<void> readBlendFunction(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    struct Field {
        std::string_view name;
        backend::BlendFactor BlendFunction::*factor;
    };
    static constexpr Field kFields[] = { { "srcRGB", &BlendFunction::sourceColor },
                                         { "srcA", &BlendFunction::sourceAlpha },
                                         { "dstRGB", &BlendFunction::targetColor },
                                         { "dstA", &BlendFunction::targetAlpha } };
    static constexpr std::string_view kNames[] = { kFields[0].name, kFields[1].name, kFields[2].name, kFields[3].name };
    if (Result<void> isObject = expectKind(value, JsonValue::Kind::Object, name); !isObject) return isObject;
    if (Result<void> known = expectOnly(value, kNames, name); !known) return known;
    for (Field const& field : kFields) {
        JsonValue const* factor = findMember(value, field.name);
        if (!factor) return errorAt(value.at, fmt::format("blendFunction needs the field '{}'", field.name));
        if (Result<void> done = readValue(*factor, field.name, out.package.blendFunction.*field.factor); !done)
            return done;
    }
    return {};
}

constexpr Word<SpecularAmbientOcclusion> kOcclusionWords[] = {
    { "none", SpecularAmbientOcclusion::None },
    { "simple", SpecularAmbientOcclusion::Simple },
    { "bentNormals", SpecularAmbientOcclusion::BentNormals },
};

/// Accepts true and false besides the words: they mean simple and none.
Result<void> readSpecularOcclusion(JsonValue const& value, std::string_view name, MaterialDefinition& out) {
    if (value.kind != JsonValue::Kind::Bool)
        return readEnum(value, name, kOcclusionWords, out.specularAmbientOcclusion);
    out.specularAmbientOcclusion = value.boolean ? SpecularAmbientOcclusion::Simple : SpecularAmbientOcclusion::None;
    return {};
}

// In the order of the guide; domain, fullScreenTriangle, wideLines, halfPrecision and clothDistribution are additions of
// this engine.
constexpr std::array kProperties{
    StateProperty{ "name", readName, [] { return std::string("any text"); } },
    StateProperty{ "domain", readState<&MaterialPackage::domain>, valuesOfMember<&MaterialPackage::domain> },
    StateProperty{ "featureLevel", readFeatureLevel, [] { return std::string("0, 1, 2, 3"); } },
    StateProperty{ "shadingModel", readState<&MaterialPackage::shading>, valuesOfMember<&MaterialPackage::shading> },
    StateProperty{ "flipUV", readSetting<&MaterialDefinition::flipUv>, valuesOfMember<&MaterialDefinition::flipUv> },
    StateProperty{ "quality", readState<&MaterialPackage::quality>, valuesOfMember<&MaterialPackage::quality> },
    StateProperty{ "instanced", readState<&MaterialPackage::instanced>, valuesOfMember<&MaterialPackage::instanced> },
    StateProperty{ "vertexDomainDeviceJittered", readState<&MaterialPackage::vertexDomainDeviceJittered>,
                   valuesOfMember<&MaterialPackage::vertexDomainDeviceJittered> },
    StateProperty{ "vertexDomain", readState<&MaterialPackage::vertexDomain>,
                   valuesOfMember<&MaterialPackage::vertexDomain> },
    StateProperty{ "interpolation", readState<&MaterialPackage::interpolation>,
                   valuesOfMember<&MaterialPackage::interpolation> },
    StateProperty{ "fullScreenTriangle", readSetting<&MaterialDefinition::fullScreenTriangle>,
                   valuesOfMember<&MaterialDefinition::fullScreenTriangle> },
    StateProperty{ "wideLines", readSetting<&MaterialDefinition::wideLines>,
                   valuesOfMember<&MaterialDefinition::wideLines> },
    StateProperty{ "halfPrecision", readSetting<&MaterialDefinition::halfPrecision>,
                   valuesOfMember<&MaterialDefinition::halfPrecision> },
    StateProperty{ "blending", readState<&MaterialPackage::blending>, valuesOfMember<&MaterialPackage::blending> },
    StateProperty{ "blendFunction", readBlendFunction,
                   [] { return "srcRGB, srcA, dstRGB, dstA, each: " + valuesOf<backend::BlendFactor>(); } },
    StateProperty{ "postLightingBlending", readState<&MaterialPackage::postLightingBlending>,
                   valuesOfMember<&MaterialPackage::postLightingBlending> },
    StateProperty{ "transparency", readState<&MaterialPackage::transparency>,
                   valuesOfMember<&MaterialPackage::transparency> },
    StateProperty{ "maskThreshold", readState<&MaterialPackage::maskThreshold>,
                   valuesOfMember<&MaterialPackage::maskThreshold> },
    StateProperty{ "refractionMode", readState<&MaterialPackage::refractionMode>,
                   valuesOfMember<&MaterialPackage::refractionMode> },
    StateProperty{ "refractionType", readState<&MaterialPackage::refractionType>,
                   valuesOfMember<&MaterialPackage::refractionType> },
    StateProperty{ "culling", readState<&MaterialPackage::culling>, valuesOfMember<&MaterialPackage::culling> },
    StateProperty{ "colorWrite", readState<&MaterialPackage::colorWrite>,
                   valuesOfMember<&MaterialPackage::colorWrite> },
    StateProperty{ "depthWrite", readState<&MaterialPackage::depthWrite>,
                   valuesOfMember<&MaterialPackage::depthWrite> },
    StateProperty{ "depthCulling", readState<&MaterialPackage::depthCulling>,
                   valuesOfMember<&MaterialPackage::depthCulling> },
    StateProperty{ "doubleSided", readState<&MaterialPackage::doubleSided>,
                   valuesOfMember<&MaterialPackage::doubleSided> },
    StateProperty{ "alphaToCoverage", readState<&MaterialPackage::alphaToCoverage>,
                   valuesOfMember<&MaterialPackage::alphaToCoverage> },
    StateProperty{ "reflections", readState<&MaterialPackage::reflections>,
                   valuesOfMember<&MaterialPackage::reflections> },
    StateProperty{ "shadowMultiplier", readState<&MaterialPackage::shadowMultiplier>,
                   valuesOfMember<&MaterialPackage::shadowMultiplier> },
    StateProperty{ "transparentShadow", readState<&MaterialPackage::transparentShadow>,
                   valuesOfMember<&MaterialPackage::transparentShadow> },
    StateProperty{ "clearCoatIorChange", readSetting<&MaterialDefinition::clearCoatIorChange>,
                   valuesOfMember<&MaterialDefinition::clearCoatIorChange> },
    StateProperty{ "multiBounceAmbientOcclusion", readSetting<&MaterialDefinition::multiBounceAmbientOcclusion>,
                   valuesOfMember<&MaterialDefinition::multiBounceAmbientOcclusion> },
    StateProperty{ "specularAmbientOcclusion", readSpecularOcclusion, [] { return listOf(kOcclusionWords); } },
    StateProperty{ "specularAntiAliasing", readFilter<&SpecularAntiAliasing::enabled>,
                   valuesOfMember<&SpecularAntiAliasing::enabled> },
    StateProperty{ "specularAntiAliasingVariance", readFilter<&SpecularAntiAliasing::variance>,
                   valuesOfMember<&SpecularAntiAliasing::variance> },
    StateProperty{ "specularAntiAliasingThreshold", readFilter<&SpecularAntiAliasing::threshold>,
                   valuesOfMember<&SpecularAntiAliasing::threshold> },
    StateProperty{ "customSurfaceShading", readSetting<&MaterialDefinition::customSurfaceShading>,
                   valuesOfMember<&MaterialDefinition::customSurfaceShading> },
    StateProperty{ "clothDistribution", readSetting<&MaterialDefinition::clothDistribution>,
                   valuesOfMember<&MaterialDefinition::clothDistribution> },
};

} // namespace

std::span<const StateProperty> stateProperties() { return kProperties; }

} // namespace filament::shader
