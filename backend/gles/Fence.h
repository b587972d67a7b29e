// SPDX-License-Identifier: Apache-2.0
/// Fence: a point in the device's work that can be polled or waited for.
///   Thread  the driver thread.
///   Fails   a lost context counts as reached, so that no thread waits forever; Device::lost is set.
#pragma once

#include "backend/gles/Device.h"

#include <utility>

namespace filament_core::backend::gles {

class Fence {
public:
    Fence() = default;
    /// After all work so far.
    explicit Fence(Device& device) : mDevice(&device), mSync(device.gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {}
    ~Fence() {
        if (mSync) mDevice->gl.DeleteSync(mSync);
    }
    Fence(Fence&& other) noexcept : mDevice(other.mDevice), mSync(std::exchange(other.mSync, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(mDevice, other.mDevice);
        std::swap(mSync, other.mSync);
        return *this;
    }

    bool isReached() const { return poll(0) != GL_TIMEOUT_EXPIRED; }
    void wait() const {
        while (poll(kSliceNanoseconds) == GL_TIMEOUT_EXPIRED) {
        }
    }

private:
    static constexpr GLuint64 kSliceNanoseconds = 100'000'000; // some drivers refuse "for ever"

    GLenum poll(GLuint64 nanoseconds) const {
        if (!mSync || mDevice->lost) return GL_ALREADY_SIGNALED;
        const GLenum answer = mDevice->gl.ClientWaitSync(mSync, GL_SYNC_FLUSH_COMMANDS_BIT, nanoseconds);
        if (answer == GL_WAIT_FAILED) mDevice->checkLost();
        return answer;
    }

    Device* mDevice = nullptr;
    GLsync mSync = nullptr;
};

} // namespace filament_core::backend::gles
