// SPDX-License-Identifier: Apache-2.0
/// The engine's own GLSL, built into the compiler so that matc needs no files at run time.
///   The implementation is written by shaders/CMakeLists.txt. Thread: any.
#pragma once

#include <optional>
#include <string_view>

namespace filament::shader {

/// `path` from the repository root: "shaders/lib/brdf.glsl". Nothing if there is no such file.
std::optional<std::string_view> embeddedSource(std::string_view path);

} // namespace filament::shader
