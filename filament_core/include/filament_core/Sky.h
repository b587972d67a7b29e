// SPDX-License-Identifier: Apache-2.0
/// loadSky: a clear sky with its sun, computed from the physics of the air, as light and background of a scene.
///   In      where the sun is, haze, ground, altitude.   Out: an Environment in physical units, whose lights() have the
///           sun: Scene::setEnvironment() adds it as a SunLight with shadows.
///               Result<Environment> sky = loadSky(engine, { .directionToSun = { 0.3f, 0.5f, 0.8f }, .turbidity = 3 });
///               if (sky) scene.setEnvironment(*sky, kSkySettings);
///   Space   +Y is up, y = 0 lies at SkyDesc::altitudeMeters above the sea.
///   Cost    0.2 to 0.5 s of one core, by SkyDesc::height, shared by the workers, and the filtering of any environment
///           of that size (docs/sky.md); nothing per frame. There is no cache on disk.
///   Errors  InvalidArgument with the option and its range.
///   Thread  the app thread, which waits for the workers. The bits are those of any number of workers.
#pragma once

#include <filament_core/Effects.h>
#include <filament_core/Engine.h>
#include <filament_core/Environment.h>
#include <filament_core/LoadOptions.h>
#include <filament_core/SkyDesc.h>

namespace filament_core {

/// Radiances of a sky are in kcd/m^2.
inline constexpr EnvironmentSettings kSkySettings{ .illuminance = Lux{ 1000 } };

/// `sun` and `lights` of the options do not count: the sun is always a light, and never in the panorama. Below the
/// horizon there is none.
Result<Environment> loadSky(Engine& engine, SkyDesc const& sky, EnvironmentLoadOptions const& options = {});

/// Aerial perspective: fog with the extinction of that air, its fall-off with height, and the light that it scatters
/// into the view, the mean over all level directions. For kSkySettings. docs/sky.md has its error: fog is grey, where
/// air takes blue light first.
Result<Fog> skyFog(Engine& engine, SkyDesc const& sky);

} // namespace filament_core
