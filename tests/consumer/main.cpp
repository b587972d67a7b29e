// SPDX-License-Identifier: Apache-2.0
// Includes every public header and draws one frame with the device-less backend: compiles, links and runs anywhere.
#include <filament/filament.h>

#include <cstdio>

int main() {
    using namespace filament;
    Result<Engine> engine = Engine::create({ .backend = Backend::Null });
    if (!engine) return std::fprintf(stderr, "%s\n", engine.error().message.c_str()), 1;

    Scene scene(*engine);
    scene.add(SunLight{ .directionWorld = { 0, -1, 0 }, .illuminance = Lux{ 110'000 } });
    Renderer renderer(*engine);
    const Result<Image> image = renderer.renderToImage(scene, View{ .size = { 64, 48 } });
    if (!image) return std::fprintf(stderr, "%s\n", image.error().message.c_str()), 1;

    std::printf("consumer: %ux%u pixels, %u light\n", image->width, image->height, scene.lightCount());
    return image->width == 64 && image->height == 48 && scene.lightCount() == 1 ? 0 : 1;
}
