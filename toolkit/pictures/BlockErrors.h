// SPDX-License-Identifier: Apache-2.0
/// blockErrors: how far an image is from a traced one, which has noise.
///   Error   root mean square of the differences of means of 8 x 8 pixels, scene-linear, over that of the traced image.
///   Noise   the same of the traced image's own standard error, which is in every error and taken off none.
///   In      images of one size; pixels beyond the last whole block do not count.
///   Thread  any; pure.
#pragma once

#include "toolkit/pictures/Picture.h"

namespace filament_core::tools {

struct BlockErrors {
    double error = 0, noise = 0; ///< 0 beside a black image
};
/// `standardError`: of the pixels of `traced`.
BlockErrors blockErrors(Picture const& picture, Picture const& traced, Picture const& standardError);

} // namespace filament_core::tools
