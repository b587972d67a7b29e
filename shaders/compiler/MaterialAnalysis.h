// SPDX-License-Identifier: Apache-2.0
/// MaterialAnalysis: which terms a material needs, found by letting the optimiser run its code.
///   Steps   the author's block with a main() that hands every member of MaterialInputs to an output of its own ->
///           SPIR-V, inlined, in SSA form and folded -> what arrives at the outputs: what the member was at first, a
///           constant, or something computed.
///   Sees    through functions, inout, branches and loops. What depends on a specialisation constant is computed: the
///           term comes in, and the driver takes it out again where the constant says so.
///   May say yes too often (the material then computes something that it ignores), never no for code that does it.
///   Thread  any. Memory: one module. Cost: about 15 ms a material.
///   Fails   InvalidArgument, "file:line: reason": the first errors of the author's GLSL are found here.
#pragma once

#include "shaders/compiler/GlslGenerator.h"
#include "shaders/compiler/StageText.h"

namespace filament::shader {

/// Sets needs.terms, and the needs that follow from them. `needs`: what findNeeds() found.
Result<void> findTerms(MaterialDefinition const& definition, IncludeResolver const& includes, MaterialNeeds& needs);

/// The declarations before the author's block, and main() behind it.
void declareProbe(StageText& out, MaterialDefinition const& definition);
void defineProbeMain(StageText& out, MaterialDefinition const& definition);

} // namespace filament::shader
