// SPDX-License-Identifier: Apache-2.0
/// SheenAlbedo: the fraction of uniform light that a sheen reflects to the viewer: the exact values behind the third
/// channel of the engine's DfgTable, ndfCharlie() * visibilityNeubelt().
///   Method  quadrature over half vectors distributed like the fibres; an interpolated table of the results.
///   Thread  any; the tables are computed at the first call: 0.3 s.
#pragma once

#include <filament_core/Math.h>

namespace filament_core::reference {

/// Not limited: exceeds 1 for smooth fibres at grazing angles. nov in (0, 1], alpha in [kMinAlpha, 1].
double integrateSheenAlbedo(double nov, double alpha, int steps = 96);

/// The same from the table. perceptualRoughness in [0.045, 1].
double sheenAlbedo(double nov, double perceptualRoughness);

/// For the lobe times the smaller sheenLimit() of view and light, which never gains energy; and its mean.
double limitedSheenAlbedo(double nov, double perceptualRoughness);
double averageLimitedSheenAlbedo(double perceptualRoughness);

} // namespace filament_core::reference
