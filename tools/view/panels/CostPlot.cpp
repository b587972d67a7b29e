// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/CostPlot.h"

#include "toolkit/program/RoundStep.h"
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace filament_core::view {
namespace {

constexpr double kMargin = 0.06;  // of the range of the points
constexpr double kNearZero = 0.5; // of the range: zero is then shown, too
constexpr std::array kMeasuredPresets{ QualityPreset::Low, QualityPreset::Medium, QualityPreset::High,
                                       QualityPreset::Reference };

void addUnlessKnown(std::vector<QualitySetting>& settings, QualitySetting setting) {
    const View with{ .quality = setting.quality, .samples = setting.samples };
    const auto isKnown = [&](QualitySetting const& other) { return hasSetting(with, other); };
    if (std::ranges::none_of(settings, isKnown)) settings.push_back(std::move(setting));
}

struct Range {
    double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();
    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
    /// With a margin, never empty.
    Range padded() const {
        if (least > most) return { 0, 1 };
        const double length = most > least ? most - least : std::max(std::abs(most), 1e-6);
        Range range{ least - kMargin * length, most + kMargin * length };
        if (least >= 0 && least <= kNearZero * length) range.least = 0;
        return range;
    }
};

} // namespace

std::vector<QualitySetting> settingsToMeasure(View const& view) {
    std::vector<QualitySetting> settings{ { "as it is", view.quality, view.samples } };
    for (Option const& choice : optionsOf<Quality>()) {
        for (const std::string_view value : choice.values) {
            QualitySetting setting{ fmt::format("{}={}", choice.name, value), view.quality, view.samples };
            if (setOption(setting.quality, choice.name, value)) addUnlessKnown(settings, std::move(setting));
        }
    }
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } })
        addUnlessKnown(settings, { fmt::format("samples={}", samples), view.quality, samples });
    for (const QualityPreset preset : kMeasuredPresets)
        addUnlessKnown(settings, { fmt::format("preset {}", toString(preset)), qualityPreset(preset), view.samples });
    return settings;
}

bool hasSetting(View const& view, QualitySetting const& setting) {
    return view.quality == setting.quality && view.samples == setting.samples;
}

void applySetting(View& view, QualitySetting const& setting) {
    view.quality = setting.quality;
    view.samples = setting.samples;
}

std::vector<size_t> paretoFront(std::span<const MeasuredSetting> points) {
    std::vector<size_t> order;
    for (size_t i = 0; i < points.size(); ++i)
        if (points[i].isMeasured()) order.push_back(i);
    std::ranges::stable_sort(order, [&](size_t a, size_t b) {
        return std::pair(points[a].milliseconds, *points[a].error) <
               std::pair(points[b].milliseconds, *points[b].error);
    });
    std::vector<size_t> front;
    for (const size_t point : order)
        if (front.empty() || *points[point].error < *points[front.back()].error) front.push_back(point);
    return front;
}

float2 PlotScale::place(double x, double y) const {
    const double right = (x - leastX) / (mostX - leastX), up = (y - leastY) / (mostY - leastY);
    return { origin.x + static_cast<float>(right) * size.x, origin.y + static_cast<float>(1 - up) * size.y };
}

PlotScale scaleOf(std::span<const MeasuredSetting> points, float2 origin, float2 size) {
    Range x, y;
    for (MeasuredSetting const& point : points) {
        if (!point.isMeasured()) continue;
        x.add(point.milliseconds);
        y.add(*point.error);
    }
    const Range wideX = x.padded(), wideY = y.padded();
    return { origin, size, wideX.least, wideX.most, wideY.least, wideY.most };
}

std::vector<double> ticksOf(double least, double most, uint32_t count) {
    std::vector<double> ticks;
    if (!(most > least) || count == 0) return ticks;
    const double step = roundStep((most - least) / count);
    for (double i = std::ceil(least / step); i * step <= most; ++i) ticks.push_back(i * step);
    return ticks;
}

std::optional<size_t> nearestPoint(std::span<const MeasuredSetting> points, PlotScale const& scale, float2 at,
                                   float reach) {
    std::optional<size_t> nearest;
    for (size_t i = 0; i < points.size(); ++i) {
        if (!points[i].isMeasured()) continue;
        const float distance = glm::distance(scale.place(points[i].milliseconds, *points[i].error), at);
        if (distance > reach) continue;
        reach = distance;
        nearest = i;
    }
    return nearest;
}

std::string describe(std::span<const MeasuredSetting> points, size_t index) {
    MeasuredSetting const& point = points[index];
    if (!point.isMeasured()) return point.setting.name + ": not measured yet";
    std::string text = fmt::format("{}: {}, error {:.3g} %", point.setting.name, millisecondsText(point.milliseconds),
                                   *point.error * 100);
    if (index > 0 && points[0].isMeasured())
        text += fmt::format("\n{}, error {:+.3g} % against '{}'",
                            differenceText(point.milliseconds - points[0].milliseconds),
                            (*point.error - *points[0].error) * 100, points[0].setting.name);
    return text;
}

} // namespace filament_core::view
