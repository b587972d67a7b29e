// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/interiors/InteriorFiles.h"

#include "base/Hash.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/HdrReader.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/ChildProcess.h"
#include "toolkit/program/Interrupt.h"
#include "tools/accuracy/TracedPicture.h"
#include "tools/accuracy/interiors/WithoutMaterial.h"
#include "tools/reference/ProbeCube.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

namespace filament_core::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kProbeSize = 64;

Result<void> writeText(fs::path const& path, std::string const& text) {
    return assets::replaceFile(path, std::as_bytes(std::span(text.data(), text.size())));
}

class Maker {
public:
    Maker(InteriorCase const& one, InteriorSettings const& settings, SceneFolders const& folders, jobs::JobSystem& jobs,
          std::function<void(std::string const&)> const& step)
            : mCase(one), mSettings(settings), mFolders(folders), mJobs(jobs), mStep(step),
              mFolder(folders.work / one.name) {}

    Result<InteriorFiles> make() {
        if (auto done = findModel(); !done) return done.error();
        if (auto done = bakeLightmap(); !done) return done.error();
        if (auto done = bakeGrid(); !done) return done.error();
        for (size_t i = 0; i < mCase.probes.size(); ++i) {
            if (auto done = captureProbe(i); !done) return done.error();
        }
        for (size_t i = 0; i < mCase.cameras.size(); ++i) {
            if (auto done = tracePicture(i); !done) return done.error();
        }
        return std::move(mFiles);
    }

private:
    Result<void> findModel() {
        if (mCase.room) {
            const Result<interiors::InteriorFiles> files = writeInterior(*mCase.room, mFolder);
            if (!files) return files.error();
            mFiles.model = files->model, mFiles.environment = files->sky;
        } else {
            mFiles.environment = mFolders.assets / mCase.environment;
            const Result<std::vector<std::byte>> whole = assets::readFileBytes(mFolders.assets / mCase.asset);
            if (!whole) return whole.error();
            const Result<std::vector<std::byte>> part = withoutMaterial(*whole, mCase.without);
            if (!part) return fail(part.error().code, "{}: {}", mCase.asset, part.error().message);
            mFiles.model = mFolder / (mCase.name + ".glb");
            if (auto done = assets::replaceFile(mFiles.model, *part); !done) return done.error();
        }
        for (fs::path const& path : { mFiles.model, mFiles.environment }) {
            const Result<std::vector<std::byte>> bytes = assets::readFileBytes(path);
            if (!bytes) return bytes.error();
            mHash = hashBytes(*bytes, mHash);
        }
        return {};
    }

    /// What `path` depends on, in a file beside it.
    static fs::path keyFile(fs::path const& path) { return path.string() + ".key"; }
    std::string keyOf(std::string const& settings) const { return fmt::format("{:016x} {}", mHash, settings); }
    bool isKept(fs::path const& path, std::string const& settings) const {
        const Result<std::string> key = assets::readText(keyFile(path), 1u << 16);
        return key && *key == keyOf(settings) && fs::exists(path);
    }
    Result<void> keep(fs::path const& path, std::string const& settings) const {
        return writeText(keyFile(path), keyOf(settings));
    }

    /// `words`: after the model. `made`: the file that it writes.
    Result<void> bake(std::vector<std::string> const& words, fs::path const& made, std::string const& settings) {
        if (isKept(made, settings)) return {};
        Exposure const& exposure = mCase.exposure;
        ChildCommand command{ .words = { (buildDir() / "bin/filament-bake").string(), mFiles.model.string(),
                                         "--environment", mFiles.environment.string(), "--exposure",
                                         fmt::format("{}", exposure.aperture),
                                         fmt::format("{}", exposure.shutterSeconds), fmt::format("{}", exposure.iso),
                                         "--out", made.parent_path().string() },
                              .log = made.parent_path() / "log.txt" };
        command.words.insert(command.words.end(), words.begin(), words.end());
        std::error_code error;
        fs::create_directories(made.parent_path(), error);
        Result<ChildProcess> child = ChildProcess::start(command);
        if (!child) return child.error();
        std::optional<ChildEnd> end;
        while (!(end = child->poll())) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (end->signal == 0 && end->exitStatus == 0) return keep(made, settings);
        const Result<std::string> log = assets::readText(command.log, 1u << 20);
        return fail(ErrorCode::Unsupported, "filament-bake: {}: {}", end->text(), log ? *log : command.log.string());
    }

