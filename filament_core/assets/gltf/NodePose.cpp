// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/NodePose.h"

#include "base/math/Elementary.h"

#include <glm/gtc/quaternion.hpp>

#include <cmath>

namespace filament_core::assets {

double4x4 matrixFrom(NodePose const& pose) {
    glm::dquat rotation(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
    const double length2 = glm::dot(rotation, rotation);
    if (length2 > 1e-12)
        rotation *= 1.0 / std::sqrt(length2);
    else
        rotation = glm::dquat(1, 0, 0, 0);
    double4x4 matrix(glm::mat3_cast(rotation));
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= pose.scale[axis];
    matrix[3] = double4(pose.translation, 1);
    return matrix;
}

NodePose poseFrom(double4x4 const& matrix) {
    double3x3 axes(matrix);
    NodePose pose{ .translation = double3(matrix[3]) };
    for (int axis = 0; axis < 3; ++axis) pose.scale[axis] = glm::length(axes[axis]);
    if (glm::determinant(axes) < 0) pose.scale.x = -pose.scale.x;
    if (pose.scale.x == 0 || pose.scale.y == 0 || pose.scale.z == 0) return pose; // flat: any rotation is as good
    for (int axis = 0; axis < 3; ++axis) axes[axis] /= pose.scale[axis];
    const glm::dquat q = glm::normalize(glm::quat_cast(axes));
    pose.rotation = { q.x, q.y, q.z, q.w };
    return pose;
}

// Shoemake 1985, "Animating Rotation with Quaternion Curves".
double4 slerp(double4 const& a, double4 const& b, double weight) {
    if (weight == 0) return a;
    const double cosine = glm::dot(a, b);
    const double4 target = cosine < 0 ? -b : b;
    if (weight == 1) return target;
    const double angle = elementary::acos(std::min(std::abs(cosine), 1.0));
    const double sine = elementary::sin(angle);
    if (sine < 1e-6) return a + (target - a) * weight; // so close that the arc is straight
    return a * (elementary::sin((1 - weight) * angle) / sine) + target * (elementary::sin(weight * angle) / sine);
}

NodePose blend(NodePose const& a, NodePose const& b, double weight) {
    return { a.translation + (b.translation - a.translation) * weight, slerp(a.rotation, b.rotation, weight),
             a.scale + (b.scale - a.scale) * weight };
}

} // namespace filament_core::assets
