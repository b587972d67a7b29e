// SPDX-License-Identifier: Apache-2.0
/// SpinWork: work of a known length that compilers cannot shorten and every runtime executes with the same
/// instructions.
///   A step is one addition that depends on the previous one; an empty asm statement keeps the compiler from folding or
///   vectorising them. A range of items is one run of steps, compiled once, in SpinWork.cpp: a loop over items of three
///   steps each would measure how well the branch predictor handles the surrounding code (0.5 to 1.3 ns for the same
///   item).
///   Thread  any.
///   Limits  the length of a step is measured once, at its first use, and changes with the core's clock. The serial
///           column shows the real time per item.
#pragma once

#include <cstdint>

namespace filament_core::bench {

/// `steps` additions from `value` on.
uint64_t spinSteps(uint64_t value, uint64_t steps);

/// Makes the compiler assume that the value is used.
inline void keep(uint64_t value) { asm volatile("" : : "r"(value)); }

/// How many steps take `nanoseconds`.
double stepsFor(double nanoseconds);

struct SpinWork {
    double itemNs = 1;
    double stepsPerItem = 1;

    static SpinWork ofItems(double nanoseconds) { return { nanoseconds, stepsFor(nanoseconds) }; }

    /// Items [begin, end) in sequence. Ranges that divide a loop make as many steps as the whole loop.
    uint64_t run(uint64_t begin, uint64_t end, uint64_t value) const {
        return spinSteps(value, stepsBefore(end) - stepsBefore(begin));
    }

private:
    uint64_t stepsBefore(uint64_t item) const {
        return static_cast<uint64_t>(static_cast<double>(item) * stepsPerItem);
    }
};

} // namespace filament_core::bench
