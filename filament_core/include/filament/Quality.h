// SPDX-License-Identifier: Apache-2.0
/// Quality: every approximation of the shading that has an alternative, as a named choice. A plain value, part of View:
/// it may change every frame. docs/quality.md says what each value computes.
///   Default  what the engine draws unless told otherwise; the choices that differ from it cost a program each, made
///            when first drawn.
///   Names    the fields' own names and the enumerators in lower camel case: "specularVisibility=fast". They are the
///            words of filament-render --set and of the accuracy tables.
///   Thread   any.   Fails: setQuality() and qualityPresetFromName(): the name that is not known, with the nearest one.
///   Load-time choices are options of loadEnvironment() and loadGltf().
#pragma once

#include <filament/Result.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace filament {

/// Masking and shadowing of microfacets.
enum class SpecularVisibility : uint8_t {
    Correlated,   ///< height-correlated Smith, Heitz 2014
    Fast,         ///< the same without square roots, Hammon 2017: a few per cent too dark between smooth and rough
    Uncorrelated, ///< separable Smith, Walter et al. 2007: darker at grazing angles
};

/// Reflectance of one microfacet, under suns and punctual lights. The split sum is built on Schlick's term.
enum class FresnelTerm : uint8_t {
    Schlick, ///< Schlick 1994
    Exact,   ///< Fresnel's equations; metals by Gulbrandsen 2014 with a white edge
};

/// The diffuse lobe under suns and punctual lights.
enum class DiffuseTerm : uint8_t {
    Lambert,
    Disney, ///< Burley 2012, normalised as in Lagarde and de Rousiers 2014
};

/// The second factor of the split sum: the directional albedo of the specular lobe.
enum class SplitSum : uint8_t {
    Table,    ///< of Quality::dfgTableSize^2 texels
    Analytic, ///< the fit of Karis 2014: no texture
};

/// Where the diffuse light of the environment comes from.
enum class DiffuseIrradiance : uint8_t {
    SphericalHarmonics, ///< Quality::shBands bands
    LastSpecularLevel,  ///< roughness 1 of the specular environment: no coefficients, a GGX lobe instead of a cosine
    Cube,               ///< a small cube map of irradiance: no bands cut off; the coefficients where a light has none
};

/// Which mip level of a specular environment holds which roughness: chosen when it is loaded. n is the last level.
enum class RoughnessMapping : uint8_t {
    Quadratic,   ///< n r (2 - r), r the perceptual roughness: most levels for rough surfaces
    Logarithmic, ///< n + log2(r^2), from 0 on: every level twice as wide a lobe
    Linear,      ///< n r
};

/// How vertex positions of a glTF file are stored: chosen when it is loaded.
enum class PositionStorage : uint8_t {
    AsAuthored, ///< floats, or the integers of a file that is quantised already
    Half,       ///< 11 bits relative to the origin of each mesh
    Unorm16,    ///< 16 bits within the bounding cube of each primitive; a node of the model scales them back
};

/// How tangent frames of a glTF file are stored: a quaternion a vertex, chosen when it is loaded.
enum class TangentStorage : uint8_t {
    Snorm16, ///< 4 x 16 bits: 0.003 degrees off
    Snorm8,  ///< 4 x 8 bits: up to a degree off
    Float,
};

/// Of the lighting of lit materials: what their own code computes keeps 32 bits. Materials that were compiled without
/// halfPrecision, and devices without 16-bit floats, are lit in Full.
enum class ShadingPrecision : uint8_t {
    Full, ///< 32 bits
    Half, ///< 16 bits: roughness from 0.089 on; the two APIs may round differently
};

/// Samplers of materials; those of the environment stay.
enum class TextureFilter : uint8_t {
    AsAuthored,  ///< as the material's textures were set
    Bilinear,    ///< the nearest mip level
    Trilinear,   ///< between mip levels
    Anisotropic, ///< trilinear along up to 16 probes
};

enum class DepthRange : uint8_t {
    Reversed, ///< near 1, infinity 0: a float's exponent makes up for the perspective
    Ordinary, ///< near 0, infinity 1: the same compare the other way round, z-fights in the distance
};

