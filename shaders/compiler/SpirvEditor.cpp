// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/SpirvEditor.h"

#include "base/Assert.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace filament_core::shader {
namespace {

void append(std::vector<uint32_t>& words, spv::Op op, std::initializer_list<uint32_t> fixed,
            std::span<const uint32_t> rest = {}) {
    words.push_back(static_cast<uint32_t>(1 + fixed.size() + rest.size()) << 16 | op);
    words.insert(words.end(), fixed);
    words.insert(words.end(), rest.begin(), rest.end());
}

bool isConstant(spv::Op op) { return op >= spv::OpConstantTrue && op <= spv::OpSpecConstantOp; }

/// Pure instructions whose operands are all ids.
bool isArithmetic(spv::Op op) {
    return (op >= spv::OpConvertFToU && op <= spv::OpBitcast) || (op >= spv::OpSNegate && op <= spv::OpDot) ||
           (op >= spv::OpLogicalEqual && op <= spv::OpFUnordGreaterThanEqual) || op == spv::OpCompositeConstruct;
}

} // namespace

SpirvEditor::SpirvEditor(std::span<const uint32_t> module) : mModule(module) {
    FILAMENT_ASSERT(module.size() > kModuleHeaderWords && module[0] == spv::MagicNumber,
                    "SpirvEditor takes valid SPIR-V");
    mTypeOf.resize(module[kModuleBoundWord]);
    scan();
}

size_t SpirvEditor::wordCountAt(size_t word) const {
    const size_t count = mModule[word] >> 16;
    FILAMENT_ASSERT(count > 0 && count <= mModule.size() - word, "SpirvEditor takes valid SPIR-V");
    return count;
}

SpirvEditor::Instruction SpirvEditor::instructionAt(size_t word) const {
    std::span<const uint32_t> rest = mModule.subspan(word + 1, wordCountAt(word) - 1);
    Instruction at;
    at.op = static_cast<spv::Op>(mModule[word] & 0xFFFF);
    bool hasResult = false, hasType = false;
    spv::HasResultAndType(at.op, &hasResult, &hasType);
    if (hasType) at.type = rest[0], rest = rest.subspan(1);
    if (hasResult) at.result = rest[0], rest = rest.subspan(1);
    at.operands = rest;
    return at;
}

void SpirvEditor::scan() {
    for (size_t word = kModuleHeaderWords; word < mModule.size(); word += wordCountAt(word)) {
        const Instruction at = instructionAt(word);
        if (at.result != 0 && at.type != 0) mTypeOf[at.result] = at.type;
        if (mGlobals == 0 && isTypeDeclaration(at.op)) mGlobals = word;
        if (mFunctions == 0 && at.op == spv::OpFunction) mFunctions = word;
        if (mFunctions == 0) scanGlobal(at);
        scanConstant(at);
    }
    FILAMENT_ASSERT(mGlobals != 0 && mFunctions != 0, "SpirvEditor takes modules with an entry point");
}

void SpirvEditor::scanGlobal(Instruction const& at) {
    switch (at.op) {
    case spv::OpExtInstImport:
        if (std::strcmp(reinterpret_cast<const char*>(at.operands.data()), "GLSL.std.450") == 0) mExtended = at.result;
        break;
    case spv::OpDecorate:
        if (at.operands[1] == spv::DecorationRelaxedPrecision || at.operands[1] == spv::DecorationNoContraction) {
            mPrecision[at.operands[0]].push_back(static_cast<spv::Decoration>(at.operands[1]));
        }
        break;
    case spv::OpTypeBool:
        mTypes[at.result] = { at.op, 0, 0 };
        break;
    case spv::OpTypeFloat:
        mTypes[at.result] = { at.op, 0, at.operands[0] };
        break;
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
        mTypes[at.result] = { at.op, at.operands[0], at.operands[1] };
        break;
    case spv::OpTypeImage:
        if (at.operands[1] == spv::Dim2D) mPlanes.insert(at.result);
        break;
    case spv::OpTypeSampledImage:
        if (mPlanes.contains(at.operands[0])) mPlanes.insert(at.result);
        break;
    default:
        break;
    }
}

