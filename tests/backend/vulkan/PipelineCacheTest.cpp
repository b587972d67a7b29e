// SPDX-License-Identifier: Apache-2.0
// The contents of a device's pipeline cache are kept in a file and passed to the next device. lavapipe's cache stores
// nothing, so some functions of the device are replaced.
#include "tests/backend/vulkan/DriverFixture.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace filament_core::backend::vulkan {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

const Bytes kCompiled(5000, std::byte{ 0x5A });

/// A cache that returns kCompiled and makes pipelines from nothing else.
struct FakeCache {
    Bytes given;                                ///< when the device's cache was made
    PFN_vkCreatePipelineCache create = nullptr; ///< the real ones
    PFN_vkCreateGraphicsPipelines compile = nullptr;
};
FakeCache sCache;

VKAPI_ATTR VkResult VKAPI_CALL createCache(VkDevice device, VkPipelineCacheCreateInfo const* info,
                                           VkAllocationCallbacks const* allocator, VkPipelineCache* cache) {
    const auto* data = static_cast<const std::byte*>(info->pInitialData);
    sCache.given.assign(data, data + info->initialDataSize);
    VkPipelineCacheCreateInfo empty = *info;
    empty.initialDataSize = 0;
    return sCache.create(device, &empty, allocator, cache);
}

VKAPI_ATTR VkResult VKAPI_CALL readCache(VkDevice, VkPipelineCache, size_t* size, void* data) {
    if (data) std::memcpy(data, kCompiled.data(), kCompiled.size());
    *size = kCompiled.size();
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL compile(VkDevice device, VkPipelineCache cache, uint32_t count,
                                       VkGraphicsPipelineCreateInfo const* infos,
                                       VkAllocationCallbacks const* allocator, VkPipeline* pipelines) {
    EXPECT_NE(cache, VK_NULL_HANDLE);
    const VkResult result = sCache.compile(device, cache, count, infos, allocator, pipelines);
    for (auto const* info = static_cast<VkBaseInStructure const*>(infos->pNext); info; info = info->pNext) {
        if (info->sType != VK_STRUCTURE_TYPE_PIPELINE_CREATION_FEEDBACK_CREATE_INFO_EXT) continue;
        const auto* feedback = reinterpret_cast<VkPipelineCreationFeedbackCreateInfoEXT const*>(info);
        feedback->pPipelineCreationFeedback->flags = VK_PIPELINE_CREATION_FEEDBACK_VALID_BIT_EXT;
        if (sCache.given == kCompiled)
            feedback->pPipelineCreationFeedback->flags |=
                    VK_PIPELINE_CREATION_FEEDBACK_APPLICATION_PIPELINE_CACHE_HIT_BIT_EXT;
    }
    return result;
}

class PipelineCacheTest : public DriverTest {
protected:
    void TearDown() override {
        DriverTest::TearDown();
        fs::remove_all(mFolder);
    }

    /// From opening a device to a pipeline, and back.
    DriverStatistics run(fs::path const& folder) {
        driver.reset();
        auto instance = Instance::create(&sink);
        EXPECT_TRUE(instance) << instance.error().message;
        std::vector<PhysicalDevice> devices = surveyDevices(**instance);
        PhysicalDevice physical = devices[*chooseDevice(devices, "")];
        EXPECT_TRUE(physical.creationFeedback) << "the tests of pipeline caches need it of the driver";
        auto device = Device::create(std::move(*instance), std::move(physical));
        EXPECT_TRUE(device) << device.error().message;
        VolkDeviceTable& functions = (*device)->functionsForTest();
        sCache = { .given = {},
                   .create = functions.vkCreatePipelineCache,
                   .compile = functions.vkCreateGraphicsPipelines };
        functions.vkCreatePipelineCache = createCache;
        functions.vkGetPipelineCacheData = readCache;
        functions.vkCreateGraphicsPipelines = compile;
        auto made = Executor::create(std::move(*device), sink, folder);
        EXPECT_TRUE(made) << made.error().message;
        driver = std::move(*made);
        const ProgramHandle program = makeProgram(kFullScreenVertex, kRedFragment);
        makePipeline({ .program = program, .pass = colorLayout() });
        finish();
        const DriverStatistics statistics = driver->statistics();
        driver.reset();
        return statistics;
    }

    std::vector<fs::path> files() const {
        if (!fs::exists(mFolder)) return {};
        return { fs::directory_iterator(mFolder), fs::directory_iterator() };
    }

    const fs::path mFolder = fs::temp_directory_path() / ("pipeline_cache_test_" + std::to_string(getpid()));
};

TEST_F(PipelineCacheTest, TheNextDeviceGetsWhatTheLastOneKeptAndSaysThatItUsedIt) {
    const DriverStatistics first = run(mFolder);
    EXPECT_THAT(sCache.given, testing::IsEmpty());
    EXPECT_EQ(first.pipelinesCreated, 1u);
    EXPECT_EQ(first.pipelinesFromCache, 0u);
    ASSERT_EQ(files().size(), 1u);
    const DriverStatistics second = run(mFolder);
    EXPECT_EQ(sCache.given, kCompiled);
    EXPECT_EQ(second.pipelinesCreated, 1u);
    EXPECT_EQ(second.pipelinesFromCache, 1u);
}

TEST_F(PipelineCacheTest, WithoutAFolderNothingIsKept) {
    run({});
    EXPECT_THAT(sCache.given, testing::IsEmpty());
    EXPECT_EQ(run({}).pipelinesFromCache, 0u);
    EXPECT_THAT(sCache.given, testing::IsEmpty());
}

TEST_F(PipelineCacheTest, TheDeviceNeverSeesADamagedFile) {
    run(mFolder);
    ASSERT_EQ(files().size(), 1u);
    std::fstream file(files()[0], std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(200) << 'x';
    file.close();
    EXPECT_EQ(run(mFolder).pipelinesFromCache, 0u);
    EXPECT_THAT(sCache.given, testing::IsEmpty());
    EXPECT_EQ(run(mFolder).pipelinesFromCache, 1u) << "a good file replaced it";
}

} // namespace
} // namespace filament_core::backend::vulkan
