// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/FoldConstants.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace filament_core::backend::vulkan {
namespace {

constexpr size_t kHeaderWords = 5, kBoundWord = 3;
constexpr uint32_t kDecorationSpecId = 1;

enum Op : uint32_t {
    OpUndef = 1,
    OpName = 5,
    OpMemberName = 6,
    OpCapability = 17,
    OpTypeImage = 25,
    OpTypeSampledImage = 27,
    OpTypePointer = 32,
    OpConstantTrue = 41,
    OpConstantFalse = 42,
    OpConstant = 43,
    OpSpecConstantTrue = 48,
    OpSpecConstantFalse = 49,
    OpSpecConstant = 50,
    OpSpecConstantOp = 52,
    OpFunction = 54,
    OpFunctionEnd = 56,
    OpFunctionCall = 57,
    OpVariable = 59,
    OpLoad = 61,
    OpDecorate = 71,
    OpMemberDecorate = 72,
    OpIAdd = 128,
    OpISub = 130,
    OpLogicalEqual = 164,
    OpLogicalNotEqual = 165,
    OpLogicalOr = 166,
    OpLogicalAnd = 167,
    OpLogicalNot = 168,
    OpSelect = 169,
    OpIEqual = 170,
    OpINotEqual = 171,
    OpUGreaterThan = 172,
    OpSGreaterThan = 173,
    OpUGreaterThanEqual = 174,
    OpSGreaterThanEqual = 175,
    OpULessThan = 176,
    OpSLessThan = 177,
    OpULessThanEqual = 178,
    OpSLessThanEqual = 179,
    OpBitwiseOr = 197,
    OpBitwiseXor = 198,
    OpBitwiseAnd = 199,
    OpPhi = 245,
    OpLoopMerge = 246,
    OpSelectionMerge = 247,
    OpLabel = 248,
    OpBranch = 249,
    OpBranchConditional = 250,
    OpSwitch = 251,
    OpUnreachable = 255,
};

using Id = uint32_t;
using Value = std::optional<uint32_t>; // booleans are 0 and 1
using Words = std::span<const uint32_t>;

uint32_t opOf(Words instruction) { return instruction[0] & 0xFFFF; }
uint32_t wordAt(Words instruction, size_t i) { return i < instruction.size() ? instruction[i] : 0; }

template <class Visit>
void forEach(Words words, Visit&& visit) {
    for (size_t at = 0; at < words.size();) {
        const size_t count = std::clamp<size_t>(words[at] >> 16, 1, words.size() - at);
        visit(words.subspan(at, count));
        at += count;
    }
}

/// Of 32-bit scalars; nothing for other operations.
Value evaluate(uint32_t op, uint32_t a, uint32_t b) {
    const auto signedA = static_cast<int32_t>(a), signedB = static_cast<int32_t>(b);
    switch (op) {
    case OpIAdd:
        return a + b;
    case OpISub:
        return a - b;
    case OpLogicalEqual:
    case OpIEqual:
        return a == b;
    case OpLogicalNotEqual:
    case OpINotEqual:
        return a != b;
    case OpLogicalOr:
    case OpBitwiseOr:
        return a | b;
    case OpLogicalAnd:
    case OpBitwiseAnd:
        return a & b;
    case OpBitwiseXor:
        return a ^ b;
    case OpUGreaterThan:
        return a > b;
    case OpUGreaterThanEqual:
        return a >= b;
    case OpULessThan:
        return a < b;
    case OpULessThanEqual:
        return a <= b;
    case OpSGreaterThan:
        return signedA > signedB;
    case OpSGreaterThanEqual:
        return signedA >= signedB;
    case OpSLessThan:
        return signedA < signedB;
    case OpSLessThanEqual:
        return signedA <= signedB;
    default:
        return {};
    }
}

/// What is known of ids before the draw.
class Values {
public:
    Values(size_t bound, std::span<const ConstantValue> constants) : mValues(bound), mConstants(constants) {}

    Value of(Id id) const { return id < mValues.size() ? mValues[id] : Value(); }

