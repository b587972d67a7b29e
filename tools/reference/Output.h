// SPDX-License-Identifier: Apache-2.0
/// Output: a ReferenceImage as files: reference.exr (scene-linear, exposed, float), reference.png (through the engine's
/// tone mapper), error.exr on request, report.json; what differs from run to run is in times.json.
///   Fails   Unreadable with path and reason.
#pragma once

#include "tools/reference/Options.h"

namespace filament_core::reference {

/// RGBA8 as the engine's tone mapping pass stores it.
std::vector<std::byte> displayPixels(ReferenceImage const& image, DisplayTransform const& display);

Result<void> writePictures(Options const& options, ReferenceImage const& image);
Result<void> writeReport(Options const& options, ReferenceImage const& image, std::vector<std::string> const& warnings);

} // namespace filament_core::reference
