// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/PhysicalDevice.h"

#include "backend/vulkan/Formats.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>
#include <optional>

namespace filament_core::backend::vulkan {
namespace {

class ExtensionList {
public:
    ExtensionList(Instance const& instance, VkPhysicalDevice device) {
        uint32_t count = 0;
        auto* const enumerate = instance.fn().vkEnumerateDeviceExtensionProperties;
        if (enumerate(device, nullptr, &count, nullptr) != VK_SUCCESS) return;
        mExtensions.resize(count);
        if (enumerate(device, nullptr, &count, mExtensions.data()) < VK_SUCCESS) mExtensions.clear();
    }
    bool has(const char* name) const {
        return std::ranges::any_of(mExtensions,
                                   [&](auto const& each) { return !std::strcmp(each.extensionName, name); });
    }

private:
    std::vector<VkExtensionProperties> mExtensions;
};

std::string versionText(uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

void readProperties(Instance const& instance, ExtensionList const& extensions, PhysicalDevice& device) {
    auto driver = make<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto properties = make<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    if (extensions.has(VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) properties.pNext = &driver;
    instance.fn().vkGetPhysicalDeviceProperties2(device.handle, &properties);

    VkPhysicalDeviceProperties const& core = properties.properties;
    VkPhysicalDeviceLimits const& limits = core.limits;
    device.type = core.deviceType;
    device.quirks = Quirks::of(driver.driverID);
    device.timestampNanoseconds = limits.timestampPeriod;
    // An offset must also be a multiple of the texel block, of which the largest has 16 bytes.
    device.copyOffsetAlignment = std::max<uint64_t>(limits.optimalBufferCopyOffsetAlignment, 16);
    if (core.apiVersion < VK_API_VERSION_1_1) device.unusable = "Vulkan 1.0 only";

    DeviceInfo& info = device.info;
    info.backend = Backend::Vulkan;
    info.shaderLanguage = ShaderLanguage::SpirV;
    info.deviceName = core.deviceName;
    const std::string build = driver.driverInfo[0] ? driver.driverInfo : versionText(core.driverVersion);
    info.driverName = fmt::format("{}, Vulkan {}", build, versionText(core.apiVersion));
    info.limits.maxTextureSize = limits.maxImageDimension2D;
    info.limits.max3DTextureSize = limits.maxImageDimension3D;
    info.limits.maxColorAttachments = std::min(limits.maxColorAttachments, kMaxColorAttachments);
    info.limits.maxUniformBlockBytes = limits.maxUniformBufferRange;
    info.limits.uniformOffsetAlignment = static_cast<uint32_t>(limits.minUniformBufferOffsetAlignment);
    info.limits.maxTextureUnits =
            std::min(limits.maxPerStageDescriptorSamplers, limits.maxPerStageDescriptorSampledImages);
    info.limits.maxStorageBuffers = limits.maxPerStageDescriptorStorageBuffers;
    info.limits.maxFragmentStorageBuffers = limits.maxPerStageDescriptorStorageBuffers;
    info.limits.maxStorageBlockBytes = limits.maxStorageBufferRange;
    info.limits.storageOffsetAlignment = static_cast<uint32_t>(limits.minStorageBufferOffsetAlignment);
    info.limits.maxDispatchGroups = std::min({ limits.maxComputeWorkGroupCount[0], limits.maxComputeWorkGroupCount[1],
                                               limits.maxComputeWorkGroupCount[2] });
    info.limits.maxGroupInvocations = limits.maxComputeWorkGroupInvocations;
    info.limits.maxGroupBytes = limits.maxComputeSharedMemorySize;
    info.limits.maxVertexAttributes = std::min(limits.maxVertexInputAttributes, kMaxVertexAttributes);
    const VkSampleCountFlags samples = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    info.limits.maxSamples = (samples & VK_SAMPLE_COUNT_4_BIT) != 0 ? 4 : 1;
    info.limits.maxAnisotropy = limits.maxSamplerAnisotropy;
}

void readFeatures(Instance const& instance, ExtensionList const& extensions, PhysicalDevice& device) {
    auto provoking = make<VkPhysicalDeviceProvokingVertexFeaturesEXT>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT);
    auto half = make<VkPhysicalDeviceShaderFloat16Int8Features>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES);
    auto lines = make<VkPhysicalDeviceLineRasterizationFeaturesEXT>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT);
    auto features = make<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    device.imageFormatList = extensions.has(VK_KHR_IMAGE_FORMAT_LIST_EXTENSION_NAME);
    device.swapchains = extensions.has(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    device.hdrMetadata = device.swapchains && instance.display().system != WindowSystem::None &&
                         extensions.has(VK_EXT_HDR_METADATA_EXTENSION_NAME);
    if (!device.swapchains && instance.display().system != WindowSystem::None)
        device.unusable = "presents to no window";
    device.creationFeedback = extensions.has(VK_EXT_PIPELINE_CREATION_FEEDBACK_EXTENSION_NAME);
    device.depthResolve = extensions.has(VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME) &&
                          extensions.has(VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME);
    if (extensions.has(VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME)) {
        provoking.pNext = features.pNext;
        features.pNext = &provoking;
    }
    if (extensions.has(VK_KHR_SHADER_FLOAT16_INT8_EXTENSION_NAME)) {
        half.pNext = features.pNext;
        features.pNext = &half;
    }
    if (extensions.has(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME)) {
        lines.pNext = features.pNext;
        features.pNext = &lines;
    }
    instance.fn().vkGetPhysicalDeviceFeatures2(device.handle, &features);

    device.features = features.features;
    device.provokingVertexLast = provoking.provokingVertexLast;
    device.halfFloatShaders = half.shaderFloat16;
    device.bresenhamLines = lines.bresenhamLines;
    DeviceInfo& info = device.info;
    info.features.depthResolve = device.depthResolve;
    info.features.textureViews = true; // so are image views
    info.features.sharedMemory = true; // and images that alias
    info.features.cubeArrays = features.features.imageCubeArray;
    info.features.blockCompression = features.features.textureCompressionBC;
    info.features.exactSrgbBlocks = info.features.blockCompression && !device.quirks.convertsSrgbOfBlocks;
    info.features.srgbAttachments = true; // views of another format are core, too
    info.features.halfFloatShaders = device.halfFloatShaders;
    info.features.primitiveIds = features.features.geometryShader;
    info.features.lastVertexProvokes = device.provokingVertexLast;
    info.features.depthClamp = features.features.depthClamp;
    if (!features.features.samplerAnisotropy) info.limits.maxAnisotropy = 1;
}

void readQueues(Instance const& instance, PhysicalDevice& device) {
    uint32_t count = 0;
    instance.fn().vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    instance.fn().vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
    const auto graphics = std::ranges::find_if(families, [](auto const& family) {
        constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT; // one family has both
        return (family.queueFlags & kNeeded) == kNeeded && family.queueCount > 0;
    });
    if (graphics == families.end()) {
        device.unusable = "no graphics queue";
        return;
    }
    device.queueFamily = static_cast<uint32_t>(graphics - families.begin());
    device.timestampBits = graphics->timestampValidBits;
    device.info.features.timers = device.timestampBits > 0;
}

/// The first renderable format that this device cannot render to.
std::optional<Format> missingFormat(Instance const& instance, VkPhysicalDevice device) {
    for (uint32_t i = 1; i < static_cast<uint32_t>(Format::Count); ++i) {
        const auto format = static_cast<Format>(i);
        if (!formatInfo(format).isRenderable) continue;
        VkFormatProperties properties{};
        instance.fn().vkGetPhysicalDeviceFormatProperties(device, native(format), &properties);
        const VkFormatFeatureFlags needed = hasDepth(format) ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                             : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
        if ((properties.optimalTilingFeatures & needed) == 0) return format;
    }
    return std::nullopt;
}

PhysicalDevice survey(Instance const& instance, VkPhysicalDevice handle) {
    PhysicalDevice device;
    device.handle = handle;
    const ExtensionList extensions(instance, handle);
    readProperties(instance, extensions, device);
    if (!device.unusable.empty()) return device;
    readFeatures(instance, extensions, device);
    readQueues(instance, device);
    instance.fn().vkGetPhysicalDeviceMemoryProperties(handle, &device.memory);
    for (uint32_t i = 0; i < device.memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = device.memory.memoryTypes[i].propertyFlags;
        device.lazilyAllocatedMemory |= (flags & VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT) != 0;
    }
    device.info.features.mergedPasses = gainsByMerging(device);
    if (const auto format = missingFormat(instance, handle)) {
        device.unusable = fmt::format("cannot render to {}", formatInfo(*format).name);
    }
    return device;
}

bool containsIgnoringCase(std::string_view text, std::string_view part) {
    const auto isSame = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), isSame) != text.end() || part.empty();
}

