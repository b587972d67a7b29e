// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/ExactLowering.h"

#include "shaders/compiler/ExactFormulas.h"
#include "shaders/compiler/SpirvEditor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <numbers>
#include <unordered_set>

namespace filament_core::shader {
namespace {

constexpr float kRadiansPerDegree = std::numbers::pi_v<float> / 180.0f;
constexpr float kDegreesPerRadian = 180.0f / std::numbers::pi_v<float>;

/// Mesa folds log2(exp2(x)), sqrt(exp2(x)), log2(pow(x, y)) and the like, but only functions that come from SPIR-V:
/// those of ESSL are `precise`. The exact sum f(x) + 0.0 between two functions forbids it on both, and changes only -0.
class FunctionChains {
public:
    /// The instruction as it is, but with sums in front of such a function; 0: it is none.
    SpirvId separate(SpirvEditor& editor, SpirvEditor::Instruction const& at) {
        if (isMoved(at)) mResults.insert(at.result);
        if (at.op != spv::OpExtInst || !editor.isExtended(at) || !isFolded(at.operands[1])) return 0;
        mResults.insert(at.result);
        std::vector<uint32_t> operands(at.operands.begin(), at.operands.end());
        bool isChain = false;
        for (uint32_t& operand : std::span(operands).subspan(2)) {
            if (!mResults.contains(operand)) continue;
            const Value value{ &editor, operand };
            operand = (value + value.like(0)).id;
            isChain = true;
        }
        return isChain ? editor.emit(at.op, at.type, operands) : 0;
    }

private:
    static bool isFolded(uint32_t function) { return (function >= GLSLstd450Pow && function <= GLSLstd450InverseSqrt); }

    bool isMoved(SpirvEditor::Instruction const& at) const {
        const bool moves =
                at.op == spv::OpCompositeExtract || at.op == spv::OpCompositeConstruct || at.op == spv::OpVectorShuffle;
        return moves && std::ranges::any_of(at.operands, [&](SpirvId id) { return mResults.contains(id); });
    }

    std::unordered_set<SpirvId> mResults; ///< of functions, and their components
};

/// Values that follow from constants alone, so that a driver may know them: also functions of constants, which
/// SPIRV-Tools leaves and drivers compute.
class KnownValues {
public:
    explicit KnownValues(SpirvEditor const& editor) : mEditor(editor) {}

    /// In the order of the module.
    void note(SpirvEditor::Instruction const& at) {
        const std::span<const uint32_t> inputs = inputsOf(at);
        if (!inputs.empty() && std::ranges::all_of(inputs, [&](SpirvId input) { return contains(input); }))
            mKnown.insert(at.result);
    }

    bool contains(SpirvId value) const { return mKnown.contains(value) || mEditor.isConstantExpression(value); }

    /// A driver may find out that it is a NaN.
    bool mayBeNan(SpirvId value) const {
        const std::span<const float> numbers = mEditor.constantOf(value);
        return numbers.empty() ? contains(value) : std::ranges::any_of(numbers, [](float x) { return x != x; });
    }

    void add(SpirvId value) { mKnown.insert(value); }

private:
    /// Without literals; empty: not a function of its operands alone.
    static std::span<const uint32_t> inputsOf(SpirvEditor::Instruction const& at) {
        switch (at.op) {
        case spv::OpExtInst:
            return at.operands.subspan(2);
        case spv::OpCompositeExtract:
            return at.operands.first(1);
        case spv::OpCompositeInsert:
        case spv::OpVectorShuffle:
            return at.operands.first(2);
        case spv::OpCompositeConstruct:
            return at.operands;
        default: // the rest of the groups "conversion", "arithmetic", "bit" and "relational and logical"
            return at.op >= spv::OpConvertFToU && at.op <= spv::OpBitCount ? at.operands : std::span<const uint32_t>{};
        }
    }

    SpirvEditor const& mEditor;
    std::unordered_set<SpirvId> mKnown;
};

class Lowering {
public:
    Lowering(SpirvEditor& editor, KnownValues& known, SpirvEditor::Instruction const& at)
            : mEditor(editor), mKnown(known), mAt(at) {}

