// SPDX-License-Identifier: Apache-2.0
// Debug views of post-processing on both APIs: circles of confusion, the history weight, the
// histogram of auto exposure, each beside its closed form.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace filament_core {
namespace {

constexpr int3 kOrange(230, 159, 0), kBlue(86, 180, 233), kGrey(153);

int3 codesAt(Image const& image, uint32_t x, uint32_t y) {
    return int3(glm::round(float3(test::bytePixel(image, x, y)) * 255.0f));
}

/// Squares of one light each, before black.
class SquaresStage {
public:
    explicit SquaresStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), renderer(engine), mSquare(engine) {
        mMaterial = test::loadMaterial(engine,
                                       test::text("shadingModel : unlit, doubleSided : true, parameters : [ { type : "
                                                  "float, name : light } ]",
                                                  "material.baseColor = vec4(vec3(materialParams.light), 1.0);"));
        view.camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }, { .verticalFovDegrees = 90 });
    }
    ~SquaresStage() { test::expectNoErrors(engine); }

    Renderable add(float light, double3 at, double side) {
        mInstances.push_back(engine.own(engine.createInstance(mMaterial)));
        EXPECT_TRUE(engine.set(mInstances.back(), "light", light));
        return mSquare.add(scene, mInstances.back(), at, side);
    }
    Image draw() {
        Result<Image> image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }
    void showHistoryWeight(uint2 size) {
        view.size = size;
        view.quality.antiAliasing = AntiAliasing::Taa;
        view.debugView = DebugView::HistoryWeight;
    }
    MaterialInstance lastMaterial() const { return mInstances.back(); }
    bool says(const char* words) const { return renderer.explain().find(words) != std::string::npos; }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;

private:
    test::SquareMesh mSquare;
    Owned<Material> mMaterial;
    std::vector<Owned<MaterialInstance>> mInstances;
};

// ---- circle of confusion

/// In pixels, < 0 before the focus, by Potmesil and Chakravarty's formula for a sensor 24 mm high.
double shownRadius(View const& view, double meters) {
    const double focal = 0.012; // of 90 degrees
    const double focus = static_cast<double>(view.effects.depthOfField.focusMeters);
    const double diameter = focal * focal * (meters - focus) /
                            (static_cast<double>(view.camera.exposure.aperture) * meters * (focus - focal));
    return diameter / 2 / 0.024 * view.size.y * static_cast<double>(view.effects.depthOfField.blurScale);
}

TEST(DebugCircleOfConfusion, ShowsTheThinLensBeforeAndBehindItsFocus) {
    const std::array distances{ 0.7, 1.0, 1.6, 2.0, 2.3, 4.0, 40.0 };
    for (const float scale : { 4.0f, 12.0f }) {
        View seen;
        const std::vector<Image> images = test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
            stage.view.size = { 140, 100 };
            stage.view.camera.exposure.aperture = 1.4f;
            stage.view.effects.depthOfField = {
                .enabled = true, .focusMeters = 2, .blurScale = scale, .maxRadius = 0.06f
            };
            stage.view.debugView = DebugView::CircleOfConfusion;
            for (size_t i = 0; i < distances.size(); ++i) { // columns of 20 pixels
                const double column = (static_cast<double>(i) - 3) * 0.4;
                stage.add(1, double3(column, 0, -1) * distances[i], 0.15 * distances[i]);
            }
            seen = stage.view;
            return std::vector{ stage.draw() };
        });
        const double most = 0.06 * 100;
        for (size_t i = 0; i < distances.size(); ++i) {
            const double radius = std::clamp(shownRadius(seen, distances[i]), -most, most);
            const double3 expected = double3(radius < 0 ? kOrange : kBlue) * (std::abs(radius) / most);
            const int3 found = codesAt(images[0], static_cast<uint32_t>(10 + 20 * i), 50);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1.01) << distances[i] << ", scale " << scale;
        }
        const double sky = std::min(shownRadius(seen, 1e9), most);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(codesAt(images[0], 1, 1)[c], kBlue[c] * sky / most, 1.01) << "what nothing covers";
    }
}

