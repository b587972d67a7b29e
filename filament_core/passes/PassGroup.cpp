// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/PassGroup.h"

#include "framegraph/FrameGraph.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>

namespace filament::passes {

using namespace backend;
using shader::PassKind;

PassBlock declareTarget(FrameContext const& context, framegraph::GraphTextureDesc const& texture, uint8_t level,
                        uint8_t samples) {
    const auto width = static_cast<float>(std::max(1u, texture.width >> level));
    const auto height = static_cast<float>(std::max(1u, texture.height >> level));
    const shader::PassUniforms block{ .target = { width, height, 1 / width, 1 / height },
                                      .raster = { samples, 0, 0, 0 } };
    return context.blocks->add(std::as_bytes(std::span(&block, 1)));
}

BindGroupHandle passGroup(framegraph::PassContext& pass, FrameContext const& context, PassKind kind, PassBlock target) {
    LightingTextures const& light = context.resources.lighting;
    FrameSamplers const& samplers = context.resources.samplers;
    const std::array<BindGroupEntry, 4> entries{ {
            context.blocks->entry(shader::kBindingPass, target),
            { .binding = shader::kBindingSpecular, .texture = light.specular, .sampler = samplers.trilinear },
            { .binding = shader::kBindingDfg, .texture = light.dfg, .sampler = samplers.bilinear },
            { .binding = shader::kBindingIrradiance, .texture = light.irradiance, .sampler = samplers.bilinear },
    } };
    const BindGroupLayout layout = shader::passGroupLayout(kind);
    return pass.bindGroup(layout, std::span(entries).first(layout.count), "pass");
}

} // namespace filament::passes
