// SPDX-License-Identifier: Apache-2.0
/// GltfAnimation: the animations of a file, as far as they move parts of the scene (glTF 2.0, section 3.11).
///   In      a document whose buffers are loaded, and the mapping of its nodes.
///   Out     one AnimationData each, in the order of the file. Empty ones are kept, because indices identify
///           animations. Weights apply to every node that shows the mesh of their node. Times that do not grow are
///           repaired (KeyTimes.h), with one warning for each animation, which names `file`, animation and channels.
///   Limits  2^26 numbers and 2^22 moved nodes in all animations together.
///   Fails   Corrupt: an accessor that leaves its buffer. A channel that is invalid by itself (no key with a
///           finite time, counts that do not match, a node without morph targets) is dropped, with a warning that
///           names it. KHR_animation_pointer: so is one whose values do not have the type of the property.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/Animation.h"
#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfScene.h"

#include <string_view>
#include <vector>

namespace filament_core::assets {

struct GltfAnimations {
    std::vector<AnimationData> animations;
    /// KHR_animation_pointer: what AnimationPath::Property channels change, each once. Objects that are nodes are those
    /// of the scene, the others those of the file; `rest` is not set.
    std::vector<AnimatedProperty> properties;
};

GltfAnimations readAnimations(GltfDocument& document, GltfScene const& scene, std::string_view file,
                              Diagnostics& diagnostics);

} // namespace filament_core::assets
