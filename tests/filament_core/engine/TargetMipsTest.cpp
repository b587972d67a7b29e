// SPDX-License-Identifier: Apache-2.0
// Mips of render targets of RGBA8Srgb: means of light by area, encoded again, compared with doubles for sizes that
// halve evenly and for those that do not.
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core {
namespace {

// A texel a pixel, of one level.
constexpr const char* kTexels = R"(material { name : texels, shadingModel : unlit,
    parameters : [ { type : sampler2d, name : picture, precision : high }, { type : int, name : level },
                   { type : bool, name : showsAlpha } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    vec4 texel = texelFetch(materialParams_picture, ivec2(gl_FragCoord.xy), materialParams.level);
    material.baseColor.rgb = materialParams.showsAlpha ? texel.aaa : texel.rgb;
} })";
constexpr const char* kFlatOfMips = R"(material { name : flat, shadingModel : unlit, culling : none,
    parameters : [ { type : float4, name : color } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = materialParams.color; } })";

constexpr uint2 kSizes[] = { { 16, 16 }, { 32, 8 }, { 17, 17 }, { 15, 9 }, { 33, 20 }, { 1, 7 },
                             { 11, 1 },  { 2, 2 },  { 3, 3 },   { 3, 64 }, { 31, 2 },  { 1, 1 } };

/// IEC 61966-2-1.
double codeOfLight(double light) {
    return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

/// What materials see of a level, and the codes of all channels that the texture must hold; alpha in 255ths.
struct Level {
    uint2 size{ 1 };
    std::vector<double4> light, codes;
};

double4 codeOf(double4 const& light) {
    return { codeOfLight(light.x), codeOfLight(light.y), codeOfLight(light.z), light.w * 255 };
}

/// How much of [begin, end) lies in texel i.
double overlap(double begin, double end, uint32_t i) {
    return std::max(0.0, std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i)));
}

/// The mean light of the part of `above` that a texel covers, encoded, not rounded.
double4 expectedCode(Level const& above, uint2 size, uint2 at) {
    const double2 share = double2(above.size) / double2(size);
    const double2 begin = double2(at) * share, end = begin + share;
    double4 light(0);
    for (uint32_t y = 0; y < above.size.y; ++y) {
        for (uint32_t x = 0; x < above.size.x; ++x) {
            const double area = overlap(begin.x, end.x, x) * overlap(begin.y, end.y, y);
            light += area * above.light[y * above.size.x + x];
        }
    }
    return codeOf(light / (share.x * share.y));
}

struct FilmStage {
    Engine engine;
    test::SquareMesh square{ engine };
    Owned<Material> texels = test::loadMaterial(engine, kTexels), flat = test::loadMaterial(engine, kFlatOfMips);
    Owned<MaterialInstance> screen = engine.own(engine.createInstance(texels));
    std::vector<Owned<MaterialInstance>> flats;
    Scene scene{ engine }, room{ engine }; ///< what is filmed, and where its texels are shown
    Renderer camera{ engine };

