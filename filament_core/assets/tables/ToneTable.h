// SPDX-License-Identifier: Apache-2.0
/// bakeToneTable: colour grading, a tone mapper, a look and the display's transfer function as a cube of colours, for
/// shaders that interpolate instead of computing. The look-up costs the same for any grading.
///   Out     RGBA16F, size * size wide and size high: the entry (r, g, b) is at (r + b * size, g). Entries are evenly
///           spaced in toneTableCoordinate() of shaders/lib/color.glsl; entry 0 is black, the last one 256.
///   Read    by shaders/post/tone_table.glsl.
///   Thread  runs on the job system; the same bits for any number of workers.
///   Memory  8 * size^3 bytes: 32 KiB, 256 KiB, 2 MiB for 16, 32, 64.   Fails: never.   Cost: 40 ms for 64.
#pragma once

#include "filament_core/assets/image/Image.h"
#include "jobsystem/JobSystem.h"

#include <filament_core/DisplayTransform.h>
#include <filament_core/Effects.h>

namespace filament_core::assets {

/// size >= 2. `grading`: within its ranges; null: none.
Image bakeToneTable(jobs::JobSystem& jobs, DisplayTransform const& display, uint32_t size,
                    ColorGrading const* grading = nullptr);

} // namespace filament_core::assets
