// SPDX-License-Identifier: Apache-2.0
/// ProgramCache: linked programs in the driver's binary form, kept in Device::programs between runs.
///   Key     a hash of all text of both stages, specialisation constants included; device and driver are the store's.
///   Blob    the driver's format, then its bytes. A binary that the driver rejects is dropped and linked from text.
///   Thread  the driver thread.   Fails: never; without a binary there is the text.
#pragma once

#include "backend/gles/Device.h"

#include <filesystem>

namespace filament_core::backend::gles {

/// Opens Device::programs; leaves it empty if it was not requested or the implementation returns no binaries.
void openProgramCache(Device& device, std::filesystem::path const& directory);
/// 0: none found. Counts in DriverStatistics::programsFromCache.
GLuint loadProgramBinary(Device& device, uint64_t key);
/// For a program linked with GL_PROGRAM_BINARY_RETRIEVABLE_HINT.
void keepProgramBinary(Device& device, uint64_t key, GLuint program);

} // namespace filament_core::backend::gles
