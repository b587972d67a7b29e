// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/ShareEffects.h"

#include <array>

namespace filament_core::engine {
namespace {

constexpr bool kNever(View const&) { return false; }

constexpr std::array kShareEffects{
    ShareEffect{ "shadows", [](View& view) { view.quality.shadows = ShadowFilter::Off; } },
    ShareEffect{ "ambientOcclusion", [](View& view) { view.effects.ambientOcclusion.enabled = false; } },
    ShareEffect{ "screenSpaceReflections", [](View& view) { view.effects.screenSpaceReflections.enabled = false; } },
    ShareEffect{ "refraction", [](View& view) { view.quality.refraction = RefractionSource::Environment; } },
    ShareEffect{ "fog", [](View& view) { view.effects.fog.enabled = false; } },
    ShareEffect{ "samples", [](View& view) { view.samples = 1; },
                 [](View const& view) { return view.quality.msaaResolve == MsaaResolve::Average; } },
    ShareEffect{ "antiAliasing", [](View& view) { view.quality.antiAliasing = AntiAliasing::Off; },
                 [](View const& view) { return view.quality.antiAliasing == AntiAliasing::Taa; } },
    ShareEffect{ "depthOfField", [](View& view) { view.effects.depthOfField.enabled = false; } },
    ShareEffect{ "motionBlur", [](View& view) { view.effects.motionBlur.enabled = false; } },
    ShareEffect{ "autoExposure", [](View& view) { view.effects.autoExposure.enabled = false; }, kNever },
    ShareEffect{ "bloom", [](View& view) { view.effects.bloom.enabled = false; },
                 [](View const& view) { return view.effects.bloom.threshold <= 0; } },
    ShareEffect{ "lensFlare", [](View& view) { view.effects.lensFlare.enabled = false; }, kNever },
    ShareEffect{ "chromaticAberration", [](View& view) { view.effects.chromaticAberration.enabled = false; } },
    ShareEffect{ "vignette", [](View& view) { view.effects.vignette.enabled = false; } },
    ShareEffect{ "colorGrading", [](View& view) { view.effects.colorGrading.enabled = false; }, kNever },
    ShareEffect{ "resolution", [](View& view) { view.effects.resolution = {}; }, kNever },
    ShareEffect{ "sharpening", [](View& view) { view.effects.sharpening.enabled = false; }, kNever },
};

} // namespace

bool ShareEffect::isIn(View const& view) const {
    View without = view;
    leaveOut(without);
    return without.quality != view.quality || without.effects != view.effects || without.samples != view.samples;
}

std::span<const ShareEffect> shareEffects() { return kShareEffects; }

} // namespace filament_core::engine