    /// Notes what the instruction defines, if its operands are known.
    void read(Words it) {
        switch (opOf(it)) {
        case OpDecorate:
            if (wordAt(it, 2) == kDecorationSpecId) mNumbers[wordAt(it, 1)] = wordAt(it, 3);
            break;
        case OpConstantTrue:
        case OpSpecConstantTrue:
            set(wordAt(it, 2), 1);
            break;
        case OpConstantFalse:
        case OpSpecConstantFalse:
            set(wordAt(it, 2), 0);
            break;
        case OpConstant:
        case OpSpecConstant:
            if (it.size() == 4) set(it[2], it[3]);
            break;
        case OpSpecConstantOp:
            if (it.size() > 4) keep(it[2], result(it[3], it.subspan(4)));
            break;
        default:
            if (it.size() > 3) keep(it[2], result(opOf(it), it.subspan(3)));
        }
    }

private:
    void keep(Id id, Value value) {
        if (value && id < mValues.size()) mValues[id] = value;
    }
    /// The value in the module, or that of the program.
    void set(Id id, uint32_t value) {
        const auto number = mNumbers.find(id);
        if (number != mNumbers.end()) {
            const auto given = std::ranges::find(mConstants, number->second, &ConstantValue::id);
            if (given != mConstants.end()) value = given->bits;
        }
        keep(id, value);
    }
    Value result(uint32_t op, Words operands) const {
        const Value first = of(operands[0]);
        if (op == OpLogicalNot) return first ? Value(*first == 0 ? 1 : 0) : Value();
        if (op == OpSelect) return first ? of(wordAt(operands, *first != 0 ? 1 : 2)) : Value();
        const Value second = operands.size() == 2 ? of(operands[1]) : Value();
        return first && second ? evaluate(op, *first, *second) : Value();
    }

    std::vector<Value> mValues;
    std::unordered_map<Id, uint32_t> mNumbers; ///< of specialisation constants
    std::span<const ConstantValue> mConstants;
};

struct Block {
    Id label = 0;
    Words body;       ///< after the label, without merge instruction and terminator
    Words merge;      ///< empty if there is none
    Words terminator; ///< as in the module
    Id jump = 0;      ///< where the branch always leads, if that is known
    bool isReached = false;
    Id continued = 0;     ///< of a loop that nothing continues: its header, to which this block leads
    bool isMerge = false; ///< reached by nothing, but named by a merge instruction
    Id continuedBy = 0;   ///< of the header of such a loop
};

/// The blocks of one function.
class Function {
public:
    Function(Words words, Values& values) {
        forEach(words, [&](Words it) {
            if (opOf(it) == OpFunctionEnd) return;
            if (opOf(it) == OpLabel) {
                mBlocks.emplace_back().label = wordAt(it, 1);
                mStart = it.data() + it.size();
                return;
            }
            if (mBlocks.empty()) {
                mHeadSize += it.size();
                return;
            }
            values.read(it);
            add(mBlocks.back(), it);
        });
        mHead = words.first(mHeadSize);
        for (size_t i = 0; i < mBlocks.size(); ++i) mPlaces.emplace(mBlocks[i].label, i);
        for (Block& block : mBlocks) mFolds |= fold(block, values);
        reach();
    }

    bool folds() const { return mFolds; }

    /// Calls `visit(instruction)` for what write() leaves out.
    template <class Visit>
    void forEachDropped(Visit&& visit) const {
        for (Block const& block : mBlocks) {
            if (!block.isReached) forEach(block.body, visit);
        }
    }

    void write(std::vector<uint32_t>& out) const {
        append(out, mHead);
        for (Block const& block : mBlocks) {
            if (block.isReached || block.isMerge || block.continued != 0) write(block, out);
        }
        out.push_back(1u << 16 | OpFunctionEnd);
    }

private:
    static void append(std::vector<uint32_t>& out, Words words) { out.insert(out.end(), words.begin(), words.end()); }

    void add(Block& block, Words it) {
        const uint32_t op = opOf(it);
        if (op == OpLoopMerge || op == OpSelectionMerge)
            block.merge = it;
        else if (op >= OpBranch && op <= OpUnreachable)
            block.terminator = it;
        else
            block.body = Words(mStart, it.data() + it.size());
    }

    static bool isLoop(Block const& block) { return !block.merge.empty() && opOf(block.merge) == OpLoopMerge; }

    /// Loops keep their form: a header its condition, and the end of what it repeats its way back.
    bool fold(Block& block, Values const& values) const {
        if (block.terminator.size() < 4 || opOf(block.terminator) != OpBranchConditional || isLoop(block)) return false;
        const size_t place = mPlaces.at(block.label);
        for (const Id target : block.terminator.subspan(2, 2)) {
            const auto found = mPlaces.find(target);
            if (found == mPlaces.end() || found->second <= place) return false;
        }
        const Value condition = values.of(block.terminator[1]);
        if (!condition) return false;
        block.jump = block.terminator[*condition != 0 ? 2 : 3];
        return true;
    }

