// SPDX-License-Identifier: Apache-2.0
/// SheenAlbedo: how much of the light from everywhere a sheen sends to the viewer: the exact numbers behind the third
/// channel of the engine's DfgTable, ndfCharlie() * visibilityNeubelt().
///   Method  quadrature over half vectors distributed as the fibres; a table of those, interpolated.
///   Thread  any; the tables are made at the first call: 0.3 s.
#pragma once

#include <filament/Math.h>

namespace filament::reference {

/// Not limited: above 1 for smooth fibres at grazing angles. nov in (0, 1], alpha in [kMinAlpha, 1].
double integrateSheenAlbedo(double nov, double alpha, int steps = 96);

/// The same from the table. perceptualRoughness in [0.045, 1].
double sheenAlbedo(double nov, double perceptualRoughness);

/// Of the lobe times the lesser sheenLimit() of view and light, which reflects no more than it gets; and its mean.
double limitedSheenAlbedo(double nov, double perceptualRoughness);
double averageLimitedSheenAlbedo(double perceptualRoughness);

} // namespace filament::reference
