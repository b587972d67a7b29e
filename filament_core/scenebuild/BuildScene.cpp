// SPDX-License-Identifier: Apache-2.0
#include <filament_core/BuildScene.h>

#include "base/OutOfMemory.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/scenebuild/SceneFileParts.h"
#include "filament_core/scenebuild/SceneFilePasses.h"

#include <filament_core/Animator.h>
#include <filament_core/Image.h>
#include <filament_core/Look.h>
#include <filament_core/ModelCopy.h>
#include <filament_core/ReflectionProbe.h>
#include <filament_core/Sky.h>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>

namespace filament_core {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMostObjects = 1'000'000; // a scene has 2^20 handles of a type
constexpr std::string_view kAsset = "asset:";

class SceneBuilder {
public:
    SceneBuilder(Engine& engine, SceneFile const& file, SceneBuildOptions const& options)
            : mEngine(engine), mFile(file), mContents(file.contents()), mOptions(options) {}

    Result<BuiltScene> build() {
        BuiltScene built{ .scene = Scene(mEngine), .view = mContents.view };
        built.contents = mContents;
        for (const Step step : { &SceneBuilder::addModels, &SceneBuilder::addEnvironment, &SceneBuilder::addLights,
                                 &SceneBuilder::addProbes, &SceneBuilder::addGrids, &SceneBuilder::setView,
                                 &SceneBuilder::addPasses, &SceneBuilder::addOverlays }) {
            const Result<void> done = (this->*step)(built);
            if (!done) return fail(done.error().code, "{}: {}", mFile.name(), done.error().message);
        }
        return built;
    }

private:
    using Step = Result<void> (SceneBuilder::*)(BuiltScene& built);

    /// Empty for an empty name.
    Result<fs::path> pathOf(SceneFileKind kind, std::string const& name) const {
        if (name.empty()) return fs::path();
        if (mOptions.find) {
            Result<std::optional<fs::path>> found = mOptions.find({ kind, name });
            if (!found) return found.error();
            if (*found) return std::move(**found);
        }
        if (kind == SceneFileKind::Object)
            return fail(ErrorCode::Unsupported,
                        "model: an object needs a program that builds it (SceneBuildOptions::find); name a file");
        if (!name.starts_with(kAsset)) return mFile.folder() / name;
        if (mOptions.assets.empty())
            return fail(ErrorCode::NotFound, "'{}': there is no folder of assets (SceneBuildOptions::assets)", name);
        return mOptions.assets / name.substr(kAsset.size());
    }

    Result<Model> loadModel(SceneFileModel const& model) const {
        const Result<fs::path> path = model.file.empty() ? pathOf(SceneFileKind::Object, model.object)
                                                         : pathOf(SceneFileKind::Model, model.file);
        if (!path) return path.error();
        GltfLoadOptions options = model.options;
        options.simplified |= mContents.view.lod.pixels > 0;
        options.sectionPlanes |= mContents.view.section.isUsed();
        return loadGltf(mEngine, *path, options);
    }

    Result<void> addModels(BuiltScene& built) {
        for (SceneFileModel const& model : mContents.models) {
            Result<Model> loaded = loadModel(model);
            if (!loaded) return loaded.error();
            if (model.animationSeconds && model.animation >= loaded->animationCount())
                return fail(ErrorCode::InvalidArgument, "animation.index: {} of {} animations", model.animation,
                            loaded->animationCount());
            built.models.push_back(std::move(*loaded));
            built.copies.emplace_back();
            built.places.emplace_back();
            uint64_t nodesOfOne = 0;
            for (SceneFileCopy const& copy : model.copies) {
                const uint64_t nodes = built.scene.nodeCount();
                const uint64_t drawn = built.scene.renderableCount() + built.models.back().renderableCount();
                if (std::max(nodes + nodesOfOne, drawn) > kMostObjects)
                    return fail(ErrorCode::InvalidArgument, "copies: {} copies of the model are more than {} objects",
                                model.copies.size(), kMostObjects);
                if (const Result<void> added = addCopy(built, model, copy); !added) return added.error();
                nodesOfOne = built.scene.nodeCount() - nodes;
            }
        }
        return {};
    }

