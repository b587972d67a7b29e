// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/page/BakePage.h"

#include "toolkit/program/Console.h"
#include "tools/bake/page/Page.h"
#include "tools/bake/page/ReportCamera.h"
#include "tools/bake/page/ScenePictures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace filament_core::bake {
namespace {

std::string percent(double share) { return fmt::format("{:.2f} %", share * 100); }
std::string brief(double value) { return fmt::format("{:.4g}", value); }
std::string placeOf(double3 v) { return fmt::format("{:.3f}, {:.3f}, {:.3f}", v.x, v.y, v.z); }

std::string captionOf(const char* what, EnginePicture const& picture) {
    return fmt::format("{}: {:.1f} % off", what, picture.errors.error * 100);
}

Result<PageSection> viewSection(Options const& options, Camera const& camera, reference::TracedScene const& scene,
                                BakedParts const& baked, jobs::JobSystem& jobs) {
    tools::showProgress("drawing the images of the report");
    Result<ScenePictures> pictures = drawScene(options, camera, scene, baked, jobs);
    tools::clearProgress();
    if (!pictures) return pictures.error();
    PageSection section{ .title = "Before, after, traced" };
    if (pictures->before && pictures->after) {
        section.sentences.push_back(fmt::format(
                "Drawn by {}. The numbers are the root mean square of the differences from the traced image, of "
                "means of 8 x 8 pixels, over that of the traced image, whose own noise is {:.1f} % of it.",
                pictures->device, pictures->after->errors.noise * 100));
        section.pictures.push_back({ captionOf("Before: the plain environment", *pictures->before),
                                     shownImage(pictures->before->picture) });
        section.pictures.push_back(
                { captionOf("After: baked", *pictures->after), shownImage(pictures->after->picture) });
    }
    if (!pictures->problem.empty()) {
        section.sentences.push_back("The engine drew no image: " + pictures->problem);
        tools::printWarning("the report has no images of the engine: " + pictures->problem);
    }
    section.pictures.push_back(
            { fmt::format("Traced: {} paths a pixel", options.report.samples), shownImage(pictures->traced) });
    section.sentences.push_back("The camera is at " + placeOf(camera.position()) + ".");
    return section;
}

Image imageOf(uint2 size, std::vector<std::byte> pixels) {
    return { .width = size.x, .height = size.y, .format = Format::RGBA8, .pixels = std::move(pixels) };
}

/// In the order of descending keys; equal ones as they were.
std::vector<uint32_t> orderBy(std::vector<double> const& keys) {
    std::vector<uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, [&](uint32_t a, uint32_t b) { return keys[a] > keys[b]; });
    return order;
}

// ---- lightmaps and occlusion

std::vector<WeightedPoint> pointsOf(BakeScene const& bake, std::span<const TexelLight> lights) {
    std::vector<WeightedPoint> points;
    const auto add = [&](AtlasTexel const& texel, TexelLight const& light) {
        const SurfacePoint point = pointOf(bake.model.surfaces[bake.atlas.charts[texel.chart].surface], texel);
        // What the sky lights needs no baked light: images show where that makes a difference.
        if (light.backs <= kMostBacks) points.push_back({ point.position, point.faceNormal, 1.05 - light.openness });
    };
    for (size_t i = 0; i < bake.heldOut.size(); ++i) add(bake.heldOut[i].texel, lights[bake.texels.size() + i]);
    const size_t step = bake.texels.size() / 512 + 1;
    for (size_t i = 0; points.size() < 64 && i < bake.texels.size(); i += step) add(bake.texels[i], lights[i]);
    return points;
}

PageTable chartTable(BakeScene const& bake, std::vector<ChartSummary> const& charts) {
    PageTable table{ .title = "Charts, the largest errors first",
                     .columns = { "node", "chart", "triangles", "place", "texels", "hidden", "samples", "mean",
                                  "standard error" } };
    std::vector<double> errors;
    for (ChartSummary const& chart : charts) errors.push_back(chart.relativeError);
    for (const uint32_t i : orderBy(errors)) {
        AtlasChart const& chart = bake.atlas.charts[i];
        table.rows.push_back({ bake.model.sources[chart.surface].name, std::to_string(i),
                               std::to_string(chart.chart.triangles.size()),
                               fmt::format("{}, {}", chart.place.x, chart.place.y), std::to_string(charts[i].texels),
                               std::to_string(charts[i].hidden), fmt::format("{:.0f}", charts[i].samples),
                               brief(charts[i].meanLux), percent(charts[i].relativeError) });
    }
    return table;
}

