// SPDX-License-Identifier: Apache-2.0
/// ProgressiveReference: the path tracer on a thread of its own, while a viewer keeps drawing.
///   Use     setScene() once per document, setView() whenever camera, size or settings change; each frame
///           takePicture().
///   Out     an image after every pass, the newest one only. After the last pass its bits are those of
///           filament-reference with the same settings, whatever was asked before.
///   Thread  all functions: one thread, which never waits: neither for a pass nor for the loading of a scene. Rays are
///           traced on one other thread, of lower priority.
///   Cancel  setView(), stop() and the destructor end a pass within the time of one pixel: tens of milliseconds. A
///           scene that is being loaded is loaded to its end first; the destructor waits for that.
///   Memory  the scene (Reference.h), 216 bytes a pixel with 16 passes, and two finished images.
///   Fails   status() says why: errors of the loader, of the scene, of the settings.
#pragma once

#include "tools/reference/Reference.h"

#include <filament_core/DisplayTransform.h>
#include <filament_core/Image.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace filament_core::view {

/// Called on the tracing thread. loadScene() of tools/reference/LoadScene.h reads what filament-reference reads.
using SceneLoader = std::function<Result<reference::ReferenceScene>(jobs::JobSystem&)>;

struct TracingStatus {
    enum class State : uint8_t { Idle, Loading, Tracing, Finished, Failed };
    State state = State::Idle;                  ///< of the last scene and view that were set
    bool isBusy = false;                        ///< the thread works, perhaps still on what is no longer wanted
    uint32_t samplesDone = 0, samplesTotal = 0; ///< per pixel
    double relativeError = 0;                   ///< RenderStatistics; 0: not known yet
    std::string error;                          ///< one line, of Failed
    std::vector<std::string> warnings;          ///< of the scene
};

struct TracedView {
    reference::ReferenceImage image;
    uint64_t view = 0; ///< number of the setView() that it belongs to
    bool isFinished = false;
};

class ProgressiveReference {
public:
    ProgressiveReference();
    ~ProgressiveReference();
    ProgressiveReference(ProgressiveReference const&) = delete;
    ProgressiveReference& operator=(ProgressiveReference const&) = delete;

    /// Ends what is traced. The view is traced again once the scene is there.
    void setScene(SceneLoader loader);
    /// Ends what is traced and begins anew. Returns the number of this view, from 1.
    uint64_t setView(reference::ReferenceView const& view, reference::ReferenceSettings const& settings);
    /// Until the next setScene() or setView().
    void stop();

    TracingStatus status() const;
    /// The newest image of the last view; none: no pass was finished since the last call.
    std::optional<TracedView> takePicture();

private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

/// Scene-linear RGBA16F, as the engine's target of that format; alpha is 1.
Image linearPicture(reference::ReferenceImage const& image);
/// RGBA8, as the engine's tone mapping pass stores it.
Image displayPicture(reference::ReferenceImage const& image, DisplayTransform const& display);

} // namespace filament_core::view
