// SPDX-License-Identifier: Apache-2.0
// custom_material [vulkan|gles] [OUT.png]: weave.mat, which CMake compiles into the program: see
// filament_add_materials() in ../CMakeLists.txt.
#include <filament_core/filament_core.h>
#include <materials/weave.h>

#include <cstdio>
#include <string_view>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "custom_material: error: %s\n", error.message.c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());

    const Result<Material> compiled = engine->create(MaterialDesc{ .package = materials::weave(), .name = "weave" });
    if (!compiled) return fail(compiled.error());
    const Owned<Material> weave = engine->own(*compiled);
    const Owned<MaterialInstance> cloth = engine->own(engine->createInstance(weave, "cloth"));
    Result<void> set = engine->set(cloth, "warp", float3(0.7f, 0.12f, 0.08f));
    if (set) set = engine->set(cloth, "weft", float3(0.85f, 0.7f, 0.45f));
    if (set) set = engine->set(cloth, "threads", float2(48, 18));
    if (!set) return fail(set.error());

    const Result<Mesh> ring = makeTorus({ .slices = 96, .stacks = 48 });
    if (!ring) return fail(ring.error());
    const Owned<VertexBuffer> vertices = engine->own(engine->create(ring->vertexBuffer()));
    const Owned<IndexBuffer> indices = engine->own(engine->create(ring->indexBuffer()));

    Scene scene(*engine);
    scene.add({ .vertices = vertices, .indices = indices, .material = cloth });
    scene.add(SunLight{ .directionWorld = { -1, -1.5f, -0.5f } });
    scene.add(SunLight{ .directionWorld = { 1, -0.3f, -1 }, .illuminance = Lux{ 25'000 }, .castsShadows = false });

    const View view{ .camera = Camera::lookAt({ 0, 1.3, 1.5 }, { 0, -0.05, 0 }),
                     .size = { 320, 180 },
                     .clearColor = { 0.3f, 0.35f, 0.4f, 1 },
                     .samples = 4 };
    Renderer renderer(*engine);
    const Result<Image> image = renderer.renderToImage(scene, view);
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "custom_material.png", *image);
    return saved ? 0 : fail(saved.error());
}
