// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/ModelOperation.h"

namespace filament::jobs::model {

// `function` is all of "bool filament::jobs::WorkStealingDeque<T, kSlots, Policy>::push(T*) [with T = ...]".
std::string_view Operation::functionName() const {
    std::string_view name = function;
    size_t arguments = name.find('(');
    while (arguments != name.npos && name.substr(arguments).starts_with("(anonymous"))
        arguments = name.find('(', arguments + 1);
    name = name.substr(0, arguments);
    const size_t start = name.find_last_of(": ");
    return start == name.npos ? name : name.substr(start + 1);
}

bool Operation::isIn(const char* name) const { return functionName() == name; }

const char* nameOf(Kind kind) {
    constexpr const char* kNames[] = { "resume",  "load",   "store", "exchange",  "add",       "and",  "or",
                                       "compare", "assume", "wait",  "notifyOne", "notifyAll", "pause" };
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

} // namespace filament::jobs::model
