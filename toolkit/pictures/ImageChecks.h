// SPDX-License-Identifier: Apache-2.0
/// ImageChecks: checks that apply to any picture.
///   Fails   never; an empty text means that nothing was found.
///   Thread  any; pure.
#pragma once

#include "backend/layers/Captured.h"

#include <filament_core/Image.h>

#include <string>

namespace filament_core::tools {

/// Why a picture cannot be correct: all black, a single colour, NaN or infinity, no pixels.
std::string faultOf(Image const& image);

/// The first non-finite component of any floating-point attachment: pass, attachment, pixel, command positions.
std::string notFinite(backend::CapturedFrame const& frame);

} // namespace filament_core::tools
