// SPDX-License-Identifier: Apache-2.0
// The cameras of a file (glTF 2.0, section 3.10). Violations of the specification are repaired with a warning: a model
// whose camera is broken is still a model.
#include "filament_core/assets/files/JsonTree.h"
#include "filament_core/assets/gltf/GltfParse.h"

#include <algorithm>
#include <cmath>

namespace filament_core::assets {
namespace {

constexpr float kLargestCameraMeters = 1e30f;

/// Whether a float holds it, and what is computed from it.
bool isSize(double value) { return value >= 1e-30 && value <= static_cast<double>(kLargestCameraMeters); }

/// A number above 0; another one is `fallback`, with a warning.
float positive(JsonNode const& node, float fallback) {
    const double value = node.number(static_cast<double>(fallback));
    if (isSize(value)) return static_cast<float>(value);
    node.diagnostics().warn("{}: {} is no number above 0 of use; it became {}", node.path(), value, fallback);
    return fallback;
}

void parsePerspective(JsonNode const& node, CameraData& camera) {
    constexpr float kHalfTurn = 3.1415926f;
    const float fov = positive(node["yfov"], camera.verticalFovRadians);
    if (fov < kHalfTurn)
        camera.verticalFovRadians = fov;
    else
        node.diagnostics().warn("{}.yfov: {} is half a turn or more; it became {}", node.path(), fov,
                                camera.verticalFovRadians);
    camera.nearMeters = positive(node["znear"], camera.nearMeters);
    if (node["aspectRatio"].exists()) camera.aspect = positive(node["aspectRatio"], 1);
}

void parseParallel(JsonNode const& node, CameraData& camera) {
    camera.isParallel = true;
    const double x = std::abs(node["xmag"].number(1)), y = std::abs(node["ymag"].number(1));
    const bool isUsable = isSize(x) && isSize(y) && isSize(x / y);
    if (!isUsable) node.diagnostics().warn("{}: {} x {} is no size of a picture; it became 1 x 1", node.path(), x, y);
    camera.halfHeightMeters = isUsable ? static_cast<float>(y) : 1.0f;
    camera.aspect = isUsable ? static_cast<float>(x / y) : 1.0f;
    camera.nearMeters = node["znear"].numberInRange(0, 0, kLargestCameraMeters);
    camera.farMeters = node["zfar"].numberInRange(1000, 0, kLargestCameraMeters);
    if (camera.farMeters > camera.nearMeters) return;
    const float far = std::max(camera.nearMeters + 1000, camera.nearMeters * 2);
    node.diagnostics().warn("{}: zfar {} is not behind znear {}; it became {}", node.path(), camera.farMeters,
                            camera.nearMeters, far);
    camera.farMeters = far;
}

} // namespace

CameraData parseGltfCamera(JsonNode const& node) {
    CameraData camera{ .name = node["name"].label() };
    const std::string type = node["type"].text();
    if (type == "orthographic")
        parseParallel(node["orthographic"], camera);
    else if (type == "perspective")
        parsePerspective(node["perspective"], camera);
    else
        node.diagnostics().warn(
                "{}.type: '{}' is neither perspective nor orthographic; the camera has a lens of 45 degrees",
                node.path(), type);
    return camera;
}

} // namespace filament_core::assets
