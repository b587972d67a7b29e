// SPDX-License-Identifier: Apache-2.0
/// Operation: one step of a thread under the model checker. Mutation: replaces a step by a weaker one.
///   Thread  any.
///   Limits  a function is recognised by its name alone; its overloads and lambdas count as the same function.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>

namespace filament_core::jobs::model {

enum class Kind : uint8_t {
    Resume, ///< continues after a start or a sleep; touches nothing
    Load,
    Store,
    Exchange,
    Add,
    And,
    Or,
    CompareExchange,
    Assume, ///< pretends that a compare_exchange succeeded, and changes nothing
    Wait,
    NotifyOne,
    NotifyAll,
    Pause,
    Yield
};

struct Operation {
    Kind kind = Kind::Resume;
    std::memory_order order = std::memory_order_seq_cst;
    std::memory_order failureOrder = std::memory_order_seq_cst; ///< of CompareExchange
    int location = -1;
    uint64_t operand = 0;
    uint64_t expected = 0; ///< of CompareExchange and Wait
    uint64_t mask = ~0ull; ///< of the object's width
    const char* function = "";
    int line = 0;

    /// The operation is written in a function of this name.
    bool isIn(const char* name) const;
    /// The effect of a store or modification.
    uint64_t result(uint64_t before) const;
};

/// Whether two steps of different threads lead to the same state in either order, from the current state on (Katz and
/// Peled 1992, "Defining conditional independence using collapses"). `settled`: a seq_cst load of b's object has one
/// choice.
bool areIndependent(Operation const& a, Operation const& b, bool settled);

const char* nameOf(Kind kind);
const char* nameOf(std::memory_order order);

struct Mutation {
    std::function<void(Operation&)> apply;

    /// Operations of this kind, written in this function, get another order.
    static Mutation weaken(const char* function, Kind kind, std::memory_order order);
    /// ... or become another kind.
    static Mutation to(Kind replacement, const char* function, Kind kind);
    /// An exchange() whose result is not used becomes a store().
    static Mutation toReleaseStore(const char* function);

    void operator()(Operation& operation) const { apply(operation); }
};

} // namespace filament_core::jobs::model
