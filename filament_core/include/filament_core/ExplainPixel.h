// SPDX-License-Identifier: Apache-2.0
/// explainPixel(): why a pixel has its colour: light by light, effect by effect, lobe by lobe, texture by texture, and
/// the surface that it shows.
/// docs/shares.md, "One pixel".
///   Sum     terms in doubles add up to the half floats of the pixel exactly, before tone mapping (Shares.h).
///   Thread  the app thread, which waits for the pixels. Not while a frame is drawn.
///   Memory  a few hundred bytes; what renderers take is given back.
///   Cost    a frame for each term and lobe, four for each texture, one for each number of the surface and each id, and
///           a pick. Other frames: none.
#pragma once

#include <filament_core/Aov.h>
#include <filament_core/Shares.h>

#include <optional>
#include <string>
#include <vector>

namespace filament_core {

struct PixelTerm {
    ShareTerm term;
    double4 value{ 0 }; ///< red, green, blue, alpha; pre-exposed linear light
};

/// The light of the surface's own material by lobe: "specular", which has with it whatever is not of this surface (fog,
/// bloom, what lies before it), or "rest" if the material is unlit; then what each further lobe adds: "diffuse",
/// "diffuseTransmission", "transmission", "sheen", "clearCoat", "iridescence", "emission". "baseColor" is in the place
/// of "diffuse" where metal is a share of the surface; all that metal reflects is specular. "all": it has none.
struct PixelLobe {
    std::string name;
    double4 value{ 0 }; ///< as of PixelTerm; a layer that dims what is below it may be negative
};

/// What a texture of the surface's material instance changes: the light with it, less that with a neutral one in its
/// place, which is white: 1 for what a texture multiplies, a flat normal in a parameter whose name ends with normalMap
/// or NormalMap, no direction in "anisotropyMap", and black in "lightMap". The first has no parameter: the light
/// without any; then each further one in the order of the material's parameters.
struct PixelTexture {
    std::string parameter{}; ///< "baseColorMap"
    std::string texture{};   ///< its name, may be empty
    uint2 size{ 0 };         ///< texels of its finest level on the device
    double4 value{ 0 };      ///< as of PixelTerm
    /// Where the shader reads it at the pixel's centre, and what it reads there: filtered, linear, red, green and blue.
    /// Of glTF materials and the textured built-in ones; missing where the mesh has no such coordinates, and `uv` of
    /// the second set.
    std::optional<float2> uv{};
    std::optional<float3> texel{};
};

/// Of the nearest surface at the pixel's centre. Numbers that its material does not have are missing.
struct PixelSurface {
    Renderable renderable{}; ///< none: a light that is drawn
    Light light{};
    std::string object;        ///< name of the nearest node with a name, upwards; may be empty
    uint32_t primitive = 0;    ///< as in PickHit
    std::string material;      ///< name of the material's file
    std::string instance;      ///< name of the material instance
    double distanceMeters = 0; ///< along the view
    double3 positionWorld{ 0 };
    std::optional<float3> normal, geometricNormal; ///< in the world, unit
    std::optional<float3> baseColor;               ///< linear Rec. 709; pre-multiplied by alpha where it blends
    std::optional<float> roughness, metallic, occlusion;
    std::optional<float3> emissive;                                               ///< pre-exposed
    std::optional<uint32_t> objectId, materialId, materialInstanceId, triangleId; ///< as those of Aov
};

struct PixelExplanation {
    uint2 pixel{ 0 };
    double4 value{ 0 }; ///< of the picture: the sum of the terms
    std::vector<PixelTerm> terms;
    std::vector<PixelLobe> lobes;        ///< their sum is `value`, too; empty without a renderable
    std::vector<PixelTexture> textures;  ///< their sum is `value`, too; empty if its material instance has none
    std::optional<PixelSurface> surface; ///< none: nothing is drawn there
};

/// `pixel`: from the left and from the top of the view, below View::size. By default light by light, then effect by
/// effect. The view is as renderShares() takes it, and fails as there.
Result<PixelExplanation> explainPixel(Engine& engine, Scene const& scene, View const& view, uint2 pixel,
                                      ShareOptions const& options = { .terms = ShareTerms::All });

/// One object; docs/shares.md has its members. Infinities and NaN are null.
std::string toJson(PixelExplanation const& explanation);

} // namespace filament_core
