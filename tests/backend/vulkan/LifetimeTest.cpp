// SPDX-License-Identifier: Apache-2.0
// Frames, answers, destruction while work is in flight, and everything that may fail.
#include "backend/vulkan/Driver.h"
#include "tests/backend/vulkan/DriverFixture.h"
#include "tests/base/ScopedVariable.h"

#include <chrono>
#include <cstdlib>
#include <thread>

namespace filament_core::backend::vulkan {
namespace {

// ---------------------------------------------------------------------------------------------- frames and answers

TEST_F(DriverTest, ObjectsDestroyedRightAfterTheirLastUseStillServeIt) {
    for (uint64_t frame = 0; frame < 8; ++frame) {
        commands.record(CmdBeginFrame{ frame });
        const ProgramHandle program = makeProgram(kFullScreenVertex, kRedFragment);
        const PipelineHandle pipeline =
                makePipeline({ .program = program, .pass = colorLayout(), .raster = kNoCulling });
        commands.record(CmdDestroyProgram{ program });
        const TextureHandle target = makeTarget(64, 64);
        beginPass(target, 64, 64);
        commands.record(CmdBindPipeline{ pipeline });
        commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
        const Ticket wanted = ticket();
        commands.record(CmdReadTexture{ target, 0, 0, { 63, 63, 1, 1 }, wanted });
        commands.record(CmdDestroyTexture{ target });
        commands.record(CmdDestroyPipeline{ pipeline });
        commands.record(CmdEndFrame{ frame });
        replay();
    }
    driver->waitIdle();
    ASSERT_EQ(sink.readbacks.size(), 8u);
    for (auto const& [id, bytes] : sink.readbacks) {
        ASSERT_EQ(bytes.size(), 4u);
        EXPECT_EQ(bytes[0], std::byte{ 255 });
    }
    EXPECT_EQ(driver->device().memory().statistics().dedicated, 0u);
}

TEST_F(DriverTest, DestroyedObjectsGiveTheirMemoryBack) {
    const uint64_t before = driver->device().memory().statistics().usedBytes;
    const TextureHandle texture = makeTarget(256, 256);
    const BufferHandle buffer = makeBuffer(BufferUsage::Vertex, std::vector<float>(1000));
    finish();
    EXPECT_GE(driver->statistics().deviceBytes, before + 256 * 256 * 4 + 4000);
    commands.record(CmdDestroyTexture{ texture });
    commands.record(CmdDestroyBuffer{ buffer });
    finish();
    EXPECT_EQ(driver->statistics().deviceBytes, before);
}

TEST_F(DriverTest, AReadBackIsAnsweredByALaterStreamWithoutAnyWait) {
    const TextureHandle target = makeTarget(1, 1);
    beginPass(target, 1, 1);
    endPass();
    const Ticket wanted = ticket();
    commands.record(CmdReadTexture{ target, 0, 0, { 0, 0, 1, 1 }, wanted });
    replay();
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!sink.readbacks.contains(wanted.value) && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        driver->execute(CommandView{});
    }
    EXPECT_TRUE(sink.readbacks.contains(wanted.value));
}

TEST_F(DriverTest, ATimerMeasuresTheWorkInsideIt) {
    if (!driver->info().features.timers) GTEST_SKIP() << "no timestamps";
    const ProgramHandle program = makeProgram(kFullScreenVertex, R"(
        layout(location = 0) out vec4 color;
        void main() {
            float x = gl_FragCoord.x;
            for (int i = 0; i < 400; ++i) x = fract(x * 1.37 + 0.11);
            color = vec4(x);
        })");
    const PipelineHandle pipeline = makePipeline({ .program = program, .pass = colorLayout(), .raster = kNoCulling });
    const TextureHandle target = makeTarget(256, 256);
    const auto draw = [&](uint32_t times) {
        beginPass(target, 256, 256);
        commands.record(CmdBindPipeline{ pipeline });
        for (uint32_t i = 0; i < times; ++i) commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
    };
    draw(1); // compiles
    finish();
    const Ticket outer = ticket(), inner = ticket(), none = ticket();
    commands.record(CmdBeginTimer{ outer });
    draw(4);
    commands.record(CmdBeginTimer{ inner });
    draw(4);
    commands.record(CmdEndTimer{ inner });
    commands.record(CmdEndTimer{ outer });
    commands.record(CmdBeginTimer{ none });
    commands.record(CmdEndTimer{ none });
    finish();
    ASSERT_EQ(sink.timers.size(), 3u);
    EXPECT_GT(sink.timers[inner.value], 500'000u) << "100 million iterations";
    EXPECT_GT(sink.timers[outer.value], sink.timers[inner.value]);
    EXPECT_LT(sink.timers[none.value], sink.timers[inner.value] / 4);
}

TEST_F(DriverTest, StatisticsCountWhatWasDone) {
    const DriverStatistics before = driver->statistics();
    const ProgramHandle program = makeProgram(kFullScreenVertex, kRedFragment);
    const PipelineHandle pipeline = makePipeline({ .program = program, .pass = colorLayout(), .raster = kNoCulling });
    const TextureHandle target = makeTarget(1, 1);
    beginPass(target, 1, 1);
    commands.record(CmdDraw{ .vertexCount = 3 }); // skipped: nothing is bound
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    const size_t recorded = commands.commandCount();
    finish();
    const DriverStatistics after = driver->statistics();
    EXPECT_EQ(after.commands - before.commands, recorded);
    EXPECT_EQ(after.draws, 1u);
    EXPECT_EQ(after.passes, 1u);
    EXPECT_EQ(after.programsCreated, 1u);
    EXPECT_EQ(after.pipelinesCreated, 1u);
    EXPECT_EQ(after.pipelinesCreatedInPasses, 0u);
}

// ---------------------------------------------------------------------------------------------- failures

class FailureTest : public DriverTest {
protected:
    /// Draws `pipeline` over a green clear; returns whether anything changed.
    bool draws(PipelineHandle pipeline, BindGroupHandle group = {}) {
        const TextureHandle target = makeTarget(1, 1);
        beginPass(target, 1, 1, { 0, 1, 0, 1 });
        commands.record(CmdBindPipeline{ pipeline });
        if (group) commands.record(CmdBindGroup{ .group = group, .index = 0 });
        commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
        return readPixels(target, 1, 1)[0] != Rgba8{ 0, 255, 0, 255 };
    }
    bool hasError(DriverErrorKind kind, std::string_view text) const {
        for (auto const& error : sink.errors) {
            if (error.kind == kind && error.message.find(text) != std::string::npos) return true;
        }
        return false;
    }
    std::string allErrors() const {
        std::string all;
        for (auto const& error : sink.errors) all += error.message + "\n";
        return all;
    }
};

TEST_F(FailureTest, ATextureTooLargeForTheDeviceIsAnErrorAndItsPassesAreSkipped) {
    const TextureHandle huge = makeTexture({ .type = TextureKind::Texture2DArray,
                                             .format = Format::RGBA32F,
                                             .usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource,
                                             .layers = 2048,
                                             .width = 16384,
                                             .height = 16384,
                                             .debugName = "huge" });
    beginPass(huge, 16, 16, {}, Format::RGBA32F);
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_TRUE(read(huge, 1, 1).empty()) << "the ticket is answered, with nothing";
    EXPECT_TRUE(hasError(DriverErrorKind::OutOfMemory, "texture 'huge' (16384x16384 RGBA32F")) << allErrors();
}

TEST_F(FailureTest, ABufferThatTheDeviceHasNoMemoryForNamesItsSize) {
    const auto original = driver->device().fn().vkAllocateMemory;
    driver->device().functionsForTest().vkAllocateMemory = [](VkDevice, VkMemoryAllocateInfo const*,
                                                              VkAllocationCallbacks const*, VkDeviceMemory*) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    };
    const auto buffer = handle<BufferHandle>();
    commands.record(CmdCreateBuffer{ buffer, { .size = 100 << 20, .debugName = "vertices" } });
    commands.record(CmdUpdateBuffer{ buffer, 0, std::as_bytes(std::span("text")) });
    finish();
    driver->device().functionsForTest().vkAllocateMemory = original;
    EXPECT_TRUE(hasError(DriverErrorKind::OutOfMemory, "buffer 'vertices' of 104857600 bytes")) << allErrors();
    EXPECT_EQ(sink.errors.size(), 1u) << allErrors();
}

TEST_F(FailureTest, AFormatThatTheDeviceCannotUseThatWayIsAnError) {
    makeTexture({ .format = Format::BC7,
                  .usage = TextureUsage::ColorAttachment,
                  .width = 4,
                  .height = 4,
                  .debugName = "blocks" });
    finish();
    EXPECT_TRUE(hasError(DriverErrorKind::Other, "texture 'blocks' (4x4 BC7")) << allErrors();
}

TEST_F(FailureTest, BrokenSpirvIsACompileErrorAndItsDrawsAreSkipped) {
    const auto program = handle<ProgramHandle>();
    const std::vector<uint32_t> vertex = spirvFromGlsl(ShaderStage::Vertex, kFullScreenVertex);
    ProgramDesc desc{ .debugName = "broken" };
    desc.vertex = std::as_bytes(std::span(vertex));
    desc.fragment = std::as_bytes(std::span("this is not SPIR-V")).first(16);
    commands.record(CmdCreateProgram{ program, desc });
    EXPECT_FALSE(
            draws(makePipeline({ .program = program, .pass = colorLayout(), .raster = kNoCulling, .debugName = "p" })));
    EXPECT_TRUE(hasError(DriverErrorKind::ShaderCompile, "program 'broken', fragment shader")) << allErrors();
    EXPECT_TRUE(hasError(DriverErrorKind::ShaderCompile, "pipeline 'p'")) << allErrors();
}

TEST_F(FailureTest, ABindGroupWithoutItsTextureIsAnErrorAndItsDrawsAreSkipped) {
    ProgramLayout layout;
    layout[0].bindings[0] = { .binding = 0, .type = BindingType::SampledTexture };
    layout[0].count = 1;
    const ProgramHandle program = makeProgram(kFullScreenVertex, R"(
        layout(set = 0, binding = 0) uniform sampler2D source;
        layout(location = 0) out vec4 color;
        void main() { color = texture(source, vec2(0.5)); })",
                                              layout);
    const PipelineHandle pipeline = makePipeline({ .program = program, .pass = colorLayout(), .raster = kNoCulling });
    const BindGroupHandle group = makeGroup(layout[0], { { .binding = 0, .texture = handle<TextureHandle>() } });
    EXPECT_FALSE(draws(pipeline, group));
    EXPECT_TRUE(hasError(DriverErrorKind::Other, "bind group 'group': binding 0 has no sampled texture"))
            << allErrors();
}

