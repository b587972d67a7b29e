// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslToSpirv.h"

#include "shaders/compiler/EndlessLoops.h"
#include "shaders/compiler/GlslLimits.h"
#include "shaders/compiler/GlslOutline.h"
#include "shaders/compiler/SpirvWords.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace filament_core::shader {
namespace {

/// glslang keeps process-wide tables; they are created once and kept until the process ends.
struct GlslangProcess {
    GlslangProcess() { glslang::InitializeProcess(); }
    ~GlslangProcess() { glslang::FinalizeProcess(); }
};

/// "file:12", of a line of the log; empty if it has no place.
std::string_view placeIn(std::string_view line) {
    const size_t end = line.find(": ");
    return end == std::string_view::npos ? std::string_view{} : line.substr(0, end);
}

/// glslang's log consists of lines like "ERROR: file:12: 'x' : undeclared identifier", and a count at the end. Of
/// several errors in a line of the source, all but the first mostly follow from it.
std::vector<std::string_view> errorsIn(std::string_view logText) {
    constexpr std::string_view kPrefix = "ERROR: ";
    std::vector<std::string_view> errors;
    std::set<std::string_view> places;
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
        const std::string_view place = placeIn(line);
        if (place.empty() || places.insert(place).second) errors.push_back(line);
    }
    return errors;
}

Error compileError(const char* log, std::string_view name) {
    std::string message;
    for (const std::string_view error : errorsIn(log)) {
        if (!message.empty()) message += '\n';
        message += error;
    }
    if (message.empty()) return fail(ErrorCode::InvalidArgument, "{}: the shader does not compile: {}", name, log);
    return { ErrorCode::InvalidArgument, std::move(message) };
}

/// "file:12" of a function of the text; the file alone if the text has none of this name.
std::string placeOfFunction(std::vector<GlslDeclaration> const& outline, std::string_view function,
                            std::string_view name) {
    GlslDeclaration const* found = nullptr;
    for (GlslDeclaration const& each : outline) {
        if (each.name == function && (!found || each.isDefinition)) found = &each;
    }
    return found ? fmt::format("{}:{}", found->file, found->line) : std::string(name);
}

/// The linker's errors name functions and no lines: "Recursion detected:", then "    f(f1; calling g(f1;" in the next.
Error linkError(std::string_view log, std::string_view glsl, std::string_view name) {
    const std::vector<GlslDeclaration> outline = outlineOf(glsl, name);
    std::string message;
    std::string_view header;
    for (size_t end = 0; !log.empty(); log.remove_prefix(std::min(end + 1, log.size()))) {
        end = std::min(log.find('\n'), log.size());
        const std::string_view line = log.substr(0, end);
        if (line.starts_with("ERROR:")) header = line;
        const size_t begin = line.find_first_not_of(' ');
        if (begin == 0 || begin == std::string_view::npos) continue;
        const std::string_view function = line.substr(begin, line.find('(') - begin);
        const bool isRecursion = header.find("Recursion") != std::string_view::npos;
        if (!message.empty()) message += '\n';
        message +=
                fmt::format("{}: {}() {}", placeOfFunction(outline, function, name), function,
                            isRecursion ? "calls itself, directly or through others; GLSL has no recursion, use a loop"
                                        : "is declared and called but not defined");
    }
    if (message.empty()) return compileError(header.data() ? std::string(header).c_str() : "", name);
    return { ErrorCode::InvalidArgument, std::move(message) };
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

static constexpr auto kRules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

static bool parse(glslang::TShader& shader, std::string_view glsl, EShLanguage language, std::string_view name,
                  EShMessages messages) {
    const std::string nameText(name);
    const char* text = glsl.data();
    const char* textName = nameText.c_str();
    const int length = static_cast<int>(glsl.size());
    shader.setStringsWithLengthsAndNames(&text, &length, &textName, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    return shader.parse(GetDefaultResources(), 450, false, messages);
}

Result<std::vector<uint32_t>> spirvFromGlsl(std::string_view glsl, backend::ShaderStage stage, std::string_view name,
                                            bool withLines) {
    if (const Result<void> within = checkGlslLimits(glsl, name); !within) return within.error();
    static const GlslangProcess process;
    const EShLanguage language = languageOf(stage);
    glslang::TShader shader(language);
    if (!parse(shader, glsl, language, name, kRules)) {
        glslang::TShader again(
                language); // cascading costs nothing here, and lists what is wrong behind the first error
        parse(again, glsl, language, name, static_cast<EShMessages>(kRules | EShMsgCascadingErrors));
        return compileError(again.getInfoLog(), name);
    }

    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(kRules)) return linkError(program.getInfoLog(), glsl, name);

    std::vector<uint32_t> spirv;
    glslang::SpvOptions options;
    options.disableOptimizer = true; // optimizeSpirv() is a separate step
    glslang::GlslangToSpv(*program.getIntermediate(language), spirv, &options);
    // Without lines first: they are needed for a message only, and cost time in every later pass.
    const bool isEndless = findEndlessLoop(spirv).has_value();
    if (!isEndless && !withLines) return spirv;
    std::vector<uint32_t> lined;
    options.generateDebugInfo = true;
    glslang::GlslangToSpv(*program.getIntermediate(language), lined, &options);
    if (!isEndless) return lined;
    return endlessLoopError(findEndlessLoop(lined).value_or(EndlessLoop{}), name);
}

namespace {

// SPIRV-Tools' own list for performance (Optimizer::RegisterPerformancePasses) with fewer repetitions: dead code is
// removed three times instead of nine, and local variables once instead of twice, which saves a third of the time.
// Of 261 stages of the engine's materials, 195 keep every byte and the others differ by a few words; no image
// changes.
void registerPerformancePasses(spvtools::Optimizer& optimizer) {
    optimizer.RegisterPass(spvtools::CreateWrapOpKillPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateMergeReturnPass())
            .RegisterPass(spvtools::CreateInlineExhaustivePass())
            .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass())
            .RegisterPass(spvtools::CreatePrivateToLocalPass())
            .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
            .RegisterPass(spvtools::CreateScalarReplacementPass())
            .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateLocalMultiStoreElimPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass())
            .RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateLoopUnrollPass(true))
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateRedundancyEliminationPass())
            .RegisterPass(spvtools::CreateCombineAccessChainsPass())
            .RegisterPass(spvtools::CreateSimplificationPass())
            .RegisterPass(spvtools::CreateLocalMultiStoreElimPass())
            .RegisterPass(spvtools::CreateVectorDCEPass())
            .RegisterPass(spvtools::CreateDeadInsertElimPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateSimplificationPass())
            .RegisterPass(spvtools::CreateIfConversionPass())
            .RegisterPass(spvtools::CreateCopyPropagateArraysPass())
            .RegisterPass(spvtools::CreateReduceLoadSizePass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass())
            .RegisterPass(spvtools::CreateBlockMergePass())
            .RegisterPass(spvtools::CreateRedundancyEliminationPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateBlockMergePass())
            .RegisterPass(spvtools::CreateSimplificationPass());
}

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
    Result<std::vector<uint32_t>> fast = runPasses(spirv, registerPerformancePasses);
    if (!fast || goal != Optimization::Size) return fast;
    // Constants of inlined code meet and fold; a function that is called once is always better inlined. So several
    // lists compete, and none is the best for all materials.
    Result<std::vector<uint32_t>> best = fast;
    const auto compete = [&](std::span<const uint32_t> from) {
        Result<std::vector<uint32_t>> small = runPasses(from, registerSizePasses);
        if (small && small->size() < best->size()) best = std::move(small);
    };
    compete(spirv);
    compete(*fast);
    return best;
}

