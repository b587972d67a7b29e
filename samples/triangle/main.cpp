// SPDX-License-Identifier: Apache-2.0
// triangle [vulkan|gles] [OUT.png]: three vertices with colours of their own; no file is read.
#include <filament_core/filament_core.h>

#include <cstdio>
#include <string_view>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "triangle: error: %s\n", error.message.c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());

    const Mesh mesh{ .vertices = { { .position = { -1, -0.8f, 0 }, .color = { 1, 0, 0, 1 } },
                                   { .position = { 1, -0.8f, 0 }, .color = { 0, 1, 0, 1 } },
                                   { .position = { 0, 0.9f, 0 }, .color = { 0, 0, 1, 1 } } },
                     .indices = { 0, 1, 2 } }; // counter-clockwise: seen from the front
    const Owned<VertexBuffer> vertices = engine->own(engine->create(mesh.vertexBuffer()));
    const Owned<IndexBuffer> indices = engine->own(engine->create(mesh.indexBuffer()));

    const Result<Material> found = createBuiltInMaterial(*engine, "vertexColors");
    if (!found) return fail(found.error());
    const Owned<Material> material = engine->own(*found);
    const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));

    Scene scene(*engine);
    scene.add({ .vertices = vertices, .indices = indices, .material = instance });

    View view{ .camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }), .size = { 320, 180 } };
    view.display.toneMapper = ToneMapper::Linear; // the colours as they are
    Renderer renderer(*engine);
    const Result<Image> image = renderer.renderToImage(scene, view);
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "triangle.png", *image);
    return saved ? 0 : fail(saved.error());
}
