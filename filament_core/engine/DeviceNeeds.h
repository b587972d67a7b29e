// SPDX-License-Identifier: Apache-2.0
/// What the engine needs of a device beyond what both APIs guarantee.
///   Thread  any; pure.   Fails: Unsupported, with the device, what it lacks, and what to do.
#pragma once

#include "backend/api/Driver.h"
#include "base/Result.h"

namespace filament::engine {

/// Storage buffers of the View group: lights and froxels.
inline constexpr uint32_t kFragmentStorageBuffers = 2;

Result<void> checkDevice(backend::DeviceInfo const& device);

} // namespace filament::engine
