// SPDX-License-Identifier: Apache-2.0
// What constants rule out is gone, what they allow stays, and modules stay valid: small ones, all of the engine's
// materials, and damaged words do not crash.
#include "backend/vulkan/FoldConstants.h"

#include "backend/vulkan/Spirv.h"
#include "shaders/package/EngineMaterials.h"
#include "shaders/package/Package.h"
#include "tests/backend/vulkan/ShaderText.h"

#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include <algorithm>
#include <random>
#include <set>

namespace filament_core::backend::vulkan {
namespace {

using Words = std::vector<uint32_t>;

constexpr uint32_t kExtInst = 12, kLoopMerge = 246, kBranchConditional = 250;

size_t countOf(Words const& words, uint32_t op) {
    size_t count = 0;
    for (size_t at = 5; at < words.size(); at += words[at] >> 16) count += (words[at] & 0xffff) == op;
    return count;
}

std::string complaintAbout(Words const& words) {
    std::string messages;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    tools.SetMessageConsumer(
            [&](spv_message_level_t, const char*, spv_position_t const&, const char* message) { messages += message; });
    return tools.Validate(words) ? "" : messages + " ";
}

Words moduleOf(std::string_view body) {
    return spirvFromGlsl(ShaderStage::Fragment, R"(
        layout(constant_id = 0) const bool on = false;
        layout(constant_id = 1) const int mode = 2;
        layout(location = 0) in vec4 v;
        layout(location = 0) out vec4 color;
        void main() { color = v; )" + std::string(body) +
                                                        " }");
}

/// Folded, and valid.
Words folded(Words const& words, std::vector<ConstantValue> const& constants) {
    Words out = foldConstants(words, constants);
    EXPECT_EQ(complaintAbout(out), "");
    EXPECT_TRUE(readEdges(out, ShaderStage::Fragment));
    return out;
}

ConstantValue on(bool value) { return { .id = 0, .bits = value, .type = ConstantValue::Type::Bool }; }
ConstantValue mode(int value) {
    return { .id = 1, .bits = static_cast<uint32_t>(value), .type = ConstantValue::Type::Int };
}

TEST(FoldConstants, LeavesOneSideOfABranch) {
    const Words words = moduleOf("if (on) { color.x = sin(v.x); } else { color.x = cos(v.y) + exp(v.z); }");
    EXPECT_EQ(countOf(words, kExtInst), 3u);
    EXPECT_EQ(countOf(folded(words, { on(true) }), kExtInst), 1u);
    EXPECT_EQ(countOf(folded(words, { on(false) }), kExtInst), 2u);
    EXPECT_EQ(countOf(folded(words, {}), kExtInst), 2u) << "the default of the module";
    EXPECT_EQ(countOf(folded(words, { on(true) }), kBranchConditional), 0u);
}

/// Two textures with one binding, of which each program reads one.
TEST(FoldConstants, ArraysOfCubesThatNothingReadsAreGoneWithTheirCapability) {
    constexpr uint32_t kCapability = 17, kTypeImage = 25, kVariable = 59;
    const Words words = spirvFromGlsl(ShaderStage::Fragment, R"(
        layout(constant_id = 0) const bool on = false;
        layout(set = 0, binding = 0) uniform samplerCube one;
        layout(set = 0, binding = 0) uniform samplerCubeArray many;
        layout(location = 0) in vec4 v;
        layout(location = 0) out vec4 color;
        void main() {
            if (on) { color = textureLod(many, v, 0.0); } else { color = textureLod(one, v.xyz, 0.0); }
        })");
    const size_t capabilities = countOf(words, kCapability), variables = countOf(words, kVariable);
    const Words with = folded(words, { on(true) }), without = folded(words, { on(false) });
    EXPECT_EQ(countOf(with, kCapability), capabilities);
    EXPECT_EQ(countOf(with, kVariable), variables);
    EXPECT_EQ(countOf(without, kCapability), capabilities - 1);
    EXPECT_EQ(countOf(without, kVariable), variables - 1);
    EXPECT_EQ(countOf(without, kTypeImage), countOf(words, kTypeImage) - 1);
}

TEST(FoldConstants, FollowsComparisonsAndLogic) {
    const auto left = [](std::string const& condition, int value, bool flag) {
        const Words words = moduleOf("if (" + condition + ") color.x = sin(v.x);");
        return countOf(folded(words, { mode(value), on(flag) }), kExtInst) == 1;
    };
    for (const int value : { -3, 0, 1, 2, 7 }) {
        for (const bool flag : { false, true }) {
            EXPECT_EQ(left("mode == 2", value, flag), value == 2);
            EXPECT_EQ(left("mode != 2 && on", value, flag), value != 2 && flag);
            EXPECT_EQ(left("mode < 1 || !on", value, flag), value < 1 || !flag);
            EXPECT_EQ(left("(mode & 2) != 0", value, flag), (value & 2) != 0);
            EXPECT_EQ(left("(on ? mode : 0) >= 1", value, flag), (flag ? value : 0) >= 1);
            EXPECT_EQ(left("mode - 1 > 1 == on", value, flag), (value - 1 > 1) == flag);
            EXPECT_EQ(left("uint(mode) > 5u", value, flag), static_cast<uint32_t>(value) > 5u);
        }
    }
}

TEST(FoldConstants, KeepsWhatDependsOnTheDraw) {
    const Words words = moduleOf("if (v.x > 0.0) color.x = sin(v.x); if (v.y > float(mode)) color.y = cos(v.y);");
    EXPECT_EQ(foldConstants(words, {}), words);
}

TEST(FoldConstants, KeepsTheFormOfLoops) {
    for (const char* body :
         { "for (int i = 0; i < mode; ++i) { if (on) continue; if (v[i] > 0.5) break; color.x += sin(v[i]); }",
           "for (;;) { if (on) break; color.x += sin(color.y); if (color.x > 3.0) break; }",
           "do { if (on) { color.x = sin(v.x); break; } color.y = 2.0; } while (false);",
           "for (int i = 0; i < 4; ++i) { if (on) { color.x = v[i]; break; } else { if (mode == 1) continue; } color.y "
           "+= v[i]; }",
           "while (on) { color.x += 1.0; if (color.x > v.x) break; }",
           "for (int i = 0; i < 3; ++i) { if (mode == 2) { for (int k = 0; k < 2; ++k) if (on) color.z += v[k]; } }",
           "switch (mode) { case 1: if (on) color.x = 1.0; break; case 2: color.y = sin(v.x); default: color.z = 1.0; "
           "}",
           "if (on) { if (v.x > 0.0) discard; color.x = 1.0; } else { discard; }" }) {
        const Words words = moduleOf(body);
        for (const bool flag : { false, true }) {
            for (const int value : { 0, 1, 2 }) {
                const Words out = folded(words, { on(flag), mode(value) });
                EXPECT_LE(out.size(), words.size()) << body;
                if (!flag && countOf(words, kLoopMerge) == 1) {
                    EXPECT_EQ(countOf(out, kLoopMerge), 1u) << body;
                }
            }
        }
    }
}

TEST(FoldConstants, KeepsEveryMaterialOfTheEngineValidAndMakesItSmaller) {
    std::mt19937 random(7);
    const auto constant = [&](uint32_t id, uint32_t below) {
        return ConstantValue{ .id = id, .bits = static_cast<uint32_t>(random() % below), .type = {} };
    };
    size_t before = 0, after = 0;
    for (const std::string_view name : shader::engineMaterialNames()) {
        const auto package = shader::readPackage(shader::engineMaterial(name));
        ASSERT_TRUE(package) << name;
        std::set<shader::SharedStage> stages;
        for (shader::Variant const& variant : package->variants) stages.insert({ variant.vertex, variant.fragment });
        for (shader::SharedStage const& stage : stages) {
            for (int round = 0; round < 3; ++round) {
                std::vector<ConstantValue> constants;
                for (uint32_t id = 0; id < 40; ++id) constants.push_back(constant(id, 2)); // the material's own
                for (uint32_t id = 1000; id < 1110; ++id) constants.push_back(constant(id, 4));
                const Words out = foldConstants(stage->spirv, constants);
                EXPECT_EQ(complaintAbout(out), "") << name;
                before += stage->spirv.size();
                after += out.size();
            }
        }
    }
    EXPECT_LT(after * 10, before * 9);
    RecordProperty("words", std::to_string(before) + " -> " + std::to_string(after));
}

TEST(FoldConstants, SurvivesDamagedWords) {
    const Words words = moduleOf(
            "for (int i = 0; i < mode; ++i) { if (on) continue; color[i] += sin(v[i]); } if (on) color.x = 1.0;");
    std::mt19937 random(11);
    int tried = 0;
    for (int round = 0; round < 3000; ++round) {
        Words damaged = words;
        for (uint32_t edits = 1 + random() % 4; edits > 0; --edits) {
            uint32_t& word = damaged[5 + random() % (damaged.size() - 5)];
            word = random() % 2 == 0 ? static_cast<uint32_t>(random()) : word ^ 1u << random() % 32;
        }
        if (!readEdges(damaged, ShaderStage::Fragment)) continue; // as drivers do first
        const std::vector constants{ on(round % 2 == 0), mode(round % 3) };
        const Words out = foldConstants(damaged, constants);
        EXPECT_TRUE(std::equal(damaged.begin(), damaged.begin() + 5, out.begin())) << "the header stays";
        EXPECT_EQ(foldConstants(damaged, constants), out) << "the same twice: nothing beyond the words is read";
        ++tried;
    }
    EXPECT_GT(tried, 1000);
}

} // namespace
} // namespace filament_core::backend::vulkan
