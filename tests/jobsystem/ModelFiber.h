// SPDX-License-Identifier: Apache-2.0
/// Fiber: a stack of its own that runs when it is told to, on the thread that tells it; the sanitizers know about it.
///   Thread  one.
///   Memory  256 KiB of stack.
///   Fails   an exception must not leave the body.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <ucontext.h>

namespace filament::jobs::model {

class Fiber {
public:
    /// Stands for the thread's own stack; may be switched to and from, and has no body.
    Fiber();
    /// `body` starts at the first switchTo() and must end in one.
    explicit Fiber(std::function<void()> body);
    ~Fiber();
    Fiber(Fiber const&) = delete;
    Fiber& operator=(Fiber const&) = delete;

    /// Goes on there; returns when something switches back to this one.
    void switchTo(Fiber& next);

private:
    static void enter();
    void arrive();

    ucontext_t mContext{};
    std::function<void()> mBody;
    std::unique_ptr<std::byte[]> mStack;
    const void* mStackBottom = nullptr; // for the address sanitizer
    size_t mStackSize = 0;
    void* mFakeStack = nullptr;
    void* mSanitizerFiber = nullptr; // for the thread sanitizer
};

} // namespace filament::jobs::model
