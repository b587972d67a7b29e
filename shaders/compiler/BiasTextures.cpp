// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/BiasTextures.h"

#include "shaders/compiler/SpirvEditor.h"
#include "shaders/compiler/SpirvWords.h"

#include <string_view>

namespace filament_core::shader {
namespace {

/// Those of texture_bias.glsl; 0: there is none.
struct BiasFunctions {
    SpirvId isBiased = 0, levels = 0, factor = 0;
};

BiasFunctions functionsOf(std::span<const uint32_t> module) {
    BiasFunctions found;
    forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) {
        if (op != spv::OpName) return;
        const std::string_view name(reinterpret_cast<const char*>(words.data() + 2)); // with the types of parameters
        if (name.starts_with("mipBias_isBiased(")) found.isBiased = words[1];
        if (name.starts_with("mipBias_levels(")) found.levels = words[1];
        if (name.starts_with("mipBias_factor(")) found.factor = words[1];
    });
    return found;
}

/// Operands of a look-up: image and coordinates, then a mask and what its bits stand for.
constexpr size_t kMask = 2;

class Bias {
public:
    Bias(std::span<const uint32_t> module, BiasFunctions const& functions) : mEditor(module), mFunctions(functions) {}

    std::vector<uint32_t> run() {
        return mEditor.rewrite([this](SpirvEditor::Instruction const& at) { return replace(at); });
    }

private:
    SpirvId replace(SpirvEditor::Instruction const& at) {
        const bool isImplicit = at.op == spv::OpImageSampleImplicitLod || at.op == spv::OpImageSampleProjImplicitLod;
        const bool isExplicit = at.op == spv::OpImageSampleExplicitLod || at.op == spv::OpImageSampleProjExplicitLod;
        const bool hasGradients =
                isExplicit && at.operands.size() > kMask && (at.operands[kMask] & spv::ImageOperandsGradMask) != 0;
        if (!isImplicit && !hasGradients) return 0;
        std::vector<uint32_t> operands(at.operands.begin(), at.operands.end());
        if (isImplicit)
            addLevels(operands);
        else
            scaleGradients(operands);
        // A selection of two look-ups, not a branch, in which derivatives could be undefined.
        const SpirvId plain = mEditor.emit(at.op, at.type, at.operands);
        const SpirvId biased = mEditor.emit(at.op, at.type, operands);
        return mEditor.emit(spv::OpSelect, at.type, { call(mFunctions.isBiased), biased, plain });
    }

    SpirvId call(SpirvId function) { return mEditor.emit(spv::OpFunctionCall, mEditor.typeOf(function), { function }); }

    /// A bias is the first of what a mask stands for.
    void addLevels(std::vector<uint32_t>& operands) {
        SpirvId levels = call(mFunctions.levels);
        if (operands.size() == kMask) operands.resize(kMask + 1, spv::ImageOperandsMaskNone);
        uint32_t& mask = operands[kMask];
        if ((mask & spv::ImageOperandsBiasMask) != 0) {
            operands[kMask + 1] = mEditor.emit(spv::OpFAdd, mEditor.typeOf(levels), { operands[kMask + 1], levels });
            return;
        }
        mask |= spv::ImageOperandsBiasMask;
        operands.insert(operands.begin() + kMask + 1, levels);
    }

    /// Without a bias and a level, gradients are the first.
    void scaleGradients(std::vector<uint32_t>& operands) {
        const SpirvId factor = call(mFunctions.factor);
        for (const size_t i : { kMask + 1, kMask + 2 })
            operands[i] = mEditor.emit(spv::OpVectorTimesScalar, mEditor.typeOf(operands[i]), { operands[i], factor });
    }

    SpirvEditor mEditor;
    BiasFunctions mFunctions;
};

} // namespace

std::vector<uint32_t> biasTextures(std::span<const uint32_t> spirv) {
    const BiasFunctions functions = functionsOf(spirv);
    const bool isComplete = functions.isBiased != 0 && functions.levels != 0 && functions.factor != 0;
    return isComplete ? Bias(spirv, functions).run() : std::vector<uint32_t>(spirv.begin(), spirv.end());
}

} // namespace filament_core::shader
