// SPDX-License-Identifier: Apache-2.0
/// Quality: every approximation in shading that has an alternative, as a named choice. A plain value, part of View: it
/// may change every frame. docs/quality.md says what each value computes. Choices made when files are loaded are
/// options of loadEnvironment() and loadGltf().
///   Default  every combination of choices that differs from the defaults costs a program, created when first drawn.
///   Names    each field is an option (Options.h): "specularVisibility=fast". filament-render --set and the accuracy
///            tables use these names.
///   Thread   any.
#pragma once

#include <filament_core/EnumNames.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace filament_core {

/// Masking and shadowing of microfacets.
enum class SpecularVisibility : uint8_t {
    Correlated,   ///< height-correlated Smith, Heitz 2014
    Fast,         ///< without square roots, Hammon 2017: a few per cent too dark at medium roughness
    Uncorrelated, ///< separable Smith, Walter et al. 2007: darker at grazing angles
};
template <>
struct EnumNames<SpecularVisibility> {
    static constexpr std::array<std::string_view, 3> values{ "correlated", "fast", "uncorrelated" };
};

/// Reflectance of one microfacet under suns and punctual lights. The split sum is based on Schlick's term.
enum class FresnelTerm : uint8_t {
    Schlick, ///< Schlick 1994
    Exact,   ///< Fresnel's equations; metals as in Gulbrandsen 2014 with a white edge
};
template <>
struct EnumNames<FresnelTerm> {
    static constexpr std::array<std::string_view, 2> values{ "schlick", "exact" };
};

/// The diffuse lobe under suns and punctual lights.
enum class DiffuseTerm : uint8_t {
    Lambert,
    Disney, ///< Burley 2012, normalised as in Lagarde and de Rousiers 2014
};
template <>
struct EnumNames<DiffuseTerm> {
    static constexpr std::array<std::string_view, 2> values{ "lambert", "disney" };
};

/// The second factor of the split sum: the directional albedo of the specular lobe.
enum class SplitSum : uint8_t {
    Table,    ///< a texture of Quality::dfgTableSize^2 texels
    Analytic, ///< the fit of Karis 2014, without a texture
};
template <>
struct EnumNames<SplitSum> {
    static constexpr std::array<std::string_view, 2> values{ "table", "analytic" };
};

/// How often the specular lobe looks up the environment, which stores round lobes for a view along the normal.
enum class SpecularLookUps : uint8_t {
    Dominant,  ///< once, in the direction of Lagarde and de Rousiers 2014
    Quadratic, ///< once, in a direction without a root: further off at middle roughness
    Two,       ///< twice, in directions and of roughnesses that are fitted to the lobe (docs/quality.md)
    Three,     ///< three times, as fitted
    Eight,     ///< at eight visible half vectors (Heitz 2018), each as wide as its share of the lobe
    ThirtyTwo, ///< with 32: a reference
};
template <>
struct EnumNames<SpecularLookUps> {
    static constexpr std::array<std::string_view, 6> values{ "dominant", "quadratic", "two",
                                                             "three",    "eight",     "thirtyTwo" };
};

/// How often an anisotropic lobe looks up the environment, along the grain.
enum class AnisotropicLookUps : uint8_t {
    Five,
    One, ///< about a normal bent towards the view (McAuley 2015): a wide round lobe for a narrow long one
    Three,
    Nine,
};
template <>
struct EnumNames<AnisotropicLookUps> {
    static constexpr std::array<std::string_view, 4> values{ "five", "one", "three", "nine" };
};

/// Source of the environment's diffuse light.
enum class DiffuseIrradiance : uint8_t {
    SphericalHarmonics, ///< Quality::shBands bands
    LastSpecularLevel,  ///< roughness 1 of the specular environment: no coefficients, a GGX lobe instead of a cosine
    Cube,               ///< a small cube map of irradiance, no truncated bands; lights without one use the coefficients
};
template <>
struct EnumNames<DiffuseIrradiance> {
    static constexpr std::array<std::string_view, 3> values{ "sphericalHarmonics", "lastSpecularLevel", "cube" };
};

