// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/Environment.h"

#include "base/Log.h"
#include "filament_core/assets/environment/CubePicture.h"
#include "filament_core/assets/environment/EnvironmentCache.h"
#include "filament_core/assets/environment/EnvironmentPackage.h"
#include "filament_core/assets/environment/Panorama.h"
#include "filament_core/assets/environment/SkyLights.h"
#include "filament_core/assets/files/FileBytes.h"

#include <filament_core/LoadOptions.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <new>
#include <optional>

namespace filament_core::assets {
namespace {

Result<void> checkOptions(EnvironmentOptions const& options) {
    if (!std::has_single_bit(options.faceSize) || options.faceSize < 16 || options.faceSize > 2048) {
        return fail(ErrorCode::InvalidArgument, "environment face size {} is not a power of two in [16, 2048]",
                    options.faceSize);
    }
    if (options.samples < 1 || options.samples > 65536) {
        return fail(ErrorCode::InvalidArgument, "{} environment samples are not in [1, 65536]", options.samples);
    }
    if (options.lights < 1 || options.lights > EnvironmentLights::kMost) {
        return fail(ErrorCode::InvalidArgument, "{} lights of an environment are not in [1, {}]", options.lights,
                    EnvironmentLights::kMost);
    }
    if (!isEnvironmentFormat(options.format)) {
        return fail(ErrorCode::InvalidArgument,
                    "environment format {} is none of RGBA16F, R11G11B10F, RGB9E5 and RGBA8",
                    backend::formatInfo(options.format).name);
    }
    return {};
}

void report(EnvironmentOptions const& options, std::string_view stage, size_t done, size_t total) {
    if (options.progress) options.progress(stage, done, total);
}

/// The error of a cancelled load.
Result<void> goesOn(EnvironmentOptions const& options) {
    if (!options.cancellation || !options.cancellation->isRequested()) return {};
    return fail(ErrorCode::Cancelled, "loading the environment was cancelled");
}

void warnAboutRepairs(std::string_view name, HdrRepairs const& repairs) {
    if (repairs.total() == 0) return;
    log(Severity::Warning,
        "'{}': replaced {} NaN, {} infinite and {} negative components; colours outside of Rec. 709 have some", name,
        repairs.notANumber, repairs.infinite, repairs.negative);
}

/// Of a package, the lights that it was baked with.
void noteLights(std::string_view name, EnvironmentOptions const& options, EnvironmentLights& lights) {
    if (options.sun == EnvironmentSun::Keep) return;
    if (lights.search == SunSearch::Off) lights.search = SunSearch::Baked;
    if (lights.count > 0) return;
    const std::string text = explain(lights, {});
    log(Severity::Warning, "'{}': {}", name, text.substr(0, text.find('\n')));
}

std::filesystem::path cacheFile(std::filesystem::path const& directory, uint64_t key) {
    return directory / fmt::format("environment-{:016x}.bin", key);
}

Result<EnvironmentData> readCached(std::filesystem::path const& file, uint64_t key) {
    const Result<std::vector<std::byte>> bytes = readFileBytes(file);
    if (!bytes) return bytes.error();
    return decodeEnvironment(*bytes, key);
}

Image irradianceOf(IblCube const& cube, jobs::JobSystem& jobs) {
    constexpr uint32_t kSource = 64; // texels per face edge: the resolution for irradianceCube()
    const size_t level = std::bit_width(std::max(cube.front().size() / kSource, 1u)) - 1u;
    const IblCubeLevel irradiance = irradianceCube(cube[level], kIrradianceFaceSize, jobs);
    return encodeCube(std::span(&irradiance, 1), backend::Format::RGBA16F, jobs).image;
}

/// What of the cube is needed once it is there: its first level has at least `skySize` and options.faceSize texels.
/// `background`: of skySize texels; null: that of the cube.
Result<EnvironmentData> bakeCube(IblCube const& cube, IblCubeLevel const* background, uint32_t skySize,
                                 jobs::JobSystem& jobs, EnvironmentOptions const& options) {
    report(options, "project", 1, 1);
    if (const Result<void> wanted = goesOn(options); !wanted) return wanted.error();
    EnvironmentData data;
    // The coefficients come from the finest level, because coarser ones replace the light of a texel by its mean, which
    // moves the sun by up to half of its size.
    data.irradianceSh = irradianceSh(cube.front(), jobs);
    const std::vector<IblCubeLevel> levels = prefilterSpecular(
            cube, options.faceSize, options.samples, jobs,
            [&](size_t done, size_t total) { report(options, "prefilter", done, total); }, options.mapping);
    data.levelOfRoughnessOne = static_cast<float>(levels.size() - 1);
    data.mapping = options.mapping;
    if (const Result<void> wanted = goesOn(options); !wanted) return wanted.error();
    EncodedCube specular = encodeCube(levels, options.format, jobs);
    // The cube is as fine as the finer of its two uses; the sky takes the level that has its own size.
    const size_t skyLevel = std::bit_width(cube.front().size() / skySize) - 1u;
    IblCubeLevel const& shown = background ? *background : cube[skyLevel];
    EncodedCube sky = encodeCube(std::span(&shown, 1), options.format, jobs);
    data.specular = std::move(specular.image);
    data.sky = std::move(sky.image);
    data.irradiance = irradianceOf(cube, jobs);
    data.statistics.specularLoss = specular.loss;
    data.statistics.skyLoss = sky.loss;
    return data;
}

IblCubeLevel levelOfSize(IblCube const& cube, uint32_t size) {
    return cube[std::bit_width(cube.front().size() / size) - 1u];
}

Result<EnvironmentData> bakeCubePicture(std::span<const std::byte> ktx2, std::string_view name, jobs::JobSystem& jobs,
                                        EnvironmentOptions const& options) {
    Result<CubePicture> picture = decodeCubePicture(ktx2, name);
    if (!picture) return picture.error();
    report(options, "decode", 1, 1);
    const uint32_t face = picture->radiance.size(), skySize = skyFaceSize(4 * face);
    report(options, "project", 0, 1);
    const uint32_t size = std::max(skySize, options.faceSize);
    std::optional<IblCubeLevel> background;
    EnvironmentLights lights;
    if (options.sun != EnvironmentSun::Keep) {
        HdrImage sky = imageFromPicture(*picture);
        lights = takeLights(sky, SkyLayout::Cube, options.sun, options.lights, jobs);
        if (lights.count > 0) {
            background = levelOfSize(cubeFromPicture(*picture, size, jobs), skySize);
            setImage(*picture, sky);
        }
    }
    const IblCube cube = cubeFromPicture(*picture, size, jobs);
    Result<EnvironmentData> data = bakeCube(cube, background ? &*background : nullptr, skySize, jobs, options);
    if (!data) return data;
    data->lights = lights;
    data->statistics.sourceWidth = data->statistics.sourceHeight = face;
    data->statistics.repairs = picture->repairs;
    return data;
}

Result<EnvironmentData> bakePicture(std::span<const std::byte> picture, std::string_view name, jobs::JobSystem& jobs,
                                    EnvironmentOptions const& options) {
    if (const Result<void> wanted = goesOn(options); !wanted) return wanted.error();
    report(options, "decode", 0, 1);
    if (isKtx2(picture)) return bakeCubePicture(picture, name, jobs, options);
    const Result<HdrImage> image = decodePanorama(picture, name);
    if (!image) return image.error();
    report(options, "decode", 1, 1);
    return bakeEnvironment(*image, jobs, options);
}

Result<EnvironmentData> readBaked(std::span<const std::byte> bytes, std::string_view name) {
    constexpr std::array kMappings{ RoughnessMapping::Quadratic, RoughnessMapping::Logarithmic,
                                    RoughnessMapping::Linear };
    for (const RoughnessMapping mapping : kMappings) {
        Result<EnvironmentData> data = decodeEnvironment(bytes, bakedEnvironmentKey(mapping));
        if (data) data->mapping = mapping;
        if (data) return data;
    }
    return fail(ErrorCode::Corrupt,
                "'{}' is a damaged baked environment, or one of another version; bake it again with cmgen", name);
}

Result<EnvironmentData> loadThroughCache(std::span<const std::byte> picture, std::string_view name,
                                         jobs::JobSystem& jobs, EnvironmentOptions const& options) {
    // Files that hold a baked environment are recognised first: nothing is computed for them, so they need no cache.
    if (isBakedEnvironment(picture)) return readBaked(picture, name);
    if (isKtx2(picture)) {
        const Result<Ktx2File> file = readKtx2(picture, name);
        if (!file) return file.error();
        if (isEnvironmentPackage(*file)) return decodeEnvironmentPackage(*file, name);
    }
    const std::filesystem::path directory =
            options.useCache ? environmentCacheDirectory(options) : std::filesystem::path();
    if (directory.empty()) return bakePicture(picture, name, jobs, options);

    const uint64_t key = environmentKey(picture, options);
    const std::filesystem::path file = cacheFile(directory, key);
    Result<EnvironmentData> cached = readCached(file, key);
    if (cached) cached->mapping = options.mapping;
    if (cached) return cached;
    // A missing file is the usual case and no reason for a warning.
    if (cached.error().code == ErrorCode::Corrupt) {
        log(Severity::Warning, "'{}': {}; baking again", file.string(), cached.error().message);
    }
    Result<EnvironmentData> baked = bakePicture(picture, name, jobs, options);
    if (!baked) return baked;
    // An environment that cannot be cached is still complete: a full disk only costs the time of the next start.
    if (Result<void> written = replaceFile(file, encodeEnvironment(*baked, key)); !written) {
        log(Severity::Warning, "environment is not cached: {}", written.error().message);
    }
    // A process that ended while it wrote has left a temporary file behind. Only a writer looks for those, because a
    // reader should not pay for listing the directory.
    removeLeftovers(directory);
    return baked;
}

} // namespace

Result<void> writeEnvironmentPackage(EnvironmentData const& data, std::filesystem::path const& path) {
    return replaceFile(path, encodeEnvironmentPackage(data));
}

Result<void> writeBakedEnvironment(EnvironmentData const& data, std::filesystem::path const& path) {
    return replaceFile(path, encodeEnvironment(data, bakedEnvironmentKey(data.mapping)));
}

uint32_t skyFaceSize(uint32_t sourceWidth) { return std::clamp(std::bit_ceil((sourceWidth + 3) / 4), 16u, 512u); }

std::filesystem::path environmentCacheDirectory(EnvironmentOptions const& options) {
    if (!options.cacheDirectory.empty()) return options.cacheDirectory;
    // XDG Base Directory Specification: relative and empty values count as unset.
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/') {
        return std::filesystem::path(cache) / "filament_core";
    }
    if (const char* home = std::getenv("HOME"); home && *home == '/') {
        return std::filesystem::path(home) / ".cache" / "filament_core";
    }
    return {};
}

