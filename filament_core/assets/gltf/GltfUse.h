// SPDX-License-Identifier: Apache-2.0
/// GltfUse: which elements of a file its default scene reaches, and with that what an error in one of them means.
///   Rule    an error in an element that the scene reaches is the error of the file. In any other element it is a
///           warning, and the element is left out: the model is drawn without it.
///   Reached are, from the roots down, nodes (hidden ones and levels of detail too), their meshes, skins, cameras and
///           lights; joints, with all that is above and below them; materials (of variants too), textures, samplers and
///           images; accessors, views and buffers of all these; the image-based light of the scene; animations of
///           which a channel moves something reached, and the data of such channels.
///   Thread  one. Cost: linear in the elements and the links between them.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filament_core::assets {

struct GltfDocument;

/// The arrays of a file whose elements can be left out.
enum class GltfArray : uint8_t {
    Buffers,
    Views,
    Accessors,
    Meshes,
    Nodes,
    Skins,
    Images,
    Samplers,
    Materials,
    Textures,
    Lights,
    Cameras,
    Profiles,
    ImageBasedLights,
    Variants,
    Animations,
};
inline constexpr size_t kGltfArrays = 16;

struct GltfUse {
    std::array<std::vector<bool>, kGltfArrays> reached; ///< by GltfArray and index

    std::vector<bool>& of(GltfArray array) { return reached[static_cast<size_t>(array)]; }
    bool has(GltfArray array, uint32_t index) const { return reached[static_cast<size_t>(array)][index]; }
};

/// An element that could not be parsed; the document has what was read of it until it is left out.
struct GltfFault {
    GltfArray array = GltfArray::Buffers;
    uint32_t index = 0;
    Error error;
};

/// Fills document.use. The indices of the document are valid or kNone; its nodes need not form a forest yet.
void findUse(GltfDocument& document);

/// Refuses the first fault that is reached; of the others it warns, and clears their elements.
void settleFaults(std::vector<GltfFault> const& faults, GltfDocument& document, Diagnostics& diagnostics);

/// Passes on what reading an element has found: its error only if the element is reached, else as a warning.
void settle(Diagnostics found, bool isReached, Diagnostics& diagnostics);

} // namespace filament_core::assets
