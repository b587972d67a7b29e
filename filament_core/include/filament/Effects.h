// SPDX-License-Identifier: Apache-2.0
/// Effects: what the effects of a View show: how far they reach, how strong they are, which colour they have. How
/// exactly they are computed, and whether at all, is Quality's. Plain values that may change every frame and cost
/// nothing to change.
///   Demand   an effect runs only if something visible asks for it: Renderer::explain() says what runs and why.
///   Names    those of effectOptions(), as in filament-render --set fog.density=0.2 and in scene files.
///   Ranges   stated at each field. setEffect() refuses what lies outside; values that a program sets itself are
///            clamped, and NaN counts as the default.
///   Thread   any.   Fails: setEffect() for unknown names and values, and says which are valid.
#pragma once

#include <filament/Color.h>
#include <filament/Objects.h>
#include <filament/Result.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace filament {

/// Surroundings that keep indirect light from surfaces (Quality::ao). It applies to what is opaque or masked.
struct AmbientOcclusion {
    float radiusMeters = 0.3f; ///< how far away surfaces still occlude, [1e-4, 1e4]
    float intensity = 1;       ///< exponent of the visibility, [0, 8]: 0: none, 1: as computed, more: darker
    friend bool operator==(AmbientOcclusion const&, AmbientOcclusion const&) = default;
};

/// Reflections of what the picture shows (Quality::ssr), on materials with `reflections : screenspace`.
struct ScreenReflections {
    float distanceMeters = 10;    ///< how far a reflected ray is followed, [1e-3, 1e5]
    float thicknessMeters = 0.1f; ///< how far behind a surface of the picture a ray still hits it, [1e-4, 1e4]
    friend bool operator==(ScreenReflections const&, ScreenReflections const&) = default;
};

/// Fog that thins out exponentially with height, and light that it scatters.
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
    friend bool operator==(Fog const&, Fog const&) = default;
};

/// Shadows of small things, found in the depths of the picture, for lights with `contactShadows`.
struct ContactShadows {
    float distanceMeters = 0.2f;   ///< how far towards the light something is looked for, [1e-4, 1e4]
    float thicknessMeters = 0.05f; ///< how deep what the picture shows is taken to be, [1e-5, 1e4]
    friend bool operator==(ContactShadows const&, ContactShadows const&) = default;
};

/// Light that lenses and eyes scatter around what is bright. It is taken from where it was: the picture as a whole is
/// no brighter. Before tone mapping; in all directions alike.
struct Bloom {
    bool enabled = false;
    float strength = 0.1f; ///< share of the light that is scattered, [0, 1]
    float radius = 0.1f;   ///< how far, as a share of the picture's height, [0.001, 1]: that of the widest of its lobes
    float threshold = 0;   ///< only what is brighter is scattered, by that much, [0, 1e4]; 1 is white
    /// Of the lens, over the whole picture: what is brighter than the mean of all of it shows more of the scattered
    /// light, what is darker less. A 2D texture of colours, with all of its mip levels; none: a clean lens.
    Texture dirt{};
    float dirtStrength = 1; ///< share of the scattered light that the dirt scatters, [0, 1]
    friend bool operator==(Bloom const&, Bloom const&) = default;
};

/// What the surfaces of a lens reflect: ghosts, which are blurred images of what is bright, on the line from it through
/// the middle of the picture; and a halo, a ring around it. The light is taken from where it was: none is added.
struct LensFlare {
    bool enabled = false;
    float threshold = 4;         ///< only of what is brighter, by that much, [0, 1e4]; 1 is white
    float ghostStrength = 0.03f; ///< share of the light in all ghosts together, [0, 1]
    float ghostCount = 5;        ///< [0, 8], whole
    float ghostSpacing = 0.4f;   ///< from the light and from ghost to ghost, of its distance from the middle, [0.05, 2]
    float ghostRadius = 0.03f;   ///< their mean, as a share of the picture's height, [0.005, 0.25]
    float haloStrength = 0.01f;  ///< share of the light in the halo, [0, 1]
    float haloRadius = 0.25f;    ///< as a share of the picture's height, [0.05, 1]
    float haloThickness = 0.2f;  ///< of the ring, as a share of its radius, [0, 1]
    float dispersion = 0.7f;     ///< [0, 1]: from white to the colours of a spectrum, red outermost
    friend bool operator==(LensFlare const&, LensFlare const&) = default;
};

/// The blur of what a lens does not focus, by the aperture of the camera's exposure and the focal length of its field
/// of view, for a sensor 24 mm high. What blends has the blur of what lies behind it.
struct DepthOfField {
    bool enabled = false;
    float focusMeters = 2;   ///< distance along the view that is sharp, [0, 1e9]
    float blurScale = 1;     ///< times what the aperture gives, [0, 100]
    float maxRadius = 0.03f; ///< of a blurred point, as a share of the picture's height, [0, 0.1]
    float blades = 0;        ///< of the aperture: a polygon of as many sides, [3, 16]; less than 3: round
    friend bool operator==(DepthOfField const&, DepthOfField const&) = default;
};

/// The blur of what moves while the shutter is open: surfaces that are opaque or masked, and everything if the camera
/// does. What blends has the blur of what lies behind it.
struct MotionBlur {
    bool enabled = false;
    float shutterDegrees = 180; ///< the part of a frame during which the shutter is open, of 360, [0, 360]
    float maxRadius = 0.03f;    ///< half of the longest way, as a share of the picture's height, [0, 0.1]
    friend bool operator==(MotionBlur const&, MotionBlur const&) = default;
};

