// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Report.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/json/JsonFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::bake {
namespace {

using tools::Json;

constexpr size_t kShownCharts = 20; // of the page: those with the largest errors

std::string const& nameOf(BakeScene const& bake, uint32_t chart) {
    return bake.model.sources[bake.atlas.charts[chart].surface].name;
}

/// Of a light in lux, or of the visible part of the hemisphere.
std::string keyOf(LightmapReport const& report, const char* stem) {
    return report.isLight ? stem + std::string("Lux") : stem;
}
const char* fileStemOf(LightmapReport const& report) { return report.isLight ? "lightmap" : "occlusion"; }
const char* unitOf(LightmapReport const& report) { return report.isLight ? "lux" : "of the hemisphere"; }

Json chartsToJson(BakeScene const& bake, LightmapReport const& report) {
    std::vector<ChartSummary> const& charts = report.charts;
    Json list = Json::array();
    for (uint32_t i = 0; i < charts.size(); ++i) {
        AtlasChart const& chart = bake.atlas.charts[i];
        list.push_back({ { "node", nameOf(bake, i) },
                         { "triangles", chart.chart.triangles.size() },
                         { "page", chart.place.y / bake.atlas.side },
                         { "place", { chart.place.x, chart.place.y % bake.atlas.side, chart.size.x, chart.size.y } },
                         { "texels", charts[i].texels },
                         { "hidden", charts[i].hidden },
                         { "samples", charts[i].samples },
                         { keyOf(report, "mean"), charts[i].meanLux },
                         { "relativeError", charts[i].relativeError } });
    }
    return list;
}

struct PageSummary {
    uint32_t charts = 0;
    uint64_t texels = 0; ///< of charts, without their padding
    double share = 0;    ///< of the page that charts take with their padding
};

std::vector<PageSummary> summarizePages(Atlas const& atlas, std::span<const AtlasTexel> texels) {
    std::vector<PageSummary> pages(atlas.pages);
    const double all = double(atlas.side) * atlas.side;
    for (AtlasChart const& chart : atlas.charts) {
        PageSummary& page = pages[chart.place.y / atlas.side];
        ++page.charts;
        page.share += double(chart.size.x) * chart.size.y / all;
    }
    for (AtlasTexel const& texel : texels) ++pages[texel.y / atlas.side].texels;
    return pages;
}

Json pagesToJson(std::vector<PageSummary> const& pages) {
    Json list = Json::array();
    for (PageSummary const& page : pages)
        list.push_back({ { "charts", page.charts }, { "texels", page.texels }, { "share", page.share } });
    return list;
}

/// A table, if there are several.
std::string tableOf(std::vector<PageSummary> const& pages) {
    if (pages.size() == 1) return {};
    std::string table = "| page | charts | texels | of the page |\n|---:|---:|---:|---:|\n";
    for (size_t i = 0; i < pages.size(); ++i)
        table +=
                fmt::format("| {} | {} | {} | {:.0f} % |\n", i, pages[i].charts, pages[i].texels, pages[i].share * 100);
    return table + "\n";
}

Json storageToJson(Options const& options, StoredLightmap const& stored) {
    return { { "format", kLightmapFormatNames[static_cast<size_t>(options.storage.format)] },
             { "openness", options.storage.hasOpenness },
             { "bytes", stored.bytes },
             { "rmsLux", stored.error.rmsLux },
             { "worstLux", stored.error.worstLux },
             { "relativeError", stored.error.meanRelative },
             { "opennessError", stored.error.opennessRms } };
}

void addSettings(Options const& options, LightmapImage const& image, StoredLightmap const& stored, Json& report) {
    if (!options.light.occlusionMeters) {
        report["intensityLux"] = image.intensity;
        report["directLight"] = options.light.directLight;
        report["storage"] = storageToJson(options, stored);
    } else if (std::isfinite(*options.light.occlusionMeters)) {
        report["occlusionMeters"] = *options.light.occlusionMeters;
    }
}

ChartSummary wholeOf(std::vector<ChartSummary> const& charts) {
    ChartSummary whole;
    double squares = 0, samples = 0, lux = 0;
    for (ChartSummary const& chart : charts) {
        whole.texels += chart.texels;
        whole.hidden += chart.hidden;
        samples += chart.samples * chart.texels;
        lux += chart.meanLux * chart.seen();
        squares += chart.errorLux() * chart.errorLux() * chart.seen();
    }
    if (whole.texels > 0) whole.samples = samples / whole.texels;
    if (whole.seen() == 0) return whole;
    whole.meanLux = lux / whole.seen();
    if (whole.meanLux > 0) whole.relativeError = std::sqrt(squares / whole.seen()) / whole.meanLux;
    return whole;
}

Json heldOutToJson(LightmapReport const& report) {
    HeldOutReport const& heldOut = report.heldOut;
    return { { "points", heldOut.points },
             { "hidden", heldOut.hidden },
             { "dark", heldOut.dark },
             { "share", kBoundShare },
             { "confidence", kBoundConfidence },
             { keyOf(report, "interpolation"), heldOut.interpolationLux ? Json(*heldOut.interpolationLux) : Json() },
             { keyOf(report, "rms"), heldOut.rmsLux },
             { keyOf(report, "worst"), heldOut.worstLux },
             { "worstPlace", { heldOut.worstPlace.x, heldOut.worstPlace.y } } };
}

std::string sentenceOfHeldOut(LightmapReport const& report) {
    HeldOutReport const& heldOut = report.heldOut;
    const char* const unit = unitOf(report);
    const std::string bound =
            heldOut.interpolationLux
                    ? fmt::format(
                              "At {:.0f} % of the lit surface (with a confidence of {:.0f} %) what the engine looks up "
                              "is no further off than two standard errors of the chart and {:.4g} {}.",
                              kBoundShare * 100, kBoundConfidence * 100, *heldOut.interpolationLux, unit)
                    : std::string("They are too few to bound the error between texels.");
    return fmt::format("{} points of lit surfaces were traced for comparison alone. {} The root mean square of their "
                       "errors is {:.4g} {}, the largest {:.4g} {} at texel {:.1f}, {:.1f}.",
                       heldOut.points, bound, heldOut.rmsLux, unit, heldOut.worstLux, unit, heldOut.worstPlace.x,
                       heldOut.worstPlace.y);
}

std::string sentenceOf(BakeScene const& bake, LightmapImage const& image, LightmapReport const& report) {
    ChartSummary const& whole = report.whole;
    return fmt::format("{} charts with {} texels in {} x {} on {} {} with {} {}, {:.4g} texels a metre; {:.0f} samples "
                       "a texel, mean {:.4g} {}, standard error {:.2f} %. {} texels see backs of surfaces and were "
                       "filled from their neighbours.",
                       report.charts.size(), whole.texels, image.side, image.side, image.pages,
                       image.pages == 1 ? "page" : "pages", bake.atlas.levels,
                       bake.atlas.levels == 1 ? "level" : "levels", bake.atlas.texelsPerMeter, whole.samples,
                       whole.meanLux, unitOf(report), whole.relativeError * 100, whole.hidden);
}

std::string sentenceOf(Options const& options, StoredLightmap const& stored, ChartSummary const& whole) {
    StorageError const& error = stored.error;
    return fmt::format("Stored as {} in {} bytes. That adds an error of {:.3g} lux (RMS; {:.3g} % of the mean), the "
                       "largest {:.3g} lux; a texel is off by {:.3g} % of its own light (RMS){}.",
                       kLightmapFormatNames[static_cast<size_t>(options.storage.format)], stored.bytes, error.rmsLux,
                       whole.meanLux > 0 ? error.rmsLux / whole.meanLux * 100 : 0, error.worstLux,
                       error.meanRelative * 100,
                       options.storage.hasOpenness ? fmt::format(", openness by {:.2g}", error.opennessRms)
                                                   : std::string("; without openness"));
}

std::string pageOf(Options const& options, BakeScene const& bake, LightmapImage const& image,
                   StoredLightmap const& stored, LightmapReport const& report) {
    std::vector<ChartSummary> const& charts = report.charts;
    std::string page = fmt::format("# {}\n\n{}\n\n", titleOf(report), sentenceOf(bake, image, report));
    for (uint32_t i = 0; i < image.pages; ++i)
        page += fmt::format("![{}]({}) ![standard error]({})\n\n", titleOf(report), pictureName(fileStemOf(report), i),
                            pictureName("error", i));
    page += tableOf(summarizePages(bake.atlas, bake.texels));
    if (report.isLight) page += sentenceOf(options, stored, report.whole) + "\n\n";
    page += sentenceOfHeldOut(report) + "\n\n";
    page += "The second picture shows the standard error; white is a tenth of the mean.\n\n"
            "| node | texels | hidden | samples | mean | error |\n|---|---:|---:|---:|---:|---:|\n";
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < charts.size(); ++i) order.push_back(i);
    std::ranges::stable_sort(order,
                             [&](uint32_t a, uint32_t b) { return charts[a].relativeError > charts[b].relativeError; });
    order.resize(std::min(order.size(), kShownCharts));
    for (const uint32_t i : order)
        page += fmt::format("| {} | {} | {} | {:.0f} | {:.4g} | {:.2f} % |\n", nameOf(bake, i), charts[i].texels,
                            charts[i].hidden, charts[i].samples, charts[i].meanLux, charts[i].relativeError * 100);
    return page;
}

} // namespace

