// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Integrals.h"

#include "base/Suggest.h"
#include "base/math/Half.h"
#include "filament_core/assets/tables/DfgTable.h"
#include "shaders/lib/LibCpp.h"
#include "tools/reference/DirectionalAlbedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace filament_core::accuracy {
namespace {

/// A DFG table as seen by a sampler with linear filtering and clamped edges.
class DfgSampler {
public:
    explicit DfgSampler(assets::Image const& table) : mSize(table.width), mTexels(size_t(mSize) * mSize) {
        for (size_t i = 0; i < mTexels.size(); ++i) {
            uint16_t halves[4];
            std::memcpy(halves, table.data.data() + i * sizeof(halves), sizeof(halves));
            mTexels[i] = { floatFromHalf(halves[0]), floatFromHalf(halves[1]) };
        }
    }

    float2 at(float u, float v) const {
        const float2 place = float2(u, v) * static_cast<float>(mSize) - 0.5f;
        const float2 corner = glm::floor(place), weight = place - corner;
        const float2 top = glm::mix(texel(corner.x, corner.y), texel(corner.x + 1, corner.y), weight.x);
        const float2 bottom = glm::mix(texel(corner.x, corner.y + 1), texel(corner.x + 1, corner.y + 1), weight.x);
        return glm::mix(top, bottom, weight.y);
    }

private:
    float2 texel(float x, float y) const {
        const auto clamped = [&](float i) {
            return static_cast<size_t>(std::clamp(i, 0.0f, static_cast<float>(mSize - 1)));
        };
        return mTexels[clamped(y) * mSize + clamped(x)];
    }

    uint32_t mSize;
    std::vector<float2> mTexels;
};

// Reflectance f0 at normal incidence, Schlick's term: f0 (1 - F) + F.
double reflected(double2 dfg, double f0) { return dfg.x * (1 - f0) + dfg.y * f0; }

ErrorFigures directionalAlbedoError(Settings const& settings, jobs::JobSystem& jobs) {
    constexpr int kSteps = 24;
    constexpr std::array kReflectances{ 0.04, 0.5, 1.0 };
    const DfgSampler table(assets::bakeDfgTable(jobs, settings.view.quality.dfgTableSize));
    ErrorFigures figures;
    double sum = 0;
    for (int y = 0; y < kSteps; ++y) {
        for (int x = 0; x < kSteps; ++x) {
            const double roughness = 0.1 + 0.9 * y / (kSteps - 1), nov = 0.05 + 0.95 * x / (kSteps - 1);
            const auto n = static_cast<float>(nov), r = static_cast<float>(roughness);
            const float2 dfg = settings.view.quality.splitSum == SplitSum::Analytic ? shader::lib::dfgAnalytic(n, r)
                                                                                    : table.at(n, r);
            const double2 truth = reference::integrateDirectionalAlbedo(nov, roughness * roughness);
            for (const double f0 : kReflectances) {
                const double exact = reflected(truth, f0);
                const double error = std::abs(reflected(double2(dfg), f0) - exact) / exact;
                sum += error * error;
                figures.max = std::max(figures.max, error);
            }
        }
    }
    figures.rms = std::sqrt(sum / (kSteps * kSteps * kReflectances.size()));
    return figures;
}

struct Integral {
    std::string_view name;
    ErrorFigures (*error)(Settings const& settings, jobs::JobSystem& jobs);
};
constexpr std::array kIntegrals{ Integral{ "directionalAlbedo", directionalAlbedoError } };

} // namespace

Result<ErrorFigures> integralError(std::string const& name, Settings const& settings, jobs::JobSystem& jobs) {
    const auto found = std::ranges::find(kIntegrals, std::string_view(name), &Integral::name);
    if (found != kIntegrals.end()) return found->error(settings, jobs);
    return fail(ErrorCode::NotFound, "there is no integral '{}'{}", name, suggestion(name, namesOf(kIntegrals)));
}

} // namespace filament_core::accuracy
