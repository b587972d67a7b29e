// SPDX-License-Identifier: Apache-2.0
// The case "mip-chain" shows what it claims: changing one code of any level by one changes one pixel, that of its
// texel.
#include "toolkit/mutations/Mutations.h"
#include "toolkit/paths/Paths.h"
#include "tools/conformance/Stage.h"

#include <gtest/gtest.h>

#include <cstring>

namespace filament_core::conformance {
namespace {

constexpr uint32_t kSide = 128, kLevels = 8;

SceneSpec mipChain() {
    auto cases = readSceneFile(tools::sourceDir() / "tests/conformance/scenes/mip-chain.json");
    EXPECT_TRUE(cases.ok()) << (cases.ok() ? "" : cases.error().message);
    return cases.ok() ? cases->front() : SceneSpec();
}

Image draw(std::unique_ptr<backend::StreamEdit> edit) {
    const auto stage = Stage::open({ .backend = Backend::Vulkan,
                                     .work = tools::buildDir() / "conformance-tests" / "work",
                                     .assets = tools::assetDir() },
                                   std::move(edit));
    EXPECT_TRUE(stage.ok()) << (stage.ok() ? "" : stage.error().message);
    if (!stage) return {};
    const SceneSpec spec = mipChain();
    const Result<void> set = (*stage)->set(spec);
    EXPECT_TRUE(set.ok()) << (set.ok() ? "" : set.error().message);
    Result<Shot> shot = (*stage)->shoot(std::nullopt);
    EXPECT_TRUE(shot.ok()) << (shot.ok() ? "" : shot.error().message);
    return shot ? std::move(shot->image) : Image();
}

/// Indices of the pixels whose bits differ, counted by rows.
std::vector<uint32_t> differing(Image const& a, Image const& b) {
    std::vector<uint32_t> pixels;
    const size_t bytes = a.pixels.size() / (size_t{ a.width } * a.height);
    for (uint32_t i = 0; i < a.width * a.height; ++i) {
        if (std::memcmp(&a.pixels[i * bytes], &b.pixels[i * bytes], bytes) != 0) pixels.push_back(i);
    }
    return pixels;
}

TEST(MipChain, ShowsOneCodeThatIsOffInOneTexelOfAnyLevelAsThatPixel) {
    const Image whole = draw(nullptr);
    ASSERT_EQ(whole.width, 2 * kSide);
    ASSERT_EQ(whole.height, kSide);
    uint32_t left = 0;
    for (uint32_t level = 0; level < kLevels; ++level) {
        SCOPED_TRACE(level);
        const uint32_t side = kSide >> level, x = 3 * side / 4, y = side / 3;
        const Image changed = draw(mipTexelEdit(level, y * side + x));
        ASSERT_EQ(changed.pixels.size(), whole.pixels.size());
        EXPECT_EQ(differing(whole, changed), std::vector<uint32_t>{ y * whole.width + left + x });
        left += side;
    }
}

} // namespace
} // namespace filament_core::conformance
