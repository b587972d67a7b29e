// SPDX-License-Identifier: Apache-2.0
/// LightWork: what the panel of probes asks for and what takes longer than a frame: captures of probes and bakes. Their
/// results become edits of the document.
///   Thread  the main thread; a capture draws on a thread and an engine of its own, a bake is a child process.
///   Life    the destructor waits for a capture and kills a bake.
#pragma once

#include "tools/view/app/BakeRun.h"
#include "tools/view/app/ProbeShot.h"
#include "tools/view/panels/Panels.h"
#include "tools/view/stage/Background.h"
#include "tools/view/stage/Stage.h"

namespace filament_core::view {

class LightWork {
public:
    /// Follows requests. `options`: of the viewer's engine; `out`: where files go.
    void follow(Panels& panels, Document const& document, Stage& stage, EngineOptions const& options,
                std::filesystem::path const& out);
    /// Takes what has finished into the document. Whether there is something new to show.
    bool poll(Panels& panels, Document& document);
    bool isBusy() const { return mShot.has_value() || mBake.isBusy(); }
    std::vector<std::string> takeMessages() { return std::exchange(mMessages, {}); }

private:
    void startCapture(size_t probe, Document const& document, EngineOptions const& options,
                      std::filesystem::path const& out);
    void startBake(Panels const& panels, Document const& document, Stage& stage, std::filesystem::path const& out);
    void takeShot(Document& document);
    void takeBake(Document& document, Result<BakeResult> const& baked);

    std::optional<Background<Result<float>>> mShot;
    std::string mShotName; ///< of the probe that is captured
    std::filesystem::path mShotFile;
    BakeRun mBake;
    std::vector<std::string> mMessages;
};

} // namespace filament_core::view
