// SPDX-License-Identifier: Apache-2.0
/// The engine's own materials, compiled by the build and part of the program (library engine_materials).
///   Names   the .mat files of shaders/material and shaders/post: "gltf_lit_opaque", "skybox", "tonemap", ...
///   Thread  any. Memory: read-only data of the program.
///   Fails   an unknown name gives an empty span.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace filament::shader {

enum class Arithmetic : uint8_t {
    Exact, ///< written out, so that both APIs compute the same bits (shaders/compiler/ExactLowering.h)
    Plain, ///< left to the drivers
};

/// The bytes of a package, for readPackage().
std::span<const std::byte> engineMaterial(std::string_view name, Arithmetic arithmetic = Arithmetic::Exact);

/// All names, ascending.
std::span<const std::string_view> engineMaterialNames();

} // namespace filament::shader
