// SPDX-License-Identifier: Apache-2.0
/// Environment packages: all that lights a scene, already baked, in one KTX 2.0 file. Any KTX 2.0 program can show its
/// texture, and zlib or Zstandard may compress it. Private to this folder; docs/environments.md describes the layout.
///   texture                     EnvironmentData::specular, with one level for each roughness
///   filament.environment        the version of this layout: "1"; "2" with lights
///   filament.roughnessMapping   "quadratic", "logarithmic" or "linear"
///   filament.irradianceSh       27 numbers: nine coefficients of red, green and blue (shaders/lib/ibl.glsl)
///   filament.irradiance         a KTX 2.0 file: the irradiance cube; may be missing
///   filament.skybox             a KTX 2.0 file: the background
///   filament.picture            EnvironmentStatistics of the panorama: nine numbers
///   filament.lights             42 numbers (LightNumbers.h): what was taken out of the light; with layout "2"
///   Formats RGBA16F, R11G11B10F, RGB9E5 and RGBA8, which means RGBM; irradiance is RGBA16F. Texts are ASCII.
///   Thread  pure functions.
///   Limits  2048 texels per side of a face, a power of two.
///   Fails   decode: Corrupt or Unsupported for any invalid bytes: one line with file, place and cure. Lengths are
///           checked before memory is allocated; texels that are negative or no finite numbers are refused.
#pragma once

#include "filament_core/assets/environment/Environment.h"
#include "filament_core/assets/image/Ktx2File.h"

#include <string_view>
#include <vector>

namespace filament_core::assets {

/// Whether a KTX 2.0 file claims to be such a package.
bool isEnvironmentPackage(Ktx2File const& file);

/// `data` is not turned: worldFromCube is the identity, which is a rule for the caller.
std::vector<std::byte> encodeEnvironmentPackage(EnvironmentData const& data);

/// `file` claims to be a package; `name` is that of its file.
Result<EnvironmentData> decodeEnvironmentPackage(Ktx2File const& file, std::string_view name);

} // namespace filament_core::assets
