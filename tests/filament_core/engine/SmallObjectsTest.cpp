// SPDX-License-Identifier: Apache-2.0
// Objects that cover no centre of a pixel are culled, and the image does not change by a bit: compared with the same
// objects that may not be left out.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/Primitives.h>

#include <glm/ext/matrix_transform.hpp>

#include <cmath>

namespace filament_core {
namespace {

using prepare::Random;

class SmallObjectsTest : public testing::TestWithParam<Backend> {
protected:
    SmallObjectsTest()
            : engine(*test::makeEngine(GetParam())), material(engine.own(*createBuiltInMaterial(engine, "lit"))),
              instance(engine.own(engine.createInstance(material))) {
        for (Result<Mesh> const& mesh : { makeBox(), makeCone(), makeTorus() }) {
            vertices.push_back(engine.own(engine.create(mesh->vertexBuffer())));
            indices.push_back(engine.own(engine.create(mesh->indexBuffer())));
        }
    }

    /// Sizes from a hundredth of a pixel to some pixels.
    void fill(Scene& scene, bool isCulled, uint32_t seed) {
        Random random(seed);
        for (int i = 0; i < 3000; ++i) {
            const double distance = random.within(2, 60);
            double4x4 world = glm::translate(
                    double4x4(1), double3(random.within(-0.5, 0.5), random.within(-0.4, 0.4), -1) * distance);
            world = glm::rotate(world, random.within(0, 6), double3(0.3, 0.8, 0.52));
            world = glm::scale(world, double3(distance * std::exp(random.within(-10, -4))));
            const size_t mesh = random.next() % 3;
            scene.add({ .vertices = vertices[mesh],
                        .indices = indices[mesh],
                        .material = instance,
                        .worldFromObject = world,
                        .culled = isCulled });
        }
        scene.add(SunLight{ .directionWorld = { -1, -1, -1 } });
    }

    Engine engine;
    Owned<Material> material;
    Owned<MaterialInstance> instance;
    std::vector<Owned<VertexBuffer>> vertices;
    std::vector<Owned<IndexBuffer>> indices;
};

TEST_P(SmallObjectsTest, LeavingThemOutChangesNoBit) {
    for (uint32_t seed = 1; seed <= 6; ++seed) {
        Scene some(engine), all(engine);
        fill(some, true, seed);
        fill(all, false, seed);
        Renderer someRenderer(engine), allRenderer(engine);
        View view{ .size = { 160, 120 } };
        view.quality.shadows = ShadowFilter::Off;
        if (seed % 3 == 0) view.camera.lens = Lens::orthographic(-12, 12, -9, 9, 0, 100);
        const Image drawn = test::renderLinear(engine, someRenderer, some, view);
        EXPECT_EQ(test::differingPixels(drawn, test::renderLinear(engine, allRenderer, all, view)), 0u) << seed;
        EXPECT_GT(allRenderer.statistics().visible, someRenderer.statistics().visible + 500) << seed;
        EXPECT_GT(someRenderer.statistics().visible, 300u) << seed;
    }
}

TEST_P(SmallObjectsTest, TheyAreCountedAndExplained) {
    Scene scene(engine);
    fill(scene, true, 11);
    Renderer renderer(engine);
    test::renderLinear(engine, renderer, scene, { .size = { 160, 120 } });
    EXPECT_NE(renderer.explain().find("not drawn: they cover no centre of a pixel"), std::string::npos)
            << renderer.explain();
}

INSTANTIATE_TEST_SUITE_P(BothApis, SmallObjectsTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
