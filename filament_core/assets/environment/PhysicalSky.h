// SPDX-License-Identifier: Apache-2.0
/// PhysicalSky: the sky of a SkyDesc as a panorama, its sun as a light, and its air as fog.
///   Model   Atmosphere.h.
///   Out     kcd/m^2 and klx of linear Rec. 709; colours outside of it lose their negative components. No disc is in
///           the panorama.
///   Method  in each row of the panorama 17 azimuths around the sun are integrated, because without their phase
///           functions they vary slowly; pixels interpolate cubically, and multiply by their own phase functions.
///   Thread  runs on the job system; the same bits for any number of workers.
///   Fails   InvalidArgument with the option's name and range.   Cost: docs/sky.md.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/environment/Environment.h"
#include "filament_core/assets/image/HdrImage.h"
#include "jobsystem/JobSystem.h"

#include <filament_core/Effects.h>
#include <filament_core/SkyDesc.h>

namespace filament_core::assets {

struct PhysicalSky {
    HdrImage panorama;
    EnvironmentLights lights{}; ///< the sun; none where its disc is below the horizon
};
Result<PhysicalSky> makePhysicalSky(SkyDesc const& desc, jobs::JobSystem& jobs);

/// That sky filtered as light. Its lights are those of the sky.
Result<EnvironmentData> bakePhysicalSky(SkyDesc const& desc, jobs::JobSystem& jobs, EnvironmentOptions options);

Result<Fog> physicalFog(SkyDesc const& desc, jobs::JobSystem& jobs);

} // namespace filament_core::assets
