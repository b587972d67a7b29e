// SPDX-License-Identifier: Apache-2.0
// dynamic_mesh [vulkan|gles] [OUT.png]: waves on a pond. The program computes positions and normals in every frame;
// what stays lies in a vertex stream of its own, which is uploaded once.
#include <filament_core/filament_core.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string_view>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "dynamic_mesh: error: %s\n", error.message.c_str());
    return 1;
}

/// Rings around two stones that fell into the water.
float heightAt(float x, float z, float seconds) {
    const auto rings = [&](float centerX, float centerZ) {
        const float distance = std::hypot(x - centerX, z - centerZ);
        return 0.06f * std::sin(9 * distance - 6 * seconds) * std::exp(-1.2f * distance);
    };
    return rings(-0.5f, 0.1f) + rings(0.6f, -0.4f);
}

/// The vertex stream that changes: 28 of the 64 bytes of a vertex.
struct Wave {
    float3 position{ 0 };
    float4 tangents{ 0 };
};

Result<void> makeWaves(Mesh& water, std::vector<Wave>& waves, float seconds) {
    for (MeshVertex& vertex : water.vertices)
        vertex.position.y = heightAt(vertex.position.x, vertex.position.z, seconds);
    if (Result<void> done = computeNormals(water); !done) return done;
    waves.clear();
    for (MeshVertex const& vertex : water.vertices)
        waves.push_back({ vertex.position, tangentsFromNormal(vertex.normal) });
    return {};
}

/// Stream 0: `waves`; stream 1: what the vertices of the mesh have besides.
VertexBufferDesc verticesOf(Mesh const& water, std::vector<Wave> const& waves) {
    const VertexStreamDesc rest{ .stride = sizeof(MeshVertex),
                                 .attributes = { { Attribute::Color, VertexFormat::Float4,
                                                   offsetof(MeshVertex, color) },
                                                 { Attribute::Uv0, VertexFormat::Float2, offsetof(MeshVertex, uv) } },
                                 .data = std::as_bytes(std::span(water.vertices)) };
    return { .vertexCount = static_cast<uint32_t>(waves.size()),
             .stride = sizeof(Wave),
             .attributes = { { Attribute::Position, VertexFormat::Float3, offsetof(Wave, position) },
                             { Attribute::Tangents, VertexFormat::Float4, offsetof(Wave, tangents) } },
             .data = std::as_bytes(std::span(waves)),
             .streams = { rest },
             .name = "water" };
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());

    Result<Mesh> water = makePlane({ .width = 3, .depth = 3, .widthSegments = 96, .depthSegments = 96 });
    if (!water) return fail(water.error());
    const Owned<IndexBuffer> indices = engine->own(engine->create(water->indexBuffer()));
    std::vector<Wave> waves;
    if (const Result<void> made = makeWaves(*water, waves, 0); !made) return fail(made.error());
    const Owned<VertexBuffer> vertices = engine->own(engine->create(verticesOf(*water, waves)));

    const Result<Material> found = createBuiltInMaterial(*engine, "lit");
    if (!found) return fail(found.error());
    const Owned<Material> material = engine->own(*found);
    const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
    Result<void> set = engine->set(instance, "baseColor", float3(0.02f, 0.15f, 0.25f));
    if (set) set = engine->set(instance, "roughness", 0.25f);
    if (!set) return fail(set.error());

    Scene scene(*engine);
    scene.add(SunLight{ .directionWorld = { 0.3f, -0.35f, 1 }, .illuminance = Lux{ 40'000 } });
    scene.add(SunLight{ .directionWorld = { 0, -1, -0.3f }, .illuminance = Lux{ 40'000 }, .castsShadows = false });
    scene.add({ .vertices = vertices, .indices = indices, .material = instance }); // its bounds follow the vertices

    const View view{ .camera = Camera::lookAt({ 0, 0.9, 1.9 }, { 0, -0.1, 0 }),
                     .size = { 320, 180 },
                     .clearColor = { 0.4f, 0.5f, 0.6f, 1 },
                     .samples = 4 };
    Renderer renderer(*engine);
    const Owned<SwapChain> frames = engine->own(engine->create(SwapChainDesc{ .size = view.size }));
    for (int frame = 0; frame < 24; ++frame) {
        if (const Result<void> made = makeWaves(*water, waves, static_cast<float>(frame) / 24); !made)
            return fail(made.error());
        engine->update(vertices, std::as_bytes(std::span(waves))); // of stream 0
        renderer.render(scene, view, frames);
    }
    const Result<Image> image = renderer.waitPixels(renderer.readPixels(frames));
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "dynamic_mesh.png", *image);
    return saved ? 0 : fail(saved.error());
}