    template <class Visit>
    static void forEachSuccessor(Block const& block, Visit&& visit) {
        Words const it = block.terminator;
        if (it.empty()) return;
        if (block.jump != 0) return visit(block.jump);
        if (opOf(it) == OpBranch) visit(wordAt(it, 1));
        if (opOf(it) == OpBranchConditional) {
            visit(wordAt(it, 2));
            visit(wordAt(it, 3));
        }
        if (opOf(it) == OpSwitch) {
            for (size_t i = 2; i < it.size(); i += 2) visit(it[i]); // the default, then literals and labels
        }
    }

    Block* find(Id label) {
        const auto place = mPlaces.find(label);
        return place == mPlaces.end() ? nullptr : &mBlocks[place->second];
    }

    void visit(Id label) {
        Block* block = find(label);
        if (!block || block->isReached) return;
        block->isReached = true;
        mWaiting.push_back(block);
    }

    void reach() {
        if (mBlocks.empty()) return;
        visit(mBlocks.front().label);
        while (!mWaiting.empty()) {
            Block const& block = *mWaiting.back();
            mWaiting.pop_back();
            forEachSuccessor(block, [&](Id label) {
                mEdges.insert({ block.label, label });
                visit(label);
            });
        }
        for (Block& block : mBlocks) {
            // Only after all blocks have been visited: whether something leads to a merge block is not known earlier.
            if (block.isReached && block.jump == 0 && !block.merge.empty()) keepNamed(block);
        }
    }

    /// A merge instruction names blocks that must exist, and a loop has one way back, even if nothing takes it.
    void keepNamed(Block& header) {
        if (Block* merge = find(wordAt(header.merge, 1)); merge && !merge->isReached) merge->isMerge = true;
        if (!isLoop(header)) return;
        Block* next = find(wordAt(header.merge, 2));
        if (!next || next->isReached) return;
        next->continued = header.label;
        header.continuedBy = next->label;
    }

    void write(Block const& block, std::vector<uint32_t>& out) const {
        append(out, std::array{ 2u << 16 | OpLabel, block.label });
        if (!block.isReached && block.continued != 0)
            return append(out, std::array{ 2u << 16 | OpBranch, block.continued });
        if (!block.isReached) return out.push_back(1u << 16 | OpUnreachable);
        forEach(block.body, [&](Words it) {
            if (opOf(it) == OpPhi)
                writePhi(block, it, out);
            else
                append(out, it);
        });
        if (block.jump != 0) return append(out, std::array{ 2u << 16 | OpBranch, block.jump });
        append(out, block.merge);
        append(out, block.terminator);
    }

    /// A pair for each block that still leads here. From a way back that nothing takes, any value will do.
    void writePhi(Block const& block, Words phi, std::vector<uint32_t>& out) const {
        const size_t at = out.size();
        append(out, phi.first(std::min<size_t>(3, phi.size())));
        for (size_t i = 3; i + 1 < phi.size(); i += 2) {
            if (mEdges.contains({ phi[i + 1], block.label })) append(out, phi.subspan(i, 2));
        }
        const bool hasRoom = out.size() - at < phi.size(); // in a valid module that of the way back
        if (hasRoom && out.size() - at > 3 && block.continuedBy != 0)
            append(out, std::array{ out[at + 3], block.continuedBy });
        const size_t count = out.size() - at;
        out[at] = static_cast<uint32_t>(count) << 16 | (count > 3 ? OpPhi : OpUndef);
    }