void SpirvEditor::scanConstant(Instruction const& at) {
    if (isConstant(at.op) || followsFromConstants(at)) mConstantExpressions.insert(at.result);
    if (!isFloat32(at.type)) {
        const bool isWhole = at.op == spv::OpConstant && at.operands[0] != 0;
        const bool isVectorOfThem = at.op == spv::OpConstantComposite && isVector(at.type) &&
                                    std::ranges::all_of(at.operands, [&](Id part) { return isNonZeroInteger(part); });
        if (isWhole || isVectorOfThem) mNonZeroIntegers.insert(at.result);
        return;
    }
    if (at.op == spv::OpConstant) mConstants[at.result] = { std::bit_cast<float>(at.operands[0]) };
    if (at.op == spv::OpConstantNull) mConstants[at.result].assign(elementCount(at.type), 0.0f);
    if (at.op != spv::OpConstantComposite && at.op != spv::OpCompositeConstruct) return;
    std::vector<float> components;
    for (const Id part : at.operands) {
        const std::span<const float> value = constantOf(part);
        if (value.empty()) return;
        components.insert(components.end(), value.begin(), value.end());
    }
    if (isVector(at.type)) mConstants[at.result] = std::move(components);
}

bool SpirvEditor::followsFromConstants(Instruction const& at) const {
    std::vector<Id> inputs;
    if (isArithmetic(at.op) || at.op == spv::OpSelect) inputs.assign(at.operands.begin(), at.operands.end());
    if (at.op == spv::OpCompositeExtract) inputs = { at.operands[0] };
    if (at.op == spv::OpPhi) { // value, block, value, block ...
        for (size_t i = 0; i < at.operands.size(); i += 2) inputs.push_back(at.operands[i]);
    }
    return !inputs.empty() && std::ranges::all_of(inputs, [&](Id input) { return isConstantExpression(input); });
}

// ---------------------------------------------------------------------------------------------- questions

SpirvEditor::Id SpirvEditor::typeOf(Id value) const { return mTypeOf[value]; }

bool SpirvEditor::isFloat32(Id type) const {
    const auto found = mTypes.find(type);
    if (found == mTypes.end()) return false;
    Type const& at = found->second;
    if (at.op == spv::OpTypeFloat) return at.count == 32;
    return at.element != 0 && isFloat32(at.element);
}

bool SpirvEditor::isVector(Id type) const {
    const auto found = mTypes.find(type);
    return found != mTypes.end() && found->second.op == spv::OpTypeVector;
}

bool SpirvEditor::isPlane(Id image) const { return mPlanes.contains(typeOf(image)); }

uint32_t SpirvEditor::elementCount(Id type) const {
    Type const& at = mTypes.at(type);
    return at.element != 0 ? at.count : 1;
}

SpirvEditor::Id SpirvEditor::elementType(Id type) const {
    const Id element = mTypes.at(type).element;
    return element != 0 ? element : type;
}

std::span<const float> SpirvEditor::constantOf(Id value) const {
    const auto found = mConstants.find(value);
    return found == mConstants.end() ? std::span<const float>{} : std::span<const float>(found->second);
}

bool SpirvEditor::isConstantExpression(Id value) const { return mConstantExpressions.contains(value); }

bool SpirvEditor::isNonZeroInteger(Id value) const { return mNonZeroIntegers.contains(value); }

SpirvEditor::Id SpirvEditor::extendedInstructions() const { return mExtended; }

bool SpirvEditor::isExtended(Instruction const& at) const {
    return at.op == spv::OpExtInst && at.operands[0] == mExtended;
}

// ---------------------------------------------------------------------------------------------- writing

SpirvEditor::Id SpirvEditor::newId(Id type) {
    mTypeOf.push_back(type);
    return static_cast<Id>(mTypeOf.size() - 1);
}

SpirvEditor::Id SpirvEditor::emit(spv::Op op, Id type, std::span<const uint32_t> operands) {
    const Id id = newId(type);
    mLastEmitted = mBody.size();
    append(mBody, op, { type, id }, operands);
    mEmitted.push_back(id);
    return id;
}

SpirvEditor::Id SpirvEditor::emit(spv::Op op, Id type, std::initializer_list<uint32_t> operands) {
    return emit(op, type, std::span<const uint32_t>(operands.begin(), operands.size()));
}

