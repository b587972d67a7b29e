// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Spirv.h"
#include "tests/backend/vulkan/ShaderText.h"

#include <gtest/gtest.h>

#include <random>

namespace filament_core::backend::vulkan {
namespace {

TEST(Spirv, FindsVertexInputsWithTheirTypesAndIgnoresBuiltIns) {
    const auto words = spirvFromGlsl(ShaderStage::Vertex, R"(
        layout(location = 2) in vec3 a;
        layout(location = 0) in ivec4 b;
        layout(location = 15) in uint c;
        layout(location = 0) out vec4 color;
        void main() { gl_Position = vec4(a, float(b.x) + float(c)) + float(gl_VertexIndex); color = vec4(1.0); })");
    const auto edges = readEdges(words, ShaderStage::Vertex);
    ASSERT_TRUE(edges) << edges.error().message;
    EXPECT_EQ(edges->inputs,
              (std::vector<ShaderInput>{ { 0, ScalarKind::Int }, { 2, ScalarKind::Float }, { 15, ScalarKind::UInt } }));
}

TEST(Spirv, CountsALocationPerMatrixColumnAndArrayElement) {
    const auto words = spirvFromGlsl(ShaderStage::Vertex, R"(
        layout(location = 1) in mat3 m;
        layout(location = 6) in vec2 uv[2];
        void main() { gl_Position = vec4(m * vec3(uv[0], uv[1].x), 1.0); })");
    const auto edges = readEdges(words, ShaderStage::Vertex);
    ASSERT_TRUE(edges);
    std::vector<uint32_t> locations;
    for (ShaderInput const& input : edges->inputs) locations.push_back(input.location);
    EXPECT_EQ(locations, (std::vector<uint32_t>{ 1, 2, 3, 6, 7 }));
}

TEST(Spirv, FindsTheFragmentOutputsThatAreWritten) {
    const auto words = spirvFromGlsl(ShaderStage::Fragment, R"(
        layout(location = 0) out vec4 a;
        layout(location = 3) out uint b;
        void main() { a = vec4(0.0); b = 1u; })");
    const auto edges = readEdges(words, ShaderStage::Fragment);
    ASSERT_TRUE(edges);
    EXPECT_EQ(edges->outputMask, 0b1001u);
}

TEST(Spirv, RefusesAModuleOfAnotherStage) {
    const auto words = spirvFromGlsl(ShaderStage::Vertex, "void main() { gl_Position = vec4(0.0); }");
    const auto edges = readEdges(words, ShaderStage::Fragment);
    ASSERT_FALSE(edges);
    EXPECT_EQ(edges.error().code, ErrorCode::Corrupt);
}

TEST(Spirv, RefusesWhatIsNotAModule) {
    EXPECT_FALSE(readEdges({}, ShaderStage::Vertex));
    const std::vector<uint32_t> zeros(64, 0), hugeBound{ 0x07230203, 0x10300, 0, 0xFFFFFFFF, 0 };
    EXPECT_FALSE(readEdges(zeros, ShaderStage::Vertex));
    EXPECT_FALSE(readEdges(hugeBound, ShaderStage::Vertex));
}

TEST(Spirv, SurvivesEveryTruncationAndRandomDamage) {
    const auto words = spirvFromGlsl(ShaderStage::Vertex, R"(
        layout(location = 1) in mat3 m;
        layout(location = 6) in vec2 uv[2];
        void main() { gl_Position = vec4(m * vec3(uv[0], uv[1].x), 1.0); })");
    for (size_t size = 0; size < words.size(); ++size) {
        (void)readEdges(std::span(words).first(size), ShaderStage::Vertex); // some prefixes are modules
    }
    std::mt19937 random(3);
    uint32_t refused = 0;
    for (int round = 0; round < 5'000; ++round) {
        std::vector<uint32_t> damaged = words;
        for (int hit = 0; hit < 4; ++hit)
            damaged[random() % damaged.size()] = static_cast<uint32_t>(random() >> (random() % 32));
        const auto edges = readEdges(damaged, ShaderStage::Vertex);
        refused += !edges;
        if (edges) {
            EXPECT_LE(edges->inputs.size(), 32u);
        }
    }
    EXPECT_GT(refused, 500u);
}

} // namespace
} // namespace filament_core::backend::vulkan
