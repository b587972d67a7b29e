// SPDX-License-Identifier: Apache-2.0
/// What the KHR_materials extensions add to a metallic-roughness surface, as shaders/material/gltf/layers.glsl and
/// gltf/transmission.glsl hand it to the engine's shading.
///   Not here  iridescence: TracedScene warns.
///   Thread    pure functions.
#pragma once

#include "tools/reference/MaterialMaps.h"
#include "tools/reference/Surface.h"

namespace filament::reference {

/// In: normal, tangent, opacity, metallic, diffuse, f0, f90 and perceptualRoughness as without extensions.
/// `baseColor`: times opacity if the material blends. `roughness`: perceptual, [0, 1], not clamped yet.
void addLayers(MaterialPoint const& point, double3 baseColor, double roughness, SurfaceSample& surface);

} // namespace filament::reference
