// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/DfgTable.h"

#include "filament_core/base/Assert.h"
#include "filament_core/math/Half.h"
#include "shaders/lib/LibCpp.h"

#include <cstring>
#include <span>
#include <vector>

namespace filament::assets {

namespace lib = shader::lib;

namespace {

/// Half vectors that follow Charlie's distribution. They depend on the roughness alone: one set serves a row of the
/// table.
std::vector<float3> charlieSamples(float alpha, uint32_t samples) {
    const float inverseCount = 1.0f / static_cast<float>(samples);
    std::vector<float3> halfVectors(samples);
    for (uint32_t i = 0; i < samples; ++i)
        halfVectors[i] = lib::importanceSampleCharlie(lib::hammersley(i, inverseCount) + 0.5f * inverseCount, alpha);
    return halfVectors;
}

/// The integrand over the density D noh / (4 voh) of the light directions is V nol 4 voh / noh.
float sheenAlbedo(float nov, std::span<const float3> halfVectors) {
    const float3 v(std::sqrt(1.0f - nov * nov), 0, nov);
    float sum = 0;
    for (float3 const& h : halfVectors) {
        const float voh = glm::dot(v, h);
        const float nol = 2 * voh * h.z - v.z;
        if (nol > 0 && voh > 0) sum += lib::visibilityNeubelt(nov, nol) * nol * (voh / h.z);
    }
    return sum * 4 / static_cast<float>(halfVectors.size());
}

} // namespace

// Half vectors drawn with density D noh leave V nol 4 voh / noh of the integrand. Karis 2013, "Real Shading in Unreal
// Engine 4"; 4 is V's own denominator.
float2 integrateDfg(float nov, float alpha, uint32_t samples) {
    const float inverseCount = 1.0f / static_cast<float>(samples);
    const float3 v(std::sqrt(1.0f - nov * nov), 0, nov);
    float2 sum(0.0f);
    for (uint32_t i = 0; i < samples; ++i) {
        const float3 h = lib::importanceSampleGgx(lib::hammersley(i, inverseCount), alpha);
        const float voh = glm::dot(v, h);
        const float nol = 2 * voh * h.z - v.z;
        if (nol <= 0 || voh <= 0) continue;
        const float visibility = lib::visibilitySmithGgxCorrelated(nov, nol, alpha) * nol * (voh / h.z);
        sum += float2(visibility * lib::pow5(1.0f - std::min(voh, 1.0f)), visibility);
    }
    return sum * (4.0f * inverseCount);
}

float integrateSheen(float nov, float alpha, uint32_t samples) {
    return sheenAlbedo(nov, charlieSamples(alpha, samples));
}

// Light directions that are uniform in the hemisphere: the lobe is as wide.
float integrateVelvet(float nov, float alpha, uint32_t samples) {
    const float inverseCount = 1.0f / static_cast<float>(samples);
    const float3 v(std::sqrt(1.0f - nov * nov), 0, nov);
    float sum = 0;
    for (uint32_t i = 0; i < samples; ++i) {
        const float2 u = lib::hammersley(i, inverseCount) + 0.5f * inverseCount;
        const float nol = u.y, sine = std::sqrt(1.0f - nol * nol), phi = lib::kTwoPi * u.x;
        const float3 h = glm::normalize(v + float3(sine * std::cos(phi), sine * std::sin(phi), nol));
        sum += lib::ndfAshikhmin(std::min(h.z, 1.0f), alpha) * lib::visibilityNeubelt(nov, nol) * nol;
    }
    return sum * lib::kTwoPi * inverseCount;
}

Image bakeDfgTable(jobs::JobSystem& jobs, uint32_t size, uint32_t samples) {
    FILAMENT_ASSERT(size > 0 && samples > 0, "a DFG table has at least one entry of one sample");
    Image table{ .width = size, .height = size, .format = backend::Format::RGBA16F, .data = {} };
    table.data.resize(table.levelBytes(0));
    jobs::parallelFor<"dfg table">(jobs, size, 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            const float roughness = (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
            const float alpha = lib::alphaFromPerceptual(lib::clampPerceptualRoughness(roughness));
            const std::vector<float3> fibres = charlieSamples(alpha, samples);
            for (size_t x = 0; x < size; ++x) {
                const float nov = (static_cast<float>(x) + 0.5f) / static_cast<float>(size);
                const float2 dfg = integrateDfg(nov, alpha, samples);
                const uint16_t halves[4] = { halfFromFloat(dfg.x), halfFromFloat(dfg.y),
                                             halfFromFloat(sheenAlbedo(nov, fibres)),
                                             halfFromFloat(integrateVelvet(nov, alpha, samples)) };
                std::memcpy(table.data.data() + (y * size + x) * sizeof(halves), halves, sizeof(halves));
            }
        }
    });
    return table;
}

} // namespace filament::assets
