// SPDX-License-Identifier: Apache-2.0
// Views in which every value of an option meets every value of each other option: the same bits on both APIs, finite
// pixels, no message of a validation layer. FILAMENT_STRESS=N draws N times as many of them; 20 are all of them.
#include "tests/filament_core/generated/AllPairs.h"
#include "tests/filament_core/generated/CaseStage.h"
#include "tests/filament_core/generated/ViewCases.h"
#include "tests/jobsystem/Storm.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace filament_core {
namespace {

using test::CaseStage;
using test::PairRow;
using test::ViewCase;

TEST(AllPairs, HaveEveryPairOfValuesInFewRows) {
    for (uint32_t seed = 1; seed < 4; ++seed) {
        for (std::vector<uint32_t> const& counts :
             { std::vector<uint32_t>{ 5 }, { 2, 2 }, { 5, 4, 3, 2, 2, 2, 1 }, test::valuesOfFactors() }) {
            const std::vector<PairRow> rows = test::allPairs(counts, seed);
            EXPECT_EQ(test::missingPairs(counts, rows), 0u);
            EXPECT_LE(rows.size(), 48u);
        }
    }
}

bool isFinite(Image const& image) {
    if (image.format != Format::RGBA16F) return true;
    for (uint32_t i = 0; i < image.width * image.height; ++i) {
        const float4 pixel = test::halfPixel(image, i % image.width, i / image.width);
        for (int c = 0; c < 4; ++c)
            if (!std::isfinite(pixel[c])) return false;
    }
    return true;
}

/// An engine on each API.
class BothApis {
public:
    /// Empty, or what is wrong with the view.
    std::string failure(ViewCase const& viewCase, int frames = 2) {
        const Image a = mVulkan.draw(viewCase, frames), b = mGles.draw(viewCase, frames);
        for (CaseStage* const stage : { &mVulkan, &mGles })
            for (std::string const& error : stage->engine().takeErrors()) return error;
        if (a.pixels.empty()) return "no picture";
        if (a.pixels != b.pixels) return "the APIs differ";
        return isFinite(a) ? "" : "pixels are not finite";
    }

    /// The row with as many first values as it takes to fail.
    PairRow reduced(PairRow row) {
        for (uint32_t& value : row) {
            const uint32_t before = std::exchange(value, 0);
            if (before != 0 && failure(test::viewCase(row)).empty()) value = before;
        }
        return row;
    }

private:
    CaseStage mVulkan{ Backend::Vulkan }, mGles{ Backend::Gles };
};

TEST(GeneratedViews, HaveTheSameBitsOnBothApis) {
    const std::vector<PairRow> rows = test::allPairs(test::valuesOfFactors(), 1);
    BothApis both;
    for (size_t i = 0; i < std::min(rows.size(), static_cast<size_t>(test::scaled(2))); ++i) {
        const std::string failure = both.failure(test::viewCase(rows[i]));
        EXPECT_EQ(failure, "") << test::viewCase(both.reduced(rows[i])).words;
    }
}

/// A row of first values, except for these.
PairRow rowWith(std::initializer_list<std::pair<std::string_view, uint32_t>> values) {
    PairRow row(test::viewFactors().size(), 0);
    for (auto const& [name, value] : values) {
        const auto at = std::ranges::find(test::viewFactors(), name, &test::ViewFactor::name);
        row.at(static_cast<size_t>(at - test::viewFactors().begin())) = value;
    }
    return row;
}

TEST(GeneratedViews, WithAProbeHaveTheSameBitsInEveryOrderOfTransparency) {
    BothApis both;
    for (const uint32_t order : { 0u, 1u, 2u }) {
        const ViewCase drawn = test::viewCase(rowWith({ { "probe", 1 }, { "transparency", order } }));
        EXPECT_EQ(both.failure(drawn), "") << drawn.words;
    }
}

/// A view with four samples through a lens of chance.
ViewCase throughLens(uint32_t seed, uint2 size) {
    ViewCase drawn = test::viewCase(PairRow(test::viewFactors().size(), 0));
    drawn.target = test::SeenTarget::HalfFloats;
    drawn.view.samples = 4;
    drawn.view.size = size;
    test::Chance chance(seed);
    const float x = chance.within(-1, 0.3f), y = chance.within(-0.5f, 0.1f);
    const float width = chance.within(0.1f, 1), height = chance.within(0.1f, 1);
    drawn.view.camera.lens = Lens::offCenter(x, x + width, y, y + height);
    return drawn;
}

// Four samples at the edges of triangles whose planes pass the camera: the middle of a pixel that they do not cover may
// lie behind it.
TEST(GeneratedViews, WithFourSamplesHaveTheSameBitsThroughAnyLens) {
    BothApis both;
    for (uint32_t round = 1; round < 10; ++round) {
        for (const uint2 size : { uint2(61, 1), uint2(1, 37) }) {
            ViewCase drawn = throughLens(round, size);
            drawn.scene = test::SeenScene::BlendedOnly;
            EXPECT_EQ(both.failure(drawn, 1), "") << "lens " << round << ", " << size.x << " x " << size.y;
        }
    }
}

} // namespace
} // namespace filament_core
