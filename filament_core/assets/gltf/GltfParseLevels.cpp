// SPDX-License-Identifier: Apache-2.0
// MSFT_lod: https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Vendor/MSFT_lod
#include "filament_core/assets/files/JsonTree.h"
#include "filament_core/assets/gltf/GltfParse.h"

#include <algorithm>

namespace filament_core::assets {
namespace {

/// Answers which nodes are above others: in a walk with parents first, all that is below a node follows it at once.
class Ancestry {
public:
    explicit Ancestry(std::vector<GltfNode> const& nodes) : mPlace(nodes.size(), 0), mBelow(nodes.size(), 0) {
        std::vector<bool> isChild(nodes.size(), false);
        for (GltfNode const& node : nodes) {
            for (const uint32_t child : node.children) isChild[child] = true;
        }
        std::vector<uint32_t> open, walk;
        for (uint32_t i = 0; i < nodes.size(); ++i) {
            if (!isChild[i]) open.push_back(i);
        }
        while (!open.empty()) {
            const uint32_t node = open.back();
            open.pop_back();
            mPlace[node] = static_cast<uint32_t>(walk.size());
            walk.push_back(node);
            open.insert(open.end(), nodes[node].children.begin(), nodes[node].children.end());
        }
        for (auto node = walk.rbegin(); node != walk.rend(); ++node) {
            for (const uint32_t child : nodes[*node].children) mBelow[*node] += 1 + mBelow[child];
        }
    }

    bool isAbove(uint32_t node, uint32_t other) const {
        return mPlace[node] < mPlace[other] && mPlace[other] - mPlace[node] <= mBelow[node];
    }

private:
    std::vector<uint32_t> mPlace, mBelow; ///< by node: its place in the walk; how many nodes are below it
};

/// Collects which node is a level of which.
class LevelLists {
public:
    explicit LevelLists(std::vector<GltfNode> const& nodes) : mAncestry(nodes), mFiner(nodes.size(), kNone) {}

    /// Why `level` cannot be a coarser level of `node`; null: it has become one.
    const char* add(uint32_t node, uint32_t level) {
        if (level == node) return "is the node itself; list only coarser levels";
        if (mFiner[level] != kNone) return "is a coarser level already; list each level once";
        if (finest(node) == level) return "is the same thing in more detail; list only coarser levels";
        if (mAncestry.isAbove(level, node) || mAncestry.isAbove(level, finest(node)))
            return "is above the node; levels must not contain finer ones";
        mFiner[level] = node;
        return nullptr;
    }

    bool isCoarser(uint32_t node) const { return mFiner[node] != kNone; }
    bool isBelow(uint32_t level, uint32_t node) const { return mAncestry.isAbove(node, level); }

private:
    /// The end of the chain; it is shortened on the way, so that long chains are walked once.
    uint32_t finest(uint32_t node) {
        while (mFiner[node] != kNone) {
            const uint32_t finer = mFiner[node];
            if (mFiner[finer] != kNone) mFiner[node] = mFiner[finer];
            node = finer;
        }
        return node;
    }

    Ancestry mAncestry;
    std::vector<uint32_t> mFiner; ///< by node: one with more detail, or kNone
};

} // namespace

std::vector<uint32_t> parseGltfLevels(JsonNode const& node, size_t nodeCount) {
    std::vector<uint32_t> levels;
    for (JsonNode const& id : node.extension("MSFT_lod")["ids"].elements()) {
        const uint64_t level = id.requiredInteger();
        if (level < nodeCount)
            levels.push_back(static_cast<uint32_t>(level));
        else
            id.diagnostics().warn("{}: nodes[{}] does not exist, there are {} nodes; the level was ignored", id.path(),
                                  level, nodeCount);
    }
    return levels;
}

std::vector<double> parseGltfCoverage(JsonNode const& node) {
    return node.extension("MSFT_lod").exists() ? node["extras"].numbersOf("MSFT_screencoverage")
                                               : std::vector<double>();
}

void markCoarserLevels(std::vector<GltfNode>& nodes, Diagnostics& diagnostics) {
    if (std::ranges::all_of(nodes, [](GltfNode const& node) { return node.levels.empty(); })) return;
    LevelLists lists(nodes);
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        std::erase_if(nodes[i].levels, [&](uint32_t level) {
            const char* const reason = lists.add(i, level);
            if (reason)
                diagnostics.warn("nodes[{}].extensions.MSFT_lod.ids: nodes[{}] {}; it was ignored", i, level, reason);
            return reason || lists.isBelow(level, i);
        });
    }
    for (uint32_t i = 0; i < nodes.size(); ++i) nodes[i].isCoarserLevel = lists.isCoarser(i);
}

} // namespace filament_core::assets
