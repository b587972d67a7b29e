// SPDX-License-Identifier: Apache-2.0
/// comparePictures: whether two pictures agree as their comparator demands, and by how much they differ.
///   Rule    identical bits are required on the same device, and between Mesa's CPU drivers; between other devices a
///           case that requires bits is compared by FLIP with its bounds (comparatorFor).
///   Thread  any; pure.  Fails  InvalidArgument if sizes or formats differ.
#pragma once

#include "toolkit/scenes/SceneFile.h"
#include "tools/conformance/Results.h"

#include <filament_core/Image.h>

namespace filament_core::conformance {

Comparator comparatorFor(Comparator const& asked, DeviceDescription const& a, DeviceDescription const& b);

/// Everything but the names of configuration and files.
Result<Comparison> comparePictures(Image const& reference, Image const& test, Comparator const& comparator);

/// Fills in how two pictures of a case differ that are files: how many pixels (one at least: half floats may differ
/// where what a display shows agrees), which is the first, and the files for the report in the folder `out`.
/// `reference` is one of its files, `drawn` any file.
Result<void> compareFiles(std::filesystem::path const& out, std::string const& reference,
                          std::filesystem::path const& drawn, Comparison& comparison);

/// As a display shows it: RGBA8; half floats are clamped to [0, 1] and encoded.
Image displayed(Image const& image);

} // namespace filament_core::conformance
