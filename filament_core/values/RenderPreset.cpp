// SPDX-License-Identifier: Apache-2.0
#include <filament/RenderPreset.h>

#include <algorithm>
#include <array>

namespace filament {
namespace {

constexpr std::array<const char*, 4> kRenderPresets{ "fast", "balanced", "fine", "cinematic" };

Quality fastQuality() {
    Quality quality = qualityPreset(QualityPreset::Low);
    quality.antiAliasing = AntiAliasing::Fxaa;
    return quality;
}

Quality balancedQuality() {
    Quality quality = qualityPreset(QualityPreset::Medium);
    quality.ao = AmbientOcclusionTerm::Sao;
    quality.antiAliasing = AntiAliasing::Fxaa;
    return quality;
}

Quality fineQuality() {
    Quality quality = qualityPreset(QualityPreset::High);
    quality.shadowCascades = 3;
    quality.ao = AmbientOcclusionTerm::Gtao;
    quality.ssr = true;
    quality.antiAliasing = AntiAliasing::Taa;
    return quality;
}

Quality cinematicQuality() {
    Quality quality = qualityPreset(QualityPreset::Reference);
    quality.ao = AmbientOcclusionTerm::Gtao;
    quality.aoSlices = 3;
    quality.aoResolution = AmbientOcclusionResolution::Full;
    quality.aoBentNormals = true;
    quality.refractionLayers = 3;
    quality.ssr = true;
    quality.ssrSteps = 128;
    quality.contactSteps = 32;
    quality.antiAliasing = AntiAliasing::Taa;
    return quality;
}

Quality qualityOf(RenderPreset preset) {
    switch (preset) {
    case RenderPreset::Fast:
        return fastQuality();
    case RenderPreset::Balanced:
        return balancedQuality();
    case RenderPreset::Fine:
        return fineQuality();
    case RenderPreset::Cinematic:
        return cinematicQuality();
    }
    return {};
}

} // namespace

void applyPreset(View& view, RenderPreset preset) {
    view.quality = qualityOf(preset);
    view.samples = 1;
    view.effects.bloom.enabled = preset != RenderPreset::Fast;
    view.effects.motionBlur.enabled = preset == RenderPreset::Cinematic;
}

const char* toString(RenderPreset preset) { return kRenderPresets[static_cast<size_t>(preset)]; }

std::optional<RenderPreset> renderPresetFromName(std::string_view name) {
    const auto found = std::ranges::find(kRenderPresets, name);
    if (found == kRenderPresets.end()) return std::nullopt;
    return static_cast<RenderPreset>(found - kRenderPresets.begin());
}

} // namespace filament
