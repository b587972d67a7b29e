// SPDX-License-Identifier: Apache-2.0
// Morph targets: vertex deltas -> a texture that the vertex stage fetches from.
#include "backend/stream/RecordingGuards.h"
#include "filament_core/engine/EngineImpl.h"

#include <algorithm>
#include <cmath>

namespace filament_core {

using engine::PublicCall;

namespace {

bool isFinite(float3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// How many of position, normal and tangent the targets have, in this order.
uint32_t texelsOf(MorphTargetsDesc const& desc) {
    uint32_t texels = 1;
    for (MorphTargetDesc const& target : desc.targets) {
        if (!target.normals.empty()) texels = std::max(texels, 2u);
        if (!target.tangents.empty()) texels = 3;
    }
    return texels;
}

void checkTarget(MorphTargetDesc const& target, uint32_t vertexCount) {
    const auto fits = [&](std::span<const float3> deltas) { return deltas.empty() || deltas.size() == vertexCount; };
    FILAMENT_ASSERT(fits(target.positions) && fits(target.normals) && fits(target.tangents),
                    "a morph target has one difference for each vertex, or none");
}

/// The texels in the order of shader::kMorphTextureWidth; the last row is padded.
std::vector<float4> texelsFrom(MorphTargetsDesc const& desc, uint32_t texels, uint32_t width) {
    const size_t used = desc.targets.size() * desc.vertexCount * texels;
    std::vector<float4> out((used + width - 1) / width * width, float4(0.0f));
    const auto put = [&](std::span<const float3> deltas, size_t target, uint32_t part) {
        for (size_t vertex = 0; vertex < deltas.size(); ++vertex) {
            if (!isFinite(deltas[vertex])) continue; // counts as 0
            out[(target * desc.vertexCount + vertex) * texels + part] = float4(deltas[vertex], 0.0f);
        }
    };
    for (size_t target = 0; target < desc.targets.size(); ++target) {
        put(desc.targets[target].positions, target, 0);
        put(desc.targets[target].normals, target, 1);
        put(desc.targets[target].tangents, target, 2);
    }
    return out;
}

scene::MinMax reachOf(MorphTargetDesc const& target) {
    scene::MinMax reach{ float3(0.0f), float3(0.0f) };
    for (float3 const& delta : target.positions) {
        if (isFinite(delta)) reach.add(delta);
    }
    return reach;
}

} // namespace

MorphTargets Engine::Impl::createMorphTargets(MorphTargetsDesc const& desc) {
    FILAMENT_ASSERT(desc.vertexCount > 0 && !desc.targets.empty(),
                    "morph targets have vertices, and there is at least one target");
    for (MorphTargetDesc const& target : desc.targets) checkTarget(target, desc.vertexCount);
    engine::Draft draft(morphTargets);
    engine::MorphTargetsState& state = draft.state();
    const uint32_t texels = texelsOf(desc);
    const auto used = static_cast<uint64_t>(desc.targets.size()) * desc.vertexCount * texels;
    const auto width = static_cast<uint32_t>(std::min<uint64_t>(used, shader::kMorphTextureWidth));
    state.targets = { .vertexCount = desc.vertexCount,
                      .targetCount = static_cast<uint32_t>(desc.targets.size()),
                      .texels = texels };
    for (MorphTargetDesc const& target : desc.targets) state.targets.reach.push_back(reachOf(target));
    if ((used + width - 1) / width > device.maxTextureSize) {
        report(fmt::format("morph targets '{}': {} targets of {} vertices exceed the texels of this device: "
                           "they have no effect",
                           desc.name, desc.targets.size(), desc.vertexCount));
        state.targets.targetCount = 0;
        return draft.keep();
    }
    const std::vector<float4> pixels = texelsFrom(desc, texels, width);
    state.texture = createTexture({ .format = Format::RGBA32F,
                                    .width = width,
                                    .height = static_cast<uint32_t>(pixels.size() / width),
                                    .pixels = std::as_bytes(std::span(pixels)),
                                    .name = desc.name });
    state.targets.deltas = textureHandle(state.texture);
    state.name = desc.name;
    return draft.keep();
}

MorphTargets Engine::create(MorphTargetsDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(MorphTargetsDesc)", desc.name);
    return mImpl->orNone("morph targets", desc.name, [&] { return mImpl->createMorphTargets(desc); });
}

} // namespace filament_core
