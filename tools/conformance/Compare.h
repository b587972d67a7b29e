// SPDX-License-Identifier: Apache-2.0
/// comparePictures: whether two pictures agree as their comparator demands, and by how much they differ.
///   Rule    identical bits are required on the same device, and between Mesa's CPU drivers; between other devices a
///           case that requires bits is compared by FLIP with its bounds (comparatorFor).
///   Thread  any; pure.  Fails  InvalidArgument if sizes or formats differ.
#pragma once

#include "tools/conformance/Results.h"
#include "tools/conformance/SceneFile.h"

#include <filament/Image.h>

namespace filament::conformance {

Comparator comparatorFor(Comparator const& asked, DeviceDescription const& a, DeviceDescription const& b);

/// Everything but the names of configuration and files.
Result<Comparison> comparePictures(Image const& reference, Image const& test, Comparator const& comparator);

/// As a display shows it: RGBA8; half floats are clamped to [0, 1] and encoded.
Image displayed(Image const& image);

} // namespace filament::conformance
