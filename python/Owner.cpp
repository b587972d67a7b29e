// SPDX-License-Identifier: Apache-2.0
#include "python/Owner.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>

#include <chrono>

namespace filament_core::python {
namespace {

bool gExits = false; // the interpreter does: no new engines, no calls

std::unordered_set<Owner*>& owners() {
    static auto* all = new std::unordered_set<Owner*>; // outlives the interpreter
    return *all;
}

} // namespace

Owner::Owner(std::unique_ptr<Engine> engine)
        : mEngine(std::move(engine)), mDevice(mEngine->device()), mThread(std::this_thread::get_id()),
          mProcess(::getpid()) {
    static bool registered = false;
    if (!registered) py::module_::import("atexit").attr("register")(py::cpp_function(&Owner::closeAll));
    registered = true;
    owners().insert(this);
}

Owner::~Owner() {
    owners().erase(this);
    end();
}

std::shared_ptr<Owner> Owner::create(EngineOptions const& options) {
    if (gExits) raiseClosedError("the interpreter exits: there are no new engines");
    // The engine belongs to the thread that creates it, which is this one.
    Result<Engine> engine = released([&] { return Engine::create(options); });
    return std::shared_ptr<Owner>(new Owner(std::make_unique<Engine>(valueOf(std::move(engine)))));
}

bool Owner::isOfThisProcess() const { return mProcess == ::getpid(); }

Owner::Call::Call(Owner& owner) : mOwner(owner) {
    if (!owner.isOpen() || gExits) raiseClosedError("the engine was closed");
    if (!owner.isOfThisProcess())
        raise({ ErrorCode::InvalidArgument,
                "the engine was made before fork() and has no threads in this process; make "
                "one here, or use multiprocessing's method 'spawn'" });
    if (owner.mThread != std::this_thread::get_id())
        raiseThreadError("the engine belongs to another thread: call Engine.use_on_this_thread() first, once that one "
                         "has stopped using it");
    ++owner.mCalls;
    std::exchange(owner.mDropped, {}).clear();
}

void Owner::useOnThisThread() {
    if (!isOpen() || gExits) raiseClosedError("the engine was closed");
    if (mThread == std::this_thread::get_id()) return;
    if (mCalls > 0) raiseThreadError("the engine is at work on its thread: wait until that call has returned");
    if (!isOfThisProcess()) raise({ ErrorCode::InvalidArgument, "the engine was made before fork(); make one here" });
    mEngine->useOnThisThread();
    mThread = std::this_thread::get_id();
}

void Owner::drop(std::shared_ptr<void> value) {
    if (!value) return;
    if (!isOfThisProcess())
        new std::shared_ptr<void>(std::move(value)); // leaked: its destructor would wait for threads that are not here
    else if (isOpen() && mThread != std::this_thread::get_id())
        mDropped.push_back(std::move(value));
}

void Owner::close() {
    if (!isOpen()) return;
    const std::shared_ptr<Owner> self = shared_from_this(); // what it holds may be the last that refers to it
    { const Call call(*this); }
    if (mCalls > 0) raiseThreadError("the engine is at work: close it once that call has returned");
    end();
}

void Owner::end() {
    if (!isOpen()) return;
    if (!isOfThisProcess()) {
        static_cast<void>(mEngine.release()); // see drop()
        for (std::shared_ptr<void>& value : mDropped) new std::shared_ptr<void>(std::move(value));
        return;
    }
    mEngine->useOnThisThread(); // it is unused now
    mThread = std::this_thread::get_id();
    for (HeldBase* held : std::vector(mHeld.begin(), mHeld.end())) held->take();
    std::exchange(mDropped, {}).clear();
    std::unique_ptr<Engine> engine = std::move(mEngine);
    released([&] { engine.reset(); });
}

void Owner::checkExit() {
    if (gExits) raiseClosedError("the engine was closed: the interpreter exits");
}

void Owner::raiseErrors() {
    const std::vector<std::string> errors = mEngine->takeErrors();
    if (!errors.empty()) raise({ ErrorCode::DeviceLost, fmt::format("{}", fmt::join(errors, "; ")) });
}

void Owner::closeAll() {
    gExits = true;
    std::vector<std::shared_ptr<Owner>> all;
    for (Owner* owner : owners()) all.push_back(owner->shared_from_this());
    for (std::shared_ptr<Owner> const& owner : all) {
        // A daemon thread may be inside of a call, which ends: the next one is refused.
        while (owner->mCalls > 0 && owner->isOfThisProcess())
            released([] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
        owner->end();
    }
}

} // namespace filament_core::python
