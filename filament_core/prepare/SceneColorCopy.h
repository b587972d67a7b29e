// SPDX-License-Identifier: Apache-2.0
/// SceneColorCopy: the part of the scene colour that is copied for refraction, and its number of blurred levels.
///   In      the boxes of the refracting objects, as the camera sees them.
///   Out     a rectangle of pixels that holds what a refracted ray is expected to meet: the objects' own pixels and a
///           margin. Beyond it, shaders fade to the environment.
///   Thread  any; pure.   Memory: none.   Fails: never.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/math/Math.h"
#include "filament_core/prepare/PixelBox.h"

#include <cstdint>

namespace filament_core::prepare {

inline constexpr uint32_t kMostPictureLevels = 9;

/// Levels of the texture for a view of this size. The smallest is two texels high or more.
uint8_t pictureLevels(uint2 view);
/// Of that texture: every level halves the one before it exactly.
uint2 pictureTextureSize(uint2 view);

struct SceneColorCopy {
    backend::Rect rect{};   ///< pixels, in whole texels of the last level; may end beyond the view
    uint8_t levels = 0;     ///< that are drawn, with the copy itself
    uint32_t firstDraw = 0; ///< of ViewPacket::blended: what is drawn over the copy; those before it are in it

    uint32_t pixels() const { return rect.width * rect.height; }
};

/// The part that is copied for objects in `box`.
SceneColorCopy copyAround(PixelBox box, uint2 view);

/// Levels that surfaces of no more than this roughness read in perspective views; `pixelsPerTangent`: of the middle.
uint8_t levelsOfRoughness(float perceptualRoughness, float pixelsPerTangent);

} // namespace filament_core::prepare
