// SPDX-License-Identifier: Apache-2.0
// Meshes: simple shapes, and triangles from arrays.
#include "python/Bindings.h"

#include <filament_core/Mesh.h>
#include <filament_core/Primitives.h>

namespace filament_core::python {
namespace {

std::shared_ptr<MeshObject> upload(EngineObject const& self, Mesh const& mesh) {
    const Owner::Call call(*self.owner);
    Engine& engine = call.engine();
    Owned<VertexBuffer> vertices = engine.own(engine.create(mesh.vertexBuffer()));
    Owned<IndexBuffer> indices = engine.own(engine.create(mesh.indexBuffer()));
    if (!vertices.get() || !indices.get()) {
        self.owner->raiseErrors();
        raise({ ErrorCode::OutOfMemory, "there is no memory for the mesh" });
    }
    OwnedMesh made{ std::move(vertices), std::move(indices), static_cast<uint32_t>(mesh.vertices.size()),
                    static_cast<uint32_t>(mesh.indices.size() / 3) };
    return std::make_shared<MeshObject>(self.owner, std::move(made));
}

float lengthOf(double value, const char* name) { return static_cast<float>(numberIn(value, name, 1e-15, 1e15)); }

uint32_t countOf(int64_t value, const char* name, int64_t least, int64_t most) {
    if (value < least || value > most) raiseInvalid("{}: {} is not from {} to {}", name, value, least, most);
    return static_cast<uint32_t>(value);
}

std::vector<uint32_t> indicesOf(py::object const& triangles, size_t vertices) {
    const py::array given = py::array::ensure(triangles);
    if (!given || (given.dtype().kind() != 'i' && given.dtype().kind() != 'u') || given.ndim() != 2 ||
        given.shape(1) != 3 || given.shape(0) == 0 || given.shape(0) >= (1 << 24)) {
        PyErr_Clear();
        raiseInvalid("triangles: not an array of 1 to 2^24 rows of three integers");
    }
    const py::array_t<int64_t, py::array::c_style | py::array::forcecast> values(given);
    std::vector<uint32_t> indices;
    for (py::ssize_t i = 0; i < values.size(); ++i) {
        const int64_t index = values.data()[i];
        if (index < 0 || static_cast<size_t>(index) >= vertices)
            raiseInvalid("triangles: vertex {} of triangle {} is not below {}", index, i / 3, vertices);
        indices.push_back(static_cast<uint32_t>(index));
    }
    return indices;
}

/// Rows of the same number as there are vertices, or none.
std::vector<float> attributeOf(py::object const& values, const char* name, size_t columns, size_t vertices) {
    if (values.is_none()) return {};
    std::vector<float> rows = rowsOf(values, name, columns);
    if (rows.size() != columns * vertices)
        raiseInvalid("{}: {} rows, but there are {} vertices", name, rows.size() / columns, vertices);
    return rows;
}

std::shared_ptr<MeshObject> makeMesh(EngineObject const& self, py::object const& positions, py::object const& triangles,
                                     py::object const& normals, py::object const& uv, py::object const& colors) {
    const std::vector<float> places = rowsOf(positions, "positions", 3);
    const size_t count = places.size() / 3;
    if (count == 0) raiseInvalid("positions: a mesh has at least one vertex");
    Mesh mesh{ .vertices = std::vector<MeshVertex>(count), .indices = indicesOf(triangles, count) };
    const std::vector<float> directions = attributeOf(normals, "normals", 3, count);
    const std::vector<float> coordinates = attributeOf(uv, "uv", 2, count);
    const std::vector<float> shades = attributeOf(colors, "colors", 4, count);
    for (size_t i = 0; i < count; ++i) {
        MeshVertex& vertex = mesh.vertices[i];
        vertex.position = { places[i * 3], places[i * 3 + 1], places[i * 3 + 2] };
        if (!directions.empty()) vertex.normal = { directions[i * 3], directions[i * 3 + 1], directions[i * 3 + 2] };
        if (!coordinates.empty()) vertex.uv = { coordinates[i * 2], coordinates[i * 2 + 1] };
        if (!shades.empty()) vertex.color = { shades[i * 4], shades[i * 4 + 1], shades[i * 4 + 2], shades[i * 4 + 3] };
    }
    if (directions.empty()) check(computeNormals(mesh));
    check(computeTangents(mesh));
    return upload(self, mesh);
}

} // namespace

void bindMeshes(py::module_& module, EngineClass& engine) {
    py::class_<MeshObject, std::shared_ptr<MeshObject>>(
            module, "Mesh",
            "Triangles on the device, for Scene.add_mesh(). From Engine.mesh(), box(), plane(), sphere().")
            .def_property_readonly(
                    "vertex_count", [](MeshObject const& self) { return self->vertexCount; },
                    "How many vertices it has.")
            .def_property_readonly(
                    "triangle_count", [](MeshObject const& self) { return self->triangleCount; },
                    "How many triangles it has.");
    engine.def("mesh", &makeMesh, py::arg("positions"), py::arg("triangles"), py::kw_only(),
               py::arg("normals") = py::none(), py::arg("uv") = py::none(), py::arg("colors") = py::none(),
               "A mesh from arrays: positions (n, 3), triangles (m, 3), counter-clockwise from the front. Normals are "
               "computed if they are not given; uv has v upwards, colors are linear and have four components.")
            .def(
                    "plane",
                    [](EngineObject const& self, double width, double depth) {
                        return upload(self, valueOf(makePlane({ .width = lengthOf(width, "width"),
                                                                .depth = lengthOf(depth, "depth") })));
                    },
                    py::arg("width") = 1.0, py::arg("depth") = 1.0, "A rectangle in y = 0 that faces +y.")
            .def(
                    "box",
                    [](EngineObject const& self, py::object const& size) {
                        const double3 sides = double3Of(size, "size");
                        const float3 lengths{ lengthOf(sides.x, "size"), lengthOf(sides.y, "size"),
                                              lengthOf(sides.z, "size") };
                        return upload(self, valueOf(makeBox({ .size = lengths })));
                    },
                    py::arg("size") = py::make_tuple(1, 1, 1), "A box around the origin.")
            .def(
                    "sphere",
                    [](EngineObject const& self, double radius, int64_t slices, int64_t stacks) {
                        return upload(self, valueOf(makeUvSphere({ .radius = lengthOf(radius, "radius"),
                                                                   .slices = countOf(slices, "slices", 3, 2048),
                                                                   .stacks = countOf(stacks, "stacks", 2, 2048) })));
                    },
                    py::arg("radius") = 0.5, py::arg("slices") = 32, py::arg("stacks") = 16,
                    "A ball around the origin.");
}

} // namespace filament_core::python
