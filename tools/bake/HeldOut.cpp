// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/HeldOut.h"

#include "tools/reference/SampleStream.h"

#include <algorithm>
#include <cmath>

namespace filament_core::bake {
namespace {

constexpr uint64_t kPointStream = 0x68656c64; // other numbers than those of texels

/// A triangle of a chart, and the area of the surfaces up to its end.
struct Piece {
    uint32_t chart = 0;
    size_t index = 0; // of the chart's triangles
    double areaUpTo = 0;
};

std::vector<Piece> piecesOf(std::span<const BakeSurface> surfaces, Atlas const& atlas) {
    std::vector<Piece> pieces;
    double area = 0;
    for (uint32_t c = 0; c < atlas.charts.size(); ++c) {
        AtlasChart const& chart = atlas.charts[c];
        BakeSurface const& surface = surfaces[chart.surface];
        for (size_t i = 0; i < chart.chart.triangles.size(); ++i) {
            const uint32_t* const corners = &surface.indices[size_t(chart.chart.triangles[i]) * 3];
            const double3 a = surface.positions[corners[0]];
            const double each =
                    glm::length(glm::cross(surface.positions[corners[1]] - a, surface.positions[corners[2]] - a));
            if (!(each > 0)) continue;
            area += each;
            pieces.push_back({ c, i, area });
        }
    }
    return pieces;
}

HeldOutPoint pointIn(Atlas const& atlas, Piece const& piece, double2 numbers, uint32_t number) {
    AtlasChart const& chart = atlas.charts[piece.chart];
    // Osada et al. 2002, "Shape Distributions", section 4.2
    const double root = std::sqrt(numbers.x);
    HeldOutPoint point{ .texel = { .x = number,
                                   .y = kHeldOutRow,
                                   .chart = piece.chart,
                                   .triangle = chart.chart.triangles[piece.index],
                                   .u = root * (1 - numbers.y),
                                   .v = root * numbers.y } };
    keepInside(point.texel);
    for (size_t i = 0; i < 3; ++i) {
        const double weight = i == 0 ? 1 - point.texel.u - point.texel.v : i == 1 ? point.texel.u : point.texel.v;
        point.place += weight * chart.corner(piece.index * 3 + i, atlas.texelsPerMeter);
    }
    return point;
}

} // namespace

std::vector<HeldOutPoint> heldOutPoints(std::span<const BakeSurface> surfaces, Atlas const& atlas, uint32_t count,
                                        uint32_t seed) {
    const std::vector<Piece> pieces = piecesOf(surfaces, atlas);
    std::vector<HeldOutPoint> points;
    if (pieces.empty()) return points;
    const uint64_t stream = reference::hashOf(reference::mixBits(seed), kPointStream);
    for (uint32_t i = 0; i < count; ++i) {
        const reference::SampleStream numbers(reference::hashOf(stream, i), 0);
        const double area = numbers.pair(0).x * pieces.back().areaUpTo;
        const auto piece = std::ranges::lower_bound(pieces, area, {}, &Piece::areaUpTo);
        points.push_back(pointIn(atlas, piece == pieces.end() ? pieces.back() : *piece, numbers.pair(1), i));
    }
    return points;
}

LightSettings heldOutSettings(LightSettings const& settings) {
    LightSettings more = settings;
    more.samplesPerTexel *= kHeldOutSamples;
    more.relativeError /= 2; // as four times the paths have
    return more;
}

HeldOutReport compareHeldOut(std::span<const HeldOutPoint> points, std::span<const TexelLight> traced,
                             assets::Image const& halves, double intensity, std::span<const double> chartErrors) {
    HeldOutReport report;
    std::vector<double> beyond;
    double squares = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        if (traced[i].backs > kMostBacks) {
            ++report.hidden;
            continue;
        }
        const double3 stored = double3(lookUp(halves, points[i].place)) * intensity;
        if (stored == double3(0.0) && traced[i].irradiance == double3(0.0)) {
            ++report.dark;
            continue;
        }
        const double error = std::abs(luminanceOf(stored - traced[i].irradiance));
        beyond.push_back(std::max(0.0, error - 2 * chartErrors[points[i].texel.chart]));
        squares += error * error;
        if (error > report.worstLux) report.worstLux = error, report.worstPlace = points[i].place;
    }
    report.points = static_cast<uint32_t>(beyond.size());
    if (report.points > 0) report.rmsLux = std::sqrt(squares / report.points);
    report.interpolationLux = toleranceBound(std::move(beyond));
    return report;
}

} // namespace filament_core::bake
