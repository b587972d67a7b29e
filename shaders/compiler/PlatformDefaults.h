// SPDX-License-Identifier: Apache-2.0
/// The effect of `matc --platform`: the defaults that the materials guide gives for phones and for desktops. One
/// package runs on both, and properties that the author states are the same on both.
///   Mobile  quality low; no multi-bounce and no specular occlusion (4.2.8, 4.2.32, 4.2.33).
///   Desktop quality high.   All: as Desktop, and the quality stays "default".
///   Thread  any. Fails: never.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament_core::shader {

enum class Platform : uint8_t { All, Desktop, Mobile };

void usePlatformDefaults(Platform platform, MaterialDefinition& definition);

} // namespace filament_core::shader
