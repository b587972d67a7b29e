// SPDX-License-Identifier: Apache-2.0
/// compileProgram: compiles two GLSL 450 stages to SPIR-V for Vulkan and ESSL 3.10 for OpenGL ES. compileCompute does
/// the same with a compute stage.
///   Steps   glslang (SPIR-V 1.3, Vulkan 1.1 rules) -> SPIRV-Tools performance passes -> exact lowering -> reflection
///           -> SPIR-V, and SPIRV-Cross -> ESSL. Both languages come from the same lowered module.
///   Exact   `exact` writes out the operations that Mesa expands differently for the two languages (ExactLowering.h)
///           and forbids reordering (ForbidReordering.h): both devices do the same arithmetic in the same order. All of
///           it is highp, whatever the source says (FullPrecision.h), except for fragment stages with halfFragment.
///   ESSL    bindings are numbered with backend::flatBinding; without `exact`, mediump in the source stays mediump; a
///           subpass input becomes a framebuffer fetch of the colour attachment of the same index; the value of
///           specialisation constant N is the macro SPIRV_CROSS_CONSTANT_ID_N, defined after the #version line.
///   Thread  any; calls are independent and equal input gives equal bytes.
///   Fails   InvalidArgument with "file:line: reason" for GLSL errors and for a layout that lacks a binding;
///           Unsupported for code that ESSL cannot express. Cost: 5 to 50 ms, half of it in the optimiser.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

struct SetBinding {
    uint8_t set = 0, binding = 0;
    friend bool operator==(SetBinding, SetBinding) = default;
};

enum class Optimization : uint8_t {
    None, ///< as glslang wrote it, for debugging
    Performance,
    Size, ///< SPIRV-Tools' passes for small modules
};

struct ProgramCompileOptions {
    bool exact = true; ///< identical bits on both APIs
    /// Parts of the fragment stage marked mediump are computed in 16 bits on Vulkan too (halfFromRelaxed()), which
    /// needs DeviceFeatures::halfFloatShaders. Otherwise Vulkan computes them in 32 bits: Mesa ignores
    /// RelaxedPrecision.
    bool halfFragment = false;
    Optimization optimization = Optimization::Performance;
    bool spirv = true; ///< requested languages; reflection always happens
    bool essl = true;
    /// Uniform buffers with a dynamic offset; nothing: all of group 0.
    std::optional<std::vector<SetBinding>> dynamicUniformBuffers = std::nullopt;
    /// The layout used for numbering, which must contain every binding that the shaders use; nothing: reflected from
    /// them.
    std::optional<backend::ProgramLayout> layout = std::nullopt;
    std::string_view vertexName = "vertex"; ///< precedes the line in errors, until a #line names another file
    std::string_view fragmentName = "fragment";
    std::string_view computeName = "compute";
};

struct ProgramShaders {
    std::vector<uint32_t> vertexSpirv, fragmentSpirv; ///< entry point "main"
    std::string vertexEssl, fragmentEssl;             ///< #version 310 es
    backend::ProgramLayout layout{};
    uint32_t vertexInputs = 0; ///< bit n: attribute location n is read
};

struct StageShader {
    std::vector<uint32_t> spirv;
    std::string essl;
    uint32_t vertexInputs = 0; ///< of a vertex stage
};

/// One stage alone, with options.layout. Programs with equal stages share the result: the other stage has no influence
/// on it.
Result<StageShader> compileStage(std::string_view glsl, backend::ShaderStage stage,
                                 ProgramCompileOptions const& options);

Result<ProgramShaders> compileProgram(std::string_view vertexGlsl, std::string_view fragmentGlsl,
                                      ProgramCompileOptions const& options = {});

struct ComputeShader {
    std::vector<uint32_t> spirv;
    std::string essl;
    backend::ProgramLayout layout{};
};

/// A compute stage. Its layout is reflected unless options.layout gives it.
Result<ComputeShader> compileCompute(std::string_view glsl, ProgramCompileOptions const& options = {});

} // namespace filament_core::shader
