// SPDX-License-Identifier: Apache-2.0
// What exists is changed: contents of buffers and textures, lights, geometry, bounds, visibility. Each image has the
// bits of one in which everything was made that way.
#include "tests/filament_core/engine/ShadowStage.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cstring>
#include <functional>

namespace filament_core {
namespace {

using test::ShadowStage;

constexpr const char* kShown = R"(material { name : shown, shadingModel : unlit, requires : [ uv0, color ],
    parameters : [ { type : sampler2d, name : picture } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = getColor() * textureLod(materialParams_picture, getUV0(), getUV0().x * 3.0); } })";

struct Vertex {
    float3 position;
    float4 tangents{ 0, 0, 0, 1 };
    float2 uv;
    float4 color;
};

/// A grid of 7 x 7 vertices before the camera, each moved and coloured at random.
std::vector<Vertex> vertices(prepare::Random& random) {
    std::vector<Vertex> all;
    const auto number = [&](double low, double high) { return static_cast<float>(random.within(low, high)); };
    for (float y = 0; y < 7; ++y)
        for (float x = 0; x < 7; ++x)
            all.push_back(
                    { { x / 3.5f - 0.86f + number(-0.1, 0.1), y / 3.5f - 0.86f + number(-0.1, 0.1), number(0, 0.3) },
                      { 0, 0, 0, 1 },
                      { x / 6.0f, y / 6.0f },
                      { number(0, 1), number(0, 1), number(0, 1), 1 } });
    return all;
}

template <class Index>
std::vector<Index> triangles(prepare::Random& random) {
    std::vector<Index> all;
    for (int i = 0; i < 60 * 3; ++i) all.push_back(static_cast<Index>(random.next() % 49));
    return all;
}

std::vector<std::byte> texels(prepare::Random& random, size_t bytes) {
    std::vector<std::byte> all(bytes);
    for (std::byte& one : all) one = static_cast<std::byte>(random.next());
    return all;
}

template <class T>
std::span<const std::byte> bytesOf(std::vector<T> const& values) {
    return std::as_bytes(std::span(values));
}

/// A mesh of its own vertices, indices and texture.
struct Mesh {
    Owned<VertexBuffer> vertices;
    Owned<IndexBuffer> indices;
    Owned<Texture> texture;

    Mesh(Engine& engine, std::span<const std::byte> vertexBytes, std::span<const std::byte> indexBytes,
         IndexFormat format, TextureDesc const& desc)
            : vertices(engine.own(engine.create(VertexBufferDesc{
                      .vertexCount = static_cast<uint32_t>(vertexBytes.size() / sizeof(Vertex)),
                      .stride = sizeof(Vertex),
                      .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                      { Attribute::Tangents, VertexFormat::Float4, offsetof(Vertex, tangents) },
                                      { Attribute::Uv0, VertexFormat::Float2, offsetof(Vertex, uv) },
                                      { Attribute::Color, VertexFormat::Float4, offsetof(Vertex, color) } },
                      .data = vertexBytes }))),
              indices(engine.own(engine.create(IndexBufferDesc{
                      .indexCount = static_cast<uint32_t>(indexBytes.size() / (format == IndexFormat::UInt16 ? 2 : 4)),
                      .format = format,
                      .data = indexBytes }))),
              texture(engine.own(engine.create(desc))) {}
};

class ChangesTest : public testing::TestWithParam<Backend> {
protected:
    ChangesTest() : stage(GetParam()), shown(test::loadMaterial(stage.engine, kShown)) {}

    Image draw(Scene const& scene, View const& view) {
        auto image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image.ok()) << image.error().message;
        return image ? std::move(*image) : Image{};
    }
    /// By a renderer that has drawn nothing yet.
    Image drawAnew(Scene const& scene, View const& view) {
        auto image = Renderer(stage.engine).renderToImage(scene, view);
        EXPECT_TRUE(image.ok()) << image.error().message;
        return image ? std::move(*image) : Image{};
    }
    Image picture(Mesh const& mesh) {
        const Owned<MaterialInstance> instance = stage.engine.own(stage.engine.createInstance(shown));
        EXPECT_TRUE(stage.engine.set(instance, "picture", mesh.texture));
        Scene scene(stage.engine);
        scene.add({ .vertices = mesh.vertices, .indices = mesh.indices, .material = instance });
        return draw(scene, test::SquareMesh::view({ 40, 40 }));
    }

    ShadowStage stage;
    Renderer renderer{ stage.engine };
    Owned<Material> shown;
};