TEST(DebugCircleOfConfusion, IsBlackWithoutDepthOfField) {
    for (const bool isOn : { false, true }) {
        const std::vector<Image> images = test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
            stage.view.size = { 32, 32 };
            stage.view.effects.depthOfField.enabled = isOn; // all of it is in focus
            stage.view.debugView = DebugView::CircleOfConfusion;
            stage.add(1, { 0, 0, -2 }, 4);
            Image image = stage.draw();
            EXPECT_TRUE(stage.says("debugView=circleOfConfusion: its effect does not run"));
            return std::vector{ std::move(image) };
        });
        EXPECT_EQ(codesAt(images[0], 16, 16), int3(0));
    }
}

// ---- weight of the history

TEST(DebugHistoryWeight, OfAStillPictureIsAllButOneOfItsFrames) {
    const std::vector<Image> images = test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
        stage.showHistoryWeight({ 32, 24 });
        stage.add(1, { 0.1, 0.2, -2 }, 1);
        std::vector<Image> frames;
        for (int i = 0; i < 300; ++i) {
            Image image = stage.draw();
            if (i < 6 || i % 50 == 49) frames.push_back(std::move(image));
        }
        return frames;
    });
    const std::array frames{ 1, 2, 3, 4, 5, 6, 50, 100, 150, 200, 250, 300 };
    ASSERT_EQ(images.size(), frames.size());
    for (size_t i = 0; i < frames.size(); ++i) {
        const double kept = 1 - 1.0 / std::min(frames[i], 256);
        for (const uint2 pixel : { uint2(0, 0), uint2(16, 12), uint2(31, 23) })
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(codesAt(images[i], pixel.x, pixel.y)[c], 255 * kept, 0.51) << "frame " << frames[i];
    }
}

TEST(DebugHistoryWeight, IsThatOfAChangeAfterEveryRasterState) {
    using Change = void (*)(Engine&, MaterialInstance);
    const Change changes[] = {
        [](Engine& engine, MaterialInstance material) { EXPECT_TRUE(engine.setDoubleSided(material, false)); },
        [](Engine& engine, MaterialInstance material) { engine.setCullingDisabled(material, true); },
        [](Engine& engine, MaterialInstance material) { engine.setCulling(material, Culling::None); },
        [](Engine& engine, MaterialInstance material) { engine.setShadowCulling(material, Culling::Front); },
        [](Engine& engine, MaterialInstance material) { engine.setColorWrite(material, true); },
        [](Engine& engine, MaterialInstance material) { engine.setDepthWrite(material, true); },
        [](Engine& engine, MaterialInstance material) { engine.setDepthCulling(material, true); },
        [](Engine& engine, MaterialInstance material) { engine.setStencil(material, std::nullopt); },
    };
    const std::vector<Image> images = test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
        stage.showHistoryWeight({ 32, 24 });
        stage.add(1, { 0, 0, -2 }, 40);
        std::vector<Image> frames;
        for (const Change change : changes) {
            for (int i = 0; i < 20; ++i) stage.draw();
            change(stage.engine, stage.lastMaterial());
            frames.push_back(stage.draw());
        }
        return frames;
    });
    for (size_t i = 0; i < images.size(); ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(codesAt(images[i], 16, 12)[c], 255 * 0.8, 0.51) << "change " << i;
}

/// The camera moves to the right by a quarter of the image's width: what comes into it there is new.
TEST(DebugHistoryWeight, IsNoneWhereNothingWasSeenBefore) {
    const std::vector<Image> images = test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
        stage.showHistoryWeight({ 64, 32 });
        stage.add(1, { 0, 0, -2 }, 40);
        for (int i = 0; i < 8; ++i) stage.draw();
        stage.view.camera = Camera::lookAt({ 2, 0, 0 }, { 2, 0, -1 }, { .verticalFovDegrees = 90 }); // 8 m are seen
        return std::vector{ stage.draw() };
    });
    for (uint32_t x = 0; x < 64; ++x) {
        const int3 color = codesAt(images[0], x, 16);
        if (x >= 49) {
            EXPECT_EQ(color, int3(0)) << x;
        }
        for (int c = 0; x < 47 && c < 3; ++c) EXPECT_NEAR(color[c], 255 * 0.8, 0.51) << x << ": a fifth is new";
    }
}

