// SPDX-License-Identifier: Apache-2.0
/// The words that GLSL 4.50 and ESSL 3.10 use or reserve: keywords, types, qualifiers. Thread: any.
#pragma once

#include <span>
#include <string_view>

namespace filament_core::shader {

/// Sorted. Types of vectors, matrices, samplers and images among them.
std::span<const std::string_view> glslKeywords();
bool isGlslKeyword(std::string_view word);

} // namespace filament_core::shader
