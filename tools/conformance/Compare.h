// SPDX-License-Identifier: Apache-2.0
/// comparePictures: do two pictures agree as a comparator demands, and by how much do they not.
///   Rule    bits are demanded of one device, and of Mesa's CPU drivers among each other; between other devices a case
///           that asks for bits is compared by FLIP with its bounds (comparatorFor).
///   Thread  any; pure.  Fails  InvalidArgument when sizes or formats differ.
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
