// SPDX-License-Identifier: Apache-2.0
// The device itself: its description, specialisation, what it refuses, timers, lifetimes, traces.
#include "tests/backend/create/Gpu.h"

#include "backend/create/CreateDriver.h"
#include "backend/layers/Traced.h"

#include <gmock/gmock.h>

#include <bit>
#include <filesystem>

namespace filament_core::backend {
namespace {

using testing::Each;
using testing::HasSubstr;

DRIVER_SUITE(Device);

constexpr std::string_view kWhiteCode = "result = vec4(1.0);";

DRIVER_TEST(Device, TellsItsNameLimitsAndLanguage) {
    DeviceInfo const& info = gpu.info();
    EXPECT_FALSE(info.deviceName.empty());
    EXPECT_FALSE(info.driverName.empty());
    EXPECT_EQ(info.shaderLanguage, info.backend == Backend::Vulkan ? ShaderLanguage::SpirV : ShaderLanguage::Essl310);
    EXPECT_GE(info.limits.maxTextureSize, 4096u);
    EXPECT_GE(info.limits.maxUniformBlockBytes, 16384u);
    EXPECT_TRUE(std::has_single_bit(info.limits.uniformOffsetAlignment));
}

DRIVER_TEST(Device, StatisticsCountWhatWasReplayed) {
    const DriverStatistics before = gpu.statistics();
    const Program program = gpu.program(kFullScreenVertex, fragmentOf("", kWhiteCode));
    gpu.read(gpu.paint(program, {}), { 0, 0, 4, 4 });
    gpu.read(gpu.paint(program, {}), { 0, 0, 4, 4 });
    EXPECT_TRUE(gpu.takeErrors().empty()); // waits: an answer may come before its stream's numbers
    const DriverStatistics after = gpu.statistics();
    EXPECT_EQ(after.draws - before.draws, 2u);
    EXPECT_EQ(after.passes - before.passes, 2u);
    EXPECT_EQ(after.programsCreated - before.programsCreated, 1u);
    EXPECT_EQ(after.pipelinesCreated - before.pipelinesCreated, 2u);
    EXPECT_GT(after.commands, before.commands);
    EXPECT_GE(after.deviceBytes - before.deviceBytes, 2u * 4 * 4 * 16);
}

DRIVER_TEST(Device, SpecializationConstantsReplaceTheirDefaults) {
    constexpr std::string_view kConstants = R"(layout(constant_id = 0) const bool enabled = false;
layout(constant_id = 3) const int count = 2;
layout(constant_id = 7) const float scale = 0.5;)";
    const std::string text = fragmentOf(kConstants, R"(float sum = 0.0;
    for (int i = 0; i < count; ++i) sum += scale;
    result = vec4(enabled ? 1.0 : 0.0, float(count), scale, sum);)");
    const auto seen = [&](std::vector<ConstantValue> const& constants) {
        return gpu.readAs<Rgba>(gpu.paint(gpu.program(kFullScreenVertex, text, constants), { .width = 1, .height = 1 }),
                                { 0, 0, 1, 1 })[0];
    };
    using enum ConstantValue::Type;
    EXPECT_EQ(seen({}), (Rgba{ 0, 2, 0.5f, 1 }));
    EXPECT_EQ(seen({ { 3, 5, Int } }), (Rgba{ 0, 5, 0.5f, 2.5f }));
    EXPECT_EQ(seen({ { 0, 1, Bool },
                     { 3, static_cast<uint32_t>(-7), Int },
                     { 7, std::bit_cast<uint32_t>(0.1f), Float } }),
              (Rgba{ 1, -7, 0.1f, 0 }));
}

// ---------------------------------------------------------------------------------------------- refusals

DRIVER_TEST(Device, AProgramThatDoesNotCompileIsReportedByNameAndItsDrawsAreSkipped) {
    // SPIR-V: a header with an empty module; ESSL: an undeclared name.
    const std::array<uint32_t, 5> header{ 0x07230203, 0x00010300, 0, 1, 0 };
    const std::string_view spirv(reinterpret_cast<const char*>(header.data()), sizeof(header));
    constexpr std::string_view kEssl = "#version 310 es\nvoid main() { undeclared = 1.0; }\n";
    const bool isVulkan = gpu.backend() == Backend::Vulkan;
    const ProgramHandle broken = gpu.rawProgram(isVulkan ? spirv : kEssl, isVulkan ? spirv : kEssl);
    const TextureHandle target = gpu.paint({ broken, {} }, { .width = 2, .height = 2 });
    EXPECT_THAT(gpu.readAs<Rgba>(target, { 0, 0, 2, 2 }), Each(Rgba{})) << "the clear happens, the draw does not";
    const std::vector<DriverError> errors = gpu.takeErrors();
    ASSERT_FALSE(errors.empty());
    EXPECT_EQ(errors.front().kind, DriverErrorKind::ShaderCompile);
    EXPECT_THAT(errors.front().message, HasSubstr("broken program"));

    const Program good = gpu.program(kFullScreenVertex, fragmentOf("", kWhiteCode));
    EXPECT_THAT(gpu.readAs<Rgba>(gpu.paint(good, { .width = 2, .height = 2 }), { 0, 0, 2, 2 }),
                Each(Rgba{ 1, 1, 1, 1 }))
            << "life goes on";
}

DRIVER_TEST(Device, ATextureThatDoesNotFitIsReportedByNameAndLifeGoesOn) {
    const uint32_t size = gpu.info().limits.maxTextureSize;
    const TextureHandle huge = gpu.texture({ .type = TextureKind::Texture2DArray,
                                             .format = Format::RGBA32F,
                                             .usage = TextureUsage::TransferTarget,
                                             .layers = 2048,
                                             .width = size,
                                             .height = size,
                                             .debugName = "far too large" });
    gpu.upload(huge, { 0, 0, 1, 1 }, Bytes(16)); // on a refused object: ignored
    const std::vector<DriverError> errors = gpu.takeErrors();
    ASSERT_FALSE(errors.empty());
    EXPECT_EQ(errors.front().kind, DriverErrorKind::OutOfMemory);
    EXPECT_THAT(errors.front().message, HasSubstr("far too large"));
    const Program good = gpu.program(kFullScreenVertex, fragmentOf("", kWhiteCode));
    EXPECT_THAT(gpu.readAs<Rgba>(gpu.paint(good, { .width = 2, .height = 2 }), { 0, 0, 2, 2 }),
                Each(Rgba{ 1, 1, 1, 1 }));
}

DRIVER_TEST(Device, ABrokenStreamIsDroppedByTheValidatedLayerBeforeTheDriverSeesIt) {
    gpu.record(CmdDraw{ .vertexCount = 3 });
    const std::vector<DriverError> errors = gpu.takeErrors();
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_THAT(errors[0].message, HasSubstr("only inside a pass"));
    EXPECT_THAT(errors[1].message, HasSubstr("was dropped"));
    const Program good = gpu.program(kFullScreenVertex, fragmentOf("", kWhiteCode));
    EXPECT_THAT(gpu.readAs<Rgba>(gpu.paint(good, { .width = 2, .height = 2 }), { 0, 0, 2, 2 }),
                Each(Rgba{ 1, 1, 1, 1 }));
}

// ---------------------------------------------------------------------------------------------- time and lifetimes

DRIVER_TEST(Device, NestedTimersAreAnsweredOnceAndTheOuterOneTakesNoLess) {
    if (!gpu.info().features.timers) GTEST_SKIP() << "this device has no timers";
    const Program program = gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(sin(gl_FragCoord.x));"));
    const Ticket outer = gpu.nextTicket(), inner = gpu.nextTicket();
    gpu.record(CmdBeginTimer{ outer });
    const TextureHandle warm = gpu.paint(program, { .width = 256, .height = 256 });
    gpu.record(CmdBeginTimer{ inner });
    const TextureHandle target = gpu.paint(program, { .width = 256, .height = 256 });
    gpu.record(CmdEndTimer{ inner });
    gpu.record(CmdEndTimer{ outer });
    static_cast<void>(warm), static_cast<void>(target);
    const uint64_t innerTime = gpu.timerOf(inner), outerTime = gpu.timerOf(outer);
    EXPECT_GT(innerTime, 0u);
    EXPECT_GE(outerTime, innerTime);
    EXPECT_LT(outerTime, 60'000'000'000u) << "nanoseconds, not ticks";
}

DRIVER_TEST(Device, ObjectsDestroyedRightAfterTheirUseAreKeptUntilTheDeviceIsDone) {
    // The kit destroys its objects at the end; here everything is destroyed in the stream that uses it, and its memory
    // is reused.
    for (int round = 0; round < 3; ++round) {
        Gpu inner = gpu.another();
        const Program program =
                inner.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform sampler2D image;",
                                                            "result = texelFetch(image, ivec2(0), 0);"));
        const float value = static_cast<float>(round) + 0.5f;
        const TextureHandle image = inner.image(Format::R32F, 1, 1, bytesOf(std::vector<float>{ value }));
        const TextureHandle target = inner.paint(
                program, { .width = 2, .height = 2, .group = inner.imageGroup(program, image, inner.sampler()) });
        const Ticket ticket = inner.nextTicket();
        inner.record(CmdReadTexture{ .texture = target, .rect = { 0, 0, 2, 2 }, .ticket = ticket });
        inner.destroyAll();
        // New objects with the same indices and other contents, still in the same stream.
        const TextureHandle other = inner.image(Format::R32F, 1, 1, bytesOf(std::vector<float>{ -1 }));
        static_cast<void>(other);
        const Bytes bytes = inner.wait(ticket);
        ASSERT_EQ(bytes.size(), 64u);
        float seen = 0;
        std::memcpy(&seen, bytes.data(), sizeof(seen));
        EXPECT_EQ(seen, value);
        inner.finish();
    }
}