    SpirvId run() const {
        if (mAt.op == spv::OpSMod) return lowerSignedModulo();
        if (mAt.op == spv::OpSDiv || mAt.op == spv::OpUDiv || mAt.op == spv::OpUMod) return lowerIntegerDivision();
        if (mAt.op == spv::OpConvertFToS) return convertClamped(-2147483648.0f, 2147483520.0f);
        if (mAt.op == spv::OpConvertFToU) return convertClamped(0.0f, 4294967040.0f);
        if (mAt.op == spv::OpBitcast) return castNumber();
        if (mAt.op == spv::OpBitCount) return inHighPrecision(mAt.operands[0]);
        if (mAt.op == spv::OpExtInst && mEditor.isExtended(mAt) && findsBit(mAt.operands[1]))
            return inHighPrecision(mAt.operands[2]);
        if (mAt.op == spv::OpExtInst && mEditor.isExtended(mAt) && mAt.operands[1] == GLSLstd450PackHalf2x16)
            return packHalves();
        if (mAt.op == spv::OpExtInst && mEditor.isExtended(mAt) && clampsInteger(mAt.operands[1]))
            return lowerIntegerClamp().id;
        if (!mEditor.isFloat32(mAt.type)) return 0;
        if (mAt.op == spv::OpExtInst && mEditor.isExtended(mAt) && unpacksTwo(mAt.operands[1])) return unpackTwo();
        if (mAt.op == spv::OpExtInst) return mEditor.isExtended(mAt) ? lowerExtended().id : 0;
        return lowerCore().id;
    }

private:
    Value operand(uint32_t index) const { return { &mEditor, mAt.operands[index] }; }
    Value argument(uint32_t index) const { return operand(2 + index); } // after the import and the function

    Value lowerCore() const {
        switch (mAt.op) {
        case spv::OpDot:
            return dot(operand(0), operand(1));
        case spv::OpMatrixTimesVector:
            return exactMatrixTimesVector(operand(0), operand(1));
        case spv::OpVectorTimesMatrix:
            return exactVectorTimesMatrix(operand(0), operand(1), mAt.type);
        case spv::OpMatrixTimesMatrix:
            return exactMatrixTimesMatrix(operand(0), operand(1), mAt.type);
        case spv::OpOuterProduct:
            return exactOuterProduct(operand(0), operand(1), mAt.type);
        case spv::OpFMod:
            return lowerModulo();
        case spv::OpFDiv:
            return lowerDivision();
        case spv::OpImageSampleImplicitLod:
        case spv::OpImageSampleExplicitLod:
        case spv::OpImageGather:
            return mEditor.isPlane(mAt.operands[0]) ? lookUp() : Value{};
        default:
            return {};
        }
    }

    /// Of a texture that repeats, Mesa's CPU drivers find the texels by one of two formulas: c * size - 0.5, wrapped as
    /// an integer, where the size is a power of two that they know when they compile; fract(c) * size - 0.5 otherwise.
    /// lavapipe 23.2 to 25.0 always takes the second (lp_build_sample_wrap_linear, lp_texture_handle.c). From 0 on both
    /// are exact, and so the same. (c - 0.5) + 0.5 takes the bits of a negative coordinate that one could round away.
    Value lookUp() const {
        const Value c = operand(1); // the layer of an array is never negative
        std::vector<uint32_t> operands(mAt.operands.begin(), mAt.operands.end());
        operands[1] = selectLess(c, c.like(0), 0.5f + (c - 0.5f), c).id;
        return { &mEditor, mEditor.emit(mAt.op, mAt.type, operands) };
    }

    /// By 0: 0 of signed numbers, all bits of unsigned ones, which some drivers give and GLSL leaves undefined.
    SpirvId divideIntegers(spv::Op op, SpirvId x, SpirvId y) const {
        if (mEditor.isNonZeroInteger(y)) return mEditor.emit(op, mAt.type, { x, y });
        const SpirvId type = mEditor.typeOf(y), one = mEditor.splatBits(1, type);
        const SpirvId isZero =
                mEditor.emit(spv::OpIEqual, mEditor.boolTypeLike(type), { y, mEditor.splatBits(0, type) });
        const SpirvId divisor = mEditor.emit(spv::OpSelect, type, { isZero, one, y });
        const SpirvId quotient = mEditor.emit(op, mAt.type, { x, divisor });
        const SpirvId otherwise = mEditor.splatBits(op == spv::OpSDiv ? 0 : ~0u, mAt.type);
        return mEditor.emit(spv::OpSelect, mAt.type, { isZero, otherwise, quotient });
    }

