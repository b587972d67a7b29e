// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/SceneFile.h"

#include "toolkit/json/JsonFile.h"

#include <filament_core/Look.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace filament_core::tools {
namespace {

Result<void> readModel(SceneSpec& spec, std::vector<SceneFileModel> const& models) {
    if (models.size() != 1)
        return fail(ErrorCode::InvalidArgument,
                    "{}: model: a scene needs one: a path, \"asset:PATH\" or {{ \"objects\": [...] }}", spec.name);
    SceneFileModel const& model = models.front();
    spec.modelPath = model.file;
    if (!model.object.empty()) {
        Result<Json> object = parseJson(model.object, spec.name);
        if (!object) return object.error();
        spec.modelObject = std::make_shared<const Json>(std::move(*object));
    }
    spec.modelOptions = model.options;
    spec.animationSeconds = model.animationSeconds;
    spec.animation = model.animation;
    if (std::ranges::any_of(model.copies, &SceneFileCopy::isFitted))
        return fail(ErrorCode::InvalidArgument, "{}: copies: 'fit' is not compared", spec.name);
    for (SceneFileCopy const& copy : model.copies) {
        spec.copies.push_back(copy.worldFromModel);
        spec.copyChannels.push_back(copy.lightChannels);
        spec.copyLayers.push_back(copy.layers);
        spec.copyPlaces.push_back(copy.drawOrder);
        spec.copyValues.push_back(copy.values);
        spec.copyRasters.push_back(copy.raster);
        spec.copyMoves.push_back(copy.metersPerFrame);
    }
    return {};
}

void readView(SceneSpec& spec, SceneFile const& file) {
    SceneFileContents const& scene = file.contents();
    spec.cameraMoves = scene.camera.metersPerFrame;
    spec.eye = scene.camera.eye;
    spec.at = scene.camera.at;
    spec.lens = scene.camera.lens;
    spec.exposure = scene.exposure;
    spec.view = scene.view;
    spec.target = scene.target;
    for (SceneFileOverlay const& overlay : scene.overlays)
        spec.overlays.push_back({ overlay.view, *overlay.camera.eye, overlay.camera.at, overlay.camera.lens });
    spec.debugDraw = scene.debug;
    if (!scene.dirt.empty()) spec.dirt = file.folder() / scene.dirt;
    spec.passes = scene.passes;
    spec.linear = scene.isLinear;
    spec.frames = scene.frames;
    spec.secondsPerFrame = scene.secondsPerFrame;
}

} // namespace

Result<SceneSpec> specOf(SceneFile const& file) {
    SceneFileContents const& scene = file.contents();
    SceneSpec spec{ .name = file.name(), .folder = file.folder() };
    if (const Result<void> read = readModel(spec, scene.models); !read) return read.error();
    spec.environment = scene.environment.file;
    spec.sky = scene.environment.sky;
    spec.environmentSettings = scene.environment.settings;
    spec.environmentOptions = scene.environment.options;
    spec.probes = scene.probes;
    spec.grids = scene.grids;
    for (SceneFileLight const& light : scene.lights) {
        spec.lights.push_back(light.light);
        spec.lightProfiles.push_back(light.profile);
        spec.lightImages.push_back({ light.image, light.imageShape });
    }
    spec.origin = scene.origin;
    readView(spec, file);
    spec.comparator = scene.comparison;
    spec.kills = scene.comparison.kills;
    if (scene.look.empty()) return spec;
    auto look = loadLook(file.folder() / scene.look);
    if (!look) return fail(look.error().code, "{}: view: look: {}", spec.name, look.error().message);
    spec.view.display.look = std::move(*look);
    for (OverlaySpec& overlay : spec.overlays) overlay.view.display.look = spec.view.display.look;
    return spec;
}

Result<std::vector<SceneSpec>> readSceneFile(std::filesystem::path const& file) {
    const Result<SceneFile> scene = SceneFile::load(file);
    if (!scene) return scene.error();
    std::vector<SceneSpec> cases;
    const auto add = [&](SceneFile const& one) -> Result<void> {
        Result<SceneSpec> spec = specOf(one);
        if (!spec) return fail(spec.error().code, "{}: {}", file.filename().string(), spec.error().message);
        cases.push_back(std::move(*spec));
        return {};
    };
    if (const Result<void> added = add(*scene); !added) return added.error();
    for (std::string const& feature : scene->featureNames()) {
        const Result<SceneFile> changed = scene->feature(feature);
        if (!changed) return changed.error();
        if (const Result<void> added = add(*changed); !added) return added.error();
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
