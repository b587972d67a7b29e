// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/ModelBounds.h"

#include "base/Assert.h"
#include "filament_core/scene/VertexPositions.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <span>

namespace filament_core::assets {
namespace {

void growPoint(Box& box, double3 point) {
    box.min = glm::min(box.min, point);
    box.max = glm::max(box.max, point);
}

bool contains(Box const& outer, Box const& inner) {
    return glm::min(outer.min, inner.min) == outer.min && glm::max(outer.max, inner.max) == outer.max;
}

/// Calls visit(position of the file, in the rest pose) for each vertex, or each corner of the box if that is all there
/// is.
template <class Visit>
void visitPositions(PrimitiveData const& primitive, Visit const& visit) {
    if (!primitive.restPositions.empty()) {
        for (float3 const& position : primitive.restPositions) visit(double3(position));
        return;
    }
    if (primitive.isSkinned || !primitive.morphTargets.empty()) {
        const double3 ends[2] = { double3(primitive.restBounds.min), double3(primitive.restBounds.max) };
        for (int i = 0; i < 8; ++i) visit({ ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z });
        return;
    }
    const std::span attributes(primitive.layout.attributes.data(), primitive.layout.attributeCount);
    const auto found = std::ranges::find(attributes, shader::kAttributePosition, &backend::VertexAttribute::location);
    if (found == attributes.end() || primitive.vertices.empty()) return;
    const size_t stride = primitive.layout.buffers[0].stride;
    const double3 offset(primitive.positionOffset);
    for (size_t vertex = 0; vertex < primitive.vertexCount; ++vertex) {
        const std::byte* const source = &primitive.vertices[vertex * stride + found->offset];
        visit(offset + double(primitive.positionScale) * *scene::positionAt(source, found->format));
    }
}

/// Of the stored positions in the space of the file: a box that holds the primitive, unless it is deformed.
Box storedBounds(PrimitiveData const& primitive) {
    const double3 offset(primitive.positionOffset);
    const double scale = primitive.positionScale;
    return { offset + scale * double3(primitive.boundsMin), offset + scale * double3(primitive.boundsMax) };
}

Box transformed(Box const& box, double4x4 const& matrix) {
    Box result;
    for (int i = 0; i < 8; ++i) {
        const double3 corner((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                             (i & 4) != 0 ? box.max.z : box.min.z);
        growPoint(result, double3(matrix * double4(corner, 1.0)));
    }
    return result;
}

} // namespace

void growBounds(Box& box, PrimitiveData const& primitive, double4x4 const& worldFromMesh) {
    if (primitive.splats) {
        const scene::MinMax& bounds = primitive.splats->bounds;
        const Box placed = transformed({ double3(bounds.min), double3(bounds.max) }, worldFromMesh);
        growPoint(box, placed.min), growPoint(box, placed.max);
    }
    if (primitive.vertexCount == 0) return;
    const bool isDeformed = primitive.isSkinned || !primitive.morphTargets.empty();
    if (!isDeformed && contains(box, transformed(storedBounds(primitive), worldFromMesh))) return;
    visitPositions(primitive,
                   [&](double3 const& position) { growPoint(box, double3(worldFromMesh * double4(position, 1.0))); });
}

Box boundsOf(ModelData const& model) {
    Box box;
    std::vector<bool> isCoarser; // or below one that is
    for (NodeData const& node : model.nodes) {
        const auto isOf = [&](uint32_t other) { return other != kNone && isCoarser[other]; };
        isCoarser.push_back(node.isCoarserLevel || isOf(node.parent) || isOf(node.visibleWith));
        if (node.mesh == kNone || isCoarser.back()) continue;
        for (PrimitiveData const& primitive : model.meshes[node.mesh].primitives)
            growBounds(box, primitive, node.worldFromNode);
    }
    return box;
}

} // namespace filament_core::assets
