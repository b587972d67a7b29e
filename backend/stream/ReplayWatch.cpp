// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/ReplayWatch.h"

#include "backend/stream/CommandFields.h"
#include "base/Log.h"

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <string_view>
#include <vector>

namespace filament_core::backend {
namespace {

/// Updates `names` as the pipelines of a stream are created and destroyed.
struct PipelineNameKeeper {
    ReplayWatch::PipelineNames& names;
    void execute(CmdCreatePipeline const& command) {
        try {
            names[command.handle] = command.desc.debugName;
        } catch (std::bad_alloc const&) { // messages will call it unknown
        }
    }
    void execute(CmdDestroyPipeline const& command) { names.erase(command.handle); }
    void execute(auto const&) {}
};

/// The first name in a command: of the object that it creates, or of the pass or group that it opens.
template <class T>
std::string_view firstName(T const& value) {
    std::string_view first;
    if constexpr (std::same_as<T, std::string_view>) {
        first = value;
    } else if constexpr (HasFields<T>) {
        visitFields(value, [&](const char*, auto const& field) {
            if (first.empty()) first = firstName(field);
        });
    }
    return first;
}

/// The position of a command in its stream: what is open and bound around it. Views into the stream.
class PlaceFinder {
public:
    PlaceFinder(const std::byte* command, ReplayWatch::PipelineNames& names) : mCommand(command), mKeeper{ names } {}

    template <class C>
    void execute(C const& command) {
        if (mIsFound) return;
        ++mNumber;
        if (reinterpret_cast<const std::byte*>(&command) == mCommand) {
            mIsFound = true;
            mName = kFields<C>.name;
            mObject = firstName(command);
            if constexpr (std::same_as<C, CmdBindPipeline>) mObject = nameOf(command.pipeline);
        } else {
            mKeeper.execute(command);
            follow(command);
        }
    }

    std::string text(std::string const& frame) const {
        if (!mIsFound) return fmt::format("in {}, outside of its commands", frame);
        std::string text = fmt::format("in command {}", mName);
        if (!mObject.empty()) text += fmt::format(" '{}'", mObject);
        text += fmt::format(" (number {} of {}", mNumber, frame);
        if (!mPass.empty()) text += fmt::format(", pass '{}'", mPass);
        if (!mGroups.empty() && mGroups.back() != mPass) text += fmt::format(", group '{}'", mGroups.back());
        if (mPipeline) text += fmt::format(", after pipeline '{}'", nameOf(mPipeline));
        return text + ")";
    }

private:
    void follow(CmdBeginPass const& command) { mPass = command.desc.debugName, mPipeline = {}; }
    void follow(CmdNextSubpass const&) { mPipeline = {}; }
    void follow(CmdEndPass const&) { mPass = {}, mPipeline = {}; }
    void follow(CmdPushGroup const& command) { mGroups.push_back(command.name); }
    void follow(CmdPopGroup const&) {
        if (!mGroups.empty()) mGroups.pop_back();
    }
    void follow(CmdBindPipeline const& command) { mPipeline = command.pipeline; }
    void follow(auto const&) {}

    std::string_view nameOf(PipelineHandle pipeline) const {
        const auto found = mKeeper.names.find(pipeline);
        return found == mKeeper.names.end() ? std::string_view("unknown") : std::string_view(found->second);
    }

    const std::byte* mCommand;
    PipelineNameKeeper mKeeper;
    uint64_t mNumber = 0;
    bool mIsFound = false;
    std::string_view mName, mObject, mPass;
    std::vector<std::string_view> mGroups;
    PipelineHandle mPipeline;
};

} // namespace

void ReplayWatch::begin(Activity activity) {
    const std::lock_guard lock(mMutex);
    mActivity = activity;
    mSeenCommand = nullptr;
    mSince = Clock::now();
    mHasWarned = false;
}

void ReplayWatch::beginReplay(CommandBuffer const& commands, uint64_t frame) {
    {
        const std::lock_guard lock(mMutex);
        mCommands = commands.view();
        mFrame = frame;
        mIsNumberedByApp = commands.contains<CmdBeginFrame>();
        mChangesPipelines = commands.contains<CmdCreatePipeline>() || commands.contains<CmdDestroyPipeline>();
    }
    begin(Activity::Replaying);
}

void ReplayWatch::end() {
    const std::lock_guard lock(mMutex);
    // Once the stream is done. Within one that is still being replayed, PlaceFinder follows the names by itself.
    if (mActivity == Activity::Replaying && mChangesPipelines) {
        PipelineNameKeeper keeper{ mPipelineNames };
        replay(mCommands, keeper);
    }
    mCommands = {};
    mActivity = Activity::None;
}

std::chrono::milliseconds ReplayWatch::period() const {
    using std::chrono::milliseconds;
    return std::clamp(mLimit / 8, milliseconds(1), milliseconds(1000));
}

// Restarts the clock if there has been progress since the last check.
void ReplayWatch::look(Clock::time_point now) {
    const std::byte* const command = mProgress.command();
    if (command == mSeenCommand) return;
    mSeenCommand = command;
    mSince = now;
    mHasWarned = false;
}

void ReplayWatch::check() {
    std::string text;
    {
        const std::lock_guard lock(mMutex);
        const Clock::time_point now = Clock::now();
        look(now);
        if (!warns() || mActivity == Activity::None || mHasWarned || now - mSince < mLimit) return;
        mHasWarned = true;
        try {
            text = describe(now);
        } catch (std::bad_alloc const&) {
            text = "is stuck";
        }
    }
    // Without the lock: the sink of the log may call into the engine.
    log(Severity::Warning, "driver thread: {}; until it continues, nothing is drawn or answered", text);
}

std::string ReplayWatch::describe() {
    const std::lock_guard lock(mMutex);
    const Clock::time_point now = Clock::now();
    look(now);
    return describe(now);
}

std::string ReplayWatch::describe(Clock::time_point now) {
    std::string what;
    switch (mActivity) {
    case Activity::None:
        return "has nothing to do";
    case Activity::MakingDriver:
        what = "making the driver";
        break;
    case Activity::Replaying:
        what = describeReplay();
        break;
    case Activity::Settling:
        what = fmt::format("waiting for the device to finish {}", frameText());
        break;
    case Activity::EndingDriver:
        what = "ending the driver";
        break;
    }
    return what + fmt::format(" for {:.1f} s", std::chrono::duration<double>(now - mSince).count());
}

// The stream stays valid: end() waits for the lock that is held here.
std::string ReplayWatch::describeReplay() {
    PlaceFinder finder(mSeenCommand, mPipelineNames);
    replay(mCommands, finder);
    return finder.text(frameText());
}

std::string ReplayWatch::frameText() const {
    return fmt::format("{} {}", mIsNumberedByApp ? "frame" : "submission", mFrame);
}

} // namespace filament_core::backend
