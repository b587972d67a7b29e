// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Stage.h"

#include "base/Result.h"
#include "toolkit/materials/PictureFile.h"
#include "toolkit/materials/PlainMaterials.h"

#include <filament_core/Animator.h>
#include <filament_core/ModelCopy.h>
#include <filament_core/TextureStreaming.h>
#include <fmt/core.h>
#include <glm/ext/matrix_transform.hpp>

namespace filament_core::conformance {
namespace {

SceneSpec withoutLights(SceneSpec spec) {
    spec.lights.clear(), spec.lightProfiles.clear(), spec.lightImages.clear();
    spec.probes.clear(), spec.grids.clear();
    return spec;
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
        : mEngine(std::move(engine)), mCapture(std::move(capture)), mTrace(trace), mRenderer(mEngine),
          mLoader(mEngine, { options.work, options.assets }, SceneLoader::Keep::Last) {}

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

Result<void> Stage::loadPasses(SceneSpec const& spec) {
    Result<tools::ScenePasses> passes = tools::ScenePasses::make(mEngine, spec.folder, spec.passes);
    if (!passes) return fail(passes.error().code, "{}: postProcess: {}", spec.name, passes.error().message);
    mPasses = std::move(*passes);
    mView.postProcess = mPasses.passes();
    return {};
}

Result<void> Stage::set(SceneSpec const& spec) {
    mShown.reset();
    if (mTrace) {
        mEngine.waitIdle();
        mTrace->begin();
    }
    Result<ShownScene> shown = mLoader.show(spec, spec.modelOptions, spec.environmentOptions);
    if (!shown) return shown.error();
    if (spec.animationSeconds && shown->model && spec.animation >= shown->model->animationCount())
        return fail(ErrorCode::NotFound, "{}: animation.index: {} of {} animations", spec.name, spec.animation,
                    shown->model->animationCount());
    mShown.emplace(std::move(*shown));
    mView = spec.view;
    if (Result<void> loaded = loadDirt(spec); !loaded) return loaded;
    if (Result<void> loaded = loadPasses(spec); !loaded) return loaded;
    mSpec = spec;
    setBack(0); // the camera frames what is posed
    mLastCamera = mView.camera = cameraOf(spec, mShown->scene.bounds());
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
    Scene& scene = mShown->scene;
    std::vector<Node> const& copies = mShown->copies;
    for (size_t i = 0; i < copies.size(); ++i) {
        if (i < mSpec.copyMoves.size()) scene.setTransform(copies[i], back(mSpec.copyMoves[i]) * places[i]);
        if (!mSpec.animationSeconds || !mShown->model) continue;
        Animator(*mShown->model, scene, copies[i]).apply(mSpec.animation, *mSpec.animationSeconds + seconds);
    }
    mView.camera.worldFromView = back(mSpec.cameraMoves) * mLastCamera.worldFromView;
    mView.timeSeconds = mSpec.view.timeSeconds + seconds;
    if (mShown->material) return;
    for (const Node copy : copies) ModelCopy::of(scene, copy)->chooseLevels(mView);
}

/// Each with a renderer of its own: it is another camera's.
void Stage::drawOverlays() {
    for (OverlaySpec const& overlay : mSpec.overlays) {
        Renderer renderer(mEngine);
        View view = overlay.view;
        view.camera =
                Camera::lookAt(overlay.eye + mSpec.origin, overlay.at + mSpec.origin, overlay.lens, mSpec.exposure);
        renderer.render(mShown->scene, view, mTarget);
    }
}

/// Streamed textures arrive with later frames, however long their files take.
void Stage::settleTextures() {
    if (textureResidency(mEngine).textures == 0) return;
    setBack(mSpec.frames - 1);
    Renderer renderer(mEngine); // which leaves no history
    do renderer.render(mShown->scene, mView, mTarget);
    while (waitForTextures(mEngine));
}

Result<Shot> Stage::shoot(std::optional<backend::CaptureRequest> const& request) {
    settleTextures();
    for (uint32_t i = mSpec.frames - 1; i > 0; --i) {
        setBack(i);
        mRenderer.render(mShown->scene, mView, mTarget);
    }
    setBack(0);
    mPasses.drawTextures(mRenderer, mShown->scene, mView);
    if (request && mCapture) {
        mEngine.waitIdle(); // earlier frames must not be affected by the request
        mCapture->arm(*request);
    }
    mRenderer.render(mShown->scene, mView, mTarget);
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

Result<ShareVerdict> Stage::shares() {
    settleTextures();
    setBack(0);
    Result<ShareVerdict> verdict = checkShares(mEngine, mShown->scene, mView, mSpec.frames);
    if (!verdict || verdict->tally.pictures == 0) return verdict;
    const SceneSpec lit = mSpec;
    if (Result<void> unlit = set(withoutLights(lit)); !unlit) return unlit.error();
    mShown->scene.setIndirectLight({}, Lux{ 0 });
    settleTextures();
    setBack(0);
    Result<void> compared = compareEmission(mEngine, mShown->scene, mView, mSpec.frames, *verdict);
    if (compared) compared = set(lit);
    if (!compared) return compared.error();
    return verdict;
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

} // namespace filament_core::conformance
