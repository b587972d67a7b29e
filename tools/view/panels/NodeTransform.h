// SPDX-License-Identifier: Apache-2.0
/// NodeTransform: an affine transform as the numbers that people edit, and edits of one of them that leave the others
/// alone.
///   Angles  degrees about x, y and z; y is applied last (matrix Ry Rx Rz), so that y is the heading. At x = +-90
///           degrees y and z turn about the same axis, and z is 0.
///   Shear   stays in the matrix where it is not edited: only turned() replaces the axes by those at right angles.
///   Thread  any; pure.   Fails: never. What is not finite stays so.
#pragma once

#include <filament_core/Math.h>

namespace filament_core::view {

struct NodeTransform {
    double3 translation{ 0 };
    double3 degrees{ 0 };
    double3 scale{ 1 }; ///< the lengths of the axes; x is negative if the matrix mirrors
};

NodeTransform transformOf(double4x4 const& matrix);
double4x4 matrixOf(NodeTransform const& transform);

double4x4 moved(double4x4 const& matrix, double3 translation);
double4x4 turned(double4x4 const& matrix, double3 degrees);
/// An axis of length 0 becomes that of the rotation that the others have.
double4x4 scaled(double4x4 const& matrix, double3 scale);

} // namespace filament_core::view
