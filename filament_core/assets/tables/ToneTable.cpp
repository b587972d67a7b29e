// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/ToneTable.h"

#include "base/Assert.h"
#include "base/math/Half.h"
#include "shaders/lib/LibCpp.h"

#include <array>
#include <cstring>

namespace filament::assets {

namespace lib = shader::lib;

namespace {

float3 row(double3x3 const& matrix, int i) { return float3(glm::transpose(matrix)[i]); }

lib::Grading asInShaders(Grading const& grading) {
    const double3x3 matrix = gradingMatrix(grading);
    lib::Grading values;
    values.mixRed = row(matrix, 0), values.mixGreen = row(matrix, 1), values.mixBlue = row(matrix, 2);
    values.shadows = grading.shadows, values.midtones = grading.midtones, values.highlights = grading.highlights;
    values.tonalRanges = grading.tonalRanges;
    values.slope = grading.slope, values.offset = grading.offset, values.power = grading.power;
    values.contrast = grading.contrast, values.saturation = grading.saturation, values.vibrance = grading.vibrance;
    values.shadowGamma = grading.shadowGamma, values.midPoint = grading.midPoint;
    values.highlightScale = grading.highlightScale;
    values.mapsGamut = grading.gamutMapping;
    return values;
}

float3 displayColor(float3 light, int mapper) {
    const float3 color = lib::toneMap(light, mapper);
    return lib::toneMapIncludesTransfer(mapper) ? color : lib::srgbFromLinear(color);
}

} // namespace

Image bakeToneTable(jobs::JobSystem& jobs, int mapper, uint32_t size, Grading const* grading) {
    FILAMENT_ASSERT(size >= 2, "a tone table has two entries a side or more");
    Image table{ .width = size * size, .height = size, .format = backend::Format::RGBA16F, .data = {} };
    table.data.resize(table.levelBytes(0));
    const lib::Grading values = asInShaders(grading ? *grading : Grading{});
    const auto lightAt = [&](size_t i) {
        return lib::lightFromToneTableCoordinate(static_cast<float>(i) / static_cast<float>(size - 1));
    };
    jobs::parallelFor<"tone table">(jobs, size, 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            for (size_t x = 0; x < table.width; ++x) {
                const float3 light(lightAt(x % size), lightAt(y), lightAt(x / size));
                const float3 color = displayColor(grading ? lib::graded(light, values) : light, mapper);
                constexpr uint16_t kOne = 0x3C00;
                const std::array<uint16_t, 4> halves{ halfFromFloat(color.x), halfFromFloat(color.y),
                                                      halfFromFloat(color.z), kOne };
                std::memcpy(table.data.data() + (y * table.width + x) * sizeof(halves), halves.data(), sizeof(halves));
            }
        }
    });
    return table;
}

} // namespace filament::assets