/// A disoccluded surface has no history: its colour is clamped to its neighbours.
TEST(DebugHistoryWeight, IsOrangeWhereColoursAreLimited) {
    const std::vector<Image> images = test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
        stage.showHistoryWeight({ 64, 32 });
        stage.add(0.1f, { 0, 0, -4 }, 40);
        const Renderable square = stage.add(4, { -1, 0, -2 }, 0.5);
        for (int i = 0; i < 4; ++i) stage.draw();
        stage.scene.setTransform(square, glm::translate(double4x4(1), double3(1, 0, -2)) *
                                                 glm::scale(double4x4(1), double3(0.5)));
        return std::vector{ stage.draw() };
    });
    const double kept = 0.8; // at -1 m of 2 m to each side in height: pixel 32 - 8
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(codesAt(images[0], 24, 16)[c], kOrange[c] * kept, 1.01);
    EXPECT_EQ(codesAt(images[0], 6, 16).x, codesAt(images[0], 6, 16).z) << "nothing happened there";
}

TEST(DebugHistoryWeight, IsBlackWithoutGathering) {
    const std::vector<Image> images = test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
        stage.view.size = { 32, 24 };
        stage.view.debugView = DebugView::HistoryWeight;
        stage.add(1, { 0, 0, -2 }, 1);
        Image image = stage.draw();
        EXPECT_TRUE(stage.says("debugView=historyWeight: its effect does not run"));
        return std::vector{ std::move(image) };
    });
    EXPECT_EQ(codesAt(images[0], 16, 12), int3(0));
}

// ---- histogram

constexpr uint2 kHistogramSize(128, 96);
constexpr int kPanel = 32; // a third of it

int binOf(double light) { return static_cast<int>((std::log2(light) + 12) * 8 / 3); }

/// Pixels of one colour in a column, from the lower edge.
int heightOf(Image const& image, int bin, int3 color) {
    int pixels = 0;
    for (int y = 0; y < kPanel; ++y) {
        const int3 found = codesAt(image, static_cast<uint32_t>(2 * bin), image.height - 1 - static_cast<uint32_t>(y));
        pixels += glm::all(glm::lessThanEqual(glm::abs(found - color), int3(1))) ? 1 : 0;
    }
    return pixels;
}

