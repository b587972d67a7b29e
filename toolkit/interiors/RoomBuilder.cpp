// SPDX-License-Identifier: Apache-2.0
#include "toolkit/interiors/RoomBuilder.h"

#include <fmt/format.h>

#include <cmath>

namespace filament_core::interiors {

uint32_t RoomBuilder::paint(const char* name, float3 color, float roughness, float metallic) {
    assets::MaterialData material{ .name = name };
    material.baseColorFactor = float4(color, 1);
    material.metallicFactor = metallic;
    material.roughnessFactor = roughness;
    mScene.materials.push_back(std::move(material));
    return static_cast<uint32_t>(mScene.materials.size() - 1);
}

uint32_t RoomBuilder::mesh(std::string name, assets::GlbPrimitive primitive) {
    mScene.meshes.push_back({ std::move(name), { std::move(primitive) } });
    return static_cast<uint32_t>(mScene.meshes.size() - 1);
}

void RoomBuilder::node(std::string name, uint32_t mesh, double4x4 const& place) {
    mScene.nodes.push_back({ .name = std::move(name), .parentFromNode = place, .mesh = mesh });
}

void RoomBuilder::add(std::string const& name, uint32_t material, showcase::Shape const& shape, double3 at) {
    double4x4 place(1.0);
    place[3] = double4(at, 1);
    assets::GlbPrimitive primitive{
        .positions = shape.positions, .normals = shape.normals, .indices = shape.indices, .material = material
    };
    node(name, mesh(name, std::move(primitive)), place);
}

void RoomBuilder::add(std::string const& name, uint32_t material, std::vector<Rectangle> const& rectangles,
                      double panelMeters) {
    assets::GlbPrimitive whole{ .material = material };
    uint32_t panels = 0;
    for (Rectangle const& one : rectangles) {
        if (!(panelMeters > 0)) {
            addRectangle(whole, one);
            continue;
        }
        const auto parts = [&](double3 side) { return std::max(1.0, std::ceil(glm::length(side) / panelMeters)); };
        const double columns = parts(one.u), rows = parts(one.v);
        for (double y = 0; y < rows; ++y) {
            for (double x = 0; x < columns; ++x) {
                assets::GlbPrimitive panel{ .material = material };
                addRectangle(panel, { one.corner + one.u * (x / columns) + one.v * (y / rows), one.u / columns,
                                      one.v / rows });
                add(fmt::format("{} {}", name, panels++), std::move(panel));
            }
        }
    }
    if (!whole.positions.empty()) add(name, std::move(whole));
}

void RoomBuilder::addBox(std::string const& name, uint32_t material, double3 low, double3 high) {
    add(name, material, sidesOf(low, high), 0);
}

void addQuad(assets::GlbPrimitive& primitive, std::array<float3, 4> const& corners) {
    const auto first = static_cast<uint32_t>(primitive.positions.size());
    const float3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (float3 const& corner : corners) primitive.positions.push_back(corner), primitive.normals.push_back(normal);
    for (const uint32_t i : { 0u, 1u, 2u, 0u, 2u, 3u }) primitive.indices.push_back(first + i);
}

void addRectangle(assets::GlbPrimitive& primitive, Rectangle const& rectangle) {
    auto const& [corner, u, v] = rectangle;
    addQuad(primitive, { float3(corner), float3(corner + u), float3(corner + u + v), float3(corner + v) });
}

std::vector<Rectangle> around(Rectangle const& rectangle, double2 low, double2 high) {
    auto const& [corner, u, v] = rectangle;
    const double3 left = u * low.x, right = u * (1 - high.x), bottom = v * low.y, top = v * (1 - high.y);
    const double3 middle = v * (high.y - low.y);
    return { { corner, u, bottom },
             { corner + v - top, u, top },
             { corner + bottom, left, middle },
             { corner + bottom + u - right, right, middle } };
}

std::vector<Rectangle> sidesOf(double3 low, double3 high) {
    const double3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
    return { { low, z, y }, { low + x, y, z }, { low, x, z }, { low + y, z, x }, { low, y, x }, { low + z, x, y } };
}

} // namespace filament_core::interiors