    Result<void> bakeLightmap() {
        mStep(mCase.name + ": bake the lightmap");
        mFiles.baked = mFolder / "lightmap/baked.glb";
        const std::string density = fmt::format("{:.6g}", mCase.texelsPerMeter / mSettings.coarseness),
                          samples = std::to_string(std::min(mCase.texelSamples, mSettings.mostSamples));
        const std::vector<std::string> words{ "--density", density, "--samples", samples };
        return bake(words, mFiles.baked, fmt::format("{} {}", density, samples));
    }

    Result<void> bakeGrid() {
        mStep(mCase.name + ": bake the grid");
        const auto list = [](auto const& v) { return Json::array({ v.x, v.y, v.z }); };
        const Json grid{ { "name", "room" },
                         { "at", list(mCase.grid.center) },
                         { "halfExtent", list(mCase.grid.half) },
                         { "spacing", mCase.gridSpacing * mSettings.coarseness },
                         { "maxProbes", mCase.mostProbes },
                         { "maxError", 0.05 },
                         { "paths", std::min(1024u, mSettings.mostSamples) } };
        mFiles.grid = mFolder / "grid/room.grid";
        const std::string text = grid.dump();
        if (auto done = writeText(mFolder / "grid/grid.json", text); !done) return done.error();
        return bake({ "--grid", (mFolder / "grid/grid.json").string() }, mFiles.grid, text);
    }

    SceneSpec plainScene(size_t camera) const {
        return sceneOf(mCase, mFiles, LightTechnique::Environment, camera, mSettings.size);
    }

    /// The scene for the path tracer, read when it is first needed. `skybox`: the camera sees the sky.
    Result<reference::TracedScene const*> traced(bool skybox) {
        reference::TracedScenePtr& kept = mScenes[skybox];
        if (kept) return kept.get();
        SceneSpec spec = plainScene(0);
        spec.environmentSettings.skybox = skybox;
        const Result<reference::ReferenceScene> scene = referenceSceneOf(spec, mFolders, mJobs);
        if (!scene) return scene.error();
        Result<reference::TracedScenePtr> prepared = reference::prepare(*scene, mJobs);
        if (!prepared) return prepared.error();
        kept = std::move(*prepared);
        return kept.get();
    }

    reference::ReferenceSettings pathSettings(uint32_t samples) const {
        return { .samplesPerPixel = std::min(samples, mSettings.mostSamples),
                 .filter = reference::PixelFilter::Center,
                 .bsdf = bsdfOf(View{}.quality) };
    }
    static bool isUninterrupted(reference::RenderProgress const&) { return !isInterrupted(); }
    static Result<void> checkInterrupted() {
        if (!isInterrupted()) return {};
        return fail(ErrorCode::Cancelled, "interrupted; the same command continues after what is finished");
    }

    Result<void> captureProbe(size_t index) {
        mStep(fmt::format("{}: trace probe {} of {}", mCase.name, index + 1, mCase.probes.size()));
        const fs::path path = mFiles.probes.emplace_back(mFolder / fmt::format("probe-{}.ktx2", index));
        const double3 at = mCase.probes[index].center;
        const reference::ReferenceSettings settings = pathSettings(128);
        const std::string key =
                fmt::format("{} {} {} {} {} sky", at.x, at.y, at.z, kProbeSize, settings.samplesPerPixel);
        if (isKept(path, key)) return {};
        const Result<reference::TracedScene const*> scene = traced(true);
        if (!scene) return scene.error();
        SceneSpec place = plainScene(0);
        place.eye = at, place.at = at - double3(0, 0, 1);
        const Result<std::vector<std::byte>> cube = reference::traceProbe(**scene, { .camera = cameraOf(place, {}) },
                                                                          kProbeSize, settings, mJobs, isUninterrupted);
        if (!cube) return cube.error();
        if (auto done = checkInterrupted(); !done) return done;
        if (auto done = assets::replaceFile(path, *cube); !done) return done.error();
        return keep(path, key);
    }

