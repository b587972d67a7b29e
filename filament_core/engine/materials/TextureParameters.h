// SPDX-License-Identifier: Apache-2.0
/// TextureParameters: which texture fits a sampler of a material, where it is kept, and how it is filtered.
///   Thread  pure functions.   Memory: only for the text of an error.
///   Fails   InvalidArgument with what the parameter was declared for and what the texture is.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"
#include "filament_core/scene/Materials.h"

#include <filament/Quality.h>

#include <string_view>

namespace filament::engine {

/// Whether the parameter is a sampler that the app may set.
Result<void> checkSampler(scene::Material const& material, shader::Parameter const& parameter);

/// Whether the sampler reads textures of this kind and format: the APIs leave the rest undefined. `name`: the
/// texture's.
Result<void> checkTexture(scene::Material const& material, shader::Parameter const& parameter,
                          backend::DeviceTextureDesc const& texture, std::string_view name);

/// Position of a texture parameter in scene::MaterialInstance::textures.
size_t textureSlot(shader::MaterialPackage const& package, shader::Parameter const& parameter);

/// What the view makes of the sampler that the app has set for this parameter. Whole numbers are never filtered.
Sampler samplerFor(shader::Parameter const& parameter, Sampler const& authored, TextureFilter filter);

} // namespace filament::engine
