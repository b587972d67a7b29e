// SPDX-License-Identifier: Apache-2.0
/// MeshFile: triangles and materials of a Wavefront .obj with its .mtl, a Stanford .ply or an .stl.
///   In      any bytes; the content is untrusted. The ending says what they are.
///   OBJ     v (also with colours), vt, vn, f of any number of corners (also concave), o, g, usemtl, mtllib. Lines,
///           points, curves and smoothing groups are left out, with a warning.
///   MTL     Kd, Ke, Ns, d, Tr, Pr, Pm, map_Kd, map_Ke, norm. Other maps are left out, with a warning.
///   PLY     1.0 as text and in both byte orders: x y z, nx ny nz, u v (s t), red green blue alpha, and faces. Without
///           faces the vertices are points, and those without a finite position are left out.
///   STL     text and binary. Normals are those of the triangles, not those of the file.
///   Out     as the file has it: units and axes are not converted. Texture coordinates begin at the top, as in glTF.
///           Colours of 8 bits are sRGB; others are linear.
///   Thread  any; pure.
///   Memory  about four times the file.   Limits: 2^32 - 2 vertices a part.
///   Fails   Corrupt, Unsupported: `name`, line or element, and the reason, in one line.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"

#include <filament_core/Math.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::assets {

enum class MeshFormat : uint8_t { Obj, Ply, Stl };

struct MeshFileMaterial {
    std::string name{};
    float4 baseColor{ 1.0f }; ///< linear
    float metallic = 0, roughness = 1;
    float3 emissive{ 0.0f };
    std::string baseColorMap{}, emissiveMap{}, normalMap{}; ///< as the file names them; empty: none
};

/// Triangles, or points; attributes are empty or have the length of `positions`.
struct MeshFilePart {
    static constexpr uint32_t kNoMaterial = ~0u;
    std::string name{};
    bool arePoints = false; ///< then there are no indices
    double3 origin{ 0 };    ///< what `positions` are relative to; 0 unless the file has coordinates of the type double
    std::vector<float3> positions{}, normals{};
    std::vector<float2> uvs{};
    std::vector<float4> colors{};    ///< linear
    std::vector<uint32_t> indices{}; ///< empty: vertices in order
    uint32_t material = kNoMaterial;
};

struct MeshFile {
    std::vector<MeshFilePart> parts{}; ///< none of them is empty
    std::vector<MeshFileMaterial> materials{};
};

/// By the ending, in any case; nothing: another kind of file.
std::optional<MeshFormat> meshFormatOf(std::string_view name);

/// Gives the bytes of a file that an .obj names.
using ReadNeighbour = std::function<Result<std::vector<std::byte>>(std::string const& name)>;

/// Missing .mtl files are warnings.
Result<MeshFile> readMeshFile(std::span<const std::byte> bytes, MeshFormat format, ReadNeighbour const& read,
                              Diagnostics& diagnostics);

Result<MeshFile> readObj(std::string_view text, ReadNeighbour const& read, Diagnostics& diagnostics);
void readMtl(std::string_view text, std::vector<MeshFileMaterial>& materials, Diagnostics& diagnostics);
Result<MeshFile> readPly(std::span<const std::byte> bytes);
Result<MeshFile> readStl(std::span<const std::byte> bytes);

} // namespace filament_core::assets
