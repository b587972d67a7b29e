// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/ModelOperation.h"

#include <cstring>

namespace filament::jobs::model {

bool Operation::isIn(const char* name) const {
    const char* found = std::strstr(function, name);
    return found && found[std::strlen(name)] == '(' && (found == function || found[-1] == ':' || found[-1] == ' ');
}

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
