// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Densities.h"

#include "tools/bake/LightmapImage.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>

namespace filament_core::bake {
namespace {

constexpr double kScaleStep = 1.189207115002721; // 2^(1/4): between densities of a chart
constexpr uint32_t kPilotSamples = 128;          // a texel, at most
constexpr uint32_t kPilotShare = 4;              // of the texels of the budget: one in four

double luxOf(double3 lux) { return glm::dot(lux, double3(0.2126, 0.7152, 0.0722)); }

/// Texels that a look-up may read: those of the box and one around it.
double boxTexels(double2 size) { return (size.x + 2) * (size.y + 2); }

/// Of a chart at a scale, from those that it had at 1.
double texelsAt(ChartDetail const& chart, double scale) {
    return double(chart.texels) * boxTexels(chart.size * scale) / boxTexels(chart.size);
}

/// The sum over the surface, in texels of scale 1.
double squaredErrorAt(ChartDetail const& chart, double scale) {
    return double(chart.texels) * chart.meanSquareError / (scale * scale);
}

/// DetailSums of the charts, while rows and columns are looked at.
struct DetailSums {
    double squares = 0, noise = 0;
    uint64_t count = 0;
};

struct ScaleStep {
    double gain = 0; ///< squared error for each texel
    size_t chart = 0;
    /// The first chart of equal ones comes first.
    bool operator<(ScaleStep const& other) const {
        return gain != other.gain ? gain < other.gain : chart > other.chart;
    }
};

} // namespace

std::vector<ChartDetail> measureDetail(Atlas const& atlas, std::span<const AtlasTexel> texels,
                                       std::span<const TexelLight> lights) {
    std::vector<ChartDetail> charts(atlas.charts.size());
    for (size_t i = 0; i < charts.size(); ++i) charts[i].size = double2(atlas.charts[i].inner);
    std::unordered_map<uint64_t, size_t> at; // texels of surfaces that are seen, by place
    const auto keyOf = [](uint64_t x, uint64_t y) { return y << 32 | x; };
    for (size_t i = 0; i < texels.size(); ++i) {
        ++charts[texels[i].chart].texels;
        if (lights[i].backs <= kMostBacks) at.emplace(keyOf(texels[i].x, texels[i].y), i);
    }
    std::vector<DetailSums> sums(charts.size());
    const auto add = [&](size_t i, int dx, int dy) {
        const auto before = at.find(keyOf(texels[i].x - uint64_t(dx), texels[i].y - uint64_t(dy)));
        const auto after = at.find(keyOf(texels[i].x + uint64_t(dx), texels[i].y + uint64_t(dy)));
        if (before == at.end() || after == at.end()) return;
        const size_t chart = texels[i].chart;
        if (texels[before->second].chart != chart || texels[after->second].chart != chart) return;
        TexelLight const &a = lights[before->second], &b = lights[after->second], &own = lights[i];
        const double off = luxOf(own.irradiance) - 0.5 * (luxOf(a.irradiance) + luxOf(b.irradiance));
        const double errorOwn = luxOf(own.standardError), errorA = luxOf(a.standardError),
                     errorB = luxOf(b.standardError);
        sums[chart].squares += off * off;
        sums[chart].noise += errorOwn * errorOwn + 0.25 * (errorA * errorA + errorB * errorB);
        ++sums[chart].count;
    };
    for (size_t i = 0; i < texels.size(); ++i) {
        if (lights[i].backs > kMostBacks) continue;
        add(i, 1, 0);
        add(i, 0, 1);
    }
    for (size_t i = 0; i < charts.size(); ++i) {
        const double left = std::max(0.0, sums[i].squares - sums[i].noise);
        if (sums[i].count > 0) charts[i].meanSquareError = left / double(sums[i].count);
    }
    return charts;
}

std::vector<double> chooseScales(std::span<const ChartDetail> charts, double base, double budget) {
    std::vector<double> scales(charts.size(), kLeastScale * base);
    double spent = 0;
    for (size_t i = 0; i < charts.size(); ++i) spent += texelsAt(charts[i], scales[i]);
    const auto costOf = [&](size_t i) {
        return texelsAt(charts[i], scales[i] * kScaleStep) - texelsAt(charts[i], scales[i]);
    };
    std::priority_queue<ScaleStep> steps;
    const auto offer = [&](size_t i) {
        if (scales[i] * kScaleStep > kMostScale * base * (1 + 1e-9)) return;
        const double gain = squaredErrorAt(charts[i], scales[i]) - squaredErrorAt(charts[i], scales[i] * kScaleStep);
        steps.push({ gain / std::max(costOf(i), 1e-9), i });
    };
    for (size_t i = 0; i < charts.size(); ++i) offer(i);
    while (!steps.empty()) {
        const size_t i = steps.top().chart;
        steps.pop();
        if (spent + costOf(i) > budget) continue; // smaller charts may still fit
        spent += costOf(i);
        scales[i] *= kScaleStep;
        offer(i);
    }
    return scales;
}

Result<Atlas> makeBudgetAtlas(reference::TracedScene const& scene, std::span<const BakeSurface> surfaces,
                              AtlasOptions const& options, LightSettings const& light, uint64_t budget,
                              jobs::JobSystem& jobs) {
    double area = 0;
    for (BakeSurface const& surface : surfaces) {
        for (size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
            double3 const& corner = surface.positions[surface.indices[i]];
            area += 0.5 * glm::length(glm::cross(surface.positions[surface.indices[i + 1]] - corner,
                                                 surface.positions[surface.indices[i + 2]] - corner));
        }
    }
    if (!(area > 0)) return makeAtlas(surfaces, options, jobs);
    AtlasOptions coarse = options;
    coarse.texelsPerMeter = std::sqrt(double(budget) / kPilotShare / area);
    const Result<Atlas> pilot = makeAtlas(surfaces, coarse, jobs);
    if (!pilot) return pilot.error();
    const std::vector<AtlasTexel> texels = findTexels(*pilot);
    LightSettings settings = light;
    settings.samplesPerTexel = std::min(settings.samplesPerTexel, kPilotSamples);
    settings.relativeError = 0;
    std::vector<TexelLight> lights;
    bakeTexels(scene, surfaces, *pilot, texels, settings, jobs, [&](size_t, std::span<const TexelLight> finished) {
        lights.insert(lights.end(), finished.begin(), finished.end());
        return true;
    });
    AtlasOptions chosen = options;
    const double base = std::sqrt(double(kPilotShare));
    chosen.texelsPerMeter = coarse.texelsPerMeter * base;
    chosen.scales = chooseScales(measureDetail(*pilot, texels, lights), base, double(budget));
    for (double& scale : chosen.scales) scale /= base;
    return makeAtlas(surfaces, chosen, jobs);
}

} // namespace filament_core::bake
