// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Validator.h"

namespace filament_core::backend {

template <class F>
void Validator::forEachTable(F&& visit) {
    visit(mBuffers);
    visit(mTextures);
    visit(mSamplers);
    visit(mPrograms);
    visit(mPipelines);
    visit(mBindGroups);
    visit(mSurfaces);
}

bool Validator::check(CommandView commands) {
    mCommandIndex = 0;
    mCrashes = false;
    const bool frameWasOpen = mFrameOpen;
    replay(commands, *this);

    mCommand = "end of the stream";
    mObject = {};
    require(!mPass, Harm::Crash, "pass '{}' is still open; record CmdEndPass", mPass ? mPass->name : "");
    require(mOpenTimers.empty(), Harm::Crash, "{} timers are still open; record CmdEndTimer in the same stream",
            mOpenTimers.size());
    require(mOpenGroups.empty(), Harm::WrongResult, "group '{}' is still open; record CmdPopGroup",
            mOpenGroups.empty() ? "" : mOpenGroups.back());
    // Each stream starts anew: one mistake should not be reported again for every stream that follows.
    mPass.reset();
    mOpenTimers.clear();
    mOpenGroups.clear();

    if (!mCrashes) {
        forEachTable([](auto& table) { table.commit(); });
        return true;
    }
    // The driver never sees this stream, so the model must not have its objects either.
    forEachTable([](auto& table) { table.rollback(); });
    mFrameOpen = frameWasOpen;
    mSink.onError(DriverErrorKind::Validation,
                  fmt::format("a stream of {} commands was dropped: a driver could crash on the errors above",
                              mCommandIndex));
    return false;
}

void Validator::enterPlace(Place place) {
    ++mCommandIndex;
    require(place != Place::OutsidePasses || !mPass, Harm::Crash, "only outside of passes; end the pass first");
    require(place != Place::InsidePass || mPass, Harm::Crash, "only inside a pass; begin one first");
}

void Validator::report(Harm harm, std::string const& rule) {
    mCommandCrashes |= harm == Harm::Crash;
    mCrashes |= mCommandCrashes;
    std::string where = fmt::format("command {} {}", mCommandIndex, mCommand);
    if (!mObject.empty()) where += fmt::format(" '{}'", mObject);
    if (mPass && mPass->name != mObject) where += fmt::format(" in pass '{}'", mPass->name);
    mSink.onError(DriverErrorKind::Validation, fmt::format("{}: {}", where, rule));
}

} // namespace filament_core::backend
