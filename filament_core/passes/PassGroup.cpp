// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/PassGroup.h"

#include "filament_core/passes/DepthPass.h"
#include "filament_core/passes/FogLightPass.h"
#include "framegraph/FrameGraph.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <cstring>

namespace filament_core::passes {

using namespace backend;
using shader::PassKind;

namespace {

constexpr uint32_t kViewNumbers = 64; // shaders/material/debug_views.glsl

shader::PassUniforms uniformsOf(FrameContext const& context, float2 size) {
    prepare::LastView const& last = context.packet.last;
    return { .target = { size, 1.0f / size },
             .raster = { 1, 0, 0, 0 },
             .picture = float4(0),
             .reflection = float4(0),
             .lastClipFromWorld = last.clipFromWorld,
             .lastAlongView = last.alongView,
             .lastTime = last.time };
}

shader::PassUniforms uniformsOf(FrameContext const& context, framegraph::GraphTextureDesc const& texture, uint8_t level,
                                uint8_t samples) {
    const auto width = static_cast<float>(std::max(1u, texture.width >> level));
    const auto height = static_cast<float>(std::max(1u, texture.height >> level));
    shader::PassUniforms block = uniformsOf(context, float2(width, height));
    block.raster.x = samples;
    block.raster.w = context.settings().mipBias;
    return block;
}

} // namespace

PassBlock declareTarget(FrameContext const& context, framegraph::GraphTextureDesc const& texture, uint8_t level,
                        uint8_t samples) {
    const shader::PassUniforms block = uniformsOf(context, texture, level, samples);
    return context.blocks->add(std::as_bytes(std::span(&block, 1)));
}

PassBlock declareTargetBeforePicture(FrameContext const& context, framegraph::GraphTextureDesc const& texture,
                                     uint8_t samples, prepare::SceneColorCopy const& copy) {
    const float2 first(copy.rect.x, copy.rect.y), size(copy.rect.width, copy.rect.height);
    shader::PassUniforms block = uniformsOf(context, texture, 0, samples);
    block.raster.z = static_cast<float>(copy.levels - 1);
    block.picture = { first, first + size };
    const ScreenSpaceReflections reflections = context.settings().effects.screenSpaceReflections;
    block.reflection = { reflections.steps, reflections.distanceMeters, reflections.thicknessMeters,
                         pyramidLevels(context.settings().size) - 1 };
    return context.blocks->add(std::as_bytes(std::span(&block, 1)));
}

PassBlock declareDebugTarget(FrameContext const& context, framegraph::GraphTextureDesc const& texture,
                             DebugView debugView, uint8_t samples) {
    static_assert(kDebugViewCount <= kViewNumbers);
    shader::PassUniforms block = uniformsOf(context, texture, 0, samples);
    block.raster.z =
            static_cast<float>(static_cast<uint32_t>(debugView) + (context.settings().givesNumbers ? kViewNumbers : 0));
    return context.blocks->add(std::as_bytes(std::span(&block, 1)));
}

PassBlock declareShadowTarget(FrameContext const& context, uint32_t size, uint32_t channel) {
    shader::PassUniforms block = uniformsOf(context, float2(static_cast<float>(size)));
    block.raster.y = static_cast<float>(channel);
    return context.blocks->add(std::as_bytes(std::span(&block, 1)));
}

PassBlock declareSectionPart(FrameContext const& context, PassBlock of, SectionPart part) {
    shader::PassUniforms block;
    std::memcpy(&block, context.blocks->bytesOf(of).data(), sizeof block);
    block.raster.y = static_cast<float>(part);
    // Drawn by variants for debug views where a pixel has several samples: with the alpha that masks cover them by.
    if (part == SectionPart::FirstSurfaces) block.raster.z = static_cast<float>(DebugView::Coverage);
    return context.blocks->add(std::as_bytes(std::span(&block, 1)));
}

PassShadows declareShadows(FrameContext const& context, framegraph::TextureId maps) {
    if (!maps) return {};
    return { maps, context.blocks->add(std::as_bytes(std::span(context.packet.shadows.uniforms, 1))) };
}

PassBlock declareProbes(FrameContext const& context) {
    if (context.packet.probes.empty()) return {};
    return context.blocks->add(std::as_bytes(std::span(context.packet.probes.uniforms, 1)));
}

void declareReads(framegraph::PassBuilder& pass, PassTextures const& textures) {
    for (const framegraph::TextureId read : { textures.shadows.maps, textures.occlusion, textures.linearDepth })
        if (read) pass.readSampled(read);
    if (textures.sceneColor) pass.readSampled(textures.sceneColor, { .levelCount = textures.sceneColorLevels });
    if (textures.fogCells) pass.readBuffer(textures.fogCells, framegraph::BufferUse::Storage);
}

namespace {

/// All that any kind of material reads, in the order of the layouts.
std::array<BindGroupEntry, 12> allEntries(framegraph::PassContext& pass, FrameContext const& context, PassBlock target,
                                          PassTextures const& textures) {
    LightingTextures const& light = context.resources.lighting;
    FrameSamplers const& samplers = context.resources.samplers;
    PassShadows const& shadows = textures.shadows;
    // Every binding of a layout has something bound, whether a program with these constants reads it or not.
    const auto orWhite = [&](framegraph::TextureId drawn) {
        return drawn ? pass.texture(drawn) : context.resources.white;
    };
    return { {
            context.blocks->entry(shader::kBindingPass, target),
            { .binding = shader::kBindingShadowMaps,
              .texture = orWhite(shadows.maps),
              .sampler = shadows.hasMoments ? samplers.trilinear : samplers.nearest },
            // Without shadows most programs do not read it: any block will do. So it is with probes.
            context.blocks->entry(shader::kBindingShadows, shadows.block.bytes > 0 ? shadows.block : target),
            { .binding = shader::kBindingSpecular,
              .texture = light.probes ? light.probes : light.specular,
              .sampler = samplers.trilinear },
            { .binding = shader::kBindingDfg, .texture = light.dfg, .sampler = samplers.bilinear },
            { .binding = shader::kBindingIrradiance, .texture = light.irradiance, .sampler = samplers.bilinear },
            { .binding = shader::kBindingOcclusion,
              .texture = orWhite(textures.occlusion),
              .sampler = samplers.nearest },
            { .binding = shader::kBindingSceneDepth,
              .texture = orWhite(textures.linearDepth),
              .sampler = samplers.nearestOfLevels },
            { .binding = shader::kBindingFog, .texture = light.specular, .sampler = samplers.trilinear },
            { .binding = shader::kBindingPicture,
              .texture = orWhite(textures.sceneColor),
              .sampler = samplers.trilinear,
              .range = { .levelCount = textures.sceneColorLevels } },
            { .binding = shader::kBindingFogCells,
              .buffer = textures.fogCells ? pass.buffer(textures.fogCells) : context.resources.noFogCells,
              .size = textures.fogCells ? fogCellBytes(context) : uint32_t{ sizeof(float4) } },
            context.blocks->entry(shader::kBindingProbes, textures.probes.bytes > 0 ? textures.probes : target),
    } };
}

} // namespace

BindGroupHandle passGroup(framegraph::PassContext& pass, FrameContext const& context, PassKind kind, PassBlock target,
                          PassTextures const& textures) {
    const auto all = allEntries(pass, context, target, textures);
    const BindGroupLayout layout = shader::passGroupLayout(kind);
    std::array<BindGroupEntry, all.size()> entries;
    size_t count = 0;
    // Both are in ascending order of bindings, so that one pass over them picks what this kind of program reads.
    for (BindGroupEntry const& entry : all) {
        if (count < layout.count && entry.binding == layout.bindings[count].binding) entries[count++] = entry;
    }
    FILAMENT_ASSERT(count == layout.count, "entries are in the order of the layouts");
    return pass.bindGroup(layout, std::span(entries).first(count), "pass");
}

std::array<BindGroupHandle, shader::kSurfaceKinds> surfaceGroups(framegraph::PassContext& pass,
                                                                 FrameContext const& context, PassBlock target,
                                                                 PassTextures const& textures) {
    std::array<BindGroupHandle, shader::kSurfaceKinds> groups;
    for (size_t kind = 0; kind < groups.size(); ++kind)
        groups[kind] = passGroup(pass, context, static_cast<PassKind>(kind), target, textures);
    return groups;
}

} // namespace filament_core::passes
