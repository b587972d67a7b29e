// SPDX-License-Identifier: Apache-2.0
/// CostMeasurement: draws a document with every setting of quality, beside the viewer, and times and compares its
/// images step by step: see CostPlot.h.
///   Engine   its own, without a window, on a thread of its own. The document is as it was at start(); the viewer may
///            go on.
///   Picture  one of each setting, as a new stage draws it; of 16 frames, if the setting accumulates them (TAA).
///   Error    from the reference that start() was given (the path tracer's image), else from the image of the most
///            exact setting: QualityPreset::Reference, accumulated over 16 frames (TAA), so that its edges are smooth.
///   Steps    in the first round each setting's image is compared and its first time taken, so points appear one by
///            one.
///   Time     the second frame after each change of setting: programs, tables and shadow maps are then there. Settings
///            take turns: a round times each of them once, and begins with another one. The median of the rounds so far
///            is what counts, so other work of the machine hits all settings alike.
///   Clock    the device's, if it times its passes; else the driver thread's.
///   Thread   all functions: one thread, which never waits, except in the destructor: for the frame that is being
///            drawn.
///   Fails    poll(): State::Failed with one line: no engine, a document that cannot be loaded, errors of the device.
#pragma once

#include "tools/view/document/Document.h"
#include "tools/view/panels/CostPlot.h"

#include <filament_core/Engine.h>
#include <filament_core/Image.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::view {

/// An image of the document by other means. Of another size than the document: it is not used.
struct CostReference {
    Image image{};
    std::string name{}; ///< "path tracer: 64 of 256 samples"
};

struct CostMeasurementOptions {
    EngineOptions engine{};                 ///< its display and instruments mean nothing
    uint32_t rounds = 7;                    ///< [1, 1000]
    std::vector<QualitySetting> settings{}; ///< empty: settingsToMeasure()
    std::optional<CostReference> reference{};
};

class CostMeasurement {
public:
    CostMeasurement();
    ~CostMeasurement();
    CostMeasurement(CostMeasurement const&) = delete;
    CostMeasurement& operator=(CostMeasurement const&) = delete;

    /// Nothing, while one is running.
    void start(Document document, CostMeasurementOptions options);
    /// Ends after the frame that is being drawn. What has been measured stays.
    void cancel();
    bool isBusy() const;
    /// Copies what has been measured since the last call. False: nothing is new.
    bool poll(CostPlot& plot);

private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

} // namespace filament_core::view