TEST_P(ChangesTest, UpdatedBuffersAreThoseThatWereMadeThatWay) {
    prepare::Random random(11);
    const TextureDesc plain{ .pixels = {} };
    for (const IndexFormat format : { IndexFormat::UInt16, IndexFormat::UInt32 }) {
        const std::vector<std::byte> white(4, std::byte{ 255 });
        TextureDesc desc = plain;
        desc.pixels = white;
        std::vector<Vertex> points = vertices(random);
        std::vector<uint16_t> short16 = triangles<uint16_t>(random);
        std::vector<uint32_t> long32(short16.begin(), short16.end());
        const auto indexBytes = [&] { return format == IndexFormat::UInt16 ? bytesOf(short16) : bytesOf(long32); };
        const Mesh mesh(stage.engine, bytesOf(points), indexBytes(), format, desc);
        for (int step = 0; step < 12; ++step) {
            const std::vector<Vertex> moved = vertices(random);
            const uint32_t first = random.next() % 49, count = 1 + random.next() % (49 - first);
            std::copy_n(moved.begin() + first, count, points.begin() + first);
            stage.engine.update(mesh.vertices, bytesOf(points).subspan(first * sizeof(Vertex), count * sizeof(Vertex)),
                                first);
            const std::vector<uint16_t> others = triangles<uint16_t>(random);
            const uint32_t from = random.next() % 180, some = 1 + random.next() % (180 - from);
            std::copy_n(others.begin() + from, some, short16.begin() + from);
            long32.assign(short16.begin(), short16.end());
            const size_t each = indexBytes().size() / 180;
            stage.engine.update(mesh.indices, indexBytes().subspan(from * each, some * each), from);
            const Image changed = picture(mesh);
            const Mesh made(stage.engine, bytesOf(points), indexBytes(), format, desc);
            ASSERT_EQ(changed.pixels, picture(made).pixels) << step;
        }
    }
}

TEST_P(ChangesTest, UpdatedTexturesAreThoseThatWereMadeThatWay) {
    prepare::Random random(12);
    const std::vector<Vertex> points = vertices(random);
    const std::vector<uint16_t> order = triangles<uint16_t>(random);
    for (const Format format : { Format::RGBA8, Format::RGBA8Srgb }) {
        std::vector<std::byte> base = texels(random, 16 * 8 * 4);
        TextureDesc desc{ .format = format, .width = 16, .height = 8, .generateMips = true, .pixels = base };
        const Mesh mesh(stage.engine, bytesOf(points), bytesOf(order), IndexFormat::UInt16, desc);
        for (int step = 0; step < 6; ++step) {
            const bool isWhole = format == Format::RGBA8Srgb || step % 2 == 0;
            const uint2 offset = isWhole ? uint2(0) : uint2(random.next() % 16, random.next() % 8);
            const uint2 size = isWhole ? uint2(16, 8)
                                       : uint2(1 + random.next() % (16 - offset.x), 1 + random.next() % (8 - offset.y));
            const std::vector<std::byte> part = texels(random, size.x * size.y * 4);
            for (uint32_t y = 0; y < size.y; ++y)
                std::memcpy(&base[((offset.y + y) * 16 + offset.x) * 4], &part[y * size.x * 4], size.x * 4);
            stage.engine.update(mesh.texture, { .pixels = part, .offset = offset, .size = size, .generateMips = true });
            desc.pixels = base;
            const Mesh made(stage.engine, bytesOf(points), bytesOf(order), IndexFormat::UInt16, desc);
            ASSERT_EQ(picture(mesh).pixels, picture(made).pixels) << static_cast<int>(format) << " " << step;
        }
    }
}

TEST_P(ChangesTest, SingleLevelsAndLayersOfTexturesChange) {
    prepare::Random random(13);
    const std::vector<Vertex> points = vertices(random);
    const std::vector<uint16_t> order = triangles<uint16_t>(random);
    std::vector<std::byte> all = texels(random, (64 + 16 + 4 + 1) * 4);
    TextureDesc desc{ .width = 8, .height = 8, .levels = 4, .pixels = all };
    const Mesh mesh(stage.engine, bytesOf(points), bytesOf(order), IndexFormat::UInt16, desc);
    size_t offset = 0;
    for (uint32_t level = 0; level < 4; ++level) {
        const size_t bytes = (64u >> (2 * level)) * 4;
        const std::vector<std::byte> part = texels(random, bytes);
        std::copy(part.begin(), part.end(), all.begin() + static_cast<std::ptrdiff_t>(offset));
        stage.engine.update(mesh.texture, { .pixels = part, .level = level });
        offset += bytes;
        desc.pixels = all;
        const Mesh made(stage.engine, bytesOf(points), bytesOf(order), IndexFormat::UInt16, desc);
        EXPECT_EQ(picture(mesh).pixels, picture(made).pixels) << level;
    }
}

