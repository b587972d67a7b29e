// SPDX-License-Identifier: Apache-2.0
/// What functions of interface.txt do that is more than one call of C++. Included by Interface.cpp alone, after the
/// conversions of its structs.
#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>

namespace filament_core::c {
namespace {

/// A struct of C that a function fills: assigning what C++ has converts it.
template <class Cpp, class C>
class Out {
public:
    Out(C& to) : mTo(to) {}
    Out const& operator=(Cpp const& value) const {
        copyTo(mTo, value);
        return *this;
    }

private:
    C& mTo;
};

/// Elements of a span in C++.
template <class C>
auto cppOf(std::span<C> in) {
    std::vector<std::decay_t<decltype(cppOf(in[0]))>> out;
    out.reserve(in.size());
    for (auto const& value : in) out.push_back(cppOf(value));
    return out;
}

std::string lines(std::vector<std::string> const& texts) {
    std::string out;
    for (std::string const& text : texts) out += (out.empty() ? "" : "\n") + text;
    return out;
}

/// Functions of C++ return no handle if memory runs out.
template <class Handle>
Result<Handle> handleOr(Handle handle) {
    if (!handle) return Error{ ErrorCode::OutOfMemory, "out of memory; fc_engine_take_errors() says for what" };
    return handle;
}

Mesh makeMesh(std::vector<MeshVertex> const& vertices, std::vector<uint32_t> const& indices) {
    return { vertices, indices };
}

/// Whether [first, first + count) are vertices.
Result<void> isRange(Mesh const& mesh, uint32_t first, size_t count) {
    if (first <= mesh.vertices.size() && count <= mesh.vertices.size() - first) return {};
    return Error{ ErrorCode::InvalidArgument, "vertices " + std::to_string(first) + " to " +
                                                      std::to_string(first + count) + " of a mesh that has " +
                                                      std::to_string(mesh.vertices.size()) };
}

Result<void> getVertices(Mesh const& mesh, uint32_t first, std::span<fc_vertex> out) {
    if (Result<void> range = isRange(mesh, first, out.size()); !range) return range;
    for (size_t i = 0; i < out.size(); ++i) copyTo(out[i], mesh.vertices[first + i]);
    return {};
}

Result<void> setVertices(Mesh& mesh, uint32_t first, std::vector<MeshVertex> const& vertices) {
    if (Result<void> range = isRange(mesh, first, vertices.size()); !range) return range;
    std::ranges::copy(vertices, mesh.vertices.begin() + first);
    return {};
}

void setTangents(Mesh& mesh) {
    for (MeshVertex& vertex : mesh.vertices) vertex.tangents = tangentsFromNormal(vertex.normal);
}

Result<Image> makeImage(uint32_t width, uint32_t height, Format format, std::span<const std::byte> pixels) {
    const size_t texel = texelBytes(format), bytes = size_t(width) * height * texel;
    if (bytes == 0 || pixels.size() != bytes)
        return Error{ ErrorCode::InvalidArgument,
                      "an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels has " +
                              std::to_string(bytes) + " bytes, not " + std::to_string(pixels.size()) };
    return Image{ width, height, format, { pixels.begin(), pixels.end() } };
}

Result<Material> loadMaterial(Engine& engine, std::string_view path) {
    std::ifstream file(std::string(path), std::ios::binary);
    if (!file) return Error{ ErrorCode::NotFound, std::string(path) + ": cannot be opened" };
    const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
    if (file.bad()) return Error{ ErrorCode::Unreadable, std::string(path) + ": cannot be read" };
    Result<Material> material = engine.create(MaterialDesc{ .package = std::as_bytes(std::span(bytes)) });
    if (!material) return Error{ material.error().code, std::string(path) + ": " + material.error().message };
    return material;
}

/// Of the view, its quality, its effects or its display: no name is there twice.
Result<void> setViewOption(View& view, std::string_view name, std::string_view value) {
    if (findOption(optionsOf<Quality>(), name)) return setOption(view.quality, name, value);
    if (findOption(optionsOf<Effects>(), name)) return setOption(view.effects, name, value);
    if (findOption(optionsOf<DisplayTransform>(), name)) return setOption(view.display, name, value);
    return setOption(view, name, value);
}

} // namespace
} // namespace filament_core::c
