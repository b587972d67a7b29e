// SPDX-License-Identifier: Apache-2.0
/// Fiber: a separate stack that runs when switched to, on the switching thread; the sanitizers are informed about it.
///   Thread  one.
///   Memory  256 KiB of stack.
///   Fails   an exception must not leave the body.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <ucontext.h>

namespace filament_core::jobs::model {

class Fiber {
public:
    /// Represents the thread's own stack; can be switched to and from, and has no body.
    Fiber();
    /// `body` starts at the first switchTo() and must end in one.
    explicit Fiber(std::function<void()> body);
    ~Fiber();
    Fiber(Fiber const&) = delete;
    Fiber& operator=(Fiber const&) = delete;

    /// Continues there; returns when something switches back to this fiber.
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

} // namespace filament_core::jobs::model
