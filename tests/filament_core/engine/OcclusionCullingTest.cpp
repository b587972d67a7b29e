// SPDX-License-Identifier: Apache-2.0
// Objects behind occluders are not drawn, and the image does not change by a bit: random walls and things, on both
// APIs.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/Primitives.h>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace filament_core {
namespace {

using prepare::Random;

class OcclusionCullingTest : public testing::TestWithParam<Backend> {
protected:
    OcclusionCullingTest()
            : engine(*test::makeEngine(GetParam())), material(engine.own(*createBuiltInMaterial(engine, "lit"))) {
        for (Result<Mesh> const& mesh : { makeBox(), makeCone(), makeTorus() }) {
            vertices.push_back(engine.own(engine.create(mesh->vertexBuffer())));
            indices.push_back(engine.own(engine.create(mesh->indexBuffer())));
            occluders.push_back(mesh->occluder());
        }
        for (const float3 color : { float3(0.8f, 0.3f, 0.2f), float3(0.2f, 0.7f, 0.3f), float3(0.3f, 0.4f, 0.9f) }) {
            instances.push_back(engine.own(engine.createInstance(material)));
            EXPECT_TRUE(engine.set(instances.back(), "baseColor", color));
        }
    }

    void add(Scene& scene, size_t mesh, double4x4 const& world, size_t color) {
        scene.add({ .vertices = vertices[mesh],
                    .indices = indices[mesh],
                    .material = instances[color % 3],
                    .occluder = occluders[mesh],
                    .worldFromObject = world });
    }

    /// Walls across the view, turned and mirrored, and things of all sizes before, in and behind them.
    void fill(Scene& scene, uint32_t seed) {
        Random random(seed);
        const auto placed = [&](double nearest, double farthest, double3 scale) {
            const double distance = random.within(nearest, farthest);
            double4x4 world = glm::translate(
                    double4x4(1), double3(random.within(-0.8, 0.8), random.within(-0.5, 0.5), -1) * distance);
            world = glm::rotate(world, random.within(-0.8, 0.8), double3(0.3, 0.8, 0.52));
            return glm::scale(world, scale * (random.next() % 5 ? double3(1) : double3(-1, 1, 1)));
        };
        for (int i = 0; i < 25; ++i)
            add(scene, 0, placed(2, 12, { random.within(1, 6), random.within(1, 4), 0.1 }), random.next());
        for (int i = 0; i < 400; ++i)
            add(scene, random.next() % 3, placed(1, 60, double3(std::exp(random.within(-3, 0.5)))), random.next());
        add(scene, 0, glm::scale(glm::translate(double4x4(1), { 0, -1.5, 0 }), { 200, 0.1, 200 }),
            1); // under the camera
        scene.add(SunLight{ .directionWorld = { -1, -1, -1 } });
    }

    Engine engine;
    Owned<Material> material;
    std::vector<Owned<MaterialInstance>> instances;
    std::vector<Owned<VertexBuffer>> vertices;
    std::vector<Owned<IndexBuffer>> indices;
    std::vector<Occluder> occluders;
};

TEST_P(OcclusionCullingTest, LeavingHiddenObjectsOutChangesNoBit) {
    uint32_t hidden = 0;
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        Scene scene(engine);
        fill(scene, seed);
        View view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0.1, 0, -1 }, { .verticalFovDegrees = 50.0f + float(seed) }),
                   .size = { 301 + seed, 173 } };
        view.effects.ambientOcclusion.enabled = seed % 2 == 0;
        view.effects.guardBand.enabled = seed % 3 == 0;
        view.quality.antiAliasing = seed % 4 == 0 ? AntiAliasing::Taa : AntiAliasing::Fxaa;
        std::array<Image, 2> images;
        uint32_t drawn[2]{};
        for (const bool culls : { false, true }) {
            view.occlusionCulling = culls;
            Renderer renderer(engine);
            images[culls] = *renderer.renderToImage(scene, view);
            drawn[culls] = renderer.statistics().visible;
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels) << seed;
        hidden += drawn[0] - drawn[1];
    }
    EXPECT_GT(hidden, 800) << "of 5100";
}

