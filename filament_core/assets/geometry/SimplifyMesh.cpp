// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/geometry/SimplifyMesh.h"

#include "base/Assert.h"
#include "filament_core/assets/geometry/TriangleTree.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace filament_core::assets {
namespace {

constexpr size_t kMostLevels = 7;
constexpr size_t kFewestTriangles = 64;   // of a level that has a coarser one: with fewer, a draw costs as much
constexpr float kLargestError = 1.0f / 8; // of a level, as a part of the mesh's size

bool isFinite(std::span<const float3> positions) {
    return std::ranges::all_of(positions, [](float3 const& at) { return std::isfinite(at.x + at.y + at.z); });
}

/// The longest side of the box of what the triangles use.
float sizeOf(MeshToSimplify const& mesh) {
    float3 min = mesh.positions[mesh.indices[0]], max = min;
    for (const uint32_t index : mesh.indices) {
        min = glm::min(min, mesh.positions[index]);
        max = glm::max(max, mesh.positions[index]);
    }
    const float3 size = max - min;
    return std::max({ size.x, size.y, size.z });
}

/// What the simplifier sees: vertices that triangles use, each once. It keeps vertices that share their place with
/// several others, and files without indices have three vertices a triangle.
struct Welded {
    std::vector<uint32_t> indices;
    std::vector<uint32_t> vertexOf; ///< of the mesh: the first that is like this one
    std::vector<float3> positions;
};

/// The number of different vertices; `remap`: what number each gets, ~0u: it is unused.
size_t numberVertices(MeshToSimplify const& mesh, std::vector<uint32_t>& remap) {
    constexpr size_t kMostStreams = 16, kLongestStream = 256; // of meshoptimizer
    std::vector<meshopt_Stream> streams{ { mesh.vertices.data(), mesh.stride, mesh.stride } };
    for (const std::span<const float3> of : mesh.displacements)
        streams.push_back({ of.data(), sizeof(float3), sizeof(float3) });
    if (!mesh.vertices.empty() && streams.size() <= kMostStreams && mesh.stride <= kLongestStream)
        return meshopt_generateVertexRemapMulti(remap.data(), mesh.indices.data(), mesh.indices.size(), remap.size(),
                                                streams.data(), streams.size());
    return meshopt_optimizeVertexFetchRemap(remap.data(), mesh.indices.data(), mesh.indices.size(), remap.size());
}

Welded welded(MeshToSimplify const& mesh) {
    std::vector<uint32_t> remap(mesh.positions.size());
    Welded out;
    out.vertexOf.resize(numberVertices(mesh, remap), ~0u);
    for (uint32_t vertex = 0; vertex < remap.size(); ++vertex) {
        if (remap[vertex] != ~0u) out.vertexOf[remap[vertex]] = std::min(out.vertexOf[remap[vertex]], vertex);
    }
    for (const uint32_t vertex : out.vertexOf) out.positions.push_back(mesh.positions[vertex]);
    for (const uint32_t index : mesh.indices) out.indices.push_back(remap[index]);
    return out;
}

/// How differently a vertex moves from a point of a triangle, when both are deformed.
class Deforming {
public:
    explicit Deforming(MeshToSimplify const& mesh)
            : mMesh(mesh), mInfluences(mesh.influences.size() / mesh.positions.size()) {
        for (size_t i = 0; i < mesh.influences.size(); ++i) {
            const Influence influence = mesh.influences[i];
            if (!(influence.weight > 0)) continue;
            if (influence.bone >= mBones.size()) mBones.resize(influence.bone + size_t{ 1 });
            mBones[influence.bone].add(mesh.positions[i / mInfluences]);
        }
    }

    double difference(uint32_t vertex, TriangleTree::Triangle const& corners, double3 const& weights) const {
        double sum = 0;
        for (const std::span<const float3> of : mMesh.displacements) {
            double3 moved(of[vertex]);
            for (int i = 0; i < 3; ++i) moved -= weights[i] * double3(of[corners[static_cast<size_t>(i)]]);
            sum += glm::length(moved);
        }
        return mInfluences > 0 ? sum + ofBones(vertex, corners, weights) : sum;
    }

private:
    struct BoneBox {
        float3 min{ std::numeric_limits<float>::max() }, max{ std::numeric_limits<float>::lowest() };
        void add(float3 const& at) { min = glm::min(min, at), max = glm::max(max, at); }
        double diagonal() const { return glm::length(double3(max) - double3(min)); }
    };

    double weightOf(uint32_t vertex, uint32_t bone) const {
        double sum = 0;
        for (Influence const& influence : mMesh.influences.subspan(vertex * mInfluences, mInfluences))
            sum += influence.bone == bone && influence.weight > 0 ? static_cast<double>(influence.weight) : 0.0;
        return sum;
    }

    /// Weights sum to 1, so half of all differences is what other bones move instead.
    double ofBones(uint32_t vertex, TriangleTree::Triangle const& corners, double3 const& weights) const {
        const std::array<uint32_t, 4> vertices{ vertex, corners[0], corners[1], corners[2] };
        double sum = 0;
        for (size_t one = 0; one < vertices.size(); ++one) {
            const std::span<const Influence> influences =
                    mMesh.influences.subspan(vertices[one] * mInfluences, mInfluences);
            for (size_t at = 0; at < influences.size(); ++at) {
                const uint32_t bone = influences[at].bone;
                if (!(influences[at].weight > 0) || isEarlier(vertices, one, at, bone)) continue;
                double apart = weightOf(vertex, bone);
                for (int i = 0; i < 3; ++i) apart -= weights[i] * weightOf(corners[static_cast<size_t>(i)], bone);
                sum += std::abs(apart) / 2 * mBones[bone].diagonal();
            }
        }
        return sum;
    }

