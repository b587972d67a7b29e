// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/ClampIndices.h"

#include "shaders/compiler/SpirvWords.h"
#include "shaders/interface/ShaderInterface.h"

#include <spirv_cross/GLSL.std.450.h>

#include <cstring>
#include <map>
#include <set>

namespace filament_core::shader {
namespace {

struct Type {
    spv::Op op = spv::OpNop;
    SpirvWords words; ///< of the instruction that declares it
};

class Clamp {
public:
    explicit Clamp(SpirvWords module) : mModule(module), mBound(module[kModuleBoundWord]) {
        forEachInstruction(module, [&](spv::Op op, SpirvWords words) { learn(op, words); });
    }

    std::vector<uint32_t> run() {
        if (mExtended == 0) return { mModule.begin(), mModule.end() };
        std::vector<uint32_t> head(mModule.begin(), mModule.begin() + kModuleHeaderWords);
        bool inFunctions = false;
        forEachInstruction(mModule, [&](spv::Op op, SpirvWords words) {
            inFunctions = inFunctions || op == spv::OpFunction;
            if (inFunctions)
                rewrite(op, words);
            else
                head.insert(head.end(), words.begin(), words.end());
        });
        head.insert(head.end(), mNewConstants.begin(), mNewConstants.end());
        head.insert(head.end(), mBody.begin(), mBody.end());
        head[kModuleBoundWord] = mBound;
        return head;
    }

private:
    void learn(spv::Op op, SpirvWords words) {
        if (op >= spv::OpTypeVoid && op <= spv::OpTypePointer) mTypes[words[1]] = { op, words };
        if (op == spv::OpConstant && words.size() == 4) mConstants[words[2]] = words[3];
        const bool isGroup = op == spv::OpDecorate && words[2] == spv::DecorationDescriptorSet;
        if (isGroup && words[3] != kGroupMaterial) mEngineBlocks.insert(words[1]);
        const bool isStandard = op == spv::OpExtInstImport &&
                                std::strcmp(reinterpret_cast<const char*>(words.data() + 2), "GLSL.std.450") == 0;
        if (isStandard) mExtended = words[1];
        learnValue(op, words);
    }

    // The type of an index, and of what is indexed.
    void learnValue(spv::Op op, SpirvWords words) {
        bool hasResult = false, hasType = false;
        spv::HasResultAndType(op, &hasResult, &hasType);
        if (hasResult && hasType) mTypeOf[words[2]] = words[1];
    }

    void rewrite(spv::Op op, SpirvWords words) {
        std::vector<uint32_t> copy(words.begin(), words.end());
        if (op == spv::OpAccessChain || op == spv::OpInBoundsAccessChain)
            clampChain(copy);
        else if (op == spv::OpVectorExtractDynamic)
            clamp(copy[4], sizeOf(mTypeOf.at(copy[3])));
        else if (op == spv::OpVectorInsertDynamic)
            clamp(copy[5], sizeOf(mTypeOf.at(copy[3])));
        mBody.insert(mBody.end(), copy.begin(), copy.end());
    }

    void clampChain(std::vector<uint32_t>& chain) {
        const auto base = mBases.find(chain[3]);
        const uint32_t variable = base == mBases.end() ? chain[3] : base->second;
        mBases[chain[2]] = variable;
        if (mEngineBlocks.contains(variable)) return;
        uint32_t type = mTypes.at(mTypeOf.at(chain[3])).words[3];
        for (size_t i = 4; i < chain.size(); ++i) {
            Type const& indexed = mTypes.at(type);
            if (indexed.op == spv::OpTypeStruct) {
                type = indexed.words[2 + mConstants.at(chain[i])];
                continue;
            }
            clamp(chain[i], sizeOf(type));
            type = indexed.words[2];
        }
    }

    /// Elements of a vector, a matrix or an array; 0: unknown.
    uint32_t sizeOf(uint32_t type) const {
        Type const& known = mTypes.at(type);
        if (known.op == spv::OpTypeVector || known.op == spv::OpTypeMatrix) return known.words[3];
        const auto length = known.op == spv::OpTypeArray ? mConstants.find(known.words[3]) : mConstants.end();
        return length == mConstants.end() ? 0 : length->second;
    }

    void clamp(uint32_t& index, uint32_t size) {
        if (size == 0 || mConstants.contains(index)) return;
        const uint32_t type = mTypeOf.at(index), last = constantOf(type, size - 1), result = mBound++;
        if (mTypes.at(type).words[3] != 0) // signed
            mBody.insert(mBody.end(), { 8u << 16 | spv::OpExtInst, type, result, mExtended, GLSLstd450SClamp, index,
                                        constantOf(type, 0), last });
        else
            mBody.insert(mBody.end(),
                         { 7u << 16 | spv::OpExtInst, type, result, mExtended, GLSLstd450UMin, index, last });
        index = result;
    }

    uint32_t constantOf(uint32_t type, uint32_t value) {
        uint32_t& id = mMade[{ type, value }];
        if (id == 0) {
            id = mBound++;
            mNewConstants.insert(mNewConstants.end(), { 4u << 16 | spv::OpConstant, type, id, value });
        }
        return id;
    }

    SpirvWords mModule;
    uint32_t mBound = 0, mExtended = 0;
    std::map<uint32_t, Type> mTypes;
    std::map<uint32_t, uint32_t> mConstants, mTypeOf, mBases; ///< by id; bases of pointers made by access chains
    std::set<uint32_t> mEngineBlocks;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> mMade;
    std::vector<uint32_t> mNewConstants, mBody;
};

} // namespace

std::vector<uint32_t> clampIndices(std::span<const uint32_t> spirv) { return Clamp(spirv).run(); }

} // namespace filament_core::shader
