// SPDX-License-Identifier: Apache-2.0
/// DirectionalAlbedo: the fraction of uniform light that the specular lobe reflects to the viewer in one bounce, with
/// and without Fresnel's weight: the exact values behind the engine's DfgTable.
///   Method  integrate(): quadrature over visible half vectors (Heitz 2018, "Sampling the GGX Distribution of Visible
///           Normals"), where the integrand G2 / G1 is bounded and smooth; midpoints in an angle of the disc's radius
///           and in its azimuth. lookUp(): cubic interpolation in a table of those, with an error below 2e-4 (tested).
///   Thread  any; the table is computed once per process.
///   Memory  96 KiB.  Cost: about 0.25 s the first time.
#pragma once

#include <filament_core/Math.h>

namespace filament_core::reference {

/// x: weighted by Schlick's (1 - voh)^5, y: by 1. As `dfg` in shaders/lib/brdf.glsl.
/// nov in (0, 1], alpha in [kMinAlpha, 1]. Height-correlated Smith.
double2 integrateDirectionalAlbedo(double nov, double alpha, int radii = 32, int azimuths = 32);

/// perceptualRoughness in [0.045, 1].
double2 directionalAlbedo(double nov, double perceptualRoughness);
/// Mean over the hemisphere, weighted by twice the cosine.
double2 averageDirectionalAlbedo(double perceptualRoughness);

/// The reflectance of a clear coat by Fresnel's equations, for uniform light. A separate table, computed at the first
/// call.
double coatAlbedo(double nov, double perceptualRoughness);
double averageCoatAlbedo(double perceptualRoughness);

} // namespace filament_core::reference
