// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/UniformConditions.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <span>
#include <utility>

namespace filament_core::backend::vulkan {
namespace {

constexpr size_t kModuleHeader = 5, kBound = 3;
constexpr uint32_t kMostWords = 0xFFFF; // of an instruction

enum Op : uint32_t {
    OpExtInst = 12,
    OpEntryPoint = 15,
    OpTypeVoid = 19,
    OpTypeBool = 20,
    OpTypeInt = 21,
    OpTypeFloat = 22,
    OpTypeVector = 23,
    OpTypePointer = 32,
    OpConstantTrue = 41,
    OpConstant = 43,
    OpConstantNull = 46,
    OpSpecConstantTrue = 48,
    OpSpecConstantOp = 52,
    OpFunction = 54,
    OpVariable = 59,
    OpLoad = 61,
    OpStore = 62,
    OpAccessChain = 65,
    OpInBoundsAccessChain = 66,
    OpDecorate = 71,
    OpVectorShuffle = 79,
    OpCompositeExtract = 81,
    OpCompositeInsert = 82,
    OpLogicalAnd = 167,
    OpSelect = 169,
    OpSGreaterThan = 173,
    OpFOrdGreaterThan = 186,
    OpPhi = 245,
    OpLoopMerge = 246,
    OpSelectionMerge = 247,
    OpLabel = 248,
    OpBranchConditional = 250,
    OpSwitch = 251,
};
constexpr uint32_t kDecorationBuiltIn = 11, kFragCoord = 15, kVertexIndex = 42;
// Of gl_FragCoord. Its w may be negative: with several samples it is that of the pixel's middle, where the plane of the
// triangle may lie behind the camera.
constexpr uint32_t kX = 0;
constexpr uint32_t kStorageOfInput = 1, kStorageUniform = 2, kStorageFunction = 7, kStoragePushConstant = 9;

bool isIn(uint32_t op, uint32_t first, uint32_t last) { return op >= first && op <= last; }

bool isConstant(uint32_t op) {
    return isIn(op, OpConstantTrue, OpConstantNull) || isIn(op, OpSpecConstantTrue, OpSpecConstantOp);
}

/// Its result depends on its operands and on nothing else: composites, conversions, arithmetic, comparisons, bits.
bool isArithmetic(uint32_t op) {
    return op == OpExtInst || isIn(op, 77, 84) || isIn(op, 109, 124) || isIn(op, 126, 152) || isIn(op, 154, 191) ||
           isIn(op, 194, 205);
}

struct Instruction {
    uint32_t op = 0;
    size_t at = 0;                     ///< in the module
    std::span<const uint32_t> words{}; ///< with the first one, which has op and size
    uint32_t word(size_t i) const { return i < words.size() ? words[i] : 0; }
    /// Words from the `first`, at most `count`; fewer if the module is not valid.
    std::span<const uint32_t> from(size_t first, size_t count = ~size_t{ 0 }) const {
        const size_t begin = std::min(first, words.size());
        return words.subspan(begin, std::min(count, words.size() - begin));
    }
};

/// The operands that are ids of values.
std::span<const uint32_t> valuesOf(Instruction const& it) {
    if (it.op == OpExtInst) return it.from(5);
    if (it.op == OpCompositeExtract) return it.from(3, 1);
    if (it.op == OpCompositeInsert || it.op == OpVectorShuffle) return it.from(3, 2);
    return it.from(3);
}

class Rewriter {
public:
    Rewriter(std::vector<uint32_t> words, ShaderStage stage)
            : mWords(std::move(words)), mIsVertex(stage == ShaderStage::Vertex), mBound(mWords[kBound]), mById(mBound) {
        for (size_t at = kModuleHeader; at < mWords.size();) {
            const size_t count = std::max(mWords[at] >> 16, 1u);
            note({ mWords[at] & 0xffff, at, std::span(mWords).subspan(at, std::min(count, mWords.size() - at)) });
            at += count;
        }
    }

