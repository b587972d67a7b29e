// SPDX-License-Identifier: Apache-2.0
/// keepCalls: marks functions that the optimiser must not inline. They are called from several places and are large, so
/// that copies would be a part of every package; drivers inline them where a program needs them.
///   In      SPIR-V of glslang, with names.   Out: the same with DontInline, for functions of kKeptCalls.
///   Thread  any; a pure function. Fails: never. Cost: one walk over the names and functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::shader {

/// With the parenthesis that follows in a name of glslang.
inline constexpr std::array<std::string_view, 4> kKeptCalls{ "probedRadiance(", "probedIrradiance(", "fieldColor(",
                                                             "objectIrradiance(" };

std::vector<uint32_t> keepCalls(std::span<const uint32_t> module);

} // namespace filament_core::shader
