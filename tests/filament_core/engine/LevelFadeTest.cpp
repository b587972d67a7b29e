// SPDX-License-Identifier: Apache-2.0
// Levels of detail that fade into each other under temporal anti-aliasing: how much a frame changes beside the last one
// where a level is replaced, with and without the fade; what each pixel shows meanwhile; the same bits on both APIs.
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/Primitives.h>
#include <filament_core/Renderer.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

using test::halfPixel;

constexpr float kLarge = 0.5f, kSmall = 0.42f; // metres: radii of the levels 0 and 1
constexpr uint32_t kFadeLasts = 32;            // frames
constexpr int kSettled = 12;                   // frames until edges are smooth

/// A white ball, 48 pixels wide on black, whose coarser level is smaller.
class Ball {
public:
    explicit Ball(Backend backend, int workers = 1)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = workers, .validation = true }))),
              scene(engine), renderer(engine) {
        Mesh mesh = *makeIcoSphere({ .radius = kLarge, .subdivisions = 3 });
        const Mesh small = *makeIcoSphere({ .radius = kSmall, .subdivisions = 2 });
        const auto fine = static_cast<uint32_t>(mesh.indices.size()),
                   first = static_cast<uint32_t>(mesh.vertices.size());
        for (const uint32_t index : small.indices) mesh.indices.push_back(first + index);
        mesh.vertices.insert(mesh.vertices.end(), small.vertices.begin(), small.vertices.end());
        mMaterial = engine.own(*createBuiltInMaterial(engine, "unlit"));
        mInstance = engine.own(engine.createInstance(mMaterial));
        mVertices = engine.own(engine.create(mesh.vertexBuffer()));
        mIndices = engine.own(engine.create(mesh.indexBuffer()));
        const std::vector<GeometryLevel> levels{ { fine, static_cast<uint32_t>(small.indices.size()),
                                                   kLarge - kSmall } };
        scene.add({ .vertices = mVertices,
                    .indices = mIndices,
                    .material = mInstance,
                    .indexCount = fine,
                    .bounds = mesh.bounds(),
                    .levels = levels });
        view.size = uint2(64);
        view.quality.antiAliasing = AntiAliasing::Taa;
        view.lod.pixels = 8;
        lookFrom(2.3);
    }
    ~Ball() { test::expectNoErrors(engine); }

    void lookFrom(double meters) {
        view.camera = Camera::lookAt({ 0, 0, meters }, { 0, 0, 0 }, { .verticalFovDegrees = 32 });
    }
    Image draw() { return test::renderLinear(engine, renderer, scene, view); }
    /// A second one, below the first, for which the colour pass has depths of its own.
    void addWithStencil() {
        mWithStencil = engine.own(engine.createInstance(mMaterial));
        engine.setStencil(mWithStencil, StencilState{});
        double4x4 below(0.25);
        below[3] = double4(0, -0.5, 0, 1);
        scene.add({ .vertices = mVertices, .indices = mIndices, .material = mWithStencil, .worldFromObject = below });
    }
    /// After so many frames of the finest level, the first frames in which the coarser one is wanted.
    std::vector<Image> replaced(uint32_t frames) {
        view.lod.pixels = 0.01f;
        for (int i = 0; i < 24; ++i) (void)draw();
        view.lod.pixels = 64;
        std::vector<Image> images;
        for (uint32_t i = 0; i < frames; ++i) images.push_back(draw());
        return images;
    }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;

private:
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance, mWithStencil;
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
};

/// Of pixels, 1 is white.
struct Change {
    float largest = 0;
    float sum = 0; ///< of all
};

Change changeBetween(Image const& a, Image const& b) {
    Change change;
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x) {
            const float pixel = std::abs(halfPixel(a, x, y).x - halfPixel(b, x, y).x);
            change = { std::max(change.largest, pixel), change.sum + pixel };
        }
    }
    return change;
}

double lightOf(Image const& image) {
    double sum = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) sum += static_cast<double>(halfPixel(image, x, y).x);
    return sum;
}