    SpirvId lowerIntegerDivision() const {
        return mEditor.isNonZeroInteger(mAt.operands[1]) ? 0 : divideIntegers(mAt.op, mAt.operands[0], mAt.operands[1]);
    }

    /// GLSL leaves % of negative numbers undefined; here the quotient is truncated towards zero, as in C++.
    SpirvId lowerSignedModulo() const {
        const SpirvId x = mAt.operands[0], y = mAt.operands[1];
        const SpirvId quotient = divideIntegers(spv::OpSDiv, x, y);
        return mEditor.emit(spv::OpISub, mAt.type, { x, mEditor.emit(spv::OpIMul, mAt.type, { quotient, y }) });
    }

    /// GLSL leaves integers out of range undefined; `high` is the largest float that fits. NaN becomes `low`.
    SpirvId convertClamped(float low, float high) const {
        const Value x = operand(0);
        if (!mEditor.isFloat32(x.type())) return 0;
        const Value raised = call(GLSLstd450FMax, { x, x.like(low) });
        const Value clamped = call(GLSLstd450FMin, { raised, x.like(high) });
        return mEditor.emit(mAt.op, mAt.type, { clamped.id });
    }

    /// Sign and payload of a NaN depend on the order of operands, which each driver chooses; only bit casts see them.
    SpirvId oneNan(Value x) const { return unlessNan(x, x.like(std::bit_cast<float>(0x7FC00000u))); }

    SpirvId unlessNan(Value x, Value otherwise) const {
        const SpirvId isNan = mEditor.emit(spv::OpIsNan, mEditor.boolTypeLike(x.type()), { x.id });
        return mEditor.emit(spv::OpSelect, x.type(), { isNan, otherwise.id, x.id });
    }

    SpirvId castNumber() const {
        const Value x = operand(0);
        if (!mEditor.isFloat32(x.type()) || mEditor.isFloat32(mAt.type)) return 0;
        return mEditor.emit(spv::OpBitcast, mAt.type, { oneNan(x) });
    }

    static bool findsBit(uint32_t function) {
        return function == GLSLstd450FindILsb || function == GLSLstd450FindSMsb || function == GLSLstd450FindUMsb;
    }

    /// ESSL 3.10, 8.8 declares these results lowp, and Mesa then compares them with constants in 16 bits. An operand of
    /// high precision, which is always 0, makes the expression highp.
    SpirvId inHighPrecision(SpirvId bits) const {
        const SpirvId result = mEditor.emit(mAt.op, mAt.type, mAt.operands);
        SpirvId zero = mEditor.emit(spv::OpBitwiseXor, mEditor.typeOf(bits), { bits, bits });
        if (mEditor.typeOf(bits) != mAt.type) zero = mEditor.emit(spv::OpBitcast, mAt.type, { zero });
        return mEditor.emit(spv::OpBitwiseOr, mAt.type, { result, zero });
    }

    SpirvId whole(uint32_t value) const { return whole(value, mAt.type); }
    SpirvId whole(uint32_t value, SpirvId type) const {
        return mEditor.constant(std::array{ std::bit_cast<float>(value) }, type);
    }

    static bool unpacksTwo(uint32_t function) {
        return function == GLSLstd450UnpackHalf2x16 || function == GLSLstd450UnpackSnorm2x16 ||
               function == GLSLstd450UnpackUnorm2x16;
    }

