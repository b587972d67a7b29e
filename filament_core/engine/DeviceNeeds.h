// SPDX-License-Identifier: Apache-2.0
/// Device requirements of the engine beyond the guarantees of both APIs.
///   Thread  any; pure.   Fails: Unsupported, with the device, the missing feature, and the remedy.
#pragma once

#include "backend/api/Driver.h"
#include "base/Result.h"

namespace filament_core::engine {

/// Storage buffers of lights, froxels and cells of volumetric fog.
inline constexpr uint32_t kFragmentStorageBuffers = 3;

Result<void> checkDevice(backend::DeviceInfo const& device);

} // namespace filament_core::engine
