// SPDX-License-Identifier: Apache-2.0
/// SavedSources: the files of models, read again for saveGltf().
///   Thread  the app thread.
///   Fails   NotFound, Unreadable: the file is gone. InvalidArgument: it changed since, or it was in memory and nobody
///           gives it.
#pragma once

#include "filament_core/engine/gltf/SaveContext.h"

namespace filament_core::engine {

/// The place of a model's file among those of the context, which reads it for the first copy.
Result<uint32_t> sourceOf(SaveContext& context, Model::Impl const& model, GltfSaveOptions const& options);

} // namespace filament_core::engine
