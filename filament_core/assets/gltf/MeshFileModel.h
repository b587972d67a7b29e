// SPDX-License-Identifier: Apache-2.0
/// MeshFileModel: an .obj, .ply or .stl (meshfiles/MeshFile.h) as the bytes of a .glb, so that it passes through the
/// same loader as a glTF file.
///   In      any bytes, and where the files that an .obj names are: beside or below it.
///   Out     a node a part. Without normals the loader makes those of the triangles. Maps that cannot be read are
///           warnings.
///   Thread  any.   Memory: about five times the file, and its images.
///   Fails   as readMeshFile().
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "filament_core/assets/meshfiles/MeshFile.h"

namespace filament_core::assets {

Result<std::vector<std::byte>> glbOfMeshFile(std::span<const std::byte> file, MeshFormat format,
                                             GltfFolder const& folder, Diagnostics& diagnostics);

} // namespace filament_core::assets