/// The mip level of a specular environment for a given roughness, chosen when it is loaded. n is the last level.
enum class RoughnessMapping : uint8_t {
    Quadratic,   ///< n r (2 - r), where r is the perceptual roughness: most levels for rough surfaces
    Logarithmic, ///< n + log2(r^2), at least 0: the lobe doubles its width with every level
    Linear,      ///< n r
};
template <>
struct EnumNames<RoughnessMapping> {
    static constexpr std::array<std::string_view, 3> values{ "quadratic", "logarithmic", "linear" };
};

/// Storage of the vertex positions of a glTF file, chosen when it is loaded.
enum class PositionStorage : uint8_t {
    AsAuthored, ///< floats, or integers if the file is already quantised
    Half,       ///< 11 bits relative to the origin of each mesh
    Unorm16,    ///< 16 bits within the bounding cube of each primitive; a node of the model scales them back
};
template <>
struct EnumNames<PositionStorage> {
    static constexpr std::array<std::string_view, 3> values{ "asAuthored", "half", "unorm16" };
};

/// Storage of the tangent frames of a glTF file, one quaternion per vertex, chosen when it is loaded.
enum class TangentStorage : uint8_t {
    Snorm16, ///< 4 x 16 bits: error 0.003 degrees
    Snorm8,  ///< 4 x 8 bits: error up to a degree
    Float,
};
template <>
struct EnumNames<TangentStorage> {
    static constexpr std::array<std::string_view, 3> values{ "snorm16", "snorm8", "float" };
};

/// Precision of the lighting of lit materials; their own code always runs in 32 bits. Materials compiled without
/// halfPrecision, and devices without 16-bit floats, use Full.
enum class ShadingPrecision : uint8_t {
    Full, ///< 32 bits
    Half, ///< 16 bits: roughness at least 0.089; the two APIs may round differently
};
template <>
struct EnumNames<ShadingPrecision> {
    static constexpr std::array<std::string_view, 2> values{ "full", "half" };
};

/// Filter of the samplers of materials; samplers of the environment do not change.
enum class TextureFilter : uint8_t {
    AsAuthored,  ///< as set with the material's textures
    Bilinear,    ///< the nearest mip level
    Trilinear,   ///< interpolates between mip levels
    Anisotropic, ///< trilinear along up to 16 probes
};
template <>
struct EnumNames<TextureFilter> {
    static constexpr std::array<std::string_view, 4> values{ "asAuthored", "bilinear", "trilinear", "anisotropic" };
};

/// How shadow maps are read. All but Vsm and Evsm are sums of comparisons of single texels, each with the depth of the
/// receiving plane at that texel, so they need next to no bias.
enum class ShadowFilter : uint8_t {
    Pcf3, ///< 4 x 4 texels: a tent as wide as three (Castano 2013, "Shadow Mapping Summary")
    Off,  ///< nothing casts shadows
    Hard, ///< one texel
    Pcf2, ///< 2 x 2 texels, as a bilinear sampler with comparison
    Pcf5, ///< 6 x 6 texels: a tent as wide as five
    /// 16 texels of a disc as wide as five texels, rotated per pixel: noise instead of steps.
    Poisson,
    /// As wide as the penumbra that the size of the light makes (SunLight::angularRadiusDegrees, sourceRadiusMeters),
    /// 16 samples to find blockers and 32 of that disc. Fernando 2005, "Percentage-Closer Soft Shadows".
    Pcss,
    /// Two moments of each map, blurred and with mip levels: one look-up, smooth at any distance. Light bleeds where
    /// casters overlap, and contact shadows thin out. Donnelly and Lauritzen 2006, "Variance Shadow Maps".
    Vsm,
    /// Four moments of warped depths: bleeds less, and the moments take twice the memory. Lauritzen and McCool 2008,
    /// "Layered Variance Shadow Maps".
    Evsm,
};
template <>
struct EnumNames<ShadowFilter> {
    static constexpr std::array<std::string_view, 9> values{ "pcf3",    "off",  "hard", "pcf2", "pcf5",
                                                             "poisson", "pcss", "vsm",  "evsm" };
};

/// How rectangles, discs and tubes shine on the standard material. On others they are representative points.
enum class AreaLightTerm : uint8_t {
    Ltc,                 ///< linearly transformed cosines, Heitz et al. 2016
    RepresentativePoint, ///< exact for diffuse surfaces; a point in the mean direction of the light for highlights
};
template <>
struct EnumNames<AreaLightTerm> {
    static constexpr std::array<std::string_view, 2> values{ "ltc", "representativePoint" };
};

