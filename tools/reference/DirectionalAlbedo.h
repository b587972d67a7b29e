// SPDX-License-Identifier: Apache-2.0
/// DirectionalAlbedo: how much of the light from everywhere the specular lobe sends to the viewer after one bounce,
/// with and without Fresnel's weight: the exact numbers behind the engine's DfgTable.
///   Method  integrate(): quadrature over visible half vectors (Heitz 2018, "Sampling the GGX Distribution of Visible
///           Normals"), where the integrand G2 / G1 is bounded and smooth; midpoints in an angle of the disc's radius
///           and in its azimuth. lookUp(): cubic interpolation in a table of those, error below 2e-4 (a test says so).
///   Thread  any; the table is made once in a process.
///   Memory  96 KiB.  Cost: about 0.25 s the first time.
#pragma once

#include <filament/Math.h>

namespace filament::reference {

/// x: weighted by Schlick's (1 - voh)^5, y: by 1. As `dfg` in shaders/lib/brdf.glsl.
/// nov in (0, 1], alpha in [kMinAlpha, 1]. Height-correlated Smith.
double2 integrateDirectionalAlbedo(double nov, double alpha, int radii = 32, int azimuths = 32);

/// perceptualRoughness in [0.045, 1].
double2 directionalAlbedo(double nov, double perceptualRoughness);
/// Over the hemisphere, weighted by twice the cosine.
double2 averageDirectionalAlbedo(double perceptualRoughness);

/// What a clear coat reflects by Fresnel's equations, and the same of light from everywhere. A table of its own, made
/// at the first call.
double coatAlbedo(double nov, double perceptualRoughness);
double averageCoatAlbedo(double perceptualRoughness);

} // namespace filament::reference
