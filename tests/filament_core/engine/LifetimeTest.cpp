// SPDX-License-Identifier: Apache-2.0
// Objects that the app destroys while something uses them: images stay, and the memory is free once the last use
// ends.
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <filament_core/Animator.h>

#include <functional>
#include <optional>

namespace filament_core {
namespace {

constexpr const char* kUvPaint = R"(material { name : paint, shadingModel : unlit, requires : [ uv0 ],
    parameters : [ { type : float4, name : tint }, { type : sampler2d, name : picture } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = materialParams.tint * texture(materialParams_picture, getUV0()); } })";

Texture makePicture(Engine& engine, uint32_t seed) {
    std::array<uint8_t, 4 * 4 * 4> texels{};
    for (size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<uint8_t>(seed * 31 + i * 37);
    return engine.create(
            TextureDesc{ .width = 4, .height = 4, .pixels = std::as_bytes(std::span(texels)), .name = "picture" });
}

bool showsSomething(Image const& image) {
    return std::ranges::any_of(image.pixels, [&](std::byte one) { return one != image.pixels[0]; });
}

/// A square with everything of its own: geometry, morph targets, material, instance, texture.
struct Painting {
    Texture texture;
    VertexBuffer vertices;
    IndexBuffer indices;
    MorphTargets targets;
    Material material;
    MaterialInstance instance;
    Renderable renderable;

    Painting(Engine& engine, Scene& scene, uint32_t seed, double3 at = {}, double scale = 1)
            : texture(makePicture(engine, seed)) {
        struct Vertex {
            float3 position;
            float2 uv;
        };
        const std::array<Vertex, 4> corners{ { { { -1, -1, 0 }, { 0, 1 } },
                                               { { 1, -1, 0 }, { 1, 1 } },
                                               { { 1, 1, 0 }, { 1, 0 } },
                                               { { -1, 1, 0 }, { 0, 0 } } } };
        const std::array<uint16_t, 6> order{ 0, 1, 2, 0, 2, 3 };
        const std::array<float3, 4> moved{ float3(0.2f, 0, 0), float3(0), float3(0, -0.3f, 0), float3(0) };
        vertices = engine.create(
                VertexBufferDesc{ .vertexCount = 4,
                                  .stride = sizeof(Vertex),
                                  .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                                  { Attribute::Uv0, VertexFormat::Float2, offsetof(Vertex, uv) } },
                                  .data = std::as_bytes(std::span(corners)),
                                  .name = "corners" });
        indices = engine.create(
                IndexBufferDesc{ .indexCount = 6, .data = std::as_bytes(std::span(order)), .name = "order" });
        targets = engine.create(MorphTargetsDesc{ .vertexCount = 4, .targets = { { .positions = moved } } });
        material = *engine.create(MaterialDesc{ .package = test::compiledPackage(kUvPaint) });
        instance = engine.createInstance(material, "red");
        EXPECT_TRUE(engine.set(instance, "tint", ParameterValue(float4(1, 0.5f, 0.25f, 1))));
        EXPECT_TRUE(engine.set(instance, "picture", texture));
        double4x4 world(scale);
        world[3] = double4(at, 1);
        renderable = scene.add({ .vertices = vertices,
                                 .indices = indices,
                                 .material = instance,
                                 .bounds = Box{ double3(-1.3f), double3(1.3f) },
                                 .worldFromObject = world,
                                 .morphTargets = targets,
                                 .morphWeights = { 0.5f } });
    }

    using End = std::function<void(Engine&)>;
    std::vector<End> ends() const {
        return {
            [this](Engine& engine) { engine.destroy(texture); },  [this](Engine& engine) { engine.destroy(vertices); },
            [this](Engine& engine) { engine.destroy(indices); },  [this](Engine& engine) { engine.destroy(targets); },
            [this](Engine& engine) { engine.destroy(material); }, [this](Engine& engine) { engine.destroy(instance); }
        };
    }
};

class LifetimeTest : public testing::TestWithParam<Backend> {
protected:
    LifetimeTest()
            : engine(std::move(*Engine::create({ .backend = GetParam(), .workers = 1, .validation = true }))),
              scene(engine), renderer(engine) {}
    ~LifetimeTest() override { test::expectNoErrors(engine); }

    Image draw() {
        auto image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image.ok()) << image.error().message;
        return image ? std::move(*image) : Image{};
    }

    /// Of the device, once everything that ended is gone, and what frames before needed.
    uint64_t bytesInUse() {
        for (int frame = 0; frame < 20; ++frame) (void)draw();
        engine.waitIdle();
        return engine.statistics().deviceBytes;
    }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view = test::SquareMesh::view({ 48, 48 });
};