    Result<void> addCopy(BuiltScene& built, SceneFileModel const& model, SceneFileCopy const& copy) const {
        Scene& scene = built.scene;
        double4x4 place = glm::translate(double4x4(1.0), mContents.origin) * copy.worldFromModel;
        if (copy.isFitted) place = place * fitToUnitCube(built.models.back().bounds());
        built.places.back().push_back(place);
        const Node root = built.copies.back().emplace_back(scene.add(built.models.back(), place));
        if (copy.lightChannels != kDefaultLightChannels) scene.setLightChannels(root, copy.lightChannels);
        scene.setLayers(root, kAllLayers, copy.layers);
        scene.setDrawOrder(root, copy.drawOrder);
        if (!model.variant.empty())
            if (const Result<void> set = scene.setVariant(root, model.variant); !set) return set.error();
        if (model.animationSeconds)
            Animator(built.models.back(), scene, root).apply(model.animation, *model.animationSeconds);
        return {};
    }

    Result<void> addEnvironment(BuiltScene& built) {
        SceneFileEnvironment const& wanted = mContents.environment;
        if (wanted.sky) {
            Result<Environment> sky = loadSky(mEngine, *wanted.sky, wanted.options);
            if (!sky) return sky.error();
            built.environment.emplace(std::move(*sky));
        } else if (!wanted.file.empty()) {
            Result<Environment> loaded = loadEnvironmentOf(wanted.file);
            if (!loaded) return loaded.error();
            built.environment.emplace(std::move(*loaded));
        }
        Environment const* shown = built.environment ? &*built.environment : nullptr;
        if (!shown && !built.models.empty()) shown = built.models.front().environment();
        if (shown) built.scene.setEnvironment(*shown, wanted.settings);
        return {};
    }

    Result<Environment> loadEnvironmentOf(std::string const& name) const {
        const Result<fs::path> path = pathOf(SceneFileKind::Environment, name);
        if (!path) return path.error();
        return loadEnvironment(mEngine, *path, mContents.environment.options);
    }

    Result<void> addLights(BuiltScene& built) {
        scenebuild::SceneFileLights lights(mEngine, built.scene);
        for (SceneFileLight const& light : mContents.lights) {
            const Result<fs::path> profile = pathOf(SceneFileKind::Profile, light.profile);
            if (!profile) return profile.error();
            const Result<fs::path> image = pathOf(SceneFileKind::Image, light.image);
            if (!image) return image.error();
            LightDesc placed = light.light;
            scenebuild::moveBy(mContents.origin, placed);
            if (const Result<void> added = lights.add(placed, *profile, *image, light.imageShape); !added)
                return added.error();
        }
        return {};
    }

    /// All capture the scene before any of them lights it.
    Result<void> addProbes(BuiltScene& built) {
        View view{ .quality = mContents.view.quality };
        view.camera.exposure = mContents.exposure;
        std::vector<ReflectionProbeDesc> places;
        for (SceneFileProbe const& probe : mContents.probes) {
            ReflectionProbeDesc& place = places.emplace_back(probe.place);
            place.centerWorld += mContents.origin;
            Result<Environment> light = probe.file.empty()
                                                ? scenebuild::captureSceneProbe(mEngine, built.scene, place, view,
                                                                                mContents.environment.options)
                                                : loadEnvironmentOf(probe.file);
            if (!light) return light.error();
            built.probes.push_back(std::move(*light));
        }
        for (size_t i = 0; i < places.size(); ++i) {
            places[i].light = built.probes[i].indirectLight();
            built.scene.add(places[i]);
        }
        return {};
    }