const char* titleOf(LightmapReport const& report) { return report.isLight ? "Lightmap" : "Ambient occlusion"; }

std::string pictureName(const char* stem, uint32_t page) {
    return page == 0 ? fmt::format("{}.png", stem) : fmt::format("{}-{}.png", stem, page);
}

Result<void> writePictures(Options const& options, const char* stem, LightmapImage const& image,
                           std::vector<std::byte> const& pixels) {
    const size_t bytes = size_t(image.side) * image.side * 4;
    for (uint32_t page = 0; page < image.pages; ++page) {
        const auto part = std::span(pixels).subspan(page * bytes, bytes);
        if (auto done = assets::writePng(options.out / pictureName(stem, page), image.side, image.side, part); !done)
            return done;
    }
    return {};
}

std::vector<ChartSummary> summarize(Atlas const& atlas, std::span<const AtlasTexel> texels,
                                    std::span<const TexelLight> lights) {
    std::vector<ChartSummary> charts(atlas.charts.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        ChartSummary& chart = charts[texels[i].chart];
        ++chart.texels;
        chart.samples += lights[i].samples;
        if (lights[i].backs > kMostBacks) {
            ++chart.hidden;
            continue;
        }
        const double error = luminanceOf(lights[i].standardError);
        chart.meanLux += luminanceOf(lights[i].irradiance);
        chart.relativeError += error * error;
    }
    for (ChartSummary& chart : charts) {
        if (chart.texels == 0) continue;
        chart.samples /= chart.texels;
        if (chart.seen() == 0) continue;
        chart.meanLux /= chart.seen();
        const double error = std::sqrt(chart.relativeError / chart.seen());
        chart.relativeError = chart.meanLux > 0 ? error / chart.meanLux : 0;
    }
    return charts;
}