TEST_F(FailureTest, ALostDeviceIsReportedOnceAndLaterStreamsAreSwallowed) {
    driver->device().functionsForTest().vkQueueSubmit = [](VkQueue, uint32_t, VkSubmitInfo const*, VkFence) {
        return VK_ERROR_DEVICE_LOST;
    };
    const TextureHandle target = makeTarget(1, 1);
    beginPass(target, 1, 1);
    endPass();
    const Ticket wanted = ticket();
    commands.record(CmdReadTexture{ target, 0, 0, { 0, 0, 1, 1 }, wanted });
    commands.record(CmdEndFrame{});
    finish();
    for (int i = 0; i < 3; ++i) {
        beginPass(target, 1, 1);
        endPass();
        commands.record(CmdEndFrame{});
        finish();
    }
    EXPECT_EQ(sink.countErrors(DriverErrorKind::DeviceLost), 1u) << allErrors();
    EXPECT_FALSE(sink.readbacks.contains(wanted.value));
}

TEST_F(FailureTest, ValidationIsAwake) {
    const auto rulesBroken = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO); // of size 0
    VkBuffer buffer = VK_NULL_HANDLE;
    Device& device = driver->device();
    device.fn().vkCreateBuffer(device.handle(), &rulesBroken, nullptr, &buffer);
    device.fn().vkDestroyBuffer(device.handle(), buffer, nullptr);
    EXPECT_TRUE(hasError(DriverErrorKind::Validation, "VUID-VkBufferCreateInfo-size-00912")) << allErrors();
    sink.errors.clear();
}

