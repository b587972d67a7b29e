// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Device.h"

#include <string>

namespace filament_core::backend::vulkan {
namespace {

VkResult createHandle(Instance const& instance, PhysicalDevice const& physical, VkDevice& handle) {
    InstanceFunctions const& fn = instance.fn();
    const float priority = 1;
    auto queue = make<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = physical.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;

    auto provoking = make<VkPhysicalDeviceProvokingVertexFeaturesEXT>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT);
    provoking.provokingVertexLast = VK_TRUE;
    auto half = make<VkPhysicalDeviceShaderFloat16Int8Features>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES);
    half.shaderFloat16 = VK_TRUE;
    auto lines = make<VkPhysicalDeviceLineRasterizationFeaturesEXT>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT);
    lines.bresenhamLines = VK_TRUE;
    auto features = make<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    features.features.samplerAnisotropy = physical.features.samplerAnisotropy;
    features.features.depthClamp = physical.features.depthClamp;
    features.features.imageCubeArray = physical.features.imageCubeArray;
    features.features.textureCompressionBC = physical.features.textureCompressionBC;
    features.features.independentBlend = physical.features.independentBlend;
    features.features.geometryShader = physical.features.geometryShader; // for gl_PrimitiveID

    std::vector<const char*> extensions;
    if (physical.provokingVertexLast) {
        extensions.push_back(VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME);
        provoking.pNext = features.pNext;
        features.pNext = &provoking;
    }
    if (physical.creationFeedback) extensions.push_back(VK_EXT_PIPELINE_CREATION_FEEDBACK_EXTENSION_NAME);
    if (physical.imageFormatList) extensions.push_back(VK_KHR_IMAGE_FORMAT_LIST_EXTENSION_NAME);
    if (physical.depthResolve) {
        extensions.push_back(VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME);
        extensions.push_back(VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME);
    }
    if (instance.display().system != WindowSystem::None) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (physical.hdrMetadata) extensions.push_back(VK_EXT_HDR_METADATA_EXTENSION_NAME);
    if (physical.bresenhamLines) {
        extensions.push_back(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME);
        lines.pNext = features.pNext;
        features.pNext = &lines;
    }
    if (physical.halfFloatShaders) {
        extensions.push_back(VK_KHR_SHADER_FLOAT16_INT8_EXTENSION_NAME);
        half.pNext = features.pNext;
        features.pNext = &half;
    }

    auto info = make<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    return fn.vkCreateDevice(physical.handle, &info, nullptr, &handle);
}

} // namespace

Result<std::unique_ptr<Device>> Device::create(std::unique_ptr<Instance> instance, PhysicalDevice physical) {
    std::unique_ptr<Device> device(new Device);
    device->mInstance = std::move(instance);
    device->mPhysical = std::move(physical);
    const VkResult result = createHandle(*device->mInstance, device->mPhysical, device->mHandle);
    if (result != VK_SUCCESS) {
        device->mHandle = VK_NULL_HANDLE;
        return fail(ErrorCode::DeviceUnavailable, "Vulkan: '{}' refused to make a device ({}); update its driver",
                    device->info().deviceName, toString(result));
    }
    volkLoadDeviceTable(&device->mFunctions, device->mHandle);
    device->mFunctions.vkGetDeviceQueue(device->mHandle, device->mPhysical.queueFamily, 0, &device->mQueue);
    device->mMemory = std::make_unique<Memory>(device->mFunctions, device->mHandle, device->mPhysical.memory);
    return device;
}

Device::~Device() {
    mMemory.reset();
    if (mHandle != VK_NULL_HANDLE) mFunctions.vkDestroyDevice(mHandle, nullptr);
}

void Device::setNameBits(VkObjectType type, uint64_t handle, std::string_view name) const {
    const std::string text(name); // a string_view may lack a terminating zero
    auto info = make<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = text.c_str();
    mInstance->fn().vkSetDebugUtilsObjectNameEXT(mHandle, &info);
}

} // namespace filament_core::backend::vulkan
