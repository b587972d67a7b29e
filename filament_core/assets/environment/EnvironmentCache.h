// SPDX-License-Identifier: Apache-2.0
/// The bytes of a cached environment: little-endian header, irradiance, then the texels of the cubes, with a 64-bit
/// checksum over everything. Private to this folder.
///   Fails   decode: Corrupt for any invalid bytes; sizes are checked against the bytes before memory is allocated.
///   Thread  pure functions.
#pragma once

#include "filament_core/assets/environment/Environment.h"

#include <vector>

namespace filament_core::assets {

/// Identifies a cached file: content of the panorama, options that change the result, version of the baker.
uint64_t environmentKey(std::span<const std::byte> picture, EnvironmentOptions const& options);

/// The key of a file that stands for itself instead of for a panorama in the cache: what cmgen writes.
uint64_t bakedEnvironmentKey(RoughnessMapping mapping);
/// Whether these bytes claim to be an environment that is already baked.
bool isBakedEnvironment(std::span<const std::byte> bytes);

std::vector<std::byte> encodeEnvironment(EnvironmentData const& data, uint64_t key);
Result<EnvironmentData> decodeEnvironment(std::span<const std::byte> bytes, uint64_t key);

} // namespace filament_core::assets