std::vector<std::byte> errorPicture(BakeScene const& bake, std::span<const TexelLight> lights, double meanLux) {
    std::vector<std::byte> pixels(size_t(bake.atlas.side) * bake.atlas.side * bake.atlas.pages * 4, std::byte{ 0 });
    for (size_t i = 0; i < bake.texels.size(); ++i) {
        const double error = luminanceOf(lights[i].standardError) / std::max(meanLux, 1e-30);
        const auto code = static_cast<std::byte>(std::lround(std::min(error * 10, 1.0) * 255));
        const size_t at = (size_t(bake.texels[i].y) * bake.atlas.side + bake.texels[i].x) * 4;
        pixels[at] = pixels[at + 1] = pixels[at + 2] = code;
    }
    for (size_t i = 3; i < pixels.size(); i += 4) pixels[i] = std::byte{ 255 };
    return pixels;
}

std::vector<std::byte> greysOf(LightmapImage const& visible) {
    std::vector<std::byte> pixels;
    for (double4 const& texel : visible.texels) {
        pixels.insert(pixels.end(), 3, static_cast<std::byte>(std::lround(texel.x * 255)));
        pixels.push_back(std::byte{ 255 });
    }
    return pixels;
}

LightmapReport reportOf(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights,
                        LightmapImage const& image, StoredLightmap const& stored) {
    LightmapReport report{ .isLight = !options.light.occlusionMeters,
                           .charts = summarize(bake.atlas, bake.texels, lights),
                           .whole = {},
                           .heldOut = {} };
    report.whole = wholeOf(report.charts);
    std::vector<double> errors;
    for (ChartSummary const& chart : report.charts) errors.push_back(chart.errorLux());
    report.heldOut =
            compareHeldOut(bake.heldOut, lights.subspan(bake.texels.size()), stored.read, image.intensity, errors);
    return report;
}

std::string summaryOf(Options const& options, BakeScene const& bake, LightmapImage const& image,
                      StoredLightmap const& stored, LightmapReport const& report) {
    const std::string storage = report.isLight ? sentenceOf(options, stored, report.whole) + "\n" : std::string();
    return sentenceOf(bake, image, report) + "\n" + storage + sentenceOfHeldOut(report);
}

Result<void> writeReport(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights,
                         LightmapImage const& image, StoredLightmap const& stored) {
    const LightmapReport numbers = reportOf(options, bake, lights, image, stored);
    ChartSummary const& whole = numbers.whole;
    uint64_t rays = 0;
    for (TexelLight const& light : lights) rays += light.rays;
    Json report{ { "model", options.model.filename().string() },
                 { "side", image.side },
                 { "levels", bake.atlas.levels },
                 { "pages", pagesToJson(summarizePages(bake.atlas, bake.texels)) },
                 { "texelsPerMeter", bake.atlas.texelsPerMeter },
                 { "texCoord", bake.model.uvSet },
                 { "texels", whole.texels },
                 { "hidden", whole.hidden },
                 { "filled", image.filled },
                 { "samples", whole.samples },
                 { keyOf(numbers, "mean"), whole.meanLux },
                 { "relativeError", whole.relativeError },
                 { "heldOut", heldOutToJson(numbers) },
                 { "rays", rays },
                 { "warnings", bake.warnings },
                 { "charts", chartsToJson(bake, numbers) } };
    addSettings(options, image, stored, report);
    if (auto done = tools::writeJson(options.out / "report.json", report); !done) return done;
    const std::string page = pageOf(options, bake, image, stored, numbers);
    if (auto done = assets::replaceFile(options.out / "report.md", std::as_bytes(std::span(page))); !done) return done;
    if (numbers.isLight) {
        if (auto done = writePictures(options, fileStemOf(numbers), image, previewOf(image)); !done) return done;
    } else if (options.occlusionOfVertices) { // that of textures is in the model, too: main.cpp
        if (auto done = writePictures(options, fileStemOf(numbers), image, greysOf(image)); !done) return done;
    }
    return writePictures(options, "error", image, errorPicture(bake, lights, whole.meanLux));
}

} // namespace filament_core::bake
