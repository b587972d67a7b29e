// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Report.h"

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/mutations/Mutations.h"
#include "toolkit/program/Html.h"
#include "tools/conformance/Machines.h"

#include <algorithm>
#include <map>

namespace filament_core::conformance {
namespace {

/// For text and attributes of XML and HTML; XML has no control characters.
std::string printable(std::string_view text) {
    std::string line(text);
    std::ranges::replace_if(
            line, [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n'; }, ' ');
    return line;
}
std::string escaped(std::string_view text) { return tools::escapedHtml(printable(text)); }

std::string imageTag(std::filesystem::path const& file, std::string const& title, const char* name) {
    const auto bytes = assets::readFileBytes(file);
    if (!bytes) return {};
    return tools::figureOfPng(*bytes, printable(title), name);
}

std::string joined(std::vector<std::string> const& lines) {
    std::string text;
    for (std::string const& line : lines) text += (text.empty() ? "" : "\n") + line;
    return text;
}

double totalSeconds(Results const& results) {
    double total = 0;
    for (auto const& [name, seconds] : results.seconds) total += seconds;
    return total;
}

double secondsOf(Results const& results, std::string const& name) {
    const auto found = results.seconds.find(name);
    return found == results.seconds.end() ? 0 : found->second;
}

constexpr const char* kHead =
        R"(<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Conformance</title><style>
body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:72rem;padding:0 1rem;color:#222;background:#fff}
table{border-collapse:collapse}td,th{padding:.15rem .7rem;text-align:left;border-bottom:1px solid #ddd}
section{border-top:1px solid #bbb;margin-top:1.2rem}h3{margin:.6rem 0}figure{display:inline-block;margin:.3rem}
img{width:256px;image-rendering:pixelated}figcaption{font-size:12px;color:#555}.failed{color:#b00}.passed{color:#070}
.skipped{color:#777}.blink{position:relative}.blink figure+figure{position:absolute;left:0;animation:b 1s steps(1) infinite}
@keyframes b{50%{visibility:hidden}}.grid{display:flex;flex-wrap:wrap}</style></head><body>
)";

std::string summaryTable(Results const& results) {
    const Summary s = summaryOf(results);
    std::string html = fmt::format("<h1>Conformance: {}</h1><p>build {}, reference {}</p><table>",
                                   s.failed ? "failed" : "passed", escaped(results.build), escaped(results.reference));
    const auto row = [&](std::string_view name, std::string const& value) {
        html += fmt::format("<tr><td>{}</td><td>{}</td></tr>", escaped(name), escaped(value));
    };
    for (auto const& [backend, device] : results.devices) row(backend, device);
    row("cases", fmt::format("{} passed, {} failed, {} skipped", s.passed, s.failed, s.skipped));
    row("pictures", fmt::format("{} of {} have the bits of the reference", s.identical, s.comparisons));
    row("mutants", fmt::format("{} of {} noticed", s.caught, s.mutants));
    return html + "</table>";
}

std::string machineTable(Results const& results) {
    if (results.machines.empty()) return {};
    std::string html = "<h2>Machines</h2><table><tr><th>machine</th><th>what is different there</th><th>device</th>"
                       "<th>promised</th><th>cases</th><th>same bits</th><th>differ</th><th>faults</th></tr>";
    for (auto const& [name, device] : results.machines) {
        const MachineSummary s = summaryOf(results, name);
        SimulatedMachine const* machine = findMachine(name);
        html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>", escaped(name),
                            escaped(machine ? machine->what : ""), escaped(device),
                            machine && machine->sameBits ? "the same bits" : "no", s.cases, s.identical);
        html += fmt::format("<td>{}{}</td><td>{}</td></tr>", s.differing,
                            s.differing ? fmt::format(" ({} pixels)", s.differingPixels) : "", s.faults);
    }
    return html + "</table>";
}

std::string mutationTable(Results const& results) {
    std::map<std::string, std::pair<uint32_t, uint32_t>> rows; // caught, tested
    for (CaseResult const& result : results.cases) {
        for (Kill const& kill : result.kills) {
            rows[kill.mutation].first += kill.caught;
            ++rows[kill.mutation].second;
        }
    }
    if (rows.empty()) return {};
    std::string html = "<h2>Mutants</h2><table><tr><th>defect</th><th>cases</th><th>noticed</th></tr>";
    for (auto const& [name, counts] : rows)
        html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}{}</td></tr>", escaped(name), counts.second, counts.first,
                            isControl(name) ? " (a control: none should be)" : "");
    return html + "</table>";
}

std::string comparisonHtml(Comparison const& c, CaseResult const& result, std::filesystem::path const& folder) {
    std::string html = fmt::format("<p class=\"{}\">{}: ", c.passed ? "passed" : "failed", escaped(c.configuration));
    if (c.differing > 0) html += fmt::format("{} pixels differ, by {}/255 at most", c.differing, c.maxDifference);
    if (c.isIdentical()) html += "the same bits";
    if (!c.fault.empty()) html += (c.differing > 0 ? "; " : "") + escaped(c.fault);
    if (c.flipMean >= 0) html += fmt::format("; FLIP mean {:.5f}, 99th percentile {:.5f}", c.flipMean, c.flipP99);
    if (!c.first.empty()) html += "<br>first: " + escaped(c.first);
    html += "</p>";
    if (c.image.empty()) return html;
    html += imageTag(folder / c.image, c.configuration, "") + imageTag(folder / c.difference, "difference", "");
    return html + "<div class=\"blink\">" + imageTag(folder / result.image, "in turn", "") +
           imageTag(folder / c.image, "in turn", "") + "</div>";
}

std::string caseHtml(CaseResult const& result, std::filesystem::path const& folder) {
    std::string html = fmt::format("<section><h3>{} <span class=\"{}\">{}</span></h3>", escaped(result.name),
                                   toString(result.status), toString(result.status));
    if (!result.reasons.empty()) html += "<pre>" + escaped(joined(result.reasons)) + "</pre>";
    if (!result.image.empty()) html += imageTag(folder / result.image, "hash " + result.hash, "");
    if (!result.baseline.empty()) html += "<p>baseline: " + escaped(result.baseline) + "</p>";
    size_t equal = 0;
    for (Comparison const& c : result.comparisons) {
        if (c.passed && c.isIdentical())
            ++equal;
        else
            html += comparisonHtml(c, result, folder);
    }
    if (equal) html += fmt::format("<p class=\"passed\">{} configurations: the same bits</p>", equal);
    return html + "</section>";
}

Result<void> writeText(std::filesystem::path const& path, std::string const& text) {
    return assets::replaceFile(path, std::as_bytes(std::span(text)));
}

} // namespace

std::string junitOf(Results const& results) {
    const Summary s = summaryOf(results);
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    xml += fmt::format("<testsuites><testsuite name=\"conformance\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" "
                       "errors=\"0\" time=\"{:.3f}\">\n",
                       results.cases.size(), s.failed, s.skipped, totalSeconds(results));
    for (CaseResult const& result : results.cases) {
        xml += fmt::format("<testcase classname=\"conformance.{}\" name=\"{}\" time=\"{:.3f}\">",
                           escaped(results.build), escaped(result.name), secondsOf(results, result.name));
        const std::string why = escaped(joined(result.reasons));
        if (result.status == Status::Failed)
            xml += fmt::format("<failure message=\"{}\">{}</failure>",
                               escaped(result.reasons.empty() ? "" : result.reasons.front()), why);
        if (result.status == Status::Skipped) xml += fmt::format("<skipped message=\"{}\"/>", why);
        xml += "</testcase>\n";
    }
    return xml + "</testsuite></testsuites>\n";
}

std::string htmlOf(Results const& results, std::filesystem::path const& folder) {
    std::string html =
            kHead + summaryTable(results) + machineTable(results) + mutationTable(results) + "<h2>Cases</h2>";
    for (const bool failed : { true, false }) { // what needs attention first
        for (CaseResult const& result : results.cases) {
            if ((result.status == Status::Failed) == failed) html += caseHtml(result, folder);
        }
    }
    return html + "</body></html>\n";
}

void dropPassedPictures(std::filesystem::path const& folder, Results& results) {
    const auto drop = [&folder](std::string& file) {
        std::error_code ignored; // it is not named any more
        if (!file.empty()) std::filesystem::remove(folder / file, ignored);
        file.clear();
    };
    for (CaseResult& result : results.cases) {
        if (result.status != Status::Passed) continue;
        drop(result.image);
        for (Comparison& comparison : result.comparisons) drop(comparison.image), drop(comparison.difference);
    }
}

Result<void> writeReport(std::filesystem::path const& folder, Results const& results) {
    if (Result<void> written = writeResults(folder, results); !written) return written;
    if (Result<void> written = writeText(folder / "junit.xml", junitOf(results)); !written) return written;
    return writeText(folder / "report.html", htmlOf(results, folder));
}

std::string summaryLine(Results const& results) {
    const Summary s = summaryOf(results);
    return fmt::format("{} cases passed, {} failed, {} skipped; {} of {} pictures have the reference's bits; {} of {} "
                       "mutants noticed{}; {:.1f} s",
                       s.passed, s.failed, s.skipped, s.identical, s.comparisons, s.caught, s.mutants,
                       s.mutants ? fmt::format(" ({:.1f} %)", 100.0 * s.caught / s.mutants) : "",
                       totalSeconds(results));
}

std::string machineLines(Results const& results) {
    std::string text;
    for (auto const& [name, device] : results.machines) {
        const MachineSummary s = summaryOf(results, name);
        SimulatedMachine const* machine = findMachine(name);
        text += fmt::format("machine {}: {} of {} cases have the same bits, {} differ{}, {} with faults\n", name,
                            s.identical, s.cases, s.differing, machine && machine->sameBits ? "" : " (not promised)",
                            s.faults);
    }
    return text;
}

} // namespace filament_core::conformance
