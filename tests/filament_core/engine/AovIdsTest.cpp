// SPDX-License-Identifier: Apache-2.0
// Ids of objects, materials and triangles as AOVs, on both APIs, beside what the scene was made of and beside picks.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/RenderAovs.h>

#include <array>
#include <cmath>
#include <set>

namespace filament_core {
namespace {

constexpr uint32_t kIdSide = 32;
constexpr std::array kIdAovs{ Aov::ObjectId, Aov::MaterialId, Aov::MaterialInstanceId, Aov::TriangleId };

const std::string kPaint = test::text("shadingModel : unlit", "material.baseColor = vec4(0.5);");
const std::string kPane =
        test::text("shadingModel : unlit, blending : transparent", "material.baseColor = vec4(0.25);");
/// The left half is cut out.
const std::string kCut = test::text("shadingModel : unlit, blending : masked, requires : [ uv0 ]",
                                    "material.baseColor = vec4(getUV0().x < 0.5 ? 0.0 : 1.0);");

float4 idAt(Image const& image, uint32_t x, uint32_t y) {
    float4 pixel;
    std::memcpy(&pixel, image.pixels.data() + (size_t{ y } * image.width + x) * sizeof(pixel), sizeof(pixel));
    return pixel;
}

/// Squares before a camera that looks along -z from the origin and sees 2 m at a distance of 1 m.
class IdStage {
public:
    struct Square {
        Renderable renderable{};
        Material material{};
        MaterialInstance instance{};
        double3 at{ 0 };
        double half = 0;
        bool isCut = false;
    };

    explicit IdStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), renderer(engine), mesh(engine) {
        view.camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }, { .verticalFovDegrees = 90 });
        view.size = uint2(kIdSide);
    }
    ~IdStage() { test::expectNoErrors(engine); }

    Material material(std::string const& text) {
        materials.push_back(test::loadMaterial(engine, text, {}, test::kNoLights));
        return materials.back();
    }
    MaterialInstance instance(Material of) {
        instances.push_back(engine.own(engine.createInstance(of)));
        return instances.back();
    }
    Square const& add(Material of, MaterialInstance with, double3 at, double half, bool isCut = false) {
        squares.push_back({ mesh.add(scene, with, at, half), of, with, at, half, isCut });
        return squares.back();
    }
    std::vector<Image> draw(std::span<const Aov> aovs = kIdAovs) {
        Result<std::vector<Image>> images = renderAovs(renderer, scene, view, aovs);
        if (images) return std::move(*images);
        ADD_FAILURE() << images.error().message;
        return {};
    }

    /// The nearest at the centre of a pixel, and where in it; null: none.
    Square const* nearestAt(uint32_t x, uint32_t y, double2& inside) const {
        const double2 ray((x + 0.5) / kIdSide * 2 - 1, 1 - (y + 0.5) / kIdSide * 2);
        Square const* nearest = nullptr;
        for (Square const& square : squares) {
            const double2 local = (ray * -square.at.z - double2(square.at)) / square.half;
            const bool isHit = std::max(std::abs(local.x), std::abs(local.y)) < 1 && !(square.isCut && local.x < 0);
            if (!isHit || (nearest && nearest->at.z >= square.at.z)) continue;
            nearest = &square;
            inside = local;
        }
        return nearest;
    }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;
    test::SquareMesh mesh;
    std::vector<Square> squares;
    std::vector<Owned<Material>> materials;
    std::vector<Owned<MaterialInstance>> instances;
};

/// Opaque ones of one instance, which share a draw; one with a hole, a transparent one before others, and one behind.
void addAllKinds(IdStage& stage) {
    const Material paint = stage.material(kPaint), cut = stage.material(kCut), pane = stage.material(kPane);
    const MaterialInstance red = stage.instance(paint), blue = stage.instance(paint);
    const MaterialInstance mask = stage.instance(cut), glass = stage.instance(pane);
    stage.add(paint, red, { -0.51, 0.41, -1 }, 0.33);
    stage.add(paint, blue, { 0.03, 0.07, -3 }, 2.61);
    stage.add(paint, red, { 0.47, 0.43, -1.1 }, 0.29);
    stage.add(cut, mask, { -0.37, -0.42, -0.9 }, 0.36, true);
    stage.add(pane, glass, { 0.32, -0.22, -0.8 }, 0.31);
    stage.add(paint, red, { 0.37, -0.31, -1.2 }, 0.27);
}

