// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <thread>

namespace filament_core::jobs {

/// Runs on a thread of its own, which ends with whatever affinity mask it was given.
inline void onOwnThread(std::function<void()> const& body) { std::thread(body).join(); }

} // namespace filament_core::jobs
