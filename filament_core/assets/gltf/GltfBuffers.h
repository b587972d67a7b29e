// SPDX-License-Identifier: Apache-2.0
/// GltfBuffers: fills GltfDocument::viewBytes: every buffer view as a checked span of bytes.
///   In      the parsed document, the GLB's binary chunk, the model's folder.
///   Out     spans into the binary chunk or into document.ownedBytes (files, data URIs, decompressed views). A view
///           without bytes, because its buffer is a fallback without data, is an error unless the view is compressed.
///   Thread  one; decompression runs on `jobs`.
///   Fails   naming the buffer or the view: "bufferViews[3]: ends at byte 900, buffers[0] has 840".
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfContainer.h"
#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::assets {

void loadGltfBuffers(GltfDocument& document, GltfContainer const& container, GltfFolder const& folder,
                     jobs::JobSystem& jobs, Diagnostics& diagnostics);

} // namespace filament_core::assets
