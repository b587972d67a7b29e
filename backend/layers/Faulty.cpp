// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Faulty.h"

#include "backend/stream/CommandFields.h"

#include <fmt/core.h>

#include <thread>
#include <utility>

namespace filament_core::backend {
namespace {

template <class C>
concept Creation = requires(C command) {
    command.handle;
    command.desc;
};

std::string_view nameOf(auto const& desc) {
    if constexpr (requires { desc.debugName; }) return desc.debugName;
    return {};
}

} // namespace

void FaultInjector::arm(Faults const& faults) {
    const std::lock_guard lock(mMutex);
    mFaults = faults;
    mCommands = mCreations = 0;
    mHasStruck = false;
    ++mArmed;
}

uint64_t FaultInjector::commandsSeen() const {
    const std::lock_guard lock(mMutex);
    return mCommands;
}

uint64_t FaultInjector::creationsSeen() const {
    const std::lock_guard lock(mMutex);
    return mCreations;
}

bool FaultInjector::hasStruck() const {
    const std::lock_guard lock(mMutex);
    return mHasStruck;
}

class FaultyDriver final : public Driver {
public:
    FaultyDriver(std::unique_ptr<Driver> inner, std::shared_ptr<FaultInjector> injector, ResultSink& sink)
            : mInner(std::move(inner)), mInjector(std::move(injector)), mSink(sink) {}

    DeviceInfo const& info() const override { return mInner->info(); }
    void waitIdle() override { mInner->waitIdle(); }
    DriverStatistics statistics() const override { return mInner->statistics(); }

    void execute(CommandView commands) override {
        readFaults();
        std::this_thread::sleep_for(mFaults.streamDelay);
        mPieces.clear();
        mOpen = {};
        for (CommandChunk const& chunk : commands) walk(chunk);
        closePiece();
        // Forwarded where they lie: the watch of the driver thread knows a command by its address.
        mInner->execute(mPieces);
        writeCounts();
        if (mStrikes) mSink.onError(DriverErrorKind::DeviceLost, mLoss); // after all answers that the device still gave
        mStrikes = false;
    }

    /// Called by walk() for each command: whether the inner driver gets it.
    template <class C>
    bool admit(C const& command) {
        if (mIsLost) return false;
        ++mCommands;
        if (mFaults.commandDelay.count() > 0) delay(command);
        if (mCommands == mFaults.loseDeviceAt) {
            lose(kFields<C>.name);
            return false;
        }
        if constexpr (Creation<C>) {
            if (++mCreations == mFaults.refuseCreation) {
                refuse(kFields<C>.name, nameOf(command.desc));
                return false;
            }
        }
        return true;
    }

private:
    template <class... C>
    static constexpr auto admitTable(TypeList<C...>) {
        return std::array<bool (*)(FaultyDriver&, const std::byte*), sizeof...(C)>{ [](FaultyDriver& driver,
                                                                                       const std::byte* command) {
            return driver.admit(*reinterpret_cast<C const*>(command));
        }... };
    }

    // Consecutive forwarded commands form one piece of their chunk.
    void walk(CommandChunk const& chunk) {
        static constexpr auto kAdmit = admitTable(Commands{});
        const std::byte* const end = chunk.data + chunk.size;
        for (const std::byte* at = chunk.data; at < end;) {
            auto const& header = *reinterpret_cast<CommandHeader const*>(at);
            if (kAdmit[header.id](*this, at + kCommandAlignment)) {
                if (mOpen.data == nullptr) mOpen = { at, 0 };
                mOpen.size += header.bytes;
            } else {
                closePiece();
            }
            at += header.bytes;
        }
        closePiece();
    }

    void closePiece() {
        if (mOpen.size > 0) mPieces.push_back(mOpen);
        mOpen = {};
    }

    // To the watchdog, the replay is inside this command during the delay.
    template <class C>
    void delay(C const& command) {
        if (ReplayProgress* progress = ReplayProgress::ofThisThread())
            progress->enter(reinterpret_cast<const std::byte*>(&command));
        std::this_thread::sleep_for(mFaults.commandDelay);
    }

    void lose(const char* command) {
        mIsLost = mStrikes = mHasStruck = true;
        mLoss = fmt::format("'{}' is lost (injected at command {}, {}); make a new engine", info().deviceName,
                            mCommands, command);
    }

    void refuse(const char* command, std::string_view name) {
        mHasStruck = true;
        mSink.onError(DriverErrorKind::OutOfMemory,
                      fmt::format("{} '{}': out of device memory (injected at creation {}); what needs it is not drawn",
                                  command, name, mCreations));
    }

    void readFaults() {
        const std::lock_guard lock(mInjector->mMutex);
        mFaults = mInjector->mFaults;
        mCommands = mInjector->mCommands;
        mCreations = mInjector->mCreations;
        mHasStruck = mInjector->mHasStruck;
        mArmed = mInjector->mArmed;
    }
    void writeCounts() {
        const std::lock_guard lock(mInjector->mMutex);
        if (mInjector->mArmed != mArmed) return; // rearmed while this stream ran
        mInjector->mCommands = mCommands;
        mInjector->mCreations = mCreations;
        mInjector->mHasStruck = mHasStruck;
    }

    std::unique_ptr<Driver> mInner;
    const std::shared_ptr<FaultInjector> mInjector;
    ResultSink& mSink;

    // of the stream being executed
    Faults mFaults;
    uint64_t mCommands = 0, mCreations = 0, mArmed = 0;
    bool mHasStruck = false;
    bool mStrikes = false; // the device is lost in this stream
    std::string mLoss;
    std::vector<CommandChunk> mPieces;
    CommandChunk mOpen;

    bool mIsLost = false;
};

std::unique_ptr<Driver> faulty(std::unique_ptr<Driver> inner, std::shared_ptr<FaultInjector> injector,
                               ResultSink& sink) {
    return std::make_unique<FaultyDriver>(std::move(inner), std::move(injector), sink);
}

} // namespace filament_core::backend
