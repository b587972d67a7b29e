// SPDX-License-Identifier: Apache-2.0
/// Nodes: transforms that hang below each other and carry renderables and lights. Scene::add makes them.
///   Space      worldFromNode = worldFromParent * parentFromNode, in double from the root down: a model 10^7 m from the
///              origin keeps its millimetres. The same bits for any number of workers and any order of edits.
///   Transform  affine, its last row counts as 0 0 0 1; scales may differ by axis, be zero or negative (the faces that
///              a mirror turns around are drawn right). One that is not finite, or overflows on the way down, counts as
///              a zero scale: that node and what hangs below it draw nothing, and never NaN.
///   Lifetime   from Scene::add to Scene::remove of the node or of one above it, or the end of the scene.
///   Limits     2^20 - 1 nodes a scene, any depth.
///   Cost       a frame computes what changed since the last one and what hangs below that, on all workers; nothing
///              changed, nothing computed. Adding, moving and removing are O(1) a node; worldFromNode() is O(1), or as
///              deep as the node while changes are waiting for a frame.
///   Fails      a handle of a removed node, or a cycle, is an assertion.
#pragma once

#include <filament/Math.h>
#include <filament/Objects.h>

#include <cstdint>
#include <string>

namespace filament {

struct NodeDesc {
    Node parent{};                   ///< none: a root
    double4x4 parentFromNode{ 1.0 }; ///< of a root: worldFromNode
    std::string name{};              ///< for Scene::findNode; need not be unique
};

/// What a node keeps when it gets another parent.
enum class Reparent : uint8_t {
    KeepLocal, ///< parentFromNode: it moves over to its new parent
    KeepWorld, ///< worldFromNode, to rounding: it stays where it is, unless the new parent's scale is zero
};

} // namespace filament
