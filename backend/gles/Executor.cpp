// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Executor.h"

#include "backend/gles/ProgramCache.h"

#include <new>

namespace filament_core::backend::gles {
namespace {

struct Dispatch {
    Executor& executor;
    uint64_t& count;

    template <class C>
    void execute(C const& command) {
        ++count;
        executor.execute(command);
    }
};

} // namespace

// ---------------------------------------------------------------------------------------------- life time

Result<std::unique_ptr<Executor>> Executor::create(DriverOptions const& options, ResultSink& sink, QuirkFilter filter) {
    Result<OpenDevice> device = chooseDevice(options);
    if (!device) return device.error();
    if (filter) filter(device->quirks);
    return std::make_unique<Executor>(std::move(*device), options, sink);
}

Executor::Executor(OpenDevice device, DriverOptions const& options, ResultSink& sink)
        : mContext(std::move(device.context)), mDisplay(options.display),
          mDevice(device.gl, device.quirks, sink, options.validation), mBuffers(mDevice), mTextures(mDevice),
          mSamplers(mDevice), mFramebuffers(mDevice), mVertices(mDevice), mPass(mDevice, mTextures, mFramebuffers),
          mDraws(mDevice.state, mVertices), mReadbacks(mDevice, mTextures, mFramebuffers), mTimers(mDevice),
          mCompute(mDevice.state, mPipelines, mBindGroups) {
    openProgramCache(mDevice, options.cacheDirectory);
}

Executor::~Executor() {
    try {
        waitIdle(); // delivers every answer that is still possible
        if (mDevice.programs) mDevice.programs->save();
    } catch (std::bad_alloc const&) { // then nothing is saved
    }
    mContext.makeCurrent();
}

DriverStatistics Executor::statistics() const {
    const std::lock_guard lock(mPublishedMutex);
    return mPublished;
}

void Executor::publishStatistics() {
    const std::lock_guard lock(mPublishedMutex);
    mPublished = mDevice.statistics;
}

// ---------------------------------------------------------------------------------------------- streams

void Executor::execute(CommandView commands) {
    mContext.makeCurrent();
    if (mDevice.lost) return;
    Dispatch dispatch{ *this, mDevice.statistics.commands };
    replay(commands, dispatch);
    answer(false);
    publishStatistics();
}

void Executor::waitIdle() {
    mContext.makeCurrent();
    if (mDevice.lost) return;
    mDevice.gl.Finish();
    answer(true);
    mDevice.checkLost();
}

void Executor::answer(bool wait) {
    const size_t readbacks = mReadbacks.countReady(wait); // first: what they waited for has its time stamps as well
    mTimers.poll(wait);
    mReadbacks.answer(readbacks);
}

// ---------------------------------------------------------------------------------------------- frames

void Executor::endFrame() {
    // The fence first, so that the flush carries it to the device, too.
    mFrames.push_back(Fence(mDevice));
    mDevice.gl.Flush();
    if (mFrames.size() <= kFramesInFlight) return;
    mFrames.front().wait();
    mFrames.pop_front();
}

void Executor::execute(CmdEndFrame const&) {
    endFrame();
    mDevice.checkLost();
#ifndef NDEBUG
    // Once a frame and in debug builds only: asking for errors may wait for a driver that works on a thread of its own.
    const GLenum error = mDevice.takeError();
    if (error != GL_NO_ERROR && !mDevice.messages) {
        mDevice.error(DriverErrorKind::Validation, "{} during this frame; DriverOptions::validation names the call",
                      glErrorName(error));
    }
#endif
    answer(false);
}

void Executor::execute(CmdPushGroup const& command) {
    if (!mDevice.messages) return;
    mDevice.gl.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(command.name.size()),
                              command.name.data());
}

void Executor::execute(CmdPopGroup const&) {
    if (mDevice.messages) mDevice.gl.PopDebugGroup();
}

} // namespace filament_core::backend::gles
