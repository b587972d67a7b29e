// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/ShownScene.h"

#include "filament_core/scenebuild/SceneFileParts.h"

#include <filament_core/Options.h>
#include <filament_core/Sky.h>

#include <fmt/format.h>

namespace filament_core::tools {
namespace {

constexpr uint64_t kMaxObjects = 1'000'000; // a scene has 2^20 handles of a type

/// Every option, so that equal keys are equal files.
template <HasOptions T>
std::string keyOf(T const& options) {
    std::string key;
    for (Option const& option : optionsOf<T>()) key += optionValue(option, &options) + ' ';
    return key;
}

Result<std::shared_ptr<Environment>> captured(Engine& engine, Scene const& scene, ReflectionProbeDesc& place,
                                              View const& view, EnvironmentLoadOptions const& options) {
    Result<Environment> light = scenebuild::captureSceneProbe(engine, scene, place, view, options);
    if (!light) return light.error();
    return std::make_shared<Environment>(std::move(*light));
}

} // namespace

SceneLoader::SceneLoader(Engine& engine, SceneFolders folders, Keep keep)
        : mEngine(engine), mFolders(std::move(folders)), mKeep(keep) {}

template <class T, class Options, class Load>
Result<std::shared_ptr<T>> SceneLoader::load(Files<T>& files, std::filesystem::path const& path, Options const& options,
                                             Load const& loadFile) {
    const std::string loadedAs = keyOf(options), key = path.string() + " " + loadedAs;
    if (const auto found = files.find(key); found != files.end()) return found->second.file;
    if (mKeep == Keep::Last) files.clear();
    Result<T> loaded = loadFile(mEngine, path, options);
    if (!loaded) return loaded.error();
    Loaded<T>& kept = files[key];
    kept = { std::make_shared<T>(std::move(*loaded)), loadedAs == keyOf(Options{}) };
    return kept.file;
}

Result<void> SceneLoader::placeModel(ShownScene& shown, SceneSpec const& spec) {
    uint64_t nodesOfOne = 0;
    const std::vector<double4x4> places = placedCopies(spec);
    for (size_t i = 0; i < places.size(); ++i) {
        Scene& scene = shown.scene;
        const uint64_t nodes = scene.nodeCount();
        if (nodes + nodesOfOne > kMaxObjects || scene.renderableCount() + shown.model->renderableCount() > kMaxObjects)
            return fail(ErrorCode::InvalidArgument, "{}: copies: {} copies of the model are more than {} objects",
                        spec.name, spec.copies.size(), kMaxObjects);
        const Node root = shown.copies.emplace_back(scene.add(*shown.model, places[i]));
        if (i < spec.copyChannels.size() && spec.copyChannels[i] != kDefaultLightChannels)
            scene.setLightChannels(root, spec.copyChannels[i]);
        if (i < spec.copyLayers.size()) scene.setLayers(root, kAllLayers, spec.copyLayers[i]);
        if (i < spec.copyPlaces.size()) scene.setDrawOrder(root, spec.copyPlaces[i]);
        nodesOfOne = scene.nodeCount() - nodes;
    }
    return {};
}

Result<void> SceneLoader::loadModel(ShownScene& shown, SceneSpec const& spec, GltfLoadOptions const& options) {
    if (isMaterialModel(spec)) {
        Result<MaterialStand> stand = makeMaterialModel(mEngine, spec);
        if (!stand) return stand.error();
        shown.material = std::make_shared<MaterialStand>(std::move(*stand));
        return {};
    }
    const Result<std::filesystem::path> path = modelFile(spec, mFolders);
    if (!path) return path.error();
    GltfLoadOptions used = options;
    used.simplified |= spec.view.lod.pixels > 0;
    used.sectionPlanes |= spec.view.section.isUsed();
    Result<std::shared_ptr<Model>> model = load(mModels, *path, used, [](auto&... a) { return loadGltf(a...); });
    if (!model) return model.error();
    shown.model = std::move(*model);
    return {};
}

Result<void> SceneLoader::loadSky(ShownScene& shown, SceneSpec const& spec, EnvironmentLoadOptions const& options) {
    if (spec.sky) {
        Result<Environment> computed = filament_core::loadSky(mEngine, *spec.sky, options);
        if (!computed) return computed.error();
        shown.environment = std::make_shared<Environment>(std::move(*computed));
        return {};
    }
    const Result<std::filesystem::path> path = environmentFile(spec, mFolders);
    if (!path) return path.error();
    if (path->empty()) return {};
    Result<std::shared_ptr<Environment>> sky =
            load(mEnvironments, *path, options, [](auto&... a) { return loadEnvironment(a...); });
    if (!sky) return sky.error();
    shown.environment = std::move(*sky);
    return {};
}

/// All capture the scene before any of them lights it.
Result<void> SceneLoader::addProbes(ShownScene& shown, SceneSpec const& spec, EnvironmentLoadOptions const& options) {
    std::vector<ProbeSpec> probes = spec.probes;
    View view{ .quality = spec.view.quality };
    view.camera.exposure = spec.exposure;
    for (ProbeSpec& probe : probes) {
        probe.place.centerWorld += spec.origin;
        SceneSpec named = spec;
        named.environment = probe.file;
        const Result<std::filesystem::path> path = environmentFile(named, mFolders);
        if (!path) return path.error();
        Result<std::shared_ptr<Environment>> light =
                path->empty() ? captured(mEngine, shown.scene, probe.place, view, options)
                              : load(mEnvironments, *path, options, [](auto&... a) { return loadEnvironment(a...); });
        if (!light) return light.error();
        shown.probes.push_back(std::move(*light));
    }
    for (size_t i = 0; i < probes.size(); ++i) {
        probes[i].place.light = shown.probes[i]->indirectLight();
        shown.scene.add(probes[i].place);
    }
    return {};
}

Result<void> SceneLoader::place(ShownScene& shown, SceneSpec const& spec) {
    if (!shown.material) return placeModel(shown, spec);
    Result<std::vector<Node>> added = addMaterialCopies(mEngine, shown.scene, spec, *shown.material);
    if (!added) return added.error();
    shown.copies = std::move(*added);
    return {};
}

Result<ShownScene> SceneLoader::show(SceneSpec const& spec, GltfLoadOptions const& modelOptions,
                                     EnvironmentLoadOptions const& environmentOptions) {
    ShownScene shown{ .scene = Scene(mEngine) };
    if (Result<void> loaded = loadModel(shown, spec, modelOptions); !loaded) return loaded.error();
    if (Result<void> loaded = loadSky(shown, spec, environmentOptions); !loaded) return loaded.error();
    if (Result<void> placed = place(shown, spec); !placed) return placed.error();
    if (Result<void> added = addLights(mEngine, shown.scene, spec, mFolders); !added) return added.error();
    if (shown.environment)
        shown.scene.setEnvironment(*shown.environment, spec.environmentSettings);
    else if (shown.model && shown.model->environment())
        shown.scene.setEnvironment(*shown.model->environment(), spec.environmentSettings);
    if (Result<void> added = addProbes(shown, spec, environmentOptions); !added) return added.error();
    if (Result<void> added = addGrids(shown.scene, spec, mFolders); !added) return added.error();
    return shown;
}

void SceneLoader::forgetUnusual() {
    const auto isUnusual = [](auto const& entry) {
        return !entry.second.isUsual && entry.second.file.use_count() == 1;
    };
    std::erase_if(mModels, isUnusual);
    std::erase_if(mEnvironments, isUnusual);
}

} // namespace filament_core::tools
