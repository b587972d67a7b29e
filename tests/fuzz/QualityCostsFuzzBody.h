// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, reading a cost table gives an error of one line, or a table
/// whose values are in range and which writes out to a fixed point.
#pragma once

#include "base/Assert.h"

#include <filament_core/QualityCosts.h>

#include <cmath>
#include <cstdint>
#include <span>

namespace filament_core {

/// Returns whether it was a table.
inline bool fuzzQualityCostsOnce(std::span<const uint8_t> input) {
    const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
    const Result<QualityCosts> costs = readQualityCosts(text, "fuzz");
    if (!costs) {
        FILAMENT_ASSERT(costs.error().message.starts_with("fuzz: "), "an error names its file");
        return false;
    }
    FILAMENT_ASSERT(costs->frameMilliseconds(Backend::Vulkan) > 0 || costs->frameMilliseconds(Backend::Gles) > 0,
                    "a table has the times of one backend");
    for (QualityEffect const& effect : costs->effects) {
        for (QualityCost const& cost : effect.values) {
            FILAMENT_ASSERT(cost.error >= 0 && cost.error <= 100, "errors are in their range");
            FILAMENT_ASSERT(std::isfinite(cost.vulkan.highRatio) && std::isfinite(cost.gles.highRatio),
                            "intervals are finite");
        }
    }
    // Digits beyond those written are rounded once.
    const Result<QualityCosts> again = readQualityCosts(toJson(*costs), "again");
    FILAMENT_ASSERT(again.ok(), "what was written can be read");
    FILAMENT_ASSERT(toJson(*again) == toJson(*costs), "writing what was read changes nothing");
    return true;
}

} // namespace filament_core
