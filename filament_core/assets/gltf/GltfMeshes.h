// SPDX-License-Identifier: Apache-2.0
/// GltfMeshes: builds the geometry that a scene needs, one primitive at a time.
///   In      a document whose buffers are loaded, and a request of planScene().
///   Out     vertices and indices ready to upload; the caller drops empty primitives (indexCount 0).
///   Thread  any; one call per primitive, all in parallel.
///   Limits  2^27 vertices and 2^29 indices for all requests together (checkBudget, before anything is allocated).
///   Fails   through the diagnostics; exceptions of libraries and of the allocator are caught there as well.
#pragma once

#include "filament_core/assets/gltf/GltfScene.h"

namespace filament_core::assets {

/// One primitive of one request.
struct GltfPrimitiveJob {
    uint32_t request = 0, primitive = 0;
    PrimitiveData data;
    Diagnostics diagnostics;
};

std::vector<GltfPrimitiveJob> listPrimitives(GltfDocument const& document, GltfScene const& scene,
                                             Diagnostics& diagnostics);

void buildPrimitive(GltfDocument const& document, GltfScene const& scene, GeometryStorage const& storage,
                    GltfPrimitiveJob& job);

/// Moves the built primitives into one mesh per request.
std::vector<MeshData> collectMeshes(GltfDocument const& document, GltfScene const& scene,
                                    std::vector<GltfPrimitiveJob>& jobs);

} // namespace filament_core::assets
