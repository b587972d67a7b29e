// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Timers.h"

#include <algorithm>

namespace filament_core::backend::gles {

Timers::~Timers() {
    for (Timer const& timer : mOpen) mSpare.push_back(timer.begin);
    for (; !mEnded.empty(); mEnded.pop_front()) {
        mSpare.insert(mSpare.end(), { mEnded.front().begin, mEnded.front().end });
    }
    if (!mSpare.empty()) mDevice.gl.DeleteQueries(static_cast<GLsizei>(mSpare.size()), mSpare.data());
}

GLuint Timers::stamp() {
    GLuint query = 0;
    if (mSpare.empty()) {
        mDevice.gl.GenQueries(1, &query);
    } else {
        query = mSpare.back();
        mSpare.pop_back();
    }
    // llvmpipe collects commands into a scene and takes the timestamp in each of its tiles; the last tile counts.
    // Flushing before and after makes the timestamp a scene of its own, which runs when all earlier scenes are done.
    mDevice.gl.Flush();
    mDevice.gl.QueryCounter(query, GL_TIMESTAMP_EXT);
    mDevice.gl.Flush();
    return query;
}

void Timers::begin(Ticket ticket) {
    if (!mDevice.quirks.timers) return;
    mOpen.push_back({ ticket, stamp(), 0 });
}

void Timers::end(Ticket ticket) {
    if (!mDevice.quirks.timers) {
        mDevice.sink.onTimer(ticket, 0);
        return;
    }
    const auto open =
            std::find_if(mOpen.rbegin(), mOpen.rend(), [ticket](Timer const& timer) { return timer.ticket == ticket; });
    FILAMENT_ASSERT(open != mOpen.rend(), "a timer that ends has begun");
    mEnded.push_back({ ticket, open->begin, stamp() });
    mOpen.erase(std::next(open).base());
}

uint64_t Timers::read(GLuint query) const {
    GLuint64 nanoseconds = 0;
    mDevice.gl.GetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
    return nanoseconds;
}

void Timers::poll(bool wait) {
    if (mEnded.empty() || mDevice.lost) return;
    GLint disjoint = 0; // reading it resets it
    mDevice.gl.GetIntegerv(GL_GPU_DISJOINT_EXT, &disjoint);
    while (!mEnded.empty()) {
        const Timer timer = mEnded.front();
        GLuint available = 0;
        if (!wait) mDevice.gl.GetQueryObjectuiv(timer.end, GL_QUERY_RESULT_AVAILABLE, &available);
        // In the order of ending: if the end of one is not there, those of later ones are not either.
        if (!wait && !available) return;
        mEnded.pop_front();
        const uint64_t begin = read(timer.begin), end = read(timer.end);
        mSpare.insert(mSpare.end(), { timer.begin, timer.end });
        mDevice.sink.onTimer(timer.ticket, disjoint || end < begin ? 0 : end - begin);
    }
}

} // namespace filament_core::backend::gles
