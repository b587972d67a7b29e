// SPDX-License-Identifier: Apache-2.0
/// The engine's own GLSL, built into the compiler so that matc needs no files at run time.
///   The implementation is written by shaders/CMakeLists.txt. Thread: any.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace filament_core::shader {

/// `path` from the repository root: "shaders/lib/brdf.glsl". Nothing if there is no such file.
std::optional<std::string_view> embeddedSource(std::string_view path);

/// All of them, in the order of their names.
std::vector<std::string_view> embeddedPaths();

} // namespace filament_core::shader
