// SPDX-License-Identifier: Apache-2.0
#include <filament_core/QualityCosts.h>

#include "base/Assert.h"
#include "filament_core/engine/quality/QualityCostsData.h"

namespace filament_core {

QualityCosts const& defaultQualityCosts() {
    static const QualityCosts kCosts = [] {
        Result<QualityCosts> costs = readQualityCosts(engine::defaultQualityCostsJson(), "quality_costs.json");
        FILAMENT_ASSERT(costs.ok(), "the cost table of the library can be read");
        return std::move(*costs);
    }();
    return kCosts;
}

} // namespace filament_core
