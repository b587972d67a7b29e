// SPDX-License-Identifier: Apache-2.0
/// Mutations: named defects, injected into the command stream of one engine. A comparison of images must detect each
/// of them; otherwise it proves nothing. The engine has no code for them.
///   Controls "none" changes nothing, and "oneList" nothing that an image may show; they must not be detected. The
///            first shows that the detections are real, the second that froxels miss no light.
///   Limits   some edit the code of one API (Mutation::api) and are injected into the engine of that API.
///   Fails    an unknown name gives none, and mutationNames() lists the known ones.
#pragma once

#include "backend/layers/Captured.h"

#include <filament_core/Backend.h>

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::tools {

struct Mutation {
    std::string_view name;
    std::string_view what; ///< for the report
    std::unique_ptr<backend::StreamEdit> (*make)();
    std::optional<Backend> api{}; ///< the one whose shaders it edits; none: it edits what all have

    bool fits(Backend backend) const { return !api || *api == backend; }
};

std::span<const Mutation> mutations();
Mutation const* findMutation(std::string_view name);
std::vector<std::string_view> mutationNames();
inline constexpr std::string_view kNoDefect = "none", kOneList = "oneList"; ///< the controls
bool isControl(std::string_view name);

inline constexpr uint32_t kSmallestLevel = ~0u;
/// Makes the red code of texel `texel` (counted by rows) of mip level `level` one off, in every RGBA8 texture that has
/// it.
std::unique_ptr<backend::StreamEdit> mipTexelEdit(uint32_t level, uint32_t texel);

/// Adds `bias` to the level of every implicit texture fetch of a SPIR-V module.
std::vector<uint32_t> withMipBias(std::span<const uint32_t> module, float bias);

} // namespace filament_core::tools
