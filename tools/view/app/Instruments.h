// SPDX-License-Identifier: Apache-2.0
/// Instruments: what a viewer measures beside its image, for its panels: the costs of settings, the jobs of the last
/// frames; and the defect that a panel injects into the image that is compared.
///   Use      poll() in every step; beforePanels() and afterFrame() around the panels of a drawn frame.
///   Draws    poll() says when something is new to be seen, at most four times a second; frames that are drawn for
///            nothing else are not read again.
///   Thread   the main thread; measurements and readings run on others.
#pragma once

#include "tools/view/app/ComparedPictures.h"
#include "tools/view/app/CostMeasurement.h"
#include "tools/view/panels/Panels.h"
#include "tools/view/stage/Background.h"
#include "tools/view/stage/Stage.h"

#include <chrono>
#include <optional>

namespace filament_core::view {

class Instruments {
public:
    /// Takes what is finished, and starts what has been asked for. Whether a frame has something new to show.
    bool poll(Panels& panels, Stage& stage);
    /// Sets PanelInputs, and what is compared to what the panels say.
    void beforePanels(Panels& panels, Document const& document, Stage& stage, ComparedPictures& compared);
    /// Follows requests. `options`: of the viewer's engine.
    void afterFrame(Panels& panels, Document const& document, ComparedPictures const& compared,
                    EngineOptions const& options);
    /// Before the viewer's engine ends. Waits for a reading of its jobs.
    void closeEngine(Panels& panels);

private:
    using Clock = std::chrono::steady_clock;

    bool pollJobs(Panels& panels, Stage& stage);
    void followDefect(Panels& panels, Backend own, ComparedPictures& compared);

    CostMeasurement mCosts;
    std::optional<Document> mMeasured;
    std::optional<Background<JobLanes>> mReading;
    bool mWantsReading = false, mIsOwnFrame = false; ///< the next frame only shows a reading
    Clock::time_point mNextReading{}, mNextCosts{};
    std::optional<Backend> mOfferedTo;
    std::string mLastDefect;
};

} // namespace filament_core::view
