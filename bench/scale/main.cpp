// SPDX-License-Identifier: Apache-2.0
// scale_bench: how the time of the CPU and the memory of a frame grow with renderables, material instances, lights and
// shadow maps. Without a device: everything from the first change of a scene to the submitted commands.
//   Method  a scene for each count (ScaleScene.h), one after the other, on one thread; the minimum and the median of
//           its frames. Minima of many frames are what an undisturbed frame takes.
//   Slope   of the logarithm of the time over that of the count, between the last two counts: 1 is linear. What frames
//           of any size cost flattens the first ones.
//   Textures  --textures draws on a device instead (TextureScene.h), whole and streamed within budgets. More
//           than 200 are not loaded whole.
//   Status  0: measured, table on standard output; 1: the reason in one line.
#include "base/Statistics.h"
#include "bench/scale/ScaleScene.h"
#include "bench/scale/TextureScene.h"
#include "toolkit/program/CommandLine.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>

namespace filament_core::bench {
namespace {

struct Options {
    double seconds = 1;
    int workers = 0;
    uint32_t most = 1'000'000;
    std::vector<std::string> only;
    std::string json;
    std::vector<int> textures; ///< instead of all of this: counts of textures
    std::vector<int> budgets{ 0, 256, 1024 };
    bool gles = false;
};

/// One line of a figure: a kind of scene over its counts.
struct Series {
    const char* name;
    const char* counted;
    std::vector<uint32_t> counts;
    std::function<ScaleCase(uint32_t)> caseOf;
};

std::vector<Series> allSeries() {
    const std::vector<uint32_t> kRenderables{ 1000, 10'000, 100'000, 1'000'000 };
    const auto moving = [](double share, bool keepsHistory = false) {
        return [=](uint32_t count) {
            return ScaleCase{
                .renderables = count, .moving = share, .visible = 0.01, .materials = 64, .keepsHistory = keepsHistory
            };
        };
    };
    return {
        { "static", "renderables", kRenderables, moving(0) },
        { "one percent moving", "renderables", kRenderables, moving(0.01) },
        { "all moving", "renderables", kRenderables, moving(1) },
        { "static, motion vectors", "renderables", kRenderables, moving(0, true) },
        { "one percent moving, motion vectors", "renderables", kRenderables, moving(0.01, true) },
        { "all visible",
          "renderables",
          { 1000, 10'000, 100'000 },
          [](uint32_t count) { return ScaleCase{ .renderables = count, .materials = 64 }; } },
        { "materials",
          "material instances",
          { 1, 10, 100, 1000, 10'000, 100'000 },
          [](uint32_t count) { return ScaleCase{ .renderables = 100'000, .visible = 0.1, .materials = count }; } },
        { "renderables with a material each",
          "material instances",
          { 1000, 10'000, 100'000 },
          [](uint32_t count) { return ScaleCase{ .renderables = count, .materials = count }; } },
        { "lights",
          "lights",
          { 10, 64, 256, 1024, 4096 },
          [](uint32_t count) { return ScaleCase{ .renderables = 1000, .materials = 64, .lights = count }; } },
        { "shadow maps",
          "shadow maps",
          { 1, 4, 16, 64 },
          [](uint32_t count) { return ScaleCase{ .renderables = 10'000, .materials = 64, .shadowMaps = count }; } },
        { "shadow maps, 100k renderables",
          "shadow maps",
          { 1, 4, 16, 64 },
          [](uint32_t count) {
              return ScaleCase{ .renderables = 100'000, .visible = 0.01, .materials = 64, .shadowMaps = count };
          } },
    };
}

struct Point {
    uint32_t count = 0;
    double minimum = 0, median = 0; ///< milliseconds of a frame
    ScaleFigures figures;
};

double slope(double x0, double y0, double x1, double y1) { return std::log(y1 / y0) / std::log(x1 / x0); }

Result<std::vector<Point>> measure(Series const& series, Options const& options) {
    std::vector<Point> points;
    for (const uint32_t count : series.counts) {
        if (count > options.most) continue;
        auto scene = ScaleScene::create(series.caseOf(count), options.workers);
        if (!scene) return scene.error();
        Point point{ .count = count, .figures = (*scene)->measure(options.seconds) };
        point.minimum = *std::ranges::min_element(point.figures.milliseconds);
        point.median = median(point.figures.milliseconds);
        const double grown =
                points.empty() ? 0 : slope(points.back().count, points.back().minimum, count, point.minimum);
        std::printf("| %s | %u | %u | %u | %.3f | %.3f | %.2f | %.0f | %.0f | %.2f |\n", series.name, count,
                    point.figures.statistics.visible, point.figures.statistics.draws, point.minimum, point.median,
                    grown, point.figures.sceneBytes / count, point.figures.frameBytes / count,
                    point.figures.buildSeconds);
        std::fflush(stdout);
        points.push_back(std::move(point));
    }
    return points;
}

nlohmann::json reportOf(Series const& series, std::vector<Point> const& points) {
    nlohmann::json rows = nlohmann::json::array();
    for (Point const& point : points)
        rows.push_back({ { "count", point.count },
                         { "minimumMs", point.minimum },
                         { "medianMs", point.median },
                         { "frames", point.figures.milliseconds.size() },
                         { "sceneBytes", point.figures.sceneBytes },
                         { "frameBytes", point.figures.frameBytes },
                         { "buildSeconds", point.figures.buildSeconds },
                         { "visible", point.figures.statistics.visible },
                         { "draws", point.figures.statistics.draws } });
    return { { "name", series.name }, { "counted", series.counted }, { "points", rows } };
}

Result<void> write(nlohmann::json const& report, Options const& options) {
    if (options.json.empty()) return {};
    std::ofstream file(options.json);
    file << report.dump(2) << '\n';
    return file ? Result<void>{} : fail(ErrorCode::Unreadable, "cannot write '{}'", options.json);
}

Result<void> run(Options const& options) {
    nlohmann::json report{ { "kind", "scale" }, { "workers", options.workers }, { "series", nlohmann::json::array() } };
    std::printf(
            "| scene | count | visible | draws | minimum ms | median ms | slope | scene bytes each | frame bytes each "
            "| built in s |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (Series const& series : allSeries()) {
        if (!options.only.empty() && std::ranges::find(options.only, series.name) == options.only.end()) continue;
        const auto points = measure(series, options);
        if (!points) return points.error();
        report["series"].push_back(reportOf(series, *points));
    }
    return write(report, options);
}

nlohmann::json textureRow(int count, TextureFigures const& at) {
    return { { "count", count },
             { "minimumMs", *std::ranges::min_element(at.restMilliseconds) },
             { "medianMs", median(at.restMilliseconds) },
             { "movingMedianMs", median(at.movingMilliseconds) },
             { "movingMaximumMs", *std::ranges::max_element(at.movingMilliseconds) },
             { "movingErrorPixels", at.movingErrorPixels },
             { "errorPixels", at.residency.largestErrorPixels },
             { "loadSeconds", at.loadSeconds },
             { "firstFrameSeconds", at.firstFrameSeconds },
             { "settledSeconds", at.settledSeconds },
             { "peakBytes", at.peakBytes },
             { "movingPeakBytes", at.movingPeakBytes },
             { "residentBytes", at.residency.residentBytes },
             { "neededBytes", at.residency.neededBytes },
             { "fileBytes", at.residency.fileBytes },
             { "sceneBytes", at.restBytes },
             { "frameBytes", 0 } };
}

/// Loading holds whole textures twice: 9 GB.
constexpr int kMostWhole = 200;

/// --textures: a line for each budget over counts of textures.
Result<void> runTextures(Options const& options) {
    nlohmann::json report{ { "kind", "scale" }, { "series", nlohmann::json::array() } };
    // Drivers compile shaders at the first draw, and keep them.
    const auto warm = measureTextures({ .textures = 2, .backend = options.gles ? Backend::Gles : Backend::Vulkan });
    if (!warm) return warm.error();
    std::printf("| budget MB | textures | load s | first frame s | settled s | peak MB | at rest MB | textures MB | "
                "rest ms | moving ms | longest ms | moving MB | moving error px |\n"
                "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const int budget : options.budgets) {
        nlohmann::json rows = nlohmann::json::array();
        for (const int count : options.textures) {
            if (budget == 0 && count > kMostWhole) continue;
            const auto figures = measureTextures({ .textures = static_cast<uint32_t>(count),
                                                   .budgetMegabytes = static_cast<uint32_t>(budget),
                                                   .backend = options.gles ? Backend::Gles : Backend::Vulkan });
            if (!figures) return figures.error();
            rows.push_back(textureRow(count, *figures));
            std::printf("| %d | %d | %.1f | %.1f | %.1f | %.0f | %.0f | %.0f | %.1f | %.1f | %.1f | %.0f | %.2f |\n",
                        budget, count, figures->loadSeconds, figures->firstFrameSeconds, figures->settledSeconds,
                        figures->peakBytes / 1e6, figures->restBytes / 1e6,
                        static_cast<double>(figures->residency.residentBytes) / 1e6, median(figures->restMilliseconds),
                        median(figures->movingMilliseconds), *std::ranges::max_element(figures->movingMilliseconds),
                        figures->movingPeakBytes / 1e6, static_cast<double>(figures->movingErrorPixels));
            std::fflush(stdout);
        }
        const std::string name = budget == 0 ? "whole textures" : fmt::format("budget of {} MB", budget);
        report["series"].push_back({ { "name", name }, { "counted", "textures of 22 MB" }, { "points", rows } });
    }
    return write(report, options);
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options;
    filament_core::tools::CommandLine app{ "Time and memory of frames over what a scene holds, without a device." };
    app.option("--seconds", options.seconds, "measured time of each count").inRange(0.01, 1000.0);
    app.option("--workers", options.workers, "job threads besides the measured one").inRange(0, 64);
    app.option("--most", options.most, "leave larger counts out");
    app.option("--only", options.only, "these scenes, by their names in the table");
    app.option("--json", options.json, "also write the figures to this file");
    app.option("--textures", options.textures,
               "instead, on a device: so many textures of 2048 x 2048 texels, a line each");
    app.option("--budgets", options.budgets, "of --textures: megabytes on the device; 0: whole textures");
    app.flag("--gles", options.gles, "of --textures: OpenGL ES instead of Vulkan");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    const Result<void> done = options.textures.empty() ? bench::run(options) : bench::runTextures(options);
    if (!done) std::fprintf(stderr, "scale_bench: error: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
