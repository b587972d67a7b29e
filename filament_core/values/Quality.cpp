// SPDX-License-Identifier: Apache-2.0
#include <filament/Quality.h>

#include "base/NumberText.h"
#include "base/Result.h"
#include "base/Suggest.h"

#include <algorithm>
#include <array>
#include <vector>

namespace filament {
namespace {

using Words = std::span<const std::string_view>;

// In the order of the enumerators.
constexpr std::string_view kSpecularVisibilities[] = { "correlated", "fast", "uncorrelated" };
constexpr std::string_view kFresnelTerms[] = { "schlick", "exact" };
constexpr std::string_view kDiffuseTerms[] = { "lambert", "disney" };
constexpr std::string_view kBooleans[] = { "off", "on" };
constexpr std::string_view kSplitSums[] = { "table", "analytic" };
constexpr std::string_view kTableSizes[] = { "16", "32", "64", "128", "256" };
constexpr std::string_view kSpecularLookUps[] = { "dominant", "quadratic", "eight", "thirtyTwo" };
constexpr std::string_view kAnisotropicLookUps[] = { "five", "one", "three", "nine" };
constexpr std::string_view kIrradiances[] = { "sphericalHarmonics", "lastSpecularLevel", "cube" };
constexpr std::string_view kRoughnessMappings[] = { "quadratic", "logarithmic", "linear" };
constexpr std::string_view kBands[] = { "1", "2", "3" };
constexpr std::string_view kPositionStorages[] = { "asAuthored", "half", "unorm16" };
constexpr std::string_view kTangentStorages[] = { "snorm16", "snorm8", "float" };
constexpr std::string_view kShadingPrecisions[] = { "full", "half" };
constexpr std::string_view kTextureFilters[] = { "asAuthored", "bilinear", "trilinear", "anisotropic" };
constexpr std::string_view kAntiAliasings[] = { "off", "fxaa", "taa" };
constexpr std::string_view kMsaaResolves[] = { "average", "toneAware" };
constexpr std::string_view kMipBiases[] = { "output", "off", "sharp" };
constexpr std::string_view kBloomResolutions[] = { "half", "quarter" };
constexpr std::string_view kUpscalings[] = { "off", "bilinear", "catmullRom", "edgeAdaptive" };
constexpr std::string_view kToneMappings[] = { "analytic", "table16", "table32", "table64" };
constexpr std::string_view kShadowFilters[] = {
    "pcf3", "off", "hard", "pcf2", "pcf5", "poisson", "pcss", "vsm", "evsm"
};
constexpr std::string_view kMapSizes[] = { "512", "1024", "2048", "4096" };
constexpr std::string_view kCascades[] = { "1", "2", "3", "4" };
constexpr std::string_view kAtlasSizes[] = { "16", "64", "256" };
constexpr std::string_view kBlurs[] = { "0", "2", "4", "8" };
constexpr std::string_view kAreaLightTerms[] = { "ltc", "representativePoint" };
constexpr std::string_view kAmbientOcclusionTerms[] = { "off", "sao", "gtao" };
constexpr std::string_view kAoSamples[] = { "3", "7", "16", "32" };
constexpr std::string_view kAoSlices[] = { "1", "2", "3" };
constexpr std::string_view kAmbientOcclusionResolutions[] = { "half", "full", "checkerboard" };
constexpr std::string_view kRefractionSources[] = { "screen", "environment" };
constexpr std::string_view kRefractionLayers[] = { "1", "2", "4", "8" };
constexpr std::string_view kTransparencyOrders[] = { "sorted", "weighted", "peeled" };
constexpr std::string_view kTransparencyLayers[] = { "1", "2", "4", "8" };
constexpr std::string_view kSsrSteps[] = { "16", "48", "128" };
constexpr std::string_view kContactSteps[] = { "8", "16", "32" };
constexpr std::string_view kDepthPrepasses[] = { "auto", "on", "off" };
constexpr std::string_view kDepthRanges[] = { "reversed", "ordinary" };
constexpr std::string_view kPresets[] = { "low", "medium", "high", "reference" };

template <class E>
const char* wordOf(Words words, E value) {
    return words[static_cast<size_t>(value)].data();
}

template <class E>
std::optional<E> valueOf(Words words, std::string_view name) {
    const auto found = std::ranges::find(words, name);
    return found == words.end() ? std::nullopt : std::optional(static_cast<E>(found - words.begin()));
}

/// How one field of Quality is read and written as a word.
struct Field {
    QualityChoice choice;
    bool (*set)(Quality& quality, Words words, std::string_view value); ///< false: no such value
    std::string (*get)(Quality const& quality, Words words);
    std::string_view range{}; ///< of numbers, for the error; empty: the words are all there is
};

template <auto Member>
constexpr Field enumField(std::string_view name, Words words) {
    using E = std::remove_cvref_t<decltype(std::declval<Quality>().*Member)>;
    return { { name, words },
             [](Quality& quality, Words known, std::string_view value) {
                 const std::optional<E> found = valueOf<E>(known, value);
                 if (found) quality.*Member = *found;
                 return found.has_value();
             },
             [](Quality const& quality, Words known) { return std::string(wordOf(known, quality.*Member)); } };
}

template <auto Member, unsigned Least, unsigned Most>
constexpr Field numberField(std::string_view name, Words words, std::string_view range) {
    using N = std::remove_cvref_t<decltype(std::declval<Quality>().*Member)>;
    return { { name, words },
             [](Quality& quality, Words, std::string_view value) {
                 const std::optional<unsigned> number = numberOf<unsigned>(value);
                 if (!number || *number < Least || *number > Most) return false;
                 quality.*Member = static_cast<N>(*number);
                 return true;
             },
             [](Quality const& quality, Words) { return std::to_string(quality.*Member); },
             range };
}

constexpr std::array kFields{
    enumField<&Quality::specularVisibility>("specularVisibility", kSpecularVisibilities),
    enumField<&Quality::fresnel>("fresnel", kFresnelTerms),
    enumField<&Quality::diffuse>("diffuse", kDiffuseTerms),
    enumField<&Quality::energyCompensation>("energyCompensation", kBooleans),
    enumField<&Quality::diffuseCoupling>("diffuseCoupling", kBooleans),
    enumField<&Quality::splitSum>("splitSum", kSplitSums),
    numberField<&Quality::dfgTableSize, 16, 256>("dfgTableSize", kTableSizes, "a whole number from 16 to 256"),
    enumField<&Quality::specularLookUps>("specularLookUps", kSpecularLookUps),
    enumField<&Quality::anisotropicLookUps>("anisotropicLookUps", kAnisotropicLookUps),
    enumField<&Quality::diffuseIrradiance>("diffuseIrradiance", kIrradiances),
    numberField<&Quality::shBands, 1, 3>("shBands", kBands, "1, 2 or 3"),
    enumField<&Quality::shadingPrecision>("shadingPrecision", kShadingPrecisions),
    enumField<&Quality::textureFilter>("textureFilter", kTextureFilters),
    enumField<&Quality::antiAliasing>("antiAliasing", kAntiAliasings),
    enumField<&Quality::msaaResolve>("msaaResolve", kMsaaResolves),
    enumField<&Quality::mipBias>("mipBias", kMipBiases),
    enumField<&Quality::bloomResolution>("bloomResolution", kBloomResolutions),
    enumField<&Quality::upscale>("upscale", kUpscalings),
    enumField<&Quality::toneMapping>("toneMapping", kToneMappings),
    enumField<&Quality::shadows>("shadows", kShadowFilters),
    numberField<&Quality::shadowMapSize, 64, 8192>("shadowMapSize", kMapSizes, "a whole number from 64 to 8192"),
    numberField<&Quality::shadowCascades, 1, 4>("shadowCascades", kCascades, "1, 2, 3 or 4"),
    numberField<&Quality::shadowAtlasMegabytes, 1, 256>("shadowAtlasMegabytes", kAtlasSizes,
                                                        "a whole number from 1 to 256"),
    numberField<&Quality::shadowBlurTexels, 0, 16>("shadowBlurTexels", kBlurs, "a whole number from 0 to 16"),
    enumField<&Quality::coloredShadows>("coloredShadows", kBooleans),
    enumField<&Quality::areaLights>("areaLights", kAreaLightTerms),
    enumField<&Quality::ao>("ao", kAmbientOcclusionTerms),
    numberField<&Quality::aoSamples, 3, 32>("aoSamples", kAoSamples, "a whole number from 3 to 32"),
    numberField<&Quality::aoSlices, 1, 3>("aoSlices", kAoSlices, "1, 2 or 3"),
    enumField<&Quality::aoResolution>("aoResolution", kAmbientOcclusionResolutions),
    enumField<&Quality::aoBlur>("aoBlur", kBooleans),
    enumField<&Quality::aoBentNormals>("aoBentNormals", kBooleans),
    enumField<&Quality::refraction>("refraction", kRefractionSources),
    numberField<&Quality::refractionLayers, 1, 8>("refractionLayers", kRefractionLayers, "a whole number from 1 to 8"),
    enumField<&Quality::transparency>("transparency", kTransparencyOrders),
    numberField<&Quality::transparencyLayers, 1, 8>("transparencyLayers", kTransparencyLayers,
                                                    "a whole number from 1 to 8"),
    enumField<&Quality::ssr>("ssr", kBooleans),
    numberField<&Quality::ssrSteps, 8, 255>("ssrSteps", kSsrSteps, "a whole number from 8 to 255"),
    numberField<&Quality::contactSteps, 4, 64>("contactSteps", kContactSteps, "a whole number from 4 to 64"),
    enumField<&Quality::depthPrepass>("depthPrepass", kDepthPrepasses),
    enumField<&Quality::depthRange>("depthRange", kDepthRanges),
    enumField<&Quality::cameraRelative>("cameraRelative", kBooleans),
};

Field const* findField(std::string_view name) {
    const auto found = std::ranges::find(kFields, name, [](Field const& field) { return field.choice.name; });
    return found == kFields.end() ? nullptr : &*found;
}

std::string joined(Words words) {
    std::string text;
    for (size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

Quality lowPreset() {
    Quality quality;
    quality.specularVisibility = SpecularVisibility::Fast;
    quality.energyCompensation = false;
    quality.diffuseCoupling = false;
    quality.splitSum = SplitSum::Analytic;
    quality.specularLookUps = SpecularLookUps::Quadratic;
    quality.anisotropicLookUps = AnisotropicLookUps::One;
    quality.areaLights = AreaLightTerm::RepresentativePoint;
    quality.textureFilter = TextureFilter::Bilinear;
    quality.shadows = ShadowFilter::Pcf2;
    quality.shadowMapSize = 1024;
    quality.bloomResolution = BloomResolution::Quarter;
    return quality;
}

Quality mediumPreset() {
    Quality quality;
    quality.specularVisibility = SpecularVisibility::Fast;
    quality.splitSum = SplitSum::Analytic;
    quality.anisotropicLookUps = AnisotropicLookUps::Three;
    quality.shadowMapSize = 1024;
    quality.bloomResolution = BloomResolution::Quarter;
    return quality;
}

Quality referencePreset() {
    Quality quality;
    quality.fresnel = FresnelTerm::Exact;
    quality.dfgTableSize = 256;
    quality.specularLookUps = SpecularLookUps::ThirtyTwo;
    quality.anisotropicLookUps = AnisotropicLookUps::Nine;
    quality.textureFilter = TextureFilter::Anisotropic;
    quality.shadows = ShadowFilter::Pcss;
    quality.shadowMapSize = 4096;
    quality.shadowCascades = 4;
    quality.shadowAtlasMegabytes = 256;
    quality.coloredShadows = true;
    return quality;
}

} // namespace

const char* toString(SpecularVisibility value) { return wordOf(kSpecularVisibilities, value); }
const char* toString(FresnelTerm value) { return wordOf(kFresnelTerms, value); }
const char* toString(DiffuseTerm value) { return wordOf(kDiffuseTerms, value); }
const char* toString(SplitSum value) { return wordOf(kSplitSums, value); }
const char* toString(SpecularLookUps value) { return wordOf(kSpecularLookUps, value); }
const char* toString(AnisotropicLookUps value) { return wordOf(kAnisotropicLookUps, value); }
const char* toString(DiffuseIrradiance value) { return wordOf(kIrradiances, value); }
const char* toString(RoughnessMapping value) { return wordOf(kRoughnessMappings, value); }
const char* toString(PositionStorage value) { return wordOf(kPositionStorages, value); }
const char* toString(TangentStorage value) { return wordOf(kTangentStorages, value); }
const char* toString(ShadingPrecision value) { return wordOf(kShadingPrecisions, value); }
const char* toString(TextureFilter value) { return wordOf(kTextureFilters, value); }
const char* toString(AntiAliasing value) { return wordOf(kAntiAliasings, value); }
const char* toString(MsaaResolve value) { return wordOf(kMsaaResolves, value); }
const char* toString(MipBias value) { return wordOf(kMipBiases, value); }
const char* toString(BloomResolution value) { return wordOf(kBloomResolutions, value); }
const char* toString(Upscaling value) { return wordOf(kUpscalings, value); }
const char* toString(ToneMapping value) { return wordOf(kToneMappings, value); }
const char* toString(ShadowFilter value) { return wordOf(kShadowFilters, value); }
const char* toString(AreaLightTerm value) { return wordOf(kAreaLightTerms, value); }
const char* toString(AmbientOcclusionTerm value) { return wordOf(kAmbientOcclusionTerms, value); }
const char* toString(AmbientOcclusionResolution value) { return wordOf(kAmbientOcclusionResolutions, value); }
const char* toString(RefractionSource value) { return wordOf(kRefractionSources, value); }
const char* toString(TransparencyOrder value) { return wordOf(kTransparencyOrders, value); }
const char* toString(DepthPrepass value) { return wordOf(kDepthPrepasses, value); }
const char* toString(DepthRange value) { return wordOf(kDepthRanges, value); }
const char* toString(QualityPreset value) { return wordOf(kPresets, value); }

std::optional<SpecularVisibility> specularVisibilityFromName(std::string_view name) {
    return valueOf<SpecularVisibility>(kSpecularVisibilities, name);
}
std::optional<FresnelTerm> fresnelTermFromName(std::string_view name) {
    return valueOf<FresnelTerm>(kFresnelTerms, name);
}
std::optional<DiffuseTerm> diffuseTermFromName(std::string_view name) {
    return valueOf<DiffuseTerm>(kDiffuseTerms, name);
}
std::optional<SplitSum> splitSumFromName(std::string_view name) { return valueOf<SplitSum>(kSplitSums, name); }
std::optional<SpecularLookUps> specularLookUpsFromName(std::string_view name) {
    return valueOf<SpecularLookUps>(kSpecularLookUps, name);
}
std::optional<AnisotropicLookUps> anisotropicLookUpsFromName(std::string_view name) {
    return valueOf<AnisotropicLookUps>(kAnisotropicLookUps, name);
}
std::optional<DiffuseIrradiance> diffuseIrradianceFromName(std::string_view name) {
    return valueOf<DiffuseIrradiance>(kIrradiances, name);
}
std::optional<RoughnessMapping> roughnessMappingFromName(std::string_view name) {
    return valueOf<RoughnessMapping>(kRoughnessMappings, name);
}
std::optional<PositionStorage> positionStorageFromName(std::string_view name) {
    return valueOf<PositionStorage>(kPositionStorages, name);
}
std::optional<TangentStorage> tangentStorageFromName(std::string_view name) {
    return valueOf<TangentStorage>(kTangentStorages, name);
}
std::optional<ShadingPrecision> shadingPrecisionFromName(std::string_view name) {
    return valueOf<ShadingPrecision>(kShadingPrecisions, name);
}
std::optional<TextureFilter> textureFilterFromName(std::string_view name) {
    return valueOf<TextureFilter>(kTextureFilters, name);
}
std::optional<ShadowFilter> shadowFilterFromName(std::string_view name) {
    return valueOf<ShadowFilter>(kShadowFilters, name);
}
std::optional<AreaLightTerm> areaLightTermFromName(std::string_view name) {
    return valueOf<AreaLightTerm>(kAreaLightTerms, name);
}
std::optional<AntiAliasing> antiAliasingFromName(std::string_view name) {
    return valueOf<AntiAliasing>(kAntiAliasings, name);
}
std::optional<MsaaResolve> msaaResolveFromName(std::string_view name) {
    return valueOf<MsaaResolve>(kMsaaResolves, name);
}
std::optional<MipBias> mipBiasFromName(std::string_view name) { return valueOf<MipBias>(kMipBiases, name); }
std::optional<BloomResolution> bloomResolutionFromName(std::string_view name) {
    return valueOf<BloomResolution>(kBloomResolutions, name);
}
std::optional<Upscaling> upscalingFromName(std::string_view name) { return valueOf<Upscaling>(kUpscalings, name); }
std::optional<ToneMapping> toneMappingFromName(std::string_view name) {
    return valueOf<ToneMapping>(kToneMappings, name);
}
std::optional<AmbientOcclusionTerm> ambientOcclusionTermFromName(std::string_view name) {
    return valueOf<AmbientOcclusionTerm>(kAmbientOcclusionTerms, name);
}
std::optional<AmbientOcclusionResolution> ambientOcclusionResolutionFromName(std::string_view name) {
    return valueOf<AmbientOcclusionResolution>(kAmbientOcclusionResolutions, name);
}
std::optional<RefractionSource> refractionSourceFromName(std::string_view name) {
    return valueOf<RefractionSource>(kRefractionSources, name);
}
std::optional<TransparencyOrder> transparencyOrderFromName(std::string_view name) {
    return valueOf<TransparencyOrder>(kTransparencyOrders, name);
}
std::optional<DepthPrepass> depthPrepassFromName(std::string_view name) {
    return valueOf<DepthPrepass>(kDepthPrepasses, name);
}
std::optional<DepthRange> depthRangeFromName(std::string_view name) { return valueOf<DepthRange>(kDepthRanges, name); }
std::optional<QualityPreset> qualityPresetFromName(std::string_view name) {
    return valueOf<QualityPreset>(kPresets, name);
}

Quality qualityPreset(QualityPreset preset) {
    switch (preset) {
    case QualityPreset::Low:
        return lowPreset();
    case QualityPreset::Medium:
        return mediumPreset();
    case QualityPreset::High:
        return {};
    case QualityPreset::Reference:
        return referencePreset();
    }
    return {};
}

std::span<const QualityChoice> qualityChoices() {
    static const std::array kChoices = [] {
        std::array<QualityChoice, kFields.size()> choices;
        std::ranges::transform(kFields, choices.begin(), &Field::choice);
        return choices;
    }();
    return kChoices;
}

Result<void> setQuality(Quality& quality, std::string_view name, std::string_view value) {
    Field const* field = findField(name);
    if (!field) {
        return fail(ErrorCode::NotFound, "there is no quality choice '{}'{}", name,
                    suggestion(name, namesOf(qualityChoices())));
    }
    if (field->set(quality, field->choice.values, value)) return {};
    const std::string expected = field->range.empty() ? joined(field->choice.values) : std::string(field->range);
    return fail(ErrorCode::InvalidArgument, "quality choice {}: '{}' is not {}", name, value, expected);
}

std::optional<std::string> qualityValue(Quality const& quality, std::string_view name) {
    Field const* field = findField(name);
    return field ? std::optional(field->get(quality, field->choice.values)) : std::nullopt;
}

std::string toString(Quality const& quality) {
    std::string text;
    for (Field const& field : kFields) {
        const std::string value = field.get(quality, field.choice.values);
        if (value == field.get({}, field.choice.values)) continue;
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", field.choice.name, value);
    }
    return text.empty() ? "default" : text;
}

} // namespace filament
