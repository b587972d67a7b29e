// SPDX-License-Identifier: Apache-2.0
/// LightProfileTable: a light distribution as shaders read it: 16-bit shares of its peak over a regular grid of angles.
///   In      an IesFile.   Out: words, two entries each, and what the grid covers.
///           shaders/material/surface/profiles.glsl looks up.
///   Grid    rows by the angle to forward, from 0 to the last one that the file has; columns around it, the full turn.
///           As fine as the file's angles, down to half a degree and 2.5 degrees: files of type C whose angles are
///           multiples of the steps keep their values, others are resampled.
///   Memory  2 B an entry, at most 102 KiB.
///   Thread  any; pure. Fails: std::bad_alloc.
#pragma once

#include "filament_core/assets/tables/IesFile.h"

#include <cstdint>

namespace filament_core::assets {

struct LightProfileTable {
    uint32_t rows = 2;           ///< >= 2
    uint32_t columns = 1;        ///< 1: the same all around
    float lastRadians = 0;       ///< angle of the last row; beyond it is no light
    float peak = 0;              ///< candelas of share 1
    double lumens = 0;           ///< of the table, over the sphere
    std::vector<uint32_t> words; ///< entry [column * rows + row]: the lower half of its word comes first

    /// As shaders do, in double precision: a share of the peak. `direction`: unit, in the frame of IesFile.
    double shareAt(double3 const& direction) const;
};

LightProfileTable makeLightProfileTable(IesFile const& file);

} // namespace filament_core::assets
