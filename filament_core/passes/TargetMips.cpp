// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/TargetMips.h"

#include "filament_core/passes/FullScreenPass.h"

#include <algorithm>
#include <array>

namespace filament_core::passes {
namespace {

constexpr std::string_view kTargetMipInputs[] = { "picture" };
constexpr FullScreenParameter kTargetMipValues[] = { { "size", ParameterType::Int2 } };
constexpr FullScreenInterface kTargetMip{ .pass = "target mips",
                                          .inputs = kTargetMipInputs,
                                          .values = kTargetMipValues };

int2 sizeOfLevel(FrameOutput const& output, uint32_t level) {
    return { std::max(1u, output.width >> level), std::max(1u, output.height >> level) };
}

} // namespace

void addTargetMips(framegraph::FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                   FrameTargets const& targets) {
    for (uint8_t level = 1; level < output.srgbLevels; ++level) {
        const auto above = static_cast<uint8_t>(level - 1);
        const std::array inputs{ FullScreenInput{
                .name = "picture", .texture = targets.target, .range = backend::oneLevel(above) } };
        const std::array values{ FullScreenValue{ "size", sizeOfLevel(output, above) } };
        addFullScreenPass(graph, context,
                          { .name = "target mips",
                            .material = context.resources.effects->get("srgb_mip", {}, kTargetMip),
                            .inputs = inputs,
                            .values = values,
                            .target = targets.target,
                            .level = level });
    }
}

} // namespace filament_core::passes
