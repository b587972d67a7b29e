// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenebuild/SceneFileParts.h"

#include "base/math/Elementary.h"
#include "filament_core/assets/files/FileBytes.h"

#include <filament_core/IrradianceGrid.h>
#include <filament_core/LightImage.h>
#include <filament_core/ProbeCapture.h>

#include <algorithm>

namespace filament_core::scenebuild {

Result<void> SceneFileLights::add(LightDesc light, std::filesystem::path const& profile,
                                  std::filesystem::path const& image, LightImageShape shape) {
    if (!profile.empty() && !mProfiles.contains(profile)) {
        const Result<LightProfile> loaded = loadLightProfile(mEngine, profile);
        if (!loaded) return loaded.error();
        mProfiles[profile] = mEngine.own(*loaded);
    }
    const std::pair key(image, shape);
    if (!image.empty() && !mImages.contains(key)) {
        const Result<LightImage> loaded = loadLightImage(mEngine, image, shape);
        if (!loaded) return loaded.error();
        mImages[key] = mEngine.own(*loaded);
    }
    const auto setFiles = [&](auto& one) {
        if constexpr (requires { one.profile; }) {
            if (!profile.empty()) one.profile = mProfiles[profile];
        }
        if constexpr (requires { one.cookie; }) {
            if (!image.empty()) one.cookie = mImages[key];
        }
        if constexpr (requires { one.image; }) {
            if (!image.empty()) one.image = mImages[key];
        }
    };
    std::visit(setFiles, light);
    mScene.add(light);
    return {};
}

void moveBy(double3 const& meters, LightDesc& light) {
    std::visit(
            [&](auto& placed) {
                if constexpr (requires { placed.positionWorld; }) placed.positionWorld += meters;
            },
            light);
}

Result<IrradianceGridDesc> readSceneGrid(SceneFileGrid const& grid, std::filesystem::path const& file) {
    if (file.empty()) return grid.grid;
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    Result<IrradianceGridDesc> read = readIrradianceGrid(*bytes);
    if (!read) return fail(read.error().code, "{}: {}", file.string(), read.error().message);
    read->intensity *= grid.grid.intensity;
    return read;
}

Result<Environment> captureSceneProbe(Engine& engine, Scene const& scene, ReflectionProbeDesc& place, View const& view,
                                      EnvironmentLoadOptions const& options) {
    const ProbeCaptureOptions how{ .faceSize = std::max(64u, options.faceSize), .view = view };
    Result<ProbeCapture> captured = captureProbe(engine, scene, place, how);
    if (!captured) return captured.error();
    place.intensity *= captured->intensity;
    return loadEnvironment(engine, captured->ktx2, "captured probe", options);
}

Camera cameraOf(SceneFileCamera const& camera, double3 const& origin, Exposure const& exposure, Box const& bounds) {
    if (camera.eye) return Camera::lookAt(*camera.eye + origin, camera.at + origin, camera.lens, exposure, camera.up);
    const double3 at = (bounds.min + bounds.max) * 0.5;
    const double radius = std::max(1e-3, glm::length(bounds.max - bounds.min) * 0.5);
    const double halfFov = glm::radians(static_cast<double>(camera.lens.verticalFovDegrees)) * 0.5;
    const double3 eye = at + glm::normalize(double3(0.45, 0.35, 1.0)) * (0.8 * radius / elementary::sin(halfFov));
    return Camera::lookAt(eye, at, camera.lens, exposure, camera.up);
}

} // namespace filament_core::scenebuild