TEST_P(LifetimeTest, WhatIsDestroyedWhileItIsShownStaysUntilItIsRemoved) {
    { // what every engine keeps after its first frames
        const Painting first(engine, scene, 1);
        (void)bytesInUse();
        scene.remove(first.renderable);
        for (Painting::End const& end : first.ends()) end(engine);
    }
    const uint64_t before = bytesInUse();
    const size_t count = 6;
    for (size_t first = 0; first < count; ++first) {
        const Painting painting(engine, scene, 1);
        const Image whole = draw();
        EXPECT_TRUE(showsSomething(whole));
        for (size_t i = 0; i < count; ++i) { // in every order that begins somewhere else
            painting.ends()[(first + i) % count](engine);
            EXPECT_EQ(draw().pixels, whole.pixels) << first << ", " << i;
        }
        EXPECT_GT(bytesInUse(), before);
        scene.remove(painting.renderable);
        EXPECT_EQ(bytesInUse(), before) << first;
    }
}

TEST_P(LifetimeTest, WhatIsDestroyedBeforeItsFirstFrameIsShown) {
    const Painting kept(engine, scene, 5);
    const Image whole = draw();
    scene.remove(kept.renderable);
    const Painting destroyed(engine, scene, 5);
    for (Painting::End const& end : destroyed.ends()) end(engine);
    EXPECT_EQ(draw().pixels, whole.pixels);
    for (Painting::End const& end : kept.ends()) end(engine);
}

TEST_P(LifetimeTest, TexturesLiveAsLongAsInstancesAndTargetsShowThem) {
    const Painting painting(engine, scene, 2);
    const Texture other = makePicture(engine, 3);
    ASSERT_TRUE(engine.set(painting.instance, "picture", other));
    const Image shown = draw();
    engine.destroy(other);
    EXPECT_EQ(draw().pixels, shown.pixels);
    ASSERT_TRUE(engine.set(painting.instance, "picture", painting.texture)); // the last use of the other one ends
    EXPECT_NE(draw().pixels, shown.pixels);

    const Texture color = engine.create(TextureDesc{ .width = 48, .height = 48, .renderable = true, .name = "mirror" });
    const Texture depth = engine.create(
            TextureDesc{ .format = Format::R32F, .width = 48, .height = 48, .renderable = true, .name = "depths" });
    const RenderTarget target = engine.create(RenderTargetDesc{ .color = color, .depth = depth });
    engine.destroy(color), engine.destroy(depth);
    EXPECT_FALSE(engine.colorOf(target) || engine.depthOf(target)) << "their handles ended";
    renderer.render(scene, view, target);
    const auto pixels = renderer.waitPixels(renderer.readPixels(target));
    ASSERT_TRUE(pixels) << pixels.error().message;
    EXPECT_EQ(pixels->pixels, draw().pixels);
    engine.destroy(target);
    for (Painting::End const& end : painting.ends()) end(engine);
}

