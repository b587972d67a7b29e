// SPDX-License-Identifier: Apache-2.0
/// RenderPreset: settings of a whole view by name: approximations of shading, enabled effects, and their accuracy.
///   Use      applyPreset(view, RenderPreset::Balanced); then change what should differ.
///   Scope    sets View::quality, View::samples, switch and exactness of ambient occlusion, screen-space reflections,
///            contact shadows and bloom, and the switch of motion blur. How effects look (strength, radius), and those
///            that are a matter of taste, stay as they are: grading, fog, depth of field, vignette, ...
///   Thread: any.   Fails: never.
#pragma once

#include <filament_core/View.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace filament_core {

enum class RenderPreset : uint8_t {
    Fast,      ///< QualityPreset::Low and FXAA
    Balanced,  ///< QualityPreset::Medium, sampled ambient occlusion, bloom, FXAA
    Fine,      ///< QualityPreset::High, ambient occlusion by horizons, screen-space reflections, bloom, TAA
    Cinematic, ///< QualityPreset::Reference, all of that at full resolution, and motion blur
};

template <>
struct EnumNames<RenderPreset> {
    static constexpr std::array<std::string_view, 4> values{ "fast", "balanced", "fine", "cinematic" };
};

void applyPreset(View& view, RenderPreset preset);

} // namespace filament_core
