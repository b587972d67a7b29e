// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/CompileProgram.h"

#include "base/Assert.h"
#include "shaders/compiler/BiasTextures.h"
#include "shaders/compiler/CanonicalOrder.h"
#include "shaders/compiler/ClampIndices.h"
#include "shaders/compiler/DefineValues.h"
#include "shaders/compiler/ExactLowering.h"
#include "shaders/compiler/ForbidReordering.h"
#include "shaders/compiler/FullPrecision.h"
#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/compiler/KeepCalls.h"
#include "shaders/compiler/OpaqueOutputs.h"
#include "shaders/compiler/ReflectLayout.h"
#include "shaders/compiler/SpirvToEssl.h"

#include <utility>

namespace filament_core::shader {
namespace {

bool isHalf(backend::ShaderStage stage, ProgramCompileOptions const& options) {
    return stage == backend::ShaderStage::Fragment && options.halfFragment;
}

/// Conversion to half precision needs code without calls and local variables, so it always optimises.
Optimization goalOf(backend::ShaderStage stage, ProgramCompileOptions const& options) {
    return isHalf(stage, options) && options.optimization == Optimization::None ? Optimization::Performance
                                                                                : options.optimization;
}

/// GLSL -> optimised and lowered SPIR-V, still with names.
Result<std::vector<uint32_t>> lowerStage(std::string_view glsl, backend::ShaderStage stage, std::string_view name,
                                         ProgramCompileOptions const& options) {
    Result<std::vector<uint32_t>> spirv = spirvFromGlsl(glsl, stage, name);
    // Before inlining: the functions of texture_bias.glsl are found by their names.
    if (spirv && stage == backend::ShaderStage::Fragment) spirv = biasTextures(*spirv);
    if (spirv && !isHalf(stage, options)) spirv = keepCalls(*spirv);
    if (spirv && options.exact && !isHalf(stage, options)) spirv = fullPrecision(*spirv);
    // Before the optimiser, for which a variable without a value may have another one at each use.
    if (spirv && options.exact) spirv = clampIndices(initializeVariables(*spirv));
    const Optimization goal = goalOf(stage, options);
    if (spirv && goal != Optimization::None) spirv = optimizeSpirv(*spirv, goal);
    if (spirv) spirv = canonicalOrder(*spirv);
    if (spirv && options.exact) // last, so that no pass rearranges the result
        spirv = forbidReordering(hideConstantOutputs(lowerExactly(*spirv)));
    return spirv;
}

Result<void> writeStage(std::vector<uint32_t> const& lowered, bool half, ProgramCompileOptions const& options,
                        backend::ProgramLayout const& layout, std::vector<uint32_t>& spirv, std::string& essl) {
    if (options.spirv) {
        Result<std::vector<uint32_t>> device = half ? halfFromRelaxed(lowered) : lowered;
        if (!device) return device.error();
        Result<std::vector<uint32_t>> stripped = stripSpirv(*device);
        if (!stripped) return stripped.error();
        spirv = std::move(*stripped);
    }
    if (options.essl) {
        Result<std::string> text = esslFromSpirv(lowered, layout);
        if (!text) return text.error();
        essl = std::move(*text);
    }
    return {};
}

} // namespace

Result<StageShader> compileStage(std::string_view glsl, backend::ShaderStage stage,
                                 ProgramCompileOptions const& options) {
    FILAMENT_ASSERT(options.layout, "compiling a single stage needs ProgramCompileOptions::layout");
    const bool isVertex = stage == backend::ShaderStage::Vertex;
    const std::string_view name = isVertex ? options.vertexName : options.fragmentName;
    Result<std::vector<uint32_t>> lowered = lowerStage(glsl, stage, name, options);
    if (!lowered) return lowered.error();
    Result<StageResources> used = reflectStage(*lowered, stage, options.dynamicUniformBuffers);
    if (!used) return used.error();
    const Result<void> contained = checkContains(*options.layout, used->layout);
    if (!contained) return fail(contained.error().code, "{}: {}", name, contained.error().message);
    StageShader shader{ .vertexInputs = used->vertexInputs };
    Result<void> written = writeStage(*lowered, !isVertex && options.halfFragment, options, *options.layout,
                                      shader.spirv, shader.essl);
    if (!written) return written.error();
    return shader;
}

Result<ComputeShader> compileCompute(std::string_view glsl, ProgramCompileOptions const& options) {
    constexpr auto kStage = backend::ShaderStage::Compute;
    Result<std::vector<uint32_t>> lowered = lowerStage(glsl, kStage, options.computeName, options);
    if (!lowered) return lowered.error();
    Result<StageResources> used = reflectStage(*lowered, kStage, options.dynamicUniformBuffers);
    if (!used) return used.error();
    if (options.layout) {
        const Result<void> contained = checkContains(*options.layout, used->layout);
        if (!contained) return fail(contained.error().code, "{}: {}", options.computeName, contained.error().message);
    }
    ComputeShader shader{ .layout = options.layout.value_or(used->layout) };
    Result<void> written = writeStage(*lowered, false, options, shader.layout, shader.spirv, shader.essl);
    if (!written) return written.error();
    return shader;
}

Result<ProgramShaders> compileProgram(std::string_view vertexGlsl, std::string_view fragmentGlsl,
                                      ProgramCompileOptions const& options) {
    Result<std::vector<uint32_t>> vertex =
            lowerStage(vertexGlsl, backend::ShaderStage::Vertex, options.vertexName, options);
    if (!vertex) return vertex.error();
    Result<std::vector<uint32_t>> fragment =
            lowerStage(fragmentGlsl, backend::ShaderStage::Fragment, options.fragmentName, options);
    if (!fragment) return fragment.error();

    Result<StageResources> used = reflectResources(*vertex, *fragment, options.dynamicUniformBuffers);
    if (!used) return used.error();
    if (options.layout) {
        const Result<void> contained = checkContains(*options.layout, used->layout);
        if (!contained) return fail(contained.error().code, "{}: {}", options.fragmentName, contained.error().message);
    }

    ProgramShaders shaders;
    shaders.layout = options.layout.value_or(used->layout);
    shaders.vertexInputs = used->vertexInputs;
    Result<void> written = writeStage(*vertex, false, options, shaders.layout, shaders.vertexSpirv, shaders.vertexEssl);
    if (written)
        written = writeStage(*fragment, options.halfFragment, options, shaders.layout, shaders.fragmentSpirv,
                             shaders.fragmentEssl);
    if (!written) return written.error();
    return shaders;
}

} // namespace filament_core::shader
