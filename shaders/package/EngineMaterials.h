// SPDX-License-Identifier: Apache-2.0
/// The engine's own materials, compiled by the build and part of the program (library engine_materials).
///   Names   the .mat files of shaders/material and shaders/post: "gltf_lit_opaque", "skybox", "tonemap", ...
///   Exact   their arithmetic is written out, so that both APIs compute the same bits
///           (shaders/compiler/ExactLowering.h). Programs that measure what this costs compile the same materials with
///           the arithmetic left to the drivers (toolkit/materials/PlainMaterials.h); the library does not contain
///           those.
///   Thread  any. Memory: read-only data of the program.
///   Fails   an unknown name gives an empty span.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::shader {

/// The bytes of a package, for readPackage().
std::span<const std::byte> engineMaterial(std::string_view name);

/// A file of a compute stage of shaders/compute: "fog_light.spv" (SPIR-V) or "fog_light.essl".
std::span<const std::byte> engineDispatch(std::string_view file);

/// Keeps a package of an engine material that this program compiled itself until the program ends.
std::span<const std::byte> keepEnginePackage(std::vector<std::byte> package);

/// Whether the bytes are part of an engine material or of a kept package: their code need not be checked.
bool isEnginePackage(std::span<const std::byte> bytes);

/// All names, ascending.
std::span<const std::string_view> engineMaterialNames();

} // namespace filament_core::shader
