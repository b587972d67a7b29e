// SPDX-License-Identifier: Apache-2.0
/// StepTime: what a step of the viewer cost its thread, in seconds of processor time: other programs do not count.
#pragma once

namespace filament_core::view {

struct StepTime {
    double other = 0;   ///< events, loads, uploads, everything but the frame
    double drawing = 0; ///< the frame and its panels; 0: none was drawn
};

/// Of the calling thread, since it began.
double threadSeconds();

} // namespace filament_core::view
