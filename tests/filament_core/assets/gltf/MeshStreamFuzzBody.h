// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: compressed geometry by itself, which damage to a whole glTF file rarely
/// reaches. Any bytes give an error, or as many vertices and indices as they claim.
///   Input   the first byte chooses: even for Draco, odd for meshopt, whose description are the next four bytes.
#pragma once

#include "base/Assert.h"
#include "filament_core/assets/gltf/Draco.h"
#include "filament_core/assets/gltf/Meshopt.h"

#include <cstring>
#include <span>
#include <vector>

namespace filament_core::assets::test {

inline bool fuzzDraco(std::span<const std::byte> stream) {
    Diagnostics diagnostics;
    DracoPatience patience;
    const DracoMesh mesh(stream, "fuzzed", patience, diagnostics);
    if (!diagnostics.ok()) {
        FILAMENT_ASSERT(diagnostics.error().message.starts_with("fuzzed: "), "an error names its place");
        FILAMENT_ASSERT(mesh.vertexCount() == 0 && mesh.indices().empty(), "a broken stream gives nothing");
        return false;
    }
    FILAMENT_ASSERT(mesh.indices().size() % 3 == 0, "triangles have three corners");
    std::vector<float> values;
    for (uint32_t id = 0; id < 8; ++id) {
        const uint8_t components = mesh.componentCount(id);
        if (components == 0) continue;
        values.resize(size_t{ mesh.vertexCount() } * components);
        mesh.read(id, components, values);
    }
    return true;
}

/// `head`: mode and filter, stride, count.
inline bool fuzzMeshopt(std::span<const std::byte, 4> head, std::span<const std::byte> stream) {
    const MeshoptSource source{ .byteStride = static_cast<uint32_t>(head[1]) + 1,
                                .count = static_cast<uint32_t>(head[2]) << 8 | static_cast<uint32_t>(head[3]),
                                .mode = static_cast<MeshoptMode>(static_cast<uint32_t>(head[0]) % 3),
                                .filter = static_cast<MeshoptFilter>(static_cast<uint32_t>(head[0]) / 3 % 5),
                                .isKhr = true };
    Diagnostics diagnostics;
    const std::vector<std::byte> out = decodeMeshopt(source, stream, "fuzzed", diagnostics);
    if (!diagnostics.ok()) {
        FILAMENT_ASSERT(diagnostics.error().message.starts_with("fuzzed: "), "an error names its place");
        return false;
    }
    FILAMENT_ASSERT(out.size() == size_t{ source.count } * source.byteStride, "every element is there");
    return true;
}

/// Returns whether it was geometry.
inline bool fuzzMeshStream(std::span<const std::byte> input) {
    if (input.size() < 5) return false;
    if ((input[0] & std::byte{ 1 }) == std::byte{ 0 }) return fuzzDraco(input.subspan(1));
    return fuzzMeshopt(input.subspan<1, 4>(), input.subspan(5));
}

} // namespace filament_core::assets::test
