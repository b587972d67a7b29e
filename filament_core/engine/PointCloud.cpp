// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Points.h>

namespace filament_core {

struct PointCloud::Buffers {
    struct Group {
        double3 center;
        Box bounds;
        uint32_t indexCount;
        Owned<VertexBuffer> vertices;
    };
    Owned<IndexBuffer> indices;
    std::vector<Group> groups;
};

PointCloud PointCloud::create(Engine& engine, std::span<const PointQuads> quads) {
    const auto buffers = std::make_shared<Buffers>();
    buffers->indices = engine.own(engine.create(pointIndexBuffer()));
    for (PointQuads const& group : quads) {
        if (group.vertices.empty()) continue;
        buffers->groups.push_back(
                { group.center, group.bounds, group.indexCount(), engine.own(engine.create(group.vertexBuffer())) });
    }
    PointCloud cloud;
    cloud.mBuffers = buffers;
    return cloud;
}

Node PointCloud::addTo(Scene& scene, MaterialInstance material, NodeDesc const& node, double marginMeters) const {
    const Node cloud = scene.add(node);
    if (!mBuffers) return cloud;
    for (Buffers::Group const& group : mBuffers->groups) {
        double4x4 place(1.0);
        place[3] = double4(group.center, 1);
        scene.add({ .vertices = group.vertices,
                    .indices = mBuffers->indices,
                    .material = material,
                    .indexCount = group.indexCount,
                    .bounds = Box{ group.bounds.min - marginMeters, group.bounds.max + marginMeters },
                    .node = scene.add(NodeDesc{ .parent = cloud, .parentFromNode = place }),
                    .name = "points" });
    }
    return cloud;
}

} // namespace filament_core
