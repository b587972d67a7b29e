// SPDX-License-Identifier: Apache-2.0
/// DracoMesh: a mesh decoded from a KHR_draco_mesh_compression stream.
///   In      the bytes of its buffer view; untrusted.
///   Out     vertices by attribute id, triangles as indices.
///   Thread  one mesh on one thread; different meshes on different threads.
///   Memory  the decoded mesh, until destruction.
///   Limits  a damaged stream of 240 bytes can make the library loop for ten seconds, and nothing can interrupt it. So
///           one stream of a file may be too slow (DracoPatience); those behind it are refused unread.
///   Fails   Corrupt, naming the primitive; the mesh is then empty. Exceptions of the library do not escape.
///   Only Draco.cpp includes the library.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/DracoPatience.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::assets {

class DracoMesh {
public:
    DracoMesh(std::span<const std::byte> stream, std::string_view path, DracoPatience& patience,
              Diagnostics& diagnostics);
    ~DracoMesh();
    DracoMesh(DracoMesh&&) noexcept;

    uint32_t vertexCount() const;
    std::vector<uint32_t> indices() const;

    /// Components of attribute `id`; 0 if the stream lacks it.
    uint8_t componentCount(uint32_t id) const;
    /// Reads vertexCount() * components floats; normalised integers are converted to their range.
    void read(uint32_t id, uint8_t components, std::span<float> out) const;

private:
    struct State;
    /// Returns why there is no mesh; empty if there is one.
    std::string decode(std::span<const std::byte> stream);
    std::string decodeInTime(std::span<const std::byte> stream, DracoPatience& patience);

    std::unique_ptr<State> mState;
};

} // namespace filament_core::assets
