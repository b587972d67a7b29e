// SPDX-License-Identifier: Apache-2.0
/// addDetailLevels: levels of detail of a primitive of a glTF file (SimplifyMesh.h), behind its indices.
///   In      a primitive as it is uploaded.   Out: its indices have those of the levels behind them; indexCount stays.
///   Thread  any; changes this primitive only.   Fails: std::bad_alloc. Other primitives than triangles get no levels.
#pragma once

#include "filament_core/assets/gltf/ModelData.h"

#include <vector>

namespace filament_core::assets {

struct DetailLevel {
    uint32_t firstIndex = 0, indexCount = 0;
    float error = 0; ///< in units of the stored positions
};

/// The finest first.
std::vector<DetailLevel> addDetailLevels(PrimitiveData& primitive);

} // namespace filament_core::assets
