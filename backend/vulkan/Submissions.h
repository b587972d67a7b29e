// SPDX-License-Identifier: Apache-2.0
/// Submissions: command buffers in flight, and objects that must live until the GPU is done with them.
///   Serial  submissions are numbered consecutively. Work recorded now has recordingSerial(); everything up to
///           finishedSerial() is done.
///   Thread  the driver thread.
///   Memory  kSlots command buffers with a fence each; open() waits for the oldest when all are in flight.
///   Fails   with the VkResult of the call; DEVICE_LOST is permanent.
#pragma once

#include "backend/vulkan/Device.h"

#include <array>
#include <deque>
#include <memory>

namespace filament_core::backend::vulkan {

class Submissions {
public:
    static constexpr size_t kSlots = 4; ///< two frames, and two streams without a frame between them

    explicit Submissions(Device& device) : mDevice(device) {}
    ~Submissions(); ///< waits for the GPU, destroys what was kept
    Submissions(Submissions const&) = delete;
    Submissions& operator=(Submissions const&) = delete;

    VkResult initialize();

    /// Makes commands() recordable, waiting for a free slot if necessary.
    VkResult open();
    bool isOpen() const { return mIsOpen; }
    VkCommandBuffer commands() const { return mSlots[mCurrent].commands; } ///< between open() and submit()
    /// `waits`: before the transfers of this submission; `signals`: when all of it is done. Null: none.
    VkResult submit(VkSemaphore waits = VK_NULL_HANDLE, VkSemaphore signals = VK_NULL_HANDLE);

    uint64_t recordingSerial() const { return mSubmitted + 1; }
    uint64_t finishedSerial() const { return mFinished; }

    /// Finds out what has finished and destroys the objects kept for it; does not wait.
    VkResult poll();
    VkResult wait(uint64_t serial);

    /// Destroys the object when the work recorded so far has finished; at once if there is none.
    void keep(std::unique_ptr<DeviceObject> object);

private:
    struct Slot {
        VkCommandPool pool = VK_NULL_HANDLE;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence fence = VK_NULL_HANDLE;
        uint64_t serial = 0; ///< of its last submission
    };
    struct Kept {
        uint64_t serial = 0;
        std::unique_ptr<DeviceObject> object;
    };

    VkResult initialize(Slot& slot);
    void finish(uint64_t serial);

    Device& mDevice;
    std::array<Slot, kSlots> mSlots; // used in turn
    size_t mCurrent = 0;
    bool mIsOpen = false;
    uint64_t mSubmitted = 0, mFinished = 0;
    std::deque<Kept> mKept; // ascending
};

} // namespace filament_core::backend::vulkan