/// A quarter of the image has another light than the rest; each second pixel of each second row is counted.
TEST(DebugHistogram, HasBarsAsHighAsTheirCounts) {
    for (const auto& [dark, bright] : { std::pair(0.125f, 2.0f), std::pair(0.01f, 0.9f), std::pair(0.3f, 30.0f) }) {
        for (const auto& [low, high] : { std::pair(0.4f, 0.95f), std::pair(0.0f, 1.0f), std::pair(0.1f, 0.2f) }) {
            const auto draw = [dark = dark, bright = bright, low = low, high = high](SquaresStage& stage) {
                stage.view.size = kHistogramSize;
                stage.view.effects.autoExposure = {
                    .enabled = true, .lowPercentile = low, .highPercentile = high, .minStops = -16, .maxStops = 16
                };
                stage.view.debugView = DebugView::Histogram;
                stage.add(bright, { 0, 0, -2 }, 9);
                stage.add(dark, { -1 - 2.0 / 3, 0, -1 }, 1); // up to a quarter of 8/3 m
                return std::vector{ stage.draw() };
            };
            const std::vector<Image> images = test::sameOnBothApis<SquaresStage>(draw);
            const double all = 64 * 48, darkCount = all / 4, brightCount = all * 3 / 4;
            const double first = low * all, last = high * all;
            const double darkIn = std::clamp(last, 0.0, darkCount) - std::clamp(first, 0.0, darkCount);
            const double brightIn =
                    std::clamp(last - darkCount, 0.0, brightCount) - std::clamp(first - darkCount, 0.0, brightCount);
            const auto rows = [&](double count) { return kPanel * count / brightCount; };
            const double middle =
                    (darkIn * ((binOf(dark) + 0.5) * 3 / 8 - 12) + brightIn * ((binOf(bright) + 0.5) * 3 / 8 - 12)) /
                    (darkIn + brightIn);
            const auto mark = static_cast<int>((middle + 12) * 8 / 3 * 2); // pixel that becomes middle grey
            const auto markedOf = [&](int bin) { return 2 * bin == mark; };
            for (const auto& [bin, count, in] :
                 { std::tuple(binOf(dark), darkCount, darkIn), std::tuple(binOf(bright), brightCount, brightIn) }) {
                if (markedOf(bin)) continue;
                EXPECT_NEAR(heightOf(images[0], bin, kBlue), rows(in), 0.51) << dark << " " << low;
                EXPECT_NEAR(heightOf(images[0], bin, kGrey) + heightOf(images[0], bin, kBlue), rows(count), 0.51);
            }
            for (int bin = 0; bin < 64; ++bin) {
                if (bin == binOf(dark) || bin == binOf(bright) || markedOf(bin)) continue;
                EXPECT_EQ(heightOf(images[0], bin, kBlue) + heightOf(images[0], bin, kGrey), 0) << bin;
            }
            int marked = 0;
            for (uint32_t x = 0; x < kHistogramSize.x; ++x) {
                if (codesAt(images[0], x, 80) != kOrange) continue;
                EXPECT_NEAR(static_cast<int>(x), mark, 1) << dark << " " << low;
                ++marked;
            }
            EXPECT_EQ(marked, 1);
        }
    }
}

TEST(DebugHistogram, IsThePictureAloneWithoutAutoExposure) {
    const std::vector<Image> images = test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
        stage.view.size = kHistogramSize;
        stage.view.debugView = DebugView::Histogram;
        stage.add(1, { 0, 0, -2 }, 9);
        Image image = stage.draw();
        EXPECT_TRUE(stage.says("debugView=histogram: its effect does not run"));
        return std::vector{ std::move(image) };
    });
    for (const uint32_t y : { 0u, 48u, 95u })
        for (const uint32_t x : { 0u, 64u, 127u }) EXPECT_EQ(codesAt(images[0], x, y), codesAt(images[0], 64, 10));
    EXPECT_GT(codesAt(images[0], 64, 10).x, 100);
}

/// Pictures of one pixel and of odd sizes, also as light, with four samples, and without anything in view.
TEST(DebugEffects, AreDrawnInAllSizesAndTargets) {
    for (const DebugView debugView : { DebugView::CircleOfConfusion, DebugView::HistoryWeight, DebugView::Histogram }) {
        for (const uint2 size : { uint2(1, 1), uint2(3, 70), uint2(131, 17) }) {
            for (const bool isEmpty : { false, true }) {
                test::sameOnBothApis<SquaresStage>([&](SquaresStage& stage) {
                    stage.view.size = size;
                    stage.view.samples = 4;
                    stage.view.debugView = debugView;
                    stage.view.quality.antiAliasing = AntiAliasing::Taa;
                    stage.view.effects.autoExposure.enabled = true;
                    stage.view.effects.depthOfField = { .enabled = true, .focusMeters = 1, .blurScale = 100 };
                    if (!isEmpty) stage.add(60'000, { 0.2, 0, -2 }, 1);
                    std::vector<Image> images{ stage.draw(), stage.draw() };
                    images.push_back(test::renderLinear(stage.engine, stage.scene, stage.view));
                    return images;
                });
            }
        }
    }
}

} // namespace
} // namespace filament_core
