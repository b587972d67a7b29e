// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes with a correct checksum, and for any KTX 2.0 file, reading a
/// baked environment gives an error, or cubes that a device can hold. The lights of a cube map are suns.
#pragma once

#include "base/Assert.h"
#include "base/Hash.h"
#include "filament_core/assets/environment/CubePicture.h"
#include "filament_core/assets/environment/EnvironmentCache.h"
#include "filament_core/assets/environment/EnvironmentPackage.h"
#include "filament_core/assets/environment/LightNumbers.h"
#include "filament_core/assets/environment/SkyLights.h"

#include <filament_core/LoadOptions.h>

#include <cmath>
#include <cstring>
#include <span>
#include <vector>

namespace filament_core::assets::test {

/// Makes key and checksum of a baked environment right, as its author would: bytes 8 to 24 of the file.
inline std::vector<std::byte> signedEnvironment(std::span<const std::byte> bytes) {
    std::vector<std::byte> file(bytes.begin(), bytes.end());
    if (file.size() < 24) return file;
    const uint64_t key = bakedEnvironmentKey(RoughnessMapping::Quadratic);
    std::memcpy(&file[8], &key, sizeof(key));
    const uint64_t checksum = hashBytes(std::span(file).subspan(24));
    std::memcpy(&file[16], &checksum, sizeof(checksum));
    return file;
}

inline void checkLights(EnvironmentLights const& lights) {
    for (ExtractedLight const& light : lights.found()) {
        const SunLight sun = sunLightOf(light, {});
        FILAMENT_ASSERT(sun.illuminance.value >= 0 && sun.illuminance.value <= 1e12f, "lights are suns");
        FILAMENT_ASSERT(glm::length(sun.directionWorld) > 0.9f, "lights have a direction");
        for (int i = 0; i < 3; ++i) FILAMENT_ASSERT(sun.color[i] >= 0 && sun.color[i] <= 1e9f, "lights have a colour");
    }
    FILAMENT_ASSERT(lightsFrom(numbersOf(lights)).has_value(), "lights can be stored");
}

/// Takes the lights out of a cube map that is not too large.
inline void fuzzLights(CubePicture const& picture) {
    if (picture.radiance.size() > 64) return; // only slow
    jobs::JobSystem jobs({ .workers = 0 });
    HdrImage sky = imageFromPicture(picture);
    checkLights(takeLights(sky, SkyLayout::Cube, EnvironmentSun::Fit, EnvironmentLights::kMost, jobs));
    for (float3 const& pixel : sky.pixels)
        for (int i = 0; i < 3; ++i) FILAMENT_ASSERT(pixel[i] >= 0 && pixel[i] <= kMaxRadiance, "the rest is light");
}

inline void checkEnvironment(EnvironmentData const& data) {
    for (Image const* cube : { &data.specular, &data.sky, &data.irradiance }) {
        if (cube == &data.irradiance && cube->data.empty()) continue; // only its coefficients are known
        FILAMENT_ASSERT(cube->layers == 6 && cube->width == cube->height && cube->width > 0, "a cube has six squares");
        FILAMENT_ASSERT(cube->levels >= 1 && cube->levels <= backend::fullMipCount(cube->width, cube->height),
                        "a cube has no level below one texel");
        FILAMENT_ASSERT(cube->data.size() == cube->levelOffset(cube->levels), "every texel is there");
        FILAMENT_ASSERT(isEnvironmentFormat(cube->format), "the format is one of environments");
    }
    checkLights(data.lights);
    for (float4 const& coefficient : data.irradianceSh) {
        for (int i = 0; i < 4; ++i) FILAMENT_ASSERT(std::isfinite(coefficient[i]), "coefficients are finite");
    }
}

/// Returns whether it was an environment.
inline bool fuzzEnvironment(std::span<const std::byte> bytes) {
    const std::vector<std::byte> file = signedEnvironment(bytes);
    const Result<EnvironmentData> data = decodeEnvironment(file, bakedEnvironmentKey(RoughnessMapping::Quadratic));
    if (!data) {
        FILAMENT_ASSERT(data.error().code == ErrorCode::Corrupt, "an environment that is refused is corrupt");
        return false;
    }
    FILAMENT_ASSERT(isBakedEnvironment(file), "what is read as an environment claims to be one");
    checkEnvironment(*data);
    return true;
}

/// Returns whether it was a package, or a cube map that can be baked.
inline bool fuzzEnvironmentPackage(std::span<const std::byte> bytes) {
    const Result<Ktx2File> file = readKtx2(bytes, "fuzzed");
    if (!file || uint64_t{ file->width } * file->height * file->layers > 1u << 18) return false; // only slow
    const auto checkError = [](Error const& error) {
        FILAMENT_ASSERT(error.code == ErrorCode::Corrupt || error.code == ErrorCode::Unsupported, "bad bytes say so");
        FILAMENT_ASSERT(error.message.find("fuzzed") != std::string::npos, "an error names its file");
        FILAMENT_ASSERT(error.message.find('\n') == std::string::npos, "an error is one line");
    };
    if (!isEnvironmentPackage(*file)) {
        const Result<CubePicture> picture = decodeCubePicture(bytes, "fuzzed");
        if (!picture) checkError(picture.error());
        if (picture) fuzzLights(*picture);
        return picture.ok();
    }
    const Result<EnvironmentData> data = decodeEnvironmentPackage(*file, "fuzzed");
    if (!data) return checkError(data.error()), false;
    checkEnvironment(*data);
    const std::vector<std::byte> again = encodeEnvironmentPackage(*data);
    const Result<Ktx2File> reread = readKtx2(again, "fuzzed");
    FILAMENT_ASSERT(reread && decodeEnvironmentPackage(*reread, "fuzzed"), "what was read can be written and read");
    return true;
}

} // namespace filament_core::assets::test