TEST_P(OcclusionCullingTest, LeavingHiddenCastersOutOfShadowMapsChangesNoBit) {
    uint32_t drawn[2]{};
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        Scene scene(engine);
        fill(scene, seed);
        Random random(seed);
        // Beside and above the camera, and one that looks along the walls.
        scene.add(PointLight{ .positionWorld = { random.within(-2, 2), 1, random.within(-4, -1) },
                              .intensity = { 4e4f } });
        scene.add(SpotLight{ .positionWorld = { -3, random.within(0, 4), -1 },
                             .directionWorld = { 0.5f, -0.3f, -1 },
                             .intensity = { 3e4f },
                             .outerConeRadians = 0.5f + 0.05f * float(seed) });
        View view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0.1, 0, -1 }), .size = { 320, 200 } };
        view.quality.shadowMapSize = 256u << seed % 3;
        view.quality.shadowCascades = 1 + seed % 4;
        view.quality.shadows = seed % 4 == 0 ? ShadowFilter::Evsm : ShadowFilter::Hard;
        view.samples = seed % 5 == 0 ? 4 : 1; // which says nothing of the samples of maps
        for (Owned<MaterialInstance> const& instance : instances)
            engine.setShadowCulling(instance, seed % 3 == 0 ? Culling::Front : Culling::Back);
        std::array<Image, 2> images;
        for (const bool culls : { false, true }) {
            view.occlusionCulling = culls;
            Renderer renderer(engine);
            images[culls] = *renderer.renderToImage(scene, view);
            drawn[culls] += renderer.statistics().triangles;
            if (culls && seed == 1) {
                EXPECT_THAT(renderer.explain(), testing::ContainsRegex("shadow views besides.*\n.*behind others"));
            }
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels) << seed;
    }
    EXPECT_LT(drawn[1], drawn[0] * 0.7) << "triangles";
}

TEST_P(OcclusionCullingTest, IsExplainedAndOffWhereItIsNotExact) {
    Scene scene(engine);
    fill(scene, 1);
    const View view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0.1, 0, -1 }), .size = { 301, 173 } };
    const auto explained = [&](auto const& change) {
        View changed = view;
        changed.quality.shadows = ShadowFilter::Off; // whose maps leave hidden casters out with any camera
        change(changed);
        Renderer renderer(engine);
        EXPECT_TRUE(renderer.renderToImage(scene, changed));
        return renderer.explain();
    };
    EXPECT_THAT(explained([](View&) {}), testing::HasSubstr("not drawn: they are behind others"));
    for (const std::string& text :
         { explained([](View& changed) { changed.occlusionCulling = false; }),
           explained([](View& changed) { changed.samples = 4; }),
           explained([](View& changed) { changed.quality.cameraRelative = false; }),
           explained([](View& changed) { changed.quality.depthRange = DepthRange::Ordinary; }),
           explained([](View& changed) { changed.debugView = DebugView::Overdraw; }) })
        EXPECT_THAT(text, testing::Not(testing::HasSubstr("behind others")));
}

TEST_P(OcclusionCullingTest, MaterialsThatDoNotFillTheirTrianglesHideNothing) {
    Scene scene(engine);
    fill(scene, 1);
    const View view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0.1, 0, -1 }), .size = { 301, 173 } };
    Renderer renderer(engine);
    for (Owned<MaterialInstance> const& instance : instances) engine.setDepthWrite(instance, false);
    EXPECT_TRUE(renderer.renderToImage(scene, view));
    EXPECT_THAT(renderer.explain(), testing::Not(testing::HasSubstr("behind others")));
    for (Owned<MaterialInstance> const& instance : instances) engine.setDepthWrite(instance, true);
    EXPECT_TRUE(renderer.renderToImage(scene, view));
    EXPECT_THAT(renderer.explain(), testing::HasSubstr("behind others"));
}

INSTANTIATE_TEST_SUITE_P(BothApis, OcclusionCullingTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