    std::vector<uint32_t> result() && {
        for (Branch const& branch : mBranches) {
            if (readsUniforms(branch.condition)) mHidden.push_back(branch);
        }
        if (mHidden.empty() || !mEntryPoint || sizeOfEntryPoint() == kMostWords) return std::move(mWords);
        makeTruth();
        for (Branch const& branch : mHidden) hide(branch);
        return rewritten();
    }

private:
    struct Branch {
        uint32_t op = 0;     ///< OpBranchConditional or OpSwitch
        size_t at = 0;       ///< of the branch
        size_t mergeAt = 0;  ///< of the merge before it, or `at`
        size_t function = 0; ///< index into mFirstBlocks
        uint32_t condition = 0;
    };
    /// What a value depends on: bits. A constant on nothing.
    using Known = uint8_t;
    static constexpr Known kConstant = 0, kUniform = 1, kVarying = 2, kAsked = 4, kUnknown = 8;
    struct Value {
        Instruction made{};
        std::vector<uint32_t> stored{}; ///< to a variable
        Known known = kUnknown;
    };

    Value* value(uint32_t id) { return id < mById.size() ? &mById[id] : nullptr; }

    void note(Instruction const& it) {
        switch (it.op) {
        case OpEntryPoint:
            mEntryPoint = it.at;
            return;
        case OpDecorate:
            if (it.word(2) == kDecorationBuiltIn && it.word(3) == builtIn()) mBuiltIn = it.word(1);
            return;
        case OpFunction:
            mFirstBlocks.push_back(0);
            return;
        case OpLabel:
            if (!mFirstBlocks.empty() && mFirstBlocks.back() == 0) mFirstBlocks.back() = it.at + it.words.size();
            return;
        case OpStore:
            if (Value* to = value(baseOf(it.word(1)))) to->stored.push_back(it.word(2));
            return;
        case OpLoopMerge:
        case OpSelectionMerge:
            mMergeAt = it.at;
            return;
        case OpBranchConditional:
        case OpSwitch:
            noteBranch(it);
            return;
        default:
            define(it);
        }
    }

    void noteBranch(Instruction const& it) {
        if (mFirstBlocks.empty() || mFirstBlocks.back() == 0 || it.words.size() < 2) return; // not a valid module
        const bool hasMerge = mMergeAt != 0 && mMergeAt + (mWords[mMergeAt] >> 16) == it.at;
        mBranches.push_back({ it.op, it.at, hasMerge ? mMergeAt : it.at, mFirstBlocks.size() - 1, it.word(1) });
    }

    void define(Instruction const& it) {
        if (isIn(it.op, OpTypeVoid, OpTypePointer)) {
            noteType(it);
        } else if (Value* made = value(it.word(2))) {
            if (isConstant(it.op) || isArithmetic(it.op) || it.op == OpVariable || it.op == OpLoad || it.op == OpPhi ||
                it.op == OpAccessChain || it.op == OpInBoundsAccessChain) {
                made->made = it;
                if (it.op == OpVariable && it.word(3) == kStorageFunction && !mFirstBlocks.empty())
                    mFirstBlocks.back() = it.at + it.words.size();
            }
        }
    }

    void noteType(Instruction const& it) {
        if (!mTypesAt) mTypesAt = it.at;
        if (it.op == OpTypeBool) mBool = it.word(1);
        if (it.op == OpTypeInt && it.word(2) == 32 && it.word(3) == 1) mInt = it.word(1);
        if (it.op == OpTypeFloat && it.word(2) == 32) mFloat = it.word(1);
        if (it.op == OpTypeVector && it.word(2) == mFloat && it.word(3) == 4) mFloat4 = it.word(1);
        if (it.op == OpTypePointer && it.word(2) == kStorageOfInput) mInputPointers[it.word(3)] = it.word(1);
    }

    /// The variable behind access chains.
    uint32_t baseOf(uint32_t pointer) {
        for (Value* it = value(pointer); it && isChain(it->made.op); it = value(pointer)) {
            const uint32_t base = it->made.word(3);
            if (base >= pointer) break; // not a valid module; ends
            pointer = base;
        }
        return pointer;
    }
    static bool isChain(uint32_t op) { return op == OpAccessChain || op == OpInBoundsAccessChain; }

