// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/ProbeShot.h"

#include "filament_core/assets/files/FileBytes.h"
#include "tools/view/stage/Stage.h"

#include <filament_core/ProbeCapture.h>

namespace filament_core::view {

Result<float> captureToFile(ProbeShot const& shot) {
    Document document = shot.document;
    const DocumentProbe probe = document.probes.at(shot.probe);
    document.probes[shot.probe].isOn = false; // its own light is what is captured anew
    document.view.debugView = DebugView::None;
    EngineOptions options = shot.engine;
    options.display = {};
    options.traceJobs = false;
    auto stage = Stage::create({ .engine = options, .watchesFiles = false });
    if (!stage) return stage.error();
    (*stage)->apply(document);
    (*stage)->finishLoading();
    if ((*stage)->loadError()) return *(*stage)->loadError();
    const ReflectionProbeDesc place{ .centerWorld = probe.centerWorld, .halfExtentMeters = probe.halfExtentMeters };
    ProbeCaptureOptions how{ .faceSize = std::max(64u, document.environment.options.faceSize),
                             .view = (*stage)->view() };
    how.view.effects = { .fog = how.view.effects.fog }; // others look at neighbouring pixels, and leave seams
    how.view.quality.antiAliasing = AntiAliasing::Off;
    const Result<ProbeCapture> captured = captureProbe((*stage)->engine(), (*stage)->scene(), place, how);
    if (!captured) return captured.error();
    if (const Result<void> written = assets::replaceFile(shot.file, captured->ktx2); !written) return written.error();
    return captured->intensity;
}

} // namespace filament_core::view