TEST(VulkanDriver, DrawsOnADeviceWithoutAnyOptionalFeature) {
    CollectingSink sink;
    auto instance = Instance::create(&sink);
    if (!instance) GTEST_SKIP() << instance.error().message;
    std::vector<PhysicalDevice> devices = surveyDevices(**instance);
    const auto choice = chooseDevice(devices, "");
    if (!choice) GTEST_SKIP() << choice.error().message;
    PhysicalDevice plain = devices[*choice];
    plain.features = {};
    plain.provokingVertexLast = plain.halfFloatShaders = false;
    plain.info.features = { .mergedPasses = true };
    plain.info.limits.maxAnisotropy = 1;
    auto device = Device::create(std::move(*instance), plain);
    ASSERT_TRUE(device) << device.error().message;
    auto driver = Executor::create(std::move(*device), sink);
    ASSERT_TRUE(driver) << driver.error().message;

    const std::vector<uint32_t> vertex = spirvFromGlsl(ShaderStage::Vertex, kFullScreenVertex);
    const std::vector<uint32_t> fragment = spirvFromGlsl(ShaderStage::Fragment, R"(
        layout(location = 0) out vec4 a;
        layout(location = 1) out vec4 b;
        void main() { a = b = vec4(1.0, 0.0, 0.0, 1.0); })");
    CommandBuffer commands;
    const auto program = ProgramHandle::make(1, 1);
    ProgramDesc desc{ .debugName = "plain" };
    desc.vertex = std::as_bytes(std::span(vertex));
    desc.fragment = std::as_bytes(std::span(fragment));
    commands.record(CmdCreateProgram{ program, desc });
    PassDesc pass{ .area = { 0, 0, 1, 1 } };
    pass.layout.colorFormats = { Format::RGBA8, Format::RGBA8 };
    pass.layout.colorCount = 2;
    const auto pipeline = PipelineHandle::make(1, 1);
    RasterState raster{ .cull = CullMode::None, .depthClamp = true };
    commands.record(CmdCreatePipeline{ pipeline, { .program = program, .pass = pass.layout, .raster = raster } });
    commands.record(CmdCreateSampler{ SamplerHandle::make(1, 1), { .anisotropy = 16 } });
    for (uint32_t i = 0; i < 2; ++i) {
        pass.colors[i].texture = TextureHandle::make(i, 1);
        commands.record(CmdCreateTexture{ pass.colors[i].texture,
                                          { .usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource } });
    }
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdDraw{ .vertexCount = 3 });
    commands.record(CmdEndPass{});
    commands.record(CmdBeginTimer{ { 1 } });
    commands.record(CmdEndTimer{ { 1 } });
    commands.record(CmdReadTexture{ pass.colors[0].texture, 0, 0, { 0, 0, 1, 1 }, { 2 } });
    (*driver)->execute(commands.view());
    (*driver)->waitIdle();
    for (auto const& error : sink.errors) ADD_FAILURE() << error.message;
    ASSERT_EQ(sink.readbacks[2].size(), 4u);
    EXPECT_EQ(sink.readbacks[2][0], std::byte{ 255 });
    EXPECT_EQ(sink.timers.at(1), 0u) << "without timestamps a timer is answered with 0";
}