    std::vector<Block> mBlocks;
    uint32_t const* mStart = nullptr; ///< of the last block's body
    size_t mHeadSize = 0;
    Words mHead;
    std::unordered_map<Id, size_t> mPlaces;
    std::set<std::pair<Id, Id>> mEdges; ///< from label to label
    std::vector<Block const*> mWaiting;
    bool mFolds = false;
};

/// Of an instruction in a block; 0: it has no result.
Id resultOf(Words it) {
    // No-op, line, stores, copies of memory, image writes, emitted vertices, atomic stores, demotion.
    constexpr std::array<uint32_t, 12> kWithout{ 0, 8, 62, 63, 64, 99, 218, 219, 220, 221, 228, 5380 };
    const uint32_t op = opOf(it);
    const bool isControl = op >= 224 && op <= 225;
    return isControl || std::ranges::count(kWithout, op) > 0 ? 0 : wordAt(it, 2);
}

/// Arrays of cubes whose look-ups were all left out, with what only they need: a device may lack them, and another
/// variable may have their binding.
class UnusedCubeArrays {
public:
    explicit UnusedCubeArrays(Words globals) {
        forEach(globals, [&](Words it) {
            constexpr uint32_t kCube = 3; // SPIR-V specification 1.3, 3.8
            const Id to = opOf(it) == OpTypePointer ? wordAt(it, 3) : wordAt(it, opOf(it) == OpVariable ? 1 : 2);
            const bool follows = opOf(it) == OpTypeSampledImage || opOf(it) == OpTypePointer || opOf(it) == OpVariable;
            if (opOf(it) == OpTypeImage && wordAt(it, 3) == kCube && wordAt(it, 5) == 1) mIds.insert(wordAt(it, 1));
            if (!follows || !mIds.contains(to)) return;
            mIds.insert(wordAt(it, opOf(it) == OpVariable ? 2 : 1));
            if (opOf(it) == OpVariable) mVariables.insert(wordAt(it, 2));
        });
    }

    /// A variable of a texture is loaded, or handed to a function.
    void read(Words it) {
        if (opOf(it) != OpLoad && opOf(it) != OpFunctionCall) return;
        for (size_t i = 3; i < it.size(); ++i) mIsUsed |= mVariables.contains(it[i]);
    }

    bool leavesOut(Words it) const {
        constexpr uint32_t kSampledCubeArray = 45; // 3.31
        if (mIsUsed || mVariables.empty()) return false;
        switch (opOf(it)) {
        case OpCapability:
            return wordAt(it, 1) == kSampledCubeArray;
        case OpVariable:
            return mIds.contains(wordAt(it, 2));
        case OpTypeImage:
        case OpTypeSampledImage:
        case OpTypePointer:
        case OpName:
        case OpDecorate:
            return mIds.contains(wordAt(it, 1));
        default:
            return false;
        }
    }

private:
    std::unordered_set<Id> mIds, mVariables;
    bool mIsUsed = false;
};

bool isAnnotation(uint32_t op) {
    return op == OpName || op == OpMemberName || op == OpDecorate || op == OpMemberDecorate;
}

/// Splits a module into what precedes its functions, and these.
struct Module {
    Words globals;
    std::vector<Function> functions;
    bool folds = false;

    Module(Words words, Values& values) {
        size_t begin = 0; // of the function that the walk is in
        forEach(words.subspan(kHeaderWords), [&](Words it) {
            const auto at = static_cast<size_t>(it.data() - words.data());
            // The specification orders a module: decorations, then constants, then functions (2.4). One walk knows each
            // value before its first use.
            if (opOf(it) == OpFunction && globals.empty()) globals = words.first(at);
            if (opOf(it) == OpFunction) begin = at;
            if (globals.empty()) values.read(it);
            if (opOf(it) != OpFunctionEnd || begin == 0) return;
            functions.emplace_back(words.subspan(begin, at + it.size() - begin), values);
            folds |= functions.back().folds();
            begin = 0;
        });
    }
};

} // namespace

std::vector<uint32_t> foldConstants(std::vector<uint32_t> words, std::span<const ConstantValue> constants) {
    Values values(words[kBoundWord], constants);
    const Module module(words, values);
    if (!module.folds) return words;
    std::unordered_set<Id> dropped;
    for (Function const& function : module.functions)
        function.forEachDropped([&](Words it) { dropped.insert(resultOf(it)); });
    std::vector<uint32_t> out(module.globals.begin(), module.globals.begin() + kHeaderWords);
    out.reserve(words.size());
    std::vector<uint32_t> functions;
    functions.reserve(words.size());
    for (Function const& function : module.functions) function.write(functions);
    UnusedCubeArrays arrays(module.globals.subspan(kHeaderWords));
    forEach(functions, [&](Words it) { arrays.read(it); });
    forEach(module.globals.subspan(kHeaderWords), [&](Words it) {
        const bool isLeft = isAnnotation(opOf(it)) && dropped.contains(wordAt(it, 1));
        if (!isLeft && !arrays.leavesOut(it)) out.insert(out.end(), it.begin(), it.end());
    });
    out.insert(out.end(), functions.begin(), functions.end());
    return out;
}

} // namespace filament_core::backend::vulkan
