// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/NodeTransform.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace filament_core::view {
namespace {

constexpr double kSmallestCosine = 1e-9; // of the angle about x: below, y and z are one angle

double3x3 rotationOf(double3 degrees) {
    const double3 s = glm::sin(glm::radians(degrees)), c = glm::cos(glm::radians(degrees));
    const double3x3 aboutX(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x);
    const double3x3 aboutY(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y);
    const double3x3 aboutZ(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
    return aboutY * aboutX * aboutZ;
}

/// Ry Rx Rz has (cx sz, cx cz, -sx) in its second row and (sy cx, -sx, cy cx) in its third column.
double3 degreesOf(double3x3 const& r) {
    const double x = std::asin(glm::clamp(0.0 - r[2][1], -1.0, 1.0)); // of 0: not -0
    if (std::cos(x) < kSmallestCosine) return glm::degrees(double3(x, std::atan2(-r[0][2], r[0][0]), 0));
    return glm::degrees(double3(x, std::atan2(r[2][0], r[2][2]), std::atan2(r[0][1], r[1][1])));
}

double3 scaleOf(double3x3 const& axes) {
    double3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
    if (glm::determinant(axes) < 0) scale.x = -scale.x;
    return scale;
}

/// Axes of length 1 at right angles; those of length 0 follow from the others.
double3x3 rotationIn(double3x3 axes, double3 scale) {
    for (int i = 0; i < 3; ++i) axes[i] = scale[i] != 0 ? axes[i] / scale[i] : double3(0);
    if (scale.z == 0) axes[2] = glm::cross(axes[0], axes[1]);
    if (scale.y == 0) axes[1] = glm::cross(axes[2], axes[0]);
    if (scale.x == 0) axes[0] = glm::cross(axes[1], axes[2]);
    const bool isFlat = std::abs(glm::determinant(axes)) < 1e-12;
    if (isFlat) return double3x3(1);
    axes[0] = glm::normalize(axes[0]);
    axes[1] = glm::normalize(axes[1] - axes[0] * glm::dot(axes[0], axes[1]));
    axes[2] = glm::cross(axes[0], axes[1]);
    return axes;
}

void setAxes(double4x4& matrix, double3x3 const& axes) {
    for (int i = 0; i < 3; ++i) matrix[i] = double4(axes[i], 0);
}

} // namespace

NodeTransform transformOf(double4x4 const& matrix) {
    const double3x3 axes(matrix);
    const double3 scale = scaleOf(axes);
    return { .translation = double3(matrix[3]), .degrees = degreesOf(rotationIn(axes, scale)), .scale = scale };
}

double4x4 matrixOf(NodeTransform const& transform) {
    double3x3 axes = rotationOf(transform.degrees);
    for (int i = 0; i < 3; ++i) axes[i] *= transform.scale[i];
    double4x4 matrix(1);
    setAxes(matrix, axes);
    return moved(matrix, transform.translation);
}

double4x4 moved(double4x4 const& matrix, double3 translation) {
    double4x4 result = matrix;
    result[3] = double4(translation, 1);
    return result;
}

double4x4 turned(double4x4 const& matrix, double3 degrees) {
    NodeTransform transform = transformOf(matrix);
    transform.degrees = degrees;
    return matrixOf(transform);
}

double4x4 scaled(double4x4 const& matrix, double3 scale) {
    const double3x3 axes(matrix);
    const double3 before = scaleOf(axes);
    const double3x3 rotation = rotationIn(axes, before);
    double3x3 result(1);
    for (int i = 0; i < 3; ++i) result[i] = before[i] != 0 ? axes[i] * (scale[i] / before[i]) : rotation[i] * scale[i];
    double4x4 changed = matrix;
    setAxes(changed, result);
    return changed;
}

} // namespace filament_core::view