    Result<void> addGrids(BuiltScene& built) {
        for (SceneFileGrid const& grid : mContents.grids) {
            const Result<fs::path> path = pathOf(SceneFileKind::Grid, grid.file);
            if (!path) return path.error();
            Result<IrradianceGridDesc> desc = scenebuild::readSceneGrid(grid, *path);
            if (!desc) return desc.error();
            desc->centerWorld += mContents.origin;
            built.scene.add(*desc);
        }
        return {};
    }

    Result<void> setView(BuiltScene& built) {
        View& view = built.view;
        view.camera =
                scenebuild::cameraOf(mContents.camera, mContents.origin, mContents.exposure, built.scene.bounds());
        built.lastCamera = view.camera;
        built.debug = std::make_unique<DebugDraw>(mContents.debug);
        view.debugDraw = built.debug.get();
        for (std::vector<Node> const& copies : built.copies)
            for (const Node copy : copies) ModelCopy::of(built.scene, copy)->chooseLevels(view);
        if (!mContents.look.empty()) {
            const Result<fs::path> path = pathOf(SceneFileKind::Look, mContents.look);
            if (!path) return path.error();
            auto look = loadLook(*path);
            if (!look) return look.error();
            view.display.look = std::move(*look);
        }
        return mContents.dirt.empty() ? Result<void>() : loadDirt(built);
    }

    Result<void> addPasses(BuiltScene& built) {
        const auto imagePath = [&](std::string const& name) { return pathOf(SceneFileKind::Image, name); };
        for (SceneFilePass const& pass : mContents.passes) {
            const Result<fs::path> path = pathOf(SceneFileKind::Pass, pass.material);
            if (!path) return path.error();
            const bool isText = path->extension() == ".mat";
            if (isText && !mOptions.compile)
                return fail(
                        ErrorCode::Unsupported,
                        "postProcess: '{}' is the text of a material: compile it with matc, and name the package, or "
                        "set SceneBuildOptions::compile",
                        pass.material);
            const Result<std::vector<std::byte>> package =
                    isText ? mOptions.compile(*path) : assets::readFileBytes(*path);
            if (!package) return package.error();
            const Result<void> added =
                    scenebuild::addPass(mEngine, pass, *package, path->stem().string(), imagePath, built);
            if (!added) return fail(added.error().code, "postProcess: {}", added.error().message);
        }
        built.view.postProcess = built.passes;
        return {};
    }

    Result<void> addOverlays(BuiltScene& built) {
        for (SceneFileOverlay const& overlay : mContents.overlays) {
            View& view = built.overlays.emplace_back(overlay.view);
            view.camera =
                    scenebuild::cameraOf(overlay.camera, mContents.origin, mContents.exposure, built.scene.bounds());
            view.display.look = built.view.display.look;
        }
        return {};
    }

    Result<void> loadDirt(BuiltScene& built) {
        const Result<fs::path> path = pathOf(SceneFileKind::Image, mContents.dirt);
        if (!path) return path.error();
        const Result<Image> image = loadImage(*path);
        if (!image) return image.error();
        if (std::max(image->width, image->height) > mEngine.device().maxTextureSize)
            return fail(ErrorCode::Unsupported, "effects.bloom.dirt: '{}' is larger than {} pixels a side",
                        path->string(), mEngine.device().maxTextureSize);
        built.dirt = mEngine.own(mEngine.create(textureOf(*image, mContents.dirt)));
        built.view.effects.bloom.dirt = built.dirt;
        return {};
    }

    Engine& mEngine;
    SceneFile const& mFile;
    SceneFileContents const& mContents;
    SceneBuildOptions const& mOptions;
};

} // namespace

Result<BuiltScene> buildScene(Engine& engine, SceneFile const& file, SceneBuildOptions const& options) {
    return orOutOfMemory("scene file", file.name(), [&] { return SceneBuilder(engine, file, options).build(); });
}

} // namespace filament_core
