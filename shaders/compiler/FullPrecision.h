// SPDX-License-Identifier: Apache-2.0
/// fullPrecision: mediump and lowp taken back. One device computes them in 16 bits and the other in 32 (Mesa ignores
/// RelaxedPrecision, not ESSL's mediump), so exact programs have neither, whatever precision the source asks for.
///   In      a module of glslang.  Out: the same without the decoration RelaxedPrecision.
///   Thread  any; pure.  Fails: never.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament::shader {

std::vector<uint32_t> fullPrecision(std::span<const uint32_t> spirv);

} // namespace filament::shader
