// SPDX-License-Identifier: Apache-2.0
// Lens flare on both APIs: where ghosts and halo lie, how much light is in them, that light is moved and none added,
// and that it costs nothing where there is none.
#include "filament_core/passes/FlarePass.h"
#include "tests/filament_core/engine/LampStage.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core {
namespace {

using test::expectSameAsPlain;
using test::halfPixel;
using test::LampStage;
using test::pictureOfLamp;

constexpr double kSide = 0.05; // of the lamp: 12.8 pixels wide
constexpr float kLight = 100;

LensFlare ghosts(uint8_t count, float spacing) {
    return { .enabled = true,
             .threshold = 1,
             .ghostStrength = 0.5f,
             .ghostCount = count,
             .ghostSpacing = spacing,
             .ghostRadius = 0.03f,
             .haloStrength = 0,
             .dispersion = 0 };
}

/// What the flare adds to an image of the lamp, and takes from it, by component; the same bits on both APIs.
struct Flare {
    Image plain, flared;

    Flare(LensFlare const& options, double2 at, uint2 size = { 256, 256 }) {
        const auto draw = [&](LensFlare const& of) {
            return pictureOfLamp(
                    kLight, kSide, [&](View& view) { view.effects.lensFlare = of, view.size = size; }, at);
        };
        plain = draw({});
        flared = draw(options);
    }

    float at(uint32_t x, uint32_t y, int component) const {
        return halfPixel(flared, x, y)[component] - halfPixel(plain, x, y)[component];
    }
    bool isLamp(uint32_t x, uint32_t y) const { return halfPixel(plain, x, y).x > 0; }

