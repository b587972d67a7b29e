// SPDX-License-Identifier: Apache-2.0
// What renderables at rest take of the heap, through the public API.
#include "tests/faults/FailingAllocator.h"
#include "tests/faults/FaultStage.h"

#include <filament_core/Mesh.h>

namespace filament_core::test {
namespace {

constexpr int64_t kMostBytes = 300; // a renderable: transform, bounds, material, mesh, handle
constexpr uint32_t kStep = 7001, kMost = 5 * kStep;

struct Field {
    Field()
            : engine(*makeEngine({ .workers = 0, .validation = false })), scene(engine), renderer(engine),
              mesh(makePlane({}).value()), vertices(engine.own(engine.create(mesh.vertexBuffer()))),
              indices(engine.own(engine.create(mesh.indexBuffer()))),
              material(engine.own(*createBuiltInMaterial(engine, "lit"))),
              instance(engine.own(engine.createInstance(material))),
              frames(engine.own(engine.create(SwapChainDesc{ .size = view.size }))) {}

    void add() {
        double4x4 world(1.0);
        world[3] = double4(count % 200 * 3, count / 200 % 200 * 3, 0, 1);
        scene.add({ .vertices = vertices,
                    .indices = indices,
                    .material = instance,
                    .bounds = Box{ double3(-1), double3(1) },
                    .worldFromObject = world });
        ++count;
    }
    /// Until all of them rest.
    void draw() {
        for (int i = 0; i < 200; ++i) {
            renderer.render(scene, view, frames);
            engine.waitIdle();
        }
    }

    View view{ .camera = Camera::lookAt({ 300, 300, 40 }, { 300, 300, 0 }), .size = { 64, 64 } };
    Engine engine;
    Scene scene;
    Renderer renderer;
    Mesh mesh;
    Owned<VertexBuffer> vertices;
    Owned<IndexBuffer> indices;
    Owned<Material> material;
    Owned<MaterialInstance> instance;
    Owned<SwapChain> frames;
    uint32_t count = 0;
};

TEST(BytesOfRenderables, AreFewForAnyNumber) {
    Field field;
    field.draw();
    const int64_t before = liveBytes();
    while (field.count < kMost) {
        for (uint32_t i = 0; i < kStep; ++i) field.add();
        EXPECT_LT(liveBytes() - before, kMostBytes * field.count) << field.count << " were added";
        if (field.count % (2 * kStep) != 0) continue;
        field.draw();
        EXPECT_LT(liveBytes() - before, kMostBytes * field.count) << field.count << " rest";
    }
}

TEST(BytesOfRenderables, HaveAHistoryOnlyOfWhatMoves) {
    Field field;
    for (uint32_t i = 0; i < kMost; ++i) field.add();
    field.draw();
    const int64_t without = liveBytes();
    field.view.quality.antiAliasing = AntiAliasing::Taa;
    field.draw();
    // 72 B each if it had all of them; the rest of what this takes does not depend on the scene.
    EXPECT_LT(liveBytes() - without, 12 * static_cast<int64_t>(kMost));
}

} // namespace
} // namespace filament_core::test