/// Light, shadow and the box of a mesh follow its vertices; maps that are kept from frame to frame would not.
TEST_P(ChangesTest, ShadowsAndBoundsFollowVertices) {
    prepare::Random random(14);
    const std::vector<std::byte> white(4, std::byte{ 255 });
    const std::vector<uint16_t> order = triangles<uint16_t>(random);
    std::vector<Vertex> points = vertices(random);
    const Mesh mesh(stage.engine, bytesOf(points), bytesOf(order), IndexFormat::UInt16, { .pixels = white });
    const View view = test::shadowedView({ 0, -4, 6 }, { 0, 0, 0 }, ShadowFilter::Pcf3);
    const auto furnish = [&](Scene& scene, Mesh const& caster) {
        stage.square.add(scene, stage.white, { 0, 0, -1 }, 6);
        scene.add(SunLight{ .directionWorld = { 0.3f, 0.2f, -1 } });
        scene.add(SpotLight{ .positionWorld = { 2, 0, 4 }, .directionWorld = { -0.4f, 0, -1 } });
        return scene.add({ .vertices = caster.vertices, .indices = caster.indices, .material = stage.white });
    };
    Scene scene(stage.engine);
    furnish(scene, mesh);
    for (int step = 0; step < 6; ++step) {
        for (Vertex& vertex : points) vertex.position += float3(0.4f * float(step % 3 - 1), 0.5f, 0.2f);
        stage.engine.update(mesh.vertices, bytesOf(points));
        const Mesh made(stage.engine, bytesOf(points), bytesOf(order), IndexFormat::UInt16, { .pixels = white });
        Scene other(stage.engine);
        furnish(other, made);
        ASSERT_EQ(draw(scene, view).pixels, drawAnew(other, view).pixels) << step;
        EXPECT_EQ(scene.bounds().max, other.bounds().max) << step;
        EXPECT_EQ(scene.bounds().min, other.bounds().min) << step;
    }
}

/// Holes of masked casters are in shadow maps, too.
TEST_P(ChangesTest, ShadowsFollowTexturesOfMaskedMaterials) {
    prepare::Random random(15);
    const Owned<Material> leaf = test::loadMaterial(stage.engine, R"(material { name : leaf, shadingModel : lit,
        blending : masked, doubleSided : true, requires : [ uv0 ], parameters : [ { type : sampler2d, name : holes } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = texture(materialParams_holes, getUV0()); } })");
    const View view = test::shadowedView({ 0, -4, 6 }, { 0, 0, 0 }, ShadowFilter::Hard);
    const auto furnish = [&](Scene& scene, MaterialInstance holes) {
        stage.square.add(scene, stage.white, { 0, 0, -1 }, 6);
        stage.square.add(scene, holes, { 0, 0, 0 }, 1);
        scene.add(SunLight{ .directionWorld = { 0.3f, 0.2f, -1 } });
    };
    std::vector<std::byte> pixels = texels(random, 8 * 8 * 4);
    const Owned<Texture> texture =
            stage.engine.own(stage.engine.create(TextureDesc{ .width = 8, .height = 8, .pixels = pixels }));
    const Owned<MaterialInstance> instance = stage.engine.own(stage.engine.createInstance(leaf));
    ASSERT_TRUE(stage.engine.set(instance, "holes", texture));
    Scene scene(stage.engine);
    furnish(scene, instance);
    for (int step = 0; step < 4; ++step) {
        pixels = texels(random, pixels.size());
        stage.engine.update(texture, { .pixels = pixels });
        const Owned<Texture> made =
                stage.engine.own(stage.engine.create(TextureDesc{ .width = 8, .height = 8, .pixels = pixels }));
        const Owned<MaterialInstance> other = stage.engine.own(stage.engine.createInstance(leaf));
        ASSERT_TRUE(stage.engine.set(other, "holes", made));
        Scene fresh(stage.engine);
        furnish(fresh, other);
        ASSERT_EQ(draw(scene, view).pixels, drawAnew(fresh, view).pixels) << step;
    }
}

