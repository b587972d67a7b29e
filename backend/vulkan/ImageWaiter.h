// SPDX-License-Identifier: Apache-2.0
/// ImageWaiter: waits for the next image of a swapchain on a thread of its own, so that the driver thread serves other
/// windows while a display has not refreshed, or a hidden window takes nothing.
///   Turns    the swapchain belongs to the waiter from ask() until take() or stop(), otherwise to the driver thread.
///   Thread   the driver thread calls; a thread starts with the first ask(), and ends with the waiter.
///   Waits    take(): as long as it is told. stop(): at most kSlice for the window system.
///   Memory   a thread, whose stack is touched once.
///   Fails    ask(): false if there is no thread; the driver thread then waits itself.
#pragma once

#include "backend/api/WindowGate.h"
#include "backend/vulkan/Device.h"

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace filament_core::backend::vulkan {

class ImageWaiter {
public:
    static constexpr std::chrono::milliseconds kSlice{ 20 };

    struct Image {
        VkResult result = VK_NOT_READY; ///< of vkAcquireNextImageKHR
        uint32_t index = 0;
        VkSemaphore acquired = VK_NULL_HANDLE; ///< signalled if there is an image
    };

    /// `gate`: told of each image; may be null.
    ImageWaiter(Device const& device, std::shared_ptr<WindowGate> gate);
    ~ImageWaiter();
    ImageWaiter(ImageWaiter const&) = delete;
    ImageWaiter& operator=(ImageWaiter const&) = delete;

    bool ask(VkSwapchainKHR swapchain, VkSemaphore acquired);
    bool isAsked() const { return mIsAsked; }
    /// What was asked for, or nothing yet.
    std::optional<Image> take(std::chrono::milliseconds timeout);
    /// Returns the swapchain to the driver thread. The semaphore of ask() may be signalled for an image nobody used.
    void stop();
    /// Nothing was presented and nothing is asked: the next present may come at once. While something is asked: with
    /// that.
    void allowAnother();

private:
    void run();
    void allow(uint64_t presents);

    Device const& mDevice;
    const std::shared_ptr<WindowGate> mGate;
    bool mIsAsked = false; // the driver thread's
    std::mutex mMutex;
    std::condition_variable mChanged;
    bool mHasTurn = false, mIsStopping = false, mEnds = false;
    VkSwapchainKHR mSwapchain = VK_NULL_HANDLE;
    std::optional<Image> mAnswer;
    uint64_t mOwed = 0; ///< presents to allow with the next answer, besides its own
    Image mAsked;
    std::thread mThread;
};

} // namespace filament_core::backend::vulkan
