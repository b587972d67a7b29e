// SPDX-License-Identifier: Apache-2.0
/// Quirks: in what a driver differs from what Vulkan promises, and how this backend lives with it. A quirk that is
/// false costs nothing. Remove one when no driver that we accept has it.
///   Thread  any; plain values.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Api.h"

#include <cstdint>
#include <span>

namespace filament::backend::vulkan {

struct Quirks {
    /// Driver  lavapipe, found in Mesa 22.3.6.
    /// What    crashes on conditions that mix a parameter with what differs from fragment to fragment, such as
    ///         `if (materialParams.x * uv.x > 0.0)`, where the parameters are in the fourth uniform buffer of a stage.
    /// Why     it notes uniforms that decide an `if` in a table of 4 x 32, but writes to [32 b + i] where it means
    ///         [4 b + i], b being 1 for the first uniform buffer of the stage. The fourth buffer's notes land upon the
    ///         counts behind the table. Where all of a condition is uniform the counts are restored, but
    ///         `uniform * varying > 0.0` leaves them spoilt, and the driver reads through a wild pointer when it draws.
    ///         For later buffers the notes land where no stage of a graphics pipeline looks.
    /// Cure    spareBindings().
    /// Cost    up to three descriptors more in each set with dynamic uniform buffers; nothing is ever bound to them.
    /// Test    tests/samples/materials/ConditionTest.cpp crashes without it.
    bool spoilsFourthUniforms = false;

    static Quirks of(VkDriverId driver);
};

inline constexpr size_t kMaxSpareBindings = 2;

/// For spoilsFourthUniforms: every stage that sees dynamic uniform buffers of this group, which are the engine's and
/// come before those of materials, gets spare ones up to the fourth. Returns how many of `bindings` it has filled.
uint32_t spareBindings(BindGroupLayout const& layout,
                       std::span<VkDescriptorSetLayoutBinding, kMaxSpareBindings> bindings);

} // namespace filament::backend::vulkan
