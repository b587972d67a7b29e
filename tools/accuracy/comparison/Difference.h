// SPDX-License-Identifier: Apache-2.0
/// Difference: how two pictures of one scene differ, relative to how bright the engine and the truth are there.
///   Unit    of a pixel: (a - b) / (mean of |truth| and |engine| + 1 % of the mean of |truth|), lengths of RGB vectors.
///           At most 2 wherever one is black and the other is not: deep shadows do not decide alone.
///   Pixels  those that show something; not those beside the background, which a rasteriser and rays own differently.
///   Thread  any; pure.
#pragma once

#include "tools/accuracy/Picture.h"

#include <filament/View.h>

#include <vector>

namespace filament::accuracy {

/// What every difference of one scene is weighed by.
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
/// Mean of (a - b) . (c - d): of a step and the whole, over the square of the whole, it is the step's share, and the
/// shares of all steps add up to 1.
double product(Picture const& a, Picture const& b, Picture const& c, Picture const& d, DifferenceScale const& scale);
/// Root mean square of standard errors, in the same unit.
double noise(std::vector<float3> const& standardError, DifferenceScale const& scale);

/// Relative difference of luminance as colour: blue where a is darker than b, red where it is brighter, white where
/// both agree; full colour at `full`.
Image differenceMap(Picture const& a, Picture const& b, DifferenceScale const& scale, double full);

/// Root mean square of what 8 bits a component change, in units of a display's white: `shown` are sRGB codes made
/// linear, `linear` is what they were made of.
double displayError(Picture const& shown, Picture const& linear, ToneMapper toneMapper);

/// As a display shows it: the ACES curve of the engine.
Image tonemapped(Picture const& picture);

} // namespace filament::accuracy
