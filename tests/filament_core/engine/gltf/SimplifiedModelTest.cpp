// SPDX-License-Identifier: Apache-2.0
// Levels of detail that the loader makes: the same bits on both APIs, at rest and in motion; without a limit the image
// of the model as it is. Levels that programs give.
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/Primitives.h>

#include <gmock/gmock.h>

#include <cmath>

namespace filament_core {
namespace {

struct Simplified {
    const char* file;
    float pixels; ///< enough for a coarser level
    double seconds;
};

class SimplifiedModel : public test::AssetTest, public testing::WithParamInterface<Simplified> {
protected:
    struct Drawn {
        std::vector<Image> images;
        std::string explained;
    };

    /// A row of copies, at rest and in motion, under shadows.
    static Drawn draw(Backend backend, bool simplified, float pixels, bool isSmoothed = false) {
        Drawn drawn;
        auto engine = test::makeEngine(backend);
        if (!engine) return drawn;
        {
            const Result<Model> model =
                    loadGltf(*engine, tools::assetDir() / "models" / GetParam().file, { .simplified = simplified });
            if (!model) {
                ADD_FAILURE() << model.error().message;
                return drawn;
            }
            Scene scene(*engine);
            std::vector<Node> copies;
            for (int i = 0; i < 3; ++i) {
                double4x4 world = fitToUnitCube(model->bounds());
                world[3] += double4(i - 1, 0, -1.5 * i, 0);
                copies.push_back(scene.add(*model, world));
            }
            scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 60'000 } });
            View view{ .camera = Camera::lookAt({ 0.9, 0.6, 2.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }),
                       .size = { 160, 120 } };
            view.lod.pixels = pixels;
            if (isSmoothed) view.quality.antiAliasing = AntiAliasing::Taa;
            Renderer renderer(*engine);
            for (const double seconds : { 0.0, GetParam().seconds }) {
                for (const Node copy : copies)
                    if (model->animationCount() > 0) Animator(*model, scene, copy).apply(0, seconds);
                Result<Image> image = renderer.renderToImage(scene, view);
                EXPECT_TRUE(image.ok());
                if (image) drawn.images.push_back(std::move(*image));
            }
            drawn.explained = renderer.explain();
        }
        test::expectNoErrors(*engine);
        return drawn;
    }

    static void expectEqual(Drawn const& a, Drawn const& b) {
        ASSERT_EQ(a.images.size(), b.images.size());
        for (size_t i = 0; i < a.images.size(); ++i) EXPECT_EQ(a.images[i].pixels, b.images[i].pixels) << i;
    }
};

TEST_P(SimplifiedModel, HasTheSameBitsOnBothApis) {
    for (const bool isSmoothed : { false, true }) {
        const Drawn one = draw(Backend::Vulkan, true, GetParam().pixels, isSmoothed);
        expectEqual(one, draw(Backend::Gles, true, GetParam().pixels, isSmoothed));
        EXPECT_THAT(one.explained, testing::HasSubstr("triangles saved by levels of detail"));
    }
}

TEST_P(SimplifiedModel, WithoutALimitIsTheModel) {
    const Drawn simplified = draw(Backend::Vulkan, true, 0);
    expectEqual(simplified, draw(Backend::Vulkan, false, 0));
    expectEqual(simplified, draw(Backend::Vulkan, false, GetParam().pixels)); // which has no levels
    EXPECT_THAT(simplified.explained, testing::Not(testing::HasSubstr("levels of detail")));
}

INSTANTIATE_TEST_SUITE_P(Models, SimplifiedModel,
                         testing::Values(Simplified{ "FlightHelmet/FlightHelmet.gltf", 4, 0 },
                                         Simplified{ "MorphStressTest/MorphStressTest.glb", 64, 1.7 }),
                         [](auto const& test) {
                             const std::string file = test.param.file;
                             return file.substr(0, file.find('/'));
                         });

TEST(LevelsOfRenderablesDeathTest, LieInTheirIndexBufferAndGrowCoarser) {
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    const Owned<Material> material = engine->own(*createBuiltInMaterial(*engine, "lit"));
    const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
    const Mesh mesh = *makeBox(); // 36 indices
    const Owned<VertexBuffer> vertices = engine->own(engine->create(mesh.vertexBuffer()));
    const Owned<IndexBuffer> indices = engine->own(engine->create(mesh.indexBuffer()));
    Scene scene(*engine);
    const auto add = [&](std::vector<GeometryLevel> const& levels) {
        return scene.add({ .vertices = vertices, .indices = indices, .material = instance, .levels = levels });
    };
    EXPECT_DEATH(add({ { 0, 18, 0.1f }, { 18, 21, 0.2f } }), "indices of a level of detail lie inside");
    EXPECT_DEATH(add({ { 0, 0, 0.1f } }), "indices of a level of detail lie inside");
    EXPECT_DEATH(add({ { 0, 18, 0.2f }, { 18, 9, 0.1f } }), "errors of levels of detail are finite");
    EXPECT_DEATH(add({ { 0, 18, std::nanf("") } }), "errors of levels of detail are finite");
    EXPECT_TRUE(add({ { 0, 18, 0.1f }, { 18, 9, 0.1f } }));
}

} // namespace
} // namespace filament_core
