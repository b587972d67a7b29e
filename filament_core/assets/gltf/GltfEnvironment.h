// SPDX-License-Identifier: Apache-2.0
/// GltfEnvironment: the image-based light of the default scene (EXT_lights_image_based), as a CubeLight.
///   In      a document whose buffers are loaded.
///   Out     radiance times the light's intensity, in the levels that the file has.
///   Images  a PNG with alpha is RGBD: radiance is colour / alpha, without a transfer curve. Others are sRGB.
///   Space   the extension's faces form a left-handed cube, as cube maps of every API do, and the bottom row of a
///           image is the one that the APIs' tables call the first (README of the extension: "flipped"). The cube's z
///           is turned round to make it right-handed: right, up and forward of a viewer in the cube are +X, +Y and -Z,
///           those of a camera of glTF. The light's rotation turns the result. Irradiance coefficients are in the
///           cube's space, too. glTF's direction of a point (s, t) of face f, both from -1 to 1, s to the right and t
///           down, before rotation:
///             +X ( 1, t,  s)   -X (-1, t, -s)   +Y (s, 1,  t)   -Y (s, -1, -t)   +Z (s, t, -1)   -Z (-s, t, 1)
///   Coefficients  of irradiance: with the cosine lobe, without the constants of the basis, which is the real one
///           without a phase: Y(1, -1) = +0.4886 y. A sky of radiance 1 has (pi * sqrt(4 pi), 0, ...).
///   Thread  decodeFace(): any, one call per face, all in parallel. The rest: one.
///   Memory  16 bytes per texel.  Limits: 2048 texels per side.
///   Fails   through the diagnostics, with the path of the field and the cure. Pixels with alpha 0 are black, with a
///           warning.
#pragma once

#include "filament_core/assets/environment/CubeLight.h"
#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfImages.h"

#include <optional>
#include <vector>

namespace filament_core::assets {

inline constexpr uint32_t kMaxCubeSize = 2048;
inline constexpr float kMaxImageIntensity = 1e9f;
/// Of a coefficient: more than any sky of kMaxRadiance has.
inline constexpr double kMaxIrradiance = 1e17;

/// The constants of the nine functions of the basis, in the order of shaders/lib/ibl.glsl.
extern const std::array<double, 9> kHarmonicConstants;

struct GltfFaceJob {
    GltfImageSource source{}; ///< read with readImage()
    uint32_t level = 0, face = 0;
    Diagnostics diagnostics{};
};

struct GltfEnvironment {
    CubeLight light;
    std::vector<GltfFaceJob> faces; ///< none: the default scene names no light
};

GltfEnvironment planEnvironment(GltfDocument const& document);

/// An error for images that contradict the light; nothing is decoded yet.
void checkFaces(GltfDocument const& document, GltfEnvironment const& environment, Diagnostics& diagnostics);

/// Fills in one face of one level.
void decodeFace(GltfDocument const& document, GltfFaceJob& job, CubeLight& light);

/// After all faces: what looks across their edges.
std::optional<ImageBasedLightData> finishEnvironment(GltfDocument const& document, GltfEnvironment environment);

} // namespace filament_core::assets
