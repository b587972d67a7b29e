// SPDX-License-Identifier: Apache-2.0
// filament-accuracy [options]: error and cost of every named choice, as JSON, CSV, plots and one page.
// Exit status 0: measured and written.
#include "toolkit/interiors/Interiors.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/program/Console.h"
#include "toolkit/program/Program.h"
#include "tools/accuracy/Options.h"
#include "tools/accuracy/Page.h"
#include "tools/accuracy/Shards.h"
#include "tools/accuracy/comparison/ComparisonPage.h"
#include "tools/accuracy/interiors/InteriorPage.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace filament_core::accuracy {
namespace {

using tools::failed;

int list(std::vector<Effect> const& effects) {
    for (Effect const& effect : effects) {
        std::printf("%s: %s\n", effect.name.c_str(), effect.question.c_str());
        for (Value const& value : effect.values) std::printf("    %s\n", value.name.c_str());
    }
    return 0;
}

MeasureProgress progressLine() {
    return [begin = std::chrono::steady_clock::now()](std::string const& what, double done) {
        constexpr size_t kWidth = 24;
        const auto filled = static_cast<size_t>(done * kWidth);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        const std::string left = done > 0.02 ? fmt::format(", {:.0f} s left", seconds * (1 - done) / done) : "";
        tools::showProgress(fmt::format("[{}{}] {:3.0f} %{}  {}", std::string(filled, '#'),
                                        std::string(kWidth - filled, '.'), done * 100, left, what));
    };
}

void nameOrigin(auto& results) {
    results.machine = tools::describeMachine();
    results.commit = tools::builtCommit();
    results.date = tools::today();
}

int compare(Options const& options) {
    Result<ComparisonResults> results = comparePictures(*options.comparison, progressLine());
    tools::clearProgress();
    if (!results) return failed(results.error());
    nameOrigin(*results);
    if (const Result<void> written = writeComparison(*results, options.out); !written) return failed(written.error());
    for (Skipped const& one : results->skipped)
        tools::printWarning(fmt::format("row {} skipped: no {}; give --assets", one.name, one.reason));
    std::fputs(textOf(*results).c_str(), stdout);
    std::printf("%s\n", (options.out / "comparison.fragment.html").c_str());
    if (!std::ranges::all_of(results->closedForms, &ClosedForm::agrees))
        return failed(fail(ErrorCode::Internal, "the path tracer contradicts a closed form, see above"));
    if (!std::ranges::all_of(results->rows, &RowResult::isExplained))
        return failed(fail(ErrorCode::Internal, "an unexplained difference exceeds the limit of its row, see above"));
    if (!std::ranges::all_of(results->rows, &RowResult::isWithinLimit))
        return failed(fail(ErrorCode::Internal, "an approximation changes more than its row allows, see above"));
    return 0;
}

template <class Data>
int report(Options const& options, Data const& data) {
    const ReportPlaces places{ options.out, options.page.empty() ? options.out / "accuracy.html" : options.page,
                               options.include, options.plots };
    if (const Result<void> written = writeReport(data, places); !written) return failed(written.error());
    std::printf("%s\n%s\n", (options.out / "results.json").c_str(), places.page.c_str());
    return 0;
}

int merge(Options const& options) {
    const Result<tools::Json> merged = mergeShards(options.merge);
    return merged ? report(options, *merged) : failed(merged.error());
}

int measureAndReport(Options const& options, std::vector<Effect> const& effects) {
    const Result<std::vector<std::string>> all = rowsOf(effects, options.effect);
    if (!all) return failed(all.error());
    const auto rows = options.shard ? rowsOf(*options.shard, *all) : all;
    if (!rows) return failed(rows.error());
    const Result<SceneLibrary> scenes = SceneLibrary::read(options.scenes);
    if (!scenes) return failed(scenes.error());
    Result<Results> results = measure(effects, *rows, *scenes, options.measure, progressLine());
    tools::clearProgress();
    if (!results) return failed(results.error());
    nameOrigin(*results);
    for (Skipped const& one : results->skipped)
        tools::printWarning(fmt::format("effect {} skipped: it needs {}", one.name, one.reason));
    if (!options.shard) return report(options, *results);
    const auto written = writeShard(*results, *options.shard, *all, options.out);
    if (!written) return failed(written.error());
    std::printf("%s\n", (options.out / "results.json").c_str());
    return 0;
}

int measureRooms(Options const& options) {
    const tools::StopOnInterrupt scope;
    Result<InteriorResults> results = measureInteriors(*options.interiors, progressLine());
    tools::clearProgress();
    if (!results) return failed(results.error());
    nameOrigin(*results);
    if (const Result<void> written = writeInteriors(*results, options.out); !written) return failed(written.error());
    for (Skipped const& one : results->skipped)
        tools::printWarning(fmt::format("interior {} skipped: no {}; give --assets", one.name, one.reason));
    std::fputs(textOf(*results).c_str(), stdout);
    return 0;
}

int writeRooms(std::filesystem::path const& folder) {
    for (interiors::Interior const& room : { interiors::cornellBox(), interiors::gallery() }) {
        const Result<interiors::InteriorFiles> files = interiors::writeInterior(room, folder);
        if (!files) return failed(files.error());
        std::printf("%s\n%s\n", files->model.c_str(), files->sky.c_str());
    }
    return 0;
}

int run(Options const& options) {
    if (!options.rooms.empty()) return writeRooms(options.rooms);
    if (options.interiors) return measureRooms(options);
    if (options.comparison) return compare(options);
    if (!options.merge.empty()) return merge(options);
    const Result<std::vector<Effect>> effects = readEffects(options.effects);
    if (!effects) return failed(effects.error());
    return options.list ? list(*effects) : measureAndReport(options, *effects);
}

} // namespace
} // namespace filament_core::accuracy

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-accuracy", argc, argv, accuracy::parseOptions, accuracy::run);
}