Result<EnvironmentData> bakeEnvironment(HdrImage const& image, jobs::JobSystem& jobs,
                                        EnvironmentOptions const& options) try {
    if (auto checked = checkOptions(options); !checked) return checked.error();
    if (image.width == 0 || image.height == 0 || image.pixels.size() != size_t(image.width) * image.height) {
        return fail(ErrorCode::InvalidArgument, "an environment of {} x {} pixels has data for {}", image.width,
                    image.height, image.pixels.size());
    }
    const uint32_t skySize = skyFaceSize(image.width);
    report(options, "project", 0, 1);
    if (const Result<void> wanted = goesOn(options); !wanted) return wanted.error();
    std::optional<IblCubeLevel> background;
    std::optional<HdrImage> rest; // without the lights
    EnvironmentLights lights;
    if (options.sun != EnvironmentSun::Keep) {
        rest = image;
        lights = takeLights(*rest, SkyLayout::Panorama, options.sun, options.lights, jobs);
        if (lights.count > 0) background = faceLevelFromEquirect(image, skySize, jobs);
    }
    const IblCube cube = cubeFromEquirect(rest ? *rest : image, std::max(skySize, options.faceSize), jobs);
    Result<EnvironmentData> data = bakeCube(cube, background ? &*background : nullptr, skySize, jobs, options);
    if (!data) return data;
    data->lights = lights;
    data->statistics.sourceWidth = image.width;
    data->statistics.sourceHeight = image.height;
    data->statistics.repairs = image.repairs;
    return data;
} catch (std::bad_alloc const&) {
    return fail(ErrorCode::OutOfMemory, "not enough memory to bake an environment of {} x {} pixels; make it smaller",
                image.width, image.height);
}

Result<EnvironmentData> loadEnvironment(std::filesystem::path const& path, jobs::JobSystem& jobs,
                                        EnvironmentOptions const& options) try {
    if (auto checked = checkOptions(options); !checked) return checked.error();
    const Result<std::vector<std::byte>> file = readFileBytes(path);
    if (!file) return file.error();
    return loadEnvironmentFromMemory(*file, path.string(), jobs, options);
} catch (std::bad_alloc const&) {
    return fail(ErrorCode::OutOfMemory, "not enough memory to load '{}'; make it smaller", path.string());
}

Result<EnvironmentData> loadEnvironmentFromMemory(std::span<const std::byte> file, std::string_view name,
                                                  jobs::JobSystem& jobs, EnvironmentOptions const& options) try {
    if (auto checked = checkOptions(options); !checked) return checked.error();
    Result<EnvironmentData> data = loadThroughCache(file, name, jobs, options);
    if (!data) return data;
    warnAboutRepairs(name, data->statistics.repairs);
    noteLights(name, options, data->lights);
    warnAboutPanorama(file, name);
    return data;
} catch (std::bad_alloc const&) {
    return fail(ErrorCode::OutOfMemory, "not enough memory to load '{}'; make it smaller", name);
}

} // namespace filament_core::assets