/// What shadow maps know of the shape of rectangles, discs and tubes. The maps themselves are the same.
enum class AreaShadows : uint8_t {
    Center, ///< those of a point at the centre, by Quality::shadows
    /// How much of the shape is seen past what the map holds, whatever filter Quality::shadows selects for other
    /// lights: wide along a tube and narrow across it. Vsm and Evsm have no depths to find that from, and use Center.
    Shape,
};
template <>
struct EnumNames<AreaShadows> {
    static constexpr std::array<std::string_view, 2> values{ "center", "shape" };
};

/// What is seen through materials with `refractionMode : screenspace`.
enum class RefractionSource : uint8_t {
    Screen,      ///< the opaque scene colour, and the environment where a ray leaves the screen
    Environment, ///< the environment alone
};
template <>
struct EnumNames<RefractionSource> {
    static constexpr std::array<std::string_view, 2> values{ "screen", "environment" };
};

/// How surfaces that blend come over each other.
enum class TransparencyOrder : uint8_t {
    Sorted, ///< object by object, the farthest first
    /// In any order, as a mean that weights what is near most: McGuire and Bavoil 2013, "Weighted Blended
    /// Order-Independent Transparency". For many thin layers, such as smoke and leaves: nothing flickers when objects
    /// pass each other.
    Weighted,
    /// Pixel by pixel, the nearest layers first (Everitt 2001, "Interactive Order-Independent Transparency"): exact,
    /// also where surfaces intersect, up to Quality::transparencyLayers.
    Peeled,
};
template <>
struct EnumNames<TransparencyOrder> {
    static constexpr std::array<std::string_view, 3> values{ "sorted", "weighted", "peeled" };
};

/// Whether opaque objects are drawn to depth before anything is shaded, so that each pixel is shaded once.
enum class DepthPrepass : uint8_t {
    Auto, ///< where another effect reads the depths anyway
    On,
    Off, ///< not even then: effects draw depths of their own
};
template <>
struct EnumNames<DepthPrepass> {
    static constexpr std::array<std::string_view, 3> values{ "auto", "on", "off" };
};

enum class DepthRange : uint8_t {
    Reversed, ///< near plane 1, infinity 0: the exponent of floats compensates for the perspective
    Ordinary, ///< near plane 0, infinity 1, with the opposite comparison: z-fighting in the distance
};
template <>
struct EnumNames<DepthRange> {
    static constexpr std::array<std::string_view, 2> values{ "reversed", "ordinary" };
};

/// Anti-aliasing in addition to View::samples.
enum class AntiAliasing : uint8_t {
    Off,
    Fxaa, ///< blends pixels along edges of the tone-mapped image (Lottes 2009, "FXAA")
    /// Temporal accumulation of jittered frames: Karis 2014, "High-Quality Temporal
    /// Supersampling". The mean of all while nothing moves.
    Taa,
    /// Subpixel reconstruction: shades once a pixel, and gives five depths of each pixel the colours of the surfaces
    /// around it that they lie on. For edges of opaque surfaces, at half the cost of View::samples = 4, which it does
    /// nothing beside. Chajdas, McGuire and Luebke 2011, "Subpixel Reconstruction Antialiasing for Deferred Shading".
    Sraa,
};
template <>
struct EnumNames<AntiAliasing> {
    static constexpr std::array<std::string_view, 4> values{ "off", "fxaa", "taa", "sraa" };
};

/// How the samples of a pixel become its colour, with four samples a pixel.
enum class MsaaResolve : uint8_t {
    Average, ///< of light: before a wall, an edge of a lamp is as jagged as with one sample
    /// Weighted so that what is displayed is nearly the average of what each sample alone would display: Karis 2013,
    /// "Tone Mapping". One more pass.
    ToneAware,
};
template <>
struct EnumNames<MsaaResolve> {
    static constexpr std::array<std::string_view, 2> values{ "average", "toneAware" };
};

/// Which mip levels of materials' textures are read with temporal accumulation (AntiAliasing::Taa).
enum class MipBias : uint8_t {
    Output, ///< those of the output resolution, also if fewer pixels are drawn
    Off,    ///< those of the pixels that are drawn
    Sharp,  ///< one sharper than Output: many frames have many samples a pixel
};
template <>
struct EnumNames<MipBias> {
    static constexpr std::array<std::string_view, 3> values{ "output", "off", "sharp" };
};

