// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/SceneFile.h"

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/scenes/SceneDebug.h"

#include <filament_core/Look.h>
#include <filament_core/Sky.h>

#include <glm/ext/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace filament_core::tools {
namespace {

std::string optionText(Json const& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
    return value.dump();
}

/// The options of T that a scene names, as words, numbers, switches or lists of numbers.
template <class T>
void readOptions(JsonReader& reader, T& object) {
    for (Option const& option : optionsOf<T>()) {
        const char* const key = option.name.data(); // a literal
        Json const* value = reader.raw(key);
        if (!value) continue;
        const Result<void> done = setOption(object, option.name, optionText(*value));
        if (!done) reader.complain(key, done.error().message);
    }
}

constexpr double kBright = 1e9;

void readCopy(JsonReader& reader, SceneSpec& spec) {
    double3 at(0.0), scale(1.0), degrees(0.0);
    reader.read("at", at);
    reader.read("scale", scale);
    reader.read("degrees", degrees);
    double4x4 world = glm::translate(double4x4(1.0), at);
    world = glm::rotate(world, glm::radians(degrees.y), double3(0, 1, 0));
    world = glm::rotate(world, glm::radians(degrees.x), double3(1, 0, 0));
    world = glm::rotate(world, glm::radians(degrees.z), double3(0, 0, 1));
    spec.copies.push_back(glm::scale(world, scale));
    LightChannels channels = kDefaultLightChannels;
    readLightChannels(reader, channels);
    spec.copyChannels.push_back(channels);
    readBits(reader, "layers", spec.copyLayers.emplace_back(kDefaultLayers));
    uint32_t priority = DrawOrder{}.priority, blendOrder = 0;
    reader.read("priority", priority, 0, DrawOrder::kLastPriority);
    reader.read("blendOrder", blendOrder, 0, 65535);
    spec.copyPlaces.push_back({ static_cast<uint8_t>(priority), static_cast<uint16_t>(blendOrder) });
    reader.read("values", spec.copyValues.emplace_back());
    readRaster(reader, spec.copyRasters.emplace_back());
    reader.read("moves", spec.copyMoves.emplace_back(0.0));
}

void readSky(JsonReader& reader, SceneSpec& spec) {
    SkyDesc& sky = spec.sky.emplace();
    spec.environmentSettings.illuminance = kSkySettings.illuminance;
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

void readEnvironment(JsonReader& reader, SceneSpec& spec) {
    reader.read("file", spec.environment);
    reader.object("sky", [&](JsonReader& r) { readSky(r, spec); });
    reader.read("lux", spec.environmentSettings.illuminance.value, 0, kBright);
    double degrees = 0;
    reader.read("degrees", degrees, -360, 360);
    spec.environmentSettings.rotationRadians = static_cast<float>(glm::radians(degrees));
    EnvironmentSettings& settings = spec.environmentSettings;
    reader.read("skybox", settings.skybox);
    reader.read("groundHeightMeters", settings.groundHeightMeters, 0, 1e4);
    reader.read("groundLevelMeters", settings.groundLevelMeters, -1e6, 1e6);
    reader.read("groundRadiusMeters", settings.groundRadiusMeters, 0.01, 1e5);
    readOptions(reader, spec.environmentOptions);
}

void readAnimation(JsonReader& reader, SceneSpec& spec) {
    reader.read("index", spec.animation, 0, 1000);
    double seconds = 0;
    reader.read("seconds", seconds, -1e6, 1e6);
    spec.animationSeconds = seconds;
}

void readCamera(JsonReader& reader, SceneSpec& spec) {
    double3 eye(0.0);
    if (reader.has("eye")) {
        reader.read("eye", eye);
        spec.eye = eye;
    }
    reader.read("at", spec.at);
    reader.read("moves", spec.cameraMoves);
    reader.read("fovDegrees", spec.lens.verticalFovDegrees, 0.01, 179);
    reader.read("near", spec.lens.nearMeters, 1e-6, 1e6);
}

void readExposure(JsonReader& reader, Exposure& exposure) {
    reader.read("aperture", exposure.aperture, 0.1, 100);
    reader.read("shutter", exposure.shutterSeconds, 1e-6, 100);
    reader.read("iso", exposure.iso, 1, 1e6);
}

/// A path from the scene's folder.
void readLook(JsonReader& reader, SceneSpec& spec) {
    std::string file;
    reader.read("look", file);
    if (file.empty()) return;
    auto look = loadLook(spec.folder / file);
    if (!look) return reader.complain("look", look.error().message);
    spec.view.display.look = std::move(*look);
}

std::optional<TargetContents> contentsFromName(std::string_view name) {
    if (name == "keep") return TargetContents::Keep;
    if (name == "clear") return TargetContents::Clear;
    return std::nullopt;
}

std::optional<ViewBlending> blendingFromName(std::string_view name) {
    if (name == "opaque") return ViewBlending::Opaque;
    if (name == "translucent") return ViewBlending::Translucent;
    return std::nullopt;
}

void readViewport(JsonReader& reader, filament_core::Viewport& viewport) {
    reader.read("offset", viewport.offset);
    reader.choice("contents", viewport.contents, "keep or clear", contentsFromName);
    reader.choice("blending", viewport.blending, "opaque or translucent", blendingFromName);
    reader.read("clear", viewport.clearColor);
}

void readSize(JsonReader& reader, const char* name, uint2& size) {
    reader.read(name, size);
    if (size.x < 1 || size.y < 1 || size.x > 4096 || size.y > 4096)
        reader.complain(name, "expected 1 to 4096 pixels a side");
}

void readView(JsonReader& reader, SceneSpec& spec) {
    View& view = spec.view;
    readSize(reader, "size", view.size);
    if (reader.has("target")) readSize(reader, "target", spec.target);
    if (reader.has("viewport"))
        reader.object("viewport", [&](JsonReader& r) { readViewport(r, view.viewport.emplace()); });
    uint32_t samples = 1;
    reader.read("samples", samples, 1, 4);
    if (samples != 1 && samples != 4) reader.complain("samples", "expected 1 or 4");
    view.samples = static_cast<uint8_t>(samples);
    reader.read("occlusionCulling", view.occlusionCulling);
    reader.read("lod.pixels", view.lod.pixels, 0, LevelsOfDetail::kMostPixels);
    readOptions(reader, view.display);
    readLook(reader, spec);
    reader.choice("debugView", view.debugView, listed(enumNames<DebugView>()).c_str(), enumFromName<DebugView>);
    reader.read("clear", view.clearColor);
    readBits(reader, "layers", view.visibleLayers);
    reader.read("linear", spec.linear);
    reader.read("frames", spec.frames, 1, 64);
    reader.read("secondsPerFrame", spec.secondsPerFrame, 0, 1e6);
}

/// A path from the scene's folder.
void readDirt(JsonReader& reader, SceneSpec& spec) {
    std::string file;
    reader.read("bloom.dirt", file);
    if (!file.empty()) spec.dirt = spec.folder / file;
}

/// Its view is the main one except for its own fields.
void readOverlay(JsonReader& reader, SceneSpec& spec) {
    OverlaySpec& overlay = spec.overlays.emplace_back(OverlaySpec{ .view = spec.view, .lens = spec.lens });
    readSize(reader, "size", overlay.view.size);
    reader.object("viewport", [&](JsonReader& r) { readViewport(r, overlay.view.viewport.emplace()); });
    reader.object("camera", [&](JsonReader& r) {
        r.read("eye", overlay.eye);
        r.read("at", overlay.at);
        r.read("fovDegrees", overlay.lens.verticalFovDegrees, 0.01, 179);
    });
    reader.read("clear", overlay.view.clearColor);
    readBits(reader, "layers", overlay.view.visibleLayers);
    reader.object("quality", [&](JsonReader& r) { readOptions(r, overlay.view.quality); });
    reader.object("effects", [&](JsonReader& r) { readOptions(r, overlay.view.effects); });
    const uint2 end = overlay.view.viewport ? overlay.view.viewport->offset + overlay.view.size : overlay.view.size;
    const uint2 target = spec.target.x > 0 ? spec.target : spec.view.size;
    if (!overlay.view.viewport || end.x > target.x || end.y > target.y)
        reader.complain("viewport", "expected one whose offset and size lie in the picture");
}

std::optional<ComparatorKind> comparatorFromName(std::string_view name) {
    if (name == "bits") return ComparatorKind::Bits;
    if (name == "tolerance") return ComparatorKind::Tolerance;
    if (name == "flip") return ComparatorKind::Flip;
    return std::nullopt;
}

void readComparator(JsonReader& reader, Comparator& comparator) {
    reader.choice("kind", comparator.kind, "bits, tolerance or flip", comparatorFromName);
    reader.read("tolerance", comparator.tolerance, 0, 255);
    reader.read("mean", comparator.flipMean, 0, 1);
    reader.read("p99", comparator.flipP99, 0, 1);
}

void readModel(JsonReader& reader, SceneSpec& spec) {
    Json const* model = reader.raw("model");
    if (!model)
        reader.complain("model", "a scene needs one: a path, \"asset:PATH\" or { \"objects\": [...] }");
    else if (model->is_string())
        spec.modelPath = model->get<std::string>();
    else
        spec.modelObject = std::make_shared<const Json>(*model);
}

void readLights(JsonReader& reader, SceneSpec& spec) {
    // The files of a light have its place in lists of their own.
    std::string profile;
    LightImageFile image;
    const auto add = [&](LightDesc const& light) {
        spec.lights.push_back(light);
        spec.lightProfiles.resize(spec.lights.size()), spec.lightImages.resize(spec.lights.size());
        spec.lightProfiles.back() = std::exchange(profile, {});
        spec.lightImages.back() = std::exchange(image, {});
    };
    reader.objects("suns", [&](JsonReader& r) { add(readSun(r, image)); });
    reader.objects("points", [&](JsonReader& r) { add(readPoint(r, profile, image)); });
    reader.objects("spots", [&](JsonReader& r) { add(readSpot(r, profile, image)); });
    reader.objects("rects", [&](JsonReader& r) { add(readRect(r, image)); });
    reader.objects("discs", [&](JsonReader& r) { spec.lights.emplace_back(readDisc(r)); });
    reader.objects("tubes", [&](JsonReader& r) { spec.lights.emplace_back(readTube(r)); });
    spec.lightProfiles.resize(spec.lights.size()), spec.lightImages.resize(spec.lights.size());
}

Result<SceneSpec> readCase(Json const& json, std::filesystem::path const& file, std::string name) {
    SceneSpec spec{ .name = std::move(name), .folder = file.parent_path() };
    spec.view.size = { 256, 256 };
    spec.view.quality.shadows = ShadowFilter::Off; // scenes name what they test
    JsonReader reader(json, fmt::format("{} ({})", file.filename().string(), spec.name));
    reader.raw("description"); // ignored: for readers
    reader.raw("features");
    readModel(reader, spec);
    reader.object("environment", [&](JsonReader& r) { readEnvironment(r, spec); });
    reader.objects("probes", [&](JsonReader& r) { readProbe(r, spec.probes.emplace_back()); });
    reader.objects("grids", [&](JsonReader& r) { readGrid(r, spec.grids.emplace_back()); });
    reader.object("geometry", [&](JsonReader& r) { readOptions(r, spec.modelOptions); });
    reader.object("animation", [&](JsonReader& r) { readAnimation(r, spec); });
    readLights(reader, spec);
    reader.objects("copies", [&](JsonReader& r) { readCopy(r, spec); });
    if (spec.copies.empty()) {
        spec.copies.push_back(double4x4(1.0));
        spec.copyChannels.push_back(kDefaultLightChannels);
        spec.copyLayers.push_back(kDefaultLayers);
        spec.copyValues.emplace_back();
        spec.copyRasters.emplace_back();
        spec.copyMoves.emplace_back(0.0);
    }
    const bool hasValues = std::ranges::any_of(spec.copyValues, [](NamedWords const& words) { return !words.empty(); });
    const bool hasRasters = std::ranges::any_of(spec.copyRasters, &CopyRaster::isUsed);
    if ((hasValues || hasRasters) && !(spec.modelObject && spec.modelObject->contains("material")))
        reader.complain("copies", "'values' and raster states belong to a model that is a material");
    reader.read("origin", spec.origin);
    reader.object("camera", [&](JsonReader& r) { readCamera(r, spec); });
    reader.object("exposure", [&](JsonReader& r) { readExposure(r, spec.exposure); });
    reader.object("view", [&](JsonReader& r) { readView(r, spec); });
    reader.object("quality", [&](JsonReader& r) { readOptions(r, spec.view.quality); });
    reader.object("effects", [&](JsonReader& r) {
        readOptions(r, spec.view.effects);
        readDirt(r, spec);
    });
    reader.object("debug", [&](JsonReader& r) { readDebugDraw(r, spec.debugDraw); });
    reader.objects("overlays", [&](JsonReader& r) { readOverlay(r, spec); });
    reader.object("comparator", [&](JsonReader& r) { readComparator(r, spec.comparator); });
    reader.read("kills", spec.kills);
    if (const Result<void> done = reader.finish(); !done) return done.error();
    return spec;
}

Result<Json> parseFile(std::filesystem::path const& file) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    const auto* text = reinterpret_cast<const char*>(bytes->data());
    try {
        return Json::parse(text, text + bytes->size());
    } catch (Json::exception const& error) { // also a number beyond the range of double
        return fail(ErrorCode::Corrupt, "{}: {}", file.string(), error.what());
    }
}

} // namespace

