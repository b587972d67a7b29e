// SPDX-License-Identifier: Apache-2.0
// Lobes that a cube of pre-filtered round ones does not have: under photographed environments the engine's mean is that
// of the path tracer, which integrates them.
#include "tests/tools/accuracy/comparison/ComparisonFixture.h"
#include "tools/accuracy/Studio.h"
#include "tools/accuracy/TracedPicture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace filament_core::accuracy {
namespace {

double sumOf(Picture const& picture) {
    double sum = 0;
    for (float3 const& color : picture.pixels) sum += 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
    return sum;
}

class EnvironmentMeans : public testing::Test {
protected:
    void SetUp() override {
        mFolders = { scratch() / "work", tools::assetDir() };
        if (!fs::exists(mFolders.assets / "environments/studio_small_03_1k.hdr")) GTEST_SKIP() << "no environments";
        auto studio = Studio::open(Backend::Vulkan, mFolders);
        ASSERT_TRUE(studio) << studio.error().message;
        mStudio = std::move(*studio);
    }

    /// The mean of the engine's image over the path tracer's; nothing but the object shines in either.
    double meanRatio(std::string const& name, std::vector<std::string> const& changes = {}) {
        const Result<SceneLibrary> scenes = SceneLibrary::read(kFolder / "scenes");
        EXPECT_TRUE(scenes) << scenes.error().message;
        tools::SceneSpec const& scene = **scenes->find(name);
        Settings settings = settingsOf(scene);
        for (std::string const& text : changes) EXPECT_TRUE(change(settings, text));
        auto take = mStudio->take(scene, settings, { 96, 54 }, true);
        EXPECT_TRUE(take) << take.error().message;
        const Result<Picture> picture = (*take)->shoot();
        jobs::JobSystem jobs;
        const Result<reference::ReferenceScene> traced = referenceSceneOf(scene, mFolders, jobs);
        EXPECT_TRUE(traced) << traced.error().message;
        const Result<TracedPicture> truth = trace(*traced, (*take)->view(), 256, jobs);
        EXPECT_TRUE(truth) << truth.error().message;
        const double ratio = sumOf(*picture) / sumOf(truth->picture);
        fmt::print("{}: {:.3f} of the path tracer's mean, whose error is {:.3f}\n", name, ratio, truth->relativeError);
        return ratio;
    }

private:
    tools::SceneFolders mFolders;
    std::unique_ptr<Studio> mStudio;
};

TEST_F(EnvironmentMeans, SheenIsAsBrightAsItsLobe) {
    for (const char* scene : { "sheen/studio", "sheen/rough-studio", "sheen/room" })
        EXPECT_NEAR(meanRatio(scene), 1, 0.1) << scene;
}

TEST_F(EnvironmentMeans, BrushedMetalIsAsBrightAsItsLobe) {
    for (const char* scene : { "brushed/studio", "brushed/room" }) EXPECT_NEAR(meanRatio(scene), 1, 0.1) << scene;
    EXPECT_GT(std::abs(meanRatio("brushed/room", { "anisotropicLookUps=one" }) - 1), 0.1) << "what one look-up misses";
}

TEST_F(EnvironmentMeans, FlatMetalIsAsBrightAsItsLobe) {
    for (const char* scene : { "tilted/studio", "tilted/beach", "tilted/room" })
        EXPECT_NEAR(meanRatio(scene), 1, 0.1) << scene;
}

} // namespace
} // namespace filament_core::accuracy
