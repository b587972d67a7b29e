// SPDX-License-Identifier: Apache-2.0
// The controller of dynamic resolution on frames whose time is known: a fixed part and one that grows with the pixels.
// It settles within the frames that it promises, does not oscillate, and holds the target where that is possible.
#include <filament_core/ResolutionController.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace filament_core {
namespace {

/// Milliseconds of a frame of a share of the pixels.
using Load = std::function<double(int frame, double share)>;

Load load(double fixed, double ofPixels) {
    return [=](int, double share) { return fixed + ofPixels * share; };
}

struct Frames {
    std::vector<float2> scales; ///< by frame
    std::vector<double> times;

    int changes(size_t from = 0) const {
        int count = 0;
        for (size_t i = std::max<size_t>(from, 1); i < scales.size(); ++i) count += scales[i] != scales[i - 1];
        return count;
    }
    /// The first frame after which nothing changes.
    size_t settled() const {
        size_t frame = scales.size() - 1;
        while (frame > 0 && scales[frame - 1] == scales.back()) --frame;
        return frame;
    }
};

constexpr Resolution kDynamic{ .dynamic = true };

/// Frames finish two frames after they began.
Frames run(ResolutionController& controller, Resolution const& options, int frames, Load const& load) {
    constexpr size_t kAhead = 2;
    Frames done;
    for (int frame = 0; frame < frames; ++frame) {
        if (done.scales.size() >= kAhead) {
            const size_t finished = done.scales.size() - kAhead;
            controller.add(options, { done.scales[finished], done.times[finished] });
        }
        const float2 scale = controller.scale(options);
        done.scales.push_back(scale);
        done.times.push_back(load(frame, double(scale.x) * double(scale.y)));
    }
    return done;
}
Frames run(Resolution const& options, int frames, Load const& load) {
    ResolutionController controller;
    return run(controller, options, frames, load);
}

TEST(ResolutionController, KeepsTheLargestScaleWhileThereIsTime) {
    const Frames fast = run(kDynamic, 200, load(2, 10));
    EXPECT_EQ(fast.changes(), 0);
    EXPECT_EQ(fast.scales.back(), float2(1));
}

TEST(ResolutionController, SettlesBelowTheTargetAfterAStep) {
    for (const double fixed : { 0.0, 2.0, 6.0, 9.0 }) {
        for (const double ofPixels : { 8.0, 12.0, 20.0, 28.0 }) {
            const Frames slow = run(kDynamic, 400, load(fixed, ofPixels));
            const bool isPossible = fixed + ofPixels / 4 <= 16;
            EXPECT_TRUE(isPossible ? slow.times.back() <= 16 : slow.scales.back() == float2(0.5f))
                    << fixed << " " << ofPixels << ": " << slow.times.back();
            // Three changes: the fixed part is found in steps, each of which the model takes for pixels.
            EXPECT_LE(slow.changes(), 3) << fixed << " " << ofPixels;
            EXPECT_LE(slow.settled(), 3u * (8 + 2)) << fixed << " " << ofPixels;
            for (size_t i = 1; i < slow.scales.size(); ++i)
                EXPECT_LE(slow.scales[i].x, slow.scales[i - 1].x) << "never up again";
        }
    }
}

TEST(ResolutionController, UsesTheTimeThatThereIs) {
    const Frames slow = run(kDynamic, 400, load(0, 24));
    const double next = 24 * std::pow(double(slow.scales.back().x) + 1.0 / 32, 2);
    EXPECT_GT(next, 16 * 0.9) << "one step more would leave less than the headroom";
}

TEST(ResolutionController, ReturnsWhenTheLoadDoes) {
    ResolutionController controller;
    (void)run(controller, kDynamic, 100, load(1, 30));
    EXPECT_LT(controller.scale(kDynamic).x, 0.75f);
    const Frames back = run(controller, kDynamic, 200, load(1, 10));
    EXPECT_EQ(back.scales.back(), float2(1));
    EXPECT_LE(back.settled(), 4u * (8 + 2));
    for (size_t i = 1; i < back.scales.size(); ++i) EXPECT_GE(back.scales[i].x, back.scales[i - 1].x);
}

TEST(ResolutionController, IgnoresNoiseBelowTheHeadroomAndSingleSpikes) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.04, 0.04);
    const Frames noisy = run(kDynamic, 3000, [&](int frame, double share) {
        const double spike = frame % 37 == 0 ? 25 : 0;
        return (1 + 22 * share) * (1 + noise(random)) + spike;
    });
    EXPECT_LE(noisy.changes(100), 1);
    EXPECT_LE(noisy.changes(), 4);
}

