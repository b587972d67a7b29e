// SPDX-License-Identifier: Apache-2.0
/// DfgTable: the part of the split sum that depends only on the surface, for every environment and material.
///   Out     RGBA16F, size x size; column: nov = (x + 0.5) / size, row: perceptual roughness = (y + 0.5) / size.
///           green = integral of D V n.l over the hemisphere: the single-bounce reflectance of a white surface;
///           red = the same weighted by Schlick's (1 - voh)^5. This is the form of Lagarde and Golubev 2018, "The Road
///           toward Unified Rendering", which also restores multiple scattering: specularDfg(), energyCompensation().
///           blue = the reflectance of a white sheen of that roughness: Charlie's distribution, Neubelt's visibility,
///           which exceeds 1 for smooth fibres at grazing angles; sheenLimit() and sheenAlbedoScaling() handle that.
///           alpha = the same for Ashikhmin's velvet with Neubelt's visibility.
///   Method  Gauss-Legendre quadrature, with 128 values of the lobe for red and green and 192 for each of the others,
///           in coordinates where they are smooth: errors below 3e-4, relative to the value where it exceeds 1.
///   Thread  runs on the job system; the same bits for any number of workers.
///   Fails   never.  Cost: bench/filament_core/assets/IblBench.cpp; about 35 ms of one core for 64 x 64.
#pragma once

#include "base/math/Math.h"
#include "filament_core/assets/image/Image.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::assets {

/// One entry. nov in [0.001, 1], alpha in [kMinAlpha, 1]. Returns (red, green) as above.
float2 integrateDfg(float nov, float alpha);

/// Blue of one entry. Same ranges. Returns values >= 0, up to about 8.
float integrateSheen(float nov, float alpha);

/// Alpha of one entry. Same ranges. Returns [0, 1].
float integrateVelvet(float nov, float alpha);

Image bakeDfgTable(jobs::JobSystem& jobs, uint32_t size = 64);

} // namespace filament_core::assets
