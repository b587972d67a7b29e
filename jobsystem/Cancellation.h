// SPDX-License-Identifier: Apache-2.0
/// Cancellation: one thread says that the result is no longer wanted, the jobs that would make it look here.
///   Use     Cancellation gone;
///           loads.runBackground<"decode">(gone, [&] { for (Row& row : rows) if (!gone.isRequested()) decode(row); });
///           gone.request();   // jobs that have not started never will, those that run stop where they look
///           loads.wait();     // quick now
///   Thread  any.
///   Memory  outlives the jobs that it was given to: declare it before their group.
///   Fails   never.  Cost: isRequested() is one load.
#pragma once

#include <atomic>

namespace filament::jobs {

class Cancellation {
public:
    Cancellation() = default;
    Cancellation(Cancellation const&) = delete;
    Cancellation& operator=(Cancellation const&) = delete;

    void request() { mRequested.store(true, std::memory_order_release); }
    bool isRequested() const { return mRequested.load(std::memory_order_acquire); }

private:
    std::atomic<bool> mRequested{ false };
};

} // namespace filament::jobs
