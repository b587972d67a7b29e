// SPDX-License-Identifier: Apache-2.0
/// ModelAtomics: the policy that runs the job system's lock-free parts under the ModelChecker. Atomic<T> has the
/// interface of std::atomic<T>; Plain<T> is a value without synchronisation, whose races are detected.
///   Thread  the threads of the checker. Before and after them the scenario may use atomics from a single thread.
///   Limits  T is at most 8 bytes and trivially copyable.
#pragma once

#include "tests/jobsystem/ModelChecker.h"

#include <atomic>
#include <cstring>
#include <type_traits>

namespace filament_core::jobs::model {

/// As std::source_location, which clang 14 lacks.
struct Where {
    const char* function;
    int line;
    static constexpr Where current(const char* function = __builtin_FUNCTION(), int line = __builtin_LINE()) {
        return { function, line };
    }
};

template <class T>
class Atomic {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 8);
    using Order = std::memory_order;
    static constexpr Order kSeqCst = std::memory_order_seq_cst;

public:
    Atomic() : Atomic(T{}) {}
    Atomic(T initial) { created(this, bits(initial)); }
    ~Atomic() { destroyed(this); }
    Atomic(Atomic const&) = delete;
    Atomic& operator=(Atomic const&) = delete;

    T load(Order order = kSeqCst, Where where = Where::current()) const { return make(Kind::Load, {}, order, where); }
    void store(T value, Order order = kSeqCst, Where where = Where::current()) {
        make(Kind::Store, value, order, where);
    }
    T exchange(T value, Order order = kSeqCst, Where where = Where::current()) {
        return make(Kind::Exchange, value, order, where);
    }
    T fetch_add(T value, Order order = kSeqCst, Where where = Where::current()) {
        return make(Kind::Add, value, order, where);
    }
    T fetch_sub(T value, Order order = kSeqCst, Where where = Where::current()) {
        return make(Kind::Add, static_cast<T>(T{} - value), order, where);
    }
    T fetch_and(T value, Order order = kSeqCst, Where where = Where::current()) {
        return make(Kind::And, value, order, where);
    }
    T fetch_or(T value, Order order = kSeqCst, Where where = Where::current()) {
        return make(Kind::Or, value, order, where);
    }

    bool compare_exchange_strong(T& expected, T desired, Order success, Order failure, Where where = Where::current()) {
        Operation operation = describe(Kind::CompareExchange, desired, success, where);
        operation.failureOrder = failure;
        operation.expected = bits(expected);
        const Outcome outcome = perform(this, operation);
        if (!outcome.succeeded) expected = fromBits(outcome.value);
        return outcome.succeeded;
    }
    bool compare_exchange_strong(T& expected, T desired, Order order = kSeqCst, Where where = Where::current()) {
        const Order failure = order == std::memory_order_acq_rel   ? std::memory_order_acquire
                              : order == std::memory_order_release ? std::memory_order_relaxed
                                                                   : order;
        return compare_exchange_strong(expected, desired, order, failure, where);
    }
    // A spurious failure makes a loop repeat, which shows nothing new.
    bool compare_exchange_weak(T& expected, T desired, Order success, Order failure, Where where = Where::current()) {
        return compare_exchange_strong(expected, desired, success, failure, where);
    }
    bool compare_exchange_weak(T& expected, T desired, Order order = kSeqCst, Where where = Where::current()) {
        return compare_exchange_strong(expected, desired, order, where);
    }

private:
    static uint64_t bits(T value) {
        uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof value);
        return bits;
    }
    static T fromBits(uint64_t bits) {
        T value;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    static Operation describe(Kind kind, T operand, Order order, Where where) {
        return { .kind = kind,
                 .order = order,
                 .operand = bits(operand),
                 .mask = sizeof(T) == 8 ? ~0ull : (1ull << 8 * sizeof(T) % 64) - 1,
                 .function = where.function,
                 .line = where.line };
    }
    T make(Kind kind, T operand, Order order, Where where) const {
        return fromBits(perform(this, describe(kind, operand, order, where)).value);
    }
};

template <class T>
class Plain {
public:
    Plain() = default;
    explicit Plain(T value) : mValue(value) {}

    T get() const {
        mRaces.read();
        return mValue;
    }
    void set(T value) {
        mRaces.write();
        mValue = value;
    }

    operator T() const { return get(); }
    Plain& operator=(T value) { return set(value), *this; }
    Plain& operator++() { return *this = static_cast<T>(get() + 1); }
    Plain& operator--() { return *this = static_cast<T>(get() - 1); }

private:
    T mValue{};
    mutable RaceDetector mRaces;
};

struct ModelAtomics {
    template <class T>
    using Atomic = model::Atomic<T>;
    template <class T>
    using Plain = model::Plain<T>;

    static void wait(Atomic<uint32_t>& word, uint32_t old, Where where = Where::current()) {
        perform(&word, { .kind = Kind::Wait, .expected = old, .function = where.function });
    }
    static void notifyOne(Atomic<uint32_t>& word, Where where = Where::current()) {
        perform(&word, { .kind = Kind::NotifyOne, .function = where.function });
    }
    static void notifyAll(Atomic<uint32_t>& word, Where where = Where::current()) {
        perform(&word, { .kind = Kind::NotifyAll, .function = where.function });
    }
};

} // namespace filament_core::jobs::model
