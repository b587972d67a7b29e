// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Report.h"

#include "base/Statistics.h"

#include <fmt/color.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace filament_core::bench {
namespace {

constexpr int kTitleWidth = 36, kFigureWidth = 9, kOursWidth = 25;

/// Three or four digits, whatever the magnitude.
std::string shortNumber(double value) {
    const double size = std::abs(value);
    if (size >= 1e6) return fmt::format("{:.3g}M", value * 1e-6);
    if (size >= 100) return fmt::format("{:.0f}", value);
    return size >= 10 ? fmt::format("{:.1f}", value) : fmt::format("{:.2f}", value);
}

std::string withQuartiles(Series const& series) {
    const Quartiles q = quartiles(series.all);
    return fmt::format("{} [{} .. {}]", shortNumber(q.median), shortNumber(q.first), shortNumber(q.third));
}

std::string medianOf(Series const* series) {
    if (!series) return "-";
    return shortNumber(quartiles(series->all).median) + (series->note.empty() ? "" : "*");
}

bool isVersus(Measured const& measured) { return measured.find("ours") != nullptr; }

/// The contenders that "ours" is compared with, always in the same columns, so that rows line up.
std::vector<std::string> versusColumns(Measured const& measured) {
    if (measured.kind == "commands") return { "copy" };
    std::vector<std::string> columns{ "tbb", "openmp", "eigen", "asio", "async", "serial" };
    if (measured.kind == "wakeup") columns.back() = "futex";
    if (measured.kind == "uneven") columns.push_back(measured.find("ideal") ? "ideal" : "fair");
    return columns;
}

std::vector<std::string> columnsOf(Measured const& measured) {
    if (isVersus(measured)) return versusColumns(measured);
    std::vector<std::string> columns;
    for (Series const& series : measured.series) columns.push_back(series.name);
    return columns;
}

void printHeader(Measured const& measured, std::vector<std::string> const& columns) {
    fmt::print("\n{:<{}} {:>8}", "workload", kTitleWidth, "unit");
    if (isVersus(measured)) fmt::print(" {:>{}}", "ours: median [quartiles]", kOursWidth);
    for (std::string const& column : columns) fmt::print(" {:>{}}", column, kFigureWidth);
    if (isVersus(measured)) {
        fmt::print("  | ours /");
        for (std::string const& column : columns) fmt::print(" {:>6}", column);
    }
    fmt::print("  | target\n");
}

void printFigures(Measured const& measured, std::vector<std::string> const& columns) {
    fmt::print("{:<{}} {:>8}", measured.title, kTitleWidth, measured.unit);
    if (isVersus(measured)) fmt::print(" {:>{}}", withQuartiles(*measured.find("ours")), kOursWidth);
    for (std::string const& column : columns) fmt::print(" {:>{}}", medianOf(measured.find(column)), kFigureWidth);
    if (!isVersus(measured)) return;
    fmt::print("  |       ");
    for (std::string const& column : columns) {
        const auto ratio = measured.ratio("ours", column);
        fmt::print(" {:>6}", ratio ? shortNumber(*ratio) : "-");
    }
}

std::string colored(bool isMet) {
    const char* word = isMet ? "pass" : "FAIL";
    if (!isatty(STDOUT_FILENO)) return word;
    return fmt::format(fg(isMet ? fmt::terminal_color::green : fmt::terminal_color::red), "{}", word);
}

nlohmann::json jsonOf(Series const& series) {
    const Quartiles q = quartiles(series.all);
    nlohmann::json json{ { "name", series.name },
                         { "median", q.median },
                         { "q1", q.first },
                         { "q3", q.third },
                         { "p99", quantile(series.all, 0.99) },
                         { "rounds", series.rounds } };
    if (series.all.size() != series.rounds.size()) json["samples"] = series.all;
    if (!series.note.empty()) json["note"] = series.note;
    return json;
}

/// ours / other for every other contender, with quartiles over the rounds.
nlohmann::json ratiosOf(Measured const& measured) {
    nlohmann::json ratios = nlohmann::json::object();
    Series const* ours = measured.find("ours");
    for (Series const& series : measured.series) {
        if (!ours || &series == ours || series.rounds.empty()) continue;
        const Quartiles q = quartiles(pairedRatios(ours->rounds, series.rounds));
        ratios[series.name] = { { "median", q.median }, { "q1", q.first }, { "q3", q.third } };
    }
    return ratios;
}

nlohmann::json jsonOf(Measured const& measured) {
    nlohmann::json json{ { "name", measured.name }, { "title", measured.title }, { "unit", measured.unit },
                         { "kind", measured.kind }, { "x", measured.x },         { "ratios", ratiosOf(measured) } };
    for (Series const& series : measured.series) json["contenders"].push_back(jsonOf(series));
    for (LeftOut const& leftOut : measured.leftOut) json["leftOut"][leftOut.name] = leftOut.why;
    json["targets"] = nlohmann::json::array();
    for (Verdict const& verdict : measured.verdicts)
        json["targets"].push_back({ { "text", describe(verdict.target, measured.unit) },
                                    { "value", verdict.value },
                                    { "limit", verdict.target.limit },
                                    { "met", verdict.isMet } });
    return json;
}

Result<void> write(std::filesystem::path const& path, nlohmann::json const& json) {
    std::ofstream file(path);
    file << json.dump(1) << '\n';
    file.close();
    if (!file) return fail(ErrorCode::Unreadable, "{}: cannot be written; is the directory there?", path.string());
    return {};
}

} // namespace

