// SPDX-License-Identifier: Apache-2.0
/// Drivers controlled by a test, and streams around them.
#pragma once

#include "backend/null/NullDriver.h"
#include "backend/stream/CommandStream.h"
#include "base/Log.h"

#include <gtest/gtest.h>

#include <pthread.h>

#include <array>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace filament_core::backend {

using namespace std::chrono_literals;

/// Closed until open(); threads in wait() then continue. It opens at the end of the scope, so that a test leaves no
/// thread waiting.
class Gate {
public:
    ~Gate() { open(); }
    void open() {
        const std::lock_guard lock(mMutex);
        mIsOpen = true;
        mChanged.notify_all();
    }
    void wait() {
        std::unique_lock lock(mMutex);
        ++mArrived;
        mChanged.notify_all();
        mChanged.wait(lock, [&] { return mIsOpen; });
    }
    /// Waits until `count` threads in all have reached wait().
    void waitForArrival(int count = 1) {
        std::unique_lock lock(mMutex);
        mChanged.wait(lock, [&] { return mArrived >= count; });
    }

private:
    std::mutex mMutex;
    std::condition_variable mChanged;
    bool mIsOpen = false;
    int mArrived = 0;
};

/// Collects the lines that are logged during its lifetime.
class CollectedLog {
public:
    CollectedLog() {
        mBefore = setLogSink([this](Severity, std::string_view line) {
            const std::lock_guard lock(mMutex);
            mLines.emplace_back(line);
        });
    }
    ~CollectedLog() { setLogSink(std::move(mBefore)); }
    std::vector<std::string> lines() const {
        const std::lock_guard lock(mMutex);
        return mLines;
    }

private:
    LogSink mBefore;
    mutable std::mutex mMutex;
    std::vector<std::string> mLines;
};

/// Observes the life of a driver, and makes it do things.
struct Script {
    std::atomic<int> executed{ 0 }, idled{ 0 }, destroyed{ 0 };
    std::atomic<bool> strayThread{ false }; ///< called from a thread other than the one that created it
    std::string threadName;
    std::function<void(ResultSink&)> onExecute; ///< runs inside execute()
};

class ScriptedDriver final : public Driver {
public:
    ScriptedDriver(Script& script, ResultSink& sink) : mScript(script), mSink(sink) {
        mInfo.deviceName = "scripted";
        std::array<char, 16> name{};
        pthread_getname_np(pthread_self(), name.data(), name.size());
        mScript.threadName = name.data();
    }
    ~ScriptedDriver() override {
        check();
        ++mScript.destroyed;
    }
    DeviceInfo const& info() const override { return mInfo; }
    void execute(CommandView) override {
        check();
        if (mScript.onExecute) mScript.onExecute(mSink);
        ++mScript.executed;
    }
    void waitIdle() override {
        check();
        ++mScript.idled;
    }
    DriverStatistics statistics() const override { return { .commands = static_cast<uint64_t>(mScript.executed) }; }

private:
    void check() {
        if (std::this_thread::get_id() != mHome) mScript.strayThread = true;
    }
    Script& mScript;
    ResultSink& mSink;
    DeviceInfo mInfo;
    std::thread::id mHome = std::this_thread::get_id();
};

inline std::unique_ptr<CommandStream> startScripted(Script& script, CommandStreamOptions options = {}) {
    auto stream = CommandStream::start(
            [&](ResultSink& sink) -> Result<std::unique_ptr<Driver>> {
                return { std::make_unique<ScriptedDriver>(script, sink) };
            },
            options);
    EXPECT_TRUE(stream.ok());
    return std::move(*stream);
}

inline std::unique_ptr<CommandStream> startNull(CommandStreamOptions options = {}) {
    auto stream = CommandStream::start(
            [](ResultSink& sink) -> Result<std::unique_ptr<Driver>> { return createNullDriver(sink); }, options);
    EXPECT_TRUE(stream.ok());
    return std::move(*stream);
}

/// The smallest stream that counts as a frame.
inline void submitFrame(CommandStream& stream, uint64_t frame) {
    CommandBuffer& commands = stream.acquire();
    commands.record(CmdBeginFrame{ frame });
    commands.record(CmdEndFrame{ frame });
    stream.submit(commands);
}

} // namespace filament_core::backend
