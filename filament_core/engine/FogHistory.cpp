// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FogHistory.h"

#include <utility>

namespace filament_core::engine {

using namespace backend;

void FogHistory::release() {
    mBytes = 0;
    mIsKept = false;
    for (BufferHandle& buffer : mBuffers)
        if (buffer) mEngine.stream->destroy(mEngine.pending, std::exchange(buffer, {}));
}

void FogHistory::use(uint32_t bytes) {
    if (bytes == 0 || bytes == mBytes) return;
    release();
    for (BufferHandle& buffer : mBuffers) {
        NewHandle made(*mEngine.stream, mEngine.stream->allocateBuffer());
        mEngine.pending.record(CmdCreateBuffer{ made, { bytes, BufferUsage::Storage, "fog history" } });
        buffer = made.keep();
    }
    mBytes = bytes;
}

void FogHistory::keep(uint32_t bytes) {
    mIsKept = bytes > 0;
    if (mIsKept) {
        mIdleFrames = 0;
        mCurrent = 1 - mCurrent;
    } else if (mBytes > 0 && ++mIdleFrames == kIdleFrames) {
        release();
    }
}

} // namespace filament_core::engine
