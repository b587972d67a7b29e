// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Instance.h"

#include <algorithm>
#include <cstring>
#include <mutex>

namespace filament_core::backend::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr uint32_t kNewestApi = VK_API_VERSION_1_3; // the newest version that this driver was checked against

/// Finds the loader once per process; its functions do not change afterwards.
VkResult initializeLoader() {
    static std::once_flag once;
    static VkResult result = VK_ERROR_INITIALIZATION_FAILED;
    std::call_once(once, [] { result = volkInitialize(); });
    return result;
}

/// The loader's vkGetDeviceProcAddr is the same for every instance; volkLoadDeviceTable() reads the global.
void publishDeviceProcAddr(VkInstance instance) {
    static std::once_flag once;
    std::call_once(once, [instance] {
        vkGetDeviceProcAddr =
                reinterpret_cast<PFN_vkGetDeviceProcAddr>(vkGetInstanceProcAddr(instance, "vkGetDeviceProcAddr"));
    });
}

bool hasValidationLayer() {
    uint32_t count = 0;
    if (vkEnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkLayerProperties> layers(count);
    if (vkEnumerateInstanceLayerProperties(&count, layers.data()) < VK_SUCCESS) return false;
    return std::ranges::any_of(layers,
                               [](auto const& layer) { return !std::strcmp(layer.layerName, kValidationLayer); });
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         VkDebugUtilsMessengerCallbackDataEXT const* data, void* user) {
    static_cast<ResultSink*>(user)->onError(DriverErrorKind::Validation, data->pMessage ? data->pMessage : "");
    return VK_FALSE; // never abort the call, so that later messages appear too
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ResultSink* sink) {
    auto info = make<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT; // not the loader's remarks about other drivers
    info.pfnUserCallback = &onMessage;
    info.pUserData = sink;
    return info;
}

const char* surfaceExtension(WindowSystem system) {
    return system == WindowSystem::X11 ? "VK_KHR_xlib_surface" : "VK_KHR_wayland_surface";
}

bool hasInstanceExtension(const char* name) {
    uint32_t count = 0;
    if (vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkExtensionProperties> all(count);
    if (vkEnumerateInstanceExtensionProperties(nullptr, &count, all.data()) < VK_SUCCESS) return false;
    return std::ranges::any_of(all, [&](auto const& each) { return !std::strcmp(each.extensionName, name); });
}

VkResult createHandle(ResultSink* sink, WindowSystem windows, uint32_t apiVersion, VkInstance& handle) {
    auto application = make<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pEngineName = "filament_core";
    application.apiVersion = apiVersion;
    auto info = make<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;

    const VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(sink);
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    auto features = make<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    features.pNext = &messenger; // receives messages about creating and destroying the instance
    std::vector<const char*> extensions;
    if (windows != WindowSystem::None) extensions = { VK_KHR_SURFACE_EXTENSION_NAME, surfaceExtension(windows) };
    // Without it surfaces name no colour space but sRGB.
    if (windows != WindowSystem::None && hasInstanceExtension(VK_EXT_SWAPCHAIN_COLOR_SPACE_EXTENSION_NAME))
        extensions.push_back(VK_EXT_SWAPCHAIN_COLOR_SPACE_EXTENSION_NAME);
    if (sink) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
    }
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    return vkCreateInstance(&info, nullptr, &handle);
}

/// Keeps the drivers loaded until the process ends. The loader unloads them with the last instance, and memory that a
/// driver keeps in statics then leaks each time: lavapipe maps 10 MiB for its code and leaves 12 KiB of it resident
/// (measured, tests/numerics/scenes/EndlessTest.cpp). Loading all drivers again also costs every further engine some
/// milliseconds. A failure can be ignored: creating the real instance then fails too, and reports it.
void keepDriversLoaded(uint32_t apiVersion) {
    static std::once_flag once;
    static VkInstance kept = VK_NULL_HANDLE;
    std::call_once(once, [apiVersion] { createHandle(nullptr, WindowSystem::None, apiVersion, kept); });
}

} // namespace

