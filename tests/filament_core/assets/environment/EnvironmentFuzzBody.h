// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes with a correct checksum, reading a baked environment gives an
/// error, or cubes that a device can hold.
#pragma once

#include "base/Assert.h"
#include "base/Hash.h"
#include "filament_core/assets/environment/EnvironmentCache.h"

#include <cmath>
#include <cstring>
#include <span>
#include <vector>

namespace filament::assets::test {

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

/// Returns whether it was an environment.
inline bool fuzzEnvironment(std::span<const std::byte> bytes) {
    const std::vector<std::byte> file = signedEnvironment(bytes);
    const Result<EnvironmentData> data = decodeEnvironment(file, bakedEnvironmentKey(RoughnessMapping::Quadratic));
    if (!data) {
        FILAMENT_ASSERT(data.error().code == ErrorCode::Corrupt, "an environment that is refused is corrupt");
        return false;
    }
    FILAMENT_ASSERT(isBakedEnvironment(file), "what is read as an environment claims to be one");
    for (Image const* cube : { &data->specular, &data->sky, &data->irradiance }) {
        FILAMENT_ASSERT(cube->layers == 6 && cube->width == cube->height && cube->width > 0, "a cube has six squares");
        FILAMENT_ASSERT(cube->levels >= 1 && cube->levels <= backend::fullMipCount(cube->width, cube->height),
                        "a cube has no level below one texel");
        FILAMENT_ASSERT(cube->data.size() == cube->levelOffset(cube->levels), "every texel is there");
        FILAMENT_ASSERT(isEnvironmentFormat(cube->format), "the format is one of environments");
    }
    for (float4 const& coefficient : data->irradianceSh) {
        for (int i = 0; i < 4; ++i) FILAMENT_ASSERT(std::isfinite(coefficient[i]), "coefficients are finite");
    }
    return true;
}

} // namespace filament::assets::test
