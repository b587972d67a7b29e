// SPDX-License-Identifier: Apache-2.0
/// Text about a package (Package.h), for people. Thread: any.
#pragma once

#include "shaders/package/Package.h"

#include <string>

namespace filament_core::matinfo {

/// Head, parameters, constants, terms, and a row of sizes and operations for each variant.
std::string describe(shader::MaterialPackage const& package, size_t fileBytes);

enum class Stage : uint8_t { Vertex, Fragment };
enum class Language : uint8_t { Essl, Spirv }; ///< SPIR-V is disassembled

/// The text of a stage. Fails: NotFound if the package has no such variant, or not in that language.
Result<std::string> codeOf(shader::MaterialPackage const& package, uint32_t key, Stage stage, Language language);

/// "0 (no lights)", "3 (directionalLighting dynamicLighting)"
std::string variantName(uint32_t key);

} // namespace filament_core::matinfo
