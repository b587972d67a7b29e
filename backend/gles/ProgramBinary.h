// SPDX-License-Identifier: Apache-2.0
/// Linked programs as the driver stores them, in Device::programs from run to run.
///   Key     a hash of all text of both stages, specialisation constants included; device and driver are the store's.
///   Blob    the driver's format, then its bytes. What it no longer takes is forgotten and linked from text.
///   Thread  the driver thread.   Fails: never; without a binary there is the text.
#pragma once

#include "backend/gles/Device.h"

namespace filament::backend::gles {

/// Whether the implementation gives out binaries at all: the number of their formats may be zero.
bool hasProgramBinaries(GlApi const& gl);
/// 0: there is none. Counts in DriverStatistics::programsFromCache.
GLuint loadProgramBinary(Device& device, uint64_t key);
/// Of a program linked with GL_PROGRAM_BINARY_RETRIEVABLE_HINT.
void keepProgramBinary(Device& device, uint64_t key, GLuint program);

} // namespace filament::backend::gles
