// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Atlas.h"

#include "base/Assert.h"
#include "tools/bake/Packing.h"

#include <cmath>
#include <map>

namespace filament_core::bake {
namespace {

constexpr double kMostTexels = 1e9; // of a chart's side, before it is rounded to whole texels

std::optional<Packing> pack(std::vector<AtlasChart>& charts, AtlasOptions const& options) {
    const uint32_t step = 1u << (options.levels - 1); // a texel of the coarsest level
    std::vector<uint2> sizes;
    for (AtlasChart& chart : charts) {
        const double2 texels =
                glm::min(glm::ceil(chart.chart.size * (options.texelsPerMeter * chart.scale)), kMostTexels);
        chart.inner = uint2(texels);
        chart.padding = paddingOf(options.levels);
        chart.size = (chart.inner + 2 * chart.padding + (step - 1)) / step * step;
        if (std::max(chart.size.x, chart.size.y) > options.maxSide) return std::nullopt;
        sizes.push_back(chart.size);
    }
    return packRectangles(sizes, { options.maxSide, options.maxPages }, step);
}

AtlasSurface newVertices(BakeSurface const& surface, std::span<const AtlasChart> charts, Atlas const& atlas) {
    AtlasSurface result;
    result.indices.resize(surface.indices.size());
    result.pages.resize(surface.indices.size() / 3);
    for (AtlasChart const& chart : charts) {
        const uint32_t page = chart.place.y / atlas.side;
        for (const uint32_t triangle : chart.chart.triangles) result.pages[triangle] = page;
        std::map<uint32_t, uint32_t> made; // vertices of this chart
        for (size_t i = 0; i < chart.chart.corners.size(); ++i) {
            const size_t at = size_t(chart.chart.triangles[i / 3]) * 3 + i % 3;
            const uint32_t source = surface.indices[at];
            const auto [entry, isNew] = made.try_emplace(source, static_cast<uint32_t>(result.sources.size()));
            result.indices[at] = entry->second;
            if (!isNew) continue;
            result.sources.push_back(source);
            const double2 corner = chart.corner(i, atlas.texelsPerMeter) - double2(0, double(page) * atlas.side);
            result.uvs.emplace_back(corner / double(atlas.side));
        }
    }
    return result;
}

} // namespace

Result<Atlas> makeAtlas(std::span<const BakeSurface> surfaces, AtlasOptions const& options, jobs::JobSystem& jobs) {
    std::vector<std::vector<Chart>> cut(surfaces.size());
    jobs::parallelFor<"charts">(jobs, surfaces.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            cut[i] = makeCharts(surfaces[i].positions, surfaces[i].indices, options.charts);
    });
    Atlas atlas{ .levels = options.levels, .texelsPerMeter = options.texelsPerMeter };
    std::vector<size_t> first;
    double area = 0;
    for (uint32_t i = 0; i < surfaces.size(); ++i) {
        first.push_back(atlas.charts.size());
        for (Chart& chart : cut[i]) {
            area += chart.size.x * chart.size.y;
            atlas.charts.push_back({ .surface = i, .chart = std::move(chart) });
        }
    }
    first.push_back(atlas.charts.size());
    FILAMENT_ASSERT(options.scales.empty() || options.scales.size() == atlas.charts.size(), "one scale for each chart");
    for (size_t i = 0; i < options.scales.size(); ++i) atlas.charts[i].scale = options.scales[i];
    const std::optional<Packing> packing = pack(atlas.charts, options);
    if (!packing) {
        const double density =
                0.8 * double(options.maxSide) * std::sqrt(double(options.maxPages)) / std::sqrt(std::max(area, 1e-12));
        return fail(ErrorCode::InvalidArgument,
                    "{} charts at {} texels a metre do not fit into {} x {} texels on {} pages; try --density {:.3g}, "
                    "or more with --max-size and --max-pages",
                    atlas.charts.size(), options.texelsPerMeter, options.maxSide, options.maxSide, options.maxPages,
                    std::min(density, options.texelsPerMeter / 2));
    }
    atlas.side = packing->side;
    atlas.pages = packing->pages;
    for (size_t i = 0; i < atlas.charts.size(); ++i) atlas.charts[i].place = packing->places[i];
    for (size_t i = 0; i < surfaces.size(); ++i) {
        const auto charts = std::span(atlas.charts).subspan(first[i], first[i + 1] - first[i]);
        atlas.surfaces.push_back(newVertices(surfaces[i], charts, atlas));
    }
    return atlas;
}

} // namespace filament_core::bake