Result<std::unique_ptr<Instance>> Instance::create(ResultSink* sink, NativeDisplay const& display) {
    if (initializeLoader() != VK_SUCCESS) {
        return fail(ErrorCode::DeviceUnavailable,
                    "Vulkan: no loader (libvulkan.so.1) on this machine; install libvulkan1 and mesa-vulkan-drivers");
    }
    uint32_t version = VK_API_VERSION_1_0;
    if (vkEnumerateInstanceVersion) vkEnumerateInstanceVersion(&version);
    if (version < VK_API_VERSION_1_1) {
        return fail(ErrorCode::DeviceUnavailable,
                    "Vulkan: the loader supports only version 1.0, but 1.1 is needed; update libvulkan1");
    }
    if (sink && !hasValidationLayer()) {
        sink->onError(DriverErrorKind::Validation, "Vulkan: validation was asked for but is not installed, going on "
                                                   "without; install vulkan-validationlayers");
        sink = nullptr;
    }

    std::unique_ptr<Instance> instance(new Instance);
    const uint32_t apiVersion = std::min(version, kNewestApi);
    keepDriversLoaded(apiVersion);
    const VkResult result = createHandle(sink, display.system, apiVersion, instance->mHandle);
    if (result != VK_SUCCESS) {
        instance->mHandle = VK_NULL_HANDLE;
        if (result == VK_ERROR_EXTENSION_NOT_PRESENT && display.system != WindowSystem::None) {
            return fail(ErrorCode::Unsupported,
                        "Vulkan: no driver presents to windows of {} ({}); install "
                        "mesa-vulkan-drivers",
                        toString(display.system), surfaceExtension(display.system));
        }
        return fail(ErrorCode::DeviceUnavailable, "Vulkan: no driver could be loaded ({}); install mesa-vulkan-drivers",
                    toString(result));
    }
    instance->mDisplay = display;
    instance->loadFunctions();
    publishDeviceProcAddr(instance->mHandle);
    if (sink) {
        const VkDebugUtilsMessengerCreateInfoEXT info = messengerInfo(sink);
        instance->mFunctions.vkCreateDebugUtilsMessengerEXT(instance->mHandle, &info, nullptr, &instance->mMessenger);
    }
    return instance;
}

Instance::~Instance() {
    if (mHandle == VK_NULL_HANDLE) return;
    if (mMessenger != VK_NULL_HANDLE) mFunctions.vkDestroyDebugUtilsMessengerEXT(mHandle, mMessenger, nullptr);
    mFunctions.vkDestroyInstance(mHandle, nullptr);
}

void Instance::loadFunctions() {
    const auto load = [this](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(vkGetInstanceProcAddr(mHandle, name));
    };
    InstanceFunctions& fn = mFunctions;
    load(fn.vkDestroyInstance, "vkDestroyInstance");
    load(fn.vkEnumeratePhysicalDevices, "vkEnumeratePhysicalDevices");
    load(fn.vkGetPhysicalDeviceProperties2, "vkGetPhysicalDeviceProperties2");
    load(fn.vkGetPhysicalDeviceFeatures2, "vkGetPhysicalDeviceFeatures2");
    load(fn.vkGetPhysicalDeviceMemoryProperties, "vkGetPhysicalDeviceMemoryProperties");
    load(fn.vkGetPhysicalDeviceQueueFamilyProperties, "vkGetPhysicalDeviceQueueFamilyProperties");
    load(fn.vkGetPhysicalDeviceFormatProperties, "vkGetPhysicalDeviceFormatProperties");
    load(fn.vkGetPhysicalDeviceImageFormatProperties, "vkGetPhysicalDeviceImageFormatProperties");
    load(fn.vkEnumerateDeviceExtensionProperties, "vkEnumerateDeviceExtensionProperties");
    load(fn.vkCreateDevice, "vkCreateDevice");
    load(fn.vkDestroySurfaceKHR, "vkDestroySurfaceKHR");
    load(fn.vkGetPhysicalDeviceSurfaceSupportKHR, "vkGetPhysicalDeviceSurfaceSupportKHR");
    load(fn.vkGetPhysicalDeviceSurfaceCapabilitiesKHR, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    load(fn.vkGetPhysicalDeviceSurfaceFormatsKHR, "vkGetPhysicalDeviceSurfaceFormatsKHR");
    load(fn.vkGetPhysicalDeviceSurfacePresentModesKHR, "vkGetPhysicalDeviceSurfacePresentModesKHR");
    load(fn.vkCreateDebugUtilsMessengerEXT, "vkCreateDebugUtilsMessengerEXT");
    load(fn.vkDestroyDebugUtilsMessengerEXT, "vkDestroyDebugUtilsMessengerEXT");
    load(fn.vkSetDebugUtilsObjectNameEXT, "vkSetDebugUtilsObjectNameEXT");
    load(fn.vkCmdBeginDebugUtilsLabelEXT, "vkCmdBeginDebugUtilsLabelEXT");
    load(fn.vkCmdEndDebugUtilsLabelEXT, "vkCmdEndDebugUtilsLabelEXT");
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const {
    uint32_t count = 0;
    if (mFunctions.vkEnumeratePhysicalDevices(mHandle, &count, nullptr) != VK_SUCCESS) return {};
    std::vector<VkPhysicalDevice> devices(count);
    if (mFunctions.vkEnumeratePhysicalDevices(mHandle, &count, devices.data()) < VK_SUCCESS) return {};
    devices.resize(count);
    return devices;
}

} // namespace filament_core::backend::vulkan
