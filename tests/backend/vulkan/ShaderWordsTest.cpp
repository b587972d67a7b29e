// SPDX-License-Identifier: Apache-2.0
// What the backend does to the words of shaders before the driver gets them: modules that no compiler writes, and the
// fuzzer's corpus, whole and damaged.
#include "tests/backend/vulkan/ShaderWordsFuzzBody.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace filament_core::backend::vulkan {
namespace {

std::vector<std::vector<uint8_t>> corpusOfShaders() {
    std::vector<std::vector<uint8_t>> files;
    for (auto const& entry :
         std::filesystem::directory_iterator(tools::sourceDir() / "tests/fuzz/corpus/shader_words")) {
        std::ifstream file(entry.path(), std::ios::binary);
        files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return files;
}

// ---- modules that no compiler writes

enum Op : uint32_t {
    Entry = 15,
    TypeBool = 20,
    TypeFloat = 22,
    ConstantTrue = 41,
    Function = 54,
    FunctionEnd = 56,
    Variable = 59,
    Load = 61,
    Chain = 65,
    Phi = 245,
    LoopMerge = 246,
    Label = 248,
    Branch = 249,
    BranchConditional = 250,
    Return = 253,
};
constexpr uint32_t kUniform = 2, kMain = 0x6E69616D;

struct Module {
    std::vector<uint32_t> words{ 0, 0x07230203, 0x10000, 0, 100, 0 }; // a fragment shader without constants

    Module& add(Op op, std::vector<uint32_t> const& operands = {}) {
        words.push_back(static_cast<uint32_t>(operands.size() + 1) << 16 | op);
        words.insert(words.end(), operands.begin(), operands.end());
        return *this;
    }
    /// Whether the driver accepts it; the fuzzer's body asserts what is to hold then.
    bool isAccepted() {
        words[0] |= 1; // a fragment shader
        const auto* const bytes = reinterpret_cast<uint8_t const*>(words.data());
        return fuzzShaderWords({ bytes, words.size() * sizeof(uint32_t) });
    }
};

/// An entry point of that many words, types, and a variable of uniforms: id 7.
Module begun(uint32_t wordsOfEntry = 5) {
    std::vector<uint32_t> entry{ 4, 50, kMain, 0 };
    entry.resize(wordsOfEntry - 1, 60);
    return Module().add(Entry, entry).add(TypeBool, { 1 }).add(TypeFloat, { 2, 32 }).add(Variable, { 3, 7, kUniform });
}

/// Its condition is known: it folds.
void addFoldedFunction(Module& module) {
    module.add(Function, { 2, 50, 0, 4 }).add(Label, { 10 }).add(BranchConditional, { 8, 11, 12 });
    module.add(Label, { 11 }).add(Return).add(Label, { 12 }).add(Return).add(FunctionEnd);
}

TEST(ShaderWords, MayHaveAnAccessChainWithoutAPointer) {
    Module module = begun();
    module.add(Function, { 2, 50, 0, 4 }).add(Label, { 10 }).add(Chain, { 3, 20 }).add(Load, { 1, 21, 20 });
    EXPECT_TRUE(module.add(BranchConditional, { 21, 10, 10 }).isAccepted());
}

TEST(ShaderWords, MayEndWithABranchWithoutOperands) {
    Module module = begun();
    module.add(Function, { 2, 50, 0, 4 }).add(Label, { 10 }).add(Load, { 1, 0, 7 }); // id 0, which it seems to name
    EXPECT_TRUE(module.add(BranchConditional).isAccepted());
}

TEST(ShaderWords, MayEndAFunctionOften) {
    Module module = begun().add(ConstantTrue, { 1, 8 });
    addFoldedFunction(module);
    for (int i = 0; i < 100'000; ++i) module.add(FunctionEnd);
    EXPECT_TRUE(module.isAccepted());
}

TEST(ShaderWords, MayHaveNoTypes) {
    Module module = Module().add(Entry, { 4, 50, kMain, 0 }).add(Variable, { 3, 7, kUniform });
    module.add(Function, { 2, 50, 0, 4 }).add(Label, { 10 }).add(Load, { 1, 21, 7 });
    EXPECT_TRUE(module.add(BranchConditional, { 21, 10, 10 }).isAccepted());
}

TEST(ShaderWords, MayBranchOutsideOfBlocks) {
    Module module = begun().add(Load, { 1, 21, 7 }).add(Function, { 2, 50, 0, 4 });
    EXPECT_TRUE(module.add(BranchConditional, { 21, 10, 10 }).isAccepted());
}

TEST(ShaderWords, MayHaveAnEntryPointOfTheLargestSize) {
    for (const uint32_t size : { 0xFFFEu, 0xFFFFu }) {
        Module module = begun(size);
        module.add(Function, { 2, 50, 0, 4 }).add(Label, { 10 }).add(Load, { 1, 21, 7 });
        EXPECT_TRUE(module.add(BranchConditional, { 21, 10, 10 }).isAccepted());
    }
}

TEST(ShaderWords, MayHaveAPhiOfTheLargestSizeInALoopThatNothingContinues) {
    Module module = begun().add(ConstantTrue, { 1, 8 });
    std::vector<uint32_t> phi{ 1, 22 };
    while (phi.size() < 0xFFFE) phi.insert(phi.end(), { 8, 9 });
    module.add(Function, { 2, 50, 0, 4 }).add(Label, { 9 }).add(BranchConditional, { 8, 10, 12 });
    module.add(Label, { 10 }).add(Phi, phi).add(LoopMerge, { 12, 11, 0 }).add(Branch, { 12 });
    module.add(Label, { 11 }).add(Branch, { 10 }).add(Label, { 12 }).add(Return);
    EXPECT_TRUE(module.add(FunctionEnd).isAccepted());
}

// ---- the corpus

TEST(ShaderWords, OfTheFuzzersCorpusAreAcceptedOrRefused) {
    const auto files = corpusOfShaders();
    EXPECT_GT(files.size(), 20u);
    size_t accepted = 0, folded = 0, hidden = 0;
    for (auto const& file : files) {
        accepted += fuzzShaderWords(file);
        const ShaderWords shader = readShaderWords(file);
        if (!readEdges(shader.module, shader.stage)) continue;
        folded += foldConstants(shader.module, shader.constants) != shader.module;
        hidden += hideUniformConditions(shader.module, shader.stage) != shader.module;
    }
    EXPECT_GT(accepted, 20u);
    EXPECT_GT(folded, 10u) << "the corpus reaches what folds";
    EXPECT_GT(hidden, 10u) << "and what hides";
}

TEST(ShaderWords, OfTheCorpusMayBeDamagedAnywhere) {
    std::mt19937 random(5);
    size_t accepted = 0;
    for (std::vector<uint8_t> const& whole : corpusOfShaders()) {
        for (int round = 0; round < 100; ++round) {
            std::vector<uint8_t> file = whole;
            const auto anyWord = [&] { return 4 * (random() % (file.size() / 4)); };
            for (auto edits = 1 + random() % 3; edits > 0; --edits) {
                if (random() % 2 == 0) // an operand that occurs elsewhere
                    std::copy_n(whole.begin() + static_cast<ptrdiff_t>(anyWord()), 4,
                                file.begin() + static_cast<ptrdiff_t>(anyWord()));
                else // another operation, a near id
                    file[anyWord() + random() % 2] = static_cast<uint8_t>(random());
            }
            accepted += fuzzShaderWords(file);
        }
    }
    EXPECT_GT(accepted, 500u);
}

} // namespace
} // namespace filament_core::backend::vulkan
