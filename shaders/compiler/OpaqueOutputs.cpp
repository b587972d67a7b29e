// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/OpaqueOutputs.h"

#include "shaders/compiler/SpirvWords.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace filament_core::shader {
namespace {

/// Stands for the output of the vertex that does not exist. It only has to differ from what authors write.
constexpr float kNever = -7.03906250e-12f;

struct Defined {
    spv::Op op = spv::OpNop;
    SpirvId type = 0;
    SpirvWords operands{}; ///< after type and result
};

Defined definedBy(spv::Op op, SpirvWords words, SpirvId& result) {
    bool hasResult = false, hasType = false;
    spv::HasResultAndType(op, &hasResult, &hasType);
    SpirvWords rest = words.subspan(1);
    Defined definition{ .op = op };
    if (hasType) definition.type = rest[0], rest = rest.subspan(1);
    result = hasResult ? rest[0] : 0;
    definition.operands = hasResult ? rest.subspan(1) : rest;
    return definition;
}

/// What each id stands for.
class Definitions {
public:
    explicit Definitions(SpirvWords module) {
        forEachInstruction(module, [&](spv::Op op, SpirvWords words) {
            SpirvId result = 0;
            const Defined definition = definedBy(op, words, result);
            if (result != 0) mDefinitions[result] = definition;
        });
    }

    Defined const& of(SpirvId id) const {
        static constexpr Defined kUnknown;
        const auto found = mDefinitions.find(id);
        return found == mDefinitions.end() ? kUnknown : found->second;
    }

    uint32_t componentsOf(SpirvId type) const {
        Defined const& definition = of(type);
        return definition.op == spv::OpTypeVector ? definition.operands[1] : 1;
    }

    bool isFloatOrVector(SpirvId type) const {
        Defined const& definition = of(type);
        if (definition.op == spv::OpTypeVector) return isFloatOrVector(definition.operands[0]);
        return definition.op == spv::OpTypeFloat && definition.operands[0] == 32;
    }

    auto begin() const { return mDefinitions.begin(); }
    auto end() const { return mDefinitions.end(); }

private:
    std::map<SpirvId, Defined> mDefinitions;
};

/// Which components of a value a compiler could know.
class Knowledge {
public:
    explicit Knowledge(Definitions const& definitions) : mDefinitions(definitions) {}

    bool mayKnow(SpirvId value, uint32_t component) {
        // A value that depends on itself through a loop is known if all that enters the loop is.
        const auto [known, isNew] = mKnown.try_emplace({ value, component }, true); // true: the start of a loop
        if (!isNew) return known->second;
        const bool result = decide(mDefinitions.of(value), component);
        return mKnown[{ value, component }] = result;
    }

    bool mayKnowAny(SpirvId value) {
        const uint32_t count = mDefinitions.componentsOf(mDefinitions.of(value).type);
        for (uint32_t i = 0; i < count; ++i) {
            if (mayKnow(value, i)) return true;
        }
        return false;
    }

private:
    bool decide(Defined const& at, uint32_t component) {
        if (at.op >= spv::OpConstantTrue && at.op <= spv::OpSpecConstantOp) return true;
        switch (at.op) {
        case spv::OpCompositeConstruct:
            return mayKnowPart(at, component);
        case spv::OpCompositeExtract: // arrays and structures: as a whole
            return mayKnow(at.operands[0], isVector(at.operands[0]) ? at.operands[1] : component);
        case spv::OpCompositeInsert:
            if (!isVector(at.operands[1])) return true;
            return component == at.operands[2] ? mayKnow(at.operands[0], 0) : mayKnow(at.operands[1], component);
        case spv::OpVectorShuffle:
            return mayKnowShuffled(at, component);
        case spv::OpVectorTimesScalar:
            return mayKnow(at.operands[0], component) && mayKnow(at.operands[1], 0);
        case spv::OpLoad:
            return mayKnowMemory(at.operands[0]);
        case spv::OpPhi:
            return mayKnowPhi(at, component);
        case spv::OpUndef:
        case spv::OpFunctionCall:
        case spv::OpFunctionParameter:
            return true;
        default:
            return mayKnowOperation(at, component);
        }
    }

    bool isVector(SpirvId value) const { return mDefinitions.of(mDefinitions.of(value).type).op == spv::OpTypeVector; }

    bool mayKnowPart(Defined const& at, uint32_t component) {
        if (mDefinitions.of(at.type).op != spv::OpTypeVector)
            return std::ranges::any_of(at.operands, [&](SpirvId part) { return mayKnowAny(part); });
        for (const SpirvId part : at.operands) {
            const uint32_t count = mDefinitions.componentsOf(mDefinitions.of(part).type);
            if (component < count) return mayKnow(part, component);
            component -= count;
        }
        return true;
    }

