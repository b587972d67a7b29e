// SPDX-License-Identifier: Apache-2.0
/// DirectLights: suns, points and spots: light from a single direction each, with the engine's attenuation formulas.
///   Method  one light is chosen per point, in proportion to its illuminance there (luminance of lux, facing the light,
///           unoccluded). A light that cannot contribute is never chosen, and a single light is always chosen.
///   Units   lux at normal incidence times `factor`.
///   Memory  80 bytes per light. Thread: read-only after construction.
#pragma once

#include "base/math/Math.h"

#include <filament/Light.h>

#include <limits>
#include <vector>

namespace filament::reference {

struct DirectSample {
    double3 direction{ 0.0 };   ///< from the point to the light, unit
    double3 illuminance{ 0.0 }; ///< divided by the probability of the choice; zero: no light reaches the point
    double distance = std::numeric_limits<double>::infinity();
};

class DirectLights {
public:
    DirectLights() = default;
    DirectLights(std::vector<SunLight> const& suns, std::vector<PointLight> const& points,
                 std::vector<SpotLight> const& spots, double factor);

    bool empty() const { return mLights.empty(); }
    /// u in [0, 1).
    DirectSample sample(double3 position, double u) const;

private:
    struct Light {
        bool isSun = false, isSpot = false;
        double3 position{ 0.0 };
        double3 axis{ 0.0 };            // direction in which the light travels, unit
        double3 intensity{ 0.0 };       // lux or candela, times factor
        double inverseSquaredRange = 0; // 1/m^2
        double spotScale = 0, spotOffset = 0;
    };
    static DirectSample arriving(Light const& light, double3 position);

    std::vector<Light> mLights;
};

} // namespace filament::reference
