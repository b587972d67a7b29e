// SPDX-License-Identifier: Apache-2.0
// Skins and morph targets that the device applies: collected and checked here, otherwise unchanged.
#include "filament_core/assets/gltf/Accessor.h"
#include "filament_core/assets/gltf/GltfGeometry.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <cmath>

namespace filament_core::assets {
namespace {

/// Texels of one primitive's targets: 256 MiB.
constexpr uint64_t kMaxMorphTexels = uint64_t{ 1 } << 24;

std::vector<float3> readDeltas(GltfDocument const& document, uint32_t accessor, const char* name, size_t vertices,
                               Diagnostics& diagnostics) {
    if (accessor == kNone || vertices == 0) return {};
    std::vector<float3> deltas = readVectors<float3>(document, accessor, name, diagnostics);
    if (diagnostics.ok() && deltas.size() != vertices) {
        diagnostics.refuse(ErrorCode::Corrupt, "accessors[{}]: a morph target has {} elements for {} vertices",
                           accessor, deltas.size(), vertices);
    }
    return deltas;
}

/// Whether the stored weights of every vertex sum to 1.
bool sumToOne(GltfGeometry const& geometry) {
    for (size_t i = 0; i < geometry.positions.size(); ++i) {
        float sum = 0;
        for (auto const& weights : geometry.weights) {
            if (!weights.empty()) sum += weights[i].x + weights[i].y + weights[i].z + weights[i].w;
        }
        if (std::abs(sum - 1) > 1e-6f) return false;
    }
    return true;
}

/// Section 3.7.3.3: unused joints become 0, weights are scaled to a sum of 1; a vertex without weights follows the
/// first joint.
bool repairVertex(GltfGeometry& geometry, size_t vertex, size_t jointCount) {
    double sum = 0;
    for (size_t set = 0; set < GltfAttributes::kJointSets; ++set) {
        if (geometry.joints[set].empty()) continue;
        for (int k = 0; k < 4; ++k) {
            const float weight = geometry.weights[set][vertex][k];
            uint32_t& joint = geometry.joints[set][vertex][k];
            sum += static_cast<double>(weight);
            if (weight == 0)
                joint = 0;
            else if (joint >= jointCount)
                return false;
        }
    }
    if (!(sum > 0)) {
        for (auto& weights : geometry.weights) {
            if (!weights.empty()) weights[vertex] = float4(0.0f);
        }
        geometry.weights[0][vertex].x = 1;
        geometry.joints[0][vertex].x = 0;
        return true;
    }
    if (std::abs(sum - 1) <= 1e-6) return true;
    for (auto& weights : geometry.weights) {
        if (!weights.empty()) weights[vertex] *= static_cast<float>(1 / sum);
    }
    return true;
}

} // namespace

bool canKeepTargets(GltfPrimitive const& primitive, GltfGeometry const& geometry, std::string const& path,
                    Diagnostics& diagnostics) {
    // Flat normals need a vertex for every corner.
    const size_t vertices = std::max(geometry.positions.size(), geometry.normals.empty() ? geometry.indices.size() : 0);
    const uint64_t texels = uint64_t{ 3 } * vertices * primitive.targets.size();
    if (texels <= kMaxMorphTexels) return true;
    diagnostics.warn("{}: {} morph targets of {} vertices are more than {} texels: it is drawn at rest", path,
                     primitive.targets.size(), vertices, kMaxMorphTexels);
    return false;
}

void keepMorphTargets(GltfDocument const& document, GltfPrimitive const& primitive, GltfGeometry& geometry,
                      Diagnostics& diagnostics) {
    for (GltfMorphTarget const& source : primitive.targets) {
        const auto read = [&](uint32_t accessor, const char* name, size_t vertices) {
            return readDeltas(document, accessor, name, vertices, diagnostics);
        };
        geometry.targets.push_back({ read(source.position, "a POSITION target", geometry.positions.size()),
                                     read(source.normal, "a NORMAL target", geometry.normals.size()),
                                     read(source.tangent, "a TANGENT target", geometry.tangents.size()) });
        if (!diagnostics.ok()) return;
    }
}

void keepSkin(size_t jointCount, std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics) {
    for (size_t set = 0; set < GltfAttributes::kJointSets; ++set) {
        if (!geometry.joints[set].empty() && !geometry.weights[set].empty()) continue;
        geometry.joints[set].clear();
        geometry.weights[set].clear();
    }
    if (geometry.joints[0].empty()) {
        diagnostics.warn("{}: is skinned but has no joints or weights, and is drawn as it is", path);
        return;
    }
    // Scaled weights are not the integers that the file has, so they need floats. The format is chosen for the whole
    // primitive, before the first vertex is repaired.
    if (!sumToOne(geometry)) geometry.weightFormat = backend::VertexFormat::Float4;
    for (size_t i = 0; i < geometry.positions.size(); ++i) {
        if (repairVertex(geometry, i, jointCount)) continue;
        diagnostics.refuse(ErrorCode::Corrupt, "{}: names a joint that its skin lacks", path);
        return;
    }
    geometry.isSkinned = true;
}

std::vector<BoundsData> boundsOfBones(GltfGeometry const& geometry) {
    std::vector<BoundsData> bounds;
    if (!geometry.isSkinned) return bounds;
    for (size_t set = 0; set < GltfAttributes::kJointSets; ++set) {
        for (size_t i = 0; i < geometry.joints[set].size(); ++i) {
            for (int k = 0; k < 4; ++k) {
                if (geometry.weights[set][i][k] == 0) continue;
                const uint32_t joint = geometry.joints[set][i][k];
                if (joint >= bounds.size()) bounds.resize(joint + 1);
                bounds[joint].add(geometry.positions[i]);
            }
        }
    }
    return bounds;
}

std::vector<float3> positionsAtRest(GltfGeometry const& geometry, std::span<const float> weights,
                                    std::span<const float4x4> worldFromBind) {
    GltfGeometry posed;
    posed.positions = geometry.positions;
    for (size_t t = 0; t < std::min(weights.size(), geometry.targets.size()); ++t) {
        std::vector<float3> const& deltas = geometry.targets[t].positions;
        for (size_t i = 0; i < deltas.size(); ++i) posed.positions[i] += weights[t] * deltas[i];
    }
    if (geometry.isSkinned) {
        posed.joints = geometry.joints;
        posed.weights = geometry.weights;
        Diagnostics ignored; // the joints were checked
        applySkin(worldFromBind, "", posed, ignored);
    }
    for (size_t i = 0; i < posed.positions.size(); ++i) // of bounds: a place in the mesh is better than none
        if (!allFinite(posed.positions[i])) posed.positions[i] = geometry.positions[i];
    return std::move(posed.positions);
}

} // namespace filament_core::assets
