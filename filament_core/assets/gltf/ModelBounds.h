// SPDX-License-Identifier: Apache-2.0
/// ModelBounds: the smallest axis-aligned box around the vertices of a model in its rest pose.
///   Why     the box of a rotated box is up to 1.7 times as large as what is in it, and off its centre.
///   In      ModelData. Deformed primitives: restPositions, or their restBounds where a program made them without.
///   Out     exact except for the rounding of the stored positions.
///   Thread  any; the data is only read.   Memory: none.   Fails: never.
///   Cost    3 ns a vertex and node; nothing for a part whose box lies inside of what is already covered.
#pragma once

#include "filament_core/assets/gltf/ModelData.h"

#include <filament_core/Box.h>

namespace filament_core::assets {

/// Extends `box` by one primitive.
void growBounds(Box& box, PrimitiveData const& primitive, double4x4 const& worldFromMesh);

/// Of all nodes with a mesh, except those of coarser levels of detail, in the space of the file's scene; empty without
/// vertices.
Box boundsOf(ModelData const& model);

} // namespace filament_core::assets
