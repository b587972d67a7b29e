// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfMeshes.h"

#include "filament_core/assets/gltf/GltfGeometry.h"
#include "filament_core/assets/gltf/GltfSplats.h"

#include <exception>
#include <optional>

namespace filament_core::assets {
namespace {

/// What tangents follow, if a material of the primitive needs them. With several maps the normal map decides, as
/// KHR_materials_anisotropy specifies; a transform that changes in time is left to the shader.
std::optional<TangentBasis> tangentBasis(GltfDocument const& document, GltfPrimitive const& primitive) {
    std::vector<uint32_t> materials;
    if (primitive.material != kNone) materials.push_back(primitive.material);
    for (VariantMaterial const& variant : primitive.variants) materials.push_back(variant.material);
    std::optional<TangentBasis> basis;
    const auto take = [&](GltfTextureInfo const& map, bool isUsed) {
        if (basis || !isUsed || map.texture == kNone) return;
        basis = { map.uvSet, turnOf({ .uvTransform = map.uvTransform, .isAnimated = map.isAnimated }) };
    };
    for (const uint32_t index : materials) take(document.materials[index].normal, true);
    for (const uint32_t index : materials) {
        GltfMaterial const& material = document.materials[index];
        take(material.anisotropy, material.values.anisotropy.isUsed());
        take(material.clearCoatNormal, material.values.clearCoat.isUsed());
        if (!basis && material.values.anisotropy.isUsed()) basis = TangentBasis{};
    }
    return basis;
}

void morph(GltfDocument const& document, GltfMeshRequest const& request, GltfPrimitive const& primitive,
           std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics) {
    if (request.keepsTargets && canKeepTargets(primitive, geometry, path, diagnostics))
        keepMorphTargets(document, primitive, geometry, diagnostics);
    else
        applyMorphTargets(document, primitive, request.weights, geometry, diagnostics);
}

PrimitiveData build(GltfDocument const& document, GltfMeshRequest const& request, GltfPrimitive const& primitive,
                    GeometryStorage const& storage, std::string const& path, Diagnostics& diagnostics) {
    if (primitive.splats) return buildSplats(document, primitive, path, diagnostics);
    GltfGeometry geometry = gatherGeometry(document, primitive, path, diagnostics);
    if (!diagnostics.ok() || geometry.positions.empty()) return {};
    // The list comes first, because everything below takes whole triangles, and it checks all indices. Morph targets
    // come before the skin, whose matrices start from the morphed mesh, as in the shader.
    makeList(primitive, path, geometry, diagnostics);
    if (diagnostics.ok()) checkFrames(path, geometry, diagnostics);
    if (diagnostics.ok()) repairDirections(path, geometry, diagnostics);
    if (diagnostics.ok()) morph(document, request, primitive, path, geometry, diagnostics);
    if (!diagnostics.ok() || geometry.indices.empty()) return {};
    // Not before the morph targets: their accessors have an element for every vertex of the file.
    dropUnusedVertices(geometry);
    if (request.keepsSkin)
        keepSkin(request.worldFromBind.size(), path, geometry, diagnostics);
    else if (request.skin != kNone)
        applySkin(request.worldFromBind, path, geometry, diagnostics);
    if (!diagnostics.ok()) return {};
    // After morphing and skinning, either of which can overflow.
    dropNonFinite(path, geometry, diagnostics);
    if (geometry.indices.empty()) return {};
    // Normals come before tangents, which lie in their planes.
    addFlatNormals(geometry);
    std::optional<TangentBasis> basis = tangentBasis(document, primitive);
    if (basis) basis = addTangents(geometry, *basis);
    // Before packing, which may round the positions and takes the geometry.
    std::vector<float3> atRest = positionsAtRest(geometry, request.weights, request.worldFromBind);
    const bool isDeformed = geometry.isSkinned || !geometry.targets.empty();
    PrimitiveData packed = packGeometry(std::move(geometry), storage);
    packed.tangentBasis = basis.value_or(TangentBasis{});
    for (float3 const& position : atRest) packed.restBounds.add(position);
    if (isDeformed) packed.restPositions = std::move(atRest);
    return packed;
}

} // namespace

std::vector<GltfPrimitiveJob> listPrimitives(GltfDocument const& document, GltfScene const& scene,
                                             Diagnostics& diagnostics) {
    constexpr uint64_t kMaxVertices = uint64_t{ 1 } << 27, kMaxIndices = uint64_t{ 1 } << 29;
    std::vector<GltfPrimitiveJob> jobs;
    uint64_t vertices = 0, indices = 0;
    for (uint32_t r = 0; r < scene.meshes.size(); ++r) {
        std::vector<GltfPrimitive> const& primitives = document.meshes[scene.meshes[r].mesh].primitives;
        for (uint32_t p = 0; p < primitives.size(); ++p) {
            jobs.push_back({ .request = r, .primitive = p, .data = {}, .diagnostics = {} });
            const uint32_t position = primitives[p].attributes.position;
            if (position != kNone) vertices += document.accessors[position].count;
            if (primitives[p].indices != kNone) indices += document.accessors[primitives[p].indices].count;
        }
    }
    if (vertices > kMaxVertices || indices > kMaxIndices) {
        diagnostics.refuse(ErrorCode::Unsupported, "the scene has {} vertices and {} indices, beyond {} and {}",
                           vertices, indices, kMaxVertices, kMaxIndices);
    }
    return jobs;
}

void buildPrimitive(GltfDocument const& document, GltfScene const& scene, GeometryStorage const& storage,
                    GltfPrimitiveJob& job) {
    GltfMeshRequest const& request = scene.meshes[job.request];
    const std::string path = fmt::format("meshes[{}].primitives[{}]", request.mesh, job.primitive);
    GltfPrimitive const& primitive = document.meshes[request.mesh].primitives[job.primitive];
    try {
        job.data = build(document, request, primitive, storage, path, job.diagnostics);
    } catch (std::bad_alloc const&) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "{}: out of memory; free some and try again", path);
    } catch (std::exception const& exception) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "{}: {}", path, exception.what());
    }
}

std::vector<MeshData> collectMeshes(GltfDocument const& document, GltfScene const& scene,
                                    std::vector<GltfPrimitiveJob>& jobs) {
    std::vector<MeshData> meshes;
    for (GltfMeshRequest const& request : scene.meshes) {
        GltfMesh const& mesh = document.meshes[request.mesh];
        meshes.push_back({ mesh.name, {}, mesh.targetNames });
    }
    for (GltfPrimitiveJob& job : jobs) {
        if (job.data.indexCount == 0 && !job.data.splats) continue;
        GltfPrimitive const& primitive = document.meshes[scene.meshes[job.request].mesh].primitives[job.primitive];
        job.data.material = primitive.material;
        job.data.variants = primitive.variants;
        meshes[job.request].primitives.push_back(std::move(job.data));
    }
    return meshes;
}

} // namespace filament_core::assets
