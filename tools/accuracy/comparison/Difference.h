// SPDX-License-Identifier: Apache-2.0
/// Difference: the differences between two pictures of one scene, relative to the local brightness of the engine's
/// picture and of the truth.
///   Unit    of a pixel: (a - b) / (mean of |truth| and |engine| + 1 % of the mean of |truth|), lengths of RGB vectors.
///           At most 2 where one is black and the other is not, so that deep shadows do not dominate.
///   Pixels  those that show something, except those next to the background, where rasteriser and rays cover
///           differently.
///   Thread  any; pure.
#pragma once

#include "toolkit/pictures/Picture.h"

#include <filament_core/View.h>

#include <vector>

namespace filament_core::accuracy {

using namespace tools; // the toolkit

/// The weights for all differences of one scene.
class DifferenceScale {
public:
    /// A pixel counts if neither picture touches its background (black) there.
    DifferenceScale(Picture const& truth, Picture const& engine);

    bool counts(size_t pixel) const { return mFactors[pixel] > 0; }
    double factor(size_t pixel) const { return mFactors[pixel]; }
    size_t size() const { return mFactors.size(); }
    size_t pixels() const { return mCount; }

private:
    std::vector<double> mFactors; ///< of the unit above; 0: does not count
    size_t mCount = 0;
};

/// Root mean square.
double rms(Picture const& a, Picture const& b, DifferenceScale const& scale);
/// Mean of the relative difference of luminance: > 0 where a is brighter.
double bias(Picture const& a, Picture const& b, DifferenceScale const& scale);
/// Mean of (a - b) . (c - d). For a step and the whole difference, divided by the square of the whole, it is the step's
/// share; the shares of all steps sum to 1.
double product(Picture const& a, Picture const& b, Picture const& c, Picture const& d, DifferenceScale const& scale);
/// Root mean square of standard errors, in the same unit.
double noise(std::vector<float3> const& standardError, DifferenceScale const& scale);

/// Relative difference of luminance as a colour: blue where a is darker than b, red where it is brighter, white where
/// both agree; saturated at `full`.
Image differenceMap(Picture const& a, Picture const& b, DifferenceScale const& scale, double full);

/// Root mean square of the change due to 8 bits per component, in units of a display's white: `shown` are sRGB codes
/// converted to linear light, `linear` is their source.
double displayError(Picture const& shown, Picture const& linear, ToneMapper toneMapper);

/// As shown by a display: through the engine's ACES curve.
Image tonemapped(Picture const& picture);

} // namespace filament_core::accuracy
