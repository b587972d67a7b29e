// SPDX-License-Identifier: Apache-2.0
/// Atmosphere: the air around a spherical earth, and the sunlight that it scatters.
///   Model   Bruneton and Neyret 2008, "Precomputed Atmospheric Scattering": molecules and aerosols whose densities
///           fall off exponentially, with scale heights of 8 and 1.2 km; ozone and the solar spectrum as in Bruneton
///           2017, "A Qualitative and Quantitative Evaluation of 8 Clear Sky Models". Single scattering is integrated
///           along each ray; all further orders as in Hillaire 2020, "A Scalable and Production Ready Sky and
///           Atmosphere Rendering Technique", section 5.5. Here the ground reflects them too, and they keep the forward
///           light of haze (Atmosphere::even), without which a turbid sky loses a quarter of its light.
///   Space   metres; the centre of the earth is the origin, y leads up through the camera.
///   Light   relative to the sun's irradiance above the air, in eight bands of the spectrum; kBandRgb turns them into
///           klx of linear Rec. 709.
///   Thread  any. makeAtmosphere() runs on the job system; the same bits for any number of workers and machines.
///   Memory  1 MiB of tables.   Fails: never.   Cost: makeAtmosphere() 0.2 s on a core; scatteredLight() about 10 us.
#pragma once

#include "base/math/Math.h"
#include "jobsystem/JobSystem.h"

#include <array>
#include <cstddef>
#include <vector>

namespace filament_core::assets {

inline constexpr size_t kBands = 8;
using Spectrum = std::array<double, kBands>;

/// Effective wavelengths of bands of 40 nm from 400 nm on, weighed by the sun and all three colour matching functions.
inline constexpr Spectrum kBandNanometers{ 428.7, 458.0, 499.2, 541.9, 580.0, 616.7, 652.8, 689.8 };
/// What the sun above the air gives to a surface that faces it, in klx of linear Rec. 709: the spectrum of ASTM G173-03
/// times the colour matching functions of CIE 1931 in the form of Wyman et al. 2013, "Simple Analytic Approximations to
/// the CIE XYZ Color Matching Functions". Their sum has 132.6 klx.
inline constexpr std::array<double3, kBands> kBandRgb{
    double3(5.7537, -5.2275, 39.3846),   double3(0.0572, -4.0186, 87.7428),  double3(-32.0880, 34.2160, 14.4370),
    double3(-23.3066, 73.1257, -7.1894), double3(77.2076, 36.5340, -6.1037), double3(95.0554, -3.2958, -1.5162),
    double3(20.9870, -1.7414, -0.2077),  double3(0.8759, 0.0766, -0.0274)
};

inline constexpr double kGroundRadius = 6'360e3, kTopRadius = 6'460e3;
inline constexpr double kRayleighHeight = 8e3, kMieHeight = 1.2e3; ///< over which densities fall to 1/e
inline constexpr double kMieAsymmetry = 0.76;
inline constexpr double kSunRadius = 0.00465; ///< radians

/// May be negative: colours outside of Rec. 709.
double3 rgbOf(Spectrum const& spectrum);

struct AtmosphereOptions {
    double turbidity = 2.5;
    float3 groundAlbedo{ 0.18f, 0.17f, 0.15f };
    double air = 1;         ///< factor of molecules, and of the haze that turbidity relates to them
    double ozone = 1;       ///< factor of 300 Dobson units
    double mieAlbedo = 0.9; ///< share of the light that aerosols scatter
};

/// What a ray passes of each constituent, in metres of air with the density that it has at the sea, or for ozone at its
/// maximum.
struct AirColumns {
    double rayleigh = 0, mie = 0, ozone = 0;
};

struct Medium {
    Spectrum rayleigh{}, mieScattering{}, mieExtinction{}, ozone{}; ///< 1/m at density 1
};

struct Atmosphere {
    Medium medium;
    /// Without the light that aerosols scatter almost straight on, which stays in the beam: what is left of their
    /// scattering is even. Similarity: van de Hulst 1980, "Multiple Light Scattering", chapter 14.
    Medium even;
    Spectrum groundAlbedo{};
    std::vector<AirColumns> columns;  ///< up to the top of the air
    std::vector<Spectrum> multiple;   ///< mean light of the even orders around a point, 1/sr
    std::vector<Spectrum> irradiance; ///< of the ground by the sky
};

Atmosphere makeAtmosphere(AtmosphereOptions const& options, jobs::JobSystem& jobs);

/// From a point to the top of the air, on a ray that misses the ground. cosZenith in [-1, 1].
AirColumns columnsToTop(double radius, double cosZenith);
/// The share of the light that is left.
Spectrum transmittance(Medium const& medium, AirColumns const& columns);
/// The sun's disc as it is seen from a point, over the irradiance above the air; partly below the horizon it is dimmer.
Spectrum sunlight(Atmosphere const& air, double radius, double sunCosZenith);
/// Irradiance of the ground by the sky, without the sun.
Spectrum skyIrradiance(Atmosphere const& air, double sunCosZenith);

/// Scattered light that reaches the start of a ray, 1/sr. Phase functions are constant along a ray, and left out.
struct ScatteredLight {
    Spectrum rayleigh{}, mie{}; ///< of the sun, and of what aerosols scattered straight on before
    Spectrum further{};         ///< all other orders, and the ground
    Spectrum transmittance{};   ///< of the ray up to its end
    Spectrum even{};            ///< of the ray through Atmosphere::even
};
/// `direction` and `sun` are unit vectors; `radius` of the start, in [kGroundRadius, kTopRadius]; the ray ends after
/// `meters`, at the ground, or where the air does.
ScatteredLight scatteredLight(Atmosphere const& air, double radius, double3 direction, double3 sun,
                              double meters = 1e9);

/// 1/sr; the cosine is 1 where the light goes straight on.
double rayleighPhase(double cosine);
/// Cornette and Shanks 1992, "Physically reasonable analytic expression for the single-scattering phase function".
double miePhase(double cosine);

} // namespace filament_core::assets