void expectIds(IdStage& stage, std::vector<Image> const& images) {
    std::set<Renderable> seen;
    for (uint32_t y = 0; y < kIdSide; ++y) {
        for (uint32_t x = 0; x < kIdSide; ++x) {
            double2 inside(0);
            IdStage::Square const* const square = stage.nearestAt(x, y, inside);
            for (Image const& image : images) ASSERT_EQ(idAt(image, x, y).w, square ? 1 : 0) << x << ' ' << y;
            if (!square) continue;
            seen.insert(square->renderable);
            const auto idOf = [&](size_t i) { return static_cast<uint32_t>(idAt(images[i], x, y).x); };
            ASSERT_EQ(idAt(images[0], x, y).x, static_cast<float>(square->renderable.index() + 1)) << x << ' ' << y;
            ASSERT_EQ(objectOf(stage.scene, idOf(0)).renderable, square->renderable);
            ASSERT_EQ(materialOf(stage.scene, idOf(1)), square->material) << x << ' ' << y;
            ASSERT_EQ(materialInstanceOf(stage.scene, idOf(2)), square->instance) << x << ' ' << y;
            ASSERT_EQ(idOf(3), inside.y > inside.x ? 1u : 0u) << x << ' ' << y;
        }
    }
    EXPECT_GT(seen.size(), 3u);
}

TEST(AovIds, AreThoseOfTheSurfaceAtThePixelsCenter) {
    test::sameOnBothApis<IdStage>([&](IdStage& stage) {
        addAllKinds(stage);
        std::vector<Image> images = stage.draw();
        expectIds(stage, images);
        return images;
    });
}

// A pick draws each object by itself.
TEST(AovIds, OfObjectsAreWhatPicksHit) {
    test::sameOnBothApis<IdStage>([&](IdStage& stage) {
        addAllKinds(stage);
        const Node parent = stage.scene.add(NodeDesc{});
        const RenderableDesc desc{ .vertices = stage.mesh.vertices(),
                                   .indices = stage.mesh.indices(),
                                   .material = stage.squares[0].instance,
                                   .bounds = Box{ double3(-1, -1, -0.01f), double3(1, 1, 0.01f) },
                                   .node = parent };
        std::array<double4x4, 5> places;
        for (size_t i = 0; i < places.size(); ++i) {
            places[i] = double4x4(0.04);
            places[i][3] = double4(-0.3 + 0.15 * static_cast<double>(i), 0.02, -0.5, 1);
        }
        stage.scene.addInstances(desc, places.size(), places);
        std::vector<Image> images = stage.draw();
        std::set<float> found;
        for (uint32_t at = 0; at < kIdSide; ++at) {
            const uint2 pixel(at, at % 2 ? kIdSide / 2 - 1 : at);
            const Result<PickHit> hit = stage.renderer.waitPick(stage.renderer.pick(stage.scene, stage.view, pixel));
            EXPECT_TRUE(hit);
            const float4 id = idAt(images[0], pixel.x, pixel.y);
            const PickHit object = objectOf(stage.scene, static_cast<uint32_t>(id.x));
            EXPECT_EQ(object.renderable, hit->renderable) << pixel.x << ' ' << pixel.y;
            EXPECT_EQ(object.node, hit->node);
            EXPECT_EQ(object.primitive, hit->primitive);
            found.insert(id.x);
        }
        EXPECT_GT(found.size(), 6u) << "the copies have numbers of their own";
        return images;
    });
}

TEST(AovIds, StayWithTheirObjectsWhenOthersComeAndGo) {
    test::sameOnBothApis<IdStage>([&](IdStage& stage) {
        addAllKinds(stage);
        const std::vector<Image> before = stage.draw();
        const IdStage::Square gone = stage.squares[1];
        stage.scene.remove(gone.renderable);
        stage.squares.erase(stage.squares.begin() + 1);
        EXPECT_FALSE(objectOf(stage.scene, gone.renderable.index() + 1));
        EXPECT_FALSE(objectOf(stage.scene, 0));
        EXPECT_FALSE(materialOf(stage.scene, 99));
        EXPECT_FALSE(materialInstanceOf(stage.scene, 0));
        std::vector<Image> images = stage.draw();
        expectIds(stage, images);
        return images;
    });
}

// A handle of what was destroyed and is still drawn would end the process that used it.
TEST(AovIds, DoNotNameWhatWasDestroyed) {
    IdStage stage(Backend::Vulkan);
    const MaterialInstance paint = stage.instance(stage.material(kPaint));
    stage.mesh.add(stage.scene, paint);
    EXPECT_EQ(materialInstanceOf(stage.scene, 1), paint);
    stage.instances.clear();
    EXPECT_FALSE(materialInstanceOf(stage.scene, 1));
}

