// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/SceneAssets.h"

#include "base/Hash.h"
#include "base/math/Elementary.h"
#include "filament_core/assets/environment/AnalyticSky.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/scenebuild/SceneFileParts.h"
#include "toolkit/scenes/BuiltModel.h"
#include "toolkit/showcase/Showcase.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace filament_core::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAsset = "asset:", kShowcase = "showcase", kSky = "sky", kWhite = "white", kSunny = "sunny",
                           kStudio = "studio";
constexpr uint32_t kSkyHeight = 64;    // smooth except at the horizon: enough for images of 256 pixels
constexpr uint32_t kSunnyHeight = 512; // pixels as small as the sun
constexpr float kSkyUnit = 22;         // klx: radiance 1 in the sky's file, as in the showcase

fs::path resolve(std::string const& name, SceneSpec const& spec, fs::path const& assets) {
    if (name.starts_with(kAsset)) return assets / name.substr(kAsset.size());
    return spec.folder / name;
}

/// Writes to a folder of this process and thread, then moves the file into place in one step.
Result<fs::path> writeOnce(fs::path const& path, std::function<Result<void>(fs::path const& own)> const& write) {
    if (fs::exists(path)) return path;
    const fs::path own =
            path.parent_path() / fmt::format("{}-{}", static_cast<const void*>(&write), path.filename().string());
    if (const Result<void> written = write(own); !written) return written.error();
    std::error_code error;
    fs::rename(own, path, error);
    if (error) return fail(ErrorCode::Unreadable, "{}: {}", path.string(), error.message());
    return path;
}

/// A file name derived from the content.
Result<fs::path> writeBuiltModel(SceneSpec const& spec, fs::path const& work) {
    const std::string name = spec.name.substr(0, spec.name.find('/'));
    Result<std::vector<std::byte>> bytes = buildModel(*spec.modelObject, name);
    if (!bytes) return bytes.error();
    const fs::path path = work / "models" / fmt::format("{}-{:016x}.glb", name, hashBytes(*bytes));
    if (fs::exists(path)) return path;
    if (const Result<void> written = assets::replaceFile(path, *bytes); !written) return written.error();
    return path;
}

Result<void> writeAnalyticSky(fs::path const& path, uint32_t height, bool sunDisc) {
    jobs::JobSystem jobs({ .workers = 0 });
    Result<assets::HdrImage> sky = assets::makeAnalyticSky(
            { .height = height, .groundAlbedo = { 0.30f, 0.29f, 0.27f }, .sunDisc = sunDisc }, jobs);
    if (!sky) return sky.error();
    for (float3& pixel : sky->pixels) pixel /= kSkyUnit;
    return assets::writeHdr(path, *sky);
}

Result<void> writeSky(fs::path const& path) { return writeAnalyticSky(path, kSkyHeight, false); }
Result<void> writeSunny(fs::path const& path) { return writeAnalyticSky(path, kSunnyHeight, true); }

Result<void> writeWhite(fs::path const& path) {
    const assets::HdrImage white{
        .width = 16, .height = 8, .pixels = std::vector<float3>(128, float3(1.0f)), .repairs = {}
    };
    return assets::writeHdr(path, white);
}

/// Soft boxes on nearly dark walls, as in a photographer's studio: hard edges, high contrast, all light from a small
/// part of the sphere.
Result<void> writeStudio(fs::path const& path) {
    constexpr uint32_t kWidth = 1024, kHeight = 512;
    struct Lamp {
        float left, top, right, bottom; ///< of the image, in [0, 1]
        float3 radiance;
    };
    constexpr Lamp kLamps[] = { { 0.10f, 0.18f, 0.20f, 0.42f, { 24, 21, 17 } },
                                { 0.42f, 0.25f, 0.58f, 0.40f, { 5, 6, 8 } },
                                { 0.78f, 0.30f, 0.80f, 0.55f, { 30, 30, 30 } },
                                { 0.00f, 0.02f, 1.00f, 0.06f, { 10, 10, 10 } } };
    assets::HdrImage studio{ .width = kWidth, .height = kHeight, .pixels = {}, .repairs = {} };
    studio.pixels.resize(size_t(kWidth) * kHeight);
    for (uint32_t y = 0; y < kHeight; ++y) {
        for (uint32_t x = 0; x < kWidth; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / kWidth, v = (static_cast<float>(y) + 0.5f) / kHeight;
            float3 radiance = v < 0.5f ? float3(0.10f, 0.11f, 0.13f) : float3(0.16f, 0.13f, 0.10f) * (1.5f - v);
            for (Lamp const& lamp : kLamps)
                if (u > lamp.left && u < lamp.right && v > lamp.top && v < lamp.bottom) radiance = lamp.radiance;
            studio.at(x, y) = radiance;
        }
    }
    return assets::writeHdr(path, studio);
}

Result<showcase::Files> showcaseFiles(fs::path const& work) {
    const fs::path folder = work / "showcase";
    const showcase::Files files{ folder / "showcase.glb", folder / "showcase.hdr" };
    if (fs::exists(files.model) && fs::exists(files.environment)) return files;
    jobs::JobSystem jobs;
    return showcase::writeFiles(folder, jobs);
}