TEST(VulkanDriver, GoesOnWithoutValidationWhenTheLayerIsNotInstalled) {
    if (listVulkanDevices().empty()) GTEST_SKIP() << "no Vulkan device";
    const test::ScopedVariable layers("VK_LAYER_PATH", "/nonexistent"); // the loader reads it for each instance
    CollectingSink sink;
    const auto driver = createVulkanDriver({ .validation = true }, sink);
    ASSERT_TRUE(driver) << driver.error().message;
    ASSERT_EQ(sink.errors.size(), 1u);
    EXPECT_EQ(sink.errors[0].kind, DriverErrorKind::Validation);
    EXPECT_NE(sink.errors[0].message.find("install vulkan-validationlayers"), std::string::npos);
}

TEST(VulkanDriver, SeveralLiveOnSeveralThreads) {
    if (listVulkanDevices().empty()) GTEST_SKIP() << "no Vulkan device";
    std::array<bool, 4> succeeded{};
    std::vector<std::thread> threads;
    for (bool& success : succeeded) {
        threads.emplace_back([&success] {
            CollectingSink sink;
            auto driver = createVulkanDriver({}, sink);
            if (!driver) return;
            CommandBuffer commands;
            const auto target = TextureHandle::make(1, 1);
            commands.record(CmdCreateTexture{
                    target, { .usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource } });
            PassDesc pass{ .area = { 0, 0, 1, 1 } };
            pass.layout.colorFormats[0] = Format::RGBA8;
            pass.layout.colorCount = 1;
            pass.colors[0] = { .texture = target, .clear = { 1, 1, 1, 1 } };
            commands.record(CmdBeginPass{ pass });
            commands.record(CmdEndPass{});
            commands.record(CmdReadTexture{ target, 0, 0, { 0, 0, 1, 1 }, { 1 } });
            (*driver)->execute(commands.view());
            (*driver)->waitIdle();
            success = sink.readbacks[1] == std::vector<std::byte>(4, std::byte{ 255 });
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(succeeded, (std::array{ true, true, true, true }));
}

} // namespace
} // namespace filament_core::backend::vulkan