// ---- grids

/// From blue over white to red, for [0, 1]; grey for less.
void push(std::vector<std::byte>& pixels, double value) {
    const double t = std::clamp(value, 0.0, 1.0) * 2 - 1;
    double3 color(std::min(1 + t, 1.0), 1 - std::abs(t), std::min(1 - t, 1.0));
    if (value < 0) color = double3(0.3);
    for (int c = 0; c < 3; ++c) pixels.push_back(static_cast<std::byte>(std::lround(color[c] * 255)));
    pixels.push_back(std::byte{ 255 });
}

/// A pixel for each probe: a slice of constant y beside the other, x to the right, z down; a grey line between them.
Image slicesOf(uint3 count, std::vector<double> const& values) {
    const uint2 size(count.y * (count.x + 1) - 1, count.z);
    std::vector<std::byte> pixels;
    for (uint32_t z = 0; z < count.z; ++z) {
        for (uint32_t y = 0; y < count.y; ++y) {
            for (uint32_t x = 0; x < count.x; ++x) push(pixels, values[(size_t(z) * count.y + y) * count.x + x]);
            if (y + 1 < count.y) push(pixels, -1);
        }
    }
    return imageOf(size, std::move(pixels));
}

struct GridPlaces {
    IrradianceGridDesc const& grid;
    uint3 count = grid.probes->count;

    double3 inWorld(float3 local) const { return grid.centerWorld + double3(grid.worldFromBox * local); }
    uint3 cellOf(size_t probe) const {
        return { probe % count.x, probe / count.x % count.y, probe / (size_t(count.x) * count.y) };
    }
    double3 ofProbe(size_t probe) const {
        const uint3 cell = cellOf(probe);
        float3 local(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            if (count[axis] > 1)
                local[axis] = grid.halfExtentMeters[axis] *
                              (2 * static_cast<float>(cell[axis]) / static_cast<float>(count[axis] - 1) - 1);
        }
        return inWorld(local);
    }
};

PageTable probeTable(BakedGrid const& baked) {
    PageTable table{ .title = "Probes, the largest errors first",
                     .columns = { "probe", "place", "mean candela / m2", "standard error", "leaks" } };
    const GridPlaces places{ baked.grid };
    std::vector<double> errors;
    std::vector<size_t> leaks(baked.grid.probes->probes.size());
    for (Leak const& leak : baked.report.leaks.found) ++leaks[leak.probe];
    for (IrradianceProbe const& probe : baked.grid.probes->probes)
        errors.push_back(probe.isInside ? -1 : double{ probe.standardError });
    for (const uint32_t i : orderBy(errors)) {
        IrradianceProbe const& probe = baked.grid.probes->probes[i];
        const uint3 cell = places.cellOf(i);
        const double mean = luminanceOf(double3(probe.irradianceSh[0]));
        table.rows.push_back({ fmt::format("{}, {}, {}", cell.x, cell.y, cell.z), placeOf(places.ofProbe(i)),
                               probe.isInside ? "inside of geometry" : brief(mean),
                               probe.isInside || mean <= 0 ? "" : percent(double{ probe.standardError } / mean),
                               std::to_string(leaks[i]) });
    }
    return table;
}

PageTable leakTable(BakedGrid const& baked) {
    PageTable table{ .title = "Leaks through walls, the largest first",
                     .columns = { "point", "probe", "share of the point's light" } };
    const GridPlaces places{ baked.grid };
    std::vector<double> shares;
    for (Leak const& leak : baked.report.leaks.found) shares.push_back(double{ leak.share });
    for (const uint32_t i : orderBy(shares)) {
        Leak const& leak = baked.report.leaks.found[i];
        const uint3 cell = places.cellOf(leak.probe);
        table.rows.push_back({ placeOf(places.inWorld(leak.point)), fmt::format("{}, {}, {}", cell.x, cell.y, cell.z),
                               percent(double{ leak.share }) });
    }
    return table;
}