bool isBuiltIn(std::string const& environment) {
    return environment.empty() || environment == kSky || environment == kSunny || environment == kWhite ||
           environment == kStudio || environment == kShowcase;
}

} // namespace

std::string missingFile(SceneSpec const& spec, fs::path const& assets) {
    const auto missing = [&](std::string const& name) {
        return !fs::exists(resolve(name, spec, assets)) ? name : std::string();
    };
    if (!spec.modelObject && spec.modelPath != kShowcase) {
        if (std::string name = missing(spec.modelPath); !name.empty()) return name;
    }
    for (std::string const& profile : spec.lightProfiles) {
        if (std::string name = profile.empty() ? profile : missing(profile); !name.empty()) return name;
    }
    for (LightImageFile const& image : spec.lightImages) {
        const std::string file = image.file.string();
        if (std::string name = file.empty() ? file : missing(file); !name.empty()) return name;
    }
    for (ProbeSpec const& probe : spec.probes) {
        if (std::string name = isBuiltIn(probe.file) ? std::string() : missing(probe.file); !name.empty()) return name;
    }
    for (GridSpec const& grid : spec.grids) {
        if (std::string name = grid.file.empty() ? grid.file : missing(grid.file); !name.empty()) return name;
    }
    return isBuiltIn(spec.environment) ? std::string() : missing(spec.environment);
}

Result<fs::path> modelFile(SceneSpec const& spec, SceneFolders const& folders) {
    if (spec.modelObject) return writeBuiltModel(spec, folders.work);
    if (spec.modelPath != kShowcase) return resolve(spec.modelPath, spec, folders.assets);
    Result<showcase::Files> files = showcaseFiles(folders.work);
    return files ? Result<fs::path>(files->model) : files.error();
}

Result<fs::path> environmentFile(SceneSpec const& spec, SceneFolders const& folders) {
    if (spec.environment == kSky) return writeOnce(folders.work / "sky.hdr", writeSky);
    if (spec.environment == kSunny) return writeOnce(folders.work / "sunny.hdr", writeSunny);
    if (spec.environment == kWhite) return writeOnce(folders.work / "white.hdr", writeWhite);
    if (spec.environment == kStudio) return writeOnce(folders.work / "studio.hdr", writeStudio);
    if (spec.environment == kShowcase) {
        Result<showcase::Files> files = showcaseFiles(folders.work);
        return files ? Result<fs::path>(files->environment) : files.error();
    }
    return spec.environment.empty() ? fs::path() : resolve(spec.environment, spec, folders.assets);
}

std::vector<LightDesc> placedLights(SceneSpec const& spec) {
    std::vector<LightDesc> lights = spec.lights;
    for (LightDesc& light : lights) scenebuild::moveBy(spec.origin, light);
    return lights;
}

fs::path profileFile(SceneSpec const& spec, size_t light, SceneFolders const& folders) {
    const bool hasProfile = light < spec.lightProfiles.size() && !spec.lightProfiles[light].empty();
    return hasProfile ? resolve(spec.lightProfiles[light], spec, folders.assets) : fs::path();
}

LightImageFile imageFile(SceneSpec const& spec, size_t light, SceneFolders const& folders) {
    if (light >= spec.lightImages.size() || spec.lightImages[light].file.empty()) return {};
    LightImageFile const& image = spec.lightImages[light];
    return { resolve(image.file.string(), spec, folders.assets), image.shape };
}

Result<void> addLights(Engine& engine, Scene& scene, SceneSpec const& spec, SceneFolders const& folders) {
    scenebuild::SceneFileLights added(engine, scene);
    const std::vector<LightDesc> lights = placedLights(spec);
    for (size_t i = 0; i < lights.size(); ++i) {
        const LightImageFile image = imageFile(spec, i, folders);
        const Result<void> done = added.add(lights[i], profileFile(spec, i, folders), image.file, image.shape);
        if (!done) return fail(done.error().code, "{}: {}", spec.name, done.error().message);
    }
    return {};
}

Result<void> addGrids(Scene& scene, SceneSpec const& spec, SceneFolders const& folders) {
    for (GridSpec const& grid : spec.grids) {
        const fs::path file = grid.file.empty() ? fs::path() : resolve(grid.file, spec, folders.assets);
        Result<IrradianceGridDesc> desc = scenebuild::readSceneGrid(grid, file);
        if (!desc) return desc.error();
        desc->centerWorld += spec.origin;
        scene.add(*desc);
    }
    return {};
}

std::vector<double4x4> placedCopies(SceneSpec const& spec) {
    std::vector<double4x4> copies = spec.copies;
    for (double4x4& copy : copies) copy = glm::translate(double4x4(1.0), spec.origin) * copy;
    return copies;
}

Camera cameraOf(SceneSpec const& spec, Box const& bounds) {
    return scenebuild::cameraOf({ .eye = spec.eye, .at = spec.at, .lens = spec.lens }, spec.origin, spec.exposure,
                                bounds);
}

} // namespace filament_core::tools
