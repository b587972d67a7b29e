// SPDX-License-Identifier: Apache-2.0
// instances [vulkan|gles] [OUT.png] [FRAMES]: a field of 50 000 boxes, each a renderable of its own. Those that share
// vertices and material are drawn together. With FRAMES the camera moves on, and the median time of a frame is printed.
#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

using namespace filament_core;

namespace {

constexpr int kColumns = 250, kRows = 200;

int fail(Error const& error) {
    std::fprintf(stderr, "instances: error: %s\n", error.message.c_str());
    return 1;
}

/// Hills of boxes, 0.4 m apart.
double4x4 placeOf(int column, int row) {
    const double x = (column - 0.5 * kColumns) / 25, z = (row - 0.5 * kRows) / 25;
    const double hill = 2 / (1 + 0.2 * (x * x + z * z)) + 0.5 / (1 + (x - 2) * (x - 2) + (z - 1) * (z - 1));
    const double turn = 0.37 * ((31 * column + 17 * row) % 13);
    const double4x4 there = glm::translate(double4x4(1), double3(10 * x, 3 * hill, 10 * z));
    return glm::scale(glm::rotate(there, turn, double3(0, 1, 0)), double3(0.33, 0.25 + 0.5 * hill, 0.33));
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    const int frameCount = argc > 3 ? std::max(std::atoi(argv[3]), 1) : 0;
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    const Result<Material> lit = createBuiltInMaterial(*engine, "lit");
    if (!lit) return fail(lit.error());
    const Owned<Material> material = engine->own(*lit);
    const Owned<MaterialInstance> paint = engine->own(engine->createInstance(material));
    if (const Result<void> set = engine->set(paint, "baseColor", float3(0.3f, 0.5f, 0.25f)); !set)
        return fail(set.error());
    const Result<Mesh> box = makeBox();
    if (!box) return fail(box.error());
    const Owned<VertexBuffer> vertices = engine->own(engine->create(box->vertexBuffer()));
    const Owned<IndexBuffer> indices = engine->own(engine->create(box->indexBuffer()));

    Scene scene(*engine);
    for (int i = 0; i < kColumns * kRows; ++i)
        scene.add({ .vertices = vertices,
                    .indices = indices,
                    .material = paint,
                    .worldFromObject = placeOf(i % kColumns, i / kColumns) });
    // Every cascade of shadows would draw all boxes again.
    scene.add(SunLight{ .directionWorld = { -1, -1, 0.5f }, .castsShadows = false });

    View view{ .camera = Camera::lookAt({ 0, 22, 44 }, { 0, 0, 6 }),
               .size = { 1280, 720 },
               .clearColor = { 0.5f, 0.6f, 0.7f, 1 } };
    Renderer renderer(*engine);
    const Owned<SwapChain> frames = engine->own(engine->create(SwapChainDesc{ .size = view.size }));
    std::vector<double> milliseconds;
    for (int frame = 0; frame < frameCount; ++frame) {
        view.camera = Camera::lookAt({ 0.05 * frame, 22, 44 }, { 0, 0, 6 });
        const auto begin = std::chrono::steady_clock::now();
        renderer.render(scene, view, frames);
        engine->waitIdle();
        milliseconds.push_back(
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    if (frameCount > 0) {
        std::ranges::nth_element(milliseconds, milliseconds.begin() + frameCount / 2);
        std::printf("%d boxes: %.1f ms a frame, the median of %d\n", kColumns * kRows, milliseconds[frameCount / 2],
                    frameCount);
        return 0;
    }
    view.size = { 320, 180 };
    view.samples = 4;
    const Result<Image> image = renderer.renderToImage(scene, view);
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "instances.png", *image);
    return saved ? 0 : fail(saved.error());
}
