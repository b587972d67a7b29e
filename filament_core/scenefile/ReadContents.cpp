// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/ReadContents.h"

#include "filament_core/scenefile/ReadDebug.h"
#include "filament_core/scenefile/ReadGrid.h"
#include "filament_core/scenefile/ReadLights.h"
#include "filament_core/scenefile/ReadModel.h"
#include "filament_core/scenefile/ReadOptions.h"
#include "filament_core/scenefile/ReadProbe.h"

#include <filament_core/Sky.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <array>

namespace filament_core::scenefile {
namespace {

constexpr double kMostLux = 1e9;
constexpr std::array<std::string_view, 2> kContents{ "keep", "clear" };
constexpr std::array<std::string_view, 2> kBlendings{ "opaque", "translucent" };

void readSky(JsonReader& reader, SceneFileEnvironment& environment) {
    SkyDesc& sky = environment.sky.emplace();
    environment.settings.illuminance = kSkySettings.illuminance;
    double3 sun(sky.directionToSun), albedo(sky.groundAlbedo);
    reader.read("sun", sun);
    sky.directionToSun = float3(sun);
    reader.read("turbidity", sky.turbidity, 1, 10);
    reader.read("groundAlbedo", albedo);
    sky.groundAlbedo = float3(albedo);
    reader.read("altitudeMeters", sky.altitudeMeters, 0, 50'000);
    reader.read("disc", sky.showsDisc);
    reader.read("height", sky.height, 16, 2048);
}

void readEnvironment(JsonReader& reader, SceneFileEnvironment& environment) {
    EnvironmentSettings& settings = environment.settings;
    reader.read("file", environment.file);
    reader.object("sky", [&](JsonReader& r) { readSky(r, environment); });
    reader.read("lux", settings.illuminance.value, 0, kMostLux);
    double degrees = 0;
    reader.read("degrees", degrees, -360, 360);
    settings.rotationRadians = static_cast<float>(glm::radians(degrees));
    reader.read("skybox", settings.skybox);
    reader.read("groundHeightMeters", settings.groundHeightMeters, 0, 1e4);
    reader.read("groundLevelMeters", settings.groundLevelMeters, -1e6, 1e6);
    reader.read("groundRadiusMeters", settings.groundRadiusMeters, 0.01, 1e5);
    readOptions(reader, environment.options);
}

void readLens(JsonReader& reader, Lens& lens) {
    reader.read("fovDegrees", lens.verticalFovDegrees, 0.01, 179);
    reader.read("near", lens.nearMeters, 1e-6, 1e6);
    reader.read("orthographicHeight", lens.orthographicHeight, 0, 1e9);
    reader.read("far", lens.farMeters, 1e-6, 1e9);
    reader.read("shift", lens.shift);
    reader.read("aspect", lens.aspect, 0, 1e4);
    if (lens.isOrthographic() && !(lens.farMeters > lens.nearMeters))
        reader.complain("far", "expected more than 'near'");
}

void readCamera(JsonReader& reader, SceneFileCamera& camera) {
    if (reader.has("eye")) reader.read("eye", camera.eye.emplace(0.0));
    reader.read("at", camera.at);
    reader.read("up", camera.up);
    if (camera.up == double3(0.0)) reader.complain("up", "expected one that is not zero");
    reader.read("moves", camera.metersPerFrame);
    readLens(reader, camera.lens);
}

void readExposure(JsonReader& reader, Exposure& exposure) {
    reader.read("aperture", exposure.aperture, 0.1, 100);
    reader.read("shutter", exposure.shutterSeconds, 1e-6, 100);
    reader.read("iso", exposure.iso, 1, 1e6);
}

void readViewport(JsonReader& reader, filament_core::Viewport& viewport) {
    reader.read("offset", viewport.offset);
    reader.choice("contents", viewport.contents, kContents);
    reader.choice("blending", viewport.blending, kBlendings);
    reader.read("clear", viewport.clearColor);
}

void readSize(JsonReader& reader, const char* name, uint2& size) {
    double2 pixels(size);
    reader.numbers(name, &pixels.x, 2, 1, 4096);
    size = uint2(pixels);
    if (double2(size) != pixels || size.x < 1 || size.y < 1 || size.x > 4096 || size.y > 4096)
        reader.complain(name, "expected 1 to 4096 pixels a side");
}

void readSamples(JsonReader& reader, uint8_t& samples) {
    Json const* value = reader.raw("samples", R"({"enum": [1, 4]})");
    if (!value) return;
    if (*value != 1 && *value != 4) return reader.complain("samples", "expected 1 or 4");
    samples = *value == 4 ? 4 : 1;
}

void readView(JsonReader& reader, SceneFileContents& scene) {
    View& view = scene.view;
    readSize(reader, "size", view.size);
    if (reader.has("target")) readSize(reader, "target", scene.target);
    if (reader.has("viewport"))
        reader.object("viewport", [&](JsonReader& r) { readViewport(r, view.viewport.emplace()); });
    readSamples(reader, view.samples);
    reader.read("occlusionCulling", view.occlusionCulling);
    reader.read("lod.pixels", view.lod.pixels, 0, static_cast<double>(LevelsOfDetail::kMostPixels));
    readOptions(reader, view.section);
    readOptions(reader, view.display);
    reader.read("look", scene.look);
    reader.choice("debugView", view.debugView, enumNames<DebugView>());
    reader.read("clear", view.clearColor);
    readBits(reader, "layers", view.visibleLayers);
    reader.read("linear", scene.isLinear);
    reader.read("frames", scene.frames, 1, 64);
    reader.read("secondsPerFrame", scene.secondsPerFrame, 0, 1e6);
}

/// Its view is the main one except for its own fields.
void readOverlay(JsonReader& reader, SceneFileContents& scene) {
    SceneFileOverlay& overlay = scene.overlays.emplace_back(SceneFileOverlay{ .view = scene.view });
    overlay.camera = { .eye = double3(0, 0, 1), .lens = scene.camera.lens };
    readSize(reader, "size", overlay.view.size);
    reader.object("viewport", [&](JsonReader& r) { readViewport(r, overlay.view.viewport.emplace()); });
    reader.object("camera", [&](JsonReader& r) { readCamera(r, overlay.camera); });
    reader.read("clear", overlay.view.clearColor);
    readBits(reader, "layers", overlay.view.visibleLayers);
    reader.object("quality", [&](JsonReader& r) { readOptions(r, overlay.view.quality); });
    reader.object("effects", [&](JsonReader& r) { readOptions(r, overlay.view.effects); });
    const uint2 end = overlay.view.viewport ? overlay.view.viewport->offset + overlay.view.size : overlay.view.size;
    const uint2 target = scene.target.x > 0 ? scene.target : scene.view.size;
    if (!overlay.view.viewport || end.x > target.x || end.y > target.y)
        reader.complain("viewport", "expected one whose offset and size lie in the picture");
}

void readPass(JsonReader& reader, SceneFilePass& pass) {
    reader.read("material", pass.material);
    if (pass.material.empty() && !reader.isDescribing())
        reader.complain("material", "expected the file of a material of domain postprocess");
    reader.choice("place", pass.place, enumNames<PassPlace>());
    reader.read("values", pass.values);
}

void readComparator(JsonReader& reader, SceneFileComparison& comparison) {
    reader.choice("kind", comparison.kind, enumNames<ImageComparator>());
    reader.read("tolerance", comparison.tolerance, 0, 255);
    reader.read("mean", comparison.flipMean, 0, 1);
    reader.read("p99", comparison.flipP99, 0, 1);
}

void readLights(JsonReader& reader, SceneFileContents& scene) {
    const auto read = [&](const char* key, void (*readLight)(JsonReader&, SceneFileLight&)) {
        reader.objects(key, [&](JsonReader& r) { readLight(r, scene.lights.emplace_back()); });
    };
    read("suns", readSun);
    read("points", readPoint);
    read("spots", readSpot);
    read("rects", readRect);
    read("discs", readDisc);
    read("tubes", readTube);
}

void readFeatures(JsonReader& reader) {
    Json const* features = reader.raw("features", R"({"type": "object", "additionalProperties": {"type": "object"}})");
    if (!features) return;
    const bool isRight = features->is_object() && std::ranges::all_of(features->items(), [](auto const& item) {
                             return item.value().is_object();
                         });
    if (!isRight) reader.complain("features", "expected an object of objects");
}

void readAll(JsonReader& reader, SceneFileContents& scene) {
    uint32_t version = SceneFile::kVersion;
    reader.read("version", version, SceneFile::kVersion, SceneFile::kVersion);
    reader.read("description", scene.description);
    readFeatures(reader);
    readModels(reader, scene.models);
    reader.object("environment", [&](JsonReader& r) { readEnvironment(r, scene.environment); });
    reader.objects("probes", [&](JsonReader& r) { readProbe(r, scene.probes.emplace_back()); });
    reader.objects("grids", [&](JsonReader& r) { readGrid(r, scene.grids.emplace_back()); });
    readLights(reader, scene);
    reader.read("origin", scene.origin);
    reader.object("camera", [&](JsonReader& r) { readCamera(r, scene.camera); });
    reader.object("exposure", [&](JsonReader& r) { readExposure(r, scene.exposure); });
    reader.object("view", [&](JsonReader& r) { readView(r, scene); });
    reader.object("quality", [&](JsonReader& r) { readOptions(r, scene.view.quality); });
    reader.object("effects", [&](JsonReader& r) {
        readOptions(r, scene.view.effects);
        r.read("bloom.dirt", scene.dirt);
    });
    reader.object("debug", [&](JsonReader& r) { readDebugDraw(r, scene.debug); });
    reader.objects("postProcess", [&](JsonReader& r) { readPass(r, scene.passes.emplace_back()); });
    reader.objects("overlays", [&](JsonReader& r) { readOverlay(r, scene); });
    reader.object("comparator", [&](JsonReader& r) { readComparator(r, scene.comparison); });
    reader.read("kills", scene.comparison.kills);
}

SceneFileContents emptyScene() {
    SceneFileContents scene;
    scene.view.size = { 256, 256 };
    scene.view.quality.shadows = ShadowFilter::Off; // files name what they want
    return scene;
}

} // namespace

Result<SceneFileContents> readContents(Json const& tree, std::string const& where) {
    if (tree.is_object() && tree.contains("version")) {
        Json const& version = tree["version"];
        if (version.is_number_unsigned() && version.get<uint64_t>() > SceneFile::kVersion)
            return fail(ErrorCode::Unsupported, "{}: version {} is newer than {}, the last one that this program reads",
                        where, version.get<uint64_t>(), SceneFile::kVersion);
    }
    SceneFileContents scene = emptyScene();
    JsonReader reader(tree, where);
    readAll(reader, scene);
    if (const Result<void> done = reader.finish(); !done) return done.error();
    return scene;
}

Json sceneSchema() {
    SceneFileContents scene = emptyScene();
    Json schema{ { "$schema", "https://json-schema.org/draft/2020-12/schema" },
                 { "title", "Scene file" },
                 { "description", "What SceneFile of filament_core reads: docs/scene-files.md." } };
    schema.update(JsonReader::describe([&](JsonReader& reader) { readAll(reader, scene); }));
    return schema;
}

} // namespace filament_core::scenefile
