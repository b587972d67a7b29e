// SPDX-License-Identifier: Apache-2.0
/// Owner: an engine, its thread, and everything in Python that was made from it.
///   Life    Held objects share their owner, so an engine ends after the last of them; or at close(), which destroys
///           them first. Engines that are alive when the interpreter exits are closed before it takes modules apart.
///   Thread  what the engine would end the process for becomes an exception: Call raises ThreadError on another thread
///           than the engine's. Python drops objects on any thread: those that are dropped elsewhere are destroyed in
///           the engine's next call, on its thread.
///   Lock    the interpreter's lock (GIL) guards everything here; released() gives it away while the engine works.
///   Fork    a child process has the engine's memory, but none of its threads: Call raises an error, and nothing of the
///           engine is destroyed there.
#pragma once

#include "python/Errors.h"

#include <filament_core/Engine.h>

#include <sys/types.h>

#include <memory>
#include <string_view>
#include <thread>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

namespace filament_core::python {

/// Calls without the interpreter's lock. A daemon thread that comes back after the interpreter has ended does not
/// return: it is unwound, which pybind11's own guard does not allow.
template <class Function>
auto released(Function&& function) {
    struct Guard {
        PyThreadState* state = PyEval_SaveThread();
        ~Guard() noexcept(false) { PyEval_RestoreThread(state); }
    };
    const Guard guard;
    return std::forward<Function>(function)();
}

class HeldBase;

class Owner : public std::enable_shared_from_this<Owner> {
public:
    /// Raises the engine's error, and Error once the interpreter exits.
    static std::shared_ptr<Owner> create(EngineOptions const& options);
    ~Owner();

    /// One call of Python into the engine, from its first line to its last.
    class Call {
    public:
        explicit Call(Owner& owner);
        ~Call() { --mOwner.mCalls; }
        Call(Call const&) = delete;
        Call& operator=(Call const&) = delete;
        Engine& engine() const { return *mOwner.mEngine; }

    private:
        Owner& mOwner;
    };

    bool isOpen() const { return mEngine != nullptr; }
    /// Destroys what is held, then the engine. Does nothing the second time. Raises ThreadError inside of another call:
    /// what Python runs there (a handler of a signal, the items of a sequence) must not end what that call uses.
    void close();
    void useOnThisThread();
    /// Raises ClosedError if the interpreter waits for this call, to exit: between the steps of long work.
    static void checkExit();
    /// Raises DeviceError with the errors of the device, if there are any.
    void raiseErrors();
    /// What Python holds of this kind and `is(value)`; null: nothing.
    template <class Object, class Is>
    std::shared_ptr<Object> find(Is const& is) const;
    /// Of the device; known without a call.
    DeviceDescription const& device() const { return mDevice; }

private:
    friend class HeldBase;
    explicit Owner(std::unique_ptr<Engine> engine);
    bool isOfThisProcess() const;
    void end();
    void drop(std::shared_ptr<void> value);
    static void closeAll();

    std::unique_ptr<Engine> mEngine;
    DeviceDescription mDevice;
    std::thread::id mThread;
    pid_t mProcess;
    unsigned mCalls = 0;
    std::unordered_set<HeldBase*> mHeld;
    std::vector<std::shared_ptr<void>> mDropped; ///< on other threads
};

/// Something of an engine as Python holds it.
class HeldBase : public std::enable_shared_from_this<HeldBase> {
public:
    std::shared_ptr<Owner> const& owner() const { return mOwner; }
    /// Gives the value up: to Owner::close().
    virtual std::shared_ptr<void> take() = 0;

protected:
    explicit HeldBase(std::shared_ptr<Owner> owner) : mOwner(std::move(owner)) { mOwner->mHeld.insert(this); }
    HeldBase(HeldBase const&) = delete;
    HeldBase& operator=(HeldBase const&) = delete;
    virtual ~HeldBase() { mOwner->mHeld.erase(this); }
    void drop(std::shared_ptr<void> value) { mOwner->drop(std::move(value)); }

private:
    std::shared_ptr<Owner> mOwner;
};

template <class T>
class Held : public HeldBase {
public:
    Held(std::shared_ptr<Owner> owner, T value)
            : HeldBase(std::move(owner)), mValue(std::make_shared<T>(std::move(value))) {}
    ~Held() override { drop(std::move(mValue)); }

    T& operator*() const {
        if (!mValue) raiseClosedError("its engine was closed");
        return *mValue;
    }
    T* operator->() const { return &**this; }
    std::shared_ptr<void> take() override { return std::move(mValue); }

private:
    std::shared_ptr<T> mValue;
};

template <class Object, class Is>
std::shared_ptr<Object> Owner::find(Is const& is) const {
    for (HeldBase* held : mHeld)
        if (auto* object = dynamic_cast<Object*>(held); object && is(**object))
            return std::static_pointer_cast<Object>(held->weak_from_this().lock());
    return nullptr;
}

/// InvalidArgument if `part` belongs to another engine. `what`: "model".
inline void requireSame(Owner const& owner, HeldBase const& part, std::string_view what) {
    if (part.owner().get() != &owner) raiseInvalid("the {} belongs to another engine", what);
}

} // namespace filament_core::python