SpirvEditor::Id SpirvEditor::makeConstant(std::vector<uint32_t> const& words, Id type) {
    Id& made = mMadeConstants[{ type, words }];
    if (made == 0) {
        made = newId(type);
        append(mNewGlobals, isVector(type) ? spv::OpConstantComposite : spv::OpConstant, { type, made }, words);
    }
    return made;
}

SpirvEditor::Id SpirvEditor::constant(std::span<const float> components, Id type) {
    std::vector<uint32_t> words;
    const bool vector = isVector(type);
    for (const float component : components) {
        words.push_back(vector ? constant(std::span(&component, 1), elementType(type))
                               : std::bit_cast<uint32_t>(component));
    }
    const Id made = makeConstant(words, type);
    mConstants[made].assign(components.begin(), components.end());
    return made;
}

SpirvEditor::Id SpirvEditor::splat(float value, Id type) {
    return constant(std::vector<float>(elementCount(type), value), type);
}

SpirvEditor::Id SpirvEditor::splatBits(uint32_t value, Id type) {
    if (!isVector(type)) return makeConstant({ value }, type);
    return makeConstant(std::vector<uint32_t>(elementCount(type), splatBits(value, elementType(type))), type);
}

SpirvEditor::Id SpirvEditor::findOrMakeType(spv::Op op, Id element, uint32_t count) {
    for (auto const& [id, type] : mTypes) { // types are unique, so the order of the map does not matter
        if (type.op == op && type.element == element && type.count == count) return id;
    }
    const Id id = newId(0);
    if (op == spv::OpTypeVector)
        append(mNewGlobals, op, { id, element, count });
    else
        append(mNewGlobals, op, { id });
    mTypes[id] = { op, element, count };
    return id;
}

SpirvEditor::Id SpirvEditor::boolTypeLike(Id type) {
    const Id scalar = findOrMakeType(spv::OpTypeBool, 0, 0);
    return isVector(type) ? findOrMakeType(spv::OpTypeVector, scalar, elementCount(type)) : scalar;
}

/// The value must keep the id by which the rest of the module refers to it.
void SpirvEditor::renameLast(Id last, Id result, Id type) {
    if (mEmitted.empty() || mEmitted.back() != last) {
        append(mBody, spv::OpCopyObject, { type, result, last });
        return;
    }
    mBody[mLastEmitted + 2] = result;
    mEmitted.pop_back();
}

void SpirvEditor::inheritDecorations(Id from) {
    const auto found = mPrecision.find(from);
    if (found == mPrecision.end()) return;
    for (const Id id : mEmitted) {
        for (const spv::Decoration decoration : found->second) {
            append(mNewAnnotations, spv::OpDecorate, { id, static_cast<uint32_t>(decoration) });
        }
    }
}

void SpirvEditor::copyOrReplace(size_t word, Replace const& replace) {
    const Instruction at = instructionAt(word);
    mEmitted.clear();
    const Id value = at.result != 0 ? replace(at) : 0;
    if (value == 0) {
        FILAMENT_ASSERT(mEmitted.empty(), "a replacement that emits must name its value");
        const auto words = mModule.subspan(word, wordCountAt(word));
        mBody.insert(mBody.end(), words.begin(), words.end());
        return;
    }
    renameLast(value, at.result, at.type);
    inheritDecorations(at.result);
}

std::vector<uint32_t> SpirvEditor::rewrite(Replace const& replace) {
    for (size_t word = mFunctions; word < mModule.size(); word += wordCountAt(word)) copyOrReplace(word, replace);

    std::vector<uint32_t> out(mModule.begin(), mModule.begin() + static_cast<ptrdiff_t>(mGlobals));
    const auto globals = mModule.subspan(mGlobals, mFunctions - mGlobals);
    // Annotations end where types begin; new types and constants stand behind the module's own, which they refer to.
    out.insert(out.end(), mNewAnnotations.begin(), mNewAnnotations.end());
    out.insert(out.end(), globals.begin(), globals.end());
    out.insert(out.end(), mNewGlobals.begin(), mNewGlobals.end());
    out.insert(out.end(), mBody.begin(), mBody.end());
    out[kModuleBoundWord] = static_cast<uint32_t>(mTypeOf.size());
    return out;
}

} // namespace filament_core::shader
