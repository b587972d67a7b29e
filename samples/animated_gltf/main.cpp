// SPDX-License-Identifier: Apache-2.0
// animated_gltf MODEL.gltf [vulkan|gles] [OUT.png]: plays the first animation of a model for 0.8 s, and keeps the last
// of its frames.
#include <filament_core/filament_core.h>

#include <cmath>
#include <cstdio>
#include <string_view>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "animated_gltf: error: %s\n", error.message.c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return fail({ ErrorCode::InvalidArgument, "usage: animated_gltf MODEL.gltf [vulkan|gles] [OUT.png]" });
    const bool isVulkan = argc > 2 && std::string_view(argv[2]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    Result<Model> model = loadGltf(*engine, argv[1]);
    if (!model) return fail(model.error());
    if (model->animationCount() == 0) return fail({ ErrorCode::NotFound, "the model has no animation" });

    Scene scene(*engine);
    const Node root = scene.add(*model, fitToUnitCube(model->bounds()));
    scene.add(SunLight{ .directionWorld = { -1, -0.7f, -0.8f } });
    scene.add(PointLight{ .positionWorld = { 1, 0, 2 }, .intensity = Candela{ 30'000 }, .castsShadows = false });
    Animator animator(*model, scene, root);

    const View view{ .camera = Camera::lookAt({ 0.3, 0.25, 1.3 }, { 0, 0, 0 }),
                     .size = { 320, 180 },
                     .clearColor = { 0.3f, 0.5f, 0.8f, 1 },
                     .samples = 4 };
    Renderer renderer(*engine);
    const Owned<SwapChain> frames = engine->own(engine->create(SwapChainDesc{ .size = view.size }));
    constexpr int kFrames = 24;
    for (int frame = 1; frame <= kFrames; ++frame) {
        const double seconds = frame / 30.0;
        animator.apply(0, std::fmod(seconds, model->animationSeconds(0)));
        renderer.render(scene, view, frames);
    }
    const Result<Image> image = renderer.waitPixels(renderer.readPixels(frames));
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 3 ? argv[3] : "animated_gltf.png", *image);
    return saved ? 0 : fail(saved.error());
}
