// SPDX-License-Identifier: Apache-2.0
/// GltfAnimation: the animations of a file, as far as they move something of the scene (glTF 2.0, section 3.11).
///   In      a document whose buffers are loaded, and where its nodes went.
///   Out     one AnimationData each, in the order of the file, also those of which nothing is left: indices are names.
///           Weights go to every node that the mesh of their node stands at.
///   Limits  2^26 numbers in all animations together.
///   Fails   Corrupt: an accessor that leaves its buffer. A channel that makes no sense by itself (times that do not
///           grow, counts that do not fit, a node without morph targets) is left out, with a warning that names it.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/Animation.h"
#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfScene.h"

#include <vector>

namespace filament::assets {

std::vector<AnimationData> readAnimations(GltfDocument const& document, GltfScene const& scene,
                                          Diagnostics& diagnostics);

} // namespace filament::assets
