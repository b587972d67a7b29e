// SPDX-License-Identifier: Apache-2.0
/// Quality: every approximation in shading that has an alternative, as a named choice. A plain value, part of View: it
/// may change every frame. docs/quality.md says what each value computes. Choices made when files are loaded are
/// options of loadEnvironment() and loadGltf().
///   Default  every combination of choices that differs from the defaults costs a program, created when first drawn.
///   Names    the names of the fields, and the enumerators in lower camel case: "specularVisibility=fast".
///            filament-render --set and the accuracy tables use these names.
///   Thread   any.   Fails: setQuality() for an unknown name, and says which names are valid.
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
    Fast,         ///< the same without square roots, Hammon 2017: a few per cent too dark at medium roughness
    Uncorrelated, ///< separable Smith, Walter et al. 2007: darker at grazing angles
};

/// Reflectance of one microfacet under suns and punctual lights. The split sum is based on Schlick's term.
enum class FresnelTerm : uint8_t {
    Schlick, ///< Schlick 1994
    Exact,   ///< Fresnel's equations; metals as in Gulbrandsen 2014 with a white edge
};

/// The diffuse lobe under suns and punctual lights.
enum class DiffuseTerm : uint8_t {
    Lambert,
    Disney, ///< Burley 2012, normalised as in Lagarde and de Rousiers 2014
};

/// The second factor of the split sum: the directional albedo of the specular lobe.
enum class SplitSum : uint8_t {
    Table,    ///< a texture of Quality::dfgTableSize^2 texels
    Analytic, ///< the fit of Karis 2014, without a texture
};

/// How often the specular lobe looks up the environment, which stores round lobes for a view along the normal.
enum class SpecularLookUps : uint8_t {
    Dominant,  ///< once, in the direction of Lagarde and de Rousiers 2014
    Quadratic, ///< once, in a direction without a root: further off at middle roughness
    Eight,     ///< at eight visible half vectors (Heitz 2018), each as wide as its share of the lobe
    ThirtyTwo, ///< the same with 32: a reference
};

/// How often an anisotropic lobe looks up the environment, along the grain.
enum class AnisotropicLookUps : uint8_t {
    Five,
    One, ///< about a normal bent towards the view (McAuley 2015): a wide round lobe for a narrow long one
    Three,
    Nine,
};

/// Source of the environment's diffuse light.
enum class DiffuseIrradiance : uint8_t {
    SphericalHarmonics, ///< Quality::shBands bands
    LastSpecularLevel,  ///< roughness 1 of the specular environment: no coefficients, a GGX lobe instead of a cosine
    Cube,               ///< a small cube map of irradiance, no truncated bands; lights without one use the coefficients
};

/// The mip level of a specular environment for a given roughness, chosen when it is loaded. n is the last level.
enum class RoughnessMapping : uint8_t {
    Quadratic,   ///< n r (2 - r), where r is the perceptual roughness: most levels for rough surfaces
    Logarithmic, ///< n + log2(r^2), at least 0: the lobe doubles its width with every level
    Linear,      ///< n r
};

/// Storage of the vertex positions of a glTF file, chosen when it is loaded.
enum class PositionStorage : uint8_t {
    AsAuthored, ///< floats, or integers if the file is already quantised
    Half,       ///< 11 bits relative to the origin of each mesh
    Unorm16,    ///< 16 bits within the bounding cube of each primitive; a node of the model scales them back
};

/// Storage of the tangent frames of a glTF file, one quaternion per vertex, chosen when it is loaded.
enum class TangentStorage : uint8_t {
    Snorm16, ///< 4 x 16 bits: error 0.003 degrees
    Snorm8,  ///< 4 x 8 bits: error up to a degree
    Float,
};

/// Precision of the lighting of lit materials; their own code always runs in 32 bits. Materials compiled without
/// halfPrecision, and devices without 16-bit floats, use Full.
enum class ShadingPrecision : uint8_t {
    Full, ///< 32 bits
    Half, ///< 16 bits: roughness at least 0.089; the two APIs may round differently
};

