// SPDX-License-Identifier: Apache-2.0
/// TracedScene: everything that a path queries: the next surface, the transmittance between two points, the lights.
///   Space   positions are relative to `origin()`, the centre of the scene, so that floats keep their precision far
///           from the world's origin.
///   Light   lux and radiance, not exposed.
///   Thread  read-only after prepare().
#pragma once

#include "tools/reference/DirectLights.h"
#include "tools/reference/EmissiveLights.h"
#include "tools/reference/EnvironmentLight.h"
#include "tools/reference/Intersector.h"
#include "tools/reference/Reference.h"

#include <span>

namespace filament_core::reference {

class TracedScene {
public:
    static Result<TracedScenePtr> create(ReferenceScene const& scene, jobs::JobSystem& jobs);

    double3 origin() const { return mOrigin; }
    std::optional<Hit> nearest(Ray const& ray) const { return mIntersector.nearest(ray); }
    Part const& part(Hit const& hit) const { return mParts[hit.part]; }
    /// The fraction of light that passes from the ray's origin to `ray.farthest`: blended surfaces transmit part of it.
    /// `throughGlass`: what transmits light lets it pass straight through; otherwise only blended surfaces do.
    double3 transmittance(Ray const& ray, bool throughGlass) const;

    EnvironmentLight const& environment() const { return mEnvironment; }
    DirectLights const& directLights() const { return mDirectLights; }
    EmissiveLights const& emissiveLights() const { return mEmissiveLights; }
    bool skybox() const { return mSkybox; }
    double environmentLux() const { return mEnvironmentLux; } ///< 0: there is none
    std::span<const SunLight> suns() const { return mSuns; }
    std::vector<std::string> const& warnings() const { return mWarnings; }

private:
    explicit TracedScene(Intersector&& intersector) : mIntersector(std::move(intersector)) {}

    std::vector<std::shared_ptr<const assets::ModelData>> mModels; // parts refer to their materials and images
    std::vector<Part> mParts;
    Intersector mIntersector;
    double3 mOrigin{ 0.0 };
    bool mHasBlended = false;
    EnvironmentLight mEnvironment;
    DirectLights mDirectLights;
    EmissiveLights mEmissiveLights; // refers to mParts
    bool mSkybox = false;
    double mEnvironmentLux = 0;
    std::vector<SunLight> mSuns;
    std::vector<std::string> mWarnings;
};

} // namespace filament_core::reference
