// SPDX-License-Identifier: Apache-2.0
/// captureToFile: what a probe of a document sees, as a .ktx2 file, drawn by an engine of its own.
///   Thread  any: the engine is made, used and ended there.
///   Fails   one line: errors of the engine, of the files and of the disk.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/Engine.h>

namespace filament_core::view {

struct ProbeShot {
    Document document{}; ///< its other probes are reflected
    size_t probe = 0;    ///< of document.probes
    EngineOptions engine{};
    std::filesystem::path file{}; ///< to be written
};

/// The intensity of the file's texels: DocumentProbe::intensity.
Result<float> captureToFile(ProbeShot const& shot);

} // namespace filament_core::view
