// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/CompileQueue.h"

#include <algorithm>

namespace filament_core::engine {
namespace {

/// The number of creations per frame, by priority.
constexpr std::array<uint32_t, 4> kSliceSizes{ 1, 2, 4, 16 };

passes::PipelineUse useOf(CompileJob const& job, CompileRequest const& request) {
    return { job.states[request.state], request.geometryLayout, request.variant, request.mirrored, request.pass };
}

} // namespace

bool CompileQueue::exists(CompileJob const& job, CompileRequest const& request) const {
    if (request.isFullScreen) return mPipelines.findFullscreen(request.slot, *job.material).has_value();
    if (request.geometryLayout == CompileRequest::kNoGeometry)
        return mPipelines.hasProgram(request.slot, *job.material, request.variant);
    return mPipelines.find(request.slot, useOf(job, request)).has_value();
}

void CompileQueue::make(backend::CommandBuffer& commands, CompileJob const& job, CompileRequest const& request) {
    if (request.isFullScreen)
        (void)mPipelines.fullscreenPipeline(commands, request.slot, *job.material);
    else if (request.geometryLayout == CompileRequest::kNoGeometry)
        mPipelines.prepareProgram(commands, request.slot, *job.material, request.variant);
    else
        (void)mPipelines.pipelineFor(commands, request.slot, useOf(job, request));
}

Compilation CompileQueue::add(CompileJob job, CompilePriority priority) {
    std::erase_if(job.requests, [&](CompileRequest const& request) { return exists(job, request); });
    const auto total = static_cast<uint32_t>(job.requests.size());
    mProgress.push_back({ 0, total });
    const uint64_t id = mProgress.size();
    if (total == 0) return { id };
    try {
        mQueues[static_cast<size_t>(priority)].push_back({ id, std::move(job), 0 });
    } catch (...) {
        mProgress.pop_back();
        throw;
    }
    return { id };
}

CompileProgress CompileQueue::progress(Compilation compilation) const {
    FILAMENT_ASSERT(compilation.id >= 1 && compilation.id <= mProgress.size(),
                    "a compilation comes from this engine's compile()");
    return mProgress[compilation.id - 1];
}

CompileQueue::Queue* CompileQueue::highest() {
    const auto queue = std::find_if(mQueues.rbegin(), mQueues.rend(), [](Queue const& q) { return !q.empty(); });
    return queue == mQueues.rend() ? nullptr : &*queue;
}

bool CompileQueue::isWaiting() const {
    return mSlice.empty() && std::ranges::any_of(mQueues, [](Queue const& queue) { return !queue.empty(); });
}

void CompileQueue::recordSlice(backend::CommandBuffer& commands, uint64_t submission) {
    if (!isWaiting()) return;
    Queue& queue = *highest();
    mSliceSubmission = submission;
    takeFrom(queue, commands, kSliceSizes[static_cast<size_t>(&queue - mQueues.data())]);
}

void CompileQueue::takeFrom(Queue& queue, backend::CommandBuffer& commands, uint32_t count) {
    while (count > 0 && !queue.empty()) {
        Waiting& first = queue.front();
        mSlice.push_back({ first.id, 0, first.job.onProgress }); // remember what is recorded
        for (; count > 0 && first.next < first.job.requests.size(); --count) {
            make(commands, first.job, first.job.requests[first.next]);
            ++first.next;
            ++mSlice.back().count;
        }
        if (first.next == first.job.requests.size()) queue.pop_front();
    }
}

void CompileQueue::collect(uint64_t replayedSubmissions) {
    // A pipeline counts as made once the driver thread has replayed its creation: drivers compile there.
    if (mSlice.empty() || replayedSubmissions < mSliceSubmission) return;
    const std::vector<Recorded> finished = std::exchange(mSlice, {});
    for (Recorded const& recorded : finished) mProgress[recorded.id - 1].done += recorded.count;
    for (Recorded const& recorded : finished) { // the callback may compile and destroy materials
        if (recorded.onProgress) recorded.onProgress(mProgress[recorded.id - 1]);
    }
}

void CompileQueue::forget(scene::Material const& material) {
    for (Queue& queue : mQueues) {
        for (Waiting const& waiting : queue) {
            if (waiting.job.material != &material) continue;
            // What is no longer made counts as done, so that progress ends.
            mProgress[waiting.id - 1].done += static_cast<uint32_t>(waiting.job.requests.size() - waiting.next);
        }
        std::erase_if(queue, [&](Waiting const& waiting) { return waiting.job.material == &material; });
    }
}

} // namespace filament_core::engine
