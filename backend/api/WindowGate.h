// SPDX-License-Identifier: Apache-2.0
/// WindowGate: when a window takes the next image, so that the app thread waits for it and not the driver thread, which
/// serves other windows meanwhile.
///   Numbers command streams name a gate by a number (SurfaceDesc::gate): a trace that is read from a file names none.
///   Thread  any: the app thread reads, threads of the driver write.
///   Memory  some 100 bytes, until the last holder drops it.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace filament_core::backend {

struct WindowGate {
    /// Presenting never waits.
    static constexpr uint64_t kOpen = ~uint64_t{ 0 };
    /// How many presents will find an image of the window. The nth, counted from 0, is submitted when this is above n.
    /// A driver that does not know leaves it open.
    std::atomic<uint64_t> allowed{ kOpen };
};

struct NumberedGate {
    uint64_t number = 0;
    std::shared_ptr<WindowGate> gate;
};
/// std::bad_alloc.
NumberedGate makeWindowGate();
/// Null: there is none, or nobody holds it any more.
std::shared_ptr<WindowGate> findWindowGate(uint64_t number);

} // namespace filament_core::backend
