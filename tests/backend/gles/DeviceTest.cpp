// SPDX-License-Identifier: Apache-2.0
// Devices, contexts, threads, frames.
#include "backend/gles/Driver.h"
#include "tests/backend/gles/GlesFixture.h"

#include <cstdio>
#include <cstdlib>
#include <thread>

namespace filament_core::backend::gles {
namespace {

using Rgba = std::array<uint8_t, 4>;

TEST(GlesDeviceTest, TheDriverRunsOnTheFirstListedDevice) {
    const std::vector<DeviceInfo> devices = listGlesDevices();
    ASSERT_FALSE(devices.empty());
    CollectingSink sink;
    Result<std::unique_ptr<Driver>> driver = createGlesDriver({}, sink);
    ASSERT_TRUE(driver) << driver.error().message;
    EXPECT_EQ((*driver)->info().deviceName, devices[0].deviceName);
    EXPECT_EQ((*driver)->info().shaderLanguage, ShaderLanguage::Essl310);
    EXPECT_GE((*driver)->info().limits.maxTextureSize, 2048u);
}

TEST(GlesDeviceTest, APartOfTheNameInAnyCaseSelectsADevice) {
    std::string name = listGlesDevices().at(0).deviceName;
    for (char& letter : name) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    CollectingSink sink;
    EXPECT_TRUE(createGlesDriver({ .requireDevice = name.substr(1) }, sink));
}

TEST(GlesDeviceTest, AnUnknownDeviceIsAnErrorThatListsTheKnownOnes) {
    CollectingSink sink;
    const Result<std::unique_ptr<Driver>> driver = createGlesDriver({ .requireDevice = "Voodoo 2" }, sink);
    ASSERT_FALSE(driver);
    EXPECT_EQ(driver.error().code, ErrorCode::DeviceUnavailable);
    EXPECT_NE(driver.error().message.find("Voodoo 2"), std::string::npos);
    EXPECT_NE(driver.error().message.find(listGlesDevices().at(0).deviceName), std::string::npos);
}

// A separate process in which libEGL finds no vendor library (libglvnd reads this variable).
TEST(GlesDeviceDeathTest, AMachineWithoutADriverIsToldWhatToInstall) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto tryWithoutDriver = [] {
        setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nowhere", 1);
        unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES"); // would come first
        CollectingSink sink;
        const Result<std::unique_ptr<Driver>> driver = createGlesDriver({}, sink);
        const bool right = !driver && driver.error().code == ErrorCode::DeviceUnavailable && listGlesDevices().empty();
        std::fputs(driver ? "a driver" : driver.error().message.c_str(), stderr);
        std::exit(right ? 0 : 1);
    };
    EXPECT_EXIT(tryWithoutDriver(), testing::ExitedWithCode(0), "install .*libegl-mesa0");
}

TEST(GlesDeviceTest, ListingDevicesLeavesTheCurrentContextCurrent) {
    Egl const& egl = **Egl::load();
    Result<Context> context = Context::create(egl, egl.displaySources().at(0), false);
    ASSERT_TRUE(context) << context.error().message;
    const EGLContext before = egl.GetCurrentContext();
    ASSERT_NE(before, EGL_NO_CONTEXT);
    listGlesDevices();
    EXPECT_EQ(egl.GetCurrentContext(), before);
    EXPECT_EQ(egl.QueryAPI(), static_cast<EGLenum>(EGL_OPENGL_ES_API));
}

TEST(GlesDeviceTest, ADestroyedDriverLeavesNoContextOnTheThread) {
    CollectingSink sink;
    { ASSERT_TRUE(createGlesDriver({}, sink)); }
    EXPECT_EQ((*Egl::load())->GetCurrentContext(), EGL_NO_CONTEXT);
}

TEST(GlesDeviceTest, AnExtensionIsFoundByItsWholeName) {
    EXPECT_TRUE(hasExtension("EGL_A EGL_AB", "EGL_A"));
    EXPECT_TRUE(hasExtension("EGL_AB EGL_A", "EGL_A"));
    EXPECT_FALSE(hasExtension("EGL_AB EGL_BA", "EGL_A"));
    EXPECT_FALSE(hasExtension(nullptr, "EGL_A"));
}

/// Clears an image to `value` and reads it back, `rounds` times.
bool clearsCorrectly(Driver& driver, CollectingSink& sink, uint8_t value, int rounds) {
    CommandBuffer commands;
    const TextureHandle image = TextureHandle::make(0, 1);
    DeviceTextureDesc desc;
    desc.usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource;
    desc.width = desc.height = 16;
    commands.record(CmdCreateTexture{ image, desc });
    for (int round = 1; round <= rounds; ++round) {
        commands.record(
                CmdBeginPass{ colorPass(image, Format::RGBA8, 16, 16, { static_cast<float>(value) / 255.0f }) });
        commands.record(CmdEndPass{});
        commands.record(CmdReadTexture{
                .texture = image, .rect = { 0, 0, 16, 16 }, .ticket = { static_cast<uint64_t>(round) } });
        commands.record(CmdEndFrame{});
        driver.execute(commands.view());
        commands.reset();
        driver.waitIdle();
        if (sink.readbacks[static_cast<uint64_t>(round)].at(0) != static_cast<std::byte>(value)) return false;
    }
    commands.record(CmdDestroyTexture{ image });
    driver.execute(commands.view());
    return driver.statistics().deviceBytes == 0 && sink.errors.empty();
}

TEST(GlesDeviceTest, TwoDriversOnOneThreadDoNotDisturbEachOther) {
    CollectingSink sinkA, sinkB;
    auto a = createGlesDriver({}, sinkA);
    auto b = createGlesDriver({}, sinkB);
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(clearsCorrectly(**a, sinkA, 10, 1));
    EXPECT_TRUE(clearsCorrectly(**b, sinkB, 20, 1));
    b = Result<std::unique_ptr<Driver>>(std::unique_ptr<Driver>());
    EXPECT_TRUE(clearsCorrectly(**a, sinkA, 30, 1)) << "the display outlives the driver that went";
}

TEST(GlesDeviceTest, DriversOnSeveralThreadsWorkAtTheSameTime) {
    std::array<bool, 4> right{};
    {
        std::vector<std::jthread> threads;
        for (size_t i = 0; i < right.size(); ++i) {
            threads.emplace_back([&right, i] {
                CollectingSink sink;
                auto driver = createGlesDriver({}, sink);
                right[i] = driver && clearsCorrectly(**driver, sink, static_cast<uint8_t>(10 * i), 20);
            });
        }
    }
    EXPECT_EQ(right, (std::array<bool, 4>{ true, true, true, true }));
}

TEST_F(GlesTest, TimersNest) {
    ASSERT_TRUE(driver->info().features.timers);
    const TextureHandle image = target(Format::RGBA8, 64, 64);
    commands.record(CmdBeginTimer{ { 1 } });
    commands.record(CmdBeginTimer{ { 2 } });
    commands.record(CmdBeginPass{ colorPass(image, Format::RGBA8, 64, 64) });
    commands.record(CmdEndPass{});
    commands.record(CmdEndTimer{ { 2 } });
    commands.record(CmdEndTimer{ { 1 } });
    commands.record(CmdEndFrame{});
    run();
    driver->waitIdle();
    ASSERT_EQ(sink.timers.size(), 2u);
    EXPECT_GE(sink.timers[1], sink.timers[2]);
    EXPECT_LT(sink.timers[1], 10'000'000'000u) << "a clear takes less than ten seconds";
}

TEST_F(GlesTest, ADeviceWithoutTimersAnswersZeroAtOnce) {
    start([](Quirks& quirks) { quirks.timers = false; });
    commands.record(CmdBeginTimer{ { 1 } });
    commands.record(CmdEndTimer{ { 1 } });
    run();
    EXPECT_EQ(sink.timers, (std::map<uint64_t, uint64_t>{ { 1, 0 } }));
}

TEST_F(GlesTest, AReadbackIsAnsweredByLaterFramesWithoutWaiting) {
    const TextureHandle image = target(Format::RGBA8, 4, 4);
    commands.record(CmdBeginPass{ colorPass(image, Format::RGBA8, 4, 4, { 1, 1, 1, 1 }) });
    commands.record(CmdEndPass{});
    commands.record(CmdReadTexture{ .texture = image, .rect = { 0, 0, 4, 4 }, .ticket = { 7 } });
    for (uint64_t frame = 0; frame < 4; ++frame) { // two frames in flight: the third waits for the first
        commands.record(CmdEndFrame{ frame });
        run();
    }
    EXPECT_EQ(sink.readbacks[7], std::vector<std::byte>(64, std::byte{ 255 }));
}

TEST_F(GlesTest, AnInvalidCallReachesTheSinkWhenValidating) {
    const TextureHandle image = texture({}); // 1 x 1
    const std::vector<uint8_t> four(16, 0);
    commands.record(CmdUploadTexture{ .texture = image, .rect = { 0, 0, 2, 2 }, .bytes = bytesOf(four) });
    run();
    expectError(DriverErrorKind::Validation, "glTexSubImage2D");
}

TEST_F(GlesTest, StatisticsCountCommandsPassesAndBytes) {
    const TextureHandle image = target(Format::RGBA8, 8, 8);
    buffer<float>({ 1, 2, 3 }, BufferUsage::Vertex);
    commands.record(CmdBeginPass{ colorPass(image, Format::RGBA8, 8, 8) });
    commands.record(CmdEndPass{});
    run();
    const DriverStatistics statistics = driver->statistics();
    EXPECT_EQ(statistics.commands, 5u); // create, create, update, begin, end
    EXPECT_EQ(statistics.passes, 1u);
    EXPECT_EQ(statistics.deviceBytes, 8u * 8u * 4u + 12u);
}

} // namespace
} // namespace filament_core::backend::gles
