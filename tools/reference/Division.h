// SPDX-License-Identifier: Apache-2.0
/// Division: which part of an image --tile, --samples and --shard name.
///   Shards  near-square tiles as long as these have at least 16 pixels a side, then also ranges of passes. Together
///           the shards 0/N to N-1/N are the image, each part once.
///   Fails   InvalidArgument in one line that names the option, the value and what is valid.
///   Thread  pure functions.
#pragma once

#include "toolkit/program/Shard.h"
#include "tools/reference/PartialFilm.h"

#include <string>

namespace filament_core::reference {

/// `tile`: "X,Y,W,H" in pixels, or "I/CxR": tile I, row by row, of a grid with C columns and R rows; empty: all.
/// `samples`: "FIRST,COUNT" of the samples of a pixel, whole passes; empty: all.
Result<FilmRegion> regionOf(std::string const& tile, std::string const& samples, uint2 size, PassPlan const& plan);

Result<FilmRegion> regionOf(tools::Shard const& shard, uint2 size, PassPlan const& plan);

} // namespace filament_core::reference
