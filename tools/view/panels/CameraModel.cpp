// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/CameraModel.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::view {

Exposure withEv100(Exposure const& exposure, float ev100) {
    Exposure changed = exposure;
    const float aperture = exposure.aperture;
    changed.shutterSeconds = aperture * aperture / exposure.iso * 100 / std::exp2(ev100);
    return changed;
}

void addBookmark(Document& document) {
    const auto isTaken = [&](std::string const& name) {
        return std::ranges::find(document.bookmarks, name, &Bookmark::name) != document.bookmarks.end();
    };
    size_t number = document.bookmarks.size() + 1;
    while (isTaken(fmt::format("view {}", number))) ++number;
    document.bookmarks.push_back({ .name = fmt::format("view {}", number), .camera = document.view.camera });
}

void goToBookmark(Document& document, size_t bookmark) {
    if (bookmark < document.bookmarks.size()) document.view.camera = document.bookmarks[bookmark].camera;
}

void removeBookmark(Document& document, size_t bookmark) {
    if (bookmark >= document.bookmarks.size()) return;
    document.bookmarks.erase(document.bookmarks.begin() + static_cast<ptrdiff_t>(bookmark));
}

void useCamera(Document& document, CopyCamera const& camera) {
    document.view.camera.worldFromView = camera.camera.worldFromView;
    document.view.camera.lens = camera.camera.lens;
}

CameraHeading headingOf(Camera const& camera) {
    const double3 forward = -double3(camera.worldFromView[2]);
    return { .yawDegrees = glm::degrees(std::atan2(forward.x, -forward.z)),
             .pitchDegrees = glm::degrees(std::asin(std::clamp(forward.y, -1.0, 1.0))) };
}

} // namespace filament_core::view
