// SPDX-License-Identifier: Apache-2.0
#include "tools/view/document/DocumentScene.h"

#include "toolkit/json/JsonFile.h"

#include <filament_core/Options.h>

#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <map>

namespace filament_core::view {
namespace {

using tools::Json;

/// Sets keys until one fails.
class SceneWriter {
public:
    explicit SceneWriter(SceneFile& file) : mFile(file) {}

    void set(std::string const& key, Json const& value) { keep(key, mFile.set(key, value.dump())); }
    void setFile(std::string const& key, std::filesystem::path const& file) {
        if (!file.empty()) set(key, std::filesystem::absolute(file).string());
    }
    /// Options that are not the defaults of a scene file.
    template <HasOptions T>
    void setOptions(std::string const& prefix, T const& options, T const& defaults) {
        for (Option const& option : optionsOf<T>()) {
            const std::string value = optionValue(option, &options);
            if (value != optionValue(option, &defaults)) set(prefix + std::string(option.name), value);
        }
    }
    void keep(std::string const& key, Result<void> const& done) {
        if (!done && mDone.ok()) mDone = fail(done.error().code, "{}: {}", key, done.error().message);
    }
    Result<void> const& done() const { return mDone; }

private:
    SceneFile& mFile;
    Result<void> mDone;
};

Json json(double3 const& v) { return { v.x, v.y, v.z }; }

void writeModel(SceneWriter& writer, Document const& document) {
    writer.setFile("model", document.model.file);
    if (document.model.file.empty()) return;
    writer.setOptions("geometry.", document.model.options, GltfLoadOptions{});
    if (!document.model.variant.empty()) writer.set("variant", document.model.variant);
    if (document.model.fit) writer.set("copies[0].fit", true);
    Playback const& playback = document.playback;
    if (!playback.animation) return;
    writer.set("animation.index", *playback.animation);
    writer.set("animation.seconds", playback.seconds);
}

void writeEnvironment(SceneWriter& writer, DocumentEnvironment const& environment, bool modelHasLight) {
    const SceneFileEnvironment defaults;
    if (!(environment.prefersModels && modelHasLight)) writer.setFile("environment.file", environment.file);
    writer.setOptions("environment.", environment.options, defaults.options);
    EnvironmentSettings const& settings = environment.settings;
    writer.set("environment.lux", static_cast<double>(settings.illuminance.value));
    writer.set("environment.degrees", glm::degrees(static_cast<double>(settings.rotationRadians)));
    writer.set("environment.skybox", settings.skybox);
    if (settings.groundHeightMeters <= 0) return;
    writer.set("environment.groundHeightMeters", static_cast<double>(settings.groundHeightMeters));
    writer.set("environment.groundLevelMeters", static_cast<double>(settings.groundLevelMeters));
    writer.set("environment.groundRadiusMeters", static_cast<double>(settings.groundRadiusMeters));
}

void writeLights(SceneWriter& writer, SceneFile& file, std::vector<DocumentLight> const& lights) {
    std::map<size_t, size_t> places; // of each kind of light
    for (DocumentLight const& light : lights) {
        if (!light.isOn) continue;
        writer.keep("lights", file.add(light.light));
        constexpr const char* kLists[] = { "suns", "points", "spots", "rects", "discs", "tubes" };
        const std::string key = fmt::format("{}[{}].", kLists[light.light.index()], places[light.light.index()]++);
        writer.setFile(key + "profile", light.profileFile);
        if (light.profileFile.empty()) continue;
        if (auto const* point = std::get_if<PointLight>(&light.light)) {
            writer.set(key + "direction", json(double3(point->directionWorld)));
            writer.set(key + "up", json(double3(point->upWorld)));
        } else if (auto const* spot = std::get_if<SpotLight>(&light.light)) {
            writer.set(key + "up", json(double3(spot->upWorld)));
        }
    }
}

void writeProbes(SceneWriter& writer, Document const& document) {
    size_t probes = 0, grids = 0;
    for (DocumentProbe const& probe : document.probes) {
        if (!probe.isOn || probe.file.empty()) continue;
        writer.set(fmt::format("probes[{}]", probes++), { { "at", json(probe.centerWorld) },
                                                          { "halfExtent", json(double3(probe.halfExtentMeters)) },
                                                          { "blend", probe.blendMeters },
                                                          { "intensity", probe.intensity },
                                                          { "diffuse", probe.lightsDiffuse },
                                                          { "name", probe.name },
                                                          { "file", std::filesystem::absolute(probe.file).string() } });
    }
    for (DocumentGrid const& grid : document.grids) {
        if (!grid.isOn || grid.file.empty()) continue;
        writer.set(fmt::format("grids[{}]", grids++),
                   { { "file", std::filesystem::absolute(grid.file).string() }, { "intensity", grid.intensity } });
    }
}

std::vector<std::string> missingOf(Document const& document) {
    std::vector<std::string> missing;
    const auto note = [&](bool isThere, const char* what) {
        if (isThere) missing.emplace_back(what);
    };
    note(!document.nodes.empty(), "edits of nodes");
    note(!document.materials.empty(), "edits of materials");
    note(!document.textures.empty(), "edits of textures");
    note(!document.modelLights.empty(), "edits of the model's lights");
    note(!document.morphs.empty(), "edits of morph targets");
    note(!document.bookmarks.empty(), "bookmarks");
    note(!document.paths.empty(), "camera paths");
    return missing;
}

} // namespace

Result<DocumentScene> sceneOf(Document const& document, bool modelHasLight) {
    DocumentScene scene{ .missing = missingOf(document) };
    SceneWriter writer(scene.file);
    writeModel(writer, document);
    writeEnvironment(writer, document.environment, modelHasLight);
    writeLights(writer, scene.file, document.lights);
    writeProbes(writer, document);
    writer.keep("camera", scene.file.setCamera(document.view.camera));
    View view = document.view;
    view.size = glm::clamp(view.size, uint2(1), uint2(4096)); // as files have it
    writer.keep("view", scene.file.setView(view));
    writer.setFile("view.look", document.look);
    writer.setFile("effects.bloom.dirt", document.dirt);
    if (!writer.done()) return writer.done().error();
    return scene;
}

} // namespace filament_core::view
