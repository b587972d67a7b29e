// SPDX-License-Identifier: Apache-2.0
/// PathSampling: the camera of a CameraPath at a time. It passes through every key at its time; position, turn, lens
/// and exposure have continuous speeds.
///   Position  cubic between keys, with the tangents of the parabola through three neighbours (Bessel): exact for
///             motions with a constant acceleration.
///   Turn      Kim, Kim and Shin 1995, "A General Construction Scheme for Unit Quaternion Curves": the cubic Hermite
///             curve of rotations.
///   Lens      logarithms of sizes: zooms are even. What is not a size (the kind of lens, a fixed aspect) is that of
///             the key before.
///   Thread    any; pure.   Cost: logarithmic in the number of keys.
#pragma once

#include "tools/view/document/CameraPath.h"

namespace filament_core::view {

double durationOf(CameraPath const& path); ///< from the first key to the last, or back to the first; 0 with one key
/// `seconds` after the first key. Outside: the first or the last key; a closed path goes round. Without keys: a default
/// camera.
Camera sampled(CameraPath const& path, double seconds);
/// The time of each frame: from 0, up to and including the end of an open path.
std::vector<double> frameTimes(CameraPath const& path, double framesPerSecond);

} // namespace filament_core::view
