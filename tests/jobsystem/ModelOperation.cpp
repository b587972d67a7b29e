// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/ModelOperation.h"

namespace filament_core::jobs::model {
namespace {

bool entersKernel(Kind kind) { return kind == Kind::Wait || kind == Kind::NotifyOne || kind == Kind::NotifyAll; }
bool onlyReads(Kind kind) { return kind == Kind::Load || kind == Kind::Wait; }
bool touchesMemory(Kind kind) { return kind != Kind::NotifyOne && kind != Kind::NotifyAll; }

} // namespace

// `function` is the whole of "bool filament_core::jobs::WorkStealingDeque<T, kSlots, Policy>::push(T*) [with T = ...]".
bool Operation::isIn(const char* name) const { return std::string_view(function) == name; }

uint64_t Operation::result(uint64_t before) const {
    switch (kind) {
    case Kind::Add:
        return (before + operand) & mask;
    case Kind::And:
        return before & operand;
    case Kind::Or:
        return before | operand;
    default:
        return operand;
    }
}

bool areIndependent(Operation const& a, Operation const& b, bool settled) {
    if (a.kind == Kind::Yield || b.kind == Kind::Yield) return true;
    if (a.kind == Kind::Pause) return onlyReads(b.kind) || b.kind == Kind::Pause;
    if (b.kind == Kind::Pause) return onlyReads(a.kind);
    if (a.location != b.location || a.location < 0) return true;
    if (entersKernel(a.kind) && entersKernel(b.kind)) return false;
    if (!touchesMemory(a.kind) || !touchesMemory(b.kind)) return true;
    if (!onlyReads(a.kind) || !onlyReads(b.kind)) return false;
    // Of two seq_cst loads, the second reads nothing older than the first.
    return settled || a.order != std::memory_order_seq_cst || b.order != std::memory_order_seq_cst;
}

const char* nameOf(Kind kind) {
    constexpr const char* kNames[] = { "resume",  "load",   "store", "exchange",  "add",       "and",   "or",
                                       "compare", "assume", "wait",  "notifyOne", "notifyAll", "pause", "yield" };
    return kNames[static_cast<int>(kind)];
}

const char* nameOf(std::memory_order order) {
    constexpr const char* kNames[] = { "relaxed", "consume", "acquire", "release", "acq_rel", "seq_cst" };
    return kNames[static_cast<int>(order)];
}

Mutation Mutation::weaken(const char* function, Kind kind, std::memory_order order) {
    return { [=](Operation& operation) {
        if (operation.kind != kind || !operation.isIn(function)) return;
        operation.order = operation.failureOrder = order;
        if (order == std::memory_order_release) operation.failureOrder = std::memory_order_relaxed;
        if (order == std::memory_order_acq_rel) operation.failureOrder = std::memory_order_acquire;
    } };
}

Mutation Mutation::to(Kind replacement, const char* function, Kind kind) {
    return { [=](Operation& operation) {
        if (operation.kind == kind && operation.isIn(function)) operation.kind = replacement;
    } };
}

Mutation Mutation::toReleaseStore(const char* function) {
    return { [=](Operation& operation) {
        if (operation.kind != Kind::Exchange || !operation.isIn(function)) return;
        operation.kind = Kind::Store;
        operation.order = std::memory_order_release;
    } };
}

} // namespace filament_core::jobs::model