/// The largest between two frames of a camera that moves away slowly, past a switch if there are levels.
Change largestChangeOnTheWay(DepthPrepass prepass, bool hasLevels) {
    Ball ball(Backend::Vulkan);
    ball.view.quality.depthPrepass = prepass;
    // An error of 8 cm behind 1.86 m takes three quarters of the limit, which the first frame does not know.
    const float limit = hasLevels ? 6.9f : 0.01f;
    ball.view.lod.pixels = 0.01f;
    Change largest;
    Image last;
    double first = 0;
    for (int i = 0; i < 96; ++i) {
        ball.lookFrom(2.33 + 0.001 * i);
        Image image = ball.draw();
        ball.view.lod.pixels = limit;
        if (i == kSettled) first = lightOf(image);
        const Change change = i > kSettled ? changeBetween(last, image) : Change{};
        largest = { std::max(largest.largest, change.largest), std::max(largest.sum, change.sum) };
        last = std::move(image);
    }
    EXPECT_EQ(lightOf(last) < 0.85 * first, hasLevels) << "whether the camera passed a switch";
    return largest;
}

TEST(LevelFade, BoundsHowMuchAFrameChanges) {
    const Change faded = largestChangeOnTheWay(DepthPrepass::On, true),
                 replaced = largestChangeOnTheWay(DepthPrepass::Off, true),
                 moved = largestChangeOnTheWay(DepthPrepass::On, false);
    RecordProperty("faded", fmt::format("{:.3f} {:.1f}", faded.largest, faded.sum));
    RecordProperty("replaced", fmt::format("{:.3f} {:.1f}", replaced.largest, replaced.sum));
    RecordProperty("moved", fmt::format("{:.3f} {:.1f}", moved.largest, moved.sum));
    EXPECT_GT(replaced.largest, 0.95f);
    EXPECT_LT(faded.largest, 0.65f);
    EXPECT_GT(replaced.sum, 6 * faded.sum);
    EXPECT_LT(moved.sum, faded.sum);
}

TEST(LevelFade, ShowsShareOfBothLevelsThatGrowsEvenly) {
    Ball ball(Backend::Vulkan);
    const std::vector<Image> images = ball.replaced(kFadeLasts + 40);
    const double last = lightOf(images.back());
    double before = lightOf(images[0]);
    const double first = before;
    for (size_t i = 1; i < images.size(); ++i) {
        const double light = lightOf(images[i]);
        EXPECT_LT(light, before + 0.01 * first) << i;
        EXPECT_GT(light, before - 0.12 * (first - last)) << i;
        before = light;
    }
    EXPECT_LT(last, 0.8 * first);
    for (uint32_t y = 0; y < 64; ++y)
        for (uint32_t x = 0; x < 64; ++x) EXPECT_LE(halfPixel(images[8], x, y).x, 1.01f) << "a pixel counts once";
}

TEST(LevelFade, HasTheSameBitsOnBothApisAndForAnyNumberOfWorkers) {
    Ball vulkan(Backend::Vulkan), gles(Backend::Gles), four(Backend::Vulkan, 4);
    const auto images = vulkan.replaced(kFadeLasts + 2), others = gles.replaced(kFadeLasts + 2),
               third = four.replaced(kFadeLasts + 2);
    for (size_t i = 0; i < images.size(); ++i) {
        EXPECT_EQ(test::differingPixels(images[i], others[i]), 0u) << i;
        EXPECT_EQ(test::differingPixels(images[i], third[i]), 0u) << i;
    }
}

TEST(LevelFade, ReplacesAtOnceWhereTheColorPassHasItsOwnDepths) {
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        Ball with(backend), without(backend);
        with.addWithStencil();
        without.addWithStencil();
        without.view.quality.depthPrepass = DepthPrepass::Off;
        EXPECT_EQ(test::differingPixels(with.replaced(1)[0], without.replaced(1)[0]), 0u);
    }
}

TEST(LevelFade, NeedsTheDepthPrepassWhileItLasts) {
    Ball ball(Backend::Vulkan);
    const auto draws = [&] { return ball.renderer.explain().find("0 'depth'") != std::string::npos; };
    (void)ball.replaced(kFadeLasts - 1);
    EXPECT_TRUE(draws());
    (void)ball.draw();
    EXPECT_FALSE(draws()) << ball.renderer.explain();
}

} // namespace
} // namespace filament_core
