// SPDX-License-Identifier: Apache-2.0
// Conditions that uniforms take part in are hidden, others stay; modules stay valid, also with damaged words.
#include "backend/vulkan/UniformConditions.h"

#include "backend/vulkan/Spirv.h"
#include "tests/backend/vulkan/ShaderText.h"

#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include <random>

namespace filament_core::backend::vulkan {
namespace {

constexpr uint32_t kLogicalAnd = 167, kSelect = 169;

size_t countOf(std::vector<uint32_t> const& words, uint32_t op) {
    size_t count = 0;
    for (size_t at = 5; at < words.size(); at += words[at] >> 16) count += (words[at] & 0xffff) == op;
    return count;
}

/// How many conditions are hidden; the new module is valid.
size_t hiddenIn(ShaderStage stage, std::string const& text, uint32_t op = kLogicalAnd) {
    const std::vector<uint32_t> words = spirvFromGlsl(stage, text);
    const std::vector<uint32_t> hidden = hideUniformConditions(words, stage);
    std::string messages;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    tools.SetMessageConsumer(
            [&](spv_message_level_t, const char*, spv_position_t const&, const char* message) { messages += message; });
    EXPECT_TRUE(tools.Validate(hidden)) << messages;
    EXPECT_TRUE(readEdges(hidden, stage));
    EXPECT_TRUE(hidden.size() > words.size() || hidden == words);
    return countOf(hidden, op) - countOf(words, op);
}

constexpr const char* kHead = R"(
    layout(set = 0, binding = 0) uniform Block { vec4 a; int n; vec4 many[4]; } u;
    layout(location = 0) in vec4 v;
    layout(location = 0) out vec4 color;
)";

std::string withBody(std::string_view body) {
    return std::string(kHead) + "void main() { color = v; " + std::string(body) + " }";
}

TEST(UniformConditions, ThoseThatUniformsDecideAloneAreHidden) {
    const auto fragment = [](std::string_view body) { return hiddenIn(ShaderStage::Fragment, withBody(body)); };
    EXPECT_EQ(fragment("if (u.a.x > 0.0) color.x += 1.0;"), 1u);
    EXPECT_EQ(fragment("if (dot(u.a, vec4(1.0, 2.0, 3.0, 4.0)) > u.many[u.n].y) color.x += 1.0;"), 1u);
    EXPECT_EQ(fragment("float x = u.a.x; if (u.n > 3) x *= 2.0; if (x > 1.0) color.x += 1.0;"), 2u);
    EXPECT_EQ(fragment("for (int i = 0; i < u.n; ++i) color.x += v[i];"), 1u);
    EXPECT_EQ(fragment("if (sin(u.a.x) > 0.5) { if (u.a.y > 0.0) color.x += 1.0; else color.y = 1.0; }"), 2u);
    EXPECT_EQ(hiddenIn(ShaderStage::Fragment,
                       withBody("switch (u.n) { case 1: color.x = 1.0; break; default: color.y = 1.0; }"), kSelect),
              1u);
}

TEST(UniformConditions, ThoseThatMixUniformsWithWhatVariesAreHidden) {
    const auto fragment = [](std::string_view body) { return hiddenIn(ShaderStage::Fragment, withBody(body)); };
    EXPECT_EQ(fragment("if (v.x * u.a.x > 0.0) color.x += 1.0;"), 1u);
    EXPECT_EQ(fragment("if (u.a.x > 0.0 && v.x > 0.0) color.x += 1.0;"), 2u) << "two branches";
    EXPECT_EQ(fragment("float x = u.a.x; if (v.y > 3.0) x = v.x; if (x > 1.0) color.x += 1.0;"), 1u);
}

TEST(UniformConditions, OthersStay) {
    const auto fragment = [](std::string_view body) { return hiddenIn(ShaderStage::Fragment, withBody(body)); };
    EXPECT_EQ(fragment(""), 0u);
    EXPECT_EQ(fragment("if (v.x > 0.0) color.x += 1.0;"), 0u);
    EXPECT_EQ(fragment("for (int i = 0; i < 4; ++i) color.x += v[i];"), 0u) << "compilers unroll it";
    EXPECT_EQ(fragment("float x = v.x; if (v.y > 3.0) x = 2.0; if (x > 1.0) color.x += 1.0;"), 0u);
}

TEST(UniformConditions, EveryStageAndFunctionHasATruthOfItsOwn) {
    const std::string vertex = std::string(kHead) + R"(
        float of(float x) { if (u.a.w > 2.0) return x * 2.0; return x; }
        void main() { color = v; if (u.a.x > 0.0) color.x = of(v.x); gl_Position = v; })";
    EXPECT_EQ(hiddenIn(ShaderStage::Vertex, vertex), 2u);
    EXPECT_EQ(hiddenIn(ShaderStage::Fragment,
                       withBody("if (u.a.x > gl_FragCoord.x) color.x = 1.0; if (u.a.x > 0.0) color.y = 1.0;")),
              2u)
            << "the variable that is there is used";
    EXPECT_EQ(hiddenIn(ShaderStage::Vertex,
                       std::string(kHead) +
                               "void main() { color = v * float(gl_VertexIndex); if (u.n > 2) color.x = 0.0; "
                               "gl_Position = v; }"),
              1u);
}

TEST(UniformConditions, DamagedModulesCrashNothing) {
    std::mt19937 random(7);
    int rewritten = 0;
    const std::vector<uint32_t> whole =
            spirvFromGlsl(ShaderStage::Fragment,
                          withBody("for (int i = 0; i < u.n; ++i) { if (u.many[i].x > 0.5) color.x += v[i]; }"));
    for (int i = 0; i < 20'000; ++i) {
        std::vector<uint32_t> words = whole;
        for (int changes = 1 + static_cast<int>(random() % 3); changes > 0; --changes)
            words[random() % words.size()] = static_cast<uint32_t>(random() % 3 ? random() % 300 : random());
        if (random() % 4 == 0) words.resize(random() % words.size());
        if (!readEdges(words, ShaderStage::Fragment)) continue;
        const std::vector<uint32_t> hidden = hideUniformConditions(words, ShaderStage::Fragment);
        EXPECT_TRUE(hidden == words || hidden.size() > words.size()) << "words are only added";
        ++rewritten;
    }
    EXPECT_GT(rewritten, 1000);
}

} // namespace
} // namespace filament_core::backend::vulkan
