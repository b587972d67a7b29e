// SPDX-License-Identifier: Apache-2.0
// textured_cube PICTURE [vulkan|gles] [OUT.png]: an image (PNG, JPEG, EXR, HDR) on all sides of a cube, in the sun.
#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <cstdio>
#include <string_view>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "textured_cube: error: %s\n", error.message.c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) return fail({ ErrorCode::InvalidArgument, "usage: textured_cube PICTURE [vulkan|gles] [OUT.png]" });
    const bool isVulkan = argc > 2 && std::string_view(argv[2]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());

    const Result<Image> picture = loadImage(argv[1]);
    if (!picture) return fail(picture.error());
    const Owned<Texture> texture = engine->own(engine->create(textureOf(*picture, argv[1])));

    const Result<Mesh> cube = makeBox();
    if (!cube) return fail(cube.error());
    const Owned<VertexBuffer> vertices = engine->own(engine->create(cube->vertexBuffer()));
    const Owned<IndexBuffer> indices = engine->own(engine->create(cube->indexBuffer()));

    const Result<Material> found = createBuiltInMaterial(*engine, "litTextured");
    if (!found) return fail(found.error());
    const Owned<Material> material = engine->own(*found);
    const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
    if (const Result<void> set = engine->set(instance, "baseColorMap", texture); !set) return fail(set.error());

    Scene scene(*engine);
    scene.add({ .vertices = vertices,
                .indices = indices,
                .material = instance,
                .worldFromObject = glm::rotate(double4x4(1), 0.6, double3(0, 1, 0)) });
    scene.add(SunLight{ .directionWorld = { -1, -2, -1.5f } });
    scene.add(SunLight{ .directionWorld = { 2, -0.5f, -1 }, .illuminance = Lux{ 15'000 }, .castsShadows = false });

    const View view{ .camera = Camera::lookAt({ 0, 1, 2.2 }, { 0, -0.05, 0 }),
                     .size = { 320, 180 },
                     .clearColor = { 0.05f, 0.07f, 0.1f, 1 },
                     .samples = 4 };
    Renderer renderer(*engine);
    const Result<Image> image = renderer.renderToImage(scene, view);
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 3 ? argv[3] : "textured_cube.png", *image);
    return saved ? 0 : fail(saved.error());
}
