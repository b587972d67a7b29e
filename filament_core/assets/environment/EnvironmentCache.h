// SPDX-License-Identifier: Apache-2.0
/// The bytes of a cached environment: little-endian header, irradiance, then the texels of the cubes; a 64-bit
/// checksum over everything. Private to this folder.
///   Fails   decode: Corrupt, for any bytes whatsoever; sizes are checked against the bytes before memory is taken.
///   Thread  pure functions.
#pragma once

#include "filament_core/assets/environment/Environment.h"

#include <vector>

namespace filament::assets {

/// What a cached file must match: content of the picture, options that change the result, version of the baker.
uint64_t environmentKey(std::span<const std::byte> picture, EnvironmentOptions const& options);

std::vector<std::byte> encodeEnvironment(EnvironmentData const& data, uint64_t key);
Result<EnvironmentData> decodeEnvironment(std::span<const std::byte> bytes, uint64_t key);

} // namespace filament::assets
