// SPDX-License-Identifier: Apache-2.0
// Picking against rays that the test casts itself, on both APIs: every pixel of small images of boxes and spheres;
// holes of masked materials, bones, glass, layers.
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <optional>

namespace filament_core {
namespace {

using prepare::Random;

constexpr uint2 kPickSize(24, 18);

constexpr const char* kPickPaint = R"(material { name : paint, shadingModel : unlit, culling : none }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = vec4(0.5); } })";
constexpr const char* kPickMasked =
        R"(material { name : holes, shadingModel : unlit, culling : none, blending : masked, requires : [ uv0 ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(1.0, 1.0, 1.0, getUV0().x < 0.5 ? 0.0 : 1.0);
} })";
constexpr const char* kPickGlass =
        R"(material { name : glass, shadingModel : unlit, culling : none, blending : transparent }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = vec4(0.1); } })";

struct Ray {
    double3 origin, direction; ///< one metre along the view for each of the direction
};

Ray rayOf(View const& view, uint2 pixel) {
    const double up = std::tan(glm::radians(static_cast<double>(view.camera.lens.verticalFovDegrees)) / 2);
    const double2 at = (double2(pixel) + 0.5) / double2(view.size) * 2.0 - 1.0;
    const double3 along(at.x * up * view.size.x / view.size.y, -at.y * up, -1);
    return { view.camera.position(), double3x3(view.camera.worldFromView) * along };
}

/// Metres along the view to a square of 2 x 2 around the origin of its space; none: it is missed. `edge`: how near the
/// ray passes to its outline, in its space.
struct Met {
    std::optional<double> distance;
    double edge = 1e9;
};
Met meetSquare(Ray const& ray, double4x4 const& world, double nearMeters) {
    const double4x4 inverse = glm::inverse(world);
    const double3 from(inverse * double4(ray.origin, 1)), along(inverse * double4(ray.direction, 0));
    if (along.z == 0) return {};
    const double t = -from.z / along.z;
    const double3 hit = from + along * t;
    const double outside = std::max(std::abs(hit.x), std::abs(hit.y)) - 1;
    if (t < nearMeters) return {};
    return { outside < 0 ? std::optional(t) : std::nullopt, std::abs(outside) };
}

struct PickStage {
    Engine engine;
    test::SquareMesh square{ engine };
    Scene scene{ engine };
    Renderer renderer{ engine };
    View view{ .camera = Camera::lookAt({ 0.2, 0.1, 5 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }),
               .size = kPickSize };
    Owned<Material> paintMaterial, maskedMaterial, glassMaterial;
    Owned<MaterialInstance> paint, masked, glass;

    explicit PickStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))) {
        const auto load = [&](const char* text, Owned<Material>& material) {
            material = test::loadMaterial(engine, text);
            return engine.own(engine.createInstance(material));
        };
        paint = load(kPickPaint, paintMaterial);
        masked = load(kPickMasked, maskedMaterial);
        glass = load(kPickGlass, glassMaterial);
    }
    ~PickStage() { test::expectNoErrors(engine); }

    PickHit pick(uint2 pixel) {
        const auto hit = renderer.waitPick(renderer.pick(scene, view, pixel));
        EXPECT_TRUE(hit) << (hit ? "" : hit.error().message);
        return hit ? *hit : PickHit{};
    }
};

