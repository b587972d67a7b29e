// SPDX-License-Identifier: Apache-2.0
/// FILAMENT_ASSERT(condition, "the rule that the caller broke"): a bug of the caller, caught in every build.
///   Fails   prints file, line, condition, rule and the current task of the thread on standard error, then aborts.
///   Cost    one predicted branch; in hot loops use FILAMENT_DEBUG_ASSERT, which NDEBUG removes.
#pragma once

namespace filament_core {

/// The current task of the calling thread, for the message: the job system stores the name of the job here. The text
/// lives as long as the process. Null: none.
inline constinit thread_local const char* tAssertContext = nullptr;

[[noreturn]] void assertionFailed(const char* file, int line, const char* condition, const char* rule);

} // namespace filament_core

#define FILAMENT_ASSERT(condition, rule)                                                                               \
    (__builtin_expect(static_cast<bool>(condition), 1)                                                                 \
             ? static_cast<void>(0)                                                                                    \
             : ::filament_core::assertionFailed(__FILE__, __LINE__, #condition, rule))

#ifdef NDEBUG
#define FILAMENT_DEBUG_ASSERT(condition, rule) static_cast<void>(0)
#else
#define FILAMENT_DEBUG_ASSERT(condition, rule) FILAMENT_ASSERT(condition, rule)
#endif
