// SPDX-License-Identifier: Apache-2.0
/// RenderRequest: what a client wants drawn, as JSON.
///     { "scene": { "points": [ ... ], "camera": { ... } }, "set": { "camera.eye": "0,1,3" }, "size": [640, 360] }
///   Members   scene (a scene file: docs/scene-files.md) or sceneFile (one in the server's folder of scenes); set (keys
///             of it and their values); size; api: "gles" or "vulkan"; format: "png" or "exr"; id: of the client.
///   Files     that scenes name lie below the server's folders: names are relative and do not leave them. A scene that
///             a client sends names models and images of --assets only ("asset:PATH").
///   Fails     InvalidArgument, Corrupt, NotFound: one line with the member.   Thread: any.
#pragma once

#include "base/Result.h"

#include <filament_core/Backend.h>
#include <filament_core/BuildScene.h>
#include <filament_core/SceneFile.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace filament_core::server {

struct RequestLimits {
    std::filesystem::path assets{}, scenes{}; ///< folders; empty: none
    uint32_t mostPixels = 4096 * 4096;
    uint32_t mostFrames = 16;
};

enum class ImageFormat : uint8_t { Png, Exr };

struct RenderRequest {
    std::string id{}; ///< empty: none was given
    SceneFile scene{};
    Backend api = Backend::Gles;
    ImageFormat format = ImageFormat::Png;
};

Result<RenderRequest> parseRequest(std::string_view json, RequestLimits const& limits);

/// Lets files of the server's folders be found, and no others.
SceneBuildOptions buildOptions(RequestLimits const& limits, SceneFile const& scene);

/// An error for clients: paths below the server's folders begin with "assets" or "scenes".
std::string withoutFolders(std::string message, RequestLimits const& limits);

const char* contentType(ImageFormat format);

} // namespace filament_core::server
