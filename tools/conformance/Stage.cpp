// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Stage.h"

#include "base/Result.h"
#include "tools/materials/PictureFile.h"
#include "tools/materials/PlainMaterials.h"

#include <filament/Animator.h>
#include <filament/ModelCopy.h>
#include <fmt/core.h>
#include <glm/ext/matrix_transform.hpp>

namespace filament::conformance {
namespace {

constexpr uint64_t kMaxObjects = 1'000'000; // a scene has 2^20 handles of a type

// Equal texts mean that it is loaded already.
std::string keyOf(std::filesystem::path const& path, GltfLoadOptions const& options) {
    return fmt::format("{} {} {} {}", path.string(), toString(options.positions), toString(options.tangents),
                       options.allLevels);
}

std::string keyOf(std::filesystem::path const& path, EnvironmentLoadOptions const& options) {
    return fmt::format("{} {} {}", path.string(), toString(options.format), toString(options.roughnessMapping));
}

} // namespace

Result<std::unique_ptr<Stage>> Stage::open(StageOptions const& options, std::unique_ptr<backend::StreamEdit> edit,
                                           DefectSize size) {
    std::unique_ptr<DefectTrace> trace;
    if (edit) trace = std::make_unique<DefectTrace>(std::move(edit), size == DefectSize::Exaggerated);
    DefectTrace* const traced = trace.get();
    std::shared_ptr<backend::FrameCapture> capture;
    if (options.capture || trace) capture = std::make_shared<backend::FrameCapture>(std::move(trace));
    EngineOptions engineOptions{ .backend = options.backend, .requireDevice = options.requireDevice };
    engineOptions.workers = options.workers;
    engineOptions.affinity = options.affinity;
    engineOptions.exactShaders = options.exact;
    engineOptions.debug.plainMaterials = &tools::plainMaterial;
    engineOptions.validation = options.validation;
    engineOptions.cacheDirectory = options.work / "environments";
    engineOptions.debug.capture = capture;
    Result<Engine> engine = Engine::create(engineOptions);
    if (!engine) return engine.error();
    return std::unique_ptr<Stage>(new Stage(options, std::move(*engine), std::move(capture), traced));
}

Stage::Stage(StageOptions const& options, Engine engine, std::shared_ptr<backend::FrameCapture> capture,
             DefectTrace* trace)
        : mOptions(options), mEngine(std::move(engine)), mCapture(std::move(capture)), mTrace(trace),
          mRenderer(mEngine) {}

Result<void> Stage::loadModel(SceneSpec const& spec) {
    mMaterial.reset();
    if (isMaterialModel(spec)) {
        Result<tools::MaterialStand> stand = makeMaterialModel(mEngine, spec);
        if (!stand) return stand.error();
        mMaterial.emplace(std::move(*stand));
        return {};
    }
    const Result<std::filesystem::path> path = modelFile(spec, { mOptions.work, mOptions.assets });
    if (!path) return path.error();
    std::string key = keyOf(*path, spec.modelOptions);
    if (mModel && mModelKey == key) return {};
    mModel.reset();
    Result<Model> model = loadGltf(mEngine, *path, spec.modelOptions);
    if (!model) return model.error();
    mModel = std::move(*model);
    mModelKey = std::move(key);
    return {};
}

Result<void> Stage::loadSky(SceneSpec const& spec) {
    const Result<std::filesystem::path> path = environmentFile(spec, { mOptions.work, mOptions.assets });
    if (!path) return path.error();
    std::string key = keyOf(*path, spec.environmentOptions);
    if (path->empty() || mEnvironmentKey == key) return {};
    Result<Environment> environment = loadEnvironment(mEngine, *path, spec.environmentOptions);
    if (!environment) return environment.error();
    mEnvironment.reset();
    mEnvironment = std::move(*environment);
    mEnvironmentKey = std::move(key);
    return {};
}

/// Of the lens: into the view.
Result<void> Stage::loadDirt(SceneSpec const& spec) {
    mDirt.reset();
    if (spec.dirt.empty()) return {};
    Result<Owned<Texture>> dirt = tools::loadPictureTexture(mEngine, spec.dirt);
    if (!dirt) return fail(dirt.error().code, "{}: effects.bloom.dirt: {}", spec.name, dirt.error().message);
    mDirt = std::move(*dirt);
    mView.effects.bloom.dirt = mDirt;
    return {};
}

Result<void> Stage::placeModel(SceneSpec const& spec) {
    mCopies.clear();
    if (mMaterial) {
        Result<std::vector<Node>> added = addMaterialCopies(mEngine, *mScene, spec, *mMaterial);
        if (!added) return added.error();
        mCopies = std::move(*added);
        return {};
    }
    uint64_t nodesOfOne = 0;
    const std::vector<double4x4> copies = placedCopies(spec);
    for (size_t i = 0; i < copies.size(); ++i) {
        double4x4 const& copy = copies[i];
        const LightChannels channels = i < spec.copyChannels.size() ? spec.copyChannels[i] : kDefaultLightChannels;
        const uint64_t nodes = mScene->nodeCount();
        if (nodes + nodesOfOne > kMaxObjects || mScene->renderableCount() + mModel->renderableCount() > kMaxObjects) {
            return fail(ErrorCode::InvalidArgument, "{}: copies: {} copies of the model are more than {} objects",
                        spec.name, spec.copies.size(), kMaxObjects);
        }
        const Node root = mCopies.emplace_back(mScene->add(*mModel, copy));
        if (channels != kDefaultLightChannels) mScene->setLightChannels(root, channels);
        if (i < spec.copyLayers.size()) mScene->setLayers(root, kAllLayers, spec.copyLayers[i]);
        if (i < spec.copyPlaces.size()) mScene->setDrawPlace(root, spec.copyPlaces[i]);
        nodesOfOne = mScene->nodeCount() - nodes;
        if (!spec.animationSeconds) continue;
        if (spec.animation >= mModel->animationCount()) {
            return fail(ErrorCode::NotFound, "{}: animation.index: {} of {} animations", spec.name, spec.animation,
                        mModel->animationCount());
        }
    }
    return {};
}

Result<void> Stage::set(SceneSpec const& spec) {
    mScene.reset();
    if (mTrace) {
        mEngine.waitIdle();
        mTrace->begin();
    }
    if (Result<void> loaded = loadModel(spec); !loaded) return loaded;
    if (Result<void> loaded = loadSky(spec); !loaded) return loaded;
    mScene.emplace(mEngine);
    if (Result<void> placed = placeModel(spec); !placed) return placed;
    const SceneFolders folders{ mOptions.work, mOptions.assets };
    if (Result<void> added = addLights(mEngine, *mScene, spec, folders); !added) return added;
    if (!spec.environment.empty())
        mScene->setEnvironment(*mEnvironment, spec.environmentSettings);
    else if (mModel && !mMaterial && mModel->environment())
        mScene->setEnvironment(*mModel->environment(), spec.environmentSettings);
    mView = spec.view;
    if (Result<void> loaded = loadDirt(spec); !loaded) return loaded;
    mSpec = spec;
    setBack(0); // the camera frames what is posed
    mLastCamera = mView.camera = cameraOf(spec, mScene->bounds());
    mView.debugDraw = &mSpec.debugDraw;
    mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = spec.target.x > 0 ? spec.target : spec.view.size,
                                                        .imageCount = 1,
                                                        .format = spec.linear ? Format::RGBA16F : Format::RGBA8,
                                                        .name = "conformance" }));
    return {};
}

