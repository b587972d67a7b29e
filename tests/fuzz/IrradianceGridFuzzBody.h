// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, reading an irradiance grid gives an error of one line, or a
/// grid whose numbers are in range and which is written again as a file that gives the same grid.
#pragma once

#include "base/Assert.h"

#include <filament_core/IrradianceGrid.h>

#include <cmath>
#include <cstdint>

namespace filament_core {

/// Returns whether it was such a file.
inline bool fuzzIrradianceGridOnce(std::span<const uint8_t> input) {
    const Result<IrradianceGridDesc> read = readIrradianceGrid(std::as_bytes(input));
    if (!read) {
        FILAMENT_ASSERT(read.error().message.starts_with("irradiance grid: "), "an error says what it is of");
        FILAMENT_ASSERT(read.error().message.find('\n') == std::string::npos, "an error is one line");
        return false;
    }
    IrradianceProbes const& probes = *read->probes;
    const size_t count = size_t{ probes.count.x } * probes.count.y * probes.count.z;
    FILAMENT_ASSERT(count > 0 && probes.probes.size() == count, "a probe for each corner");
    FILAMENT_ASSERT(probes.depths.size() == count * probes.depthSize * probes.depthSize, "depths for each probe");
    for (IrradianceProbe const& probe : probes.probes) {
        for (float3 const& coefficient : probe.irradianceSh)
            for (int channel = 0; channel < 3; ++channel)
                FILAMENT_ASSERT(std::abs(coefficient[channel]) <= 1e12f, "coefficients are in their range");
        FILAMENT_ASSERT(probe.standardError >= 0 && probe.standardError <= 1e12f, "standard errors are");
    }
    for (float2 const& depth : probes.depths)
        FILAMENT_ASSERT(depth.x >= 0 && depth.x <= 1e9f && depth.y >= 0 && std::isfinite(depth.y), "depths are");
    const Result<IrradianceGridDesc> again = readIrradianceGrid(writeIrradianceGrid(*read));
    FILAMENT_ASSERT(again && again->probes->probes.size() == count && again->name == read->name, "it is written again");
    return true;
}

} // namespace filament_core
