// SPDX-License-Identifier: Apache-2.0
#include "tools/view/document/SceneDocument.h"

#include <algorithm>

namespace filament_core::view {
namespace {

/// What a document cannot show; empty: nothing.
std::string unshown(SceneFileContents const& scene) {
    if (scene.models.size() > 1) return "models: it shows one";
    if (scene.environment.sky) return "environment.sky: it shows files";
    if (scene.origin != double3(0.0)) return "origin: it has none";
    if (!scene.overlays.empty()) return "overlays: it has none";
    for (SceneFileModel const& model : scene.models) {
        if (!model.object.empty()) return "model: it shows files";
        if (model.copies.size() > 1 || model.copies[0].worldFromModel != double4x4(1.0)) return "copies: it shows one";
    }
    for (SceneFileLight const& light : scene.lights)
        if (!light.image.empty()) return "images of lights: it has none";
    for (SceneFileProbe const& probe : scene.probes)
        if (probe.file.empty() || probe.place.worldFromBox != float3x3(1.0f))
            return "probes: it shows those of files, along the axes of the world";
    for (SceneFileGrid const& grid : scene.grids)
        if (grid.file.empty()) return "grids: it shows those of files";
    return {};
}

/// Paths from the folder of a file.
class Paths {
public:
    explicit Paths(SceneFile const& file) : mFolder(file.folder()) {}
    std::filesystem::path of(std::string const& name) {
        if (name.starts_with("asset:")) mAsset = name;
        return name.empty() ? std::filesystem::path() : mFolder / name;
    }
    std::string const& asset() const { return mAsset; } ///< the last name that is no path

private:
    std::filesystem::path mFolder;
    std::string mAsset;
};

void readModel(Document& document, SceneFileModel const& model, Paths& paths) {
    document.model = { .file = paths.of(model.file),
                       .options = model.options,
                       .fit = model.copies[0].isFitted,
                       .variant = model.variant };
    if (!model.animationSeconds) return;
    document.playback.animation = model.animation;
    document.playback.seconds = *model.animationSeconds;
}

void readLight(Document& document, SceneFileLight const& light, Paths& paths) {
    constexpr const char* kNames[] = { "sun", "point", "spot", "rectangle", "disc", "tube" };
    const auto ofKind = std::ranges::count_if(
            document.lights, [&](DocumentLight const& other) { return other.light.index() == light.light.index(); });
    document.lights.push_back({ .name = fmt::format("{} {}", kNames[light.light.index()], ofKind + 1),
                                .light = light.light,
                                .profileFile = paths.of(light.profile) });
}

void readProbes(Document& document, SceneFileContents const& scene, Paths& paths) {
    for (SceneFileProbe const& probe : scene.probes)
        document.probes.push_back({ .name = probe.place.name,
                                    .centerWorld = probe.place.centerWorld,
                                    .halfExtentMeters = probe.place.halfExtentMeters,
                                    .blendMeters = probe.place.blendMeters,
                                    .file = paths.of(probe.file),
                                    .intensity = probe.place.intensity,
                                    .lightsDiffuse = probe.place.lightsDiffuse });
    for (SceneFileGrid const& grid : scene.grids)
        document.grids.push_back({ .file = paths.of(grid.file), .intensity = grid.grid.intensity });
}

void readView(Document& document, SceneFileContents const& scene) {
    constexpr double3 kUsualEye{ 0.9, 0.6, 1.5 }; // that of makeDocument()
    document.view = scene.view;
    document.view.viewport.reset();
    document.view.camera = Camera::lookAt(scene.camera.eye.value_or(kUsualEye), scene.camera.at, scene.camera.lens,
                                          scene.exposure, scene.camera.up);
}

} // namespace

Result<Document> documentOf(SceneFile const& file) {
    SceneFileContents const& scene = file.contents();
    if (const std::string key = unshown(scene); !key.empty())
        return fail(ErrorCode::Unsupported, "{}: the viewer does not show this scene file: {}", file.name(), key);
    Document document;
    Paths paths(file);
    if (!scene.models.empty()) readModel(document, scene.models.front(), paths);
    document.environment = { .file = paths.of(scene.environment.file),
                             .prefersModels = scene.environment.file.empty(),
                             .options = scene.environment.options,
                             .settings = scene.environment.settings };
    for (SceneFileLight const& light : scene.lights) readLight(document, light, paths);
    readProbes(document, scene, paths);
    readView(document, scene);
    document.look = paths.of(scene.look);
    document.dirt = paths.of(scene.dirt);
    if (!paths.asset().empty())
        return fail(ErrorCode::Unsupported, "{}: the viewer has no folder of assets for '{}'", file.name(),
                    paths.asset());
    if (const Result<void> done = check(document); !done)
        return fail(done.error().code, "{}: {}", file.name(), done.error().message);
    return document;
}

} // namespace filament_core::view
