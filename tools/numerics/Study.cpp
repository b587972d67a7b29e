// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/Study.h"

#include "tools/numerics/gpu/GpuEvaluator.h"
#include "tools/numerics/gpu/ShaderText.h"

#include <fmt/format.h>

#include <bit>

namespace filament_core::shader::numerics {
namespace {

/// The rows of a format with their points. A row has the same index in all lists below.
struct Work {
    Format format{};
    std::vector<size_t> indices; ///< into Study::rows
    std::vector<Points> points;
    std::vector<Task> tasks; ///< points inside, then outside
};

Work workOf(Study const& study, Format format) {
    Work work{ .format = format };
    for (size_t i = 0; i < study.rows.size(); ++i) {
        Row const& row = *study.rows[i].row;
        if (format == Format::Half && !row.fp32Only.empty()) continue;
        Points points = pointsOf(row, format);
        std::vector<Point> all = points.inside;
        all.insert(all.end(), points.outside.begin(), points.outside.end());
        work.indices.push_back(i);
        work.points.push_back(std::move(points));
        work.tasks.push_back({ &row, std::move(all) });
    }
    return work;
}

bool isVulkan(Column column) { return column == Column::VulkanSingle || column == Column::VulkanHalf; }

/// These round like the CPU. Other operations may be off by a few units in the last place, or by 2^-11 in sin() and
/// cos() (Vulkan 1.3, "Precision and Operation of SPIR-V Instructions"), and differ between devices.
bool isMesaCpu(std::string_view device) { return device.find("llvmpipe") != std::string_view::npos; }

void measureAll(Study& study, Work const& work, Column column, std::vector<Results> const& results) {
    for (size_t i = 0; i < work.tasks.size(); ++i) {
        Points const& points = work.points[i];
        const auto split = results[i].begin() + static_cast<std::ptrdiff_t>(points.inside.size());
        const Results inside(results[i].begin(), split), outside(split, results[i].end());
        RowResult& row = study.rows[work.indices[i]];
        Measurement measurement = measure(*row.row, column, points, inside, outside);
        measurement.isJudged = column == Column::Cpp || isMesaCpu(study.devices[isVulkan(column) ? 0 : 1]);
        row.columns[static_cast<size_t>(column)] = std::move(measurement);
    }
}

bool sameBits(float a, float b) {
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

void countDifferences(Study& study, Work const& work, std::vector<Results> const& a, std::vector<Results> const& b) {
    if (a.empty() || b.empty()) return; // a device is missing
    for (size_t i = 0; i < work.tasks.size(); ++i) {
        uint32_t& count = study.rows[work.indices[i]].differing[static_cast<size_t>(work.format)];
        for (size_t p = 0; p < work.points[i].inside.size(); ++p) {
            bool same = true;
            for (int c = 0; c < 4; ++c) same &= sameBits(a[i][p][c], b[i][p][c]);
            count += !same;
        }
    }
}

void evaluateInCpp(Study& study, Work const& work) {
    std::vector<Results> results;
    for (Task const& task : work.tasks) results.push_back(evaluateCpp(*task.row, task.points));
    measureAll(study, work, Column::Cpp, results);
}

/// One device's results for the work, for the comparison with the other; empty without a device.
struct DeviceResults {
    std::vector<Results> single, half;
};

Result<DeviceResults> evaluateOn(Study& study, Backend type, std::string const& library, Work const& single,
                                 Work const& half) {
    const bool vulkan = type == Backend::Vulkan;
    auto device = GpuEvaluator::make(type, library);
    if (!device) {
        study.missing.push_back(device.error().message);
        return DeviceResults{};
    }
    study.devices[vulkan ? 0 : 1] = (*device)->deviceName();
    Result<std::vector<Results>> singles = (*device)->evaluate(single.tasks, Format::Single);
    if (!singles) return singles.error();
    measureAll(study, single, vulkan ? Column::VulkanSingle : Column::GlesSingle, *singles);
    if (!(*device)->hasHalf()) {
        study.missing.push_back(fmt::format("{} has no half floats in shaders", (*device)->deviceName()));
        return DeviceResults{ .single = std::move(*singles) };
    }
    Result<std::vector<Results>> halves = (*device)->evaluate(half.tasks, Format::Half);
    if (!halves) return halves.error();
    measureAll(study, half, vulkan ? Column::VulkanHalf : Column::GlesHalf, *halves);
    return DeviceResults{ std::move(*singles), std::move(*halves) };
}

Result<std::string> mutatedLibrary(std::optional<Mutation> const& mutation) {
    Result<std::string> library = libraryText();
    if (!library || !mutation) return library;
    const size_t at = library->find(mutation->from);
    if (at == std::string::npos)
        return fail(ErrorCode::NotFound, "shaders/lib has no \"{}\" to mutate", mutation->from);
    library->replace(at, mutation->from.size(), mutation->to);
    return library;
}

} // namespace

bool isMeasured(Row const& row, Column column) { return formatOf(column) == Format::Single || row.fp32Only.empty(); }

Result<Study> runStudy(std::string_view only, std::optional<Mutation> mutation) {
    const Result<std::string> library = mutatedLibrary(mutation);
    if (!library) return library.error();
    Study study;
    for (Row const& row : rows()) {
        const bool wanted = row.function.find(only) != std::string_view::npos || row.file.find(only) == 0;
        if (wanted) study.rows.push_back({ .row = &row });
    }
    const Work single = workOf(study, Format::Single), half = workOf(study, Format::Half);
    evaluateInCpp(study, single);
    const Result<DeviceResults> vulkan = evaluateOn(study, Backend::Vulkan, *library, single, half);
    if (!vulkan) return vulkan.error();
    const Result<DeviceResults> gles = evaluateOn(study, Backend::Gles, *library, single, half);
    if (!gles) return gles.error();
    study.promisesSameBits = isMesaCpu(study.devices[0]) && isMesaCpu(study.devices[1]);
    countDifferences(study, single, vulkan->single, gles->single);
    countDifferences(study, half, vulkan->half, gles->half);
    return study;
}

std::vector<std::string> violations(Row const& row, Column column, Measurement const& result) {
    std::vector<std::string> found;
    const auto say = [&](std::string text) { found.push_back(fmt::format("{}: {}", toString(column), text)); };
    const auto at = [&](std::optional<Point> const& point) { return point ? describe(row, *point) : "nowhere"; };
    if (result.nan + result.infinite > 0)
        say(fmt::format("{} NaN and {} inf, first at {}", result.nan, result.infinite, at(result.firstNotFinite)));
    if (result.outOfRange > 0)
        say(fmt::format("{} results outside of [{}, {}], first at {}", result.outOfRange, row.range.low, row.range.high,
                        at(result.firstOutOfRange)));
    if (result.isJudged && result.notMonotone > 0)
        say(fmt::format("{} steps against the order, first at {}", result.notMonotone, at(result.firstNotMonotone)));
    if (result.isJudged && row.noError.empty() && !(result.worst <= limitOf(row, column)))
        say(fmt::format("error {:.2g} above its limit {:.2g} at {}: {:.9g} instead of {:.9g}", result.worst,
                        limitOf(row, column), at(result.worstAt), result.worstResult, result.worstTruth));
    const uint32_t nan = result.outside[static_cast<size_t>(OutsideInput::Beyond)].nan;
    if (row.openOutside.empty() && nan > 0) say(fmt::format("{} NaN for inputs beyond their intervals", nan));
    return found;
}

} // namespace filament_core::shader::numerics