struct PickTest : testing::TestWithParam<Backend>, PickStage {
    PickTest() : PickStage(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(BothApis, PickTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(PickTest, EveryPixelOfACrowdIsWhatARayMeets) {
    Random random(11);
    std::vector<std::pair<Renderable, double4x4>> squares;
    for (int i = 0; i < 40; ++i) {
        double4x4 world =
                glm::translate(double4x4(1), double3(random.within(-2, 2), random.within(-2, 2), random.within(-4, 3)));
        world = glm::rotate(world, random.within(0, 6),
                            glm::normalize(double3(random.within(-1, 1), 0.3, random.within(-1, 1))));
        world = glm::scale(world, double3(random.within(0.2, 0.9)));
        squares.emplace_back(square.add(scene, i % 5 == 4 ? glass : paint, world), world);
    }
    size_t hits = 0, misses = 0;
    for (uint32_t y = 0; y < kPickSize.y; ++y) {
        for (uint32_t x = 0; x < kPickSize.x; ++x) {
            const Ray ray = rayOf(view, { x, y });
            Renderable expected{};
            double nearest = 1e9, second = 1e9, edge = 1e9;
            for (auto const& [renderable, world] : squares) {
                const Met met = meetSquare(ray, world, 0.01);
                edge = std::min(edge, met.edge);
                if (!met.distance) continue;
                if (*met.distance < nearest)
                    second = nearest, nearest = *met.distance, expected = renderable;
                else
                    second = std::min(second, *met.distance);
            }
            if (edge < 2e-2 || (expected && second - nearest < 1e-4)) continue; // too near to call
            const PickHit hit = pick({ x, y });
            EXPECT_EQ(hit.renderable, expected) << x << " " << y;
            ++(expected ? hits : misses);
            if (!expected || !hit) continue;
            EXPECT_NEAR(hit.distanceMeters, nearest, 2e-5 * nearest) << x << " " << y;
            EXPECT_LT(glm::distance(hit.positionWorld, ray.origin + ray.direction * nearest), 1e-4 * nearest);
            EXPECT_FALSE(hit.node);
        }
    }
    EXPECT_GT(hits, 100u);
    EXPECT_GT(misses, 20u);
}

TEST_P(PickTest, PicksWhatThePictureShows) {
    // A colour for each square: the image identifies the square of each pixel, edges included.
    constexpr const char* kColored = R"(material { name : colored, shadingModel : unlit, culling : none,
        parameters : [ { type : float4, name : color } ] }
    fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = materialParams.color; } })";
    const Owned<Material> material = test::loadMaterial(engine, kColored);
    std::vector<Owned<MaterialInstance>> instances;
    std::vector<Renderable> renderables;
    Random random(21);
    for (int i = 0; i < 24; ++i) {
        instances.push_back(engine.own(engine.createInstance(material)));
        EXPECT_TRUE(engine.set(instances.back(), "color", float4(i + 1, 0, 0, 1)));
        double4x4 world =
                glm::translate(double4x4(1), double3(random.within(-2, 2), random.within(-2, 2), random.within(-3, 3)));
        world = glm::rotate(world, random.within(0, 6), double3(0.6, 0.8, 0));
        renderables.push_back(square.add(scene, instances.back(), glm::scale(world, double3(0.6))));
    }
    const Image picture = test::renderLinear(engine, scene, view);
    size_t shown = 0;
    for (uint32_t y = 0; y < kPickSize.y; ++y) {
        for (uint32_t x = 0; x < kPickSize.x; ++x) {
            const auto who = static_cast<size_t>(test::halfPixel(picture, x, y).x);
            const PickHit hit = pick({ x, y });
            EXPECT_EQ(hit.renderable, who == 0 ? Renderable{} : renderables[who - 1]) << x << " " << y;
            shown += who > 0;
        }
    }
    EXPECT_GT(shown, 100u);
}

TEST_P(PickTest, SeesThroughHolesAndLayersAndNamesNodesAndPrimitives) {
    square.add(scene, masked, { 0, 0, 1 }, 1.5); // its left half is a hole
    const Node node = scene.add(NodeDesc{ .parentFromNode = glm::scale(double4x4(1), double3(3)) });
    const auto attach = [&](MaterialInstance material, Layers layers) {
        return scene.add({ .vertices = square.vertices(),
                           .indices = square.indices(),
                           .material = material,
                           .bounds = Box{ double3(-1, -1, -0.01f), double3(1, 1, 0.01f) },
                           .node = node,
                           .layers = layers });
    };
    const Renderable wall = attach(paint, 1), hidden = attach(paint, 2);
    view.visibleLayers = 1;
    EXPECT_EQ(pick({ 8, 9 }).renderable, wall);
    EXPECT_EQ(pick({ 8, 9 }).node, node);
    EXPECT_EQ(pick({ 8, 9 }).primitive, 0u);
    EXPECT_NEAR(pick({ 8, 9 }).positionWorld.z, 0, 1e-4);
    EXPECT_NEAR(pick({ 16, 9 }).positionWorld.z, 1, 1e-4);
    view.visibleLayers = 2;
    EXPECT_EQ(pick({ 8, 9 }).renderable, hidden);
    EXPECT_EQ(pick({ 8, 9 }).primitive, 1u);
    view.visibleLayers = kAllLayers;
    EXPECT_EQ(pick({ 8, 9 }).renderable, hidden) << "of equal depths the one that is drawn last is seen";
}

