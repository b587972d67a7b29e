// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/ToneTable.h"

#include "base/Assert.h"
#include "base/math/Half.h"
#include "filament_core/assets/tables/DisplayColor.h"
#include "shaders/lib/LibCpp.h"

#include <array>
#include <cstring>

namespace filament_core::assets {

namespace lib = shader::lib;

Image bakeToneTable(jobs::JobSystem& jobs, DisplayTransform const& display, uint32_t size,
                    ColorGrading const* grading) {
    FILAMENT_ASSERT(size >= 2, "a tone table has two entries a side or more");
    Image table{ .width = size * size, .height = size, .format = backend::Format::RGBA16F, .data = {} };
    table.data.resize(table.levelBytes(0));
    const DisplayColor displayColor(display, grading);
    const auto lightAt = [&](size_t i) {
        return lib::lightFromToneTableCoordinate(static_cast<float>(i) / static_cast<float>(size - 1));
    };
    jobs::parallelFor<"tone table">(jobs, size, 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            for (size_t x = 0; x < table.width; ++x) {
                const float3 color = displayColor(float3(lightAt(x % size), lightAt(y), lightAt(x / size)));
                constexpr uint16_t kOne = 0x3C00;
                const std::array<uint16_t, 4> halves{ halfFromFloat(color.x), halfFromFloat(color.y),
                                                      halfFromFloat(color.z), kOne };
                std::memcpy(table.data.data() + (y * table.width + x) * sizeof(halves), halves.data(), sizeof(halves));
            }
        }
    });
    return table;
}

} // namespace filament_core::assets