TEST(ResolutionController, FollowsARampWithoutGoingBackAndForth) {
    const auto ramp = [](int frame, double share) { return 1 + (10 + 20 * std::min(frame / 600.0, 1.0)) * share; };
    const Frames rising = run(kDynamic, 1200, ramp);
    for (size_t i = 1; i < rising.scales.size(); ++i) EXPECT_LE(rising.scales[i].x, rising.scales[i - 1].x);
    // A change answers a median: half of its frames, and those on the way, are late by so much of the ramp.
    const double late = 20.0 / 600 * (8 + 2) + 1e-9;
    for (size_t i = 0; i < rising.times.size(); ++i) EXPECT_LE(rising.times[i], 16 + late) << i;
    EXPECT_LE(rising.times.back(), 16);
}

TEST(ResolutionController, StaysBetweenItsBounds) {
    Resolution options = kDynamic;
    options.scale = float2(0.9f, 0.8f);
    options.leastScale = 0.6f;
    const Frames slow = run(options, 300, load(0, 1000));
    EXPECT_EQ(slow.scales.front(), options.scale);
    EXPECT_GE(std::min(slow.scales.back().x, slow.scales.back().y), 0.6f);
    EXPECT_LT(std::min(slow.scales.back().x, slow.scales.back().y), 0.6f + 1.0f / 32) << "the last step above it";
    options.leastScale = 1;
    EXPECT_EQ(run(options, 300, load(0, 1000)).changes(), 0) << "no room";
}

TEST(ResolutionController, NotUniformShrinksTheWidthFirst) {
    Resolution options = kDynamic;
    options.uniform = false;
    const Frames half = run(options, 300, load(0, 24));
    EXPECT_EQ(half.scales.back().y, 1.0f);
    EXPECT_LT(half.scales.back().x, 0.7f);
    EXPECT_LE(half.times.back(), 16);
    const Frames quarter = run(options, 300, load(0, 1000));
    EXPECT_NEAR(quarter.scales.back().x, 0.5f, 1e-6f);
    EXPECT_NEAR(quarter.scales.back().y, 0.5f, 1e-6f);
}

TEST(ResolutionController, HasFewSizes) {
    for (const bool isUniform : { true, false }) {
        Resolution options = kDynamic;
        options.uniform = isUniform;
        for (int i = 0; i < 100; ++i) {
            const Frames one = run(options, 100, load(i * 0.1, 16 + i));
            for (float2 const& scale : one.scales) {
                const float steps = (isUniform ? scale.x : std::sqrt(scale.x * scale.y)) * 32;
                EXPECT_NEAR(steps, std::round(steps), 1e-4f);
            }
        }
    }
}

TEST(ResolutionController, IsOffUnlessAsked) {
    Resolution options{ .scale = float2(0.7f, 0.6f) };
    EXPECT_EQ(run(options, 100, load(0, 1000)).changes(), 0);
    EXPECT_EQ(ResolutionController().scale(options), options.scale);
}

TEST(ResolutionController, TakesHardTimesForNone) {
    ResolutionController controller;
    for (const double time : { 0.0, -1.0, double(NAN), -HUGE_VAL })
        for (int i = 0; i < 64; ++i) controller.add(kDynamic, { float2(1), time });
    EXPECT_EQ(controller.scale(kDynamic), float2(1));
    for (int i = 0; i < 8; ++i) controller.add(kDynamic, { float2(1), HUGE_VAL });
    EXPECT_EQ(controller.scale(kDynamic), float2(0.5f)) << "infinitely slow";
    controller.forget();
    for (int i = 0; i < 64; ++i) controller.add(kDynamic, { float2(0.5f), 100 });
    EXPECT_EQ(controller.scale(kDynamic), float2(1)) << "of another size";
}

/// Other options in the middle of a run: other bounds, another history.
TEST(ResolutionController, SurvivesOptionsThatChangeEveryFrame) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any(0, 1);
    ResolutionController controller;
    for (int frame = 0; frame < 5000; ++frame) {
        const Resolution options{ .scale = 0.5f + 0.5f * float2(any(random), any(random)),
                                  .dynamic = any(random) < 0.9f,
                                  .targetMilliseconds = 0.1f + 50 * any(random),
                                  .leastScale = 0.5f + 0.5f * any(random),
                                  .headroom = 0.5f * any(random),
                                  .history = static_cast<uint8_t>(1 + 31 * any(random)),
                                  .uniform = any(random) < 0.5f };
        const float2 scale = controller.scale(options);
        EXPECT_LE(scale.x, options.scale.x);
        EXPECT_LE(scale.y, options.scale.y);
        EXPECT_GE(scale.x, std::min(options.leastScale, options.scale.x) - 1e-5f);
        EXPECT_GE(scale.y, std::min(options.leastScale, options.scale.y) - 1e-5f);
        controller.add(options, { scale, 100 * any(random) });
    }
}

} // namespace
} // namespace filament_core
