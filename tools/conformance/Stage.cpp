// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Stage.h"

#include "filament_core/assets/AnalyticSky.h"
#include "filament_core/assets/EnvironmentFile.h"
#include "filament_core/assets/ImageWriter.h"
#include "filament_core/base/Hash.h"
#include "tools/conformance/BuiltModel.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace filament::conformance {
namespace {

constexpr std::string_view kAsset = "asset:";
constexpr uint32_t kSkyHeight = 64; // smooth but for the horizon: enough for pictures of 256 pixels
constexpr float kSkyUnit = 22;      // klx: radiance 1 of the sky's file, as the showcase has it
const EnvironmentLoadOptions kEnvironment{ .faceSize = 64, .samples = 128 };

std::filesystem::path resolve(std::string const& name, SceneSpec const& spec, std::filesystem::path const& assets) {
    if (name.starts_with(kAsset)) return assets / name.substr(kAsset.size());
    return spec.folder / name;
}

/// One file name for each content: several processes may write it at once.
Result<std::filesystem::path> writeBuiltModel(SceneSpec const& spec, std::filesystem::path const& work) {
    const std::string name = spec.name.substr(0, spec.name.find('/'));
    Result<std::vector<std::byte>> bytes = buildModel(spec.model, name);
    if (!bytes) return bytes.error();
    const std::filesystem::path path = work / "models" / fmt::format("{}-{:016x}.glb", name, hashBytes(*bytes));
    if (std::filesystem::exists(path)) return path;
    if (const Result<void> written = assets::replaceFile(path, *bytes); !written) return written.error();
    return path;
}

Result<std::filesystem::path> writeSky(std::filesystem::path const& work) {
    const std::filesystem::path path = work / "sky.hdr";
    if (std::filesystem::exists(path)) return path;
    jobs::JobSystem jobs({ .workers = 0 });
    Result<assets::HdrImage> sky = assets::makeAnalyticSky(
            { .height = kSkyHeight, .groundAlbedo = { 0.30f, 0.29f, 0.27f }, .sunDisc = false }, jobs);
    if (!sky) return sky.error();
    for (float3& pixel : sky->pixels) pixel /= kSkyUnit;
    const std::filesystem::path own = work / fmt::format("sky-{}.hdr", static_cast<const void*>(&sky));
    if (const Result<void> written = assets::writeHdr(own, *sky); !written) return written.error();
    std::error_code error;
    std::filesystem::rename(own, path, error);
    if (error) return fail(ErrorCode::Unreadable, "{}: {}", path.string(), error.message());
    return path;
}

} // namespace

std::string missingFile(SceneSpec const& spec, std::filesystem::path const& assets) {
    const auto missing = [&](std::string const& name) {
        return !std::filesystem::exists(resolve(name, spec, assets)) ? name : std::string();
    };
    if (spec.model.is_string()) {
        if (std::string name = missing(spec.model.get<std::string>()); !name.empty()) return name;
    }
    return spec.environment.empty() || spec.environment == "sky" ? std::string() : missing(spec.environment);
}

Result<std::unique_ptr<Stage>> Stage::open(StageOptions const& options, std::unique_ptr<backend::StreamEdit> edit) {
    std::shared_ptr<backend::FrameCapture> capture;
    if (options.capture || edit) capture = std::make_shared<backend::FrameCapture>(std::move(edit));
    EngineOptions engineOptions{ .backend = options.backend, .requireDevice = options.requireDevice };
    engineOptions.workers = options.workers;
    engineOptions.affinity = options.affinity;
    engineOptions.cacheDirectory = options.work / "environments";
    engineOptions.debug.capture = capture;
    Result<Engine> engine = Engine::create(engineOptions);
    if (!engine) return engine.error();
    return std::unique_ptr<Stage>(new Stage(options, std::move(*engine), std::move(capture)));
}