    Result<void> tracePicture(size_t camera) {
        mStep(fmt::format("{}: trace camera {} of {}", mCase.name, camera + 1, mCase.cameras.size()));
        const fs::path path = mFolder / fmt::format("traced-{}.exr", camera),
                       errors = mFolder / fmt::format("traced-{}-error.exr", camera);
        const reference::ReferenceSettings settings = pathSettings(mCase.samplesPerPixel);
        const SceneSpec spec = plainScene(camera);
        const std::string key =
                fmt::format("{} {} {} {} {} {} {} {} {}x{} {} {}", spec.eye->x, spec.eye->y, spec.eye->z, spec.at.x,
                            spec.at.y, spec.at.z, spec.lens.verticalFovDegrees, spec.exposure.factor(),
                            mSettings.size.x, mSettings.size.y, settings.samplesPerPixel, errors.filename().string());
        if (!isKept(path, key)) {
            const Result<reference::TracedScene const*> scene = traced(false);
            if (!scene) return scene.error();
            const Result<reference::ReferenceImage> image =
                    render(**scene, { .camera = cameraOf(spec, {}), .size = mSettings.size }, settings, mJobs,
                           isUninterrupted);
            if (!image) return image.error();
            if (auto done = checkInterrupted(); !done) return done;
            const auto write = [&](fs::path const& file, std::vector<float3> const& pixels) {
                return assets::writeExr(file, image->width, image->height, pixels, assets::ExrPrecision::Float);
            };
            if (auto done = write(path, image->color); !done) return done;
            if (auto done = write(errors, image->standardError); !done) return done;
            if (auto done = keep(path, key); !done) return done;
        }
        Result<assets::HdrImage> color = assets::readHdrImage(path), error = assets::readHdrImage(errors);
        if (!color) return color.error();
        if (!error) return error.error();
        mFiles.traced.push_back({ { color->width, color->height, std::move(color->pixels) },
                                  { error->width, error->height, std::move(error->pixels) } });
        return {};
    }

    InteriorCase const& mCase;
    InteriorSettings const& mSettings;
    SceneFolders const& mFolders;
    jobs::JobSystem& mJobs;
    std::function<void(std::string const&)> const& mStep;
    const fs::path mFolder;
    InteriorFiles mFiles;
    uint64_t mHash = 0;                               // of model and environment
    std::array<reference::TracedScenePtr, 2> mScenes; // without and with a visible sky
};

} // namespace

Result<InteriorFiles> makeFiles(InteriorCase const& one, InteriorSettings const& settings, SceneFolders const& folders,
                                jobs::JobSystem& jobs, std::function<void(std::string const&)> const& step) {
    return Maker(one, settings, folders, jobs, step).make();
}

SceneSpec sceneOf(InteriorCase const& one, InteriorFiles const& files, LightTechnique technique, size_t camera,
                  uint2 size) {
    using T = LightTechnique;
    const bool isBaked = technique == T::Lightmap || technique == T::LightmapAndProbes,
               hasGrid = technique == T::Grid || technique == T::GridAndProbes,
               hasProbes = technique == T::Probes || technique == T::GridAndProbes || technique == T::LightmapAndProbes;
    SceneSpec spec{ .name = one.name, .modelPath = fs::absolute(isBaked ? files.baked : files.model).string() };
    spec.environment = fs::absolute(files.environment).string();
    spec.environmentSettings.skybox = false;
    interiors::InteriorCamera const& place = one.cameras[camera];
    spec.eye = place.eye, spec.at = place.at;
    spec.lens.verticalFovDegrees = place.fovDegrees;
    spec.exposure = one.exposure;
    spec.view.size = size;
    spec.linear = true;
    spec.copies = { double4x4(1.0) };
    for (size_t i = 0; hasProbes && i < one.probes.size(); ++i) {
        ReflectionProbeDesc box{ .centerWorld = one.probes[i].center, .halfExtentMeters = one.probes[i].half };
        box.intensity = 1 / one.exposure.factor(); // what traceProbe() writes is exposed
        box.lightsDiffuse = technique == T::Probes;
        spec.probes.push_back({ box, fs::absolute(files.probes[i]).string() });
    }
    if (hasGrid) spec.grids.push_back({ {}, fs::absolute(files.grid).string() });
    return spec;
}

} // namespace filament_core::accuracy
