// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ResolvePass.h"

#include "base/math/Elementary.h"
#include "filament_core/passes/FullScreenPass.h"

#include <array>

namespace filament_core::passes {
namespace {

constexpr std::string_view kResolveInputs[] = { "samples" };
constexpr FullScreenParameter kResolveValues[] = { { "perHalfWhite", ParameterType::Float } };
constexpr FullScreenInterface kResolve{ .pass = "msaa resolve", .inputs = kResolveInputs, .values = kResolveValues };

} // namespace

float halfWhiteOf(FrameContext const& context) {
    // Samples are weighed by what they display, so that a bright one does not outshine the others: Karis 2013, "Tone
    // Mapping".
    const float half = context.settings().display.halfWhiteLight;
    const bool isGraded = context.packet.demand.needs(prepare::Effect::ColorGrading);
    return isGraded ? half * elementary::exp2(-context.settings().effects.colorGrading.exposure) : half;
}

void addResolvePass(framegraph::FrameGraph& graph, FrameContext const& context, framegraph::TextureId samples,
                    framegraph::TextureId color) {
    const std::array constants{ EffectConstant{ "sampleCount", int32_t{ context.settings().samples } },
                                EffectConstant{ "isTranslucent", context.settings().isTranslucent() } };
    const std::array inputs{ FullScreenInput{ .name = "samples", .texture = samples } };
    const std::array values{ FullScreenValue{ "perHalfWhite", 1 / halfWhiteOf(context) } };
    addFullScreenPass(graph, context,
                      { .name = "msaa resolve",
                        .material = context.resources.effects->get("msaa_resolve", constants, kResolve),
                        .inputs = inputs,
                        .values = values,
                        .target = color });
}

} // namespace filament_core::passes
