// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Quality.h>

#include "filament_core/values/OptionRows.h"

#include <fmt/format.h>

#include <span>
#include <vector>

namespace filament_core {
namespace {

constexpr std::array<std::string_view, 5> kTableSizes{ "16", "32", "64", "128", "256" };
constexpr std::array<std::string_view, 4> kMapSizes{ "512", "1024", "2048", "4096" };
constexpr std::array<std::string_view, 3> kBands{ "1", "2", "3" }, kAtlasSizes{ "16", "64", "256" };
constexpr std::array<std::string_view, 4> kCascades{ "1", "2", "3", "4" }, kBlurs{ "0", "2", "4", "8" },
        kLayers{ "1", "2", "4", "8" }, kProbes{ "0", "1", "2", "8" };

std::vector<Option> lightingRows() {
    using Q = Quality;
    return { option("specularVisibility", &Q::specularVisibility, "Masking and shadowing of microfacets."),
             option("fresnel", &Q::fresnel, "Reflectance of a microfacet under punctual lights."),
             option("diffuse", &Q::diffuse, "Diffuse lobe under punctual lights."),
             option("energyCompensation", &Q::energyCompensation,
                    "Restores the energy that rough metals lose with a single bounce."),
             option("diffuseCoupling", &Q::diffuseCoupling,
                    "Gives the diffuse lobe only the light that the specular lobe leaves."),
             option("splitSum", &Q::splitSum, "Directional albedo of the specular lobe."),
             option("dfgTableSize", &Q::dfgTableSize, { 16, 256, {}, kTableSizes }, "Texels per side of that table."),
             option("specularLookUps", &Q::specularLookUps, "Samples of the environment for the specular lobe."),
             option("anisotropicLookUps", &Q::anisotropicLookUps, "Samples of the environment for anisotropic lobes."),
             option("diffuseIrradiance", &Q::diffuseIrradiance, "Source of the environment's diffuse light."),
             option("shBands", &Q::shBands, { 1, 3, {}, kBands }, "Bands of spherical harmonics."),
             option("reflectionProbes", &Q::reflectionProbes, { 0, 8, {}, kProbes },
                    "Most reflection probes that light a view."),
             option("shadingPrecision", &Q::shadingPrecision, "Precision of lighting."),
             option("textureFilter", &Q::textureFilter, "Filter of materials' textures.") };
}

std::vector<Option> samplingRows() {
    using Q = Quality;
    return { option("antiAliasing", &Q::antiAliasing, "Smooths edges of the image."),
             option("msaaResolve", &Q::msaaResolve, "How the samples of a pixel become its colour."),
             option("mipBias", &Q::mipBias, "Mip levels of textures with temporal accumulation."),
             option("toneMapping", &Q::toneMapping, "Evaluation of the tone mapper.") };
}

std::vector<Option> shadowRows() {
    using Q = Quality;
    return { option("shadows", &Q::shadows, "Filter of shadow maps."),
             option("shadowMapSize", &Q::shadowMapSize, { 64, 8192, {}, kMapSizes },
                    "Texels per side of a cascade; the most for other lights."),
             option("shadowCascades", &Q::shadowCascades, { 1, 4, {}, kCascades }, "Cascades of the sun."),
             option("shadowAtlasMegabytes", &Q::shadowAtlasMegabytes, { 1, 256, {}, kAtlasSizes },
                    "Memory of all shadow maps."),
             option("shadowBlurTexels", &Q::shadowBlurTexels, { 0, 16, {}, kBlurs },
                    "Half the width of the blur of `vsm` and `evsm`."),
             option("coloredShadows", &Q::coloredShadows, "Transmissive surfaces cast coloured shadows."),
             option("areaLights", &Q::areaLights, "Highlights of rectangles, discs and tubes."),
             option("areaShadows", &Q::areaShadows, "Shadows of rectangles, discs and tubes.") };
}

std::vector<Option> orderRows() {
    using Q = Quality;
    return { option("refraction", &Q::refraction, "What is seen through refractive materials."),
             option("refractionLayers", &Q::refractionLayers, { 1, 8, {}, kLayers },
                    "Refractive objects seen through each other."),
             option("transparency", &Q::transparency, "Order of transparent surfaces."),
             option("transparencyLayers", &Q::transparencyLayers, { 1, 8, {}, kLayers }, "Layers of `peeled`."),
             option("depthPrepass", &Q::depthPrepass, "Draws depth before anything is shaded."),
             option("depthRange", &Q::depthRange, "Direction of depth."),
             option("cameraRelative", &Q::cameraRelative, "Gives shaders positions relative to the camera.") };
}

Quality lowPreset() {
    Quality quality;
    quality.specularVisibility = SpecularVisibility::Fast;
    quality.energyCompensation = false;
    quality.diffuseCoupling = false;
    quality.splitSum = SplitSum::Analytic;
    quality.specularLookUps = SpecularLookUps::Quadratic;
    quality.reflectionProbes = 1;
    quality.anisotropicLookUps = AnisotropicLookUps::One;
    quality.areaLights = AreaLightTerm::RepresentativePoint;
    quality.textureFilter = TextureFilter::Bilinear;
    quality.shadows = ShadowFilter::Pcf2;
    quality.shadowMapSize = 1024;
    return quality;
}

Quality mediumPreset() {
    Quality quality;
    quality.specularVisibility = SpecularVisibility::Fast;
    quality.splitSum = SplitSum::Analytic;
    quality.anisotropicLookUps = AnisotropicLookUps::Three;
    quality.reflectionProbes = 2;
    quality.shadowMapSize = 1024;
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
    quality.areaShadows = AreaShadows::Shape;
    return quality;
}

} // namespace

template <>
std::span<const Option> optionsOf<Quality>() {
    static const std::vector<Option> kOptions = [] {
        std::vector<Option> all;
        for (std::vector<Option> const& rows : { lightingRows(), samplingRows(), shadowRows(), orderRows() })
            all.insert(all.end(), rows.begin(), rows.end());
        return all;
    }();
    return kOptions;
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

std::string toString(Quality const& quality) {
    const Quality defaults;
    std::string text;
    for (Option const& option : optionsOf<Quality>()) {
        const std::string value = optionValue(option, &quality);
        if (value == optionValue(option, &defaults)) continue;
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", option.name, value);
    }
    return text.empty() ? "default" : text;
}

} // namespace filament_core
