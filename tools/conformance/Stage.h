// SPDX-License-Identifier: Apache-2.0
/// Stage: one engine on one backend that draws cases, one after the other.
///   In      set(case), then shoot() any number of times.   Out: the pixels, the errors, the contents of a frame.
///   Memory  the model and the environment of the last case are kept, so the features of a scene load nothing again.
///   Thread  one stage per thread.
///   Fails   errors of the loaders and the device. For a missing asset see missingFile().
#pragma once

#include "backend/layers/Captured.h"
#include "toolkit/mutations/DefectTrace.h"
#include "toolkit/record/Bisect.h"
#include "toolkit/scenes/ShownScene.h"
#include "tools/conformance/ShareCheck.h"

#include <filament_core/Renderer.h>

#include <memory>
#include <optional>

namespace filament_core::conformance {

using namespace tools; // the toolkit

struct StageOptions {
    Backend backend = Backend::Vulkan;
    std::string requireDevice;
    int workers = 1;
    ThreadAffinity affinity = ThreadAffinity::None;
    bool exact = true;            ///< EngineOptions::exactShaders
    bool validation = false;      ///< EngineOptions::validation: its messages are in Shot::errors
    bool capture = false;         ///< shoot() may inspect a frame
    std::filesystem::path work;   ///< built models, the sky, baked environments
    std::filesystem::path assets; ///< the folder of "asset:"; empty: none
};

/// Of a defect in a stage.
enum class DefectSize : uint8_t { AsItIs, Exaggerated };

struct Shot {
    Image image;
    std::vector<std::string> errors; ///< of the device
    std::optional<backend::CapturedFrame> inside;
};

class Stage {
public:
    /// `edit` changes the stream of everything that this stage draws; it implies `capture`.
    static Result<std::unique_ptr<Stage>> open(StageOptions const& options,
                                               std::unique_ptr<backend::StreamEdit> edit = nullptr,
                                               DefectSize size = DefectSize::AsItIs);

    DeviceDescription const& device() const { return mEngine.device(); }
    Result<void> set(SceneSpec const& spec);
    /// Draws the case's frames and returns the last one.
    Result<Shot> shoot(std::optional<backend::CaptureRequest> const& request = {});
    /// Of the case's last frame, drawn as often as the case has frames.
    Result<ShareVerdict> shares();
    /// How far `edit` came since set(). Waits for the device. Without one: nowhere.
    DefectReach reach();

private:
    Stage(StageOptions const& options, Engine engine, std::shared_ptr<backend::FrameCapture> capture,
          DefectTrace* trace);

    Result<void> loadDirt(SceneSpec const& spec);
    Result<void> loadPasses(SceneSpec const& spec);
    /// Where everything is `frames` before the last one.
    void setBack(uint32_t frames);
    void drawOverlays();
    void settleTextures();

    Engine mEngine;
    std::shared_ptr<backend::FrameCapture> mCapture;
    DefectTrace* mTrace; ///< that of mCapture; null: no edit
    Renderer mRenderer;
    SceneLoader mLoader;
    std::optional<ShownScene> mShown;
    Owned<SwapChain> mTarget;
    Owned<Texture> mDirt;
    tools::ScenePasses mPasses;
    View mView;
    Camera mLastCamera; ///< of the last frame
    SceneSpec mSpec;
};

/// For bisect(): frames of the case that was set. The stage must have been opened with capture, and outlive the result.
FrameSource insideOf(Stage& stage);

} // namespace filament_core::conformance