namespace {

/// The instruction of a specialisation constant with a value that can no longer be chosen.
std::vector<uint32_t> chosenConstant(std::span<const uint32_t> words, uint32_t bits) {
    std::vector<uint32_t> chosen(words.begin(), words.end());
    const auto op = static_cast<spv::Op>(words[0] & 0xFFFF);
    if (op == spv::OpSpecConstantTrue || op == spv::OpSpecConstantFalse) {
        chosen[0] = static_cast<uint32_t>(words.size()) << 16 | (bits ? spv::OpConstantTrue : spv::OpConstantFalse);
    } else if (op == spv::OpSpecConstant && words.size() == 4) {
        chosen[0] = 4u << 16 | spv::OpConstant;
        chosen[3] = bits;
    }
    return chosen;
}

} // namespace

Result<std::vector<uint32_t>> optimizeWith(std::span<const uint32_t> spirv,
                                           std::span<const backend::ConstantValue> constants) {
    std::vector<uint32_t> fixed(spirv.begin(), spirv.begin() + kModuleHeaderWords);
    std::map<uint32_t, uint32_t> chosen; // value by id
    forEachInstruction(spirv, [&](spv::Op op, std::span<const uint32_t> words) {
        if (op == spv::OpDecorate && words[2] == spv::DecorationSpecId) {
            const auto given = std::ranges::find(constants, words[3], &backend::ConstantValue::id);
            if (given != constants.end()) {
                chosen[words[1]] = given->bits;
                return;
            }
        }
        const auto value = words.size() > 2 ? chosen.find(words[2]) : chosen.end();
        const bool isConstant = op >= spv::OpSpecConstantTrue && op <= spv::OpSpecConstant && value != chosen.end();
        const std::vector<uint32_t> constant =
                isConstant ? chosenConstant(words, value->second) : std::vector<uint32_t>();
        const std::span<const uint32_t> kept = isConstant ? std::span<const uint32_t>(constant) : words;
        fixed.insert(fixed.end(), kept.begin(), kept.end());
    });
    return runPasses(fixed, [](spvtools::Optimizer& optimizer) {
        optimizer.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
        registerPerformancePasses(optimizer);
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

Result<std::string> disassembleSpirv(std::span<const uint32_t> spirv) {
    const spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    std::string text;
    constexpr uint32_t kOptions = SPV_BINARY_TO_TEXT_OPTION_INDENT | SPV_BINARY_TO_TEXT_OPTION_FRIENDLY_NAMES;
    if (tools.Disassemble(spirv.data(), spirv.size(), &text, kOptions)) return text;
    return fail(ErrorCode::Corrupt, "this SPIR-V cannot be read; compile the material again");
}

Result<std::vector<uint32_t>> stripSpirv(std::span<const uint32_t> spirv) {
    return runPasses(spirv, [](spvtools::Optimizer& optimizer) {
        optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
        optimizer.RegisterPass(spvtools::CreateCompactIdsPass());
    });
}

} // namespace filament_core::shader
