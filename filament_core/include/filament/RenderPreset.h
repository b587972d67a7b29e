// SPDX-License-Identifier: Apache-2.0
/// RenderPreset: settings of a whole view by name: the approximations of shading, which effects run, and how exactly.
///   Use      applyPreset(view, *renderPresetFromName("balanced")); then change what should differ.
///   Scope    sets View::quality and View::samples, and switches bloom and motion blur. What effects look like (how
///            strong, how far), and those that are a matter of taste, stay as they are: grading, fog, depth of field,
///            vignette, ...
///   Demand   as always: an effect runs only if something visible asks for it.
///   Thread: any.   Fails: never.
#pragma once

#include <filament/View.h>

#include <optional>
#include <string_view>

namespace filament {

enum class RenderPreset : uint8_t {
    Fast,      ///< QualityPreset::Low and FXAA
    Balanced,  ///< QualityPreset::Medium, sampled ambient occlusion, bloom, FXAA
    Fine,      ///< QualityPreset::High, ambient occlusion by horizons, reflections of the picture, bloom, TAA
    Cinematic, ///< QualityPreset::Reference, all of that at full resolution, and motion blur
};

void applyPreset(View& view, RenderPreset preset);

/// "fast", "balanced", "fine" and "cinematic".
const char* toString(RenderPreset preset);
std::optional<RenderPreset> renderPresetFromName(std::string_view name);

} // namespace filament
