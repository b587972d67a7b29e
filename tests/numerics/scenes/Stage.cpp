// SPDX-License-Identifier: Apache-2.0
#include "tests/numerics/scenes/Stage.h"

#include "base/math/Half.h"
#include "shaders/package/EngineMaterials.h"
#include "tests/scenes/Sphere.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <span>

namespace filament_core::hard {
namespace {

Owned<Material> loadMaterial(Engine& engine, const char* package, std::vector<MaterialConstant> constants = {}) {
    auto material = engine.create(MaterialDesc{ shader::engineMaterial(package), std::move(constants), package });
    if (!material) {
        ADD_FAILURE() << material.error().message;
        return {};
    }
    return engine.own(*material);
}

// Tangent-space normals tilted up to 40 degrees in every direction: a wrong axis or sign of a frame is visible at once.
std::vector<uint8_t> waveTexels(uint32_t size) {
    std::vector<uint8_t> texels;
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            const auto wave = [size](uint32_t i) { return 0.45 * std::sin(6.28318530718 * (i + 0.5) / size); };
            const double3 n(wave(x), wave(y), 0.77);
            for (int c = 0; c < 3; ++c)
                texels.push_back(static_cast<uint8_t>(std::lround((n[c] / glm::length(n) * 0.5 + 0.5) * 255)));
            texels.push_back(255);
        }
    }
    return texels;
}

float largestOf(std::vector<Vertex> const& vertices) {
    float largest = 0;
    for (Vertex const& vertex : vertices) {
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(vertex.position[axis]));
    }
    return largest;
}

void setLook(Engine& engine, MaterialInstance instance, Look const& look) {
    EXPECT_TRUE(engine.set(instance, "baseColorFactor", look.baseColor));
    EXPECT_TRUE(engine.set(instance, "metallicFactor", look.metallic));
    EXPECT_TRUE(engine.set(instance, "roughnessFactor", look.roughness));
    EXPECT_TRUE(engine.set(instance, "emissiveFactor", look.emissive));
}

} // namespace

Mesh sphereMesh() {
    const scenes::SphereMesh sphere = scenes::makeSphere(32, 64);
    Mesh mesh;
    mesh.indices = sphere.indices;
    for (size_t i = 0; i < sphere.vertices.size(); ++i) {
        const float2 uv(static_cast<float>(i % 65) / 64, static_cast<float>(i / 65) / 32);
        mesh.vertices.push_back({ sphere.vertices[i].position, sphere.vertices[i].tangents, uv * 4.0f });
    }
    return mesh;
}

Mesh quadMesh() {
    Mesh mesh;
    for (float2 corner : { float2(-1, -1), float2(1, -1), float2(1, 1), float2(-1, 1) })
        mesh.vertices.push_back({ .position = float3(corner, 0), .uv = corner });
    mesh.indices = { 0, 1, 2, 0, 2, 3 };
    return mesh;
}

Mesh transformed(Mesh mesh, float3 scale) {
    for (Vertex& vertex : mesh.vertices) vertex.position *= scale;
    return mesh;
}

double4x4 translation(double3 by) {
    double4x4 matrix(1.0);
    matrix[3] = double4(by, 1);
    return matrix;
}

double4x4 scaling(double3 by) {
    double4x4 matrix(1.0);
    for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = by[axis];
    return matrix;
}

Device::Device(Backend backend) : mCapture(std::make_shared<backend::FrameCapture>()) {
    auto engine =
            Engine::create({ .backend = backend, .workers = 1, .validation = true, .debug = { .capture = mCapture } });
    if (!engine) {
        ADD_FAILURE() << toString(backend) << ": " << engine.error().message;
        return;
    }
    mEngine.emplace(std::move(*engine));
    mOpaque = loadMaterial(*mEngine, "gltf_lit_opaque");
    mBlended = loadMaterial(*mEngine, "gltf_lit_blended");
    mBumpy = loadMaterial(*mEngine, "gltf_lit_opaque", { { "hasNormalMap", true } });
    constexpr uint32_t kSize = 32;
    const std::vector<uint8_t> texels = waveTexels(kSize);
    mWaves = mEngine->own(mEngine->create(TextureDesc{
            .width = kSize, .height = kSize, .pixels = std::as_bytes(std::span(texels)), .name = "waves" }));
}