/// Filter of the samplers of materials; samplers of the environment do not change.
enum class TextureFilter : uint8_t {
    AsAuthored,  ///< as set with the material's textures
    Bilinear,    ///< the nearest mip level
    Trilinear,   ///< interpolates between mip levels
    Anisotropic, ///< trilinear along up to 16 probes
};

/// How shadow maps are read. All but Vsm and Evsm are sums of comparisons of single texels, each with the depth of the
/// receiving plane at that texel, so they need next to no bias.
enum class ShadowFilter : uint8_t {
    Pcf3, ///< 4 x 4 texels: a tent as wide as three (Castano 2013, "Shadow Mapping Summary")
    Off,  ///< nothing casts shadows
    Hard, ///< one texel
    Pcf2, ///< 2 x 2 texels, as a bilinear sampler with comparison
    Pcf5, ///< 6 x 6 texels: a tent as wide as five
    /// 16 texels of a disc as wide as five texels, turned by a pattern of the picture's pixels: noise instead of steps.
    Poisson,
    /// As wide as the penumbra that the size of the light makes (SunLight::angularRadiusDegrees, sourceRadiusMeters),
    /// from 16 look-ups for what casts and 32 of that disc. Fernando 2005, "Percentage-Closer Soft Shadows".
    Pcss,
    /// Two moments of each map, blurred and with mip levels: one look-up, smooth at any distance. Light bleeds where
    /// casters overlap, and contact shadows thin out. Donnelly and Lauritzen 2006, "Variance Shadow Maps".
    Vsm,
    /// Four moments of warped depths: bleeds less, and the moments take twice the memory. Lauritzen and McCool 2008,
    /// "Layered Variance Shadow Maps".
    Evsm,
};

/// How rectangles, discs and tubes shine on the standard material. On others they are representative points.
enum class AreaLightTerm : uint8_t {
    Ltc,                 ///< linearly transformed cosines, Heitz et al. 2016
    RepresentativePoint, ///< exact for diffuse surfaces; a point in the mean direction of the light for highlights
};

/// Ambient occlusion by what the depths of the picture show: Effects::ambientOcclusion.
enum class AmbientOcclusionTerm : uint8_t {
    Off,
    /// Scalable ambient obscurance: Quality::aoSamples points of a spiral (McGuire, Mara and Luebke 2012).
    Sao,
    /// The visible part of the hemisphere between the horizons of Quality::aoSlices slices (Jimenez et al. 2016,
    /// "Practical Realtime Strategies for Accurate Indirect Occlusion").
    Gtao,
};

/// The pixels for which ambient occlusion is computed; the others take it from neighbours of their depth.
enum class AmbientOcclusionResolution : uint8_t {
    Half,         ///< one of four
    Full,         ///< all
    Checkerboard, ///< every other one
};

