// SPDX-License-Identifier: Apache-2.0
/// JobFault: ends a process whose job broke a rule that no caller can handle.
///   Thread  any.
///   Fails   does not return: one line on standard error that names the job, then abort().
#pragma once

#include "jobsystem/Job.h"

#include <exception>

namespace filament_core::jobs {

/// Call inside a catch block: reports what was thrown.
[[noreturn]] void reportThrow(const char* jobName);
[[noreturn]] void reportThrow(const char* jobName, std::exception const& thrown);

} // namespace filament_core::jobs
