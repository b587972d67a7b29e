// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslToSpirv.h"

#include "shaders/compiler/EndlessLoops.h"
#include "shaders/compiler/GlslLimits.h"
#include "shaders/compiler/SpirvWords.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace filament::shader {
namespace {

/// glslang keeps process-wide tables; they are created once and kept until the process ends.
struct GlslangProcess {
    GlslangProcess() { glslang::InitializeProcess(); }
    ~GlslangProcess() { glslang::FinalizeProcess(); }
};

struct LogSummary {
    std::string firstError;
    size_t errors = 0;
};

/// glslang's log consists of lines like "ERROR: file:12: 'x' : undeclared identifier", and a count at the end.
LogSummary summarize(std::string_view logText) {
    constexpr std::string_view kPrefix = "ERROR: ";
    LogSummary summary;
    while (!logText.empty()) {
        const size_t end = logText.find('\n');
        std::string_view line = logText.substr(0, end);
        logText.remove_prefix(end == std::string_view::npos ? logText.size() : end + 1);
        if (!line.starts_with(kPrefix)) continue;
        line.remove_prefix(kPrefix.size());
        const bool isCount = line.find("compilation errors.") != std::string_view::npos;
        const bool isEcho = line.find("compilation terminated") != std::string_view::npos;
        if (isCount || isEcho) continue;
        line.remove_suffix(line.size() - 1 - line.find_last_not_of(' ')); // glslang pads the line
        if (summary.errors++ == 0) summary.firstError = line;
    }
    return summary;
}

Error compileError(const char* log, std::string_view name) {
    const LogSummary summary = summarize(log);
    if (summary.errors == 0) return fail(ErrorCode::InvalidArgument, "{}: the shader does not compile: {}", name, log);
    if (summary.errors == 1) return fail(ErrorCode::InvalidArgument, "{}", summary.firstError);
    return fail(ErrorCode::InvalidArgument, "{} (and {} more)", summary.firstError, summary.errors - 1);
}

Error endlessLoopError(EndlessLoop const& loop, std::string_view name) {
    const std::string_view file = loop.file.empty() ? name : std::string_view(loop.file);
    return fail(ErrorCode::InvalidArgument,
                "{}:{}: this loop never ends; give it a condition that becomes false, a break or a return", file,
                loop.line);
}

using PassSetup = void (*)(spvtools::Optimizer&);

Result<std::vector<uint32_t>> runPasses(std::span<const uint32_t> spirv, PassSetup setup) {
    std::string complaint;
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    optimizer.SetMessageConsumer([&](spv_message_level_t, const char*, spv_position_t const&, const char* text) {
        if (complaint.empty()) complaint = text;
    });
    setup(optimizer);
    spvtools::OptimizerOptions options;
    options.set_run_validator(false); // validation is left to the tests: the input comes from glslang
    std::vector<uint32_t> result;
    if (!optimizer.Run(spirv.data(), spirv.size(), &result, options)) {
        return fail(ErrorCode::Internal, "the SPIR-V optimiser refused a module: {}", complaint);
    }
    return result;
}

} // namespace

static EShLanguage languageOf(backend::ShaderStage stage) {
    if (stage == backend::ShaderStage::Compute) return EShLangCompute;
    return stage == backend::ShaderStage::Vertex ? EShLangVertex : EShLangFragment;
}

Result<std::vector<uint32_t>> spirvFromGlsl(std::string_view glsl, backend::ShaderStage stage, std::string_view name) {
    if (const Result<void> within = checkGlslLimits(glsl, name); !within) return within.error();
    static const GlslangProcess process;
    const EShLanguage language = languageOf(stage);
    const std::string nameText(name);
    const char* text = glsl.data();
    const char* textName = nameText.c_str();
    const int length = static_cast<int>(glsl.size());

    glslang::TShader shader(language);
    shader.setStringsWithLengthsAndNames(&text, &length, &textName, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), 450, false, messages)) return compileError(shader.getInfoLog(), name);

    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages)) return compileError(program.getInfoLog(), name);

    std::vector<uint32_t> spirv;
    glslang::SpvOptions options;
    options.disableOptimizer = true; // optimizeSpirv() is a separate step
    glslang::GlslangToSpv(*program.getIntermediate(language), spirv, &options);
    if (!findEndlessLoop(spirv)) return spirv;
    std::vector<uint32_t> withLines;
    options.generateDebugInfo = true;
    glslang::GlslangToSpv(*program.getIntermediate(language), withLines, &options);
    return endlessLoopError(findEndlessLoop(withLines).value_or(EndlessLoop{}), name);
}

