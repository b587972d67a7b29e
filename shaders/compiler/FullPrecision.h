// SPDX-License-Identifier: Apache-2.0
/// fullPrecision: removes mediump and lowp. One device computes them in 16 bits and the other in 32 (Mesa ignores
/// RelaxedPrecision, but not ESSL's mediump), so exact programs have neither, whatever precision the source requests.
///   In      a module of glslang.  Out: the same without the decoration RelaxedPrecision.
///   Thread  any; pure.  Fails: never.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<uint32_t> fullPrecision(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
