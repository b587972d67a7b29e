// SPDX-License-Identifier: Apache-2.0
/// Nodes: a hierarchy of transforms that carries renderables and lights. Scene::add creates them.
///   Space      worldFromNode = worldFromParent * parentFromNode, in double precision from the root down: a model 10^7
///              m from the origin keeps its millimetres. The bits are the same for any number of workers and any order
///              of edits.
///   Transform  affine; the last row is taken as 0 0 0 1. Scales may differ by axis and may be zero or negative (faces
///              that a mirror flips are drawn correctly). A transform that is not finite, or overflows further down,
///              is treated as a zero scale: the node and everything below it draw nothing, and never produce NaN.
///   Lifetime   from Scene::add to Scene::remove of the node or of an ancestor, or the end of the scene.
///   Limits     2^20 - 1 nodes per scene, any depth.
///   Cost       a frame updates the nodes that changed since the last frame and their descendants, on all workers;
///              without changes it computes nothing. Adding, moving and removing are O(1) per node. worldFromNode() is
///              O(1), or proportional to the depth of the node while changes wait for a frame.
///   Fails      a handle of a removed node, or a cycle, is an assertion.
#pragma once

#include <filament_core/Math.h>
#include <filament_core/Objects.h>

#include <cstdint>
#include <string>

namespace filament_core {

struct NodeDesc {
    Node parent{};                   ///< none: a root
    double4x4 parentFromNode{ 1.0 }; ///< for a root: worldFromNode
    std::string name{};              ///< for Scene::findNode; need not be unique
};

/// What a node keeps when its parent changes.
enum class Reparent : uint8_t {
    KeepLocal, ///< parentFromNode: the node moves along with its new parent
    KeepWorld, ///< worldFromNode, up to rounding: the node stays in place, unless the new parent's scale is zero
};

} // namespace filament_core
