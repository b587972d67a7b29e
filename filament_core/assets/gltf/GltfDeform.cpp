// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/geometry/TangentFrame.h"
#include "filament_core/assets/gltf/Accessor.h"
#include "filament_core/assets/gltf/GltfGeometry.h"

#include <algorithm>

namespace filament_core::assets {
namespace {

/// values[i] += weight * deltas[i]
template <class T>
void addDeltas(GltfDocument const& document, uint32_t accessor, float weight, const char* name, std::vector<T>& values,
               Diagnostics& diagnostics) {
    if (accessor == kNone || values.empty()) return;
    const std::vector<float3> deltas = readVectors<float3>(document, accessor, name, diagnostics);
    if (!diagnostics.ok()) return;
    if (deltas.size() != values.size()) {
        diagnostics.refuse(ErrorCode::Corrupt, "accessors[{}]: a morph target has {} elements for {} vertices",
                           accessor, deltas.size(), values.size());
        return;
    }
    for (size_t i = 0; i < values.size(); ++i) values[i] = T(float3(values[i]) + weight * deltas[i]);
}

template <>
void addDeltas(GltfDocument const& document, uint32_t accessor, float weight, const char* name,
               std::vector<float4>& tangents, Diagnostics& diagnostics) {
    std::vector<float3> directions; // morph targets do not change the handedness
    directions.reserve(tangents.size());
    for (float4 const& tangent : tangents) directions.emplace_back(tangent);
    addDeltas(document, accessor, weight, name, directions, diagnostics);
    for (size_t i = 0; i < tangents.size(); ++i) tangents[i] = float4(directions[i], tangents[i].w);
}

/// The transform of one vertex: the weighted mean of the joints. Weights that do not sum to 1 are scaled (3.7.3.3).
float4x4 blendJoints(std::span<const float4x4> worldFromBind, GltfGeometry const& geometry, size_t vertex,
                     bool& isInRange) {
    float4x4 blended(0.0f);
    float sum = 0;
    for (size_t set = 0; set < GltfAttributes::kJointSets; ++set) {
        if (geometry.joints[set].empty() || geometry.weights[set].empty()) continue;
        for (int k = 0; k < 4; ++k) {
            const float weight = geometry.weights[set][vertex][k];
            const uint32_t joint = geometry.joints[set][vertex][k];
            if (weight == 0) continue; // unused slots may contain anything
            if (joint >= worldFromBind.size()) {
                isInRange = false;
                continue;
            }
            blended += weight * worldFromBind[joint];
            sum += weight;
        }
    }
    if (!(sum > 0)) return worldFromBind[0]; // without weights, a vertex follows the first joint
    return blended * (1.0f / sum);
}

/// Transforms normals by the cofactors of the upper 3x3: its inverse transpose without the division.
float3x3 normalMatrix(float3 x, float3 y, float3 z) { return { glm::cross(y, z), glm::cross(z, x), glm::cross(x, y) }; }

void reverseTriangles(GltfGeometry& geometry) {
    for (size_t i = 0; i + 2 < geometry.indices.size(); i += 3)
        std::swap(geometry.indices[i + 1], geometry.indices[i + 2]);
}

} // namespace

void applyMorphTargets(GltfDocument const& document, GltfPrimitive const& primitive, std::span<const float> weights,
                       GltfGeometry& geometry, Diagnostics& diagnostics) {
    const size_t count = std::min(weights.size(), primitive.targets.size());
    for (size_t i = 0; i < count && diagnostics.ok(); ++i) {
        if (weights[i] == 0) continue;
        GltfMorphTarget const& target = primitive.targets[i];
        addDeltas(document, target.position, weights[i], "a POSITION target", geometry.positions, diagnostics);
        addDeltas(document, target.normal, weights[i], "a NORMAL target", geometry.normals, diagnostics);
        addDeltas(document, target.tangent, weights[i], "a TANGENT target", geometry.tangents, diagnostics);
        geometry.positionFormat = backend::VertexFormat::Float3;
        geometry.frames.clear();
    }
}

void applySkin(std::span<const float4x4> worldFromBind, std::string const& path, GltfGeometry& geometry,
               Diagnostics& diagnostics) {
    if (worldFromBind.empty() || geometry.joints[0].empty() || geometry.weights[0].empty()) {
        diagnostics.warn("{}: is skinned but has no joints or weights, and is drawn as it is", path);
        return;
    }
    bool isInRange = true;
    size_t mirrored = 0;
    for (size_t i = 0; i < geometry.positions.size(); ++i) {
        const float4x4 matrix = blendJoints(worldFromBind, geometry, i, isInRange);
        const float3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
        // normalMatrix() is the inverse transpose times the determinant, which is negative for a matrix that mirrors.
        const float mirror = glm::dot(x, glm::cross(y, z)) < 0 ? -1.0f : 1.0f;
        mirrored += mirror < 0;
        geometry.positions[i] = float3(matrix * float4(geometry.positions[i], 1.0f));
        if (!geometry.normals.empty()) {
            float3& normal = geometry.normals[i];
            normal = normalizedOr(mirror * (normalMatrix(x, y, z) * normal), normal);
        }
        if (!geometry.tangents.empty()) {
            float4& tangent = geometry.tangents[i];
            tangent = float4(normalizedOr(float3x3(x, y, z) * float3(tangent), float3(tangent)), tangent.w * mirror);
        }
    }
    geometry.positionFormat = backend::VertexFormat::Float3;
    geometry.frames.clear();
    // The winding belongs to triangles, mirroring to vertices: the majority decides for the whole primitive.
    if (mirrored * 2 > geometry.positions.size() && geometry.topology == backend::PrimitiveType::Triangles) {
        reverseTriangles(geometry);
    }
    if (!isInRange) diagnostics.refuse(ErrorCode::Corrupt, "{}: names a joint that its skin lacks", path);
}

} // namespace filament_core::assets