void printMachine(MachineDescription const& machine, Settings const& settings) {
    for (auto const& [name, value] : machine) fmt::print("{:<9} {}\n", name, value);
    fmt::print("{:<9} {}, with the caller; {} rounds\n", "threads", settings.threads, settings.rounds);
    if (settings.quick) fmt::print("{:<9} sizes too small to mean anything; targets are not judged\n", "quick");
}

void Table::print(Measured const& measured) {
    if (const std::vector<std::string> columns = columnsOf(measured); columns != mColumns) {
        printHeader(measured, columns);
        mColumns = columns;
    }
    printFigures(measured, mColumns);
    for (LeftOut const& leftOut : measured.leftOut)
        mLeftOut[fmt::format("{}: {}", leftOut.name, leftOut.why)].push_back(measured.name);
    if (measured.verdicts.empty()) fmt::print("  |\n");
    const int indent = kTitleWidth + 9 + static_cast<int>(mColumns.size()) * (kFigureWidth + 1) +
                       (isVersus(measured) ? kOursWidth + 1 + 10 + static_cast<int>(mColumns.size()) * 7 : 0);
    for (size_t i = 0; i < measured.verdicts.size(); ++i) {
        Verdict const& verdict = measured.verdicts[i];
        const std::string text = describe(verdict.target, measured.unit);
        fmt::print("{:{}}  | {} {} ({})\n", "", i == 0 ? 0 : indent, colored(verdict.isMet), text,
                   shortNumber(verdict.value));
        ++mTargets;
        if (!verdict.isMet)
            mMissed.push_back(fmt::format("{}: {} ({})", measured.name, text, shortNumber(verdict.value)));
    }
    std::fflush(stdout);
}

void Table::printSummary() const {
    fmt::print("\n*  scaled down and given per item: see the note in the JSON\n");
    for (auto const& [why, workloads] : mLeftOut) fmt::print("-  {} ({})\n", why, fmt::join(workloads, ", "));
    if (mTargets > 0) fmt::print("{} of {} targets met\n", mTargets - static_cast<int>(mMissed.size()), mTargets);
    for (std::string const& missed : mMissed) fmt::print("  missed: {}\n", missed);
}

Result<void> writeJson(std::filesystem::path const& path, MachineDescription const& machine, Settings const& settings,
                       std::span<const Measured> results) {
    nlohmann::json json{ { "program", "threading_bench" }, { "version", 1 },
                         { "threads", settings.threads },  { "rounds", settings.rounds },
                         { "quick", settings.quick },      { "workloads", nlohmann::json::array() } };
    for (auto const& [name, value] : machine) json["machine"][name] = value;
    for (Measured const& measured : results) json["workloads"].push_back(jsonOf(measured));
    return write(path, json);
}

Result<void> writeJson(std::filesystem::path const& path, MachineDescription const& machine,
                       std::span<const ContentionRow> rows) {
    nlohmann::json json{ { "program", "threading_bench" },
                         { "version", 1 },
                         { "contention", nlohmann::json::array() } };
    for (auto const& [name, value] : machine) json["machine"][name] = value;
    for (ContentionRow const& row : rows) {
        nlohmann::json counts;
        for (size_t kind = 0; kind < jobs::kContentionKinds; ++kind)
            counts[jobs::nameOf(static_cast<jobs::Contention>(kind))] = row.counts.by[kind];
        json["contention"].push_back(
                { { "work", row.workload }, { "workers", row.workers }, { "jobs", row.jobs }, { "counts", counts } });
    }
    return write(path, json);
}

} // namespace filament_core::bench
