// SPDX-License-Identifier: Apache-2.0
/// LtcFit: fits linearly transformed cosines (shaders/lib/ltc.glsl) to the engine's GGX lobe. Heitz, Dupuy, Hill and
/// Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines".
///   Lobe    D V n.l of shaders/lib/brdf.glsl over its integral; the integral itself, and that with Schlick's factor,
///           are in the DFG table (DfgTable.h), which shaders multiply by.
///   Error   the triangular discrimination, the integral of (f - g)^2 / (f + g), as a sum over directions that both
///           lobes distribute. It bounds from both sides what a light of any shape may gain or lose.
///   Method  Nelder and Mead 1965, "A Simplex Method for Function Minimization", begun at the neighbour's solution.
///   Thread  pure functions. Cost: 50 ms a fit. Fails: never.
#pragma once

#include "base/math/Math.h"

#include <vector>

namespace filament_core::tools {

/// a, b and d of shaders/lib/ltc.glsl.
struct LtcTerms {
    double a = 1, b = 0, d = 1;
};

/// A lobe, seen from the direction whose cosine is nov. nov in [0.002, 1], perceptual roughness in [0.045, 1].
class GgxLobe {
public:
    GgxLobe(double nov, double perceptualRoughness);

    double nov() const { return mView.z; }
    double alpha() const { return mAlpha; }
    double3 view() const { return mView; }
    double norm() const { return mNorm; } ///< the integral of D V n.l
    /// D V n.l; 0 below the horizon.
    double value(double3 light) const;
    /// A direction for two numbers in [0, 1], for one half of the lobe: with y >= 0. Heitz 2018, "Sampling the GGX
    /// Distribution of Visible Normals"; Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
    double3 sample(double u, double v) const;
    /// value() over the density of sample(): what each direction counts for.
    double weight(double3 light) const;

private:
    double mAlpha;
    double3 mView;
    double mNorm = 1;
};

/// The terms of a mirror of this roughness.
LtcTerms mirrorTerms(double nov, double alpha);

LtcTerms fitLtc(GgxLobe const& lobe, LtcTerms start);

/// Half of the integral of |f - g|: no light, whatever its shape, gains or loses more, as a part of norm(). [0, 1].
double totalVariation(GgxLobe const& lobe, LtcTerms terms);

/// Entries of shader::kLtcTable, row after row of `size`; a row is a roughness.
std::vector<float3> fitLtcTable(int size);

/// The interpolated terms of such a table.
LtcTerms lookUpLtc(const float* table, double nov, double perceptualRoughness);

} // namespace filament_core::tools
