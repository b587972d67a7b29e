// SPDX-License-Identifier: Apache-2.0
/// Operation: one step of a thread under the model checker; and Mutation: what if the step were weaker?
///   Thread  any.
///   Limits  a function is recognised by its name alone; overloads and lambdas inside of it are one.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>

namespace filament::jobs::model {

enum class Kind : uint8_t {
    Resume, ///< goes on after a start or a sleep; touches nothing
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
    Pause
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
    /// The name without its class, result and arguments.
    std::string_view functionName() const;
    /// What a store or modification leaves behind.
    uint64_t result(uint64_t before) const;
};

/// Two steps of different threads that lead to the same state in either order, from the state at hand on (Katz and
/// Peled 1992, "Defining conditional independence using collapses"). `settled`: a seq_cst load of b's object has one
/// choice.
bool areIndependent(Operation const& a, Operation const& b, bool settled);

const char* nameOf(Kind kind);
const char* nameOf(std::memory_order order);

struct Mutation {
    std::function<void(Operation&)> apply;

    /// Operations of this kind, written in this function, have another order.
    static Mutation weaken(const char* function, Kind kind, std::memory_order order);
    /// ... or are of another kind.
    static Mutation to(Kind replacement, const char* function, Kind kind);
    /// An exchange() whose result nobody looks at becomes a store().
    static Mutation toReleaseStore(const char* function);

    void operator()(Operation& operation) const { apply(operation); }
};

} // namespace filament::jobs::model
