// SPDX-License-Identifier: Apache-2.0
/// MaterialShares: what lobes and textures of one material instance add to a pixel (docs/shares.md), by drawing it with
/// some of them off. Each is the difference that one made, so that their sum is the picture's half floats.
///   In      a live instance, and the pixel of the picture.   Out: terms in the order in which they were switched on.
///   Thread  the app thread. While a frame is drawn the instance differs; afterwards it is what it was, and counts as
///           unchanged.
///   Fails   as `draw` does; OutOfMemory.
#pragma once

#include "filament_core/engine/EngineImpl.h"

#include <filament_core/ExplainPixel.h>

#include <array>
#include <functional>
#include <vector>

namespace filament_core::engine {

/// Draws the picture as it is now, and returns the half floats of the pixel.
using DrawPixel = std::function<Result<std::array<uint16_t, 4>>()>;

Result<std::vector<PixelLobe>> pixelLobes(Engine& engine, MaterialInstance handle, PixelSurface const& surface,
                                          std::array<uint16_t, 4> const& whole, DrawPixel const& draw);

/// Empty: the instance reads no texture.
Result<std::vector<PixelTexture>> pixelTextures(Engine& engine, MaterialInstance handle,
                                                std::array<uint16_t, 4> const& whole, DrawPixel const& draw);

/// Fills `uv` and `texel` where they are known, by drawing the surface's renderable with a material that shows the
/// texture: nothing of it is in other materials.
Result<void> readTexels(Engine& engine, Scene const& scene, View const& view, uint2 pixel, MaterialInstance handle,
                        PixelSurface const& surface, std::vector<PixelTexture>& textures);

} // namespace filament_core::engine
