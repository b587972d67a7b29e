// SPDX-License-Identifier: Apache-2.0
/// GltfExtensions: the extensions of glTF 2.0 that the loader supports completely, and what it makes of each. The
/// loader refuses files that require another one; docs/gltf.md has the table.
///   Thread  any; constant data.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace filament_core::assets {

/// In the registry of glTF extensions (github.com/KhronosGroup/glTF, extensions/README.md), read in November 2026.
enum class GltfExtensionState : uint8_t {
    Ratified,         ///< by the Khronos Group
    ReleaseCandidate, ///< of the Khronos Group
    Vendor,           ///< of one vendor or several
    Draft,            ///< not in the registry yet
    Archived,         ///< replaced by others
};

struct GltfExtension {
    std::string_view name; ///< as files spell it
    GltfExtensionState state;
    std::string_view effect; ///< for documents: one phrase of Markdown
};

/// Sorted by subject: how data is stored, the scene, light, materials, metadata.
std::span<const GltfExtension> gltfExtensions();
bool isSupportedGltfExtension(std::string_view name);

} // namespace filament_core::assets
