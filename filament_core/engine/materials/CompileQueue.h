// SPDX-License-Identifier: Apache-2.0
/// CompileQueue: programs and pipelines requested before their first draw, sent to the driver thread in slices.
///   In      requests: a material with the states of its instances, vertex layouts, variants, passes.
///   Out     creations recorded into frames; how many of them have been replayed.
///   Order   highest priority first, then in order of arrival. One slice is under way at a time: the next one is sent
///           when the driver thread has finished it, so that no frame waits for more than one.
///   Thread  the app thread.
///   Memory  16 bytes per request until it is done; 16 bytes per compilation permanently.
///   Fails   add() and recordSlice(): std::bad_alloc; anything not recorded stays queued.
#pragma once

#include "filament_core/passes/PipelineCache.h"

#include <filament_core/Objects.h>

#include <array>
#include <deque>
#include <functional>
#include <vector>

namespace filament_core::engine {

/// A pipeline, or (without geometry) only a program, or (full screen) a pipeline of a material without geometry.
struct CompileRequest {
    static constexpr uint16_t kNoGeometry = 0xFFFF;
    uint32_t slot = 0;                     ///< of PipelineCache
    uint16_t geometryLayout = kNoGeometry; ///< of GeometryLayouts
    uint16_t state = 0;                    ///< of CompileJob::states
    uint8_t variant = 0;
    bool mirrored = false;
    prepare::DrawPass pass = prepare::DrawPass::Only;
    bool isFullScreen = false;
};

struct CompileJob {
    scene::Material const* material = nullptr;
    std::vector<scene::MaterialInstance> states; ///< the part of the instances that selects pipelines
    std::vector<CompileRequest> requests;
    std::function<void(CompileProgress const&)> onProgress;
};

class CompileQueue {
public:
    explicit CompileQueue(passes::PipelineCache& pipelines) : mPipelines(pipelines) {}

    /// Requests for existing objects do not count.
    Compilation add(CompileJob job, CompilePriority priority);
    CompileProgress progress(Compilation compilation) const;

    /// Whether recordSlice() would record something now.
    bool isWaiting() const;
    /// Records into the submission of that number, unless an earlier slice is under way.
    void recordSlice(backend::CommandBuffer& commands, uint64_t submission);
    /// Counts what is finished, and calls the callbacks.
    void collect(uint64_t replayedSubmissions);
    /// Stops work for a material that is destroyed: its remaining requests count as done.
    void forget(scene::Material const& material);

private:
    struct Waiting {
        uint64_t id = 0;
        CompileJob job;
        size_t next = 0; ///< of the next one to create
    };
    using Queue = std::deque<Waiting>;

    bool exists(CompileJob const& job, CompileRequest const& request) const;
    void make(backend::CommandBuffer& commands, CompileJob const& job, CompileRequest const& request);
    Queue* highest();
    void takeFrom(Queue& queue, backend::CommandBuffer& commands, uint32_t count);

    passes::PipelineCache& mPipelines;
    std::array<Queue, 4> mQueues;           ///< by priority
    std::vector<CompileProgress> mProgress; ///< by id - 1
    struct Recorded {
        uint64_t id = 0;
        uint32_t count = 0;
        std::function<void(CompileProgress const&)> onProgress;
    };
    std::vector<Recorded> mSlice; ///< under way
    uint64_t mSliceSubmission = 0;
};

} // namespace filament_core::engine
