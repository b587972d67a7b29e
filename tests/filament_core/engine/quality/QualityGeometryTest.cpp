// SPDX-License-Identifier: Apache-2.0
// glTF files with vertices in fewer bits: the same model, almost the same image.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/scenes/Sphere.h"

#include "filament_core/assets/gltf/GltfWriter.h"
#include "toolkit/paths/Paths.h"

#include <fstream>

namespace filament_core {
namespace {

/// A sphere of radius 1 around (3, 0, 0), at a node that mirrors and stretches it.
std::filesystem::path sphereFile() {
    const scenes::SphereMesh sphere = scenes::makeSphere(16, 32);
    assets::GlbPrimitive primitive;
    for (scenes::SphereVertex const& vertex : sphere.vertices) {
        primitive.positions.push_back(vertex.position + float3(3, 0, 0));
        primitive.normals.push_back(vertex.position);
    }
    primitive.indices.assign(sphere.indices.begin(), sphere.indices.end());
    double4x4 node(1.0);
    node[0][0] = -1, node[1][1] = 1.5;
    assets::GlbScene scene;
    scene.meshes = { { "sphere", { std::move(primitive) } } };
    scene.nodes = { { .name = "stretched", .parentFromNode = node, .mesh = 0 } };
    const auto bytes = assets::writeGlb(scene);
    EXPECT_TRUE(bytes.ok());
    const std::filesystem::path path = test::folderOfThisTest() / "sphere.glb";
    std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
    return path;
}

Image drawn(Engine& engine, GltfLoadOptions const& options, Box& bounds) {
    auto model = loadGltf(engine, sphereFile(), options);
    if (!model) {
        ADD_FAILURE() << model.error().message;
        return {};
    }
    bounds = model->bounds();
    Scene scene(engine);
    scene.add(*model);
    scene.add(SunLight{ .directionWorld = { 0.4f, -1, -0.6f } });
    View view{ .camera = Camera::lookAt({ -3, 0, 6 }, { -3, 0, 0 }, { .verticalFovDegrees = 40 }), .size = { 64, 64 } };
    Renderer renderer(engine);
    auto image = renderer.renderToImage(scene, view);
    EXPECT_TRUE(image.ok());
    test::expectNoErrors(engine);
    return image ? std::move(*image) : Image{};
}

/// Pixels that differ by more than two steps of 8 bits.
size_t apart(Image const& a, Image const& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        count += std::abs(static_cast<int>(a.pixels[i]) - static_cast<int>(b.pixels[i])) > 2;
    return count;
}

class QualityGeometryTest : public testing::TestWithParam<Backend> {};

TEST_P(QualityGeometryTest, EveryStorageOfVerticesDrawsNearlyTheSamePictureWithinTheSameBounds) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Box bounds, other;
    const Image authored = drawn(*engine, {}, bounds);
    EXPECT_NEAR(bounds.min.x, -4, 1e-6);
    EXPECT_NEAR(bounds.max.y, 1.5, 1e-6);
    for (const PositionStorage positions : { PositionStorage::Half, PositionStorage::Unorm16 }) {
        const Image image = drawn(*engine, { .positions = positions }, other);
        EXPECT_LT(apart(authored, image), authored.pixels.size() / 50) << toString(positions);
        EXPECT_NEAR(other.min.x, bounds.min.x, 1e-5);
        EXPECT_NEAR(other.max.y, bounds.max.y, 1e-5);
    }
    for (const TangentStorage tangents : { TangentStorage::Snorm8, TangentStorage::Float }) {
        const Image image = drawn(*engine, { .tangents = tangents }, other);
        EXPECT_EQ(image.pixels == authored.pixels, false) << toString(tangents);
        EXPECT_LT(apart(authored, image), authored.pixels.size() / 10) << toString(tangents);
    }
}

INSTANTIATE_TEST_SUITE_P(BothApis, QualityGeometryTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST(QualityGeometryBits, EveryStorageOfVerticesDrawsTheSameBitsOnBothApis) {
    auto vulkan = test::makeEngine(Backend::Vulkan), gles = test::makeEngine(Backend::Gles);
    ASSERT_TRUE(vulkan && gles);
    Box bounds;
    for (const PositionStorage positions :
         { PositionStorage::AsAuthored, PositionStorage::Half, PositionStorage::Unorm16 }) {
        for (const TangentStorage tangents :
             { TangentStorage::Snorm16, TangentStorage::Snorm8, TangentStorage::Float }) {
            const GltfLoadOptions options{ .positions = positions, .tangents = tangents };
            EXPECT_EQ(drawn(*vulkan, options, bounds).pixels, drawn(*gles, options, bounds).pixels)
                    << toString(positions) << ' ' << toString(tangents);
        }
    }
}

} // namespace
} // namespace filament_core