    /// Calls see(offset from the middle, light) for what the flare brings where the lamp is not.
    template <class See>
    void visit(int component, See const& see) const {
        for (uint32_t y = 0; y < plain.height; ++y)
            for (uint32_t x = 0; x < plain.width; ++x)
                if (!isLamp(x, y))
                    see(double2(x, y) + 0.5 - double2(plain.width, plain.height) / 2.0,
                        static_cast<double>(at(x, y, component)));
    }
    double sum(int component = 0) const {
        double all = 0;
        visit(component, [&](double2, double light) { all += light; });
        return all;
    }
    double2 center(int component = 0) const {
        double2 weighted(0);
        visit(component, [&](double2 away, double light) { weighted += away * light; });
        return weighted / sum(component);
    }
    double meanDistance(double2 from, int component = 0) const {
        double weighted = 0;
        visit(component, [&](double2 away, double light) { weighted += glm::length(away - from) * light; });
        return weighted / sum(component);
    }
    /// The middle of the lamp's pixels.
    double2 lamp() const {
        double2 places(0);
        double pixels = 0;
        for (uint32_t y = 0; y < plain.height; ++y) {
            for (uint32_t x = 0; x < plain.width; ++x) {
                if (!isLamp(x, y)) continue;
                places += double2(x, y) + 0.5 - double2(plain.width, plain.height) / 2.0;
                pixels += 1;
            }
        }
        return places / pixels;
    }
    /// Of the lamp, beyond the threshold.
    double bright() const {
        double all = 0;
        for (uint32_t y = 0; y < plain.height; ++y)
            for (uint32_t x = 0; x < plain.width; ++x)
                all += std::max(static_cast<double>(halfPixel(plain, x, y).x) - 1, 0.0);
        return all;
    }
    double taken() const {
        double all = 0;
        for (uint32_t y = 0; y < plain.height; ++y)
            for (uint32_t x = 0; x < plain.width; ++x)
                if (isLamp(x, y)) all -= static_cast<double>(at(x, y, 0));
        return all;
    }
};

TEST(LensFlare, PutsAGhostOnTheLineThroughTheMiddle) {
    for (const double2 at : { double2(0.4, 0.2), double2(-0.3, 0.45), double2(0.1, -0.35) }) {
        for (const float spacing : { 0.5f, 1.5f, 2.0f }) {
            const Flare flare(ghosts(1, spacing), at);
            const double2 expected = flare.lamp() * (1 - static_cast<double>(spacing));
            const double2 found = flare.center();
            EXPECT_NEAR(found.x, expected.x, 0.5) << spacing;
            EXPECT_NEAR(found.y, expected.y, 0.5) << spacing;
            EXPECT_NEAR(flare.sum(), 0.5 * flare.bright(), 0.02 * flare.bright()) << spacing;
        }
    }
}

TEST(LensFlare, MovesLightAndAddsNone) {
    for (const double2 at : { double2(0.3, 0.1), double2(-0.2, 0.3) }) {
        for (const uint8_t count : { uint8_t{ 1 }, uint8_t{ 2 }, uint8_t{ 4 } }) {
            LensFlare options = ghosts(count, 0.55f);
            options.haloStrength = 0.25f;
            options.haloRadius = 0.2f;
            const Flare flare(options, at);
            EXPECT_NEAR(flare.taken(), 0.75 * flare.bright(), 0.02 * flare.bright()) << int{ count };
            EXPECT_NEAR(flare.sum(), 0.75 * flare.bright(), 0.03 * flare.bright()) << int{ count };
        }
    }
}

/// A disc of radius r has a mean distance of 2/3 r from its middle; the blur of what it gathers from adds to it.
TEST(LensFlare, BlursAGhostByItsRadius) {
    double last = 0;
    for (const float radius : { 0.02f, 0.05f, 0.1f }) {
        LensFlare options = ghosts(1, 1.8f);
        options.ghostRadius = radius;
        const double2 at(0.35, 0.3);
        const Flare flare(options, at);
        const double size = passes::flareGhosts(options, 256)[0].radius * 0.8; // in pixels of the image
        const double found = flare.meanDistance(flare.center());
        EXPECT_GT(found, 0.6 * size) << radius;
        EXPECT_LT(found, 0.75 * size + 12) << radius;
        EXPECT_GT(found, last) << radius;
        last = found;
    }
}

TEST(LensFlare, PutsAHaloAroundTheLight) {
    for (const double2 at : { double2(0), double2(0.25, -0.15) }) {
        for (const float radius : { 0.15f, 0.3f }) {
            LensFlare options{ .enabled = true,
                               .threshold = 1,
                               .ghostStrength = 0,
                               .haloStrength = 0.5f,
                               .haloRadius = radius,
                               .haloThickness = 0.1f,
                               .dispersion = 0 };
            const Flare flare(options, at);
            const double2 lamp = flare.lamp();
            EXPECT_NEAR(flare.meanDistance(lamp), 256.0 * static_cast<double>(radius), 3) << radius;
            EXPECT_NEAR(glm::length(flare.center() - lamp), 0, 1.5) << radius;
            EXPECT_NEAR(flare.sum(), 0.5 * flare.bright(), 0.02 * flare.bright()) << radius;
            double inside = 0; // half of the radius
            flare.visit(0, [&](double2 away, double light) {
                inside += glm::length(away - lamp) < 128.0 * static_cast<double>(radius) ? light : 0.0;
            });
            EXPECT_LT(inside, 0.02 * flare.sum()) << radius;
        }
    }
}

TEST(LensFlare, HasRedOutermost) {
    LensFlare options = ghosts(1, 1.9f);
    options.haloStrength = 0, options.dispersion = 1;
    const double2 at(0.6, 0.5);
    const Flare ghost(options, at);
    options.ghostStrength = 0, options.haloStrength = 0.5f, options.haloThickness = 0.5f;
    const Flare halo(options, double2(0));
    std::array<double, 3> places{}, radii{};
    for (int c = 0; c < 3; ++c) {
        places[static_cast<size_t>(c)] = glm::length(ghost.center(c));
        radii[static_cast<size_t>(c)] = halo.meanDistance(double2(0), c);
        EXPECT_NEAR(ghost.sum(c), 0.5 * ghost.bright(), 0.05 * ghost.bright()) << c;
        EXPECT_NEAR(halo.sum(c), 0.5 * halo.bright(), 0.02 * halo.bright()) << c;
    }
    EXPECT_GT(places[0], places[1] + 0.5);
    EXPECT_GT(places[1], places[2] + 0.5);
    EXPECT_GT(radii[0], radii[1] + 3);
    EXPECT_GT(radii[1], radii[2] + 3);
}

TEST(LensFlareGhosts, LieAtMultiplesOfTheirSpacing) {
    const auto found = passes::flareGhosts(ghosts(8, 0.25f), 100u);
    const std::array places{ 0.75f, 0.5f, 0.25f, 0.0f, -0.25f, -0.5f, -0.75f, -1.0f };
    float share = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        share += found[i].share;
        if (places[i] == 0)
            EXPECT_EQ(found[i].share, 0) << "the fourth lies in the middle, wherever the light is";
        else
            EXPECT_NEAR(found[i].scale * places[i], 1, 1e-5f) << i;
    }
    EXPECT_NEAR(share, 0.5f * 7 / 8, 1e-5f);
    EXPECT_NEAR(passes::flareShare(ghosts(8, 0.25f)), share, 1e-5f);
}

TEST(LensFlareBlocks, LeaveAsManyRowsInAllPictures) {
    for (uint32_t height = 1; height <= 4320; ++height) {
        const uint32_t block = passes::flareBlock(height), rows = height / block;
        EXPECT_EQ(block & (block - 1), 0u) << height;
        EXPECT_TRUE(block == 1 || (rows >= 90 && rows < 180)) << height;
        EXPECT_TRUE(block > 1 || height < 180) << height;
    }
}

