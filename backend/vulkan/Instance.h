// SPDX-License-Identifier: Apache-2.0
/// Instance: the loader, the instance and the validation messenger.
///   Thread  create(): any, also several at once. After that one thread at a time.
///   Fails   DeviceUnavailable without a loader, without Vulkan 1.1 or without any driver.
///               Unsupported if the loader knows no surfaces of the display.
///   Validation  if requested but not installed: one ResultSink::onError, and no validation.
#pragma once

#include "backend/api/Driver.h"
#include "backend/vulkan/Api.h"

#include <memory>
#include <vector>

namespace filament_core::backend::vulkan {

/// The functions that we call on the instance and its physical devices. Those of surfaces are null without a display,
/// those of debug utils without validation.
struct InstanceFunctions {
    PFN_vkDestroyInstance vkDestroyInstance = nullptr;
    PFN_vkEnumeratePhysicalDevices vkEnumeratePhysicalDevices = nullptr;
    PFN_vkGetPhysicalDeviceProperties2 vkGetPhysicalDeviceProperties2 = nullptr;
    PFN_vkGetPhysicalDeviceFeatures2 vkGetPhysicalDeviceFeatures2 = nullptr;
    PFN_vkGetPhysicalDeviceMemoryProperties vkGetPhysicalDeviceMemoryProperties = nullptr;
    PFN_vkGetPhysicalDeviceQueueFamilyProperties vkGetPhysicalDeviceQueueFamilyProperties = nullptr;
    PFN_vkGetPhysicalDeviceFormatProperties vkGetPhysicalDeviceFormatProperties = nullptr;
    PFN_vkGetPhysicalDeviceImageFormatProperties vkGetPhysicalDeviceImageFormatProperties = nullptr;
    PFN_vkEnumerateDeviceExtensionProperties vkEnumerateDeviceExtensionProperties = nullptr;
    PFN_vkCreateDevice vkCreateDevice = nullptr;
    PFN_vkDestroySurfaceKHR vkDestroySurfaceKHR = nullptr;
    PFN_vkGetPhysicalDeviceSurfaceSupportKHR vkGetPhysicalDeviceSurfaceSupportKHR = nullptr;
    PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR vkGetPhysicalDeviceSurfaceCapabilitiesKHR = nullptr;
    PFN_vkGetPhysicalDeviceSurfaceFormatsKHR vkGetPhysicalDeviceSurfaceFormatsKHR = nullptr;
    PFN_vkGetPhysicalDeviceSurfacePresentModesKHR vkGetPhysicalDeviceSurfacePresentModesKHR = nullptr;
    PFN_vkCreateDebugUtilsMessengerEXT vkCreateDebugUtilsMessengerEXT = nullptr;
    PFN_vkDestroyDebugUtilsMessengerEXT vkDestroyDebugUtilsMessengerEXT = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT vkSetDebugUtilsObjectNameEXT = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT vkCmdBeginDebugUtilsLabelEXT = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT vkCmdEndDebugUtilsLabelEXT = nullptr;
};

class Instance {
public:
    /// `sink` receives validation messages and must outlive the instance; null: no validation.
    /// `display`: of the windows that devices will present to.
    static Result<std::unique_ptr<Instance>> create(ResultSink* sink, NativeDisplay const& display = {});
    ~Instance();
    Instance(Instance const&) = delete;
    Instance& operator=(Instance const&) = delete;

    std::vector<VkPhysicalDevice> physicalDevices() const;

    VkInstance handle() const { return mHandle; }
    InstanceFunctions const& fn() const { return mFunctions; }
    bool hasValidation() const { return mMessenger != VK_NULL_HANDLE; }
    NativeDisplay const& display() const { return mDisplay; }

private:
    Instance() = default;
    void loadFunctions();

    VkInstance mHandle = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT mMessenger = VK_NULL_HANDLE;
    NativeDisplay mDisplay{};
    InstanceFunctions mFunctions;
};

} // namespace filament_core::backend::vulkan