/// How the tone mapper of View::colorGrading reaches the picture, with the transfer function of the display.
enum class ToneMapping : uint8_t {
    Analytic, ///< its formula, every pixel
    Table16,  ///< a cube of 16 colours a side over the logarithm of light, interpolated: any grading at one price
    Table32,
    Table64,
};

enum class QualityPreset : uint8_t {
    Low,       ///< the cheapest of everything
    Medium,    ///< what a phone affords
    High,      ///< the default of Quality
    Reference, ///< the most exact of everything
};

struct Quality {
    SpecularVisibility specularVisibility = SpecularVisibility::Correlated;
    FresnelTerm fresnel = FresnelTerm::Schlick;
    DiffuseTerm diffuse = DiffuseTerm::Lambert;
    bool energyCompensation = true; ///< returns what rough metals lose by counting one bounce only
    bool diffuseCoupling = true;    ///< lights give the diffuse lobe only what the specular lobe leaves of them
    SplitSum splitSum = SplitSum::Table;
    uint16_t dfgTableSize = 64; ///< texels a side, [16, 256]
    DiffuseIrradiance diffuseIrradiance = DiffuseIrradiance::SphericalHarmonics;
    uint8_t shBands = 3; ///< [1, 3]: 1, 4 or 9 coefficients
    ShadingPrecision shadingPrecision = ShadingPrecision::Full;
    TextureFilter textureFilter = TextureFilter::AsAuthored;
    ToneMapping toneMapping = ToneMapping::Analytic;
    DepthRange depthRange = DepthRange::Reversed;
    /// Positions reach the shaders relative to the camera, subtracted in double precision. Off: as absolute floats,
    /// which the vertex shader subtracts, as engines with a float world do.
    bool cameraRelative = true;
    friend bool operator==(Quality const&, Quality const&) = default;
};

const char* toString(SpecularVisibility value);
const char* toString(FresnelTerm value);
const char* toString(DiffuseTerm value);
const char* toString(SplitSum value);
const char* toString(DiffuseIrradiance value);
const char* toString(RoughnessMapping value);
const char* toString(PositionStorage value);
const char* toString(TangentStorage value);
const char* toString(ShadingPrecision value);
const char* toString(TextureFilter value);
const char* toString(ToneMapping value);
const char* toString(DepthRange value);
const char* toString(QualityPreset value);
std::optional<SpecularVisibility> specularVisibilityFromName(std::string_view name);
std::optional<FresnelTerm> fresnelTermFromName(std::string_view name);
std::optional<DiffuseTerm> diffuseTermFromName(std::string_view name);
std::optional<SplitSum> splitSumFromName(std::string_view name);
std::optional<DiffuseIrradiance> diffuseIrradianceFromName(std::string_view name);
std::optional<RoughnessMapping> roughnessMappingFromName(std::string_view name);
std::optional<PositionStorage> positionStorageFromName(std::string_view name);
std::optional<TangentStorage> tangentStorageFromName(std::string_view name);
std::optional<ShadingPrecision> shadingPrecisionFromName(std::string_view name);
std::optional<TextureFilter> textureFilterFromName(std::string_view name);
std::optional<ToneMapping> toneMappingFromName(std::string_view name);
std::optional<DepthRange> depthRangeFromName(std::string_view name);
std::optional<QualityPreset> qualityPresetFromName(std::string_view name);

Quality qualityPreset(QualityPreset preset);

/// One field of Quality and what it may be set to: for menus, sweeps and help texts.
struct QualityChoice {
    std::string_view name;                    ///< "shBands"
    std::span<const std::string_view> values; ///< all words of enumerations; for numbers those worth measuring
};
std::span<const QualityChoice> qualityChoices();

/// Sets one field by name. NotFound or InvalidArgument says what would be right; `quality` is then as before.
Result<void> setQuality(Quality& quality, std::string_view name, std::string_view value);
/// The word of one field, or nothing for an unknown name. setQuality() takes it back.
std::optional<std::string> qualityValue(Quality const& quality, std::string_view name);
/// "specularVisibility=fast shBands=2": what differs from the default, in the order of qualityChoices(); else
/// "default".
std::string toString(Quality const& quality);

} // namespace filament
