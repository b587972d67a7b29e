// SPDX-License-Identifier: Apache-2.0
// Meshes: simple shapes, and triangles from arrays.
#include "python/Bindings.h"

#include <filament_core/Mesh.h>
#include <filament_core/Primitives.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace filament_core::python {
namespace {

std::shared_ptr<MeshObject> upload(EngineObject const& self, Mesh given, Mesh const& mesh, bool hasNormals) {
    const Owner::Call call(*self.owner);
    Engine& engine = call.engine();
    Owned<VertexBuffer> vertices = engine.own(engine.create(mesh.vertexBuffer()));
    Owned<IndexBuffer> indices = engine.own(engine.create(mesh.indexBuffer()));
    if (!vertices.get() || !indices.get()) {
        self.owner->raiseErrors();
        raise({ ErrorCode::OutOfMemory, "there is no memory for the mesh" });
    }
    OwnedMesh made{ .vertices = std::move(vertices),
                    .indices = std::move(indices),
                    .given = std::move(given),
                    .hasNormals = hasNormals,
                    .drawn = mesh.indices,
                    .vertexCount = static_cast<uint32_t>(mesh.vertices.size()) };
    return std::make_shared<MeshObject>(self.owner, std::move(made));
}

/// A simple shape.
std::shared_ptr<MeshObject> upload(EngineObject const& self, Mesh const& mesh) {
    return upload(self, mesh, mesh, true);
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

/// What is None stays as it is.
struct VertexArrays {
    std::vector<float> positions{}, normals{}, uv{}, colors{};

    void copyTo(std::vector<MeshVertex>& vertices) const {
        for (size_t i = 0; i < vertices.size(); ++i) {
            MeshVertex& vertex = vertices[i];
            if (!positions.empty()) vertex.position = at(positions, i);
            if (!normals.empty()) vertex.normal = at(normals, i);
            if (!uv.empty()) vertex.uv = { uv[i * 2], uv[i * 2 + 1] };
            if (!colors.empty())
                vertex.color = { colors[i * 4], colors[i * 4 + 1], colors[i * 4 + 2], colors[i * 4 + 3] };
        }
    }

private:
    static float3 at(std::vector<float> const& rows, size_t i) {
        return { rows[i * 3], rows[i * 3 + 1], rows[i * 3 + 2] };
    }
};

VertexArrays arraysOf(py::object const& positions, py::object const& normals, py::object const& uv,
                      py::object const& colors, size_t count) {
    return { .positions = attributeOf(positions, "positions", 3, count),
             .normals = attributeOf(normals, "normals", 3, count),
             .uv = attributeOf(uv, "uv", 2, count),
             .colors = attributeOf(colors, "colors", 4, count) };
}

/// With normals, unless they were given, and tangents. Outside of the interpreter's lock.
Result<Mesh> finished(Mesh& given, bool hasNormals) {
    if (!hasNormals) {
        for (MeshVertex& vertex : given.vertices) vertex.normal = MeshVertex{}.normal; // where no triangle has an area
        if (Result<void> done = computeNormals(given); !done) return done.error();
    }
    Mesh mesh = given;
    if (Result<void> done = computeTangents(mesh); !done) return done.error();
    return mesh;
}

size_t rowCountOf(py::object const& positions) {
    const size_t count = rowsOf(positions, "positions", 3).size() / 3;
    if (count == 0) raiseInvalid("positions: a mesh has at least one vertex");
    return count;
}

std::shared_ptr<MeshObject> makeMesh(EngineObject const& self, py::object const& positions, py::object const& triangles,
                                     py::object const& normals, py::object const& uv, py::object const& colors) {
    const size_t count = rowCountOf(positions);
    Mesh given{ .vertices = std::vector<MeshVertex>(count), .indices = indicesOf(triangles, count) };
    arraysOf(positions, normals, uv, colors, count).copyTo(given.vertices);
    const Mesh mesh = valueOf(released([&] { return finished(given, !normals.is_none()); }));
    return upload(self, std::move(given), mesh, !normals.is_none());
}

/// On the device there are as many vertices as before. Each takes what the corners of its triangles have: where other
/// positions change which vertices are split, as where vertices come to lie on each other, that of its first corner.
std::vector<MeshVertex> verticesOf(OwnedMesh const& on, Mesh const& mesh) {
    std::vector<MeshVertex> vertices(mesh.vertices.begin(),
                                     mesh.vertices.begin() + static_cast<std::ptrdiff_t>(on.given.vertices.size()));
    vertices.resize(on.vertexCount);
    for (size_t corner = on.drawn.size(); corner-- > 0;)
        vertices[on.drawn[corner]] = mesh.vertices[mesh.indices[corner]];
    return vertices;
}

void updateMesh(MeshObject const& self, py::object const& positions, py::object const& normals, py::object const& uv,
                py::object const& colors) {
    const Owner::Call call(*self.owner());
    OwnedMesh& mesh = *self;
    if (positions.is_none() && normals.is_none() && uv.is_none() && colors.is_none())
        raiseInvalid("update(): give positions, normals, uv or colors");
    Mesh given = mesh.given;
    arraysOf(positions, normals, uv, colors, given.vertices.size()).copyTo(given.vertices);
    const bool hasNormals = mesh.hasNormals || !normals.is_none();
    const std::vector<MeshVertex> vertices = valueOf(released([&]() -> Result<std::vector<MeshVertex>> {
        Result<Mesh> changed = finished(given, hasNormals);
        if (!changed) return changed.error();
        return verticesOf(mesh, *changed);
    }));
    call.engine().update(mesh.vertices, std::as_bytes(std::span(vertices)));
    self.owner()->raiseErrors();
    mesh.given = std::move(given);
    mesh.hasNormals = hasNormals;
}

/// Rows of a member of the vertices that were given.
template <class Vector>
py::array_t<float> rowsOf(MeshObject const& self, Vector MeshVertex::*member) {
    std::vector<MeshVertex> const& vertices = self->given.vertices;
    py::array_t<float> rows({ static_cast<py::ssize_t>(vertices.size()), py::ssize_t{ Vector::length() } });
    float* out = rows.mutable_data();
    for (MeshVertex const& vertex : vertices)
        for (int i = 0; i < Vector::length(); ++i) *out++ = (vertex.*member)[i];
    return rows;
}

py::array_t<uint32_t> trianglesOf(MeshObject const& self) {
    std::vector<uint32_t> const& indices = self->given.indices;
    py::array_t<uint32_t> rows({ static_cast<py::ssize_t>(indices.size() / 3), py::ssize_t{ 3 } });
    std::ranges::copy(indices, rows.mutable_data());
    return rows;
}

void bindMesh(py::module_& module) {
    py::class_<MeshObject, std::shared_ptr<MeshObject>>(
            module, "Mesh",
            "Triangles on the device, for Scene.add_mesh(). From Engine.mesh(), box(), plane(), sphere(). Keeps the "
            "arrays, too.")
            .def_property_readonly(
                    "vertex_count", [](MeshObject const& self) { return self->vertexCount; },
                    "How many vertices it has on the device: more than `positions` where mirrored textures meet.")
            .def_property_readonly(
                    "triangle_count", [](MeshObject const& self) { return self->given.indices.size() / 3; },
                    "How many triangles it has.")
            .def_property_readonly(
                    "positions", [](MeshObject const& self) { return rowsOf(self, &MeshVertex::position); },
                    "A copy of the positions: float32 (n, 3).")
            .def_property_readonly(
                    "normals", [](MeshObject const& self) { return rowsOf(self, &MeshVertex::normal); },
                    "A copy of the normals, given or computed: float32 (n, 3).")
            .def_property_readonly("triangles", &trianglesOf,
                                   "The vertices of each triangle: uint32 (m, 3). A number of triangleId is a row.")
            .def("update", &updateMesh, py::arg("positions") = py::none(), py::kw_only(),
                 py::arg("normals") = py::none(), py::arg("uv") = py::none(), py::arg("colors") = py::none(),
                 "New values for all vertices, from the next frame on: rows as those of Engine.mesh(). What is None "
                 "stays, but normals that were never given are computed again, and tangents always.");
}

} // namespace

void bindMeshes(py::module_& module, EngineClass& engine) {
    bindMesh(module);
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