    // ---- what conditions depend on

    bool readsUniforms(uint32_t condition) { return (knowledgeOf(condition, 0) & kUniform) != 0; }

    /// A phi that depends on itself through a loop counts as a constant: its other inputs decide.
    Known knowledgeOf(uint32_t id, int depth) {
        // The walk recurses: a module made to harm must not exhaust the stack.
        constexpr int kMostDepth = 4000;
        Value* it = value(id);
        if (!it || depth > kMostDepth) return kVarying;
        if (it->known == kAsked) return kConstant;
        if (it->known != kUnknown) return it->known;
        it->known = kAsked;
        return it->known = askedAnew(*it, depth);
    }

    Known askedAnew(Value const& it, int depth) {
        const uint32_t op = it.made.op;
        if (isConstant(op)) return kConstant;
        if (op == OpLoad) return loaded(it.made.word(3), depth);
        if (op == OpPhi) {
            Known known = kConstant;
            for (size_t i = 3; i < it.made.words.size(); i += 2) known |= knowledgeOf(it.made.words[i], depth + 1);
            return known;
        }
        return isArithmetic(op) ? ofAll(valuesOf(it.made), depth) : kVarying;
    }

    Known ofAll(std::span<const uint32_t> ids, int depth) {
        Known known = kConstant;
        for (const uint32_t id : ids) known |= knowledgeOf(id, depth + 1);
        return known;
    }

    Known loaded(uint32_t pointer, int depth) {
        Known known = kConstant;
        const uint32_t base = baseOf(pointer);
        for (uint32_t at = pointer; at != base; at = value(at)->made.word(3))
            known |= ofAll(value(at)->made.from(4), depth);
        Value const* variable = value(base);
        if (!variable || variable->made.op != OpVariable) return kVarying;
        const uint32_t storage = variable->made.word(3);
        if (storage == kStorageUniform || storage == kStoragePushConstant) return known | kUniform;
        return storage == kStorageFunction ? known | ofAll(variable->stored, depth) : kVarying;
    }

    // ---- the new module

    uint32_t newId() { return mBound++; }
    uint32_t sizeOfEntryPoint() const { return mWords[mEntryPoint] >> 16; }
    uint32_t builtIn() const { return mIsVertex ? kVertexIndex : kFragCoord; }
    void insert(size_t at, uint32_t op, std::initializer_list<uint32_t> operands) {
        std::vector<uint32_t>& words = mInserted[at];
        words.push_back(static_cast<uint32_t>(operands.size() + 1) << 16 | op);
        words.insert(words.end(), operands);
    }

    uint32_t typeOr(uint32_t known, uint32_t op, std::initializer_list<uint32_t> operands) {
        if (known) return known;
        const uint32_t id = newId();
        std::vector<uint32_t>& words = mInserted[mFunctionsAt];
        words.insert(words.end(), { static_cast<uint32_t>(operands.size() + 2) << 16 | op, id });
        words.insert(words.end(), operands);
        return id;
    }

    /// A value at the begin of each function that has hidden conditions.
    void makeTruth() {
        mFunctionsAt = functionsAt();
        mBool = typeOr(mBool, OpTypeBool, {}); // a module with switches only may have none
        const uint32_t scalar = mIsVertex ? typeOr(mInt, OpTypeInt, { 32, 1 }) : typeOr(mFloat, OpTypeFloat, { 32 });
        uint32_t type = mIsVertex ? scalar : typeOr(mFloat4, OpTypeVector, { scalar, 4 });
        if (Value const* input = mBuiltIn ? value(mBuiltIn) : nullptr; input && input->made.op == OpVariable) {
            for (auto const& [pointee, pointer] : mInputPointers) {
                if (pointer == input->made.word(1)) type = pointee;
            }
        } else {
            addBuiltIn(type);
        }
        const uint32_t limit = newId();
        insert(mFunctionsAt, OpConstant, { scalar, limit, mIsVertex ? ~0u : 0u });
        for (Branch const& branch : mHidden) {
            uint32_t& truth = mTruths[branch.function];
            if (!truth) truth = addTruth(mFirstBlocks[branch.function], type, scalar, limit);
        }
    }

