// SPDX-License-Identifier: Apache-2.0
/// hideConstantOutputs: keeps linkers from treating the outputs of a vertex stage as constants or uniforms.
///   Why     Mesa's OpenGL ES linker replaces an input of the fragment stage by the constant that the vertex stage
///           writes, component by component, and from 24.1 on by what it computes from uniforms (nir_opt_varyings).
///           Vulkan compiles the stages apart and interpolates, which rounds: 1.0 became 0.99999994 in 6 % of the
///           pixels, and a comparison with 1.0 then differed.
///   What    a value stored to an output, of which a component may be known to a compiler (a constant, a specialisation
///           constant, a uniform, what follows from them, a local variable), is selected by gl_VertexIndex == 2^31 - 1,
///           which no draw reaches. The value itself is unchanged; both APIs interpolate it.
///   In      valid SPIR-V of any stage; other stages than vertex are returned as they are. Run it after the optimiser.
///   Limits  outputs of 32-bit floats and vectors of them; integers are flat and never rounded.
///   Thread  any. Fails: never for a valid module. Cost: one comparison and one selection per vertex and such output;
///           outputs that depend on an attribute or an index in all components cost nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<uint32_t> hideConstantOutputs(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
