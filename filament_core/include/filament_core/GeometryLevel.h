// SPDX-License-Identifier: Apache-2.0
/// GeometryLevel: a coarser version of the geometry of a renderable, drawn where its error is small on the screen
/// (View::lod). docs/levels-of-detail.md.
///   Use   RenderableDesc::levels. loadGltf() makes them for models: GltfLoadOptions::simplified.
///   Rule  levels have the vertices and the index buffer of the geometry that they go with, and are sorted: each has a
///         larger error than the one before, or the same.
#pragma once

#include <filament_core/Occluder.h>

#include <cstdint>

namespace filament_core {

struct GeometryLevel {
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0; ///< > 0
    /// How far its surface is from the finest one, at most: metres in object space, >= 0, finite.
    float errorMeters = 0;
    /// Of the triangles of this level; as RenderableDesc::occluder.
    Occluder occluder{};
};

} // namespace filament_core
