// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/ImageTarget.h"

#include <utility>

namespace filament::engine {

ImageTarget::~ImageTarget() {
    if (mChain) mEngine.destroy(mChain);
}

SwapChain ImageTarget::of(uint2 size) {
    if (mChain && mEngine.swapChains.get(mChain).size == size) return mChain;
    if (mChain) mEngine.destroy(std::exchange(mChain, {}));
    mChain = mEngine.createSwapChain({ .size = size, .imageCount = 1, .name = "renderToImage" });
    return mChain;
}

} // namespace filament::engine