Result<std::vector<SceneSpec>> readSceneFile(std::filesystem::path const& file) {
    const Result<Json> json = parseFile(file);
    if (!json) return json.error();
    const std::string name = file.stem().string();
    std::vector<SceneSpec> cases;
    Result<SceneSpec> plain = readCase(*json, file, name);
    if (!plain) return plain.error();
    cases.push_back(std::move(*plain));
    const auto features = json->find("features");
    if (features == json->end()) return cases;
    if (!features->is_object()) return fail(ErrorCode::InvalidArgument, "{}: features: expected an object", name);
    for (auto const& [feature, patch] : features->items()) {
        Json changed = *json;
        changed.erase("kills"); // not inherited: a feature lists its own
        changed.merge_patch(patch);
        Result<SceneSpec> one = readCase(changed, file, name + "/" + feature);
        if (!one) return one.error();
        cases.push_back(std::move(*one));
    }
    return cases;
}

Result<std::vector<SceneSpec>> readScenes(std::filesystem::path const& folder) {
    std::error_code error;
    std::vector<SceneSpec> all;
    std::filesystem::directory_iterator files(folder, error);
    if (error)
        return fail(ErrorCode::NotFound, "scene folder '{}': {}; give one with --scenes", folder.string(),
                    error.message());
    for (auto const& entry : files) {
        if (entry.path().extension() != ".json") continue;
        Result<std::vector<SceneSpec>> cases = readSceneFile(entry.path());
        if (!cases) return cases.error();
        for (SceneSpec& spec : *cases) all.push_back(std::move(spec));
    }
    if (all.empty()) return fail(ErrorCode::NotFound, "scene folder '{}' has no .json", folder.string());
    std::sort(all.begin(), all.end(), [](auto const& a, auto const& b) { return a.name < b.name; });
    return all;
}

} // namespace filament_core::tools