DRIVER_TEST(Device, APipelineOutlivesTheProgramItWasMadeFrom) {
    const Program program = gpu.program(kFullScreenVertex, fragmentOf("", kWhiteCode));
    const TextureHandle target = gpu.target(Format::RGBA32F, 2, 2);
    const PassDesc pass = passOver({ { target, Format::RGBA32F } }, 2, 2);
    const PipelineHandle pipeline = gpu.pipeline(pipelineFor(program, pass.layout));
    gpu.destroyEarly(program.handle);
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    EXPECT_THAT(gpu.readAs<Rgba>(target, { 0, 0, 2, 2 }), Each(Rgba{ 1, 1, 1, 1 }));
}

// ---------------------------------------------------------------------------------------------- traces

DRIVER_TEST(Device, AReplayedTraceGivesTheSameBitsOnAFreshDevice) {
    const Backend type = gpu.backend();
    const char* const name = type == Backend::Vulkan ? "filament_vulkan.trace" : "filament_gles.trace";
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
    Bytes original;
    {
        auto stream = CommandStream::start([&](ResultSink& sink) -> Result<std::unique_ptr<Driver>> {
            Result<std::unique_ptr<Driver>> driver = createDriver(type, {}, sink);
            if (!driver) return driver.error();
            return trace(std::move(*driver), path);
        });
        ASSERT_TRUE(stream.ok()) << stream.error().message;
        Gpu traced(**stream);
        const Program program =
                traced.program(kFullScreenVertex,
                               fragmentOf("layout(set = 1, binding = 0) uniform sampler2D image;",
                                          "result = texture(image, gl_FragCoord.yx * 0.07) * sin(gl_FragCoord.x);"));
        std::vector<float> texels(64);
        for (size_t i = 0; i < 64; ++i) texels[i] = static_cast<float>(i) * 0.37f;
        const TextureHandle image = traced.image(Format::R32F, 8, 8, bytesOf(texels));
        const SamplerHandle sampler = traced.sampler({ .magFilter = Filter::Linear, .wrapU = WrapMode::Repeat });
        const TextureHandle target = traced.paint(
                program, { .width = 32, .height = 32, .group = traced.imageGroup(program, image, sampler) });
        original = traced.read(target, { 0, 0, 32, 32 });
        traced.finish();
    }
    auto fresh = CommandStream::start([&](ResultSink& sink) { return createDriver(type, {}, sink); });
    ASSERT_TRUE(fresh.ok()) << fresh.error().message;
    const Result<std::vector<Ticket>> tickets = replayTrace(path, **fresh);
    ASSERT_TRUE(tickets.ok()) << tickets.error().message;
    ASSERT_EQ(tickets->size(), 1u);
    const Result<Bytes> again = (*fresh)->waitReadback(tickets->front());
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(*again, original);
    std::filesystem::remove(path);
    std::filesystem::remove(path.string() + ".bin");
}

} // namespace
} // namespace filament_core::backend