/// What is seen through materials with `refractionMode : screenspace`.
enum class RefractionSource : uint8_t {
    Screen,      ///< what is opaque in the picture, and the environment where a ray leaves it
    Environment, ///< the environment alone
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

/// Whether what is opaque leaves its depth before anything is shaded, so that each pixel is shaded once.
enum class DepthPrepass : uint8_t {
    Auto, ///< where another effect reads the depths anyway
    On,
    Off, ///< not even then: effects draw depths of their own
};

enum class DepthRange : uint8_t {
    Reversed, ///< near plane 1, infinity 0: the exponent of floats compensates for the perspective
    Ordinary, ///< near plane 0, infinity 1, with the opposite comparison: z-fighting in the distance
};

/// How the edges of the picture are smoothed, besides by View::samples.
enum class AntiAliasing : uint8_t {
    Off,
    Fxaa, ///< blends pixels along edges of the finished picture (Lottes 2009, "FXAA")
    /// Gathers pictures over frames, each seen from another place in its pixels: Karis 2014, "High-Quality Temporal
    /// Supersampling". The mean of all while nothing moves.
    Taa,
};

/// How the samples of a pixel become its colour, with four samples a pixel.
enum class MsaaResolve : uint8_t {
    Average, ///< of light: before a wall, an edge of a lamp is as jagged as with one sample
    /// Weighted so that what is displayed is nearly the average of what each sample alone would display: Karis 2013,
    /// "Tone Mapping". One more pass.
    ToneAware,
};

/// The largest level of what Effects::bloom scatters.
enum class BloomResolution : uint8_t {
    Half,    ///< half of the picture, each way
    Quarter, ///< a quarter, each way: without the narrowest lobe
};

/// Which mip levels of materials' textures are read while frames are gathered (AntiAliasing::Taa).
enum class MipBias : uint8_t {
    Output, ///< those of the picture that is shown, also if fewer pixels are drawn
    Off,    ///< those of the pixels that are drawn
    Sharp,  ///< one sharper than Output: many frames have many samples a pixel
};

/// How a picture of which Resolution::scale draws a share becomes as large as the view, after the tone mapper. With
/// AntiAliasing::Taa and Off, gathering frames does it.
enum class Upscaling : uint8_t {
    Off,        ///< everything is drawn at the size of the view, unless frames are gathered
    Bilinear,   ///< the mean of four pixels
    CatmullRom, ///< Catmull and Rom's cubic filter: sixteen pixels
    /// Twelve pixels, by a filter that lies along edges: as AMD's FidelityFX Super Resolution 1 does (Lottes 2021).
    EdgeAdaptive,
};

/// How the tone mapper of View::colorGrading is evaluated, together with the transfer function of the display.
enum class ToneMapping : uint8_t {
    Analytic, ///< its formula, for every pixel
    Table16,  ///< an interpolated cube of 16 colours per side over the logarithm of light: any grading costs the same
    Table32,
    Table64,
};

enum class QualityPreset : uint8_t {
    Low,       ///< the cheapest value of everything
    Medium,    ///< suitable for phones
    High,      ///< the default of Quality
    Reference, ///< the most exact value of everything
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
    uint8_t shBands = 3; ///< [1, 3]: 1, 4 or 9 coefficients
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
    AmbientOcclusionTerm ao = AmbientOcclusionTerm::Off;
    uint8_t aoSamples = 7; ///< of Sao, [3, 32]
    uint8_t aoSlices = 2;  ///< of Gtao, [1, 3]
    AmbientOcclusionResolution aoResolution = AmbientOcclusionResolution::Half;
    bool aoBlur = true;         ///< smooths the noise of the samples, along surfaces and not across their edges
    bool aoBentNormals = false; ///< diffuse light comes from the mean direction that is open, reflections by its cone
    RefractionSource refraction = RefractionSource::Screen;
    /// How often the picture is copied for what refracts it, [1, 8]. 1: refracting objects show what is opaque. n: they
    /// are drawn from back to front, and each of the n - 1 nearest also shows those behind it; farther ones show none.
    uint8_t refractionLayers = 1;
    TransparencyOrder transparency = TransparencyOrder::Sorted;
    uint8_t transparencyLayers =
            4;                 ///< of Peeled, [1, 8]: all but the last are peeled, the last is what is left, sorted
    bool ssr = false;          ///< reflections of the picture, on materials that ask for them
    uint8_t ssrSteps = 48;     ///< cells of the pyramid of distances that a reflected ray visits at most, [8, 255]
    uint8_t contactSteps = 16; ///< of a contact shadow's ray, [4, 64]
    DepthPrepass depthPrepass = DepthPrepass::Auto;
    AntiAliasing antiAliasing = AntiAliasing::Off;
    MsaaResolve msaaResolve = MsaaResolve::Average;
    MipBias mipBias = MipBias::Output;
    BloomResolution bloomResolution = BloomResolution::Half;
    Upscaling upscale = Upscaling::Off;
    ToneMapping toneMapping = ToneMapping::Analytic;
    DepthRange depthRange = DepthRange::Reversed;
    /// Shaders receive positions relative to the camera, subtracted in double precision. Off: absolute floats, from
    /// which the vertex shader subtracts the camera, as in engines with a float world.
    bool cameraRelative = true;
    friend bool operator==(Quality const&, Quality const&) = default;
};

const char* toString(SpecularVisibility value);
const char* toString(FresnelTerm value);
const char* toString(DiffuseTerm value);
const char* toString(SplitSum value);
const char* toString(SpecularLookUps value);
const char* toString(AnisotropicLookUps value);
const char* toString(DiffuseIrradiance value);
const char* toString(RoughnessMapping value);
const char* toString(PositionStorage value);
const char* toString(TangentStorage value);
const char* toString(ShadingPrecision value);
const char* toString(TextureFilter value);
const char* toString(AntiAliasing value);
const char* toString(MsaaResolve value);
const char* toString(MipBias value);
const char* toString(BloomResolution value);
const char* toString(Upscaling value);
const char* toString(ToneMapping value);
const char* toString(ShadowFilter value);
const char* toString(AreaLightTerm value);
const char* toString(AmbientOcclusionTerm value);
const char* toString(AmbientOcclusionResolution value);
const char* toString(RefractionSource value);
const char* toString(TransparencyOrder value);
const char* toString(DepthPrepass value);
const char* toString(DepthRange value);
const char* toString(QualityPreset value);
std::optional<SpecularVisibility> specularVisibilityFromName(std::string_view name);
std::optional<FresnelTerm> fresnelTermFromName(std::string_view name);
std::optional<DiffuseTerm> diffuseTermFromName(std::string_view name);
std::optional<SplitSum> splitSumFromName(std::string_view name);
std::optional<SpecularLookUps> specularLookUpsFromName(std::string_view name);
std::optional<AnisotropicLookUps> anisotropicLookUpsFromName(std::string_view name);
std::optional<DiffuseIrradiance> diffuseIrradianceFromName(std::string_view name);
std::optional<RoughnessMapping> roughnessMappingFromName(std::string_view name);
std::optional<PositionStorage> positionStorageFromName(std::string_view name);
std::optional<TangentStorage> tangentStorageFromName(std::string_view name);
std::optional<ShadingPrecision> shadingPrecisionFromName(std::string_view name);
std::optional<TextureFilter> textureFilterFromName(std::string_view name);
std::optional<AntiAliasing> antiAliasingFromName(std::string_view name);
std::optional<MsaaResolve> msaaResolveFromName(std::string_view name);
std::optional<MipBias> mipBiasFromName(std::string_view name);
std::optional<BloomResolution> bloomResolutionFromName(std::string_view name);
std::optional<Upscaling> upscalingFromName(std::string_view name);
std::optional<ToneMapping> toneMappingFromName(std::string_view name);
std::optional<ShadowFilter> shadowFilterFromName(std::string_view name);
std::optional<AreaLightTerm> areaLightTermFromName(std::string_view name);
std::optional<AmbientOcclusionTerm> ambientOcclusionTermFromName(std::string_view name);
std::optional<AmbientOcclusionResolution> ambientOcclusionResolutionFromName(std::string_view name);
std::optional<RefractionSource> refractionSourceFromName(std::string_view name);
std::optional<TransparencyOrder> transparencyOrderFromName(std::string_view name);
std::optional<DepthPrepass> depthPrepassFromName(std::string_view name);
std::optional<DepthRange> depthRangeFromName(std::string_view name);
std::optional<QualityPreset> qualityPresetFromName(std::string_view name);

Quality qualityPreset(QualityPreset preset);

/// One field of Quality and its possible values, for menus, sweeps and help texts.
struct QualityChoice {
    std::string_view name;                    ///< "shBands"
    std::span<const std::string_view> values; ///< all names of an enumeration; for numbers those worth measuring
};
std::span<const QualityChoice> qualityChoices();

/// Sets one field by name. NotFound and InvalidArgument list what is valid; `quality` is then unchanged.
Result<void> setQuality(Quality& quality, std::string_view name, std::string_view value);
/// The value of one field as text that setQuality() accepts, or nothing for an unknown name.
std::optional<std::string> qualityValue(Quality const& quality, std::string_view name);
/// "specularVisibility=fast shBands=2": the fields that differ from the default, in the order of qualityChoices(); or
/// "default".
std::string toString(Quality const& quality);

} // namespace filament
