// SPDX-License-Identifier: Apache-2.0
/// Grids: the irradiance grids of a scene (<filament_core/IrradianceGrid.h>).
///   Thread  the app thread between frames; read-only while a frame is prepared.
///   Memory  one record a grid, with 144 B a probe; adding and removing are O(1), and removal moves the last record
///           into the gap.
#pragma once

#include "filament_core/scene/DenseIndex.h"

#include <filament_core/IrradianceGrid.h>
#include <filament_core/Math.h>
#include <filament_core/Objects.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace filament_core::scene {

struct GridRecord {
    double3 centerWorld{ 0.0 };
    float3x3 worldFromBox{ 1.0f };
    float3 halfExtent{ 1.0f };
    float blendMeters = 0;
    /// Of each probe, along the axes of the world and times the intensity.
    std::vector<std::array<float3, 9>> irradianceSh;
    std::shared_ptr<const IrradianceProbes> probes;
    std::string name{};

    float volume() const { return halfExtent.x * halfExtent.y * halfExtent.z; }
};

struct Grids {
    explicit Grids(uint16_t owner = 0) : index(owner) {}

    DenseIndex<IrradianceGridObject> index;
    std::vector<GridRecord> records;
    uint64_t changes = 0; ///< how often they changed
};

/// Of a valid description.
GridRecord gridRecord(IrradianceGridDesc const& desc);

} // namespace filament_core::scene