// ---- lights

using AddLight = std::function<Light(Scene&, Node)>;
using SetLight = std::function<void(Scene&, Light)>;
struct Lamp {
    const char* name;
    AddLight add;
    SetLight set;
};

template <class L>
Lamp lampOf(const char* name, L const& light) {
    return { name, [light](Scene& scene, Node node) { return scene.add(light, node); },
             [light](Scene& scene, Light handle) { scene.set(handle, light); } };
}

std::vector<Lamp> everyLamp() {
    return { lampOf("sun", SunLight{ .directionWorld = { 0.5f, 0.1f, -1 }, .illuminance = Lux{ 40'000 } }),
             lampOf("point", PointLight{ .positionWorld = { 1, 0.5, 2 }, .intensity = Candela{ 90'000 } }),
             lampOf("spot", SpotLight{ .positionWorld = { -1, 0, 3 },
                                       .directionWorld = { 0.3f, 0, -1 },
                                       .intensity = Candela{ 200'000 } }),
             lampOf("rect", RectLight{ .positionWorld = { 0, 1, 2 },
                                       .directionWorld = { 0, -0.3f, -1 },
                                       .luminance = Nits{ 60'000 } }),
             lampOf("disc", DiscLight{ .positionWorld = { 0, -1, 2 },
                                       .directionWorld = { 0, 0.3f, -1 },
                                       .luminance = Nits{ 80'000 } }),
             lampOf("tube", TubeLight{ .positionWorld = { 0, 0, 1.5 },
                                       .axisWorld = { 1, 0, 0 },
                                       .luminance = Nits{ 50'000 } }) };
}

TEST_P(ChangesTest, ALightBecomesAnyOtherWhereverItHangs) {
    const View view = test::shadowedView({ 0, -4, 6 }, { 0, 0, 0 }, ShadowFilter::Pcf3, { 32, 32 });
    const double4x4 turned = glm::rotate(glm::translate(double4x4(1), double3(0.3, -0.2, 0.5)), 0.4, double3(1, 2, 3));
    const auto furnish = [&](Scene& scene) {
        stage.square.add(scene, stage.white, { 0, 0, -1 }, 6);
        stage.square.add(scene, stage.white, { 0, 0, 0 }, 0.5);
    };
    const std::vector<Lamp> lamps = everyLamp();
    for (const bool hangs : { false, true }) {
        Scene scene(stage.engine);
        furnish(scene);
        const auto nodeIn = [&](Scene& of) { return hangs ? of.add(NodeDesc{ .parentFromNode = turned }) : Node{}; };
        const Light light = lamps.back().add(scene, nodeIn(scene));
        for (Lamp const& before : lamps) {
            for (Lamp const& after : lamps) {
                before.set(scene, light);
                (void)draw(scene, view);
                after.set(scene, light);
                Scene fresh(stage.engine);
                furnish(fresh);
                after.add(fresh, nodeIn(fresh));
                const Image expected = drawAnew(fresh, view);
                EXPECT_TRUE(
                        std::ranges::any_of(expected.pixels, [&](std::byte one) { return one != expected.pixels[0]; }));
                ASSERT_EQ(draw(scene, view).pixels, expected.pixels)
                        << before.name << " to " << after.name << (hangs ? ", at a node" : "");
            }
        }
    }
}

// ---- geometry, bounds, visibility

TEST_P(ChangesTest, ARenderableTakesOtherGeometry) {
    prepare::Random random(16);
    const std::vector<std::byte> white(4, std::byte{ 255 });
    const std::vector<Vertex> points = vertices(random);
    const std::vector<uint16_t> order = triangles<uint16_t>(random);
    const Mesh mesh(stage.engine, bytesOf(points), bytesOf(order), IndexFormat::UInt16, { .pixels = white });
    const View view = test::shadowedView({ 0, -4, 6 }, { 0, 0, 0 }, ShadowFilter::Pcf3);
    const auto furnish = [&](Scene& scene) {
        stage.square.add(scene, stage.white, { 0, 0, -1 }, 6);
        scene.add(SunLight{ .directionWorld = { 0.3f, 0.2f, -1 } });
    };
    Scene scene(stage.engine);
    furnish(scene);
    const Renderable shape = stage.square.add(scene, stage.white, { 0.5, 0, 1 }, 0.8);
    for (const uint32_t first : { 0u, 30u, 90u }) {
        const GeometryDesc part{
            .vertices = mesh.vertices, .indices = mesh.indices, .firstIndex = first, .indexCount = 60
        };
        (void)draw(scene, view);
        scene.setGeometry(shape, part);
        Scene fresh(stage.engine);
        furnish(fresh);
        double4x4 world(0.8);
        world[3] = double4(0.5, 0, 1, 1);
        fresh.add({ .vertices = mesh.vertices,
                    .indices = mesh.indices,
                    .material = stage.white,
                    .firstIndex = first,
                    .indexCount = 60,
                    .worldFromObject = world });
        ASSERT_EQ(draw(scene, view).pixels, drawAnew(fresh, view).pixels) << first;
        EXPECT_LT(glm::distance(scene.bounds().max, fresh.bounds().max), 1e-6) << "transforms are kept as floats";
    }
}

TEST_P(ChangesTest, WhatIsHiddenIsAsIfItWereNotThere) {
    const View view = test::shadowedView({ 0, -4, 6 }, { 0, 0, 0 }, ShadowFilter::Pcf3);
    Scene scene(stage.engine);
    stage.square.add(scene, stage.white, { 0, 0, -1 }, 6);
    scene.add(SunLight{ .directionWorld = { 0.3f, 0.2f, -1 } });
    const Image without = draw(scene, view);
    const uint32_t draws = renderer.statistics().draws;
    const Node arm = scene.add(NodeDesc{}), hand = scene.add(NodeDesc{ .parent = arm });
    const auto hang = [&](Node node) {
        return scene.add({ .vertices = stage.square.vertices(),
                           .indices = stage.square.indices(),
                           .material = stage.white,
                           .node = node });
    };
    const Renderable onArm = hang(arm);
    scene.setTransform(hand, glm::translate(double4x4(1), double3(1.5, 0.5, 0.3)));
    const Renderable onHand = hang(hand);
    const Image with = draw(scene, view);
    EXPECT_NE(with.pixels, without.pixels);
    scene.setVisible(arm, false);
    EXPECT_FALSE(scene.isVisible(onArm) || scene.isVisible(onHand));
    EXPECT_EQ(draw(scene, view).pixels, without.pixels);
    EXPECT_EQ(renderer.statistics().draws, draws);
    scene.setLayers(onHand, kAllLayers, kAllLayers); // does not bring it back
    EXPECT_EQ(draw(scene, view).pixels, without.pixels);
    scene.setLayers(onHand, kAllLayers, kDefaultLayers);
    scene.setVisible(onHand, true);
    EXPECT_NE(draw(scene, view).pixels, without.pixels);
    scene.setVisible(onArm, true);
    EXPECT_EQ(draw(scene, view).pixels, with.pixels);
}

TEST_P(ChangesTest, BoundsAreThoseOfVerticesUnlessTheyAreNamed) {
    Scene scene(stage.engine);
    const Renderable shape = scene.add(
            { .vertices = stage.square.vertices(), .indices = stage.square.indices(), .material = stage.white });
    EXPECT_EQ(scene.bounds().min, double3(-1, -1, 0));
    EXPECT_EQ(scene.bounds().max, double3(1, 1, 0));
    const Renderable moved = scene.add(
            { .vertices = stage.square.vertices(), .indices = stage.square.indices(), .material = stage.white });
    scene.setTransform(moved, glm::translate(double4x4(1), double3(10, 0, 0)));
    EXPECT_EQ(scene.bounds(shape).max, double3(1, 1, 0)) << "of one alone";
    EXPECT_EQ(scene.bounds(moved).min, double3(9, -1, 0));
    scene.remove(moved);
    scene.setBounds(shape, { { 100, 0, 0 }, { 101, 1, 1 } });
    EXPECT_EQ(scene.bounds().min, double3(100, 0, 0));
    const View view = test::SquareMesh::view();
    (void)draw(scene, view);
    EXPECT_EQ(renderer.statistics().visible, 0u);
    scene.setBounds(shape, { { -1, -1, 0 }, { 1, 1, 0 } });
    (void)draw(scene, view);
    EXPECT_EQ(renderer.statistics().visible, 1u);
    scene.setGeometry(shape, { .vertices = stage.square.vertices(),
                               .indices = stage.square.indices(),
                               .bounds = Box{ double3(5), double3(6) } });
    EXPECT_EQ(scene.bounds().max, double3(6));
}

INSTANTIATE_TEST_SUITE_P(BothApis, ChangesTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

// ---- what does not fit

TEST(ChangesDeathTest, WhatDoesNotFitEndsTheProcessAndSaysWhy) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    const test::SquareMesh square(*engine);
    const Owned<Texture> texture = engine->own(engine->create({ .format = Format::RGBA8Srgb,
                                                                .width = 8,
                                                                .height = 4,
                                                                .levels = 1,
                                                                .generateMips = true,
                                                                .pixels = std::vector<std::byte>(8 * 4 * 4) }));
    const std::vector<std::byte> bytes(1024);
    const auto some = [&](size_t count) { return std::span(bytes).first(count); };
    EXPECT_DEATH(engine->update(square.vertices(), some(35)), "35 bytes, which is no whole number of vertices of 36");
    EXPECT_DEATH(engine->update(square.vertices(), some(0)), "0 bytes");
    EXPECT_DEATH(engine->update(square.vertices(), some(36 * 2), 3), "vertices 3 to 5 are changed, but there are 4");
    EXPECT_DEATH(engine->update(square.indices(), some(4), 5), "indices 5 to 7 are changed, but there are 6");
    EXPECT_DEATH(engine->update(texture, { .pixels = some(8), .level = 9 }), "levels 9 to 10 .* there are 4");
    EXPECT_DEATH(engine->update(texture, { .pixels = some(8), .firstLayer = 1 }), "layers 1 to 2 .* there are 1");
    EXPECT_DEATH(engine->update(texture, { .pixels = some(8), .offset = { 7, 0 }, .size = { 2, 1 } }),
                 "columns 7 to 9 .* there are 8");
    EXPECT_DEATH(engine->update(texture, { .pixels = some(8), .offset = { 0, 9 } }), "rows 9 to 9 .* there are 4");
    EXPECT_DEATH(engine->update(texture, { .pixels = some(8) }), "has 8 bytes, but the part that is changed has 128");
    EXPECT_DEATH(engine->update(texture, { .pixels = some(4), .size = { 1, 1 }, .generateMips = true }),
                 "computed from all of level 0");
}

// ---- numbers for parameters of other types

TEST(ParameterNumbers, AreTakenWhereTheParameterCanHoldThem) {
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    const Owned<Material> material = test::loadMaterial(*engine, R"(material { name : m, shadingModel : unlit,
        parameters : [ { type : float, name : f }, { type : int, name : i }, { type : uint, name : u },
                       { type : bool, name : b }, { type : float3, name : v } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor.rgb = materialParams.v * materialParams.f *
        float(materialParams.i) * float(materialParams.u) * (materialParams.b ? 1.0 : 0.0); } })");
    const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
    const auto expectTaken = [&](const char* name, auto value) {
        EXPECT_TRUE(engine->set(instance, name, value).ok());
    };
    const auto expectRefused = [&](const char* name, auto value, const char* message) {
        const Result<void> done = engine->set(instance, name, value);
        ASSERT_FALSE(done) << name;
        EXPECT_EQ(done.error().code, ErrorCode::InvalidArgument);
        EXPECT_EQ(done.error().message, fmt::format("parameter '{}' of material 'm' is {}", name, message));
    };
    expectTaken("f", 0.1), expectTaken("f", 3), expectTaken("f", 3u), expectTaken("f", uint8_t{ 3 });
    expectTaken("f", 1 << 24), expectTaken("f", int64_t{ 1 } << 40), expectTaken("f", HUGE_VAL), expectTaken("f", 'a');
    expectRefused("f", (1 << 24) + 1, "float, which cannot hold 16777217");
    expectRefused("f", INT64_MAX, "float, which cannot hold 9223372036854775807");
    expectRefused("f", UINT64_MAX, "float, which cannot hold 18446744073709551615");
    expectRefused("f", 1e39, "float, which cannot hold 1e+39");
    expectRefused("f", true, "float, but was given bool");
    expectTaken("i", -3), expectTaken("i", size_t{ 3 }), expectTaken("i", short{ -1 });
    expectRefused("i", INT64_MAX, "int, which cannot hold 9223372036854775807");
    expectRefused("i", 1.0, "int, but was given double");
    expectRefused("i", 1.0f, "int, but was given float");
    expectTaken("u", 3), expectTaken("u", UINT32_MAX);
    expectRefused("u", -1, "uint, which cannot hold -1");
    expectRefused("v", 1, "float3, but was given int");
    expectRefused("b", 1, "bool, but was given int");
    expectTaken("b", true), expectTaken("v", float3(1));
}

} // namespace
} // namespace filament_core
