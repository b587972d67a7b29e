// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/meshfiles/MeshFile.h"

#include <algorithm>

namespace filament_core::assets {

std::optional<MeshFormat> meshFormatOf(std::string_view name) {
    const size_t dot = name.rfind('.');
    if (dot == std::string_view::npos) return std::nullopt;
    std::string ending(name.substr(dot + 1));
    std::ranges::transform(ending, ending.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    if (ending == "obj") return MeshFormat::Obj;
    if (ending == "ply") return MeshFormat::Ply;
    if (ending == "stl") return MeshFormat::Stl;
    return std::nullopt;
}

Result<MeshFile> readMeshFile(std::span<const std::byte> bytes, MeshFormat format, ReadNeighbour const& read,
                              Diagnostics& diagnostics) {
    Result<MeshFile> file = [&] {
        if (format == MeshFormat::Ply) return readPly(bytes);
        if (format == MeshFormat::Stl) return readStl(bytes);
        return readObj({ reinterpret_cast<const char*>(bytes.data()), bytes.size() }, read, diagnostics);
    }();
    if (!file) return file;
    std::erase_if(file->parts, [](MeshFilePart const& part) { return part.positions.empty(); });
    if (file->parts.empty()) return fail(ErrorCode::Unsupported, "there are no triangles in the file");
    return file;
}

} // namespace filament_core::assets
