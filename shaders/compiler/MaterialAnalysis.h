// SPDX-License-Identifier: Apache-2.0
/// MaterialAnalysis: finds the terms that a material needs, by letting the optimiser run its code.
///   Steps   the author's block, with a main() that writes every member of MaterialInputs to its own output -> SPIR-V,
///           inlined, in SSA form and folded -> the value of each output: the member's initial value, a constant, or
///           something computed.
///   Sees    through functions, inout, branches and loops. A value that depends on a specialisation constant counts as
///           computed: the term is included, and the driver removes it again if the constant allows.
///   May report too many terms (the material then computes something it ignores), but never misses one.
///   Thread  any. Memory: one module. Cost: about 15 ms per material.
///   Fails   InvalidArgument, "file:line: reason": the first errors of the author's GLSL are found here.
#pragma once

#include "shaders/compiler/GlslGenerator.h"
#include "shaders/compiler/StageText.h"

namespace filament_core::shader {

/// Sets needs.terms, and the needs that follow from them. `needs`: the result of findNeeds().
Result<void> findTerms(MaterialDefinition const& definition, IncludeResolver const& includes, MaterialNeeds& needs);

/// The declarations before the author's block, and main() behind it.
void declareProbe(StageText& out, MaterialDefinition const& definition);
void defineProbeMain(StageText& out, MaterialDefinition const& definition);

} // namespace filament_core::shader
