// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/ImageWaiter.h"

#include <system_error>
#include <utility>

namespace filament_core::backend::vulkan {

ImageWaiter::ImageWaiter(Device const& device, std::shared_ptr<WindowGate> gate)
        : mDevice(device), mGate(std::move(gate)) {
    if (mGate) mGate->allowed.store(1, std::memory_order_release); // the first image is there
}

ImageWaiter::~ImageWaiter() {
    {
        const std::lock_guard lock(mMutex);
        mEnds = true;
    }
    mChanged.notify_all();
    if (mThread.joinable()) mThread.join();
    if (mGate)
        mGate->allowed.store(WindowGate::kOpen, std::memory_order_release); // nobody waits for a window that went
}

void ImageWaiter::allow(uint64_t presents) {
    if (mGate) mGate->allowed.fetch_add(presents, std::memory_order_acq_rel);
}

void ImageWaiter::allowAnother() {
    const std::lock_guard lock(mMutex);
    if (mHasTurn)
        ++mOwed;
    else
        allow(1);
}

bool ImageWaiter::ask(VkSwapchainKHR swapchain, VkSemaphore acquired) {
    try {
        if (!mThread.joinable()) mThread = std::thread([this] { run(); });
    } catch (std::system_error const&) {
        return false;
    }
    {
        const std::lock_guard lock(mMutex);
        mSwapchain = swapchain;
        mAsked = { .acquired = acquired };
        mAnswer.reset();
        mHasTurn = true;
    }
    mIsAsked = true;
    mChanged.notify_all();
    return true;
}

std::optional<ImageWaiter::Image> ImageWaiter::take(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mMutex);
    if (!mChanged.wait_for(lock, timeout, [&] { return mAnswer.has_value(); })) return std::nullopt;
    mIsAsked = false;
    return std::exchange(mAnswer, std::nullopt);
}

void ImageWaiter::stop() {
    if (!mIsAsked) return;
    std::unique_lock lock(mMutex);
    mIsStopping = true;
    mChanged.wait(lock, [&] { return !mHasTurn; });
    mIsStopping = mIsAsked = false;
    mAnswer.reset();
}

void ImageWaiter::run() {
    std::unique_lock lock(mMutex);
    for (;;) {
        mChanged.wait(lock, [&] { return mHasTurn || mEnds; });
        if (mEnds) return;
        while (!mAnswer && !mIsStopping && !mEnds) {
            Image image = mAsked;
            lock.unlock();
            const uint64_t slice = std::chrono::nanoseconds(kSlice).count();
            image.result = mDevice.fn().vkAcquireNextImageKHR(mDevice.handle(), mSwapchain, slice, image.acquired,
                                                              VK_NULL_HANDLE, &image.index);
            lock.lock();
            if (image.result != VK_TIMEOUT && image.result != VK_NOT_READY) mAnswer = image;
        }
        mHasTurn = false;
        allow(1 +
              std::exchange(
                      mOwed,
                      0)); // whatever the answer: presenting does not wait, since the window is there, changed, or gone
        mChanged.notify_all();
    }
}

} // namespace filament_core::backend::vulkan
