// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/ImageTarget.h"

namespace filament_core::engine {

SwapChain ImageTarget::of(uint2 size) {
    if (mChain && mEngine.swapChains.get(mChain).size == size) return mChain;
    destroy();
    mChain = mEngine.createSwapChain({ .size = size, .imageCount = 1, .name = "renderToImage" });
    return mChain;
}

} // namespace filament_core::engine
