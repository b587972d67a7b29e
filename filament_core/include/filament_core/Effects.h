// SPDX-License-Identifier: Apache-2.0
/// Effects: screen-space and post-processing effects of a View, each with its switch, its look and how exactly it is
/// computed. What shading itself approximates is Quality's. Plain values that may change every frame and cost nothing
/// to change.
///   Demand   an effect runs only where something visible needs it: Renderer::explain() says what runs and why.
///   Names    each member is an option (Options.h), as in filament-render --set fog.density=0.2 and in scene files.
///   Ranges   stated at each member. setOption() refuses what lies outside; values that a program sets itself are
///            clamped, and NaN counts as the default.
///   Thread   any.
#pragma once

#include <filament_core/Color.h>
#include <filament_core/EnumNames.h>
#include <filament_core/Objects.h>

#include <array>
#include <cstdint>

namespace filament_core {

enum class AmbientOcclusionMethod : uint8_t {
    /// Scalable ambient obscurance: `samples` points of a spiral (McGuire, Mara and Luebke 2012).
    Sao,
    /// Ground-truth ambient occlusion: the visible part of the hemisphere between the horizons of `slices` slices
    /// (Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion").
    Gtao,
};
template <>
struct EnumNames<AmbientOcclusionMethod> {
    static constexpr std::array<std::string_view, 2> values{ "sao", "gtao" };
};

/// The pixels for which ambient occlusion is computed; the others take it from neighbours of their depth.
enum class AmbientOcclusionResolution : uint8_t {
    Half,         ///< one of four
    Full,         ///< all
    Checkerboard, ///< every other one
};
template <>
struct EnumNames<AmbientOcclusionResolution> {
    static constexpr std::array<std::string_view, 3> values{ "half", "full", "checkerboard" };
};

/// Occlusion of indirect light by surroundings, found in the depth buffer, on opaque and masked surfaces.
struct AmbientOcclusion {
    bool enabled = false;
    AmbientOcclusionMethod method = AmbientOcclusionMethod::Gtao;
    AmbientOcclusionResolution resolution = AmbientOcclusionResolution::Half;
    uint8_t samples = 7;       ///< of Sao, [3, 32]
    uint8_t slices = 2;        ///< of Gtao, [1, 3]
    bool blur = true;          ///< smooths the noise of the samples, along surfaces and not across their edges
    bool bentNormals = false;  ///< diffuse light comes from the mean unoccluded direction, reflections by its cone
    float radiusMeters = 0.3f; ///< distance at which surfaces still occlude, in metres, [1e-4, 1e4]
    float intensity = 1;       ///< exponent of the visibility, [0, 8]: 0 disables the effect, above 1 is darker
    friend bool operator==(AmbientOcclusion const&, AmbientOcclusion const&) = default;
};

/// Reflections of the rendered scene, on materials with `reflections : screenspace`. Rays that leave the screen fall
/// back to the environment.
struct ScreenSpaceReflections {
    bool enabled = false;
    uint8_t steps = 48;           ///< cells of the depth pyramid that a ray visits at most, [8, 255]
    float distanceMeters = 10;    ///< length of a reflected ray, in metres, [1e-3, 1e5]
    float thicknessMeters = 0.1f; ///< assumed thickness of visible surfaces, in metres, [1e-4, 1e4]
    friend bool operator==(ScreenSpaceReflections const&, ScreenSpaceReflections const&) = default;
};

/// Fog that decreases exponentially with height, and light that it scatters.
struct Fog {
    bool enabled = false;
    float density = 0.1f;     ///< at heightMeters, [0, 1e4] 1/m
    float startMeters = 0;    ///< no fog nearer to the camera, [0, 1e6]
    float cutOffMeters = 0;   ///< no fog farther away, for skies that have their own; 0: no limit, [0, 1e9]
    float heightMeters = 0;   ///< world height at which `density` holds, [-1e6, 1e6]
    float heightFalloff = 0;  ///< [0, 1e3] 1/m: density changes by exp(-heightFalloff * metres above heightMeters)
    float maximumOpacity = 1; ///< [0, 1]
    LinearColor color{ 0.5f, 0.6f, 0.7f }; ///< of the light that fog scatters, relative to the environment; [0, 1e3]
    bool colorFromEnvironment = false;     ///< times the blurred environment in the direction of the view
    float inScatteringStartMeters = 0;     ///< of the sun's light, [0, 1e6]
    float inScatteringSize = 0; ///< how narrow the sun's glow in the fog is: exponent of the cosine, [0, 1e3]; 0: none
    /// Fog scatters the light of lamps and of the brightest sun by its phase function, and shadow maps cut it into
    /// shafts; replaces the glow above. Summed up in cells: columns over the image, cut into slices.
    bool volumetric = false;
    LinearColor albedo{ 1, 1, 1 }; ///< share of the light that fog scatters; the rest is absorbed; [0, 1]
    float anisotropy = 0.2f;       ///< mean cosine of scattering: > 0 forwards, 0 in all directions; [-0.95, 0.95]
    float volumetricMeters = 64; ///< where the cells end; beyond, the sun has no shadows and lamps no light; [0.1, 1e5]
    uint8_t volumetricPixels = 16; ///< width of a column, [8, 64]; wider ones where cells would take over 128 MiB
    uint8_t volumetricSlices = 32; ///< the nearest are the thinnest, [8, 128]
    uint8_t volumetricFrames = 1;  ///< in which all cells are lit, a part in each, [1, 64]; 1: all in each
    bool attenuatesLight = false;  ///< volumetric fog weakens light on its way from lamps and the sun to the fog
    /// The density of volumetric fog varies from place to place: by noise of mean 0, up to this share of it, [0, 1].
    float noiseAmplitude = 0;
    float noiseMeters = 4;    ///< size of the largest swirls, [0.01, 1e4]; 256 of them repeat
    uint8_t noiseOctaves = 3; ///< each adds swirls half as large and half as dense, [1, 4]
    float3 noiseWind{ 0 };    ///< moves the swirls with View::timeSeconds, [-1e3, 1e3] m/s
    friend bool operator==(Fog const&, Fog const&) = default;
};

/// Screen-space shadows of details that are too small for shadow maps, of lights with `contactShadows`.
struct ContactShadows {
    uint8_t steps = 16;            ///< samples of a ray, [4, 64]
    float distanceMeters = 0.2f;   ///< length of the ray towards the light, in metres, [1e-4, 1e4]
    float thicknessMeters = 0.05f; ///< assumed thickness of visible surfaces, in metres, [1e-5, 1e4]
    friend bool operator==(ContactShadows const&, ContactShadows const&) = default;
};

/// The size of the first level of bloom's pyramid.
enum class BloomResolution : uint8_t {
    Half,    ///< half of the image, each way
    Quarter, ///< a quarter, each way: without the narrowest lobe
};
template <>
struct EnumNames<BloomResolution> {
    static constexpr std::array<std::string_view, 2> values{ "half", "quarter" };
};

/// Scattering of light around bright areas by lenses and eyes. It conserves energy: the image as a whole is no
/// brighter. Before tone mapping; isotropic.
struct Bloom {
    bool enabled = false;
    BloomResolution resolution = BloomResolution::Half;
    float strength = 0.1f; ///< fraction of the light that is scattered, [0, 1]
    float radius = 0.1f;   ///< radius of the widest lobe, as a share of the image height, [0.001, 1]
    float threshold = 0;   ///< only light above this value is scattered, relative to white, [0, 1e4]
    /// Dirt on the lens over the whole image: areas brighter than the mean of the texture show more of the scattered
    /// light, darker ones less. A 2D colour texture with all of its mip levels; null: a clean lens.
    Texture dirt{};
    float dirtStrength = 1; ///< share of the scattered light that the dirt modulates, [0, 1]
    friend bool operator==(Bloom const&, Bloom const&) = default;
};

/// Reflections in a lens: ghosts, which are blurred images of bright light, on the line from it through
/// the image centre; and a halo, a ring around it. The light is removed from its source: none is added.
struct LensFlare {
    bool enabled = false;
    float threshold = 4;         ///< only of light above it, [0, 1e4]; 1 is white
    float ghostStrength = 0.03f; ///< fraction of the light in all ghosts together, [0, 1]
    uint8_t ghostCount = 5;      ///< [0, 8]
    float ghostSpacing = 0.4f;   ///< from the light and between ghosts, of its distance from the centre, [0.05, 2]
    float ghostRadius = 0.03f;   ///< mean, as a fraction of the image height, [0.005, 0.25]
    float haloStrength = 0.01f;  ///< fraction of the light in the halo, [0, 1]
    float haloRadius = 0.25f;    ///< as a fraction of the image height, [0.05, 1]
    float haloThickness = 0.2f;  ///< of the ring, as a fraction of its radius, [0, 1]
    float dispersion = 0.7f;     ///< [0, 1]: from white to the colours of a spectrum, red outermost
    friend bool operator==(LensFlare const&, LensFlare const&) = default;
};

/// Blur of surfaces that are out of focus, by the aperture of the camera's exposure and the focal length of its field
/// of view, for a sensor 24 mm high. Transparent objects have the blur of the surface behind them.
struct DepthOfField {
    bool enabled = false;
    float focusMeters = 2;   ///< linear depth that is sharp, [0, 1e9]
    float blurScale = 1;     ///< factor of the physical blur, [0, 100]
    float maxRadius = 0.03f; ///< of a blurred point, as a fraction of the image height, [0, 0.1]
    uint8_t blades = 0;      ///< of the aperture: a polygon with as many sides, [0, 16]; less than 3: round
    friend bool operator==(DepthOfField const&, DepthOfField const&) = default;
};

/// Blur of moving surfaces while the shutter is open: opaque and masked ones, and everything if the camera
/// moves. Transparent objects have the blur of the surface behind them.
struct MotionBlur {
    bool enabled = false;
    float shutterDegrees = 180; ///< the part of a frame during which the shutter is open, of 360, [0, 360]
    float maxRadius = 0.03f;    ///< half of the longest streak, as a fraction of the image height, [0, 0.1]
    friend bool operator==(MotionBlur const&, MotionBlur const&) = default;
};

/// Exposure that adapts to the image: the mean luminance of the pixels between two percentiles becomes middle grey. On
/// top of the camera's exposure. Its speed is relative to View::timeSeconds; the first frame is exposed at
/// once.
struct AutoExposure {
    bool enabled = false;
    float lowPercentile = 0.4f, highPercentile = 0.95f; ///< darker and brighter pixels do not count, [0, 1]
    float compensation = 0;                             ///< stops, [-16, 16]
    float minStops = -8, maxStops = 8;                  ///< least and most correction, [-16, 16]
    float speedUp = 3, speedDown = 1; ///< towards brighter and darker images, stops a second, [0, 1e3]
    friend bool operator==(AutoExposure const&, AutoExposure const&) = default;
};

/// Colour grading of light before the tone mapper, in linear Rec. 2020: vision at night; exposure, white balance,
/// channel mixer; shadows, midtones and highlights; slope, offset, power and contrast on the ACEScct logarithm;
/// saturation and vibrance; curves. The neutral values of all fields together change nothing, and cost nothing.
/// docs/finish.md has the formulas.
struct ColorGrading {
    bool enabled = false;
    float nightAdaptation = 0; ///< [0, 1]: rod vision; dark colours get brighter, bluer and paler
    float exposure = 0;        ///< stops, [-16, 16]
    float temperature = 0;     ///< [-1, 1]: cooler to warmer, along daylight from 4000 to 25 000 kelvin
    float tint = 0;            ///< [-1, 1]: greener to more magenta
    float3 mixRed{ 1, 0, 0 }, mixGreen{ 0, 1, 0 }, mixBlue{ 0, 0, 1 }; ///< of red, green and blue, [-2, 2]
    float3 shadows{ 1 }, midtones{ 1 }, highlights{ 1 };               ///< factors, [0, 4]
    float4 tonalRanges{ 0, 0.333f, 0.55f, 1 }; ///< luminances between which shadows end and highlights begin, [0, 100]
    float3 slope{ 1 };                         ///< [0, 4]
    float3 offset{ 0 };                        ///< [-1, 1]
    float3 power{ 1 };                         ///< [0.1, 10]
    float contrast = 1;                        ///< about middle grey, [0, 2]
    float saturation = 1, vibrance = 1;        ///< of all colours, and of pale ones, [0, 3]
    float3 shadowGamma{ 1 };                   ///< of light up to midPoint, [0.1, 10]
    float3 midPoint{ 1 };                      ///< [1e-3, 100]
    float3 highlightScale{ 1 };                ///< of light beyond midPoint, [0, 10]
    bool gamutMapping = false;                 ///< colours outside of Rec. 709 lose chroma instead of components
    friend bool operator==(ColorGrading const&, ColorGrading const&) = default;
};

/// Darkening towards the corners.
struct Vignette {
    bool enabled = false;
    float midPoint = 0.5f;  ///< distance from the centre where it begins, [0, 1]
    float roundness = 0.5f; ///< [0, 1]: from a rectangle by an ellipse (0.5) to a circle
    float feather = 0.5f;   ///< softness of its edge, [0.05, 1]
    LinearColor color{ 0 }; ///< factor of the image at the corners, [0, 1]
    friend bool operator==(Vignette const&, Vignette const&) = default;
};

/// Film grain of display values, different in each frame.
struct Grain {
    bool enabled = false;
    float strength = 0.05f; ///< standard deviation in the middle tones, [0, 1]
    float size = 1.5f;      ///< of a grain, pixels, [1, 8]
    friend bool operator==(Grain const&, Grain const&) = default;
};

/// Dispersion of the lens: coloured fringes that grow with the distance from the centre.
struct ChromaticAberration {
    bool enabled = false;
    float strength = 0.005f; ///< distance of red and blue at the corners, as a fraction of the height, [0, 0.1]
    friend bool operator==(ChromaticAberration const&, ChromaticAberration const&) = default;
};

/// Filter that enlarges an image of which Resolution::scale draws a share, after the tone mapper. With
/// AntiAliasing::Taa and Off, temporal accumulation upscales instead.
enum class Upscaling : uint8_t {
    Off,        ///< everything is drawn at the size of the view, unless temporal accumulation upscales
    Bilinear,   ///< the mean of four pixels
    CatmullRom, ///< Catmull and Rom's cubic filter: sixteen pixels
    /// Twelve pixels, by a filter that lies along edges: as AMD's FidelityFX Super Resolution 1 does (Lottes 2021).
    EdgeAdaptive,
};
template <>
struct EnumNames<Upscaling> {
    static constexpr std::array<std::string_view, 4> values{ "off", "bilinear", "catmullRom", "edgeAdaptive" };
};

/// How many pixels are drawn, before `upscaling` or AntiAliasing::Taa makes as many of them as the view has. With
/// `dynamic`, Renderer finds the largest scale, up to `scale`, that fits the frame time: docs/resolution.md.
struct Resolution {
    Upscaling upscaling = Upscaling::Off;
    float2 scale{ 1 };             ///< fraction of View::size, per axis, [0.5, 1]
    bool dynamic = false;          ///< the scale follows the frame time
    float targetMilliseconds = 16; ///< frame time to stay below, [0.1, 1000]
    float leastScale = 0.5f;       ///< the smallest scale, per axis, [0.5, 1]
    float headroom = 0.1f;         ///< fraction of the target that stays free when the scale grows, [0, 0.5]
    uint8_t history = 8;           ///< frames that must agree before the scale changes, [1, 32]
    bool uniform = true;           ///< both axes equal; off: the width first, down to its minimum
    friend bool operator==(Resolution const&, Resolution const&) = default;
};

/// Increases the contrast of neighbours as far as none becomes darker than black or brighter than white.
struct Sharpening {
    bool enabled = false;
    float strength = 0.5f; ///< [0, 1]
    friend bool operator==(Sharpening const&, Sharpening const&) = default;
};

/// Pixels drawn around the image and cropped in the end, so that off-screen surfaces are available to
/// occlusion, reflections, refraction, bloom and blurs. Not with temporal upscaling, and not for
/// render targets with depth.
struct GuardBand {
    bool enabled = false;
    float width = 0.1f; ///< on each side, as a fraction of the image height, [0, 0.5]
    friend bool operator==(GuardBand const&, GuardBand const&) = default;
};

struct Effects {
    AmbientOcclusion ambientOcclusion{};
    ScreenSpaceReflections screenSpaceReflections{};
    Fog fog{};
    ContactShadows contactShadows{};
    Bloom bloom{};
    DepthOfField depthOfField{};
    MotionBlur motionBlur{};
    AutoExposure autoExposure{};
    ColorGrading colorGrading{};
    Vignette vignette{};
    Grain grain{};
    ChromaticAberration chromaticAberration{};
    Resolution resolution{};
    Sharpening sharpening{};
    LensFlare lensFlare{};
    GuardBand guardBand{};
    friend bool operator==(Effects const&, Effects const&) = default;
};

/// The matrix of exposure, white balance and channel mixer: linear Rec. 2020 from linear Rec. 709.
double3x3 gradingMatrix(ColorGrading const& grading);

} // namespace filament_core