    explicit FilmStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))) {
        prepare::Random random(11);
        const auto some = [&](double least, double most) { return random.within(least, most); };
        for (int i = 0; i < 60; ++i) {
            flats.push_back(engine.own(engine.createInstance(flat)));
            const auto channel = [&] { return static_cast<float>(std::pow(some(0, 1), 3)); };
            EXPECT_TRUE(engine.set(flats.back(), "color", float4(channel(), channel(), channel(), 1)));
            square.add(scene, flats.back(), { some(-2, 2), some(-2, 2), some(-1, 1) }, 0.2);
        }
        square.add(room, screen, {}, 100);
    }
    ~FilmStage() { test::expectNoErrors(engine); }

    Owned<Texture> film(uint2 size) {
        return engine.own(engine.create(TextureDesc{ .format = Format::RGBA8Srgb,
                                                     .width = size.x,
                                                     .height = size.y,
                                                     .levels = backend::fullMipCount(size.x, size.y),
                                                     .renderable = true,
                                                     .name = "film" }));
    }

    View viewOf(uint2 size) const {
        View view{ .camera = Camera::lookAt({ 0, 0, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }), .size = size };
        view.clearColor = { 0.02f, 0.4f, 0.9f, 0.3f };
        return view;
    }

    Image shown(Texture film, uint32_t level, uint2 size, bool showsAlpha) {
        EXPECT_TRUE(engine.set(screen, "picture", film, kUnfilteredSampler));
        EXPECT_TRUE(engine.set(screen, "level", static_cast<int32_t>(level)));
        EXPECT_TRUE(engine.set(screen, "showsAlpha", showsAlpha));
        return test::renderLinear(engine, room, viewOf(size));
    }

    /// Samplers decode by a polynomial, which is up to 0.3 codes off.
    Level level(Texture film, uint32_t index, uint2 size) {
        const Image light = shown(film, index, size, false), alpha = shown(film, index, size, true);
        Level level{ .size = size };
        for (uint32_t y = 0; y < size.y; ++y) {
            for (uint32_t x = 0; x < size.x; ++x) {
                const double3 seen(test::halfPixel(light, x, y));
                level.light.emplace_back(seen, test::halfPixel(alpha, x, y).x);
                const double4 code = codeOf(level.light.back());
                level.codes.push_back(glm::round(code));
                level.light.back().w = level.codes.back().w / 255; // half floats are 0.06 codes off
                for (int c = 0; c < 4; ++c) EXPECT_NEAR(code[c], level.codes.back()[c], 0.4) << x << ' ' << y;
            }
        }
        return level;
    }
};

uint2 halved(uint2 size) { return glm::max(size / 2u, uint2(1)); }

class TargetMipsTest : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(BothApis, TargetMipsTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(TargetMipsTest, OfSrgbAreMeansOfLight) {
    FilmStage stage(GetParam());
    for (const uint2 size : kSizes) {
        SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
        const Owned<Texture> film = stage.film(size);
        const Owned<RenderTarget> target = stage.engine.own(
                stage.engine.create(RenderTargetDesc{ .color = film, .generateMips = size != uint2(1) }));
        stage.camera.render(stage.scene, stage.viewOf(size), target);
        Level above = stage.level(film, 0, size);
        for (uint32_t index = 1; index < backend::fullMipCount(size.x, size.y); ++index) {
            const Level level = stage.level(film, index, halved(above.size));
            for (uint32_t i = 0; i < level.codes.size(); ++i) {
                const uint2 at(i % level.size.x, i / level.size.x);
                const double4 expected = expectedCode(above, level.size, at);
                for (int c = 0; c < 4; ++c)
                    EXPECT_NEAR(level.codes[i][c], expected[c], 0.55) << index << ": " << at.x << ' ' << at.y;
            }
            above = level;
        }
    }
}

TEST_P(TargetMipsTest, OfSrgbFollowEveryViewAndItsViewports) {
    FilmStage stage(GetParam());
    const uint2 size(16);
    const Owned<Texture> film = stage.film(size);
    const Owned<RenderTarget> target =
            stage.engine.own(stage.engine.create(RenderTargetDesc{ .color = film, .generateMips = true }));
    stage.camera.render(stage.scene, stage.viewOf(size), target);
    const Level before = stage.level(film, 1, halved(size));
    View corner = stage.viewOf(uint2(8));
    corner.viewport = Viewport{ .offset = { 8, 0 } };
    corner.clearColor = { 1, 1, 1, 1 };
    corner.visibleLayers = 0; // nothing but its background
    stage.camera.render(stage.scene, corner, target);
    const Level after = stage.level(film, 1, halved(size));
    const double4 background = stage.level(film, 0, size).codes[15];
    EXPECT_NE(background, before.codes[7]);
    for (uint32_t i = 0; i < after.codes.size(); ++i) {
        const bool isInCorner = i % 8 >= 4 && i / 8 < 4;
        const double4 expected = isInCorner ? background : before.codes[i];
        for (int c = 0; c < 4; ++c) EXPECT_EQ(after.codes[i][c], expected[c]) << i;
    }
}

} // namespace
} // namespace filament_core
