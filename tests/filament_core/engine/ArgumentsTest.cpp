// SPDX-License-Identifier: Apache-2.0
// Numbers that no description may have end the process with the rule that they break; larger ones do not wrap to
// smaller ones that it may have.
#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace filament_core {
namespace {

class ArgumentsDeathTest : public testing::Test {
protected:
    Engine engine = std::move(*Engine::create({ .backend = Backend::Null, .workers = 0 }));

    VertexBuffer vertices(uint32_t stride, uint32_t offset) {
        const std::vector<std::byte> data(stride);
        return engine.create(VertexBufferDesc{ .vertexCount = 1,
                                               .stride = stride,
                                               .attributes = { { Attribute::Position, VertexFormat::Float3, offset } },
                                               .data = data });
    }
};

TEST_F(ArgumentsDeathTest, VerticesLieInTheirStride) {
    engine.destroy(vertices(12, 0));
    engine.destroy(vertices(2048, 2036));
    EXPECT_DEATH(vertices(12, 1), "an attribute lies inside of the stride");
    EXPECT_DEATH(vertices(12, 0xFFFFFFFC), "an attribute lies inside of the stride");
    EXPECT_DEATH(vertices(8, 0), "an attribute lies inside of the stride");
    EXPECT_DEATH(vertices(65536 + 12, 0), "a stride is at most 2048 bytes");
}

TEST_F(ArgumentsDeathTest, TexturesHaveLayersThatDevicesMayHave) {
    EXPECT_DEATH(engine.create(TextureDesc{ .kind = TextureKind::Texture2DArray, .layers = 65537 }),
                 "a texture has at most 2048 layers");
}

TEST_F(ArgumentsDeathTest, ALightHasALevel) {
    const Owned<Texture> cube = engine.own(engine.create(TextureDesc{ .kind = TextureKind::Cube, .layers = 6 }));
    EXPECT_DEATH(engine.create(IndirectLightDesc{ .specular = cube, .specularLevels = 0 }),
                 "an indirect light has at least one specular level");
}

TEST_F(ArgumentsDeathTest, AViewHasAPixel) {
    Scene scene(engine);
    Renderer renderer(engine);
    const Owned<SwapChain> chain = engine.own(engine.create(SwapChainDesc{ .size = { 4, 4 } }));
    for (const uint2 size : { uint2(0, 0), uint2(0, 4), uint2(4, 0) })
        EXPECT_DEATH(renderer.render(scene, { .size = size, .viewport = Viewport{} }, chain),
                     "a view has at least one pixel");
}

} // namespace
} // namespace filament_core
