// SPDX-License-Identifier: Apache-2.0
/// Studio: one backend, with an engine for each set of engine options. Take: one scene with one set of settings, which
/// can be drawn repeatedly.
///   In      scene files and Settings.   Out: pictures, milliseconds.
///   Memory  what a Take needs is loaded once per studio and shared; see forgetUnusual(). Takes must end before their
///           studio.
///   Thread  one per studio.
///   Fails   errors of the loaders and the device, in one line.
///   Cost    the first picture of a new combination compiles a pipeline: up to a second.
#pragma once

#include "toolkit/pictures/Picture.h"
#include "toolkit/scenes/ShownScene.h"
#include "tools/accuracy/Bakes.h"
#include "tools/accuracy/Settings.h"

#include <filament_core/Renderer.h>

#include <map>
#include <memory>
#include <optional>

namespace filament_core::accuracy {

using namespace tools; // the toolkit

/// The scene's own view: the settings to start from.
Settings settingsOf(tools::SceneSpec const& spec);

/// What a take draws, together with everything that must stay alive for it.
struct TakeParts {
    ShownScene shown;
    View view{};
    Owned<SwapChain> target{};
    uint32_t frames = 1;        ///< drawn for a picture: its effects may need those before
    double3 cameraMoves{ 0.0 }; ///< metres a frame; the last one is seen from `view`
};

class Take {
public:
    Take(Engine& engine, Renderer& renderer, TakeParts parts);
    /// Draws and reads back.
    Result<Picture> shoot();
    /// Draws two frames; returns the device's milliseconds for all passes of the second, that of a still scene.
    Result<double> time();
    View const& view() const { return mParts.view; }

private:
    Result<void> checkDevice();

    Engine& mEngine;
    Renderer& mRenderer;
    TakeParts mParts;
};

class Studio {
public:
    /// `bakes`: shared with other studios; null: its own.
    static Result<std::unique_ptr<Studio>> open(Backend backend, tools::SceneFolders const& folders,
                                                std::shared_ptr<Bakes> bakes = {});
    ~Studio();

    DeviceDescription const& device() const { return mDevice; }
    /// `linear`: scene-linear half floats, without the tone mapper.
    Result<std::unique_ptr<Take>> take(tools::SceneSpec const& named, Settings const& settings, uint2 size,
                                       bool linear);
    /// Milliseconds for loading one file again, with an empty cache.
    Result<double> timeEnvironment(tools::SceneSpec const& spec, Settings const& settings);
    Result<double> timeModel(tools::SceneSpec const& spec, Settings const& settings);
    /// Drops files that no Take uses and that were loaded with special options: a cube of 2048 takes half a gigabyte.
    void forgetUnusual();

private:
    struct Equipment; // one engine, and the files loaded for it
    Studio(Backend backend, tools::SceneFolders const& folders, std::shared_ptr<Bakes> bakes);
    Result<Equipment*> equipment(Settings const& settings);

    const Backend mBackend;
    const tools::SceneFolders mFolders;
    const std::shared_ptr<Bakes> mBakes;
    DeviceDescription mDevice;
    std::map<std::string, std::unique_ptr<Equipment>> mEquipment; // by Settings::engineKey
};

} // namespace filament_core::accuracy
