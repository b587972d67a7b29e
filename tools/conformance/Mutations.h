// SPDX-License-Identifier: Apache-2.0
/// Mutations: named defects, put into the command stream of one engine. What compares pictures must notice each of
/// them; if it does not, it proves nothing. No code of the engine knows of them.
///   Identity "none" changes nothing and must not be noticed: it shows that the others are.
///   Limits   "mipBias" edits SPIR-V: Vulkan only.
///   Fails    an unknown name gives none, and mutationNames() says which there are.
#pragma once

#include "backend/layers/Captured.h"

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace filament::conformance {

struct Mutation {
    std::string_view name;
    std::string_view what; ///< for the report
    std::unique_ptr<backend::StreamEdit> (*make)();
};

std::span<const Mutation> mutations();
Mutation const* findMutation(std::string_view name);
std::vector<std::string_view> mutationNames();

/// Adds `bias` to the level of every implicit texture fetch of a SPIR-V module.
std::vector<uint32_t> withMipBias(std::span<const uint32_t> module, float bias);

} // namespace filament::conformance
