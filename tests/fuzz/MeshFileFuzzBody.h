// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, an .obj, .ply or .stl gives finite triangles whose indices
/// exist, or an error of one line. The first byte chooses the format. An .obj also finds itself as its .mtl.
#pragma once

#include "base/Assert.h"
#include "filament_core/assets/meshfiles/MeshFile.h"

#include <algorithm>
#include <cmath>

namespace filament_core::assets {

inline void checkPart(MeshFilePart const& part, size_t materials) {
    const size_t vertices = part.positions.size();
    const auto fits = [&](auto const& list) { return list.empty() || list.size() == vertices; };
    const auto isFinite = [](auto const& list) {
        return std::ranges::all_of(list, [](auto const& v) {
            for (int i = 0; i < v.length(); ++i)
                if (!std::isfinite(v[i])) return false;
            return true;
        });
    };
    FILAMENT_ASSERT(vertices > 0 && fits(part.normals) && fits(part.uvs) && fits(part.colors), "attributes are whole");
    FILAMENT_ASSERT(isFinite(part.positions) && isFinite(part.normals) && isFinite(part.colors) && isFinite(part.uvs),
                    "numbers are finite");
    const size_t corners = part.indices.empty() ? vertices : part.indices.size();
    FILAMENT_ASSERT(part.arePoints ? part.indices.empty() : corners % 3 == 0, "corners are triangles");
    FILAMENT_ASSERT(std::ranges::all_of(part.indices, [&](uint32_t i) { return i < vertices; }), "indices exist");
    FILAMENT_ASSERT(part.material == MeshFilePart::kNoMaterial || part.material < materials, "materials exist");
}

/// Returns whether it was a mesh.
inline bool fuzzMeshFileOnce(std::span<const uint8_t> input) {
    if (input.empty()) return false;
    const auto bytes = std::as_bytes(input.subspan(1));
    Diagnostics diagnostics;
    const ReadNeighbour read = [&](std::string const&) {
        return Result<std::vector<std::byte>>(std::vector<std::byte>(bytes.begin(), bytes.end()));
    };
    const Result<MeshFile> file = readMeshFile(bytes, static_cast<MeshFormat>(input[0] % 3), read, diagnostics);
    const auto isLine = [](std::string const& text) {
        return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
    };
    for (std::string const& warning : diagnostics.takeWarnings())
        FILAMENT_ASSERT(isLine(warning), "a warning is one line");
    if (!file) {
        FILAMENT_ASSERT(isLine(file.error().message), "an error is one line");
        return false;
    }
    FILAMENT_ASSERT(!file->parts.empty(), "there are triangles");
    for (MeshFilePart const& part : file->parts) checkPart(part, file->materials.size());
    for (MeshFileMaterial const& material : file->materials)
        FILAMENT_ASSERT(material.roughness >= 0 && material.roughness <= 1 && material.metallic >= 0 &&
                                material.metallic <= 1 && material.baseColor.w >= 0 && material.baseColor.w <= 1,
                        "values of materials are in range");
    return true;
}

} // namespace filament_core::assets