/// Exposure that follows the picture: the mean luminance of the pixels between two percentiles becomes middle grey. On
/// top of the camera's exposure. How fast it follows is measured in View::timeSeconds; the first frame is exposed at
/// once.
struct AutoExposure {
    bool enabled = false;
    float lowPercentile = 0.4f, highPercentile = 0.95f; ///< darker and brighter pixels do not count, [0, 1]
    float compensation = 0;                             ///< stops, [-16, 16]
    float minStops = -8, maxStops = 8;                  ///< least and most correction, [-16, 16]
    float speedUp = 3, speedDown = 1; ///< towards brighter and darker pictures, stops a second, [0, 1e3]
    friend bool operator==(AutoExposure const&, AutoExposure const&) = default;
};

/// Colour grading of light before the tone mapper, in linear Rec. 2020: vision at night; exposure, white balance,
/// channel mixer; shadows, midtones and highlights; slope, offset, power and contrast on the ACEScct logarithm;
/// saturation and vibrance; curves. The neutral values of all fields together change nothing, and cost nothing.
/// docs/finish.md has the formulas.
struct Grading {
    bool enabled = false;
    float nightAdaptation = 0; ///< [0, 1]: of an eye that sees by its rods; dark colours get brighter, bluer and paler
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
    friend bool operator==(Grading const&, Grading const&) = default;
};

/// Darker towards the corners, as a lens makes a picture.
struct Vignette {
    bool enabled = false;
    float midPoint = 0.5f;  ///< how far from the middle it begins, [0, 1]
    float roundness = 0.5f; ///< [0, 1]: from a rectangle by an ellipse (0.5) to a circle
    float feather = 0.5f;   ///< how soft its edge is, [0.05, 1]
    LinearColor color{ 0 }; ///< that the picture is multiplied by in the end, [0, 1]
    friend bool operator==(Vignette const&, Vignette const&) = default;
};

/// Noise as of photographic film, of the display's values; another one in each frame.
struct Grain {
    bool enabled = false;
    float strength = 0.05f; ///< standard deviation in the middle tones, [0, 1]
    float size = 1.5f;      ///< of a grain, pixels, [1, 8]
    friend bool operator==(Grain const&, Grain const&) = default;
};

/// A lens that bends blue light more than red: coloured fringes that grow with the distance from the middle.
struct ChromaticAberration {
    bool enabled = false;
    float strength = 0.005f; ///< how far red and blue lie apart at the corners, as a share of the height, [0, 0.1]
    friend bool operator==(ChromaticAberration const&, ChromaticAberration const&) = default;
};

/// How many pixels are drawn, before Quality::upscale or AntiAliasing::Taa makes as many of them as the view has. With
/// `dynamic`, Renderer finds the largest share, up to `scale`, that its frames have time for: docs/resolution.md.
struct Resolution {
    float2 scale{ 1 };             ///< share of View::size, each way, [0.5, 1]
    bool dynamic = false;          ///< the share follows the time that frames take
    float targetMilliseconds = 16; ///< that a frame may take, [0.1, 1000]
    float leastScale = 0.5f;       ///< the smallest share, each way, [0.5, 1]
    float headroom = 0.1f;         ///< share of the target that stays free when the picture grows, [0, 0.5]
    float history = 8;             ///< frames that must agree before the share changes, [1, 32]
    bool uniform = true;           ///< both ways alike; off: the width first, down to its least
    friend bool operator==(Resolution const&, Resolution const&) = default;
};

/// Contrast between neighbours, raised as far as none of them becomes darker than black or brighter than white.
struct Sharpening {
    bool enabled = false;
    float strength = 0.5f; ///< [0, 1]
    friend bool operator==(Sharpening const&, Sharpening const&) = default;
};

/// Pixels around the picture that are drawn and cut off in the end, so that what lies beside the picture is seen by
/// occlusion, reflections, refraction, bloom and blurs. Not while gathering frames enlarges the picture, and not of
/// render targets with depth.
struct GuardBand {
    bool enabled = false;
    float width = 0.1f; ///< on each side, as a share of the height of the picture, [0, 0.5]
    friend bool operator==(GuardBand const&, GuardBand const&) = default;
};

struct Effects {
    AmbientOcclusion ambientOcclusion{};
    ScreenReflections reflections{};
    Fog fog{};
    ContactShadows contactShadows{};
    Bloom bloom{};
    DepthOfField depthOfField{};
    MotionBlur motionBlur{};
    AutoExposure autoExposure{};
    Grading grading{};
    Vignette vignette{};
    Grain grain{};
    ChromaticAberration chromaticAberration{};
    Resolution resolution{};
    Sharpening sharpening{};
    LensFlare lensFlare{};
    GuardBand guardBand{};
    friend bool operator==(Effects const&, Effects const&) = default;
};

/// One field of Effects, for menus and help texts.
struct EffectOption {
    std::string_view name;  ///< "fog.density"
    std::string_view range; ///< in words: "a number from 0 to 10000"
};
std::span<const EffectOption> effectOptions();

/// Sets one field by name. NotFound and InvalidArgument say what is valid; `effects` is then unchanged.
Result<void> setEffect(Effects& effects, std::string_view name, std::string_view value);
/// The value of one field as text that setEffect() accepts, or nothing for an unknown name.
std::optional<std::string> effectValue(Effects const& effects, std::string_view name);
/// The matrix of exposure, white balance and channel mixer: linear Rec. 2020 from linear Rec. 709.
double3x3 gradingMatrix(Grading const& grading);
/// Every field within its range.
Effects clamped(Effects const& effects);

} // namespace filament
