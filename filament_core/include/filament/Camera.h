// SPDX-License-Identifier: Apache-2.0
/// Camera: position and orientation, lens and exposure. A plain value.
///   Position and orientation are double precision: the image is the same a million kilometres from the origin.
///   The depth buffer is reversed with an infinite far plane; only the near plane can be tuned.
#pragma once

#include <filament/Math.h>

namespace filament {

/// Photographic exposure. Lagarde & de Rousiers 2014, "Moving Frostbite to PBR", section 5.1.
struct Exposure {
    float aperture = 16.0f;            ///< f-stops, > 0
    float shutterSeconds = 1.0f / 125; ///< > 0
    float iso = 100.0f;                ///< > 0

    friend bool operator==(Exposure const&, Exposure const&) = default;
    /// log2(N^2 / t * 100 / S)
    float ev100() const;
    /// The factor for luminance in nits before tone mapping: 1 / (1.2 * 2^EV100).
    float factor() const;

    /// The luminance in nits that a reflected-light meter reads as `ev100`: 2^(EV100 - 3), with the calibration constant
    /// K = 12.5. For emissive colours given in EV (materials guide, 3.1.18).
    static float luminance(float ev100);
    /// The illuminance in lux that an incident-light meter reads as `ev100`: 2.5 * 2^EV100, with C = 250.
    static float illuminance(float ev100);
};

struct Lens {
    float verticalFovDegrees = 45.0f; ///< (0, 180)
    float nearMeters = 0.01f;         ///< > 0; distance of the near plane
};

struct Camera {
    double4x4 worldFromView{ 1.0 }; ///< rigid: rotation and position. Looks down -Z, +Y is up
    Lens lens{};
    Exposure exposure{};

    /// `up` need not be perpendicular to the view. If it is parallel, another direction is used.
    static Camera lookAt(double3 eye, double3 at, Lens lens = {}, Exposure exposure = {}, double3 up = { 0, 1, 0 });

    double3 position() const { return double3(worldFromView[3]); }
    /// Clip from view: +Y of the view is row 0 of the image, z = near / distance (1 at the near plane, 0 at infinity).
    float4x4 clipFromView(float aspect) const;
};

} // namespace filament
