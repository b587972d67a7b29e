// SPDX-License-Identifier: Apache-2.0
// What a driver draws without the cure of a quirk. tests/backend/create requires what it draws with the cure.
#include "backend/create/SelfTest.h"
#include "tests/backend/vulkan/DriverFixture.h"

#include <cstdio>

namespace filament_core::backend::vulkan {
namespace {

/// The major version of Mesa, 0 for drivers other than lavapipe.
int lavapipeOf(DeviceInfo const& info) {
    int major = 0;
    const bool isMesa = std::sscanf(info.driverName.c_str(), "Mesa %d.", &major) == 1;
    return isMesa && info.deviceName.starts_with("llvmpipe") ? major : 0;
}

class QuirkTest : public DriverTest {
protected:
    void SetUp() override {} // each test starts its driver

    void drawDepthAlone() {
        PassLayout layout{ .depthFormat = Format::D32F };
        const ProgramHandle program = makeProgram(kFullScreenVertex, "void main() {}");
        const PipelineHandle pipeline = makePipeline({ .program = program, .pass = layout, .raster = kNoCulling });
        PassDesc pass{ .layout = layout, .area = { 0, 0, 1, 1 } };
        pass.depth = { .texture = makeTarget(1, 1, Format::D32F) };
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ pipeline });
        commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
    }

    /// Of a program that writes white to attachment 1 of 2 and leaves attachment 0 alone; both were cleared to red.
    Rgba8 drawSecondAttachment() {
        PassLayout layout{ .colorFormats = { Format::RGBA8, Format::RGBA8 }, .colorCount = 2 };
        const ProgramHandle program = makeProgram(kFullScreenVertex, R"(
            layout(location = 1) out vec4 color;
            void main() { color = vec4(1.0); })");
        const PipelineHandle pipeline = makePipeline({ .program = program, .pass = layout, .raster = kNoCulling });
        const TextureHandle second = makeTarget(1, 1);
        PassDesc pass{ .layout = layout, .area = { 0, 0, 1, 1 } };
        pass.colors[0] = { .texture = makeTarget(1, 1), .clear = { 1, 0, 0, 1 } };
        pass.colors[1] = { .texture = second, .clear = { 1, 0, 0, 1 } };
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ pipeline });
        commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
        return readPixels(second, 1, 1)[0];
    }

    static constexpr Rgba8 kWhite{ 255, 255, 255, 255 };
};

TEST_F(QuirkTest, DepthAloneTakesTheBlendingOfAttachmentsWithoutItsCure) {
    start([](Quirks& quirks) { quirks.clearsIndependentBlend = false; });
    if (!driver) return;
    EXPECT_EQ(drawSecondAttachment(), kWhite) << "without a pass of depth alone";
    drawDepthAlone();
    const Rgba8 seen = drawSecondAttachment();
    const int mesa = lavapipeOf(driver->info());
    if (mesa >= 25) {
        EXPECT_EQ(seen, kRed) << driver->info().driverName << " draws right: say so in Quirks.h";
    } else if (mesa <= 22) { // versions in between are untested
        EXPECT_EQ(seen, kWhite) << driver->info().driverName;
    }
}

/// The self-test of drivers would have seen what the quirk cures.
TEST_F(QuirkTest, TheSelfTestRefusesADriverWithoutItsCure) {
    DeviceInfo info;
    const auto made = makeTestedDriver(
            [&](ResultSink& results) -> Result<std::unique_ptr<Driver>> {
                auto executor =
                        Executor::create({}, results, [](Quirks& quirks) { quirks.clearsIndependentBlend = false; });
                if (!executor) return executor.error();
                info = (*executor)->info();
                return std::unique_ptr<Driver>(std::move(*executor));
            },
            sink, {});
    if (info.deviceName.empty()) GTEST_SKIP() << made.error().message;
    const int mesa = lavapipeOf(info);
    if (mesa >= 25) {
        EXPECT_FALSE(made) << info.driverName;
    } else if (mesa <= 22) {
        EXPECT_TRUE(made) << made.error().message;
    }
}

TEST_F(QuirkTest, DepthAloneLeavesTheBlendingOfAttachmentsWithItsCure) {
    start();
    if (!driver) return;
    drawDepthAlone();
    EXPECT_EQ(drawSecondAttachment(), kWhite);
}

} // namespace
} // namespace filament_core::backend::vulkan
