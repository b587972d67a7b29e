// SPDX-License-Identifier: Apache-2.0
/// CubeFaces: how cameras draw the faces of a cube map.
///   Faces   +x, -x, +y, -y, +z, -z, with texture coordinates as in table 8.25 of OpenGL ES 3.1. Those are of a cube
///           seen from outside, so images of a camera inside are mirrored: their rows go from right to left.
///   Thread  any; constant data.
#pragma once

#include "base/math/Math.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::assets {

/// Where the camera of a face looks, and what is up in its image: in the space of the cube.
struct CubeFace {
    double3 forward, up;
};
inline constexpr std::array kCubeFaces{ CubeFace{ { 1, 0, 0 }, { 0, 1, 0 } },  CubeFace{ { -1, 0, 0 }, { 0, 1, 0 } },
                                        CubeFace{ { 0, 1, 0 }, { 0, 0, -1 } }, CubeFace{ { 0, -1, 0 }, { 0, 0, 1 } },
                                        CubeFace{ { 0, 0, 1 }, { 0, 1, 0 } },  CubeFace{ { 0, 0, -1 }, { 0, 1, 0 } } };

/// Camera::worldFromView of a lens of 90 degrees at `eye`, in a cube that lies along `axes`.
inline double4x4 worldFromFace(CubeFace const& face, double3 eye, double3x3 const& axes) {
    const double3 back = -(axes * face.forward), up = axes * face.up;
    return double4x4(double4(glm::cross(up, back), 0), double4(up, 0), double4(back, 0), double4(eye, 1));
}

/// Appends the image of such a camera, `side` pixels wide and high, as the texels of its face.
template <class Texel>
void appendFace(std::span<const Texel> image, size_t side, std::vector<Texel>& to) {
    for (size_t y = 0; y < side; ++y)
        for (size_t x = side; x-- > 0;) to.push_back(image[y * side + x]);
}

} // namespace filament_core::assets
