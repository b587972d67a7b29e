// SPDX-License-Identifier: Apache-2.0
/// Options: the checked command line of filament-render.
///   Fails   parseOptions: InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "base/Result.h"
#include "toolkit/program/SceneOptions.h"

#include <filament_core/Aov.h>
#include <filament_core/Engine.h>
#include <filament_core/Shares.h>
#include <filament_core/SkyDesc.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::tools {

enum class PictureFormat : uint8_t { Png, Png16, Exr };

struct Options : SceneOptions {
    std::vector<Backend> backends{ Backend::Vulkan, Backend::Gles };
    std::string requireDevice;
    std::optional<SkyDesc> sky; ///< in the place of an environment's file; iblIntensity is that of its radiances
    bool skyFog = false;        ///< the fog of its air
    uint32_t frames = 1;
    std::vector<std::pair<std::string, std::string>> values;     ///< for the parameters of a material
    std::vector<std::pair<std::string, std::string>> sceneEdits; ///< keys of a scene file, where the model is one
    uint32_t copies = 1;                                         ///< of the model, on a grid
    uint32_t tolerance = 0;                                      ///< in 1/255
    PictureFormat format = PictureFormat::Png;
    std::vector<Aov> aovs{};                   ///< layers of DIR/API.aovs.exr, each once; empty: none
    std::optional<ShareTerms> shares{};        ///< of the picture in DIR/API.shares.exr; none: no such file
    std::optional<uint2> explainPixel{};       ///< printed, and written to DIR/API.pixel.json; none: neither
    std::optional<double> seconds;             ///< time of the animation and of materials; none: rest pose, 0
    std::string animation;                     ///< name or index; empty: the first, if there is a time
    double framesPerSecond = 24;               ///< (0, 1e4]: Aov::Motion is from 1/framesPerSecond before `seconds`
    double3 previousEye{ 0 }, previousAt{ 0 }; ///< of that earlier frame's camera
    bool timing = false, explain = false, trace = false;
    std::filesystem::path traceJobs;    ///< empty: none
    std::filesystem::path saveFrame;    ///< folder of a saved frame (toolkit/record); empty: none
    std::vector<std::string> arguments; ///< of the command line, as given
    int workers = -1;                   ///< as EngineOptions::workers
    ThreadAffinity affinity = ThreadAffinity::None;
    int driverCore = -1; ///< -1: the driver thread is not pinned
    bool repinAfterWaits = false;
    bool listDevices = false, checkAsset = false;
    std::optional<double> budgetMilliseconds; ///< device time of a frame: the quality is chosen to fit
    std::filesystem::path costs;              ///< its cost table; empty: the library's
    std::filesystem::path saveLook;           ///< .cube file for grading and tone mapper; empty: none
    std::filesystem::path saveGltf;           ///< .glb or .gltf of the scene; empty: none
    std::filesystem::path measureCosts;       ///< file for a new cost table of this scene; empty: none
};

/// No value: the help text was requested and has been printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament_core::tools
