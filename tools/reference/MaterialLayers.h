// SPDX-License-Identifier: Apache-2.0
/// Adds the KHR_materials extensions to a metallic-roughness surface, as gltf/layers.glsl and gltf/transmission.glsl of
/// shaders/material pass them to the engine's shading.
///   Thread    pure functions.
#pragma once

#include "tools/reference/MaterialMaps.h"
#include "tools/reference/Surface.h"

namespace filament_core::reference {

/// In: normal, tangent, opacity, metallic, diffuse, f0, f90 and perceptualRoughness without extensions.
/// `roughness`: perceptual, [0, 1], not yet clamped.
void addLayers(MaterialPoint const& point, double3 baseColor, double roughness, SurfaceSample& surface);

} // namespace filament_core::reference