Stage::Stage(StageOptions const& options, Engine engine, std::shared_ptr<backend::FrameCapture> capture)
        : mOptions(options), mEngine(std::move(engine)), mCapture(std::move(capture)), mRenderer(mEngine) {}

Result<void> Stage::loadModel(SceneSpec const& spec) {
    std::filesystem::path path;
    if (spec.model.is_string()) {
        path = resolve(spec.model.get<std::string>(), spec, mOptions.assets);
    } else {
        Result<std::filesystem::path> built = writeBuiltModel(spec, mOptions.work);
        if (!built) return built.error();
        path = std::move(*built);
    }
    if (mModel && mModelKey == path.string()) return {};
    mModel.reset();
    Result<Model> model = loadGltf(mEngine, path);
    if (!model) return model.error();
    mModel = std::move(*model);
    mModelKey = path.string();
    return {};
}

Result<void> Stage::loadSky(SceneSpec const& spec) {
    std::filesystem::path path;
    if (spec.environment == "sky") {
        Result<std::filesystem::path> sky = writeSky(mOptions.work);
        if (!sky) return sky.error();
        path = std::move(*sky);
    } else if (!spec.environment.empty()) {
        path = resolve(spec.environment, spec, mOptions.assets);
    }
    if (path.empty() || mEnvironmentKey == path.string()) return {};
    Result<Environment> environment = loadEnvironment(mEngine, path, kEnvironment);
    if (!environment) return environment.error();
    mEnvironment.reset();
    mEnvironment = std::move(*environment);
    mEnvironmentKey = path.string();
    return {};
}

void Stage::addLights(SceneSpec const& spec) {
    for (LightSpec const& light : spec.lights) {
        std::visit(
                [&](auto moved) {
                    if constexpr (requires { moved.positionWorld; }) moved.positionWorld += spec.origin;
                    mScene->add(moved);
                },
                light);
    }
}

// Where the scene does not say: from the front, a little from the right and above, all of the model in view.
void Stage::placeCamera(SceneSpec const& spec) {
    double3 eye, at;
    if (spec.eye) {
        eye = *spec.eye + spec.origin;
        at = spec.at + spec.origin;
    } else {
        const Box box = mScene->bounds();
        at = (box.min + box.max) * 0.5;
        const double radius = std::max(1e-3, glm::length(box.max - box.min) * 0.5);
        const double halfFov = glm::radians(static_cast<double>(spec.lens.verticalFovDegrees)) * 0.5;
        eye = at + glm::normalize(double3(0.45, 0.35, 1.0)) * (0.8 * radius / std::sin(halfFov));
    }
    mView.camera = Camera::lookAt(eye, at, spec.lens, spec.exposure);
}

Result<void> Stage::set(SceneSpec const& spec) {
    mScene.reset();
    if (Result<void> loaded = loadModel(spec); !loaded) return loaded;
    if (Result<void> loaded = loadSky(spec); !loaded) return loaded;
    mScene.emplace(mEngine);
    const double4x4 toOrigin = glm::translate(double4x4(1.0), spec.origin);
    for (double4x4 const& copy : spec.copies) mScene->add(*mModel, toOrigin * copy);
    addLights(spec);
    if (!spec.environment.empty()) mScene->setEnvironment(*mEnvironment, spec.environmentSettings);
    mView = spec.view;
    placeCamera(spec);
    mFrames = spec.frames;
    mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = spec.view.size,
                                                        .imageCount = 1,
                                                        .format = spec.linear ? Format::RGBA16F : Format::RGBA8,
                                                        .name = "conformance" }));
    return {};
}

Result<Shot> Stage::shoot(std::optional<backend::CaptureRequest> const& request) {
    for (uint32_t i = 1; i < mFrames; ++i) mRenderer.render(*mScene, mView, mTarget);
    if (request && mCapture) {
        mEngine.waitIdle(); // frames under way must not meet the request
        mCapture->arm(*request);
    }
    mRenderer.render(*mScene, mView, mTarget);
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

} // namespace filament::conformance
