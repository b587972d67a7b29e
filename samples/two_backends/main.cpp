// SPDX-License-Identifier: Apache-2.0
// two_backends [OUT.png]: draws the same scene by Vulkan and by OpenGL ES and counts the pixels that differ. With
// Mesa's CPU drivers there are none. The exit status is 1 if there are.
#include <filament_core/filament_core.h>

#include <cstdio>
#include <cstring>
#include <initializer_list>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "two_backends: error: %s\n", error.message.c_str());
    return 1;
}

/// Forty balls, from metal to plastic and from smooth to rough, under a sun and a lamp.
Result<Image> draw(Backend backend) {
    Result<Engine> engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    std::printf("%s: %s\n", toString(backend), engine->device().device.c_str());
    const Result<Material> found = createBuiltInMaterial(*engine, "lit");
    if (!found) return found.error();
    const Owned<Material> material = engine->own(*found);
    const Result<Mesh> ball = makeIcoSphere({ .radius = 0.45f });
    if (!ball) return ball.error();
    const Owned<VertexBuffer> vertices = engine->own(engine->create(ball->vertexBuffer()));
    const Owned<IndexBuffer> indices = engine->own(engine->create(ball->indexBuffer()));

    std::vector<Owned<MaterialInstance>> instances;
    Scene scene(*engine);
    for (uint32_t i = 0; i < 40; ++i) {
        const float column = static_cast<float>(i % 8), row = static_cast<float>(i / 8); // NOLINT: whole numbers
        instances.push_back(engine->own(engine->createInstance(material)));
        Result<void> set = engine->set(instances.back(), "baseColor", float3(0.9f, 0.5f + 0.05f * column, 0.3f));
        if (set) set = engine->set(instances.back(), "roughness", (column + 0.5f) / 8);
        if (set) set = engine->set(instances.back(), "metallic", row / 4);
        if (!set) return set.error();
        double4x4 place(1);
        place[3] = double4(column - 3.5, 2 - row, 0, 1);
        scene.add({ .vertices = vertices, .indices = indices, .material = instances.back(), .worldFromObject = place });
    }
    scene.add(SunLight{ .directionWorld = { -1, -1, -1 } });
    scene.add(PointLight{ .positionWorld = { 0, 0, 4 }, .intensity = Candela{ 200'000 }, .castsShadows = false });
    const View view{ .camera = Camera::lookAt({ 0, 0, 7 }, { 0, 0, 0 }), .size = { 320, 180 }, .samples = 4 };
    Renderer renderer(*engine);
    return renderer.renderToImage(scene, view);
}

} // namespace

int main(int argc, char** argv) {
    const Result<Image> vulkan = draw(Backend::Vulkan), gles = draw(Backend::Gles);
    for (Result<Image> const* image : { &vulkan, &gles }) {
        if (!*image) return fail(image->error());
    }
    size_t differing = 0;
    for (size_t i = 0; i < vulkan->pixels.size(); i += 4)
        differing += std::memcmp(&vulkan->pixels[i], &gles->pixels[i], 4) != 0;
    std::printf("%zu of %zu pixels differ\n", differing, vulkan->pixels.size() / 4);
    if (const Result<void> saved = savePng(argc > 1 ? argv[1] : "two_backends.png", *vulkan); !saved)
        return fail(saved.error());
    return differing == 0 ? 0 : 1;
}
