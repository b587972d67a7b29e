// SPDX-License-Identifier: Apache-2.0
/// EnvironmentLights: what EnvironmentLoadOptions::sun takes out of an environment, so that it casts shadows.
///   Space   that of the environment: before the rotation of EnvironmentSettings.
///   Thread  any; pure.   Memory: no heap, except for texts.
#pragma once

#include <filament_core/EnumNames.h>
#include <filament_core/Light.h>
#include <filament_core/Math.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace filament_core {

struct EnvironmentSettings;

/// How the sun of an environment is handled: docs/environments.md, "The sun".
enum class EnvironmentSun : uint8_t {
    Keep,    ///< it stays in the environment, which casts no shadows
    Extract, ///< a compact sun becomes a SunLight
    Fit,     ///< the sun and the brightest regions become EnvironmentLoadOptions::lights SunLights
};
template <>
struct EnumNames<EnvironmentSun> {
    static constexpr std::array<std::string_view, 3> values{ "keep", "extract", "fit" };
};

/// One light that was taken out.
struct ExtractedLight {
    float3 direction{ 0, 1, 0 };          ///< towards the light, unit length
    float3 illuminance{ 0 };              ///< R, G, B of a surface that faces it, in the units of radiance, >= 0
    float angularRadiusDegrees = 0.2665f; ///< of the disc with the same spread of light, [0.2665, 20]
    float share = 0;                      ///< of the luminous illuminance of a surface that faces it, [0, 1]
    bool showsDisc = false;               ///< the background has none: the sun of loadSky()
};

/// Why there are lights or none.
enum class SunSearch : uint8_t {
    Off,   ///< EnvironmentSun::Keep
    Found, ///< there are lights
    Wide,  ///< the brightest region is too wide for a sun: a lamp, a window, a sun behind clouds
    Dim,   ///< it is compact, and its share of the light is too small
    Even,  ///< there is no bright region, or no light at all
    Baked, ///< the file is a package that was baked without lights
};

/// The lights of an environment. All of it is known when it is baked, and stored in caches and packages.
struct EnvironmentLights {
    static constexpr size_t kMost = 4;
    /// The widest sun that EnvironmentSun::Extract takes.
    static constexpr float kWidestSunDegrees = 2.5f;
    /// Of the illuminance: what EnvironmentSun::Extract and each light of EnvironmentSun::Fit have at least.
    static constexpr float kLeastSunShare = 0.1f, kLeastShare = 0.01f;

    SunSearch search = SunSearch::Off;
    std::array<ExtractedLight, kMost> lights{}; ///< brightest first
    uint32_t count = 0;                         ///< of `lights`, [0, 4]
    ExtractedLight brightest{};                 ///< with Wide and Dim: the region that is no sun

    std::span<const ExtractedLight> found() const { return { lights.data(), count }; }
};

/// The light in a scene: turned and scaled by the settings of the environment. It shines on every channel, and shows no
/// disc, because the background still has the sun of the photograph; that of loadSky() shows it, without a halo.
SunLight sunLightOf(ExtractedLight const& light, EnvironmentSettings const& settings);

/// A line for each light: direction in degrees, lux, radius, share; or a line that says why there is none. Empty with
/// SunSearch::Off.
std::string explain(EnvironmentLights const& lights, EnvironmentSettings const& settings);

} // namespace filament_core