    bool mayKnowShuffled(Defined const& at, uint32_t component) {
        const uint32_t from = at.operands[2 + component];
        const uint32_t first = mDefinitions.componentsOf(mDefinitions.of(at.operands[0]).type);
        if (from == 0xFFFFFFFF) return true;
        return from < first ? mayKnow(at.operands[0], from) : mayKnow(at.operands[1], from - first);
    }

    bool mayKnowPhi(Defined const& at, uint32_t component) {
        for (size_t i = 0; i < at.operands.size(); i += 2) { // value, block, value, block ...
            if (!mayKnow(at.operands[i], component)) return false;
        }
        return true;
    }

    /// Local and private variables may hold constants. What is read of uniforms by indices that are known is the same
    /// for all vertices.
    bool mayKnowMemory(SpirvId pointer) {
        Defined const* at = &mDefinitions.of(pointer);
        bool knowsIndices = true;
        while (at->op == spv::OpAccessChain || at->op == spv::OpInBoundsAccessChain) {
            const auto indices = at->operands.subspan(1);
            knowsIndices = knowsIndices && std::ranges::all_of(indices, [&](SpirvId id) { return mayKnow(id, 0); });
            at = &mDefinitions.of(at->operands[0]);
        }
        if (at->op != spv::OpVariable) return true;
        const auto storage = static_cast<spv::StorageClass>(at->operands[0]);
        if (storage == spv::StorageClassFunction || storage == spv::StorageClassPrivate) return true;
        return storage == spv::StorageClassUniform && knowsIndices;
    }

    /// Component by component where the operand has as many; otherwise all components count.
    bool mayKnowOperation(Defined const& at, uint32_t component) {
        SpirvWords inputs = at.operands;
        if (at.op == spv::OpExtInst) inputs = inputs.subspan(2);
        const uint32_t count = mDefinitions.componentsOf(at.type);
        return std::ranges::all_of(inputs, [&](SpirvId input) {
            Defined const& definition = mDefinitions.of(input);
            if (definition.op == spv::OpNop || definition.type == 0) return true; // a literal
            if (mDefinitions.componentsOf(definition.type) == count) return mayKnow(input, component);
            return mayKnowAny(input);
        });
    }

    Definitions const& mDefinitions;
    std::map<std::pair<SpirvId, uint32_t>, bool> mKnown;
};

class Rewriter {
public:
    explicit Rewriter(SpirvWords module) : mModule(module), mDefinitions(module), mKnowledge(mDefinitions) { survey(); }

    std::vector<uint32_t> run() {
        std::vector<uint32_t> body;
        forEachInstruction(mModule, [&](spv::Op op, SpirvWords words) {
            if (&words[0] < &mModule[mFunctions]) return;
            if (op == spv::OpStore && hides(words))
                storeHidden(words, body);
            else
                body.insert(body.end(), words.begin(), words.end());
        });
        return assemble(body);
    }

    bool isVertex() const { return mIsVertex; }

private:
    void survey() {
        forEachInstruction(mModule, [&](spv::Op op, SpirvWords words) {
            const auto at = static_cast<size_t>(words.data() - mModule.data());
            if (op == spv::OpEntryPoint) {
                mIsVertex = words[1] == spv::ExecutionModelVertex;
                mEntryPoint = at;
            }
            if (op == spv::OpDecorate && words[2] == spv::DecorationLocation) mLocated.insert(words[1]);
            const bool isIndex =
                    op == spv::OpDecorate && words[2] == spv::DecorationBuiltIn && words[3] == spv::BuiltInVertexIndex;
            if (isIndex) mVertexIndex = words[1];
            if (mTypes == 0 && op >= spv::OpTypeVoid && op <= spv::OpTypeForwardPointer) mTypes = at;
            if (mFunctions == 0 && op == spv::OpFunction) mFunctions = at;
        });
        mBound = mModule[kModuleBoundWord];
    }

    SpirvId variableOf(SpirvId pointer) const {
        Defined const& at = mDefinitions.of(pointer);
        return at.op == spv::OpAccessChain || at.op == spv::OpInBoundsAccessChain ? variableOf(at.operands[0])
                                                                                  : pointer;
    }

    bool hides(SpirvWords store) {
        const SpirvId variable = variableOf(store[1]);
        Defined const& at = mDefinitions.of(variable);
        const bool isOutput = at.op == spv::OpVariable && at.operands[0] == spv::StorageClassOutput;
        if (!isOutput || !mLocated.contains(variable)) return false;
        return mDefinitions.isFloatOrVector(mDefinitions.of(store[2]).type) && mKnowledge.mayKnowAny(store[2]);
    }