std::vector<PagePicture> gridMaps(BakedGrid const& baked) {
    std::vector<double> light, errors, leaks(baked.grid.probes->probes.size());
    for (Leak const& leak : baked.report.leaks.found)
        leaks[leak.probe] = std::max(leaks[leak.probe], double{ leak.share });
    const double mean = std::max(baked.report.mean, 1e-30);
    for (size_t i = 0; i < leaks.size(); ++i) {
        IrradianceProbe const& probe = baked.grid.probes->probes[i];
        if (probe.isInside) leaks[i] = -1;
        light.push_back(probe.isInside ? -1 : luminanceOf(double3(probe.irradianceSh[0])) / mean / 2);
        errors.push_back(probe.isInside ? -1 : double{ probe.standardError } / mean * 10);
    }
    const uint3 count = baked.grid.probes->count;
    return { { "Light of the probes, a slice of each height: white is the mean, red twice as much",
               slicesOf(count, light), true },
             { "Standard error: white is 5 % of the mean, red 10 % and more", slicesOf(count, errors), true },
             { "Largest leak: blue is none, red all of a point's light", slicesOf(count, leaks), true } };
}

std::string sentenceOf(BakedGrid const& baked) {
    GridJudgement const& judgement = baked.report.judgement;
    return fmt::format("{} points judge the grid alone ({} others are inside of geometry, {} are dark). The root mean "
                       "square of their errors is {} candela / m2, the largest {} candela / m2 at {}.",
                       judgement.points, judgement.inside, judgement.dark, brief(judgement.rms), brief(judgement.worst),
                       placeOf(GridPlaces{ baked.grid }.inWorld(judgement.worstPlace)));
}

std::vector<std::string> linesOf(std::string const& text) {
    std::vector<std::string> lines;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

} // namespace

Result<void> writeLightmapPage(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights,
                               LightmapImage const& image, StoredLightmap const& stored,
                               std::filesystem::path const& model, jobs::JobSystem& jobs) {
    const LightmapReport report = reportOf(options, bake, lights, image, stored);
    const Camera camera = reportCamera(options.report, options.light.exposure, *bake.scene, pointsOf(bake, lights));
    Result<PageSection> view = viewSection(options, camera, *bake.scene, { .model = model, .grid = {} }, jobs);
    if (!view) return view.error();
    const uint2 size(image.side, image.side * image.pages); // pages below each other
    PageSection maps{ .title = titleOf(report), .sentences = linesOf(summaryOf(options, bake, image, stored, report)) };
    for (std::string const& warning : bake.warnings) maps.sentences.push_back("Warning: " + warning);
    maps.pictures = { { report.isLight ? "Light: the mean is a middle grey" : "The visible part of the hemisphere",
                        imageOf(size, report.isLight ? previewOf(image) : greysOf(image)), true },
                      { "Standard error: white is a tenth of the mean",
                        imageOf(size, errorPicture(bake, lights, report.whole.meanLux)), true } };
    maps.tables.push_back(chartTable(bake, report.charts));
    return writePage(options.report.file, { maps.title + " of " + options.model.filename().string(),
                                            { std::move(*view), std::move(maps) } });
}

Result<void> writeGridPage(Options const& options, reference::TracedScene const& scene, BakedGrid const& baked,
                           jobs::JobSystem& jobs) {
    std::vector<double3> places;
    const GridPlaces grid{ baked.grid };
    const size_t count = baked.grid.probes->probes.size(), step = count / 64 + 1;
    for (size_t i = 0; i < count; i += step) {
        if (!baked.grid.probes->probes[i].isInside) places.push_back(grid.ofProbe(i));
    }
    const Camera camera = reportCamera(options.report, options.light.exposure, scene, pointsAround(scene, places));
    Result<PageSection> view = viewSection(options, camera, scene, { .model = {}, .grid = baked.grid }, jobs);
    if (!view) return view.error();
    PageSection maps{ .title = "The probes",
                      .sentences = linesOf(describe(baked)),
                      .pictures = gridMaps(baked),
                      .tables = { leakTable(baked), probeTable(baked) } };
    maps.sentences.push_back(sentenceOf(baked));
    return writePage(options.report.file, { "Irradiance grid of " + options.model.filename().string(),
                                            { std::move(*view), std::move(maps) } });
}

} // namespace filament_core::bake
