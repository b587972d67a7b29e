// SPDX-License-Identifier: Apache-2.0
// Nobody waits while files load: what a step of the viewer costs its thread, frames aside.
#include "filament_core/assets/environment/AnalyticSky.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/tools/view/app/TestScene.h"
#include "toolkit/materials/MaterialFile.h"
#include "toolkit/paths/Paths.h"
#include "tools/view/app/Viewer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>
#include <vector>

namespace filament_core::view {
namespace {

using Clock = std::chrono::steady_clock;

/// Of the processor time of the process while something loads. What must not happen in a step, as compiling a material
/// or decoding an image, is at least a tenth of it on every machine.
constexpr double kLongestStep = 1.0 / 20;

/// 4096 x 2048, baked by the first run on a machine: a smaller sky with every pixel four times.
std::filesystem::path largeSky() {
    jobs::JobSystem jobs({ .workers = 1 });
    const Result<assets::HdrImage> small = assets::makeAnalyticSky({ .sunDisc = false }, jobs);
    EXPECT_TRUE(small.ok());
    assets::HdrImage large{ .width = 4096, .height = 2048, .pixels = std::vector<float3>(size_t{ 4096 } * 2048) };
    for (uint32_t y = 0; y < large.height; ++y)
        for (uint32_t x = 0; x < large.width; ++x)
            large.at(x, y) = small->at(x * small->width / large.width, y * small->height / large.height);
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "responsiveness-sky.hdr";
    EXPECT_TRUE(assets::writeHdr(file, large).ok());
    return file;
}

struct Steps {
    std::vector<double> seconds; ///< ascending
    double ofProcess = 0;        ///< seconds of processor time, of all threads
    double longest() const { return seconds.empty() ? 0 : seconds.back(); }
    double quantile(double share) const {
        return seconds.empty() ? 0 : seconds[static_cast<size_t>(share * static_cast<double>(seconds.size() - 1))];
    }
};

/// Steps until everything is there and was drawn.
Steps load(Viewer& viewer) {
    Steps steps;
    const Clock::time_point end = Clock::now() + std::chrono::minutes(5);
    const std::clock_t before = std::clock();
    const auto step = [&] {
        viewer.step(0.01);
        steps.seconds.push_back(viewer.lastStep().other);
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // the workers' turn
    };
    step();
    while ((viewer.isLoading() || viewer.idleSeconds() < 0.1) && Clock::now() < end) step();
    EXPECT_FALSE(viewer.isLoading());
    std::ranges::sort(steps.seconds);
    steps.ofProcess = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    return steps;
}

void expectQuick(Steps const& steps, std::string const& what) {
    const auto milliseconds = [](double seconds) { return fmt::format("{:.2f} ms", 1000 * seconds); };
    const std::string line = fmt::format("{}: {} steps, p99 {}, longest {} of {}", what, steps.seconds.size(),
                                         milliseconds(steps.quantile(0.99)), milliseconds(steps.longest()),
                                         milliseconds(steps.ofProcess));
    std::printf("[          ] %s\n", line.c_str());
    EXPECT_LT(steps.longest(), kLongestStep * steps.ofProcess) << line;
}

class ResponsivenessTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        ViewerOptions options = testOptions(GetParam());
        options.validation = false; // checks are not what users wait for
        auto made = Viewer::create(options, showcaseDocument({ 320, 180 }), { .pixels = { 320, 180 } });
        ASSERT_TRUE(made.ok()) << made.error().message;
        mViewer = std::move(*made);
    }
    void expectNoMessages() {
        for (std::string const& message : mViewer->takeMessages()) ADD_FAILURE() << message;
    }

    std::unique_ptr<Viewer> mViewer;
};

INSTANTIATE_TEST_SUITE_P(Apis, ResponsivenessTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(ResponsivenessTest, NoStepIsLongWhileAModelAndALargeSkyLoad) {
    if (!mViewer) return;
    expectQuick(load(*mViewer), "the showcase");
    mViewer->handle(DropEvent{ { largeSky() } });
    expectQuick(load(*mViewer), "a sky of 4096 x 2048");
    mViewer->perform(Action::Reload);
    expectQuick(load(*mViewer), "both again");
    expectNoMessages();
}

TEST_P(ResponsivenessTest, NoStepIsLongWhileAMaterialIsCompiled) {
    if (!mViewer) return;
    load(*mViewer);
    const std::filesystem::path file = tools::sourceDir() / "samples/materials/blend_add.mat";
    ASSERT_TRUE(std::filesystem::exists(file));
    tools::forgetCompiledMaterialFiles();
    mViewer->handle(DropEvent{ { file } });
    expectQuick(load(*mViewer), "a material");
    EXPECT_EQ(mViewer->stage().shownFile(), file);
    expectNoMessages();
}

TEST_P(ResponsivenessTest, NoStepIsLongWhileModelsOfUsersLoad) {
    if (!mViewer) return;
    if (tools::assetDir().empty())
        GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    load(*mViewer);
    const std::filesystem::path models = tools::assetDir() / "models";
    for (const char* name : { "LittlestTokyo/LittlestTokyo.glb", "FlightHelmet/FlightHelmet.gltf" }) {
        mViewer->handle(DropEvent{ { models / name } });
        expectQuick(load(*mViewer), name);
        EXPECT_EQ(mViewer->stage().shownFile(), models / name);
    }
    mViewer->takeMessages(); // warnings of the models
}

} // namespace
} // namespace filament_core::view