    void storeHidden(SpirvWords store, std::vector<uint32_t>& body) {
        const SpirvId type = mDefinitions.of(store[2]).type;
        const uint32_t count = mDefinitions.componentsOf(type);
        const SpirvId integer = global(spv::OpTypeInt, 0, { 32, 1 }), boolean = global(spv::OpTypeBool, 0, {});
        const SpirvId last = global(spv::OpConstant, integer, { std::numeric_limits<int32_t>::max() });
        SpirvId never = global(spv::OpConstant, scalarOf(type), { std::bit_cast<uint32_t>(kNever) });
        if (count > 1) never = global(spv::OpConstantComposite, type, std::vector<uint32_t>(count, never));

        const SpirvId index = emit(body, spv::OpLoad, integer, { vertexIndex(integer) });
        SpirvId condition = emit(body, spv::OpIEqual, boolean, { index, last });
        if (count > 1) { // SPIR-V 1.3 needs one condition per component
            const SpirvId booleans = global(spv::OpTypeVector, 0, { boolean, count });
            condition = emit(body, spv::OpCompositeConstruct, booleans, std::vector<uint32_t>(count, condition));
        }
        const SpirvId hidden = emit(body, spv::OpSelect, type, { condition, never, store[2] });
        body.insert(body.end(), store.begin(), store.end());
        body[body.size() - store.size() + 2] = hidden;
    }

    SpirvId scalarOf(SpirvId type) const {
        Defined const& at = mDefinitions.of(type);
        return at.op == spv::OpTypeVector ? at.operands[0] : type;
    }

    SpirvId emit(std::vector<uint32_t>& out, spv::Op op, SpirvId type, std::vector<uint32_t> const& operands) {
        const SpirvId id = mBound++;
        out.push_back(static_cast<uint32_t>(operands.size() + (type != 0 ? 3 : 2)) << 16 | op);
        if (type != 0) out.push_back(type);
        out.push_back(id);
        out.insert(out.end(), operands.begin(), operands.end());
        return id;
    }

    /// A type or a constant: the module's own, or a new one. SPIR-V forbids two equal types.
    SpirvId global(spv::Op op, SpirvId type, std::vector<uint32_t> const& operands) {
        for (auto const& [id, known] : mDefinitions) {
            if (known.op == op && known.type == type && std::ranges::equal(known.operands, operands)) return id;
        }
        SpirvId& made = mMade[{ op, type, operands }];
        if (made == 0) made = emit(mNewGlobals, op, type, operands);
        return made;
    }

    SpirvId vertexIndex(SpirvId integer) {
        if (mVertexIndex != 0) return mVertexIndex;
        const SpirvId pointer = global(spv::OpTypePointer, 0, { spv::StorageClassInput, integer });
        mVertexIndex = emit(mNewGlobals, spv::OpVariable, pointer, { spv::StorageClassInput });
        mIsNewIndex = true;
        return mVertexIndex;
    }

    std::vector<uint32_t> assemble(std::vector<uint32_t> const& body) const {
        std::vector<uint32_t> out;
        const auto copy = [&](size_t begin, size_t end) {
            const SpirvWords part = mModule.subspan(begin, end - begin);
            out.insert(out.end(), part.begin(), part.end());
        };
        const size_t entryEnd = mEntryPoint + (mModule[mEntryPoint] >> 16);
        copy(0, entryEnd);
        if (mIsNewIndex) {
            out[mEntryPoint] += 1u << 16;
            out.push_back(mVertexIndex);
        }
        copy(entryEnd, mTypes);
        if (mIsNewIndex) {
            out.insert(out.end(),
                       { 4u << 16 | spv::OpDecorate, mVertexIndex, spv::DecorationBuiltIn, spv::BuiltInVertexIndex });
        }
        copy(mTypes, mFunctions);
        out.insert(out.end(), mNewGlobals.begin(), mNewGlobals.end());
        out.insert(out.end(), body.begin(), body.end());
        out[kModuleBoundWord] = mBound;
        return out;
    }

    SpirvWords mModule;
    Definitions mDefinitions;
    Knowledge mKnowledge;
    bool mIsVertex = false, mIsNewIndex = false;
    size_t mEntryPoint = 0, mTypes = 0, mFunctions = 0; ///< word indices
    SpirvId mVertexIndex = 0, mBound = 0;
    std::set<SpirvId> mLocated;
    std::map<std::tuple<spv::Op, SpirvId, std::vector<uint32_t>>, SpirvId> mMade;
    std::vector<uint32_t> mNewGlobals;
};

} // namespace

std::vector<uint32_t> hideConstantOutputs(std::span<const uint32_t> spirv) {
    Rewriter rewriter(spirv);
    return rewriter.isVertex() ? rewriter.run() : std::vector<uint32_t>(spirv.begin(), spirv.end());
}

} // namespace filament_core::shader
