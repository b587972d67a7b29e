// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Surface.h"

#include "backend/vulkan/Barriers.h"
#include "backend/vulkan/SurfaceFormats.h"

#include <algorithm>
#include <array>

// The structures of surfaces, without the headers of the window systems.
using Display = struct _XDisplay;
using Window = unsigned long;
using VisualID = unsigned long;
#include <vulkan/vulkan_wayland.h>
#include <vulkan/vulkan_xlib.h>

namespace filament_core::backend::vulkan {
namespace {

template <class F>
F instanceFunction(Instance const& instance, const char* name) {
    return reinterpret_cast<F>(vkGetInstanceProcAddr(instance.handle(), name));
}

VkResult createX11(Instance const& instance, uint64_t window, VkSurfaceKHR& surface) {
    auto info = make<VkXlibSurfaceCreateInfoKHR>(VK_STRUCTURE_TYPE_XLIB_SURFACE_CREATE_INFO_KHR);
    info.dpy = static_cast<Display*>(instance.display().handle);
    info.window = static_cast<Window>(window);
    return instanceFunction<PFN_vkCreateXlibSurfaceKHR>(instance, "vkCreateXlibSurfaceKHR")(instance.handle(), &info,
                                                                                            nullptr, &surface);
}

VkResult createWayland(Instance const& instance, uint64_t window, VkSurfaceKHR& surface) {
    auto info = make<VkWaylandSurfaceCreateInfoKHR>(VK_STRUCTURE_TYPE_WAYLAND_SURFACE_CREATE_INFO_KHR);
    info.display = static_cast<wl_display*>(instance.display().handle);
    info.surface = reinterpret_cast<wl_surface*>(window);
    return instanceFunction<PFN_vkCreateWaylandSurfaceKHR>(instance, "vkCreateWaylandSurfaceKHR")(
            instance.handle(), &info, nullptr, &surface);
}

/// The two calls of Vulkan's enumerations.
template <class T, class F>
std::vector<T> enumerate(F&& call) {
    uint32_t count = 0;
    if (call(&count, nullptr) != VK_SUCCESS) return {};
    std::vector<T> list(count);
    if (call(&count, list.data()) < VK_SUCCESS) return {};
    list.resize(count);
    return list;
}

std::string namesOf(std::vector<OutputSpace> const& spaces) {
    std::string names;
    for (const OutputSpace space : spaces) names += (names.empty() ? "" : ", ") + std::string(toString(space));
    return names.empty() ? "none" : names;
}

VkCompositeAlphaFlagBitsKHR compositeAlpha(VkSurfaceCapabilitiesKHR const& capabilities) {
    constexpr std::array kChoices{ VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
                                   VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR,
                                   VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR };
    const auto found =
            std::ranges::find_if(kChoices, [&](auto bit) { return (capabilities.supportedCompositeAlpha & bit) != 0; });
    return found == kChoices.end() ? kChoices[0] : *found;
}

/// What the window is, or what we want where it takes the size of its images.
VkExtent2D extentOf(VkSurfaceCapabilitiesKHR const& capabilities, VkExtent2D wanted) {
    constexpr uint32_t kOurs = 0xFFFFFFFF;
    if (capabilities.currentExtent.width != kOurs) return capabilities.currentExtent;
    return { std::clamp(wanted.width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
             std::clamp(wanted.height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height) };
}

constexpr VkImageSubresourceRange kWhole{ VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 };

VkImageMemoryBarrier barrierOf(VkImage image, VkImageLayout before, VkImageLayout after) {
    auto barrier = make<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.oldLayout = before;
    barrier.newLayout = after;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = kWhole;
    return barrier;
}

} // namespace

// ---------------------------------------------------------------------------------------------- life time

Surface::Surface(Device& device, SurfaceDesc const& desc)
        : mDevice(device), mName(desc.debugName), mMode(desc.presentMode), mSpace(desc.space),
          mPeakNits(desc.peakNits) {}

Result<std::unique_ptr<Surface>> Surface::create(Device& device, SurfaceDesc const& desc) {
    std::unique_ptr<Surface> surface(new Surface(device, desc));
    if (Result<void> opened = surface->open(desc); !opened) return opened.error();
    return surface;
}

Result<void> Surface::open(SurfaceDesc const& desc) {
    Instance const& instance = mDevice.instance();
    const WindowSystem system = instance.display().system;
    if (system == WindowSystem::None) {
        return fail(ErrorCode::Unsupported,
                    "window '{}': the engine was made without a display; set EngineOptions::display", mName);
    }
    const VkResult result = system == WindowSystem::X11 ? createX11(instance, desc.window, mSurface)
                                                        : createWayland(instance, desc.window, mSurface);
    if (result != VK_SUCCESS) return errorFromResult(result, fmt::format("Vulkan: window '{}'", mName));
    VkBool32 isSupported = VK_FALSE;
    PhysicalDevice const& physical = mDevice.physical();
    instance.fn().vkGetPhysicalDeviceSurfaceSupportKHR(physical.handle, physical.queueFamily, mSurface, &isSupported);
    if (!isSupported) {
        return fail(ErrorCode::Unsupported, "window '{}': '{}' cannot present to it; choose another device", mName,
                    mDevice.info().deviceName);
    }
    const std::shared_ptr<WindowGate> gate = findWindowGate(desc.gate);
    if (system == WindowSystem::Wayland && mMode == PresentMode::Fifo && hasMode(VK_PRESENT_MODE_MAILBOX_KHR)) {
        mFrames = FrameCallbacks::create(instance.display().handle, reinterpret_cast<void*>(desc.window), gate);
        if (mFrames) mMode = PresentMode::Mailbox; // in order all the same: the next image comes when it is wanted
    }
    mWaiter.emplace(mDevice, mFrames ? nullptr : gate);
    return {};
}

Surface::~Surface() {
    VolkDeviceTable const& fn = mDevice.fn();
    mWaiter.reset();
    mFrames.reset();
    fn.vkDeviceWaitIdle(mDevice.handle());
    dropImages();
    for (Acquisition const& each : mAcquisitions) fn.vkDestroySemaphore(mDevice.handle(), each.semaphore, nullptr);
    if (mSwapchain != VK_NULL_HANDLE) fn.vkDestroySwapchainKHR(mDevice.handle(), mSwapchain, nullptr);
    if (mSurface != VK_NULL_HANDLE) {
        mDevice.instance().fn().vkDestroySurfaceKHR(mDevice.instance().handle(), mSurface, nullptr);
    }
}

// ---------------------------------------------------------------------------------------------- swapchain

std::vector<VkSurfaceFormatKHR> Surface::offeredFormats() const {
    return enumerate<VkSurfaceFormatKHR>([&](uint32_t* count, VkSurfaceFormatKHR* list) {
        return mDevice.instance().fn().vkGetPhysicalDeviceSurfaceFormatsKHR(mDevice.physical().handle, mSurface, count,
                                                                            list);
    });
}

std::vector<OutputSpace> Surface::spaces() const { return spacesOf(offeredFormats()); }

Result<VkSurfaceFormatKHR> Surface::chooseFormat(Format format) const {
    const std::vector<VkSurfaceFormatKHR> offered = offeredFormats();
    if (const auto found = chooseSurfaceFormat(offered, format, mSpace)) return *found;
    return fail(ErrorCode::Unsupported,
                "window '{}' shows no {} as {}; it has {}: set SwapChainDesc::outputSpace to one of those, which "
                "Engine::outputSpaces() returns",
                mName, formatInfo(format).name, toString(mSpace), namesOf(spacesOf(offered)));
}

/// SMPTE ST 2086 and CTA-861.3: primaries of Rec. 2020, D65, and the brightest pixel.
void Surface::describePeak() const {
    if (mSpace != OutputSpace::Rec2020Pq || !mDevice.physical().hdrMetadata) return;
    auto metadata = make<VkHdrMetadataEXT>(VK_STRUCTURE_TYPE_HDR_METADATA_EXT);
    metadata.displayPrimaryRed = { 0.708f, 0.292f };
    metadata.displayPrimaryGreen = { 0.170f, 0.797f };
    metadata.displayPrimaryBlue = { 0.131f, 0.046f };
    metadata.whitePoint = { 0.3127f, 0.3290f };
    metadata.maxLuminance = metadata.maxContentLightLevel = mPeakNits;
    mDevice.fn().vkSetHdrMetadataEXT(mDevice.handle(), 1, &mSwapchain, &metadata);
}

bool Surface::hasMode(VkPresentModeKHR mode) const {
    const auto modes = enumerate<VkPresentModeKHR>([&](uint32_t* count, VkPresentModeKHR* list) {
        return mDevice.instance().fn().vkGetPhysicalDeviceSurfacePresentModesKHR(mDevice.physical().handle, mSurface,
                                                                                 count, list);
    });
    return std::ranges::find(modes, mode) != modes.end();
}

VkPresentModeKHR Surface::chooseMode() const {
    const VkPresentModeKHR wanted = mMode == PresentMode::Mailbox     ? VK_PRESENT_MODE_MAILBOX_KHR
                                    : mMode == PresentMode::Immediate ? VK_PRESENT_MODE_IMMEDIATE_KHR
                                                                      : VK_PRESENT_MODE_FIFO_KHR;
    return hasMode(wanted) ? wanted : VK_PRESENT_MODE_FIFO_KHR;
}

Result<bool> Surface::rebuild(Format format, VkExtent2D wanted) {
    VolkDeviceTable const& fn = mDevice.fn();
    VkSurfaceCapabilitiesKHR capabilities{};
    VkResult result = mDevice.instance().fn().vkGetPhysicalDeviceSurfaceCapabilitiesKHR(mDevice.physical().handle,
                                                                                        mSurface, &capabilities);
    if (result != VK_SUCCESS) return errorFromResult(result, fmt::format("Vulkan: window '{}'", mName));
    const VkExtent2D extent = extentOf(capabilities, wanted);
    if (extent.width == 0 || extent.height == 0) return false; // minimised
    const Result<VkSurfaceFormatKHR> surfaceFormat = chooseFormat(format);
    if (!surfaceFormat) return surfaceFormat.error();

    auto info = make<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
    info.surface = mSurface;
    // One is shown, one waits to be shown, and one can be drawn to.
    info.minImageCount = std::max(capabilities.minImageCount, 3u);
    if (capabilities.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, capabilities.maxImageCount);
    info.imageFormat = surfaceFormat->format;
    info.imageColorSpace = surfaceFormat->colorSpace;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha = compositeAlpha(capabilities);
    info.presentMode = chooseMode();
    info.clipped = VK_TRUE;
    info.oldSwapchain = mSwapchain;

    mWaiter->stop();
    fn.vkDeviceWaitIdle(mDevice.handle()); // images of the old one may be on their way to the window
    VkSwapchainKHR made = VK_NULL_HANDLE;
    result = fn.vkCreateSwapchainKHR(mDevice.handle(), &info, nullptr, &made);
    // The old one goes in any case: the call retires it even where it fails.
    dropImages();
    if (mSwapchain != VK_NULL_HANDLE) fn.vkDestroySwapchainKHR(mDevice.handle(), mSwapchain, nullptr);
    dropAsked();
    mSwapchain = made;
    if (result == VK_SUCCESS) result = takeImages();
    if (result != VK_SUCCESS) return errorFromResult(result, fmt::format("Vulkan: swapchain of window '{}'", mName));
    describePeak();
    mExtent = extent, mWanted = wanted, mFormat = format;
    mIsStale = false;
    return true;
}

VkResult Surface::takeImages() {
    const auto images = enumerate<VkImage>([&](uint32_t* count, VkImage* list) {
        return mDevice.fn().vkGetSwapchainImagesKHR(mDevice.handle(), mSwapchain, count, list);
    });
    if (images.empty()) return VK_ERROR_OUT_OF_HOST_MEMORY;
    for (VkImage image : images) {
        // A semaphore for each image, not for each frame: no fence tells when presenting has waited for it. It has when
        // the same image can be acquired again.
        const Result<VkSemaphore> drawn = makeSemaphore();
        if (!drawn) return VK_ERROR_OUT_OF_HOST_MEMORY;
        mImages.push_back({ image, *drawn });
        mDevice.setName(VK_OBJECT_TYPE_IMAGE, image, mName);
    }
    return VK_SUCCESS;
}

void Surface::dropImages() {
    for (Image const& each : mImages) mDevice.fn().vkDestroySemaphore(mDevice.handle(), each.drawn, nullptr);
    mImages.clear();
}

// ---------------------------------------------------------------------------------------------- images

Result<VkSemaphore> Surface::makeSemaphore() const {
    const auto info = make<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    VkSemaphore semaphore = VK_NULL_HANDLE;
    const VkResult result = mDevice.fn().vkCreateSemaphore(mDevice.handle(), &info, nullptr, &semaphore);
    if (result != VK_SUCCESS) return errorFromResult(result, fmt::format("Vulkan: window '{}'", mName));
    return semaphore;
}

Result<VkSemaphore> Surface::freeSemaphore(Submissions& submissions) {
    const auto idle = std::ranges::find_if(
            mAcquisitions, [&](Acquisition const& each) { return each.serial <= submissions.finishedSerial(); });
    const uint64_t serial = submissions.recordingSerial(); // of the submission that will wait for it
    if (idle != mAcquisitions.end()) {
        idle->serial = serial;
        return idle->semaphore;
    }
    const Result<VkSemaphore> made = makeSemaphore();
    if (made) mAcquisitions.push_back({ *made, serial });
    return made;
}

void Surface::setSerial(VkSemaphore semaphore, uint64_t serial) {
    for (Acquisition& each : mAcquisitions) {
        if (each.semaphore == semaphore) each.serial = serial;
    }
}

/// Semaphores that the old swapchain may have signalled for images nobody used.
void Surface::dropAsked() {
    std::erase_if(mAcquisitions, [&](Acquisition const& each) {
        if (each.serial == kAsked) mDevice.fn().vkDestroySemaphore(mDevice.handle(), each.semaphore, nullptr);
        return each.serial == kAsked;
    });
}

/// Nothing will be presented.
void Surface::allowAnother() {
    mWaiter->allowAnother();
    if (mFrames) mFrames->allowAnother();
}

/// So that the driver thread need not wait for it when it presents.
void Surface::askForNext(Submissions& submissions) {
    if (mIsStale) return mWaiter->allowAnother();
    const Result<VkSemaphore> acquired = freeSemaphore(submissions);
    if (!acquired) return mWaiter->allowAnother();
    setSerial(*acquired, kAsked);
    if (mWaiter->ask(mSwapchain, *acquired)) return;
    setSerial(*acquired, 0);
    mWaiter->allowAnother();
}

ImageWaiter::Image Surface::nextImage(VkSemaphore acquired) const {
    ImageWaiter::Image image{ .acquired = acquired };
    const uint64_t timeout = std::chrono::nanoseconds(kAcquireTimeout).count();
    image.result = mDevice.fn().vkAcquireNextImageKHR(mDevice.handle(), mSwapchain, timeout, acquired, VK_NULL_HANDLE,
                                                      &image.index);
    return image;
}

Result<std::optional<Surface::Target>> Surface::acquire(Format format, VkExtent2D wanted, Submissions& submissions) {
    const Result<std::optional<Target>> target = tryAcquire(format, wanted, submissions);
    if (!target || !*target) allowAnother();
    return target;
}

Result<std::optional<Surface::Target>> Surface::tryAcquire(Format format, VkExtent2D wanted, Submissions& submissions) {
    const bool isResized = wanted.width != mWanted.width || wanted.height != mWanted.height || format != mFormat;
    mIsStale |= isResized;
    constexpr int kTries = 3; // a window that is being resized may change again at once
    for (int i = 0; i < kTries; ++i) {
        if (mIsStale) {
            const Result<bool> built = rebuild(format, wanted);
            if (!built) return built.error();
            if (!*built) return std::optional<Target>{};
        }
        ImageWaiter::Image image;
        if (mWaiter->isAsked()) {
            const auto taken = mWaiter->take(kAcquireTimeout);
            if (!taken) return std::optional<Target>{}; // the waiter continues
            image = *taken;
            setSerial(image.acquired, submissions.recordingSerial());
        } else {
            const Result<VkSemaphore> acquired = freeSemaphore(submissions);
            if (!acquired) return acquired.error();
            image = nextImage(*acquired);
        }
        Target target{ .extent = mExtent, .index = image.index, .acquired = image.acquired };
        const VkResult result = image.result;
        if (result == VK_SUBOPTIMAL_KHR) mIsStale = true; // the image is there, and fits the next time
        if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) {
            target.image = mImages[target.index].image;
            target.drawn = mImages[target.index].drawn;
            return std::optional(target);
        }
        setSerial(image.acquired, 0); // nobody signals it
        if (result == VK_TIMEOUT || result == VK_NOT_READY) return std::optional<Target>{};
        if (result != VK_ERROR_OUT_OF_DATE_KHR) {
            return errorFromResult(result, fmt::format("Vulkan: image of window '{}'", mName));
        }
        mIsStale = true;
    }
    return std::optional<Target>{};
}

void Surface::recordCopy(VkCommandBuffer commands, VkImage source, VkExtent2D extent, Target const& target) const {
    VolkDeviceTable const& fn = mDevice.fn();
    constexpr VkImageLayout kWritten = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkImageMemoryBarrier barrier = barrierOf(target.image, VK_IMAGE_LAYOUT_UNDEFINED, kWritten);
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    // From the transfer stage, at which the submission waits for the image: the layout must not change before that.
    fn.vkCmdPipelineBarrier(commands, kTransfer, kTransfer, 0, 0, nullptr, 0, nullptr, 1, &barrier);

    if (extent.width < target.extent.width || extent.height < target.extent.height) {
        constexpr VkClearColorValue kBlack{ { 0, 0, 0, 1 } };
        fn.vkCmdClearColorImage(commands, target.image, kWritten, &kBlack, 1, &kWhole);
        barrier = barrierOf(target.image, kWritten, kWritten);
        barrier.srcAccessMask = barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        fn.vkCmdPipelineBarrier(commands, kTransfer, kTransfer, 0, 0, nullptr, 0, nullptr, 1, &barrier);
    }
    VkImageBlit blit{}; // of one texel to one: only the order of the channels may change
    blit.srcSubresource = blit.dstSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1 };
    blit.srcOffsets[1] =
            blit.dstOffsets[1] = { static_cast<int32_t>(std::min(extent.width, target.extent.width)),
                                   static_cast<int32_t>(std::min(extent.height, target.extent.height)), 1 };
    fn.vkCmdBlitImage(commands, source, infoOf(Use::TransferRead).layout, target.image, kWritten, 1, &blit,
                      VK_FILTER_NEAREST);

    barrier = barrierOf(target.image, kWritten, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    fn.vkCmdPipelineBarrier(commands, kTransfer, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr, 0, nullptr, 1,
                            &barrier);
}

VkResult Surface::present(Target const& target, Submissions& submissions) {
    auto info = make<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &target.drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &mSwapchain;
    info.pImageIndices = &target.index;
    if (mFrames) mFrames->request();
    const VkResult result = mDevice.fn().vkQueuePresentKHR(mDevice.queue(), &info);
    mIsStale |= result != VK_SUCCESS; // suboptimal, out of date, or the window is gone: the next acquire() finds out
    if (result < VK_SUCCESS && mFrames) mFrames->allowAnother(); // nothing was committed
    askForNext(submissions);
    return result;
}

} // namespace filament_core::backend::vulkan
