// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Cost.h"

#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/compiler/SpirvWords.h"

#include <fmt/core.h>
#include <spirv_cross/GLSL.std.450.h>

#include <utility>

namespace filament_core::shader {
namespace {

constexpr std::string_view kCheapestLit =
        "material { name : cheapest, shadingModel : lit }\n"
        "fragment { void material(inout MaterialInputs material) { prepareMaterial(material); } }\n";

bool isTranscendental(uint32_t function) {
    return (function >= GLSLstd450Sin && function <= GLSLstd450InverseSqrt) || function == GLSLstd450Length ||
           function == GLSLstd450Distance || function == GLSLstd450Normalize;
}

bool isFetch(spv::Op op) { return op >= spv::OpImageSampleImplicitLod && op <= spv::OpImageDrefGather; }

bool isControl(spv::Op op) { return (op >= spv::OpBranch && op <= spv::OpUnreachable) || op == spv::OpFunctionCall; }

/// Conversions, arithmetic, comparisons, bit operations and derivatives are consecutive in SPIR-V's numbering.
bool isCountedArithmetic(spv::Op op) { return op >= spv::OpConvertFToU && op <= spv::OpFwidthCoarse; }

void count(spv::Op op, std::span<const uint32_t> words, InstructionCounts& counts) {
    if (op == spv::OpExtInst) {
        ++(isTranscendental(words[4]) ? counts.transcendental : counts.arithmetic);
    } else if (isFetch(op)) {
        ++counts.fetches;
    } else if (isControl(op)) {
        ++counts.control;
    } else if (op == spv::OpLoad || op == spv::OpStore) {
        ++counts.memory;
    } else if (isCountedArithmetic(op)) {
        ++counts.arithmetic;
    }
}

std::string nameOf(uint16_t key) {
    static constexpr std::pair<uint16_t, const char*> kBits[] = {
        { kVariantSun, "sun" },           { kVariantPunctual, "punctual" }, { kVariantShadowReceiver, "shadows" },
        { kVariantSkinning, "skinning" }, { kVariantHalf, "half" },         { kVariantMerged, "merged" },
        { kVariantDepth, "depth" },       { kVariantMotion, "motion" },     { kVariantDebug, "debug" }
    };
    std::string name;
    for (auto const& [bit, word] : kBits) {
        if ((key & bit) != 0) name += fmt::format("{}{}", name.empty() ? "" : "+", word);
    }
    return name.empty() ? "none" : name;
}

/// What remains of the fragment stage, which variants share, for this one.
InstructionCounts countsOf(Variant const& variant) {
    const Result<std::vector<uint32_t>> alone = optimizeWith(variant.fragment->spirv, variantConstants(variant.key));
    return countInstructions(alone ? *alone : variant.fragment->spirv);
}

std::string row(Variant const& variant, MaterialPackage const& cheapest) {
    const InstructionCounts counts = countsOf(variant);
    std::string line = fmt::format("{:<20}{:>11}{:>15}{:>9}{:>8}{:>9}{:>7}", nameOf(variant.key), counts.arithmetic,
                                   counts.transcendental, counts.control, counts.memory, counts.fetches, counts.sum());
    if (Variant const* beside = cheapest.findVariant(variant.key)) {
        const double ratio = static_cast<double>(counts.sum()) / static_cast<double>(countsOf(*beside).sum());
        line += fmt::format("{:>13.2f}", ratio);
    }
    return line + "\n";
}

} // namespace

InstructionCounts countInstructions(std::span<const uint32_t> module) {
    InstructionCounts counts;
    bool inFunction = false; // before that, operations on specialisation constants are data
    for (size_t at = kModuleHeaderWords; at < module.size(); at += module[at] >> 16) {
        const auto op = static_cast<spv::Op>(module[at] & 0xFFFF);
        inFunction = inFunction || op == spv::OpFunction;
        if (inFunction) count(op, module.subspan(at, module[at] >> 16), counts);
    }
    return counts;
}

Result<std::string> costReport(std::string_view text, std::string_view fileName, CompileOptions options) {
    options.spirv = true;
    options.essl = false;
    options.exact = false; // count what the author wrote, not its exact expansion
    const Result<MaterialPackage> package = compileMaterial(text, fileName, options);
    if (!package) return package.error();
    const Result<std::string> terms = describeTerms(text, fileName, options);
    if (!terms) return terms.error();
    const Result<MaterialPackage> cheapest = compileMaterial(kCheapestLit, "cheapest.mat", options);
    if (!cheapest) return cheapest.error();

    std::string out =
            fmt::format("{}: {}\n\n{:<20}{:>11}{:>15}{:>9}{:>8}{:>9}{:>7}{:>13}\n", fileName, *terms, "fragment stage",
                        "arithmetic", "transcendental", "control", "memory", "fetches", "sum", "cheapest lit");
    for (Variant const& variant : package->variants) out += row(variant, *cheapest);
    return out;
}

} // namespace filament_core::shader
