// SPDX-License-Identifier: Apache-2.0
/// Cancellation: one thread signals that a result is no longer wanted; the jobs that would produce it check here.
///   Use     Cancellation gone;
///           loads.runBackground<"decode">(gone, [&] { for (Row& row : rows) if (!gone.isRequested()) decode(row); });
///           gone.request();   // jobs that have not started never will; running jobs stop where they check
///           loads.wait();     // returns soon
///   Thread  any.
///   Memory  must outlive the jobs that it is passed to: declare it before their group.
///   Fails   never.  Cost: isRequested() is one load.
#pragma once

#include <atomic>

namespace filament_core::jobs {

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

} // namespace filament_core::jobs
