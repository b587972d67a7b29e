// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/CanonicalOrder.h"

#include "shaders/compiler/SpirvWords.h"

#include <spirv-tools/libspirv.h>

#include <algorithm>
#include <memory>

namespace filament_core::shader {
namespace {

struct ParsedInstruction {
    std::vector<uint32_t> words;
    std::vector<uint16_t> ids; ///< which words are ids that it uses, its type included
    SpirvId result = 0;

    spv::Op op() const { return static_cast<spv::Op>(words[0] & 0xFFFF); }
};

struct Module {
    std::vector<uint32_t> header;
    std::vector<ParsedInstruction> instructions;
};

bool isId(spv_operand_type_t type) {
    return type == SPV_OPERAND_TYPE_ID || type == SPV_OPERAND_TYPE_TYPE_ID ||
           type == SPV_OPERAND_TYPE_MEMORY_SEMANTICS_ID || type == SPV_OPERAND_TYPE_SCOPE_ID;
}

spv_result_t addInstruction(void* user, const spv_parsed_instruction_t* parsed) {
    ParsedInstruction instruction{ { parsed->words, parsed->words + parsed->num_words }, {}, parsed->result_id };
    for (uint16_t i = 0; i < parsed->num_operands; ++i) {
        if (isId(parsed->operands[i].type)) instruction.ids.push_back(parsed->operands[i].offset);
    }
    static_cast<Module*>(user)->instructions.push_back(std::move(instruction));
    return SPV_SUCCESS;
}

bool parse(std::span<const uint32_t> words, Module& out) {
    const std::unique_ptr<spv_context_t, void (*)(spv_context)> context(spvContextCreate(SPV_ENV_VULKAN_1_1),
                                                                        spvContextDestroy);
    if (words.size() < kModuleHeaderWords) return false;
    out.header.assign(words.begin(), words.begin() + kModuleHeaderWords);
    return spvBinaryParse(context.get(), &out, words.data(), words.size(), nullptr, addInstruction, nullptr) ==
           SPV_SUCCESS;
}

bool isAnnotation(spv::Op op) {
    return op == spv::OpName || op == spv::OpMemberName || op == spv::OpDecorate || op == spv::OpMemberDecorate;
}

/// Types, constants and global variables: everything with a result before the first function, except imports.
bool isGlobal(ParsedInstruction const& at) { return at.result != 0 && at.op() != spv::OpExtInstImport; }

class Order {
public:
    explicit Order(Module module)
            : mModule(std::move(module)), mNumbers(mModule.header[3]), mGlobals(mNumbers.size()) {}

    std::vector<uint32_t> run() {
        const size_t functions = firstFunction();
        for (size_t i = 0; i < functions; ++i) {
            ParsedInstruction& at = mModule.instructions[i];
            if (isGlobal(at))
                mGlobals[at.result] = &at;
            else
                (isAnnotation(at.op()) ? mAnnotations : mPreamble).push_back(&at);
        }
        // Numbers follow the order in which the module is written: imports, then what functions need, then what they
        // define.
        for (ParsedInstruction const* at : mPreamble) number(at->result);
        for (size_t i = functions; i < mModule.instructions.size(); ++i) need(mModule.instructions[i]);
        for (size_t i = functions; i < mModule.instructions.size(); ++i) number(mModule.instructions[i].result);
        for (ParsedInstruction const* at : mPreamble) need(*at); // interface variables that no function reads
        for (size_t i = 0; i < functions; ++i) place(mModule.instructions[i].result); // everything that nothing reads
        return write(functions);
    }

private:
    size_t firstFunction() const {
        const auto found = std::ranges::find(mModule.instructions, spv::OpFunction, &ParsedInstruction::op);
        return static_cast<size_t>(found - mModule.instructions.begin());
    }

    void number(SpirvId id) {
        if (id != 0 && mNumbers[id] == 0) mNumbers[id] = mNext++;
    }

    /// Places the globals that `at` uses, each after the globals that it uses itself. Types are not nested deeply.
    void need(ParsedInstruction const& at) {
        for (const uint16_t word : at.ids) place(at.words[word]);
    }

    void place(SpirvId id) {
        ParsedInstruction const* global = mGlobals[id];
        if (!global || mNumbers[id] != 0) return;
        need(*global);
        number(id);
        mOrdered.push_back(global);
    }

    void renumber(ParsedInstruction& at) {
        for (const uint16_t word : at.ids) {
            number(at.words[word]); // only undefined ids are new here
            at.words[word] = mNumbers[at.words[word]];
        }
        if (at.result == 0) return;
        const bool hasType = !at.ids.empty() && at.ids[0] == 1 && at.words.size() > 2 && at.words[2] == at.result;
        at.words[hasType ? 2 : 1] = mNumbers[at.result];
    }

    std::vector<uint32_t> write(size_t functions) {
        // Before sorting: annotations are ordered by the new numbers, since the old ones depend on removed code.
        for (ParsedInstruction& at : mModule.instructions) renumber(at);
        std::ranges::stable_sort(mAnnotations, {}, [](ParsedInstruction const* at) {
            const bool isName = at->op() == spv::OpName || at->op() == spv::OpMemberName;
            return std::pair(!isName, std::vector(at->words.begin() + 1, at->words.end()));
        });
        std::vector<uint32_t> out = mModule.header;
        out[3] = mNext;
        const auto append = [&](ParsedInstruction const& at) {
            out.insert(out.end(), at.words.begin(), at.words.end());
        };
        for (ParsedInstruction const* at : mPreamble) append(*at);
        for (ParsedInstruction const* at : mAnnotations) append(*at);
        for (ParsedInstruction const* at : mOrdered) append(*at);
        for (size_t i = functions; i < mModule.instructions.size(); ++i) append(mModule.instructions[i]);
        return out;
    }

    Module mModule;
    std::vector<SpirvId> mNumbers;                  ///< old id -> new id, 0: none yet
    std::vector<ParsedInstruction const*> mGlobals; ///< by old id
    std::vector<ParsedInstruction*> mPreamble, mAnnotations;
    std::vector<ParsedInstruction const*> mOrdered;
    SpirvId mNext = 1;
};

} // namespace

Result<std::vector<uint32_t>> canonicalOrder(std::span<const uint32_t> words) {
    Module module;
    if (!parse(words, module)) return fail(ErrorCode::Internal, "SPIRV-Tools cannot read a module of the compiler");
    return Order(std::move(module)).run();
}

} // namespace filament_core::shader
