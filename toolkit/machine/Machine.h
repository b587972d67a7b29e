// SPDX-License-Identifier: Apache-2.0
/// Machine: describes the machine and the build that figures were measured with.
///   Fails   never: unavailable information is "unknown".
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace filament_core::tools {

/// Processor, cores, system, load: in one line.
std::string describeMachine();
/// Name and value, in the order to print them: processor, system, what may change its speed, load, compiler, commit.
std::vector<std::pair<std::string, std::string>> machineFacts();
/// UTC, such as "2026-11-28".
std::string today();
/// What of "avx fma" this processor gives Mesa's CPU drivers, such as "avx no-fma", or "not x86-64". Processors with
/// both draw the same bits (docs/conformance.md).
std::string cpuFeatures();
inline constexpr const char* kPromisedFeatures = "avx fma";
/// Of an x86-64 processor. `override` is GALLIUM_OVERRIDE_CPU_CAPS, null if it is not set: up to "sse4.1" it makes
/// Mesa do without AVX, and so without FMA.
std::string cpuFeatures(bool hasAvx, bool hasFma, const char* override);
/// The commit that was built, with "-dirty" if files differ from it.
std::string builtCommit();

} // namespace filament_core::tools