    /// Where the word is a constant, Mesa 22.3 computes the second component as 0 (nir_opcodes.py, unpack_2x16: << 16).
    /// So both are first components.
    SpirvId unpackTwo() const {
        const SpirvId word = mAt.operands[2], type = mEditor.typeOf(word);
        const SpirvId upper = mEditor.emit(spv::OpShiftRightLogical, type, { word, whole(16, type) });
        const auto first = [&](SpirvId of) {
            return Value{ &mEditor, mEditor.emit(mAt.op, mAt.type, { mAt.operands[0], mAt.operands[1], of }) }[0];
        };
        const Value x = first(word), y = first(upper);
        return compose(mAt.type, std::array{ x, y }).id;
    }

    /// Drivers pack a NaN as 7E00 or 7FFF, so numbers are packed, and NaNs added to them.
    SpirvId packHalves() const {
        const Value both = argument(0);
        const Value clean = { &mEditor, unlessNan(both, both.like(0)) };
        SpirvId packed = mEditor.emit(spv::OpExtInst, mAt.type, { mAt.operands[0], mAt.operands[1], clean.id });
        for (uint32_t i = 0; i < 2; ++i) {
            const Value half = both[i];
            const SpirvId isNan = mEditor.emit(spv::OpIsNan, mEditor.boolTypeLike(half.type()), { half.id });
            const SpirvId nan = mEditor.emit(spv::OpSelect, mAt.type, { isNan, whole(0x7E00u << (16 * i)), whole(0) });
            packed = mEditor.emit(spv::OpBitwiseOr, mAt.type, { packed, nan });
        }
        return packed;
    }

    bool mayBeNan(uint32_t index) const { return mKnown.mayBeNan(mAt.operands[2 + index]); }

    /// FMin or FMax; the other argument where one is a NaN. Mesa's GLSL compiler computes MIN2(x, NaN) = NaN from
    /// constants (ir_expression_operation.py), and opt_minmax.cpp drops x from min(x, NaN). Of values that no driver
    /// knows, all drivers choose the number.
    Value limit(uint32_t function, Value x, Value y) const {
        Value result = call(static_cast<GLSLstd450>(function), { x, y });
        result = ifNan(y, x, ifNan(x, y, result));
        if (mKnown.contains(x.id) && mKnown.contains(y.id)) mKnown.add(result.id);
        return result;
    }

    /// `result`, but `otherwise` where `x` is a NaN and a driver may know it.
    Value ifNan(Value x, Value otherwise, Value result) const {
        if (!mKnown.mayBeNan(x.id)) return result;
        const SpirvId isNan = mEditor.emit(spv::OpIsNan, mEditor.boolTypeLike(x.type()), { x.id });
        return { &mEditor, mEditor.emit(spv::OpSelect, x.type(), { isNan, otherwise.id, result.id }) };
    }

    /// min(max(x, low), high), unless it is all the same to drivers: some take high first, which differs if it is less.
    Value lowerClamp() const {
        const std::span<const float> low = mEditor.constantOf(argument(1).id),
                                     high = mEditor.constantOf(argument(2).id);
        const bool isInOrder = !low.empty() && std::ranges::equal(low, high, std::less_equal{});
        if (isInOrder && !mayBeNan(0)) return {};
        return limit(GLSLstd450FMin, limit(GLSLstd450FMax, argument(0), argument(1)), argument(2));
    }

    static bool clampsInteger(uint32_t function) {
        return function == GLSLstd450SClamp || function == GLSLstd450UClamp;
    }
    Value lowerIntegerClamp() const {
        const bool isSigned = mAt.operands[1] == GLSLstd450SClamp;
        const Value raised = call(isSigned ? GLSLstd450SMax : GLSLstd450UMax, { argument(0), argument(1) });
        return call(isSigned ? GLSLstd450SMin : GLSLstd450UMin, { raised, argument(2) });
    }

    /// mod(x, 0) of a 0 that a driver knows is x: Mesa makes 0 * floor(x / 0) to 0 when it writes code (lp_build_mul),
    /// but to NaN when it computes constants.
    Value lowerModulo() const {
        const Value x = operand(0), y = operand(1), result = exactMod(x, y);
        const std::span<const float> divisor = mEditor.constantOf(y.id);
        const bool mayBeZero = divisor.empty() ? mKnown.contains(y.id) : std::ranges::count(divisor, 0.0f) > 0;
        if (!mayBeZero) return result;
        const SpirvId isZero = mEditor.emit(spv::OpFOrdEqual, mEditor.boolTypeLike(x.type()), { y.id, y.like(0).id });
        return { &mEditor, mEditor.emit(spv::OpSelect, x.type(), { isZero, x.id, result.id }) };
    }

