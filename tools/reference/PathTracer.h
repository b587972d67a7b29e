// SPDX-License-Identifier: Apache-2.0
/// PathTracer: the radiance along one camera ray, estimated from one sample's numbers.
///   Method  unidirectional paths; at every surface one light sample each of the environment and of the direct lights,
///           the environment combined with the BSDF's sample by the power heuristic (Veach 1997, "Robust Monte Carlo
///           Methods for Light Transport Simulation", section 9.2). Russian roulette from the fifth event on.
///           Blended surfaces are chosen or passed by chance, with the weights that keep the mean.
///   Inside  a path may enter solids; the way inside is absorbed. Shadow rays stop at them: what lies behind is found
///           by paths alone, so that light from one direction makes caustics of much noise. One solid at a time: where
///           two touch or overlap each is in air. Where a solid disperses light, a path takes one of three colours.
///   Visible single-sided materials are not seen from behind by the camera; every other ray meets both sides, as light
///           would. Light is not carried through a triangle by its shading normal. Emissive surfaces light others
///           when paths happen to meet them.
///   Out     exposed, as in the engine's scene-linear target.
///   Thread  radiance(): any, all at once.
#pragma once

#include "tools/reference/Bsdf.h"
#include "tools/reference/SampleStream.h"
#include "tools/reference/TracedScene.h"

namespace filament::reference {

class PathTracer {
public:
    PathTracer(TracedScene const& scene, ReferenceSettings const& settings, double exposure, double3 background);

    /// `ray` relative to the scene's origin. `rays` counts those traced.
    double3 radiance(Ray const& ray, SampleStream const& numbers, uint64_t& rays) const;

private:
    struct Path;

    std::optional<SurfaceSample> nextSurface(Path& path) const;
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
    double environmentWeight(double bsdfPdf, double3 direction) const;
    bool reflect(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const;

    TracedScene const& mScene;
    ReferenceSettings const& mSettings;
    double mExposure;
    double3 mBackground;
    bool mUseOcclusion;
};

} // namespace filament::reference
