// SPDX-License-Identifier: Apache-2.0
// thousand_lights [vulkan|gles] [OUT.png]: lamps that rise and fall over a floor, each with its own colour.
#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

using namespace filament_core;

namespace {

constexpr int kColumns = 40, kRows = 25, kFrames = 12;

int fail(Error const& error) {
    std::fprintf(stderr, "thousand_lights: error: %s\n", error.message.c_str());
    return 1;
}

/// Up for half of the time, down for the other; neighbours are apart.
PointLight lampAt(int column, int row, int frame) {
    const int phase = (7 * column + 11 * row + frame) % kFrames;
    const double height = 0.15 + 0.1 * std::abs(phase - kFrames / 2);
    constexpr std::array<float3, 5> kColors{
        float3{ 1, 0.3f, 0.1f }, { 0.2f, 0.5f, 1 }, { 1, 0.8f, 0.3f }, { 0.4f, 1, 0.3f }, { 0.9f, 0.2f, 0.8f }
    };
    return { .positionWorld = { (column - 0.5 * (kColumns - 1)) * 0.5, height, (row - 0.5 * (kRows - 1)) * 0.5 },
             .intensity = Candela{ 6'000 },
             .color = LinearColor{ kColors[static_cast<size_t>(column + 2 * row) % kColors.size()] },
             .rangeMeters = 1.6f,
             .castsShadows = false };
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    const Result<Material> lit = createBuiltInMaterial(*engine, "lit");
    if (!lit) return fail(lit.error());
    const Owned<Material> material = engine->own(*lit);
    const Owned<MaterialInstance> grey = engine->own(engine->createInstance(material));
    if (const Result<void> set = engine->set(grey, "roughness", 0.4); !set) return fail(set.error());

    Scene scene(*engine);
    std::vector<Owned<VertexBuffer>> vertices;
    std::vector<Owned<IndexBuffer>> indices;
    for (Result<Mesh> const& mesh : { makePlane({ .width = 24, .depth = 16 }), makeIcoSphere({ .radius = 0.3f }) }) {
        if (!mesh) return fail(mesh.error());
        vertices.push_back(engine->own(engine->create(mesh->vertexBuffer())));
        indices.push_back(engine->own(engine->create(mesh->indexBuffer())));
    }
    scene.add({ .vertices = vertices[0], .indices = indices[0], .material = grey });
    for (int i = 0; i < 60; ++i)
        scene.add({ .vertices = vertices[1],
                    .indices = indices[1],
                    .material = grey,
                    .worldFromObject =
                            glm::translate(double4x4(1), double3((i % 10 - 4.5) * 2, 0.2, (i / 10 - 2.5) * 2)) });
    std::vector<Light> lamps;
    for (int i = 0; i < kColumns * kRows; ++i) lamps.push_back(scene.add(lampAt(i % kColumns, i / kColumns, 0)));

    const View view{ .camera = Camera::lookAt({ 0, 5, 9 }, { 0, -0.5, 0.5 }), .size = { 320, 180 }, .samples = 4 };
    Renderer renderer(*engine);
    const Owned<SwapChain> frames = engine->own(engine->create(SwapChainDesc{ .size = view.size }));
    for (int frame = 0; frame < kFrames; ++frame) {
        for (int i = 0; i < kColumns * kRows; ++i)
            scene.set(lamps[static_cast<size_t>(i)], lampAt(i % kColumns, i / kColumns, frame));
        renderer.render(scene, view, frames);
    }
    const Result<Image> image = renderer.waitPixels(renderer.readPixels(frames));
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "thousand_lights.png", *image);
    return saved ? 0 : fail(saved.error());
}
