// SPDX-License-Identifier: Apache-2.0
/// Occluder: large triangles of an opaque mesh, kept for the CPU. What they hide from the camera is not drawn
/// (View::occlusionCulling); the image has the same bits as without.
///   Use     RenderableDesc::occluder. loadGltf() makes them for models, Mesh::occluder() for meshes of this engine.
///   Life    shared and immutable: renderables, scenes and threads may share one.
///   Rule    its triangles are those of the geometry that it goes with. After Engine::update() of these vertices, give
///           the renderable another one with Scene::setGeometry().
#pragma once

#include <filament_core/Math.h>

#include <cstdint>
#include <memory>
#include <span>

namespace filament_core {

class OccluderMesh;
using Occluder = std::shared_ptr<const OccluderMesh>;

/// Of the largest triangles, at most `maxTriangles` (at most 4096). Null where they have less than half of the area:
/// finely divided meshes hide too little for the time that they take.
///   positions  metres, in object space.   indices  three for each triangle, below positions.size().
Occluder makeOccluder(std::span<const float3> positions, std::span<const uint32_t> indices,
                      uint32_t maxTriangles = 256);

} // namespace filament_core
