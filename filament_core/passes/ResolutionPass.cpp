// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ResolutionPass.h"

#include "filament_core/passes/FullScreenPass.h"

#include <algorithm>
#include <array>

namespace filament_core::passes {
namespace {

using framegraph::FrameGraph;

constexpr std::string_view kResolutionInputs[] = { "picture" };
constexpr FullScreenParameter kUpscalingValues[] = { { "texelsPerPixel", ParameterType::Float2 },
                                                     { "grainStrength", ParameterType::Float },
                                                     { "grainSize", ParameterType::Float } };
constexpr FullScreenInterface kUpscaling{ .pass = "upscaling",
                                          .inputs = kResolutionInputs,
                                          .values = kUpscalingValues };
constexpr FullScreenParameter kSharpeningValues[] = { { "strength", ParameterType::Float },
                                                      { "grainStrength", ParameterType::Float },
                                                      { "grainSize", ParameterType::Float } };
constexpr FullScreenInterface kSharpening{ .pass = "sharpening",
                                           .inputs = kResolutionInputs,
                                           .values = kSharpeningValues };

} // namespace

// Along edges: Lottes 2021, AMD FidelityFX Super Resolution 1, EASU.
void addUpscalingPass(FrameGraph& graph, FrameContext const& context, PictureStep const& step, LastStep const& last) {
    const auto filter =
            static_cast<int32_t>(std::max(context.settings().effects.resolution.upscaling, Upscaling::Bilinear));
    const std::array constants{ EffectConstant{ "filterKind", filter },
                                EffectConstant{ "isSceneLinear", last.isSceneLinear },
                                EffectConstant{ "dither", last.dithers }, EffectConstant{ "grain", last.hasGrain } };
    const std::array inputs{ FullScreenInput{ .name = "picture", .texture = step.picture } };
    Grain const& grain = context.settings().effects.grain;
    const float2 ratio = float2(sizeOf(graph, step.picture)) / float2(sizeOf(graph, step.target));
    const std::array values{ FullScreenValue{ "texelsPerPixel", ratio },
                             FullScreenValue{ "grainStrength", grain.strength },
                             FullScreenValue{ "grainSize", grain.size } };
    addFullScreenPass(graph, context,
                      { .name = "upscaling",
                        .material = context.resources.effects->get("upscale", constants, kUpscaling),
                        .inputs = inputs,
                        .values = values,
                        .target = step.target });
}

// Lottes 2021, AMD FidelityFX Super Resolution 1, RCAS.
void addSharpeningPass(FrameGraph& graph, FrameContext const& context, PictureStep const& step, LastStep const& last) {
    const std::array constants{ EffectConstant{ "isSceneLinear", last.isSceneLinear },
                                EffectConstant{ "dither", last.dithers }, EffectConstant{ "grain", last.hasGrain } };
    const std::array inputs{ FullScreenInput{ .name = "picture", .texture = step.picture } };
    Effects const& effects = context.settings().effects;
    const std::array values{ FullScreenValue{ "strength", effects.sharpening.strength },
                             FullScreenValue{ "grainStrength", effects.grain.strength },
                             FullScreenValue{ "grainSize", effects.grain.size } };
    addFullScreenPass(graph, context,
                      { .name = "sharpening",
                        .material = context.resources.effects->get("sharpen", constants, kSharpening),
                        .inputs = inputs,
                        .values = values,
                        .target = step.target });
}

} // namespace filament_core::passes
