// SPDX-License-Identifier: Apache-2.0
/// GltfParseMaterial: shared by the parsers of materials and of their extensions.
///   Fails   through the diagnostics of the node.
#pragma once

#include "filament_core/assets/files/JsonTree.h"
#include "filament_core/assets/gltf/GltfParse.h"

#include <algorithm>
#include <array>
#include <limits>

namespace filament_core::assets {

inline constexpr float kMaxFloat = std::numeric_limits<float>::max();

GltfTextureInfo parseTextureInfo(JsonNode const& node, size_t textureCount);

/// Components outside [low, high] are clamped, with one warning.
template <size_t N>
std::array<float, N> parseFactors(JsonNode const& node, double fallback, double low, double high) {
    std::array<double, N> values;
    values.fill(fallback);
    node.numbers(values);
    std::array<float, N> factors;
    for (size_t i = 0; i < N; ++i) {
        const double clamped = std::clamp(values[i], low, high);
        if (clamped != values[i]) {
            node.diagnostics().warn("{}: {} is outside [{}, {}] and was clamped", node.path(), values[i], low, high);
        }
        factors[i] = static_cast<float>(clamped);
    }
    return factors;
}

/// Parses material.extensions except the emissive strength. Combinations that the specifications forbid are dropped,
/// with a warning.
void parseMaterialExtensions(JsonNode const& node, size_t textureCount, GltfMaterial& material);

} // namespace filament_core::assets