int rankOf(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 4;
    default:
        return 3;
    }
}

} // namespace

bool gainsByMerging(PhysicalDevice const& device) {
    return device.lazilyAllocatedMemory || device.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

std::vector<PhysicalDevice> surveyDevices(Instance const& instance) {
    std::vector<PhysicalDevice> devices;
    for (VkPhysicalDevice handle : instance.physicalDevices()) devices.push_back(survey(instance, handle));
    return devices;
}

Result<size_t> chooseDevice(std::span<const PhysicalDevice> devices, std::string_view required) {
    std::optional<size_t> best;
    std::string list;
    for (size_t i = 0; i < devices.size(); ++i) {
        PhysicalDevice const& device = devices[i];
        list += fmt::format("{}'{}'", list.empty() ? "" : ", ", device.info.deviceName);
        if (!device.unusable.empty()) {
            list += fmt::format(" (unusable: {})", device.unusable);
        } else if (containsIgnoringCase(device.info.deviceName, required)) {
            if (!best || rankOf(device.type) < rankOf(devices[*best].type)) best = i;
        }
    }
    if (best) return *best;
    if (devices.empty()) return fail(ErrorCode::DeviceUnavailable, "Vulkan: no device; install mesa-vulkan-drivers");
    if (required.empty()) return fail(ErrorCode::DeviceUnavailable, "Vulkan: no usable device; there is {}", list);
    return fail(ErrorCode::DeviceUnavailable, "Vulkan: no usable device is named like '{}'; there is {}", required,
                list);
}

} // namespace filament_core::backend::vulkan