    Value lowerDivision() const {
        const Value divisor = operand(1);
        return mEditor.isConstantExpression(divisor.id) ? exactDivide(operand(0), divisor) : Value{};
    }

    Value lowerExtended() const {
        switch (mAt.operands[1]) {
        case GLSLstd450Length:
            return exactLength(argument(0));
        case GLSLstd450Distance:
            return exactLength(argument(0) - argument(1));
        case GLSLstd450Normalize:
            return exactNormalize(argument(0));
        case GLSLstd450Reflect:
            return exactReflect(argument(0), argument(1));
        case GLSLstd450Refract:
            return exactRefract(argument(0), argument(1), argument(2));
        case GLSLstd450Cross:
            return exactCross(argument(0), argument(1));
        case GLSLstd450FaceForward:
            return exactFaceForward(argument(0), argument(1), argument(2));
        case GLSLstd450FMix:
            return exactMix(argument(0), argument(1), argument(2));
        case GLSLstd450Step: // NaN: 1, as GLSL 4.50, 8.3 says; drivers compare the other way round
            return selectLess(argument(1), argument(0), argument(1).like(0), argument(1).like(1));
        case GLSLstd450SmoothStep:
            return exactSmoothStep(argument(0), argument(1), argument(2));
        case GLSLstd450Pow:
            return exactPow(argument(0), argument(1));
        case GLSLstd450FMin:
        case GLSLstd450FMax:
            return mayBeNan(0) || mayBeNan(1) ? limit(mAt.operands[1], argument(0), argument(1)) : Value{};
        case GLSLstd450FClamp:
            return lowerClamp();
        case GLSLstd450Fma:
            return argument(0) * argument(1) + argument(2);
        case GLSLstd450Determinant:
            return exactDeterminant(argument(0));
        case GLSLstd450MatrixInverse:
            return exactInverse(argument(0));
        default:
            return lowerOneVariable();
        }
    }

    Value lowerOneVariable() const {
        switch (mAt.operands[1]) {
        case GLSLstd450Radians:
            return kRadiansPerDegree * argument(0);
        case GLSLstd450Degrees:
            return kDegreesPerRadian * argument(0);
        case GLSLstd450Tan:
            return exactTan(argument(0));
        case GLSLstd450Asin: // the formulas of arcs contain minima and maxima
            return ifNan(argument(0), argument(0), exactAsin(argument(0)));
        case GLSLstd450Acos:
            return ifNan(argument(0), argument(0), exactAcos(argument(0)));
        case GLSLstd450Atan:
            return ifNan(argument(0), argument(0), exactAtan(argument(0)));
        case GLSLstd450Atan2:
            return ifNan(argument(0), argument(0),
                         ifNan(argument(1), argument(1), exactAtan2(argument(0), argument(1))));
        case GLSLstd450Sinh:
            return exactSinh(argument(0));
        case GLSLstd450Cosh:
            return exactCosh(argument(0));
        case GLSLstd450Tanh:
            return exactTanh(argument(0));
        case GLSLstd450Asinh:
            return exactAsinh(argument(0));
        case GLSLstd450Acosh:
            return exactAcosh(argument(0));
        case GLSLstd450Atanh:
            return exactAtanh(argument(0));
        default:
            return {};
        }
    }

    SpirvEditor& mEditor;
    KnownValues& mKnown;
    SpirvEditor::Instruction const& mAt;
};

} // namespace

std::vector<uint32_t> lowerExactly(std::span<const uint32_t> spirv) {
    SpirvEditor editor(spirv);
    FunctionChains chains;
    KnownValues known(editor);
    return editor.rewrite([&](SpirvEditor::Instruction const& at) {
        known.note(at);
        const SpirvId lowered = Lowering(editor, known, at).run();
        return lowered != 0 ? lowered : chains.separate(editor, at);
    });
}

} // namespace filament_core::shader
