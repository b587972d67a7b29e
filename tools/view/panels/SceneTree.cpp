// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/SceneTree.h"

#include "tools/view/panels/PanelText.h"
#include "tools/view/stage/Stage.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::view {
namespace {

NodeEdit const* editOf(Document const& document, uint32_t node) {
    const auto found = std::ranges::find(document.nodes, node, &NodeEdit::node);
    return found == document.nodes.end() ? nullptr : &*found;
}

/// Children of every node; the last list is that of the roots.
std::vector<std::vector<uint32_t>> childrenOf(std::vector<SceneNode> const& nodes) {
    std::vector<std::vector<uint32_t>> children(nodes.size() + 1);
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        const bool isRoot = nodes[i].parent < 0 || static_cast<uint32_t>(nodes[i].parent) >= i;
        children[isRoot ? nodes.size() : static_cast<size_t>(nodes[i].parent)].push_back(i);
    }
    return children;
}

/// Nodes that match, and those above one that does.
std::vector<bool> shownByFilter(std::vector<SceneNode> const& nodes, std::string_view filter) {
    std::vector<bool> shown(nodes.size());
    for (size_t i = nodes.size(); i-- > 0;) { // parents come first, so that children are done before them
        if (matchesFilter(nodeLabel(nodes, static_cast<uint32_t>(i)), filter)) shown[i] = true;
        if (shown[i] && nodes[i].parent >= 0 && static_cast<size_t>(nodes[i].parent) < i)
            shown[static_cast<size_t>(nodes[i].parent)] = true;
    }
    return shown;
}

struct TreeWalk {
    std::vector<SceneNode> const& nodes;
    Document const& document;
    TreeState const& state;
    std::vector<std::vector<uint32_t>> children;
    std::vector<bool> shown; ///< empty: all
    std::vector<TreeRow> rows{};

    bool isShown(uint32_t node) const { return shown.empty() || shown[node]; }

    TreeRow rowOf(uint32_t node, uint32_t depth, bool isHidden) const {
        NodeEdit const* edit = editOf(document, node);
        return { .node = node,
                 .depth = depth,
                 .isVisible = !edit || edit->isVisible,
                 .isHidden = isHidden,
                 .hasChildren = std::ranges::any_of(children[node], [&](uint32_t child) { return isShown(child); }),
                 .isOpen = !shown.empty() || !state.closed(node),
                 .isEdited = edit && edit->parentFromNode.has_value() };
    }

    /// With a stack of its own: files may nest nodes as deep as they like.
    void walk() {
        struct Step {
            uint32_t node, depth;
            bool isHidden;
        };
        std::vector<Step> steps;
        const auto push = [&](std::vector<uint32_t> const& list, uint32_t depth, bool isHidden) {
            for (size_t i = list.size(); i-- > 0;)
                if (isShown(list[i])) steps.push_back({ list[i], depth, isHidden });
        };
        push(children.back(), 0, false);
        while (!steps.empty()) {
            const Step step = steps.back();
            steps.pop_back();
            rows.push_back(rowOf(step.node, step.depth, step.isHidden));
            TreeRow const& row = rows.back();
            if (row.isOpen) push(children[step.node], step.depth + 1, step.isHidden || !row.isVisible);
        }
    }
};

} // namespace

std::vector<SceneNode> sceneNodes(Stage& stage) {
    const std::vector<Node> nodes = stage.nodes();
    std::vector<SceneNode> result(nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        result[i].name = stage.scene().name(nodes[i]);
        const std::optional<uint32_t> parent = stage.indexOf(stage.scene().parent(nodes[i]));
        result[i].parent = parent ? static_cast<int32_t>(*parent) : -1;
    }
    ModelCopy const* copy = stage.modelCopy();
    if (!copy) return result;
    const auto count = [&](Node node, auto&& add) {
        if (const std::optional<uint32_t> index = stage.indexOf(node); index && *index < result.size())
            add(result[*index]);
    };
    for (CopyRenderable const& part : copy->renderables()) count(part.node, [](SceneNode& n) { ++n.renderables; });
    for (CopyLight const& light : stage.modelLights()) count(light.node, [](SceneNode& n) { ++n.lights; });
    for (CopyCamera const& camera : copy->cameras()) count(camera.node, [](SceneNode& n) { n.hasCamera = true; });
    return result;
}

void TreeState::toggle(uint32_t node) {
    if (node >= isClosed.size()) isClosed.resize(size_t{ node } + 1);
    isClosed[node] = !isClosed[node];
}

std::vector<TreeRow> treeRows(std::vector<SceneNode> const& nodes, Document const& document, TreeState const& state,
                              std::string_view filter) {
    TreeWalk walk{ nodes, document, state, childrenOf(nodes),
                   filter.empty() ? std::vector<bool>() : shownByFilter(nodes, filter) };
    walk.walk();
    return std::move(walk.rows);
}

std::string nodeLabel(std::vector<SceneNode> const& nodes, uint32_t node) {
    if (node >= nodes.size()) return {};
    return nodes[node].name.empty() ? fmt::format("node {}", node) : nodes[node].name;
}

void toggleVisible(Document& document, uint32_t node) {
    NodeEdit& edit = nodeEdit(document, node);
    edit.isVisible = !edit.isVisible;
    removeIdleEdits(document);
}

void isolate(Document& document, std::vector<SceneNode> const& nodes, uint32_t node) {
    std::vector<bool> keeps(nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) { // what is below it
        const bool isBelow = nodes[i].parent >= 0 && static_cast<size_t>(nodes[i].parent) < i &&
                             keeps[static_cast<size_t>(nodes[i].parent)];
        keeps[i] = i == node || isBelow;
    }
    for (auto above = static_cast<int32_t>(node); above >= 0; above = nodes[static_cast<size_t>(above)].parent)
        keeps[static_cast<size_t>(above)] = true;
    Document alone = document;
    showAll(alone);
    for (size_t i = 0; i < nodes.size(); ++i)
        if (!keeps[i]) nodeEdit(alone, static_cast<uint32_t>(i)).isVisible = false;
    const auto isSame = [&](NodeEdit const& edit) {
        NodeEdit const* before = editOf(document, edit.node);
        return before && before->isVisible == edit.isVisible;
    };
    const bool isAlone = alone.nodes.size() == document.nodes.size() && std::ranges::all_of(alone.nodes, isSame);
    document.nodes = std::move(alone.nodes);
    if (isAlone) showAll(document);
}

void showAll(Document& document) {
    for (NodeEdit& edit : document.nodes) edit.isVisible = true;
    removeIdleEdits(document);
}

void setNodeTransform(Document& document, uint32_t node, double4x4 const& parentFromNode) {
    nodeEdit(document, node).parentFromNode = parentFromNode;
}

void resetNodeTransform(Document& document, uint32_t node) {
    nodeEdit(document, node).parentFromNode.reset();
    removeIdleEdits(document);
}

} // namespace filament_core::view