TEST_P(LifetimeTest, AnEnvironmentShinesUntilItIsReplaced) {
    const std::vector<std::byte> grey(6 * 4 * 4 * 4, std::byte{ 90 });
    const TextureDesc cube{ .kind = TextureKind::Cube, .width = 4, .height = 4, .layers = 6, .pixels = grey };
    scene.setSkybox({}, Lux{ 1 });
    const Image dark = draw();
    const Texture texture = engine.create(cube);
    const IndirectLight light = engine.create(IndirectLightDesc{ .specular = texture });
    const Skybox skybox = engine.create(SkyboxDesc{ .cube = texture });
    scene.setIndirectLight(light, Lux{ 30'000 });
    scene.setSkybox(skybox, Lux{ 30'000 });
    const Image lit = draw();
    EXPECT_NE(lit.pixels, dark.pixels);
    const uint64_t shown = bytesInUse();
    engine.destroy(light), engine.destroy(skybox), engine.destroy(texture);
    EXPECT_EQ(draw().pixels, lit.pixels);
    EXPECT_EQ(bytesInUse(), shown);
    scene.setIndirectLight({}, Lux{ 1 });
    EXPECT_EQ(bytesInUse(), shown) << "the sky still shows it";
    scene.setSkybox({}, Lux{ 1 });
    EXPECT_LT(bytesInUse(), shown);
}

TEST_P(LifetimeTest, ASceneLetsGoOfWhatItShowsWhenItEnds) {
    { // as above
        Scene first(engine);
        const Painting painting(engine, first, 1);
        ASSERT_TRUE(renderer.renderToImage(first, view));
        for (Painting::End const& end : painting.ends()) end(engine);
    }
    const uint64_t before = bytesInUse();
    std::optional<Scene> other(std::in_place, engine);
    const Painting painting(engine, *other, 4);
    for (Painting::End const& end : painting.ends()) end(engine);
    EXPECT_GT(bytesInUse(), before);
    other.reset();
    EXPECT_EQ(bytesInUse(), before);
}

/// Two scenes with the same paintings: one's are destroyed at random times, the other's at the end.
TEST_P(LifetimeTest, PicturesDoNotShowWhatIsDestroyed) {
    Scene careful(engine);
    prepare::Random random(GetParam() == Backend::Vulkan ? 7u : 8u);
    const auto below = [&random](size_t end) { return random.next() % end; };
    struct Pair {
        std::unique_ptr<Painting> early, late;
        std::vector<size_t> open{ 0, 1, 2, 3, 4, 5 }; ///< of Painting::ends(), of the early one
    };
    std::vector<Pair> pairs;
    uint32_t seed = 0;
    for (int step = 0; step < 60; ++step) {
        const size_t what = below(4);
        if (what == 0 || pairs.empty()) {
            const double3 at{ random.within(-0.8, 0.8), random.within(-0.8, 0.8), -0.1 * step };
            ++seed;
            pairs.push_back({ std::make_unique<Painting>(engine, scene, seed, at, 0.4),
                              std::make_unique<Painting>(engine, careful, seed, at, 0.4) });
        } else if (what == 3) {
            const size_t i = below(pairs.size());
            scene.remove(pairs[i].early->renderable);
            careful.remove(pairs[i].late->renderable);
            for (const size_t end : pairs[i].open) pairs[i].early->ends()[end](engine);
            for (Painting::End const& end : pairs[i].late->ends()) end(engine);
            pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(i));
        } else {
            Pair& pair = pairs[below(pairs.size())];
            if (pair.open.empty()) continue;
            const size_t i = below(pair.open.size());
            pair.early->ends()[pair.open[i]](engine);
            pair.open.erase(pair.open.begin() + static_cast<std::ptrdiff_t>(i));
        }
        auto expected = renderer.renderToImage(careful, view);
        ASSERT_TRUE(expected);
        ASSERT_EQ(draw().pixels, expected->pixels) << "step " << step;
    }
    for (Pair const& pair : pairs) {
        for (const size_t end : pair.open) pair.early->ends()[end](engine);
        for (Painting::End const& end : pair.late->ends()) end(engine);
    }
}

INSTANTIATE_TEST_SUITE_P(BothApis, LifetimeTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

// ---- models

class ModelLifetimeTest : public test::AssetTest, public testing::WithParamInterface<Backend> {};

TEST_P(ModelLifetimeTest, CopiesAndAnimatorsKeepTheirModel) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Renderer renderer(*engine);
    const View view{ .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 55 }),
                     .size = { 64, 48 } };
    std::vector<Image> images;
    for (const bool endsEarly : { false, true }) {
        auto loaded = loadGltf(*engine, tools::assetDir() / "models/AnimatedMorphCube/AnimatedMorphCube.glb");
        ASSERT_TRUE(loaded) << loaded.error().message;
        std::optional<Model> model(std::move(*loaded));
        Scene scene(*engine);
        const Node root = scene.add(*model, fitToUnitCube(model->bounds()));
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 60'000 } });
        Animator animator(*model, scene, root);
        if (endsEarly) model.reset();
        animator.apply(0, 1.5);
        auto image = renderer.renderToImage(scene, view);
        ASSERT_TRUE(image);
        images.push_back(std::move(*image));
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    test::expectNoErrors(*engine);
}

TEST_P(ModelLifetimeTest, ModelsScenesAndAnimatorsMayOutliveTheirEngine) {
    std::optional<Model> model;
    std::optional<Scene> scene;
    std::optional<Animator> animator;
    {
        auto engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
        auto loaded = loadGltf(*engine, tools::assetDir() / "models/AnimatedMorphCube/AnimatedMorphCube.glb");
        ASSERT_TRUE(loaded) << loaded.error().message;
        model.emplace(std::move(*loaded));
        scene.emplace(*engine);
        const Node root = scene->add(*model);
        animator.emplace(*model, *scene, root);
        Renderer renderer(*engine);
        ASSERT_TRUE(renderer.renderToImage(*scene, { .size = { 8, 8 } }));
    }
    EXPECT_DEATH((void)model->name(), "Model::name.*: its engine is gone; destroy engines last");
    EXPECT_DEATH(animator->rest(), "Animator::rest.*: its engine is gone; destroy engines last");
    scene.reset();
    EXPECT_DEATH(animator->rest(), "Animator::rest.*: its scene is gone");
}

INSTANTIATE_TEST_SUITE_P(BothApis, ModelLifetimeTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
