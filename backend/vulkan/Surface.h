// SPDX-License-Identifier: Apache-2.0
/// Surface: a window, and the swapchain that images are copied to. The swapchain follows the size of the window, and of
/// what is presented where the window system leaves that to us (Wayland).
///   Thread  the driver thread.
///   Format  SurfaceFormats.h: what is copied is encoded. Displays of HDR10 are told of the peak (VK_EXT_hdr_metadata).
///   Waits   the app thread waits for the window system (WindowGate), while an ImageWaiter does here. acquire() waits
///           at most kAcquireTimeout, for an app that does not; a new swapchain, and the end, for the device.
///   Fails   create(), acquire(): Unsupported, OutOfMemory or Internal, with the name of the window.
#pragma once

#include "backend/api/FrameCallbacks.h"
#include "backend/vulkan/ImageWaiter.h"
#include "backend/vulkan/Submissions.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::backend::vulkan {

class Surface {
public:
    static constexpr std::chrono::milliseconds kAcquireTimeout{ 250 };

    static Result<std::unique_ptr<Surface>> create(Device& device, SurfaceDesc const& desc);
    ~Surface();
    Surface(Surface const&) = delete;
    Surface& operator=(Surface const&) = delete;

    /// An image of the window, which belongs to us until present().
    struct Target {
        VkImage image = VK_NULL_HANDLE;
        VkExtent2D extent{};
        uint32_t index = 0;
        VkSemaphore acquired = VK_NULL_HANDLE; ///< the submission that draws to it waits for this
        VkSemaphore drawn = VK_NULL_HANDLE;    ///< and signals this
    };
    /// None: the window shows nothing now, or the window system took too long.
    Result<std::optional<Target>> acquire(Format format, VkExtent2D wanted, Submissions& submissions);
    /// Records the copy of a texture, which Barriers has made Use::TransferRead, and black where it does not reach.
    void recordCopy(VkCommandBuffer commands, VkImage source, VkExtent2D extent, Target const& target) const;
    /// Negative: the window did not take it. A window that has changed gets a new swapchain next time.
    VkResult present(Target const& target, Submissions& submissions);

    /// What the window offers; none: it cannot be asked.
    std::vector<OutputSpace> spaces() const;

    bool isReported = false; ///< a failure was told already

private:
    /// A semaphore that acquire() signals; free again once the submission that waited for it has finished.
    static constexpr uint64_t kAsked = ~uint64_t{ 0 };
    struct Acquisition {
        VkSemaphore semaphore = VK_NULL_HANDLE;
        uint64_t serial = 0; ///< kAsked: the waiter has it, of no submission yet
    };
    struct Image {
        VkImage image = VK_NULL_HANDLE;
        VkSemaphore drawn = VK_NULL_HANDLE;
    };

    Surface(Device& device, SurfaceDesc const& desc);
    Result<void> open(SurfaceDesc const& desc);
    /// False: there is nothing to draw to now.
    Result<bool> rebuild(Format format, VkExtent2D wanted);
    std::vector<VkSurfaceFormatKHR> offeredFormats() const;
    Result<VkSurfaceFormatKHR> chooseFormat(Format format) const;
    void describePeak() const;
    bool hasMode(VkPresentModeKHR mode) const;
    VkPresentModeKHR chooseMode() const;
    VkResult takeImages();
    void dropImages();
    Result<VkSemaphore> freeSemaphore(Submissions& submissions);
    void setSerial(VkSemaphore semaphore, uint64_t serial);
    void askForNext(Submissions& submissions);
    void allowAnother();
    void dropAsked();
    Result<std::optional<Target>> tryAcquire(Format format, VkExtent2D wanted, Submissions& submissions);
    ImageWaiter::Image nextImage(VkSemaphore acquired) const;
    Result<VkSemaphore> makeSemaphore() const;

    Device& mDevice;
    std::string mName;
    PresentMode mMode;
    OutputSpace mSpace;
    float mPeakNits;
    VkSurfaceKHR mSurface = VK_NULL_HANDLE;
    VkSwapchainKHR mSwapchain = VK_NULL_HANDLE;
    VkExtent2D mExtent{}, mWanted{}; ///< of the swapchain; of what was presented to it
    Format mFormat = Format::None;   ///< of what was presented to it
    bool mIsStale = true;            ///< the swapchain no longer fits the window
    std::vector<Image> mImages;
    std::vector<Acquisition> mAcquisitions;
    std::optional<ImageWaiter> mWaiter;      ///< once the window is open
    std::unique_ptr<FrameCallbacks> mFrames; ///< of Wayland, instead of the waits of Fifo
};

} // namespace filament_core::backend::vulkan
