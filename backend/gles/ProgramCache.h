// SPDX-License-Identifier: Apache-2.0
/// ProgramCache: linked programs as the driver stores them, in Device::programs from run to run.
///   Key     a hash of all text of both stages, specialisation constants included; device and driver are the store's.
///   Blob    the driver's format, then its bytes. What it no longer takes is forgotten and linked from text.
///   Thread  the driver thread.   Fails: never; without a binary there is the text.
#pragma once

#include "backend/gles/Device.h"

#include <filesystem>

namespace filament::backend::gles {

/// Opens Device::programs; leaves it empty where nobody asked for it or the implementation gives out no binaries.
void openProgramCache(Device& device, std::filesystem::path const& directory);
/// 0: there is none. Counts in DriverStatistics::programsFromCache.
GLuint loadProgramBinary(Device& device, uint64_t key);
/// Of a program linked with GL_PROGRAM_BINARY_RETRIEVABLE_HINT.
void keepProgramBinary(Device& device, uint64_t key, GLuint program);

} // namespace filament::backend::gles
