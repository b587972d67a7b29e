// SPDX-License-Identifier: Apache-2.0
/// Lights, in photometric units. Plain descriptions: Scene::add takes them and returns a handle. For a light attached
/// to a node, "World" in a field's name means the space of that node.
///   Fails   assertions of Scene::add, which name the rule: positions, intensities, colours and ranges are finite,
///           directions not zero, cones 0 <= inner < outer <= pi/2; intensities, colours and ranges are not negative.
///   Limits  of lights other than the sun: 4096 that reach into a view, and 256 that reach any froxel, a cell a
///           sixteenth of the screen wide and at most half as deep as it is far away. Beyond, the dimmest at the
///           camera are skipped; Renderer::explain() reports how many.
///   Cost    that of the lights whose range includes what is drawn: give lamps a range. An unlimited light shades every
///           fragment.
#pragma once

#include <filament_core/Color.h>
#include <filament_core/Math.h>
#include <filament_core/Objects.h>
#include <filament_core/Units.h>

#include <cstdint>
#include <numbers>
#include <variant>

namespace filament_core {

/// Bit n: channel n. A light shines on a renderable if they share a channel. By default both are on channel 0 only.
/// Channels do not affect shadows: every shadow caster occludes the light. No channel: the
/// light is off, the renderable has the light of the environment only.
using LightChannels = uint8_t;
inline constexpr LightChannels kDefaultLightChannels = 1;

/// Parallel light; a scene has any number. The brightest without a cookie is the sun of the uniforms and of the
/// directional shader variant. The others are among the 4096 lights of a view, in the order of the scene: they cost
/// what an unlimited point costs, and materials compiled without dynamic lighting ignore them.
struct SunLight {
    float3 directionWorld{ 0, -1, 0 }; ///< the direction in which the light travels; any length except zero
    Lux illuminance{ 110'000 };        ///< on a surface facing it, [0, 1e12]
    LinearColor color{ 1.0f };         ///< linear, [0, 1e9]
    /// Half of its diameter in the sky, [0, 20]: softness of its shadows with ShadowFilter::Pcss.
    float angularRadiusDegrees = 0.2665f;
    /// In views of the sky: a disc of that radius, and a halo around it. They do not affect
    /// lighting. docs/lights.md, "A sun in the sky".
    bool showsDisc = false;
    float haloSize = 10;      ///< radius of the halo over that of the disc, [1, 1000]; 1: none
    float haloFalloff = 80;   ///< exponent by which it fades, [0, 10'000]
    bool castsShadows = true; ///< in views with Quality::shadows
    /// Screen-space shadows of casters too small for shadow maps: Effects::contactShadows. docs/shadows.md.
    bool contactShadows = false;
    LightChannels lightChannels = kDefaultLightChannels;
    LightImage cookie{};     ///< Tiled: repeated over the world, such as shadows of clouds. None: white
    float cookieMeters = 10; ///< width of the image across the direction, > 0; the height follows from its pixels
    /// By which the image moves to its right and down. Without, the origin of the world is a corner of it.
    float2 cookieOffsetMeters{ 0.0f };
    /// Of the cookie: its right is cross(directionWorld, upWorld). Only the part across the direction counts. None: any
    float3 upWorld{ 0, 1, 0 };
};

/// A profile makes it a luminaire: `intensity` is that of the brightest direction, and the profile scales the others
/// relative to it. Engine::describe(profile).peak is the intensity that the file measured.
struct PointLight {
    double3 positionWorld{ 0 };
    Candela intensity{ 100 }; ///< >= 0; Photometry.h: from lumens, watts and lux
    LinearColor color{ 1.0f };
    float rangeMeters = 0; ///< the light is exactly zero beyond this range; 0: unlimited
    /// Of the ball that shines, >= 0: softness of its shadows with ShadowFilter::Pcss. It is lit as if from the
    /// centre.
    float sourceRadiusMeters = 0;
    bool castsShadows = true;
    bool contactShadows = false; ///< see SunLight
    LightChannels lightChannels = kDefaultLightChannels;
    LightProfile profile{}; ///< none: as bright in every direction
    LightImage cookie{};    ///< Octahedron or Cube: multiplied with the light, in the frame of -Z along directionWorld,
                            ///< +X along cross(directionWorld, upWorld). None: white
    /// Where both angles of the profile are zero; any length except zero. Unused without a profile and a cookie.
    float3 directionWorld{ 0, 0, -1 };
    /// With `directionWorld` it gives the side where the horizontal angle is zero, cross(directionWorld, upWorld). Only
    /// the part across the direction counts. None: any
    float3 upWorld{ 0, 1, 0 };
};

/// The intensity is that of the inner cone, whatever the cone: a narrower one gives less light. spotIntensity() keeps
/// that for lumens; focusedSpotIntensity() makes a narrower cone brighter. With a profile it is that of the profile's
/// brightest direction, and the cone multiplies the profile.
struct SpotLight {
    double3 positionWorld{ 0 };
    float3 directionWorld{ 0, 0, -1 };
    Candela intensity{ 100 };
    LinearColor color{ 1.0f };
    float rangeMeters = 0;
    float innerConeRadians = 0;          ///< [0, outer)
    float outerConeRadians = 0.7853982f; ///< (inner, pi/2]
    float sourceRadiusMeters = 0;
    bool castsShadows = true;
    bool contactShadows = false; ///< see SunLight
    LightChannels lightChannels = kDefaultLightChannels;
    LightProfile profile{}; ///< aimed along directionWorld; see PointLight
    /// Projected: multiplied with the light. The outer cone touches its nearer edges, up to 80 degrees; beyond them
    /// it is dark. Seen along directionWorld, with upWorld upwards. None: white
    LightImage cookie{};
    float3 upWorld{ 0, 1, 0 }; ///< of the profile and the cookie; see PointLight
};

// ---- area lights, as bright in every direction: docs/lights-area.md
//   Shape     they light surfaces; `isVisible` draws them as well.
//   Units     luminance, or by luminanceFromFlux() the luminous flux of the whole light. A luminance that is not a
//             number, infinite or negative counts as 0. Sizes are finite and >= 0; without an area there is no light.
//   Range     at the distance rangeMeters from its centre the light has faded to exactly zero; 0: unlimited.
//   Shadows   those of a point at the centre, which ShadowFilter::Pcss softens like those of a disc of the same area;
//             with AreaShadows::Shape those of the shape. The drawn shape casts none.
//   Nodes     turn and move them; a scale does not change their size.

/// A rectangle around a position. Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly
/// Transformed Cosines".
struct RectLight {
    double3 positionWorld{ 0 };
    float3 directionWorld{ 0, 0, -1 }; ///< in which it shines; any length except zero
    float3 upWorld{ 0, 1, 0 };         ///< along its height; only the part across the direction counts. None: any
    float widthMeters = 1, heightMeters = 1;
    LightImage image{}; ///< Emitted: multiplied with the luminance; upright as seen from the front. None: white
    Nits luminance{ 1000 };
    LinearColor color{ 1.0f };
    float rangeMeters = 0;
    bool isTwoSided = false; ///< also shines against its direction, as bright
    bool castsShadows = true;
    bool isVisible = false; ///< drawn with its luminance and image, on the sides that shine
    LightChannels lightChannels = kDefaultLightChannels;
};

/// A disc around a position: a polygon of 16 corners that has its area.
struct DiscLight {
    double3 positionWorld{ 0 };
    float3 directionWorld{ 0, 0, -1 };
    float radiusMeters = 0.5f;
    Nits luminance{ 1000 };
    LinearColor color{ 1.0f };
    float rangeMeters = 0;
    bool isTwoSided = false;
    bool castsShadows = true;
    bool isVisible = false; ///< drawn with its luminance, on the sides that shine
    LightChannels lightChannels = kDefaultLightChannels;
};

/// The side of a cylinder, without its ends: at every point it is the rectangle that covers it in view of that point.
struct TubeLight {
    double3 positionWorld{ 0 };  ///< of its middle
    float3 axisWorld{ 1, 0, 0 }; ///< any length except zero
    float lengthMeters = 1, radiusMeters = 0.02f;
    Nits luminance{ 1000 };
    LinearColor color{ 1.0f };
    float rangeMeters = 0;
    bool castsShadows = true;
    bool isVisible = false; ///< drawn with its luminance, on the sides that shine
    LightChannels lightChannels = kDefaultLightChannels;
};

/// Any light, for Scene::add() and set().
using LightDesc = std::variant<SunLight, PointLight, SpotLight, RectLight, DiscLight, TubeLight>;

namespace detail {
inline Nits luminanceOf(Lumen flux, double area) {
    return { area > 0 ? static_cast<float>(double{ flux.value } / (std::numbers::pi * area)) : 0.0f };
}
} // namespace detail

/// The luminance of a light of this size that gives off `flux` in total. An area A that shines equally into all
/// directions of one side gives off pi A L (Lambert 1760); a tube has the area 2 pi radius length. 0 without an area.
inline Nits luminanceFromFlux(Lumen flux, RectLight const& light) {
    return detail::luminanceOf(flux,
                               double{ light.widthMeters } * double{ light.heightMeters } * (light.isTwoSided ? 2 : 1));
}
inline Nits luminanceFromFlux(Lumen flux, DiscLight const& light) {
    return detail::luminanceOf(flux, std::numbers::pi * double{ light.radiusMeters } * double{ light.radiusMeters } *
                                             (light.isTwoSided ? 2 : 1));
}
inline Nits luminanceFromFlux(Lumen flux, TubeLight const& light) {
    return detail::luminanceOf(flux,
                               2 * std::numbers::pi * double{ light.radiusMeters } * double{ light.lengthMeters });
}

} // namespace filament_core
