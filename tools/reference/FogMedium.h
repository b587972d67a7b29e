// SPDX-License-Identifier: Apache-2.0
/// FogMedium: the fog between the camera and what a camera ray meets first, by the definition of docs/fog.md: the
/// density along the ray is summed up, where the engine has a closed form.
///   Colour  with Fog::colorFromEnvironment, what a mirror of roughness 1 shows: D of GGX is constant there, so the
///           lobe of the engine's last level is the cosine, and the colour is irradiance / pi around the ray, here by
///           three bands of harmonics.
///   Noise   the transmittance of what the density is more or less than its mean, by residual ratio tracking (Novak et
///           al. 2014, "Residual Ratio Tracking for Estimating Attenuation in Participating Media"): without error of a
///           step, at the price of noise. Fog::maximumOpacity limits each estimate, which is exact at 1 only.
///   Thread  read-only after construction.   Memory: none; the environment outlives it.
#pragma once

#include "base/math/Math.h"
#include "tools/reference/EnvironmentLight.h"
#include "tools/reference/SampleStream.h"

#include <filament_core/Effects.h>
#include <filament_core/Light.h>

#include <span>

namespace filament_core::reference {

/// The light that fog scatters, exposed.
struct FogLight {
    double ambient = 1; ///< times Fog::color
    double exposure = 1;
    std::span<const SunLight> suns{};              ///< the brightest makes the glow
    EnvironmentLight const* environment = nullptr; ///< for Fog::colorFromEnvironment; none: as without that
};

/// Random numbers of a path from a dimension on; fog without noise needs none.
struct FogNumbers {
    SampleStream const* stream = nullptr;
    uint32_t dimension = 0;

    double next() { return stream->pair(dimension++).x; }
};

class FogMedium {
public:
    FogMedium() = default; ///< none
    /// `height`: of the camera, in the world. `place`: of the camera, in metres, from where the noise begins.
    FogMedium(Fog const& fog, double height, FogLight const& light, double3 place = double3(0.0));

    /// `color` as the camera sees it from `distance` (infinite: a sky) in this unit direction, if what it sees there
    /// covers this share of it, of which `color` is the light.
    double3 inFront(double3 color, double3 share, double3 direction, double distance, FogNumbers numbers = {}) const;

    /// Whether lamps and suns light it along the ray (Fog::volumetric): single scattering; like surfaces, it gets their
    /// light unweakened, unless Fog::attenuatesLight says otherwise.
    bool isLit() const { return mFog.enabled && mFog.volumetric && mFog.density > 0; }
    /// A point of the ray in the fog before `distance`, chosen in proportion to the share of light that it scatters to
    /// the camera.
    struct Event {
        double distance = 0;
        double opacity = 0; ///< of all fog before `distance`: the weight of the event; 0: none
    };
    Event sample(double3 direction, double distance, double u, FogNumbers numbers = {}) const;
    /// The share of a light that reaches the fog from that direction and distance (infinite: a sun). `point`: from the
    /// camera, in metres.
    double shareOnTheWay(double3 point, double3 toLight, double distance, FogNumbers numbers) const;
    /// The share of a light from direction `toLight` that an event scatters to the camera, 1/sr.
    double3 phase(double3 direction, double3 toLight) const;

private:
    double3 colorTowards(double3 direction) const;
    bool varies() const { return mFog.volumetric && mFog.noiseAmplitude > 0; }
    double noiseAt(double3 point) const;
    double opticalDepth(double rise, double from, double to) const;
    double opacity(double3 direction, double from, double to, FogNumbers numbers) const;
    double logDensityAt(double height) const;
    double residualTransmittance(double3 origin, double3 direction, double from, double to, FogNumbers& numbers) const;

    Fog mFog{};
    double mHeight = 0;
    double3 mPlace{ 0.0 };
    EnvironmentLight const* mEnvironment = nullptr;
    double3 mColor{ 0.0 }, mSun{ 0.0 }, mTowardsSun{ 0, 1, 0 };
};

} // namespace filament_core::reference
