// SPDX-License-Identifier: Apache-2.0
#include "backend/api/WindowGate.h"

#include <mutex>
#include <unordered_map>

namespace filament_core::backend {
namespace {

struct Gates {
    std::mutex mutex;
    std::unordered_map<uint64_t, std::weak_ptr<WindowGate>> all;
    uint64_t last = 0;
};

Gates& gates() {
    static Gates ofProcess;
    return ofProcess;
}

} // namespace

NumberedGate makeWindowGate() {
    NumberedGate made{ 0, std::make_shared<WindowGate>() };
    Gates& known = gates();
    const std::lock_guard lock(known.mutex);
    std::erase_if(known.all, [](auto const& each) { return each.second.expired(); });
    made.number = ++known.last;
    known.all.emplace(made.number, made.gate);
    return made;
}

std::shared_ptr<WindowGate> findWindowGate(uint64_t number) {
    Gates& known = gates();
    const std::lock_guard lock(known.mutex);
    const auto found = known.all.find(number);
    return found == known.all.end() ? nullptr : found->second.lock();
}

} // namespace filament_core::backend
