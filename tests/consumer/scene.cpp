// SPDX-License-Identifier: Apache-2.0
// Reads a scene file, edits it, saves it, reads it again and draws it with the device-less backend.
//   scene OUT.json [IN.json]
#include <filament_core/BuildScene.h>
#include <filament_core/Renderer.h>
#include <filament_core/SceneFile.h>

#include <cstdio>
#include <filesystem>

namespace {

using namespace filament_core;

constexpr const char* kScene = R"({
  "version": 1,
  "description": "Two lamps above nothing.",
  "points": [ { "at": [ 0, 2, 0 ], "lumens": 800, "kelvin": 2700 } ],
  "camera": { "eye": [ 0, 1, 3 ] },
  "view": { "size": [ 64, 48 ] }
})";

int fail(Error const& error) {
    std::fprintf(stderr, "scene: error: %s\n", error.message.c_str());
    return 1;
}

Result<void> edit(SceneFile& scene) {
    if (Result<void> done = scene.set("points[0].kelvin", "4000"); !done) return done;
    if (Result<void> done = scene.set("effects.fog", "on"); !done) return done;
    if (Result<void> done = scene.add(SpotLight{ .positionWorld = { 1, 2, 0 }, .directionWorld = { 0, -1, 0 } }); !done)
        return done;
    return scene.setCamera(Camera::lookAt({ 2, 1, 3 }, { 0, 1, 0 }));
}

bool isWhatWasSaved(SceneFile const& scene) {
    return scene.get("points[0].kelvin") == "4000" && scene.get("points[0].lumens") == "800" &&
           scene.contents().lights.size() == 2 && scene.contents().camera.eye.has_value();
}

} // namespace

int main(int argc, char** argv) {
    const std::filesystem::path out = argc > 1 ? argv[1] : "edited-scene.json";
    Result<SceneFile> scene = argc > 2 ? SceneFile::load(argv[2]) : SceneFile::parse(kScene);
    if (!scene) return fail(scene.error());
    if (Result<void> done = edit(*scene); !done) return fail(done.error());
    if (Result<void> done = scene->save(out); !done) return fail(done.error());
    const Result<SceneFile> saved = SceneFile::load(out);
    if (!saved) return fail(saved.error());

    Result<Engine> engine = Engine::create({ .backend = Backend::Null });
    if (!engine) return fail(engine.error());
    Result<BuiltScene> built = buildScene(*engine, *saved);
    if (!built) return fail(built.error());
    Renderer renderer(*engine);
    const Result<Image> image = renderer.renderToImage(built->scene, built->view);
    if (!image) return fail(image.error());
    std::printf("scene: %u lights, %ux%u pixels\n", built->scene.lightCount(), image->width, image->height);
    return isWhatWasSaved(*saved) && built->scene.lightCount() == 2 && image->width == 64 ? 0 : 1;
}
