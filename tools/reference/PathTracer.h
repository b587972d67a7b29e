// SPDX-License-Identifier: Apache-2.0
/// PathTracer: estimates the radiance along one camera ray from the numbers of one sample.
///   Method  unidirectional paths. At every surface one light sample each of the environment and of the direct lights;
///           the environment is combined with the BSDF's sample by the power heuristic (Veach 1997, "Robust Monte Carlo
///           Methods for Light Transport Simulation", section 9.2). Russian roulette from the fifth event on. Blended
///           surfaces are hit or passed at random, with weights that preserve the mean.
///   Inside  a path may enter solids and is absorbed inside. Shadow rays stop at them: paths alone find the lights
///           behind, so directional light makes noisy caustics. One solid at a time: where two touch or overlap, each
///           behaves as if in air. Where a solid disperses light, a path chooses one of three colours.
///   Scatter inside solids that scatter, paths fly to an event, where they turn, or to the surface
///           (ScatteringMedium.h), up to 65536 times, with roulette from the ninth flight on. No light is sampled
///           there, because it would have to be found through the surface; where the path leaves, it is.
///   Sides   the camera does not see single-sided materials from behind; all other rays hit both sides. Light cannot
///           pass through a triangle because of its shading normal. Emissive surfaces light others.
///   Fog     between the camera and the first surface, or the sky, alone; lit by one event of single scattering.
///   Out     exposed, as in the engine's scene-linear target.
///   Thread  radiance(): any, all at once.
#pragma once

#include "tools/reference/Bsdf.h"
#include "tools/reference/FogMedium.h"
#include "tools/reference/SampleStream.h"
#include "tools/reference/TracedScene.h"

#include <limits>

namespace filament_core::reference {

/// A point whose irradiance is wanted; positions are relative to the scene's origin.
struct ReceivingPoint {
    double3 position{ 0.0 };
    double3 normal{ 0, 0, 1 };          ///< shading normal, unit
    double3 geometricNormal{ 0, 0, 1 }; ///< unit; below it nothing arrives
    double selfAvoidance = 1e-6;        ///< metres, as SurfaceSample::selfAvoidance
};

/// What one path from a point of a surface finds.
struct Arriving {
    double3 irradiance{ 0.0 }; ///< lux times exposure; its mean over many paths is that of the surface
    bool fromSky = false;      ///< the path left without meeting a surface
    bool fromBehind = false;   ///< it first met the back of a single-sided surface, as from inside of a wall
    double meters = std::numeric_limits<double>::infinity(); ///< to the first surface that it met
};

/// Which light counts that arrives straight from lamps: suns, points, spots and areas.
enum class LampLight : uint8_t { None, Direct };

class PathTracer {
public:
    PathTracer(TracedScene const& scene, ReferenceSettings const& settings, double exposure, double3 background,
               FogMedium fog = {});

    /// `ray` is relative to the scene's origin. `rays` counts the rays traced.
    double3 radiance(Ray const& ray, SampleStream const& numbers, uint64_t& rays) const;

    /// The environment, glowing surfaces and all light that was reflected before count, whatever `lamps` is.
    ///   Method  cosine-weighted directions, with multiple importance sampling of environment and glowing surfaces.
    Arriving arriving(ReceivingPoint const& point, LampLight lamps, SampleStream const& numbers, uint64_t& rays) const;

private:
    struct Path;

    double3 follow(Path& path, std::optional<SurfaceSample> surface) const;

    double3 scatteredByFog(Path& path, Ray const& camera, double distance) const;
    std::optional<SurfaceSample> nextSurface(Path& path) const;
    bool crossMedium(Path& path, std::optional<SurfaceSample>& surface) const;
    void enterSurface(Path& path, SurfaceSample& surface) const;
    Bsdf bsdfAt(SurfaceSample const& surface) const;
    double3 missed(Path const& path) const;
    double3 lightAt(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const;
    double3 environmentSample(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const;
    double3 emissiveSample(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const;
    double emissionWeight(Path const& path) const;
    double3 directSample(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const;
    double3 unoccludedBsdfSample(Path const& path, Bsdf const& bsdf) const;
    double visibility(Path& path, SurfaceSample const& surface, double3 direction, double distance) const;
    /// `throughGlass`: ReferenceSettings::coloredShadows.
    double3 tracedVisibility(Path& path, SurfaceSample const& surface, double3 direction, double distance,
                             bool throughGlass) const;
    double environmentWeight(double bsdfPdf, double3 direction) const;
    bool reflect(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const;

    TracedScene const& mScene;
    ReferenceSettings const& mSettings;
    double mExposure;
    double3 mBackground;
    FogMedium mFog;
    bool mUseOcclusion;
};

} // namespace filament_core::reference
