// SPDX-License-Identifier: Apache-2.0
// hello MODEL.glb SKY.hdr: one lit picture of a glTF model, hello.png, without a window.
#include <filament_core/filament_core.h>

#include <cstdio>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "hello: error: %s\n", error.message.c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) return fail({ ErrorCode::InvalidArgument, "usage: hello MODEL.glb SKY.hdr" });

    Result<Engine> engine = Engine::create({ .backend = Backend::Gles }); // or Backend::Vulkan: the same bits
    if (!engine) return fail(engine.error());
    Result<Model> model = loadGltf(*engine, argv[1]); // decoding runs on the workers
    if (!model) return fail(model.error());
    Result<Environment> sky = loadEnvironment(*engine, argv[2]);
    if (!sky) return fail(sky.error());

    Scene scene(*engine);
    scene.add(*model);
    scene.setEnvironment(*sky, { .illuminance = Lux{ 30'000 } });

    const Box box = scene.bounds();
    const double3 center = (box.min + box.max) * 0.5, size = box.max - box.min;
    View view{ .camera = Camera::lookAt(center + size, center, { .verticalFovDegrees = 40 }), .size = { 1280, 720 } };

    Renderer renderer(*engine);
    Result<Image> image = renderer.renderToImage(scene, view);
    if (!image) return fail(image.error());
    Result<void> saved = savePng("hello.png", *image);
    return saved ? 0 : fail(saved.error());
}
