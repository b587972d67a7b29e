// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/ObjectHandles.h"

#include "base/ApiCall.h"

#include <fmt/format.h>

#include <atomic>

namespace filament_core::scene {
namespace {

std::string complaintOf(ObjectKind kind, HandleFault fault, std::string_view name) {
    const std::string named = name.empty() ? std::string(kind.name) : fmt::format("{} '{}'", kind.name, name);
    switch (fault) {
    case HandleFault::Null:
        return kind.isOfScene ? fmt::format("the {} is null: none was added or found", kind.name)
                              : fmt::format("the {} is null: none was created, or Engine::takeErrors() says why "
                                            "creating it failed",
                                            kind.name);
    case HandleFault::OfAnother:
        return fmt::format("the {} belongs to another {}", kind.name, kind.isOfScene ? "scene" : "engine");
    case HandleFault::Gone:
        return kind.isOfScene ? fmt::format("the {} was removed from the scene", named)
                              : fmt::format("the {} was destroyed", named);
    }
    return {};
}

} // namespace

uint64_t newOwnerSerial() {
    static std::atomic<uint64_t> next{ 1 };
    return next.fetch_add(1, std::memory_order_relaxed);
}

void refuseHandle(ObjectKind kind, HandleFault fault, std::string_view name) {
    misused(complaintOf(kind, fault, name));
}

} // namespace filament_core::scene
