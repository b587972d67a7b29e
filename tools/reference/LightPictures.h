// SPDX-License-Identifier: Apache-2.0
/// LightPictures: the images of lights as the reference renderer reads them: all of their pixels, in double precision,
/// without mip levels or a table.
///   Thread  any; read-only.
#pragma once

#include "filament_core/assets/tables/LightImageTable.h"

#include <filament_core/Image.h>

#include <memory>

namespace filament_core::reference {

struct LightPicture {
    assets::LightPixels pixels{};
    LightImageShape shape = LightImageShape::Projected;

    double aspect() const { return double(pixels.height) / pixels.width; } ///< height over width
    /// At a place in [0, 1] over the image, from its top left; of a tiled image anywhere.
    double3 at(double2 place) const;
    /// Of an octahedron or a cube; x: the image's right, y: down, z: forward.
    double3 towards(double3 direction) const;
};
using LightPicturePtr = std::shared_ptr<const LightPicture>;

LightPicturePtr lightPictureOf(Image const& image, LightImageShape shape);

} // namespace filament_core::reference
