// SPDX-License-Identifier: Apache-2.0
/// RoomBuilder: collects rectangles, boxes and shapes as meshes of a scene, each with a node of its name.
///   Thread  one thread at a time.
#pragma once

#include "filament_core/assets/gltf/GltfWriter.h"
#include "toolkit/showcase/Shapes.h"

#include <array>
#include <string>

namespace filament_core::interiors {

/// A rectangle from `corner` along two sides; its front is that of cross(u, v).
struct Rectangle {
    double3 corner{ 0.0 }, u{ 1, 0, 0 }, v{ 0, 1, 0 };
};

class RoomBuilder {
public:
    explicit RoomBuilder(std::string name) { mScene.name = std::move(name); }

    uint32_t paint(const char* name, float3 color, float roughness = 1, float metallic = 0);
    /// One mesh for each material of the others: nodes may share it.
    uint32_t mesh(std::string name, assets::GlbPrimitive primitive);
    void node(std::string name, uint32_t mesh, double4x4 const& place = double4x4(1.0));

    void add(std::string const& name, assets::GlbPrimitive primitive) { node(name, mesh(name, std::move(primitive))); }
    void add(std::string const& name, uint32_t material, showcase::Shape const& shape, double3 at);
    /// `panelMeters` > 0: as meshes of at most that size, "NAME 0" and so on.
    void add(std::string const& name, uint32_t material, std::vector<Rectangle> const& rectangles, double panelMeters);
    /// From `low` to `high`, closed.
    void addBox(std::string const& name, uint32_t material, double3 low, double3 high);

    assets::GlbScene take() { return std::move(mScene); }
    assets::MaterialData& material(uint32_t index) { return mScene.materials[index]; }

private:
    assets::GlbScene mScene;
};

void addQuad(assets::GlbPrimitive& primitive, std::array<float3, 4> const& corners);
void addRectangle(assets::GlbPrimitive& primitive, Rectangle const& rectangle);

/// The wall `rectangle` around a hole from `low` to `high`, both in shares of its sides.
std::vector<Rectangle> around(Rectangle const& rectangle, double2 low, double2 high);
/// The six sides of a box, seen from outside.
std::vector<Rectangle> sidesOf(double3 low, double3 high);

} // namespace filament_core::interiors
