// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameTarget.h"

#include <algorithm>

namespace filament_core::engine {

uint2 FrameTarget::size() const {
    return { std::max(1u, color.desc.width >> level()), std::max(1u, color.desc.height >> level()) };
}

void FrameTarget::keepContents(Engine::Impl& engine) const {
    color.hasContents = true;
    if (state) state->hasContents = true;
    if (state && isPart()) {
        engine.renderTargets.forEachHeld([&](RenderTarget, RenderTargetState& other) { // several may draw to one part
            if (other.color == state->color && other.level == level() && other.layer == layer())
                other.hasContents = true;
        });
    }
    if (depth && (!isAlone || meshes)) depth->hasContents = true;
    if (!isAlone) return;
    for (const Texture other : state->others) engine.textures.held(other).hasContents = true;
}

FrameTarget targetOf(Engine::Impl& engine, RenderTarget target) {
    RenderTargetState& state = engine.renderTargets.get(target);
    return { .color = engine.textures.held(state.color),
             .depth = state.depth ? &engine.textures.held(state.depth) : nullptr,
             .state = &state };
}

passes::FrameOutput outputOf(FrameTarget const& target) {
    TextureState const& color = target.color;
    const uint2 size = target.size();
    passes::FrameOutput output{ .texture = color.handle,
                                .width = size.x,
                                .height = size.y,
                                .format = backend::attachmentFormat(color.desc.format),
                                .hasContents = color.hasContents };
    if (target.isPart()) {
        output.part = { .isOne = true,
                        .kind = color.desc.type,
                        .width = color.desc.width,
                        .height = color.desc.height,
                        .level = target.level(),
                        .levels = color.desc.levels,
                        .layer = target.layer(),
                        .layers = color.desc.layers };
        output.hasContents = target.state->hasContents;
    }
    if (target.generatesMips() && target.isSrgb()) output.srgbLevels = static_cast<uint8_t>(color.desc.levels);
    if (target.depth) output.depth = target.depth->handle, output.hasDepths = target.depth->hasContents;
    return output;
}

std::array<passes::FrameOutput, kMostOthers> otherOutputsOf(Engine::Impl& engine, FrameTarget const& target) {
    std::array<passes::FrameOutput, kMostOthers> outputs;
    for (size_t i = 0; target.state && i < target.state->others.size(); ++i)
        outputs[i] = outputOf({ .color = engine.textures.held(target.state->others[i]) });
    return outputs;
}

std::array<backend::TextureHandle, kMostOthers + 2> texturesOf(Engine::Impl& engine, FrameTarget const& target) {
    std::array<backend::TextureHandle, kMostOthers + 2> textures{ target.color.handle };
    if (target.depth) textures[1] = target.depth->handle;
    for (size_t i = 0; target.isAlone && i < target.state->others.size(); ++i)
        textures[i + 2] = engine.textures.held(target.state->others[i]).handle;
    return textures;
}

scene::MaterialInstance const* samplerOf(prepare::FramePacket const& packet, FrameTarget const& target) {
    const auto samples = [&](prepare::DrawCall const& draw) {
        return std::ranges::any_of(draw.material->textures, [&](scene::TextureBinding const& bound) {
            return bound.texture == target.color.handle || (target.depth && bound.texture == target.depth->handle);
        });
    };
    for (prepare::ViewPacket const& view : packet.views) {
        for (const std::span<const prepare::DrawCall> draws : { view.opaque, view.blended }) {
            const auto found = std::ranges::find_if(draws, samples);
            if (found != draws.end()) return found->material;
        }
    }
    return nullptr;
}

Error samplesTarget(scene::MaterialInstance const& material, FrameTarget const& target) {
    return fail(ErrorCode::InvalidArgument,
                "a frame is left out: material '{}' samples '{}', which the frame draws to; draw to another render "
                "target, or hide what has the material by View::visibleLayers",
                material.name.empty() ? material.material->name : material.name, target.color.name);
}

Error dirtIsTarget(FrameTarget const& target) {
    return fail(ErrorCode::InvalidArgument,
                "a frame is left out: the dirt of bloom is '{}', which the frame draws to; draw to another render "
                "target",
                target.color.name);
}

} // namespace filament_core::engine