// Half floats end at 2048, and so does the first part of the number of a triangle.
TEST(AovIds, AreExactWhereHalfFloatsAreNot) {
    constexpr uint32_t kBefore = 5000;
    test::sameOnBothApis<IdStage>([&](IdStage& stage) {
        const MaterialInstance paint = stage.instance(stage.material(kPaint));
        for (uint32_t i = 0; i < kBefore; ++i) stage.scene.setVisible(stage.mesh.add(stage.scene, paint), false);
        std::vector<uint16_t> indices(size_t{ 3 } * kBefore, 0); // triangles without an area
        constexpr std::array<uint16_t, 6> kTwo{ 0, 1, 2, 0, 2, 3 };
        indices.insert(indices.end(), kTwo.begin(), kTwo.end());
        const Owned<IndexBuffer> many = stage.engine.own(stage.engine.create(IndexBufferDesc{
                .indexCount = static_cast<uint32_t>(indices.size()), .data = std::as_bytes(std::span(indices)) }));
        double4x4 world(1);
        world[3] = double4(0, 0, -1, 1);
        stage.scene.add(
                { .vertices = stage.mesh.vertices(), .indices = many, .material = paint, .worldFromObject = world });
        std::vector<Image> images = stage.draw();
        EXPECT_EQ(idAt(images[0], 3, 5), float4(kBefore + 1, 0, 0, 1));
        EXPECT_EQ(idAt(images[3], 20, 29), float4(kBefore, 0, 0, 1));
        EXPECT_EQ(idAt(images[3], 3, 5), float4(kBefore + 1, 0, 0, 1));
        stage.view.debugView = DebugView::ObjectIds;
        images.push_back(*stage.renderer.renderToImage(stage.scene, stage.view));
        const Renderable next = stage.mesh.add(stage.scene, paint, { 0, 0, -0.9 });
        images.push_back(*stage.renderer.renderToImage(stage.scene, stage.view));
        EXPECT_NE(images[4].pixels, images[5].pixels) << next.index();
        return images;
    });
}

// Of points, and of copies that are far away.
TEST(AovIds, CountPointsAndDoNotDependOnThePlace) {
    test::sameOnBothApis<IdStage>([&](IdStage& stage) {
        const MaterialInstance paint = stage.instance(stage.material(kPaint));
        const std::array<float3, 3> places{ { { -0.53f, 0.53f, -1 }, { 0.28f, 0.03f, -1 }, { 0.03f, -0.28f, -1 } } };
        const Owned<VertexBuffer> vertices = stage.engine.own(stage.engine.create(
                VertexBufferDesc{ .vertexCount = 3,
                                  .stride = sizeof(float3),
                                  .attributes = { { Attribute::Position, VertexFormat::Float3, 0 } },
                                  .data = std::as_bytes(std::span(places)) }));
        constexpr std::array<uint16_t, 3> kIndices{ 0, 1, 2 };
        const Owned<IndexBuffer> indices = stage.engine.own(
                stage.engine.create(IndexBufferDesc{ .indexCount = 3, .data = std::as_bytes(std::span(kIndices)) }));
        RenderableDesc desc{ .vertices = vertices,
                             .indices = indices,
                             .material = paint,
                             .primitive = PrimitiveType::Points,
                             .bounds = Box{ double3(-1, -1, -1.1f), double3(1, 1, -0.9f) } };
        const Renderable here = stage.scene.add(desc);
        std::vector<Image> images = stage.draw();
        for (size_t i = 0; i < places.size(); ++i) {
            const auto x = static_cast<uint32_t>(16 + 16 * places[i].x),
                       y = static_cast<uint32_t>(16 - 16 * places[i].y);
            EXPECT_EQ(idAt(images[3], x, y), float4(static_cast<float>(i), 0, 0, 1)) << i;
        }
        stage.scene.remove(here);
        const double3 away(3e7, -2e7, 5e6);
        desc.worldFromObject[3] = double4(away, 1);
        stage.view.camera.worldFromView[3] += double4(away, 0);
        stage.scene.add(desc);
        const std::vector<Image> there = stage.draw();
        for (size_t i = 1; i < there.size(); ++i) EXPECT_EQ(there[i].pixels, images[i].pixels) << i;
        return images;
    });
}

} // namespace
} // namespace filament_core
