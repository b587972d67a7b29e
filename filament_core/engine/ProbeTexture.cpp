// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/ProbeTexture.h"

#include <algorithm>
#include <utility>

namespace filament_core::engine {

using namespace backend;

ProbeTexture::ProbeTexture(Engine::Impl& engine) : mEngine(engine) {
    mHeld.hasArrays = engine.stream->info().features.cubeArrays;
}

void ProbeTexture::release() {
    mHeld.cubes = {};
    mHeld.shape = {};
    if (mTexture) mEngine.stream->destroy(mEngine.pending, std::exchange(mTexture, {}));
}

void ProbeTexture::use(prepare::ProbePacket const& probes) {
    if (probes.empty() || (mTexture && probes.shape == mHeld.shape)) return;
    release();
    NewHandle texture(*mEngine.stream, mEngine.stream->allocateTexture());
    mEngine.pending.record(CmdCreateTexture{ texture,
                                             { .type = TextureKind::CubeArray,
                                               .format = probes.shape.format,
                                               .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                               .levels = static_cast<uint8_t>(probes.shape.levels),
                                               .layers = static_cast<uint16_t>(6 * prepare::kProbeLayers),
                                               .width = probes.shape.size,
                                               .height = probes.shape.size,
                                               .debugName = "reflection probes" } });
    mTexture = texture.keep();
    mHeld.shape = probes.shape;
}

void ProbeTexture::copy(prepare::ProbePacket const& probes, CommandBuffer& commands) {
    if (probes.empty()) return;
    const prepare::ProbeCubes held = std::exchange(mHeld.cubes, {});
    for (uint32_t layer = 0; layer < probes.cubes.size(); ++layer) {
        const TextureHandle cube = probes.cubes[layer].texture;
        if (!cube || probes.cubes[layer] == held[layer]) continue;
        for (uint32_t face = 0; face < 6; ++face) {
            for (uint32_t level = 0; level < probes.shape.levels; ++level) {
                const uint32_t size = std::max(1u, probes.shape.size >> level);
                const Rect whole{ 0, 0, size, size };
                commands.record(CmdBlit{ .source = cube,
                                         .target = mTexture,
                                         .sourceLevel = static_cast<uint8_t>(level),
                                         .targetLevel = static_cast<uint8_t>(level),
                                         .sourceLayer = static_cast<uint16_t>(face),
                                         .targetLayer = static_cast<uint16_t>(6 * layer + face),
                                         .sourceRect = whole,
                                         .targetRect = whole });
            }
        }
    }
}

void ProbeTexture::keep(prepare::ProbePacket const& probes) {
    if (probes.empty()) {
        // Not at once: probes that leave the view and come back would be copied each time.
        if (mTexture && ++mIdleFrames == kIdleFrames) release();
        return;
    }
    mIdleFrames = 0;
    mHeld.cubes = probes.cubes;
}

} // namespace filament_core::engine
