// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ToneMapPass.h"

#include <array>

namespace filament::passes {
namespace {

constexpr std::string_view kInputs[] = { "color", "table" };
constexpr FullScreenInterface kInterface{ .pass = "tone map", .inputs = kInputs };

scene::Material const& materialOf(FrameContext const& context) {
    ColorGrading const& grading = context.view->colorGrading;
    const bool hasTable = static_cast<bool>(context.resources.toneTable);
    const std::array constants{
        EffectConstant{ "dither", grading.dither }, EffectConstant{ "fromTable", hasTable },
        EffectConstant{ "toneMapper", hasTable ? 0 : static_cast<int32_t>(grading.toneMapper) } // the table knows it
    };
    return context.resources.effects->get("tonemap", constants, kInterface);
}

} // namespace

void addToneMapPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets) {
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = targets.color },
                             FullScreenInput{ .name = "table", .image = context.resources.toneTable } };
    addFullScreenPass(
            graph, context,
            { .name = "tone map", .material = materialOf(context), .inputs = inputs, .target = targets.output });
}

} // namespace filament::passes