/// How the tone mapper of View::display is evaluated, together with the transfer function of the display.
enum class ToneMapping : uint8_t {
    Analytic, ///< its formula, for every pixel
    Table16,  ///< an interpolated cube of 16 colours per side over the logarithm of light: any grading costs the same
    Table32,
    Table64,
};
template <>
struct EnumNames<ToneMapping> {
    static constexpr std::array<std::string_view, 4> values{ "analytic", "table16", "table32", "table64" };
};

enum class QualityPreset : uint8_t {
    Low,       ///< the cheapest value of everything
    Medium,    ///< suitable for phones
    High,      ///< the default of Quality
    Reference, ///< the most exact value of everything
};
template <>
struct EnumNames<QualityPreset> {
    static constexpr std::array<std::string_view, 4> values{ "low", "medium", "high", "reference" };
};

struct Quality {
    SpecularVisibility specularVisibility = SpecularVisibility::Correlated;
    FresnelTerm fresnel = FresnelTerm::Schlick;
    DiffuseTerm diffuse = DiffuseTerm::Lambert;
    bool energyCompensation = true; ///< restores the energy that rough metals lose with a single bounce
    bool diffuseCoupling = true;    ///< the diffuse lobe receives only the light that the specular lobe leaves
    SplitSum splitSum = SplitSum::Table;
    uint16_t dfgTableSize = 64; ///< texels per side, [16, 256]
    SpecularLookUps specularLookUps = SpecularLookUps::Dominant;
    AnisotropicLookUps anisotropicLookUps = AnisotropicLookUps::Five;
    DiffuseIrradiance diffuseIrradiance = DiffuseIrradiance::Cube;
    uint8_t shBands = 3;          ///< [1, 3]: 1, 4 or 9 coefficients
    uint8_t reflectionProbes = 8; ///< most ReflectionProbes that light a view, [0, 8]: the nearest ones
    ShadingPrecision shadingPrecision = ShadingPrecision::Full;
    TextureFilter textureFilter = TextureFilter::AsAuthored;
    ShadowFilter shadows = ShadowFilter::Pcf3;
    uint16_t shadowMapSize = 2048; ///< texels of a side, [64, 8192]: of a cascade; the most for other lights. Rounded
                                   ///< down to a power of two
    uint8_t shadowCascades = 1;    ///< of the sun, [1, 4]
    uint16_t shadowAtlasMegabytes = 64; ///< for all maps, [1, 256]: beyond, maps get smaller and the least important go
    uint8_t shadowBlurTexels = 2; ///< of Vsm and Evsm: half the width of the blur, [0, 16]. A map's margin limits it:
                                  ///< a sixteenth of its width
    /// What transmits light (a material's `transmission` and `absorption`) casts shadows of that colour: three maps
    /// instead of one where something does. Off: it stops all light.
    bool coloredShadows = false;
    AreaLightTerm areaLights = AreaLightTerm::Ltc;
    AreaShadows areaShadows = AreaShadows::Center;
    RefractionSource refraction = RefractionSource::Screen;
    /// Copies of the scene colour for refraction, [1, 8]. 1: refractive objects show opaque ones. n: they
    /// are drawn from back to front, and each of the n - 1 nearest also shows those behind it; farther ones show none.
    uint8_t refractionLayers = 1;
    TransparencyOrder transparency = TransparencyOrder::Sorted;
    uint8_t transparencyLayers = 4; ///< of Peeled, [1, 8]: all but the last are peeled, the last holds the rest, sorted
    DepthPrepass depthPrepass = DepthPrepass::Auto;
    AntiAliasing antiAliasing = AntiAliasing::Off;
    MsaaResolve msaaResolve = MsaaResolve::Average;
    MipBias mipBias = MipBias::Output;
    ToneMapping toneMapping = ToneMapping::Analytic;
    DepthRange depthRange = DepthRange::Reversed;
    /// Shaders receive positions relative to the camera, subtracted in double precision. Off: absolute floats, from
    /// which the vertex shader subtracts the camera, as in engines with a float world.
    bool cameraRelative = true;
    friend bool operator==(Quality const&, Quality const&) = default;
};

Quality qualityPreset(QualityPreset preset);

/// "specularVisibility=fast shBands=2": the options that differ from the default, or "default".
std::string toString(Quality const& quality);

} // namespace filament_core
