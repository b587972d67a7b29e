// SPDX-License-Identifier: Apache-2.0
// The path tracer in the background: the same bits as in the foreground, and it ends when it is told to.
#include "tools/view/compare/ProgressiveReference.h"

#include "tests/tools/reference/TestScenes.h"
#include "tools/view/compare/Comparison.h"

#include <gmock/gmock.h>

#include <chrono>
#include <ctime>
#include <thread>

namespace filament_core::view {
namespace {

using namespace reference;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using State = TracingStatus::State;
using ::testing::HasSubstr;

ReferenceScene ballScene() {
    auto model = makeModel(spherePrimitive(12), lambert(0.7f));
    ReferenceScene scene{ .models = { { model } } };
    scene.environment = { .image = makeSky(16, [](double3 d) { return float3(float(1.2 + d.y)); }),
                          .illuminance = Lux{ 1 } };
    scene.suns = { { .directionWorld = { -1, -2, 0 }, .illuminance = Lux{ 2 } } };
    return scene;
}

const ReferenceView kSmallView = viewFrom({ 2, 1.5, 3 }, { 0, 0, 0 }, { 16, 12 }, 40);
const ReferenceView kOtherView = viewFrom({ -2, 1, 3 }, { 0, 0, 0 }, { 12, 16 }, 50);
const ReferenceView kLargeView = viewFrom({ 2, 1.5, 3 }, { 0, 0, 0 }, { 1600, 1200 }, 40);

SceneLoader loaderOf(ReferenceScene scene) {
    return [scene = std::move(scene)](jobs::JobSystem&) -> Result<ReferenceScene> { return scene; };
}

template <class Reached>
bool waitUntil(Reached const& reached) {
    const auto deadline = Clock::now() + 60s;
    while (!reached() && Clock::now() < deadline) std::this_thread::sleep_for(1ms);
    return reached();
}

std::optional<TracedView> lastPicture(ProgressiveReference& tracer) {
    waitUntil([&] { return tracer.status().state == State::Finished || tracer.status().state == State::Failed; });
    EXPECT_EQ(tracer.status().error, "");
    return tracer.takePicture();
}

TEST(ProgressiveReference, EndsWithTheBitsOfTheReferenceOfAsManySamples) {
    ProgressiveReference tracer;
    tracer.setScene(loaderOf(ballScene()));
    for (const uint32_t samples : { 2u, 16u, 40u }) {
        const ReferenceSettings settings{ .samplesPerPixel = samples };
        const uint64_t number = tracer.setView(kSmallView, settings);
        const auto picture = lastPicture(tracer);
        ASSERT_TRUE(picture);
        const ReferenceImage whole = rendered(ballScene(), kSmallView, settings, 2);
        EXPECT_EQ(picture->image.color, whole.color) << samples;
        EXPECT_EQ(picture->image.standardError, whole.standardError) << samples;
        EXPECT_EQ(picture->view, number);
        EXPECT_TRUE(picture->isFinished);
        EXPECT_EQ(tracer.status().samplesDone, whole.statistics.samplesPerPixel);
        EXPECT_FALSE(tracer.takePicture()) << "once";
    }
}

TEST(ProgressiveReference, TracesTheLastViewWhateverWasAskedBefore) {
    ProgressiveReference tracer;
    tracer.setScene(loaderOf(ballScene()));
    const ReferenceSettings settings{ .samplesPerPixel = 8 };
    const std::vector<float3> expected = rendered(ballScene(), kOtherView, settings, 0).color;
    for (int round = 0; round < 20; ++round) {
        tracer.setView(kLargeView, { .samplesPerPixel = 64 });
        std::this_thread::sleep_for(round * 1ms); // ends it in different places
        const uint64_t number = tracer.setView(kOtherView, settings);
        const auto picture = lastPicture(tracer);
        ASSERT_TRUE(picture) << round;
        EXPECT_EQ(picture->view, number);
        EXPECT_EQ(picture->image.color, expected) << round;
    }
}

/// Of all threads of this process. Other programs may hold the cores for any time, but take none of this.
double processorMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

/// A pass takes minutes, what is left after stop() 20 to 70 ms, by the speed of the machine.
TEST(ProgressiveReference, StopsLongBeforeItsPassEnds) {
    ProgressiveReference tracer;
    tracer.setScene(loaderOf(ballScene()));
    for (int round = 0; round < 5; ++round) {
        tracer.setView(kLargeView, { .samplesPerPixel = 1024 });
        ASSERT_TRUE(waitUntil([&] { return tracer.status().state == State::Tracing; }));
        const double start = processorMilliseconds();
        tracer.stop();
        EXPECT_EQ(tracer.status().state, State::Idle);
        EXPECT_FALSE(tracer.takePicture());
        ASSERT_TRUE(waitUntil([&] { return !tracer.status().isBusy; }));
        EXPECT_LT(processorMilliseconds() - start, 1000) << round;
    }
}

TEST(ProgressiveReference, ThePicturesBeforeTheLastOneAreThoseThatWereStoppedThere) {
    jobs::JobSystem jobs({ .workers = 0 });
    const ReferenceScene scene = ballScene();
    const auto traced = prepare(scene, jobs);
    ASSERT_TRUE(traced.ok());
    const ReferenceSettings settings{ .samplesPerPixel = 64 };
    auto progressive = ProgressiveRender::start(**traced, kSmallView, settings);
    ASSERT_TRUE(progressive.ok());
    for (uint32_t passes = 1; !progressive->isFinished(); ++passes) {
        ASSERT_TRUE(progressive->runPass(jobs));
        uint32_t left = passes;
        const auto stopped =
                render(**traced, kSmallView, settings, jobs, [&](RenderProgress const&) { return --left > 0; });
        ASSERT_TRUE(stopped.ok());
        EXPECT_EQ(progressive->image().color, stopped->color) << passes;
        EXPECT_EQ(progressive->progress().samplesDone, stopped->statistics.samplesPerPixel);
    }
}

TEST(ProgressiveReference, ACancelledPassIsPartOfNoPicture) {
    jobs::JobSystem jobs({ .workers = 0 });
    const ReferenceScene scene = ballScene();
    const auto traced = prepare(scene, jobs);
    ASSERT_TRUE(traced.ok());
    auto progressive = ProgressiveRender::start(**traced, kSmallView, { .samplesPerPixel = 4 });
    ASSERT_TRUE(progressive.ok());
    jobs::Cancellation cancelled;
    cancelled.request();
    EXPECT_FALSE(progressive->runPass(jobs, &cancelled));
    EXPECT_EQ(progressive->progress().samplesDone, 0u);
    EXPECT_FALSE(ProgressiveRender::start(**traced, kSmallView, { .samplesPerPixel = 0 }).ok());
}

TEST(ProgressiveReference, SaysWhatIsWrongAndGoesOnWithTheNextScene) {
    ProgressiveReference tracer;
    EXPECT_EQ(tracer.status().state, State::Idle);
    tracer.setView(kSmallView, { .samplesPerPixel = 4 });
    tracer.setScene([](jobs::JobSystem&) -> Result<ReferenceScene> {
        return fail(ErrorCode::NotFound, "there is no 'ball.gltf'");
    });
    ASSERT_TRUE(waitUntil([&] { return tracer.status().state == State::Failed; }));
    EXPECT_EQ(tracer.status().error, "there is no 'ball.gltf'");
    tracer.setScene(loaderOf({ .models = { {} } }));
    ASSERT_TRUE(waitUntil([&] { return tracer.status().state == State::Failed; }));
    EXPECT_FALSE(tracer.status().error.empty());
    tracer.setScene(loaderOf(ballScene()));
    EXPECT_TRUE(lastPicture(tracer));
    tracer.setView(kSmallView, { .samplesPerPixel = 0 });
    ASSERT_TRUE(waitUntil([&] { return tracer.status().state == State::Failed; }));
    EXPECT_THAT(tracer.status().error, HasSubstr("samples per pixel 0"));
    tracer.setView(kOtherView, { .samplesPerPixel = 4 });
    EXPECT_TRUE(lastPicture(tracer));
}

TEST(ProgressiveReference, PicturesCompareWithThoseOfTheEngine) {
    const ReferenceImage traced = rendered(ballScene(), kSmallView, { .samplesPerPixel = 4 }, 0);
    const Image light = linearPicture(traced), display = displayPicture(traced, {});
    EXPECT_EQ(light.format, Format::RGBA16F);
    EXPECT_EQ(compareImages(light, light)->percentage(), "100.0000 %");
    EXPECT_EQ(display.format, Format::RGBA8);
    EXPECT_EQ(compareImages(display, display)->pixels, 16u * 12);
}

} // namespace
} // namespace filament_core::view
