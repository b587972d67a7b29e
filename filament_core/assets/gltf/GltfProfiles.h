// SPDX-License-Identifier: Apache-2.0
/// GltfProfiles: the photometric files of EXT_lights_ies that a scene shows.
///   In      a document whose buffers are loaded, and the lights that its nodes make of profiles.
///   Out     each file once, and the lights with candelas: peak of the file times multiplier.
///   Limits  1024 profiles and 64 MiB of files for a model; see IesFile.h for one of them.
///   Thread  one.   Fails: through the diagnostics, with the index of the profile and the line of its file.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfUri.h"

#include <span>
#include <vector>

namespace filament_core::assets {

struct GltfProfiles {
    std::vector<LightProfileData> read;
    std::vector<uint32_t> newIndex; ///< by profile of the document: into `read`, or kNone
};

GltfProfiles readProfiles(GltfDocument const& document, GltfFolder const& folder, std::span<const LightData> lights,
                          Diagnostics& diagnostics);

/// Fills in the model's lights and profiles, and the nodes' indices: `others`, then `lights`.
void addProfiledLights(std::vector<LightData> lights, GltfProfiles profiles, std::vector<LightData> const& others,
                       ModelData& model);

} // namespace filament_core::assets
