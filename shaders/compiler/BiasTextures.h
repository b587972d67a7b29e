// SPDX-License-Identifier: Apache-2.0
/// biasTextures: lets a view bias the mip levels that its pixels would read.
///   What    every look-up that takes its level from derivatives, or from gradients that the author gives, is made a
///           second time with the functions of shaders/material/surface/texture_bias.glsl, and one of the two is taken
///           by a specialisation constant. A driver that knows the constant removes the other: without a bias the code
///           is that without this pass, to the bit, as no driver promises of a bias of 0.
///   Why so  OpenGL ES has no bias in samplers, and an author's look-ups may be in functions, macros and loops.
///   In      valid SPIR-V of glslang, before the optimiser. A module without those functions stays as it is.
///   Limits  look-ups of explicit levels and of compared depths stay as they are.
///   Thread  any. Fails: never for a valid module.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<uint32_t> biasTextures(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