void Stage::setBack(uint32_t frames) {
    const auto back = [&](double3 const& moves) {
        return glm::translate(double4x4(1.0), moves * -static_cast<double>(frames));
    };
    const double seconds = -mSpec.secondsPerFrame * frames;
    const std::vector<double4x4> places = placedCopies(mSpec);
    for (size_t i = 0; i < mCopies.size(); ++i) {
        if (i < mSpec.copyMoves.size()) mScene->setTransform(mCopies[i], back(mSpec.copyMoves[i]) * places[i]);
        if (!mSpec.animationSeconds) continue;
        Animator(*mModel, *mScene, mCopies[i]).apply(mSpec.animation, *mSpec.animationSeconds + seconds);
    }
    mView.camera.worldFromView = back(mSpec.cameraMoves) * mLastCamera.worldFromView;
    mView.timeSeconds = mSpec.view.timeSeconds + seconds;
    if (mMaterial) return;
    for (const Node copy : mCopies) ModelCopy::of(*mScene, copy)->chooseLevels(mView);
}

/// Each with a renderer of its own: it is another camera's.
void Stage::drawOverlays() {
    for (OverlaySpec const& overlay : mSpec.overlays) {
        Renderer renderer(mEngine);
        View view = overlay.view;
        view.camera =
                Camera::lookAt(overlay.eye + mSpec.origin, overlay.at + mSpec.origin, overlay.lens, mSpec.exposure);
        renderer.render(*mScene, view, mTarget);
    }
}

Result<Shot> Stage::shoot(std::optional<backend::CaptureRequest> const& request) {
    for (uint32_t i = mSpec.frames - 1; i > 0; --i) {
        setBack(i);
        mRenderer.render(*mScene, mView, mTarget);
    }
    setBack(0);
    if (request && mCapture) {
        mEngine.waitIdle(); // earlier frames must not be affected by the request
        mCapture->arm(*request);
    }
    mRenderer.render(*mScene, mView, mTarget);
    drawOverlays();
    Result<Image> image = mRenderer.waitPixels(mRenderer.readPixels(mTarget));
    if (!image) return image.error();
    Shot shot{ .image = std::move(*image) };
    if (request && mCapture) {
        mEngine.waitIdle();
        shot.inside = mCapture->take();
    }
    shot.errors = mEngine.takeErrors();
    return shot;
}

DefectReach Stage::reach() {
    if (!mTrace) return {};
    mEngine.waitIdle();
    return mTrace->reach();
}

FrameSource insideOf(Stage& stage) {
    return [&stage](uint32_t drawLimit) -> Result<backend::CapturedFrame> {
        Result<Shot> shot = stage.shoot(backend::CaptureRequest{ .drawLimit = drawLimit });
        if (!shot) return shot.error();
        if (!shot->inside)
            return fail(ErrorCode::Internal, "{}: the frame was not captured", toString(stage.device().backend));
        return std::move(*shot->inside);
    };
}

} // namespace filament::conformance
