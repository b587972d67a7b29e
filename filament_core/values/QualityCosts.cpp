// SPDX-License-Identifier: Apache-2.0
#include <filament_core/QualityCosts.h>

#include "base/Assert.h"
#include "base/Statistics.h"

#include <filament_core/Options.h>
#include <filament_core/Quality.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace filament_core {

double QualityCosts::frameMilliseconds(Backend backend) const {
    std::vector<double> defaults;
    for (QualityEffect const& effect : effects) {
        const std::optional<std::string> standard = optionValue(Quality{}, effect.name);
        for (QualityCost const& cost : effect.values) {
            if (cost.value == standard) defaults.push_back(cost.on(backend).milliseconds);
        }
    }
    return median(std::move(defaults));
}

void addBackend(QualityCosts& costs, QualityCosts const& other, Backend backend) {
    FILAMENT_ASSERT(costs.effects.size() == other.effects.size(), "both tables rate the same choices");
    for (size_t i = 0; i < costs.effects.size(); ++i) {
        QualityEffect& effect = costs.effects[i];
        QualityEffect const& from = other.effects[i];
        FILAMENT_ASSERT(effect.name == from.name && effect.values.size() == from.values.size(),
                        "both tables rate the same choices");
        for (size_t j = 0; j < effect.values.size(); ++j) effect.values[j].on(backend) = from.values[j].on(backend);
    }
}

} // namespace filament_core
