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

/// Light that lenses and eyes scatter around what is bright. It is taken from where it was: the picture as a whole is no
/// brighter. Before tone mapping; in all directions alike.
struct Bloom {
    bool enabled = false;
    float strength = 0.1f; ///< share of the light that is scattered, [0, 1]
    float radius = 0.1f;   ///< how far, as a share of the picture's height, [0.001, 1]: that of the widest of its lobes
    float threshold = 0;   ///< only what is brighter is scattered, by that much, [0, 1e4]; 1 is white
    friend bool operator==(Bloom const&, Bloom const&) = default;
};

struct Effects {
    AmbientOcclusion ambientOcclusion{};
    ScreenReflections reflections{};
    Fog fog{};
    ContactShadows contactShadows{};
    Bloom bloom{};
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
/// Every field within its range.
Effects clamped(Effects const& effects);

} // namespace filament