    /// Whether the bone is among the influences before this one.
    bool isEarlier(std::array<uint32_t, 4> const& vertices, size_t one, size_t at, uint32_t bone) const {
        for (size_t i = 0; i <= one; ++i) {
            const std::span<const Influence> influences =
                    mMesh.influences.subspan(vertices[i] * mInfluences, i < one ? mInfluences : at);
            for (Influence const& influence : influences)
                if (influence.bone == bone && influence.weight > 0) return true;
        }
        return false;
    }

    MeshToSimplify const& mMesh;
    size_t mInfluences;
    std::vector<BoneBox> mBones;
};

/// Measures levels of a mesh.
class LevelError {
public:
    LevelError(MeshToSimplify const& mesh, std::span<const uint32_t> indices)
            : mMesh(mesh), mDeforming(mesh), mTree(mesh.positions, indices), mVertices(indices.begin(), indices.end()) {
        std::ranges::sort(mVertices);
        mVertices.erase(std::unique(mVertices.begin(), mVertices.end()), mVertices.end());
    }

    double of(std::span<const uint32_t> level, double atLeast) const {
        return ofLevel(level, ofVertices(level, atLeast));
    }

private:
    double ofVertices(std::span<const uint32_t> level, double largest) const {
        const TriangleTree tree(mMesh.positions, level);
        uint32_t hint = 0;
        for (const uint32_t vertex : mVertices) {
            const double3 at(mMesh.positions[vertex]);
            largest = tree.least(mMesh.positions[vertex], largest, hint,
                                 [&](TriangleTree::Triangle const& corners, TrianglePoint const& nearest) {
                                     return glm::distance(at, nearest.position) +
                                            mDeforming.difference(vertex, corners, nearest.weights);
                                 });
        }
        return largest;
    }

    double ofLevel(std::span<const uint32_t> level, double largest) const {
        uint32_t hint = 0;
        const auto add = [&](float3 const& at) {
            largest = mTree.least(at, largest, hint, [&](TriangleTree::Triangle const&, TrianglePoint const& nearest) {
                return glm::distance(double3(at), nearest.position);
            });
        };
        for (size_t i = 0; i + 3 <= level.size(); i += 3) {
            const float3 a = mMesh.positions[level[i]], b = mMesh.positions[level[i + 1]],
                         c = mMesh.positions[level[i + 2]];
            for (float3 const& at : { (a + b) * 0.5f, (b + c) * 0.5f, (c + a) * 0.5f, (a + b + c) * (1.0f / 3) })
                add(at);
        }
        return largest;
    }

    MeshToSimplify const& mMesh;
    Deforming mDeforming;
    TriangleTree mTree;
    std::vector<uint32_t> mVertices;
};

std::vector<uint32_t> halved(std::vector<float3> const& positions, std::vector<uint32_t> const& indices) {
    std::vector<uint32_t> level(indices.size());
    const size_t target = indices.size() / 6 * 3;
    level.resize(meshopt_simplify(level.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                  sizeof(float3), target, kLargestError, meshopt_SimplifyLockBorder, nullptr));
    return level;
}

/// Of the mesh, in an order for the caches of devices.
std::vector<uint32_t> levelIndices(Welded const& mesh, std::vector<uint32_t> const& triangles) {
    std::vector<uint32_t> indices(triangles.size());
    meshopt_optimizeVertexCache(indices.data(), triangles.data(), triangles.size(), mesh.positions.size());
    for (uint32_t& index : indices) index = mesh.vertexOf[index];
    return indices;
}

} // namespace

std::vector<SimplifiedLevel> simplifyMesh(MeshToSimplify const& mesh) {
    FILAMENT_ASSERT(mesh.indices.size() % 3 == 0, "a triangle has three indices");
    std::vector<SimplifiedLevel> levels;
    if (mesh.indices.size() / 3 < kFewestTriangles || !isFinite(mesh.positions)) return levels;
    const float size = sizeOf(mesh);
    if (!(size > 0) || !std::isfinite(size)) return levels;
    const Welded whole = welded(mesh);
    std::vector<uint32_t> finest = whole.indices;
    for (uint32_t& index : finest) index = whole.vertexOf[index];
    // Errors are measured against the mesh itself. The error that meshoptimizer reports is one against its own input,
    // which here is the level before.
    const LevelError measure(mesh, finest);
    std::vector<uint32_t> last = whole.indices;
    double error = 0;
    while (levels.size() < kMostLevels && last.size() / 3 >= kFewestTriangles) {
        std::vector<uint32_t> level = halved(whole.positions, last);
        if (level.empty() || level.size() * 4 > last.size() * 3) break;
        std::vector<uint32_t> indices = levelIndices(whole, level);
        // Starts with the error of the level before: errors never fall from level to level, as the choice of a level
        // expects.
        error = measure.of(indices, error);
        if (!(error <= static_cast<double>(size * kLargestError))) break;
        // The next float above, because rounding to the nearest could state less than was measured.
        levels.push_back({ std::move(indices), std::nextafter(static_cast<float>(error), HUGE_VALF) });
        last = std::move(level);
    }
    return levels;
}

} // namespace filament_core::assets
