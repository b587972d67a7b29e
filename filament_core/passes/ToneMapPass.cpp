// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ToneMapPass.h"

#include <array>

namespace filament::passes {
namespace {

constexpr std::string_view kInputs[] = { "color", "table" };

} // namespace

const FullScreenInterface kToneMapInterface{ .pass = "tone map", .inputs = kInputs };

void addToneMapPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets) {
    ToneMap const& toneMap = context.resources.toneMap;
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = targets.color },
                             FullScreenInput{ .name = "table", .image = toneMap.table } };
    addFullScreenPass(
            graph, context,
            { .name = "tone map", .material = *toneMap.material, .inputs = inputs, .target = targets.output });
}

} // namespace filament::passes