namespace {

// The performance passes without those that make code longer: functions are not inlined. The optimiser's own list for
// size is unusable: it removes unread members of uniform blocks, and ESSL 3.10 cannot express the gaps.
void registerSizePasses(spvtools::Optimizer& optimizer) {
    optimizer.RegisterPass(spvtools::CreateWrapOpKillPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateMergeReturnPass())
            .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass())
            .RegisterPass(spvtools::CreatePrivateToLocalPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
            .RegisterPass(spvtools::CreateScalarReplacementPass(0))
            .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
            .RegisterPass(spvtools::CreateLocalMultiStoreElimPass())
            .RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateRedundancyEliminationPass())
            .RegisterPass(spvtools::CreateCombineAccessChainsPass())
            .RegisterPass(spvtools::CreateSimplificationPass())
            .RegisterPass(spvtools::CreateScalarReplacementPass(0))
            .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
            .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
            .RegisterPass(spvtools::CreateLocalMultiStoreElimPass())
            .RegisterPass(spvtools::CreateVectorDCEPass())
            .RegisterPass(spvtools::CreateDeadInsertElimPass())
            .RegisterPass(spvtools::CreateIfConversionPass())
            .RegisterPass(spvtools::CreateCopyPropagateArraysPass())
            .RegisterPass(spvtools::CreateReduceLoadSizePass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass())
            .RegisterPass(spvtools::CreateBlockMergePass())
            .RegisterPass(spvtools::CreateRedundancyEliminationPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateBlockMergePass())
            .RegisterPass(spvtools::CreateSimplificationPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
}

} // namespace

Result<std::vector<uint32_t>> optimizeSpirv(std::span<const uint32_t> spirv, Optimization goal) {
    Result<std::vector<uint32_t>> fast =
            runPasses(spirv, [](spvtools::Optimizer& optimizer) { optimizer.RegisterPerformancePasses(); });
    if (!fast || goal != Optimization::Size) return fast;
    // Inlined code may still become shorter: constants meet and fold.
    Result<std::vector<uint32_t>> small = runPasses(spirv, registerSizePasses);
    return small && small->size() < fast->size() ? small : fast;
}

// A constant without SpecId can no longer be chosen.
Result<std::vector<uint32_t>> optimizeWithFalse(std::span<const uint32_t> spirv, std::span<const uint32_t> constants) {
    std::vector<uint32_t> fixed(spirv.begin(), spirv.begin() + kModuleHeaderWords);
    std::set<uint32_t> chosen; // ids of the chosen constants
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> words) {
        const bool isSpecId = op == spv::OpDecorate && words[2] == spv::DecorationSpecId;
        if (isSpecId && std::ranges::count(constants, words[3]) > 0) {
            chosen.insert(words[1]);
            return;
        }
        fixed.insert(fixed.end(), words.begin(), words.end());
        const bool isBool = op == spv::OpSpecConstantTrue || op == spv::OpSpecConstantFalse;
        if (isBool && chosen.contains(words[2]))
            fixed[fixed.size() - words.size()] = static_cast<uint32_t>(words.size()) << 16 | spv::OpConstantFalse;
    });
    return runPasses(fixed, [](spvtools::Optimizer& optimizer) {
        optimizer.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
        optimizer.RegisterPerformancePasses();
    });
}

// The conversion cannot extract parts of whole arrays, so elements are loaded one by one first.
Result<std::vector<uint32_t>> halfFromRelaxed(std::span<const uint32_t> spirv) {
    Result<std::vector<uint32_t>> half = runPasses(spirv, [](spvtools::Optimizer& optimizer) {
        constexpr double kAlways = 2; // regardless of the share of the elements read
        optimizer.RegisterPass(spvtools::CreateReduceLoadSizePass(kAlways));
        optimizer.RegisterPass(spvtools::CreateConvertRelaxedToHalfPass());
    });
    if (half && !spvtools::SpirvTools(SPV_ENV_VULKAN_1_1).Validate(*half))
        return fail(ErrorCode::Unsupported,
                    "the mediump code of this shader cannot be computed in 16 bits; avoid local arrays");
    return half;
}

Result<std::vector<uint32_t>> stripSpirv(std::span<const uint32_t> spirv) {
    return runPasses(spirv, [](spvtools::Optimizer& optimizer) {
        optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
        optimizer.RegisterPass(spvtools::CreateCompactIdsPass());
    });
}

} // namespace filament::shader
