// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Points.h>

namespace filament_core {

PointCloud PointCloud::create(Engine& engine, std::span<const PointQuads> quads) {
    PointCloud cloud;
    cloud.mIndices = engine.own(engine.create(pointIndexBuffer()));
    for (PointQuads const& group : quads) {
        if (group.vertices.empty()) continue;
        cloud.mGroups.push_back(
                { group.center, group.bounds, group.indexCount(), engine.own(engine.create(group.vertexBuffer())) });
    }
    return cloud;
}

Node PointCloud::addTo(Scene& scene, MaterialInstance material, NodeDesc const& node, double marginMeters) const {
    const Node cloud = scene.add(node);
    for (Group const& group : mGroups) {
        double4x4 place(1.0);
        place[3] = double4(group.center, 1);
        scene.add({ .vertices = group.vertices,
                    .indices = mIndices,
                    .material = material,
                    .indexCount = group.indexCount,
                    .bounds = Box{ group.bounds.min - marginMeters, group.bounds.max + marginMeters },
                    .node = scene.add(NodeDesc{ .parent = cloud, .parentFromNode = place }),
                    .name = "points" });
    }
    return cloud;
}

} // namespace filament_core
