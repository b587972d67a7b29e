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

PassBlock declareShadowTarget(FrameContext const& context, uint32_t size, uint32_t channel) {
    const auto side = static_cast<float>(size);
    const shader::PassUniforms block{ .target = { side, side, 1 / side, 1 / side },
                                      .raster = { 1, static_cast<float>(channel), 0, 0 } };
    return context.blocks->add(std::as_bytes(std::span(&block, 1)));
}

PassShadows declareShadows(FrameContext const& context, framegraph::TextureId maps) {
    if (!maps) return {};
    return { maps, context.blocks->add(std::as_bytes(std::span(context.packet.shadows.uniforms, 1))) };
}

BindGroupHandle passGroup(framegraph::PassContext& pass, FrameContext const& context, PassKind kind, PassBlock target,
                          PassShadows const& shadows) {
    LightingTextures const& light = context.resources.lighting;
    FrameSamplers const& samplers = context.resources.samplers;
    const TextureHandle maps = shadows.maps ? pass.texture(shadows.maps) : context.resources.white;
    const std::array<BindGroupEntry, 6> entries{ {
            context.blocks->entry(shader::kBindingPass, target),
            { .binding = shader::kBindingShadowMaps,
              .texture = maps,
              .sampler = shadows.hasMoments ? samplers.trilinear : samplers.nearest },
            // Without shadows most programs do not read it: any block will do.
            context.blocks->entry(shader::kBindingShadows, shadows.block.bytes > 0 ? shadows.block : target),
            { .binding = shader::kBindingSpecular, .texture = light.specular, .sampler = samplers.trilinear },
            { .binding = shader::kBindingDfg, .texture = light.dfg, .sampler = samplers.bilinear },
            { .binding = shader::kBindingIrradiance, .texture = light.irradiance, .sampler = samplers.bilinear },
    } };
    const BindGroupLayout layout = shader::passGroupLayout(kind);
    return pass.bindGroup(layout, std::span(entries).first(layout.count), "pass");
}

} // namespace filament::passes
