// SPDX-License-Identifier: Apache-2.0
/// GltfMergeFuzzBody: saves two copies of a file of arbitrary bytes as one glTF file; one body for the fuzzer
/// (tests/fuzz/GltfMergeFuzz.cpp) and the mutation test. What loads gives a file that loads, with the same bytes of
/// vertices and twice the nodes, or an error of one line.
#pragma once

#include "base/Hash.h"
#include "filament_core/assets/gltf/GltfMerge.h"
#include "tests/filament_core/assets/gltf/GltfFuzzBody.h"

#include <set>

namespace filament_core::assets::test {

/// Below roots of their own, as a scene with two copies has them.
inline GltfMerge twoCopiesOf(std::span<const std::byte> file, ModelData const& model) {
    GltfMerge merge{ .sources = { { .name = "fuzzed", .file = { file.begin(), file.end() } } }, .copies = { 0, 0 } };
    for (uint32_t copy = 0; copy < 2; ++copy) {
        std::vector<uint32_t> written(model.nodes.size(), kNone); // by node of the model
        for (size_t i = 0; i < model.nodes.size(); ++i) {
            NodeData const& node = model.nodes[i];
            if (node.carriesMesh) continue;
            written[i] = static_cast<uint32_t>(merge.nodes.size());
            merge.nodes.push_back({ .copy = copy, .node = node.ofFile });
            std::vector<uint32_t>& siblings =
                    node.parent == kNone ? merge.roots : merge.nodes[written[node.parent]].children;
            siblings.push_back(written[i]);
        }
    }
    return merge;
}

/// Each once: a skinned mesh is a mesh of its own for each skin.
inline std::set<uint64_t> vertexHashes(ModelData const& model) {
    std::set<uint64_t> hashes;
    for (MeshData const& mesh : model.meshes)
        for (PrimitiveData const& primitive : mesh.primitives) hashes.insert(hashBytes(primitive.vertices));
    return hashes;
}

inline size_t nodesOfFile(ModelData const& model) {
    return static_cast<size_t>(std::ranges::count(model.nodes, false, &NodeData::carriesMesh));
}

/// Null: the merged file is what was merged.
inline const char* lostByMerge(ModelData const& model, Result<ModelData> const& again) {
    if (!again) return again.error().message.c_str();
    if (const char* broken = brokenPromise(*again)) return broken;
    if (nodesOfFile(*again) != 2 * nodesOfFile(model)) return "nodes of both copies";
    return vertexHashes(*again) == vertexHashes(model) ? nullptr : "bytes of vertices";
}

/// Returns whether it was merged. Ends the process on an error that no file may cause.
inline bool fuzzGltfMerge(std::span<const std::byte> file) {
    jobs::JobSystem jobs({ .workers = 0 });
    const GltfOptions options{ .deformation = GltfDeformation::Kept, .levels = GltfLevels::All };
    const Result<ModelData> model = loadGltfFromMemory(file, "no such folder", jobs, options);
    if (!model) return false;
    const Result<GltfMerged> merged = mergeGltf(twoCopiesOf(file, *model));
    const char* lost = nullptr;
    Result<ModelData> again = fail(ErrorCode::Internal, "not loaded");
    if (merged) {
        const Result<std::vector<std::byte>> glb = glbOf(*merged);
        if (glb) again = loadGltfFromMemory(*glb, "no such folder", jobs, options);
        lost = glb ? lostByMerge(*model, again) : nullptr;
    } else if (merged.error().message.empty() || merged.error().message.find('\n') != std::string::npos) {
        lost = "message";
    }
    if (lost) {
        std::fprintf(stderr, "a merged file lost: %s\n", lost);
        std::abort();
    }
    return merged.ok();
}

} // namespace filament_core::assets::test
