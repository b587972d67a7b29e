// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/EndlessLoops.h"

#include "shaders/compiler/SpirvWords.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace filament_core::shader {
namespace {

struct Block {
    std::vector<uint32_t> successors;
    bool leaves = false; ///< returns or discards
    bool isLoop = false; ///< the head of a loop
    uint32_t file = 0, line = 0;
};

class Search {
public:
    std::optional<EndlessLoop> run(SpirvWords module) {
        forEachInstruction(module, [&](spv::Op op, SpirvWords words) { visit(op, words); });
        return mFound;
    }

private:
    void visit(spv::Op op, SpirvWords words) {
        if (op == spv::OpString) mStrings[words[1]] = reinterpret_cast<const char*>(&words[2]);
        if (op == spv::OpConstantTrue) mTrue.insert(words[2]);
        if (op == spv::OpConstantFalse) mFalse.insert(words[2]);
        if (op == spv::OpLine) mFile = words[1], mLine = words[2];
        if (op == spv::OpFunction) mBlocks.clear(), mEntry = 0;
        if (op == spv::OpLabel) {
            mCurrent = words[1];
            if (mEntry == 0) mEntry = mCurrent;
            mBlocks[mCurrent] = {};
        }
        if (mEntry != 0) readBranch(op, words);
        if (op == spv::OpFunctionEnd && mEntry != 0) searchFunction(), mEntry = 0;
    }

    void readBranch(spv::Op op, SpirvWords words) {
        Block& block = mBlocks[mCurrent];
        if (op == spv::OpLoopMerge) block.isLoop = true, block.file = mFile, block.line = mLine;
        if (op == spv::OpBranch) block.successors = { words[1] };
        if (op == spv::OpBranchConditional) {
            if (!mFalse.contains(words[1])) block.successors.push_back(words[2]);
            if (!mTrue.contains(words[1])) block.successors.push_back(words[3]);
        }
        if (op == spv::OpSwitch) {
            block.successors = { words[2] };
            for (size_t i = 4; i < words.size(); i += 2) block.successors.push_back(words[i]);
        }
        block.leaves = block.leaves || op == spv::OpReturn || op == spv::OpReturnValue || op == spv::OpKill;
    }

    std::set<uint32_t> reached() const {
        std::set<uint32_t> known{ mEntry };
        for (std::vector<uint32_t> open{ mEntry }; !open.empty();) {
            const uint32_t at = open.back();
            open.pop_back();
            for (const uint32_t next : mBlocks.at(at).successors) {
                if (known.insert(next).second) open.push_back(next);
            }
        }
        return known;
    }

    std::set<uint32_t> leaving() const {
        std::set<uint32_t> known;
        for (bool grew = true; grew;) {
            grew = false;
            for (auto const& [id, block] : mBlocks) {
                const bool leaves = block.leaves || std::ranges::any_of(block.successors, [&](uint32_t next) {
                                        return known.contains(next);
                                    });
                grew = (leaves && known.insert(id).second) || grew;
            }
        }
        return known;
    }

    void searchFunction() {
        const std::set<uint32_t> exits = leaving();
        for (const uint32_t id : reached()) {
            Block const& block = mBlocks.at(id);
            if (mFound || exits.contains(id) || !block.isLoop) continue;
            const auto file = mStrings.find(block.file);
            mFound = EndlessLoop{ file == mStrings.end() ? std::string() : file->second, block.line };
        }
    }

    std::map<uint32_t, std::string> mStrings;
    std::set<uint32_t> mTrue, mFalse;
    std::map<uint32_t, Block> mBlocks; ///< of the current function, by label
    uint32_t mEntry = 0, mCurrent = 0, mFile = 0, mLine = 0;
    std::optional<EndlessLoop> mFound;
};

} // namespace

std::optional<EndlessLoop> findEndlessLoop(std::span<const uint32_t> spirv) { return Search().run(spirv); }

} // namespace filament_core::shader
