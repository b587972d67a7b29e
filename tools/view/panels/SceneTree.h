// SPDX-License-Identifier: Apache-2.0
/// SceneTree: the nodes of a model as rows of a tree, and what a click on a row does to the Document.
///   In      nodes as values, so that it needs neither stage nor window; sceneNodes() reads them from a stage.
///   Thread  one.   Cost: proportional to the nodes, for every call of treeRows(): read nodes again when
///           Stage::generation() changes, rows in every frame.
#pragma once

#include "tools/view/document/Document.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

class Stage;

struct SceneNode {
    std::string name{};
    int32_t parent = -1; ///< place in the list; -1: below the root of the copy
    uint32_t renderables = 0, lights = 0;
    bool hasCamera = false;
};

/// In the order of Stage::nodes(), parents first.
std::vector<SceneNode> sceneNodes(Stage& stage);

struct TreeRow {
    uint32_t node = 0; ///< as in NodeEdit
    uint32_t depth = 0;
    bool isVisible = true; ///< as edited
    bool isHidden = false; ///< by a node above it
    bool hasChildren = false, isOpen = true;
    bool isEdited = false;
};

/// Which nodes are closed; new ones are open.
struct TreeState {
    std::vector<bool> isClosed{};
    bool closed(uint32_t node) const { return node < isClosed.size() && isClosed[node]; }
    void toggle(uint32_t node);
};

/// Depth first. With a filter: the nodes whose names match, and those above them, open or not.
std::vector<TreeRow> treeRows(std::vector<SceneNode> const& nodes, Document const& document, TreeState const& state,
                              std::string_view filter = {});

/// "" of a file: "node 7".
std::string nodeLabel(std::vector<SceneNode> const& nodes, uint32_t node);

void toggleVisible(Document& document, uint32_t node);
/// Only this node, what is above it and what is below it is seen; a second time: everything.
void isolate(Document& document, std::vector<SceneNode> const& nodes, uint32_t node);
void showAll(Document& document);
void setNodeTransform(Document& document, uint32_t node, double4x4 const& parentFromNode);
void resetNodeTransform(Document& document, uint32_t node);

} // namespace filament_core::view
