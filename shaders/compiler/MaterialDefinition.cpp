// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialDefinition.h"
#include "shaders/compiler/ParameterProperties.h"
#include "shaders/compiler/PropertyReader.h"

#include <algorithm>
#include <array>

namespace filament::shader {
namespace {

/// What the author wrote explicitly, where the default depends on other properties.
struct Explicit {
    bool culling = false, depthWrite = false, shadingModel = false;
};

struct Target {
    MaterialDefinition& definition;
    Explicit& given;
    MaterialPackage& package = definition.package;
};

using Read = Result<void> (*)(JsonValue const&, std::string_view name, Target&);

struct Property {
    std::string_view name;
    Read read;
};

template <bool MaterialPackage::*Member>
Result<void> readState(JsonValue const& value, std::string_view name, Target& to) {
    return readBool(value, name, to.package.*Member);
}

template <bool MaterialDefinition::*Member>
Result<void> readFlag(JsonValue const& value, std::string_view name, Target& to) {
    return readBool(value, name, to.definition.*Member);
}

template <float SpecularAntiAliasing::*Member>
Result<void> readFilter(JsonValue const& value, std::string_view name, Target& to) {
    return readNumber(value, name, 0, 1, to.definition.specularAntiAliasing.*Member);
}

/// A property that is a list has a function of its own (ParameterProperties.h).
template <Result<void> (*ReadList)(JsonValue const&, MaterialDefinition&)>
Result<void> readList(JsonValue const& value, std::string_view, Target& to) {
    return ReadList(value, to.definition);
}

Result<void> readName(JsonValue const& value, std::string_view name, Target& to) {
    const bool isScalar = value.kind != JsonValue::Kind::Array && value.kind != JsonValue::Kind::Object;
    if (!isScalar) return expectKind(value, JsonValue::Kind::String, name);
    to.package.name = value.text;
    return {};
}

Result<void> readShadingModel(JsonValue const& value, std::string_view name, Target& to) {
    for (const std::string_view later : { "subsurface", "cloth", "specularGlossiness" }) {
        if (equalIgnoringCase(value.text, later)) {
            return errorAt(value.at,
                           fmt::format("the shading model {} is known but not supported by this version", later),
                           ErrorCode::Unsupported);
        }
    }
    static constexpr std::pair<std::string_view, ShadingModel> kNames[] = {
        { "lit", ShadingModel::Lit },
        { "unlit", ShadingModel::Unlit },
    };
    to.given.shadingModel = true;
    return readEnum(value, name, kNames, to.package.shading);
}

Result<void> readDomain(JsonValue const& value, std::string_view name, Target& to) {
    static constexpr std::pair<std::string_view, MaterialDomain> kNames[] = {
        { "surface", MaterialDomain::Surface },
        { "postprocess", MaterialDomain::PostProcess },
    };
    return readEnum(value, name, kNames, to.package.domain);
}

Result<void> readBlending(JsonValue const& value, std::string_view name, Target& to) {
    if (equalIgnoringCase(value.text, "custom")) {
        return errorAt(value.at, "custom blending is known but not supported by this version", ErrorCode::Unsupported);
    }
    static constexpr std::pair<std::string_view, Blending> kNames[] = {
        { "opaque", Blending::Opaque }, { "masked", Blending::Masked }, { "transparent", Blending::Transparent },
        { "fade", Blending::Fade },     { "add", Blending::Add },       { "multiply", Blending::Multiply },
        { "screen", Blending::Screen },
    };
    return readEnum(value, name, kNames, to.package.blending);
}

Result<void> readCulling(JsonValue const& value, std::string_view name, Target& to) {
    static constexpr std::pair<std::string_view, Culling> kNames[] = {
        { "none", Culling::None },
        { "front", Culling::Front },
        { "back", Culling::Back },
        { "frontAndBack", Culling::FrontAndBack },
    };
    to.given.culling = true;
    return readEnum(value, name, kNames, to.package.culling);
}

Result<void> readVertexDomain(JsonValue const& value, std::string_view name, Target& to) {
    static constexpr std::pair<std::string_view, VertexDomain> kNames[] = {
        { "object", VertexDomain::Object },
        { "world", VertexDomain::World },
        { "view", VertexDomain::View },
        { "device", VertexDomain::Device },
    };
    return readEnum(value, name, kNames, to.package.vertexDomain);
}

Result<void> readDepthWrite(JsonValue const& value, std::string_view name, Target& to) {
    to.given.depthWrite = true;
    return readBool(value, name, to.package.depthWrite);
}

Result<void> readMaskThreshold(JsonValue const& value, std::string_view name, Target& to) {
    return readNumber(value, name, 0, 1, to.package.maskThreshold);
}

Result<void> readAntiAliasing(JsonValue const& value, std::string_view name, Target& to) {
    return readBool(value, name, to.definition.specularAntiAliasing.enabled);
}

constexpr std::array kProperties{
    Property{ "name", readName },
    Property{ "domain", readDomain },
    Property{ "shadingModel", readShadingModel },
    Property{ "parameters", readList<readParameters> },
    Property{ "constants", readList<readConstants> },
    Property{ "requires", readList<readRequires> },
    Property{ "variables", readList<readVariables> },
    Property{ "variantFilter", readList<readVariantFilter> },
    Property{ "vertexDomain", readVertexDomain },
    Property{ "fullScreenTriangle", readFlag<&MaterialDefinition::fullScreenTriangle> },
    Property{ "halfPrecision", readFlag<&MaterialDefinition::halfPrecision> },
    Property{ "flipUV", readFlag<&MaterialDefinition::flipUv> },
    Property{ "blending", readBlending },
    Property{ "maskThreshold", readMaskThreshold },
    Property{ "culling", readCulling },
    Property{ "colorWrite", readState<&MaterialPackage::colorWrite> },
    Property{ "depthWrite", readDepthWrite },
    Property{ "depthCulling", readState<&MaterialPackage::depthCulling> },
    Property{ "doubleSided", readState<&MaterialPackage::doubleSided> },
    Property{ "specularAntiAliasing", readAntiAliasing },
    Property{ "specularAntiAliasingVariance", readFilter<&SpecularAntiAliasing::variance> },
    Property{ "specularAntiAliasingThreshold", readFilter<&SpecularAntiAliasing::threshold> },
};

/// Properties of the guide that exist, so that "not yet" is told apart from "misspelt".
constexpr std::array<std::string_view, 18> kLaterProperties{ "featureLevel",
                                                             "quality",
                                                             "instanced",
                                                             "vertexDomainDeviceJittered",
                                                             "interpolation",
                                                             "blendFunction",
                                                             "postLightingBlending",
                                                             "transparency",
                                                             "refractionMode",
                                                             "refractionType",
                                                             "alphaToCoverage",
                                                             "reflections",
                                                             "shadowMultiplier",
                                                             "transparentShadow",
                                                             "clearCoatIorChange",
                                                             "multiBounceAmbientOcclusion",
                                                             "specularAmbientOcclusion",
                                                             "customSurfaceShading" };

Error unknownProperty(std::string const& name, JsonValue const& value) {
    if (std::ranges::count(kLaterProperties, name) > 0) {
        return errorAt(value.at, fmt::format("the property '{}' is known but not supported by this version", name),
                       ErrorCode::Unsupported);
    }
    std::vector<std::string_view> known(kLaterProperties.begin(), kLaterProperties.end());
    for (Property const& property : kProperties) known.push_back(property.name);
    return errorAt(value.at, fmt::format("there is no property '{}'{}", name, suggestion(name, known)));
}

Result<void> readProperties(JsonValue const& material, Target& to) {
    std::vector<std::string_view> seen;
    for (auto const& [name, value] : material.members) {
        const auto property = std::ranges::find(kProperties, name, &Property::name);
        if (property == kProperties.end()) return unknownProperty(name, value);
        if (std::ranges::count(seen, name) > 0)
            return errorAt(value.at, fmt::format("the property '{}' is given twice", name));
        seen.push_back(name);
        if (Result<void> done = property->read(value, name, to); !done) return done;
    }
    return {};
}

bool blends(Blending blending) { return blending != Blending::Opaque && blending != Blending::Masked; }

/// Defaults that follow from other properties.
void completeDefaults(Target& to) {
    if (!to.given.depthWrite) to.package.depthWrite = !blends(to.package.blending);
    if (!to.given.culling && to.package.doubleSided) to.package.culling = Culling::None;
    if (to.package.domain == MaterialDomain::PostProcess) {
        if (!to.given.culling) to.package.culling = Culling::None;
        if (!to.given.shadingModel) to.package.shading = ShadingModel::Unlit;
        to.package.vertexDomain = VertexDomain::Device;
    }
    if (to.package.blending == Blending::Masked) {
        to.package.parameters.push_back({ .name = std::string(kMaskThresholdParameter), .type = ParameterType::Float });
        to.definition.parameterSources.push_back({});
    }
}

Result<void> checkTogether(MaterialDefinition const& definition) {
    MaterialPackage const& package = definition.package;
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::InvalidArgument, "{}: {}", definition.fileName, why);
    };
    if (package.domain == MaterialDomain::PostProcess && package.shading == ShadingModel::Lit) {
        return refuse("a material of the domain postprocess cannot be lit");
    }
    if (package.domain == MaterialDomain::PostProcess && definition.vertex) {
        return refuse("a material of the domain postprocess has no vertex block");
    }
    if (package.domain == MaterialDomain::PostProcess &&
        (definition.requiredAttributes != 0 || !definition.variables.empty())) {
        return refuse("a material of the domain postprocess reads no attributes and has no variables");
    }
    if (definition.halfPrecision && package.shading != ShadingModel::Lit) {
        return refuse("halfPrecision is for lit materials: nothing else is computed in 16 bits");
    }
    if (definition.fullScreenTriangle && package.vertexDomain != VertexDomain::Device) {
        return refuse("fullScreenTriangle needs vertexDomain : device");
    }
    return {};
}

} // namespace

Result<MaterialDefinition> defineMaterial(MaterialText text, std::string_view fileName) {
    MaterialDefinition definition;
    definition.fileName = fileName;
    Explicit given;
    Target target{ definition, given };
    if (Result<void> read = readProperties(text.material, target); !read) return read.error();
    if (!text.fragment) return errorAt(text.material.at, "there is no fragment block");
    definition.fragment = std::move(*text.fragment);
    definition.vertex = std::move(text.vertex);
    completeDefaults(target);
    if (Result<void> checked = checkTogether(definition); !checked) return checked.error();
    if (Result<void> laidOut = layOutParameters(definition); !laidOut) return laidOut.error();
    return definition;
}

} // namespace filament::shader