TEST_P(PickTest, FollowsBonesAndLooksThroughNothingThatBlends) {
    struct Vertex {
        float3 position;
        std::array<uint8_t, 4> joints{};
        std::array<uint8_t, 4> weights{ 255, 0, 0, 0 };
    };
    const std::array<Vertex, 4> vertices{ Vertex{ { -1, -1, 0 } }, Vertex{ { 1, -1, 0 } }, Vertex{ { 1, 1, 0 } },
                                          Vertex{ { -1, 1, 0 } } };
    const Owned<VertexBuffer> skinned = engine.own(engine.create(VertexBufferDesc{
            .vertexCount = 4,
            .stride = sizeof(Vertex),
            .attributes = { { Attribute::Position, VertexFormat::Float3, offsetof(Vertex, position) },
                            { Attribute::Joints, VertexFormat::UByte4, offsetof(Vertex, joints) },
                            { Attribute::Weights, VertexFormat::UByte4N, offsetof(Vertex, weights) } },
            .data = std::as_bytes(std::span(vertices)) }));
    const Skin skin = scene.add(SkinDesc{ .boneCount = 1 });
    const Renderable renderable = scene.add({ .vertices = skinned,
                                              .indices = square.indices(),
                                              .material = paint,
                                              .bounds = Box{ double3(-1, -1, -0.01f), double3(1, 1, 0.01f) },
                                              .skin = skin });
    EXPECT_EQ(pick({ 12, 9 }).renderable, renderable);
    const float4x4 away = glm::translate(float4x4(1), float3(0, 0, -4)) * glm::scale(float4x4(1), float3(3));
    scene.setBones(skin, std::span(&away, 1));
    EXPECT_EQ(pick({ 12, 9 }).renderable, renderable);
    EXPECT_NEAR(pick({ 12, 9 }).positionWorld.z, -4, 1e-3);
    const Renderable pane = square.add(scene, glass, { 0, 0, 1 });
    EXPECT_EQ(pick({ 12, 9 }).renderable, pane);
    EXPECT_NEAR(pick({ 12, 9 }).positionWorld.z, 1, 1e-4);
}

TEST_P(PickTest, IsPolledAndAnswersEachTicketOnceInAnyOrder) {
    const Renderable left = square.add(scene, paint, { -1.2, 0, 0 }), right = square.add(scene, paint, { 1.2, 0, 0 });
    const PickTicket first = renderer.pick(scene, view, { 6, 9 }), second = renderer.pick(scene, view, { 18, 9 }),
                     none = renderer.pick(scene, view, { 0, 0 });
    scene.remove(left); // the state at the call
    ASSERT_TRUE(renderer.takePick(none));
    std::optional<PickHit> hit;
    while (!hit) {
        EXPECT_TRUE(renderer.renderToImage(scene, view)); // frames go on
        hit = renderer.takePick(second);
    }
    EXPECT_EQ(hit->renderable, right);
    const auto other = renderer.waitPick(first);
    ASSERT_TRUE(other);
    EXPECT_EQ(other->renderable, left);
    EXPECT_FALSE(renderer.takePick({})->renderable);
}

TEST_P(PickTest, IsExactFarFromTheOriginAndWithOrdinaryDepth) {
    const double3 far(1e7, -2e7, 3e6);
    view.camera = Camera::lookAt(far + double3(0, 0, 5), far, { .verticalFovDegrees = 50 });
    square.add(scene, paint, far);
    for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
        view.quality.depthRange = range;
        const PickHit hit = pick({ 12, 9 });
        ASSERT_TRUE(hit);
        const Ray ray = rayOf(view, { 12, 9 });
        EXPECT_NEAR(hit.distanceMeters, 5, 1e-4);
        EXPECT_LT(glm::distance(hit.positionWorld, ray.origin + ray.direction * 5.0), 1e-3);
    }
}

TEST_P(PickTest, FramesDrawTheSamePictureWhetherSomebodyPicksOrNot) {
    for (int i = 0; i < 8; ++i) square.add(scene, i % 2 ? glass : paint, { 0.3 * i - 1, 0.1 * i, 0.2 * i }, 0.7);
    const Image before = test::renderLinear(engine, scene, view);
    for (uint32_t x = 0; x < kPickSize.x; x += 5) pick({ x, 9 });
    EXPECT_EQ(test::renderLinear(engine, scene, view).pixels, before.pixels);
}

TEST(PickDeathTest, APixelLiesInTheView) {
    GTEST_FLAG_SET(death_test_style, "threadsafe"); // an engine has threads
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    Scene scene(*engine);
    Renderer renderer(*engine);
    const View view{ .size = { 8, 6 } };
    EXPECT_DEATH((void)renderer.pick(scene, view, { 8, 0 }), "a picked pixel lies in the view");
    EXPECT_DEATH((void)renderer.pick(scene, view, { 0, 6 }), "a picked pixel lies in the view");
    const PickTicket ticket = renderer.pick(scene, view, { 7, 5 });
    EXPECT_TRUE(renderer.takePick(ticket));
    EXPECT_DEATH((void)renderer.takePick(ticket), "a pick is taken once");
}

} // namespace
} // namespace filament_core
