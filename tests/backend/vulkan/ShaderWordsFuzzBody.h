// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: whatever the words of a shader are, the Vulkan backend refuses them, or
/// rewrites them as Program.cpp does: constants are folded, and conditions on uniforms hidden. The result is the same
/// twice, and consists of whole instructions behind a header.
#pragma once

#include "backend/vulkan/FoldConstants.h"
#include "backend/vulkan/Spirv.h"
#include "backend/vulkan/UniformConditions.h"
#include "base/Assert.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace filament_core::backend::vulkan {

/// A shader as this fuzzer's files hold it, in words: the stage in bit 0 and the number of constants in bits 8 to 13;
/// the id and the bits of each constant; the module.
struct ShaderWords {
    ShaderStage stage = ShaderStage::Vertex;
    std::vector<ConstantValue> constants;
    std::vector<uint32_t> module;
};

/// Bytes after the last whole word are left out.
inline ShaderWords readShaderWords(std::span<const uint8_t> bytes) {
    std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
    if (words.empty()) return {};
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
    ShaderWords shader{ .stage = words[0] & 1 ? ShaderStage::Fragment : ShaderStage::Vertex };
    size_t at = 1;
    for (uint32_t left = words[0] >> 8 & 63; left > 0 && at + 2 <= words.size(); --left, at += 2)
        shader.constants.push_back({ .id = words[at], .bits = words[at + 1], .type = {} });
    shader.module.assign(words.begin() + static_cast<ptrdiff_t>(at), words.end());
    return shader;
}

inline void checkWholeInstructions(std::span<const uint32_t> before, std::span<const uint32_t> words) {
    constexpr size_t kHeader = 5, kBound = 3;
    FILAMENT_ASSERT(words.size() >= kHeader, "the header stays");
    for (size_t i = 0; i < kHeader; ++i)
        FILAMENT_ASSERT(words[i] == before[i] || (i == kBound && words[i] > before[i]), "only ids are added");
    for (size_t at = kHeader; at < words.size(); at += words[at] >> 16) {
        const size_t count = words[at] >> 16;
        FILAMENT_ASSERT(count > 0 && count <= words.size() - at, "instructions are whole");
    }
}

/// Returns whether the words are accepted.
inline bool fuzzShaderWords(std::span<const uint8_t> input) {
    const ShaderWords shader = readShaderWords(input);
    const auto edges = readEdges(shader.module, shader.stage);
    if (!edges) {
        FILAMENT_ASSERT(edges.error().code == ErrorCode::Corrupt, "what is refused is corrupt");
        FILAMENT_ASSERT(!edges.error().message.empty(), "a refusal says why");
        return false;
    }
    const std::vector<uint32_t> folded = foldConstants(shader.module, shader.constants);
    checkWholeInstructions(shader.module, folded);
    FILAMENT_ASSERT(folded.size() <= 4 * shader.module.size(), "no block is written twice");
    FILAMENT_ASSERT(folded == foldConstants(shader.module, shader.constants), "nothing beyond the words is read");
    const std::vector<uint32_t> hidden = hideUniformConditions(folded, shader.stage);
    checkWholeInstructions(folded, hidden);
    FILAMENT_ASSERT(hidden == folded || hidden.size() > folded.size(), "words are only added");
    return true;
}

} // namespace filament_core::backend::vulkan
