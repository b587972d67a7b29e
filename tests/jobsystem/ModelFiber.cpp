// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/ModelFiber.h"

#include <utility>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FILAMENT_ADDRESS_SANITIZER
#endif
#if __has_feature(thread_sanitizer)
#define FILAMENT_THREAD_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(FILAMENT_ADDRESS_SANITIZER)
#include <sanitizer/common_interface_defs.h>
#define FILAMENT_IF_ASAN(call) call
#else
#define FILAMENT_IF_ASAN(call)
#endif
#if defined(__SANITIZE_THREAD__) || defined(FILAMENT_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#define FILAMENT_IF_TSAN(call) call
#else
#define FILAMENT_IF_TSAN(call)
#endif

namespace filament_core::jobs::model {
namespace {

constexpr size_t kStackBytes = 256 << 10;

// makecontext() passes only integers, so the arguments of a switch are here.
Fiber* gLeaving = nullptr;
Fiber* gArriving = nullptr;

} // namespace

Fiber::Fiber() { FILAMENT_IF_TSAN(mSanitizerFiber = __tsan_get_current_fiber()); }

Fiber::Fiber(std::function<void()> body)
        : mBody(std::move(body)), mStack(std::make_unique_for_overwrite<std::byte[]>(kStackBytes)),
          mStackBottom(mStack.get()), mStackSize(kStackBytes) {
    FILAMENT_IF_TSAN(mSanitizerFiber = __tsan_create_fiber(0));
    getcontext(&mContext);
    mContext.uc_stack = { .ss_sp = mStack.get(), .ss_flags = 0, .ss_size = kStackBytes };
    mContext.uc_link = nullptr;
    makecontext(&mContext, &Fiber::enter, 0);
}

Fiber::~Fiber() { FILAMENT_IF_TSAN(if (mStack) __tsan_destroy_fiber(mSanitizerFiber)); }

void Fiber::enter() {
    gArriving->arrive();
    gArriving->mBody();
}

void Fiber::arrive() {
    const void* bottom = nullptr;
    size_t size = 0;
    FILAMENT_IF_ASAN(__sanitizer_finish_switch_fiber(mFakeStack, &bottom, &size));
    if (!gLeaving->mStack && bottom) { // the thread's own stack, known only to the sanitizer
        gLeaving->mStackBottom = bottom;
        gLeaving->mStackSize = size;
    }
}

void Fiber::switchTo(Fiber& next) {
    gLeaving = this;
    gArriving = &next;
    FILAMENT_IF_ASAN(__sanitizer_start_switch_fiber(&mFakeStack, next.mStackBottom, next.mStackSize));
    FILAMENT_IF_TSAN(__tsan_switch_to_fiber(next.mSanitizerFiber, 0));
    swapcontext(&mContext, &next.mContext);
    arrive();
}

} // namespace filament_core::jobs::model