Material Device::material(Look const& look) const { return look.bumpy ? mBumpy : look.blended ? mBlended : mOpaque; }

Stage::Stage(Device& device) : scene(device.engine()), mDevice(device) {
    view.size = { 64, 64 };
    view.clearColor = float4(0);
}

Renderable Stage::add(Mesh const& mesh, double4x4 const& worldFromObject, Look const& look, Node node) {
    Engine& engine = mDevice.engine();
    mVertices.push_back(engine.own(engine.create(
            VertexBufferDesc{ .vertexCount = static_cast<uint32_t>(mesh.vertices.size()),
                              .stride = sizeof(Vertex),
                              .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                              { Attribute::Tangents, VertexFormat::Float4, offsetof(Vertex, tangents) },
                                              { Attribute::Uv0, VertexFormat::Float2, offsetof(Vertex, uv) } },
                              .data = std::as_bytes(std::span(mesh.vertices)) })));
    mIndices.push_back(
            engine.own(engine.create(IndexBufferDesc{ .indexCount = static_cast<uint32_t>(mesh.indices.size()),
                                                      .data = std::as_bytes(std::span(mesh.indices)) })));
    mInstances.push_back(engine.own(engine.createInstance(mDevice.material(look))));
    setLook(engine, mInstances.back(), look);
    if (look.bumpy) {
        EXPECT_TRUE(engine.set(mInstances.back(), "normalScale", 1.0f));
        EXPECT_TRUE(engine.set(mInstances.back(), "normalMap", mDevice.waves(), kUnfilteredSampler));
    }
    const float extent = largestOf(mesh.vertices);
    return scene.add({ .vertices = mVertices.back(),
                       .indices = mIndices.back(),
                       .material = mInstances.back(),
                       .bounds = Box{ double3(-extent), double3(extent) },
                       .worldFromObject = worldFromObject,
                       .node = node });
}

void Stage::addFile(std::span<const std::byte> glb) {
    const std::filesystem::path folder = tools::buildDir() / "hard";
    const std::filesystem::path path = folder / "case.glb";
    std::filesystem::create_directories(folder);
    std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
    auto model = loadGltf(engine(), path);
    ASSERT_TRUE(model.ok()) << model.error().message;
    scene.add(*model);
    mModels.push_back(std::move(*model));
}

Texture Stage::constantCube(float radiance) {
    constexpr uint32_t kTexels = 6 * (16 + 4 + 1);
    const std::vector<uint16_t> texels(kTexels * 4, halfFromFloat(radiance));
    mTextures.push_back(engine().own(engine().create(TextureDesc{ .kind = TextureKind::Cube,
                                                                  .format = Format::RGBA16F,
                                                                  .width = 4,
                                                                  .height = 4,
                                                                  .layers = 6,
                                                                  .levels = 3,
                                                                  .pixels = std::as_bytes(std::span(texels)),
                                                                  .name = "constant sky" })));
    return mTextures.back();
}

void Stage::addConstantSky(Lux illuminance, float radiance, bool visible) {
    IndirectLightDesc light{ .specular = constantCube(radiance), .specularLevels = 3, .name = "constant sky" };
    light.irradianceSh[0] = float4(radiance);
    mLights.push_back(engine().own(engine().create(light)));
    scene.setIndirectLight(mLights.back(), illuminance);
    if (!visible) return;
    mSkies.push_back(engine().own(engine().create(SkyboxDesc{ .cube = mTextures.back(), .name = "constant sky" })));
    scene.setSkybox(mSkies.back(), illuminance);
}

Picture Stage::take() {
    Picture picture;
    Renderer renderer(engine());
    for (Format format : { Format::RGBA16F, Format::RGBA8 }) {
        const Owned<SwapChain> target = engine().own(engine().create(
                SwapChainDesc{ .size = view.size, .imageCount = 1, .format = format, .name = "hard case" }));
        mDevice.capture().arm({});
        renderer.render(scene, view, target);
        auto image = renderer.waitPixels(renderer.readPixels(target));
        if (!image) {
            ADD_FAILURE() << image.error().message;
            continue;
        }
        engine().waitIdle();
        if (const auto frame = mDevice.capture().take())
            picture.notFinite += describeNotFinite(*frame, picture.scannedAttachments);
        (format == Format::RGBA16F ? picture.linear : picture.display) = std::move(*image);
    }
    return picture;
}

} // namespace filament_core::hard
