// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/ShadowTexture.h"

#include <utility>

namespace filament_core::engine {

using namespace backend;

void ShadowTexture::beginAnew() {
    mHeld.size = 0;
    mHeld.maps.clear();
}

void ShadowTexture::release() {
    beginAnew();
    mSize = 0;
    for (TextureHandle* texture : { &mDepths, &mMoments }) {
        if (*texture) mEngine.stream->destroy(mEngine.pending, std::exchange(*texture, {}));
    }
}

TextureHandle ShadowTexture::create(DeviceTextureDesc const& desc) {
    NewHandle texture(*mEngine.stream, mEngine.stream->allocateTexture());
    mEngine.pending.record(CmdCreateTexture{ texture, desc });
    return texture.keep();
}

void ShadowTexture::use(prepare::ShadowPacket const& shadows) {
    const bool isAlike = shadows.atlasSize == mSize && shadows.moments == mKind && shadows.hasStencil == mHasStencil;
    if (shadows.maps.empty() || isAlike) return;
    release();
    mDepths = create({ .format = shadows.hasStencil ? Format::D32FS8 : Format::D32F,
                       .usage = TextureUsage::Sampled | TextureUsage::DepthAttachment,
                       .width = shadows.atlasSize,
                       .height = shadows.atlasSize,
                       .debugName = "shadow maps" });
    if (shadows.moments != prepare::ShadowMoments::None) {
        mMoments = create({ .format = momentFormat(shadows.moments),
                            .usage = TextureUsage::Sampled | TextureUsage::ColorAttachment,
                            .levels = prepare::kShadowMomentLevels,
                            .width = shadows.atlasSize,
                            .height = shadows.atlasSize,
                            .debugName = "shadow moments" });
    }
    mSize = shadows.atlasSize;
    mKind = shadows.moments;
    mHasStencil = shadows.hasStencil;
}

void ShadowTexture::forget(prepare::ShadowPacket const& shadows) {
    if (shadows.drawn > 0) mHeld.maps.clear();
}

void ShadowTexture::keep(prepare::ShadowPacket const& shadows) {
    if (shadows.maps.empty()) {
        // Not at once: shadows that are switched off and on again would allocate the atlas each time.
        if (mDepths && ++mIdleFrames == kIdleFrames) release();
        return;
    }
    mIdleFrames = 0;
    mHeld.size = shadows.atlasSize;
    mHeld.moments = shadows.moments;
    mHeld.hasStencil = shadows.hasStencil;
    mHeld.maps.clear();
    for (prepare::ShadowMapPacket const& map : shadows.maps) mHeld.maps.push_back(map.held);
}

} // namespace filament_core::engine
