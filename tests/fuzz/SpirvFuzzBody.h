// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: whatever words of a module are changed, checkSpirv() accepts the package
/// or names the reason; the same twice.
#pragma once

#include "base/Assert.h"
#include "filament_core/engine/materials/CheckSpirv.h"
#include "shaders/package/EngineMaterials.h"
#include "tests/shaders/EditStage.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace filament_core::engine::test {

/// Input: one byte for the stage and the variant, then edits of 8 bytes: which word, and its new value. Returns whether
/// the package is accepted.
inline bool fuzzSpirv(std::span<const uint8_t> input) {
    static const shader::MaterialPackage original = *shader::readPackage(shader::engineMaterial("skybox"));
    if (input.empty()) return false;
    shader::MaterialPackage package = original;
    shader::Variant& variant = package.variants[input[0] / 2 % package.variants.size()];
    std::vector<uint32_t>& words = shader::test::editable(input[0] % 2 == 0 ? variant.vertex : variant.fragment).spirv;
    for (input = input.subspan(1); input.size() >= 8; input = input.subspan(8)) {
        uint32_t edit[2];
        std::memcpy(edit, input.data(), sizeof edit);
        words[edit[0] % words.size()] = edit[1];
    }
    if (!input.empty()) words.resize(std::min<size_t>(words.size(), input[0])); // cut short
    const Result<void> checked = checkSpirv(package);
    FILAMENT_ASSERT(checked.ok() || checked.error().code == ErrorCode::Corrupt, "what is refused is corrupt");
    FILAMENT_ASSERT(checked.ok() || !checked.error().message.empty(), "a refusal says why");
    FILAMENT_ASSERT(checkSpirv(package).ok() == checked.ok(), "checking twice gives the same answer");
    return checked.ok();
}

} // namespace filament_core::engine::test
