// SPDX-License-Identifier: Apache-2.0
/// Camera: position and orientation, lens and exposure. A plain value.
///   Position and orientation are double precision: the image is the same a million kilometres from the origin.
///   The depth buffer is reversed. A perspective lens has an infinite far plane, and only the near plane can be tuned;
///   an orthographic one ends at Lens::farMeters.
#pragma once

#include <filament_core/Math.h>

namespace filament_core {

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

    /// The luminance in nits that a reflected-light meter reads as `ev100`: 2^(EV100 - 3), with the calibration
    /// constant K = 12.5. For emissive colours given in EV (materials guide, 3.1.18).
    static float luminance(float ev100);
    /// The illuminance in lux that an incident-light meter reads as `ev100`: 2.5 * 2^EV100, with C = 250.
    static float illuminance(float ev100);
};

/// The projection. The defaults are a symmetric perspective lens;
/// Lens::orthographic() and Lens::offCenter() create others.
struct Lens {
    float verticalFovDegrees = 45.0f; ///< (0, 180); perspective only
    float nearMeters = 0.01f;         ///< distance of the near plane: > 0, or >= 0 if orthographic
    /// Height of the image in metres of an orthographic lens. 0: perspective.
    float orthographicHeight = 0;
    float farMeters = 1000; ///< > nearMeters; orthographic only: nothing is drawn beyond it
    /// Lens shift, in sizes of the image: (1, 0) shows the part just right of it, (0, 0.5) half an image more
    /// above.
    float2 shift{ 0 };
    float aspect = 0; ///< width / height of the image; 0: that of the view, so that circles are round

    bool isOrthographic() const { return orthographicHeight > 0; }

    /// An orthographic lens that shows x in [left, right] and y in [bottom, top], in metres of the view's space.
    static Lens orthographic(float left, float right, float bottom, float top, float nearMeters = 0,
                             float farMeters = 1000);
    /// A perspective lens that shows x in [left, right] and y in [bottom, top] of the plane at distance 1: a
    /// part of a wall of screens, or an eye off the centre of its display.
    static Lens offCenter(float left, float right, float bottom, float top, float nearMeters = 0.01f);
    /// The perspective lens of a camera, by its focal length and the height of its sensor or film, both > 0: the field
    /// of view is 2 atan(height / (2 focal length)). 24 mm is the height of a full frame.
    static Lens fromFocalLength(float millimeters, float sensorHeightMillimeters = 24, float nearMeters = 0.01f);
};

struct Camera {
    double4x4 worldFromView{ 1.0 }; ///< rigid: rotation and position. Looks down -Z, +Y is up
    Lens lens{};
    Exposure exposure{};

    /// `up` need not be perpendicular to the view. If it is parallel, another direction is used.
    static Camera lookAt(double3 eye, double3 at, Lens lens = {}, Exposure exposure = {}, double3 up = { 0, 1, 0 });

    double3 position() const { return double3(worldFromView[3]); }
    /// Clip from view: +Y of the view is row 0 of the image. Perspective: z = near / distance (1 at the near plane, 0
    /// at infinity); orthographic: z falls linearly from 1 at the near to 0 at the far plane. `aspect`: of the view;
    /// Lens::aspect overrides it.
    float4x4 clipFromView(float aspect) const;
    /// The inverse: the point shown at `clip` (x and y as above: (-1, -1) is its upper left corner) at
    /// a distance along the view. In the space of the view; in double precision.
    double3 viewFromPicture(double2 clip, double distanceMeters, double aspect) const;
};

} // namespace filament_core