    uint32_t addTruth(size_t at, uint32_t type, uint32_t scalar, uint32_t limit) {
        const uint32_t read = newId(), truth = newId();
        uint32_t operand = read;
        insert(at, OpLoad, { type, read, mBuiltIn });
        if (!mIsVertex) {
            operand = newId();
            insert(at, OpCompositeExtract, { scalar, operand, read, kX });
        }
        insert(at, mIsVertex ? OpSGreaterThan : OpFOrdGreaterThan, { mBool, truth, operand, limit });
        return truth;
    }

    void addBuiltIn(uint32_t type) {
        const uint32_t pointer = typeOr(mInputPointers[type], OpTypePointer, { kStorageOfInput, type });
        mBuiltIn = newId();
        insert(mTypesAt ? mTypesAt : mFunctionsAt, OpDecorate, { mBuiltIn, kDecorationBuiltIn, builtIn() });
        insert(mFunctionsAt, OpVariable, { pointer, mBuiltIn, kStorageOfInput });
        const uint32_t size = sizeOfEntryPoint();
        mWords[mEntryPoint] = (size + 1) << 16 | OpEntryPoint;
        std::vector<uint32_t>& behind = mInserted[mEntryPoint + size];
        behind.insert(behind.begin(), mBuiltIn); // one more word of the entry point
    }

    size_t functionsAt() const {
        for (size_t at = kModuleHeader; at < mWords.size(); at += std::max(mWords[at] >> 16, 1u)) {
            if ((mWords[at] & 0xffff) == OpFunction) return at;
        }
        return mWords.size();
    }

    void hide(Branch const& branch) {
        const uint32_t hidden = newId(), truth = mTruths[branch.function];
        if (branch.op == OpBranchConditional) {
            insert(branch.mergeAt, OpLogicalAnd, { mBool, hidden, truth, branch.condition });
        } else {
            const uint32_t type = value(branch.condition)->made.word(1), zero = newId();
            insert(mFunctionsAt, OpConstantNull, { type, zero });
            insert(branch.mergeAt, OpSelect, { type, hidden, truth, branch.condition, zero });
        }
        mWords[branch.at + 1] = hidden;
    }

    std::vector<uint32_t> rewritten() {
        std::vector<uint32_t> words;
        size_t from = 0;
        for (auto const& [at, inserted] : mInserted) {
            words.insert(words.end(), mWords.begin() + static_cast<ptrdiff_t>(from),
                         mWords.begin() + static_cast<ptrdiff_t>(at));
            words.insert(words.end(), inserted.begin(), inserted.end());
            from = at;
        }
        words.insert(words.end(), mWords.begin() + static_cast<ptrdiff_t>(from), mWords.end());
        words[kBound] = mBound;
        return words;
    }

    std::vector<uint32_t> mWords;
    bool mIsVertex;
    uint32_t mBound;
    std::vector<Value> mById;
    uint32_t mBool = 0, mInt = 0, mFloat = 0, mFloat4 = 0;
    std::map<uint32_t, uint32_t> mInputPointers; // by the pointee
    uint32_t mBuiltIn = 0;                       // the variable
    size_t mEntryPoint = 0, mTypesAt = 0, mFunctionsAt = 0, mMergeAt = 0;
    std::vector<size_t> mFirstBlocks; // by function: behind the variables of its first block
    std::vector<Branch> mBranches, mHidden;
    std::map<size_t, uint32_t> mTruths;                // by function
    std::map<size_t, std::vector<uint32_t>> mInserted; // before the word at this place
};

} // namespace

std::vector<uint32_t> hideUniformConditions(std::vector<uint32_t> words, ShaderStage stage) {
    if (stage == ShaderStage::Compute || words.size() <= kModuleHeader) return words;
    return Rewriter(std::move(words), stage).result();
}

} // namespace filament_core::backend::vulkan
