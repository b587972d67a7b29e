// SPDX-License-Identifier: Apache-2.0
// Includes every public header and draws one frame with the device-less backend: compiles, links and runs anywhere.
#include <filament_core/filament_core.h>
#include <materials/stone.h>

#include <cstdio>
#include <cstring>

namespace {

using namespace filament_core;

int fail(Error const& error) {
    std::fprintf(stderr, "consumer: error: %s\n", error.message.c_str());
    return 1;
}

/// The version as the headers, the library and find_package() give it.
bool isOneVersion() { return version() == kHeaderVersion && std::strcmp(versionText(), CMAKE_VERSION_TEXT) == 0; }

} // namespace

int main() {
    if (!isOneVersion()) return fail({ ErrorCode::Internal, std::string("the library is version ") + versionText() });
    Result<Engine> engine = Engine::create({ .backend = Backend::Null });
    if (!engine) return fail(engine.error());
    const Result<Material> stone = engine->create(MaterialDesc{ .package = materials::stone() });
    if (!stone) return fail(stone.error());
    const Owned<Material> owner = engine->own(*stone);

    Scene scene(*engine);
    scene.add(SunLight{ .directionWorld = { 0, -1, 0 }, .illuminance = Lux{ 110'000 } });
    Renderer renderer(*engine);
    const Result<Image> image = renderer.renderToImage(scene, View{ .size = { 64, 48 } });
    if (!image) return fail(image.error());

    std::printf("consumer: %ux%u pixels, %u light, material '%s'\n", image->width, image->height, scene.lightCount(),
                engine->describe(*stone).name.c_str());
    const bool right = image->width == 64 && image->height == 48 && scene.lightCount() == 1;
    return right && engine->describe(*stone).name == "stone" ? 0 : 1;
}
