// SPDX-License-Identifier: Apache-2.0
/// The engine's own materials, compiled by the build and part of the program (library engine_materials).
///   Names   the .mat files of shaders/material and shaders/post: "gltf_lit_opaque", "skybox", "tonemap", ...
///   Thread  any. Memory: read-only data of the program.
///   Fails   an unknown name gives an empty span.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace filament::shader {

/// The bytes of a package, for readPackage().
std::span<const std::byte> engineMaterial(std::string_view name);

/// All names, ascending.
std::span<const std::string_view> engineMaterialNames();

} // namespace filament::shader
