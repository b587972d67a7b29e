// SPDX-License-Identifier: Apache-2.0
// several_views [vulkan|gles] [OUT.png]: a scene in perspective, from above and from the side, all in one image.
#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "several_views: error: %s\n", error.message.c_str());
    return 1;
}

struct Thing {
    Result<Mesh> mesh;
    double3 position;
    float3 color;
};

View viewFrom(double3 eye, double3 up, Lens lens, uint2 offset, uint2 size, float4 background) {
    return { .camera = Camera::lookAt(eye, { 0, 0.4, 0 }, lens, {}, up),
             .size = size,
             .clearColor = background,
             .samples = 4,
             .viewport = Viewport{ .offset = offset } };
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    const Result<Material> lit = createBuiltInMaterial(*engine, "lit");
    if (!lit) return fail(lit.error());
    const Owned<Material> material = engine->own(*lit);

    const std::array<Thing, 4> things{
        Thing{ makePlane({ .width = 4, .depth = 3 }), { 0, 0, 0 }, { 0.5f, 0.5f, 0.5f } },
        Thing{ makeBox(), { -1, 0.5, -0.5 }, { 0.8f, 0.2f, 0.1f } },
        Thing{ makeCone(), { 0.9, 0.5, -0.4 }, { 0.2f, 0.6f, 0.2f } },
        Thing{ makeTorus(), { 0.1, 0.2, 0.7 }, { 0.1f, 0.3f, 0.8f } }
    };
    Scene scene(*engine);
    std::vector<Owned<VertexBuffer>> vertices;
    std::vector<Owned<IndexBuffer>> indices;
    std::vector<Owned<MaterialInstance>> paints;
    for (auto const& [mesh, position, color] : things) {
        if (!mesh) return fail(mesh.error());
        vertices.push_back(engine->own(engine->create(mesh->vertexBuffer())));
        indices.push_back(engine->own(engine->create(mesh->indexBuffer())));
        paints.push_back(engine->own(engine->createInstance(material)));
        if (const Result<void> set = engine->set(paints.back(), "baseColor", color); !set) return fail(set.error());
        scene.add({ .vertices = vertices.back(),
                    .indices = indices.back(),
                    .material = paints.back(),
                    .worldFromObject = glm::translate(double4x4(1), position) });
    }
    scene.add(SunLight{ .directionWorld = { -0.6f, -1, -0.4f } });
    scene.add(SunLight{ .directionWorld = { 1, -0.5f, -1 }, .illuminance = Lux{ 20'000 }, .castsShadows = false });

    const Lens parallel{ .nearMeters = 0.1f, .orthographicHeight = 3.4f, .farMeters = 20 };
    std::array<View, 3> views{
        viewFrom({ 2, 2.4, 4 }, { 0, 1, 0 }, {}, { 0, 0 }, { 200, 180 }, { 0.25f, 0.3f, 0.35f, 1 }),
        viewFrom({ 0, 8, 0 }, { 0, 0, -1 }, parallel, { 200, 0 }, { 120, 90 }, { 0.1f, 0.1f, 0.12f, 1 }),
        viewFrom({ 8, 0.4, 0 }, { 0, 1, 0 }, parallel, { 200, 90 }, { 120, 90 }, { 0.12f, 0.12f, 0.1f, 1 }),
    };
    views[0].viewport->contents = TargetContents::Clear; // the next image; the others join it

    const Owned<SwapChain> frames = engine->own(engine->create(SwapChainDesc{ .size = { 320, 180 } }));
    std::vector<Renderer> renderers; // one for each view, so that each keeps its shadow maps and histories
    for (View const& view : views) renderers.emplace_back(*engine).render(scene, view, frames);

    const Result<Image> image = renderers[0].waitPixels(renderers[0].readPixels(frames));
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "several_views.png", *image);
    return saved ? 0 : fail(saved.error());
}
