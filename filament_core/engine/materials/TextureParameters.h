// SPDX-License-Identifier: Apache-2.0
/// TextureParameters: which texture fits a sampler of a material, where it is stored, and how it is filtered.
///   Thread  pure functions.   Memory: only for the text of an error.
///   Fails   InvalidArgument with the declaration of the parameter and the kind of the texture.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"
#include "filament_core/scene/Materials.h"

#include <filament_core/Objects.h>
#include <filament_core/Quality.h>

#include <string_view>

namespace filament_core::engine {

/// What a sampler reads.
TextureKind textureKindOf(shader::ParameterType sampler);

/// Whether the parameter is a sampler that the app can set.
Result<void> checkSampler(scene::Material const& material, shader::Parameter const& parameter);

/// Whether the sampler can read textures of this kind and format; otherwise the APIs' behaviour is undefined. `name`:
/// of the texture.
Result<void> checkTexture(scene::Material const& material, shader::Parameter const& parameter,
                          backend::DeviceTextureDesc const& texture, std::string_view name);

/// Position of a texture parameter in scene::MaterialInstance::textures.
size_t textureSlot(shader::MaterialPackage const& package, shader::Parameter const& parameter);

/// The app's sampler for this parameter, changed according to the view. Integers are never filtered.
Sampler samplerFor(shader::Parameter const& parameter, Sampler const& authored, TextureFilter filter);

} // namespace filament_core::engine
