// SPDX-License-Identifier: Apache-2.0
// Tone mapping by formula and by table, as images of a single colour: View::clearColor is scene-linear.
#include "filament_core/assets/tables/ToneTable.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include "shaders/lib/LibCpp.h"

#include <algorithm>
#include <array>

namespace filament_core {
namespace {

namespace lib = shader::lib;

const std::array kColors{ float3(0),
                          float3(0.001f),
                          float3(0.18f),
                          float3(1, 0.2f, 0.05f),
                          float3(0.03f, 2, 9),
                          float3(300, 0.5f, 1),
                          float3(0.4f, 0.4f, 3),
                          float3(7, 7, 0.01f),
                          float3(0.2f, 5, 0.2f) };

using Rgba8 = std::array<uint8_t, 4>;

/// Each of kColors as sent to the display.
std::vector<Rgba8> shown(Engine& engine, ToneMapper mapper, ToneMapping mapping, uint8_t samples = 1) {
    Scene scene(engine);
    Renderer renderer(engine);
    View view{ .size = { 4, 4 }, .samples = samples };
    view.display.toneMapper = mapper;
    view.quality.toneMapping = mapping;
    std::vector<Rgba8> all;
    for (float3 const& color : kColors) {
        view.clearColor = float4(color, 1);
        auto image = renderer.renderToImage(scene, view);
        if (!image) {
            ADD_FAILURE() << image.error().message;
            return {};
        }
        std::memcpy(all.emplace_back().data(), image->pixels.data(), sizeof(Rgba8));
    }
    test::expectNoErrors(engine);
    return all;
}

/// Tetrahedral interpolation by its definition: from the darkest corner along the axes, the largest fraction first.
float3 interpolated(assets::Image const& table, float3 light) {
    const uint32_t size = table.height;
    std::array<uint32_t, 3> corner{};
    std::array<std::pair<float, int>, 3> steps{};
    for (int c = 0; c < 3; ++c) {
        const float at = lib::toneTableCoordinate(light[c]) * static_cast<float>(size - 1);
        corner[static_cast<size_t>(c)] = std::min(static_cast<uint32_t>(at), size - 2);
        steps[static_cast<size_t>(c)] = { at - static_cast<float>(corner[static_cast<size_t>(c)]), c };
    }
    std::ranges::sort(steps, std::greater());
    const auto entry = [&] {
        uint16_t bits[3];
        const size_t texel = size_t{ corner[1] } * table.width + corner[0] + size_t{ corner[2] } * size;
        std::memcpy(bits, table.data.data() + texel * 8, sizeof(bits));
        return float3(floatFromHalf(bits[0]), floatFromHalf(bits[1]), floatFromHalf(bits[2]));
    };
    float3 color = entry();
    for (auto const& [fraction, axis] : steps) {
        const float3 before = entry();
        ++corner[static_cast<size_t>(axis)];
        color += (entry() - before) * fraction;
    }
    return color;
}

class QualityToneTest : public testing::TestWithParam<Backend> {};

TEST_P(QualityToneTest, ATableIsInterpolatedTetrahedrally) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const std::vector<Rgba8> bytes = shown(*engine, ToneMapper::Aces, ToneMapping::Table16);
    ASSERT_EQ(bytes.size(), kColors.size());
    jobs::JobSystem jobs({ .workers = 0 });
    const assets::Image table = assets::bakeToneTable(jobs, { .toneMapper = ToneMapper::Aces }, 16);
    for (size_t i = 0; i < kColors.size(); ++i) {
        const float3 expected = interpolated(table, kColors[i]) * 255.0f;
        for (int c = 0; c < 3; ++c) {
            // The scene is stored in half floats: a relative error of 2^-11 of light is 0.2 of a step at most.
            EXPECT_NEAR(bytes[i][static_cast<size_t>(c)], expected[c], 0.75f) << "colour " << i << ", component " << c;
        }
    }
}

TEST_P(QualityToneTest, LargerTablesAreNearerToTheFormula) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const std::vector<Rgba8> exact = shown(*engine, ToneMapper::Aces, ToneMapping::Analytic);
    int largest[3] = {};
    const ToneMapping sizes[] = { ToneMapping::Table16, ToneMapping::Table32, ToneMapping::Table64 };
    for (size_t size = 0; size < 3; ++size) {
        const std::vector<Rgba8> looked = shown(*engine, ToneMapper::Aces, sizes[size]);
        ASSERT_EQ(looked.size(), exact.size());
        for (size_t i = 0; i < exact.size(); ++i) {
            for (size_t c = 0; c < 3; ++c)
                largest[size] = std::max(largest[size], std::abs(looked[i][c] - exact[i][c]));
        }
    }
    EXPECT_GT(largest[0], largest[1]);
    EXPECT_GE(largest[1], largest[2]);
    EXPECT_LE(largest[2], 3);
}

TEST_P(QualityToneTest, MultisampledPicturesGoThroughTheSameTable) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    EXPECT_EQ(shown(*engine, ToneMapper::Filmic, ToneMapping::Table32, 4),
              shown(*engine, ToneMapper::Filmic, ToneMapping::Table32, 1));
}

INSTANTIATE_TEST_SUITE_P(BothApis, QualityToneTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST(QualityToneBits, EveryMapperGivesTheSameBytesOnBothApisByFormulaAndByTable) {
    auto vulkan = test::makeEngine(Backend::Vulkan), gles = test::makeEngine(Backend::Gles);
    ASSERT_TRUE(vulkan && gles);
    for (const ToneMapper mapper : { ToneMapper::Linear, ToneMapper::Aces, ToneMapper::Filmic, ToneMapper::Mobile }) {
        for (const ToneMapping mapping : { ToneMapping::Analytic, ToneMapping::Table16, ToneMapping::Table32 })
            EXPECT_EQ(shown(*vulkan, mapper, mapping), shown(*gles, mapper, mapping))
                    << toString(mapper) << ' ' << toString(mapping);
    }
}

} // namespace
} // namespace filament_core