TEST(LensFlare, BelowItsThresholdNothingChanges) {
    LensFlare options = ghosts(4, 0.4f);
    options.threshold = kLight;
    const Flare flare(options, { 0.3, 0.2 });
    EXPECT_EQ(test::differingPixels(flare.plain, flare.flared), 0u);
}

/// Lamps of 60 000 beside black, in images of all sizes.
TEST(LensFlare, IsFiniteAtItsEndsAndInAllSizes) {
    for (const uint2 size : { uint2(1, 1), uint2(3, 70), uint2(131, 17), uint2(64, 64) }) {
        for (const bool isMost : { false, true }) {
            for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
                const Image image = pictureOfLamp(60'000, 0.3,
                                                  [&](View& view) {
                                                      view.size = size;
                                                      view.samples = samples;
                                                      view.effects.lensFlare = { .enabled = true,
                                                                                 .threshold = 0,
                                                                                 .ghostStrength = isMost ? 1.0f : 0.01f,
                                                                                 .ghostCount = 8,
                                                                                 .ghostSpacing = isMost ? 2.0f : 0.05f,
                                                                                 .ghostRadius = isMost ? 0.25f : 0.005f,
                                                                                 .haloStrength = isMost ? 0.0f : 0.5f,
                                                                                 .haloRadius = isMost ? 1.0f : 0.05f,
                                                                                 .haloThickness = isMost ? 1.0f : 0.0f,
                                                                                 .dispersion = isMost ? 1.0f : 0.0f };
                                                  },
                                                  { 0.2, 0.1 });
                EXPECT_TRUE(std::isfinite(test::extremesOf(image).most));
                EXPECT_GE(test::extremesOf(image).least, 0);
            }
        }
    }
}

/// Only what is not a number shows that; its flare is none, and that of an infinity one of the brightest light. The
/// next frame is unaffected.
TEST(LensFlare, KeepsWhatIsNoNumberWhereItIs) {
    for (const char* light : { "vec3(uintBitsToFloat(0x7FC00000u))", "vec3(uintBitsToFloat(0x7F800000u))" }) {
        for (const Backend backend : test::kBothApis) {
            LampStage stage(backend, light, kSide, { 0.4, 0.2 });
            stage.view.effects.lensFlare = ghosts(4, 0.4f);
            Renderer renderer(stage.engine);
            const Owned<SwapChain> target = stage.engine.own(stage.engine.create(
                    SwapChainDesc{ .size = stage.view.size, .imageCount = 1, .format = Format::RGBA16F }));
            const auto draw = [&] {
                renderer.render(stage.scene, stage.view, target);
                return *renderer.waitPixels(renderer.readPixels(target));
            };
            const Image first = draw();
            size_t strange = 0;
            for (uint32_t y = 0; y < first.height; ++y)
                for (uint32_t x = 0; x < first.width; ++x) strange += std::isfinite(halfPixel(first, x, y).x) ? 0u : 1u;
            EXPECT_LE(strange, 14u * 14u) << "the lamp's pixels";
            stage.scene.setLayers(stage.lamp, kAllLayers, 0);
            const Image second = draw();
            EXPECT_EQ(test::extremesOf(second).most, 0.0f);
        }
    }
}

TEST(LensFlare, CostsNothingWithoutAnythingToReflect) {
    for (const Backend backend : test::kBothApis) {
        LampStage lamp(backend, kLight, 0.25);
        expectSameAsPlain(lamp, "switched off: lensFlare=off");
        lamp.view.effects.lensFlare = { .enabled = true, .ghostStrength = 0, .haloStrength = 0 };
        expectSameAsPlain(lamp, "its intensity is 0");
        LampStage dark(backend, kLight, 0);
        dark.view.effects.lensFlare.enabled = true;
        expectSameAsPlain(dark, "nothing is visible, not even a sky");
    }
}

TEST(LensFlare, ExplainsWhatItShows) {
    LampStage lamp(Backend::Vulkan, kLight, 0.25);
    Renderer renderer(lamp.engine);
    const auto said = [&](LensFlare const& flare) {
        lamp.view.effects.lensFlare = flare;
        EXPECT_TRUE(renderer.renderToImage(lamp.scene, lamp.view));
        return renderer.explain();
    };
    EXPECT_NE(said({ .enabled = true }).find("5 ghosts and a halo of what is bright"), std::string::npos);
    EXPECT_NE(said({ .enabled = true, .ghostCount = 1, .haloStrength = 0 }).find("1 ghost of what is bright"),
              std::string::npos);
    EXPECT_NE(said({ .enabled = true, .ghostStrength = 0 }).find("a halo of what is bright"), std::string::npos);
}

} // namespace
} // namespace filament_core
