// SPDX-License-Identifier: Apache-2.0
/// CameraPath: cameras at times, between which a camera moves. tools/view/camera/PathSampling.h has the motion.
#pragma once

#include <filament_core/Camera.h>

#include <string>
#include <vector>

namespace filament_core::view {

struct CameraKey {
    double seconds = 0; ///< from the start of the path; finite, more than that of the key before
    Camera camera{};
};

struct CameraPath {
    std::string name{};
    std::vector<CameraKey> keys{};
    bool isClosed = false;     ///< continues from the last key to the first one
    double closingSeconds = 1; ///< how long that takes, > 0, if it is closed
};

bool operator==(CameraKey const& a, CameraKey const& b);
bool operator==(CameraPath const& a, CameraPath const& b);

} // namespace filament_core::view
