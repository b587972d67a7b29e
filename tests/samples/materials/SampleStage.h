// SPDX-License-Identifier: Apache-2.0
/// SampleStage: one small image of a material under a studio's lamps, a sun and a lamp, on either API with
/// validation.
///   Fails   by failing the running test; the image is then empty.
#pragma once

#include "tests/samples/materials/SampleTable.h"
#include "toolkit/materials/MaterialFile.h"
#include "toolkit/paths/Paths.h"

#include <filament_core/Backend.h>
#include <filament_core/Image.h>

#include <vector>

namespace filament_core::samples {

inline const std::filesystem::path kSampleFolder = tools::sourceDir() / "samples/materials";

using Picture = Image; ///< scene-linear half floats

Picture draw(Sample const& sample, std::vector<tools::TextEdit> const& edits, Backend backend);

size_t differingPixels(Picture const& a, Picture const& b);
/// Of all components but alpha, as a display shows them, in [0, 1].
double mean(Picture const& picture);
float spread(Picture const& picture); ///< standard deviation
void save(std::string const& name, Picture const& picture);
/// All images saved by this process, in alphabetical order, row by row: sheet.png.
void saveSheet();

} // namespace filament_core::samples
