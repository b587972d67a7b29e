// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/comparison/ComparisonPage.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/json/JsonFile.h"
#include "toolkit/program/Html.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace filament_core::accuracy {
namespace {

namespace fs = std::filesystem;
using tools::escapedHtml;
using tools::Json;

constexpr double kFullColor = 0.25; // relative difference at which the maps are saturated
constexpr size_t kMapsOfSteps = 3;  // of the largest steps
constexpr const char* kCompareCommand = "build/release/bin/filament-accuracy --compare";

std::string fixedPercent(double value) { return fmt::format("{:.2f} %", value * 100); }
std::string signedPercent(double value) { return fmt::format("{:+.2f} %", value * 100); }

Json jsonOf(StepResult const& step) {
    return { { "name", step.name },
             { "own", step.own },
             { "left", step.left },
             { "share", step.share },
             { "bias", step.bias } };
}

constexpr const char* kHowToAddRow =
        R"(<p class="small">A row is an object in <code>tools/accuracy/comparison/rows.json</code>:
<code>{ "name": "metals-sun", "title": "Metals under a sun", "scene": "metals/sun", "samples": 256, "unexplained": 0.01 }</code>;
scenes are files of <code>comparison/scenes</code> as in <a href="conformance.md">conformance.md</a>; a material's values are
traced by their names (<code>TracedMaterial.h</code>). A row about one approximation names its <code>"step"</code> and the most
that it may change, <code>"limit"</code>. A new approximation of the
engine is a rung of <code>comparison/Ladder.cpp</code>.</p>)";

Json jsonOf(ClosedForm const& form) {
    return { { "name", form.name },
             { "formula", form.formula },
             { "expected", form.expected },
             { "mean", form.mean },
             { "standardError", form.standardError } };
}

Json jsonOf(RowResult const& result) {
    Json steps = Json::array(), others = Json::array();
    for (StepResult const& step : result.steps) steps.push_back(jsonOf(step));
    for (StepResult const& other : result.alternatives)
        others.push_back({ { "name", other.name }, { "own", other.own }, { "bias", other.bias } });
    return { { "name", result.row.name },
             { "scene", result.row.scene },
             { "samples", result.row.samples },
             { "size", { result.size.x, result.size.y } },
             { "rms", result.rms },
             { "bias", result.bias },
             { "flip", result.flip },
             { "eightBits", result.eightBits },
             { "noise", result.noise },
             { "tracedNoise", result.tracedNoise },
             { "unexplained", result.unexplained },
             { "unexplainedLimit", result.row.unexplained },
             { "step", result.row.step },
             { "stepLimit", result.row.limit },
             { "referenceSeconds", result.seconds },
             { "steps", std::move(steps) },
             { "alternatives", std::move(others) } };
}

/// Writes an image into a folder beside the fragment, and returns an element that shows it.
class Pictures {
public:
    explicit Pictures(fs::path folder) : mFolder(std::move(folder)) {}

    Result<std::string> figure(std::string const& name, Image const& image, std::string const& caption) const {
        const fs::path path = mFolder / (name + ".png");
        if (const Result<void> written = assets::writePng(path, image.width, image.height, image.pixels); !written)
            return written.error();
        return fmt::format(
                "<figure style=\"display:inline-block;margin:.3rem\"><img width=\"{}\" height=\"{}\" alt=\"{}\" "
                "src=\"{}/{}\"><figcaption class=\"small\">{}</figcaption></figure>",
                image.width, image.height, escapedHtml(caption), escapedHtml(mFolder.filename().string()),
                escapedHtml(path.filename().string()), escapedHtml(caption));
    }

private:
    fs::path mFolder;
};

/// Steps by the size of their change, largest first; the unexplained one is always shown.
std::vector<size_t> largestSteps(RowResult const& result) {
    std::vector<size_t> order;
    for (size_t i = 0; i < result.steps.size(); ++i) {
        if (result.steps[i].name != kUnexplained) order.push_back(i);
    }
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](size_t i) { return result.steps[i].own; });
    order.resize(std::min(order.size(), kMapsOfSteps));
    return order;
}

Result<std::string> figuresOf(RowResult const& result, Pictures const& pictures) {
    Picture const &engine = result.pictures.front(), &truth = result.pictures.back();
    const DifferenceScale scale(truth, result.pictures[1]);
    struct Wanted {
        std::string name, caption;
        Image image;
    };
    std::vector<Wanted> wanted{ { "engine", "engine", tonemapped(engine) },
                                { "traced", "path tracer", tonemapped(truth) },
                                { "difference", fmt::format("difference, {}", fixedPercent(result.rms)),
                                  differenceMap(engine, truth, scale, kFullColor) } };
    const auto addStep = [&](size_t i) {
        StepResult const& step = result.steps[i];
        wanted.push_back({ step.name, fmt::format("{}, {}", step.title, fixedPercent(step.own)),
                           differenceMap(result.pictures[i], result.pictures[i + 1], scale, kFullColor) });
    };
    for (const size_t i : largestSteps(result)) addStep(i);
    for (size_t i = 0; i < result.steps.size(); ++i) {
        if (result.steps[i].name == kUnexplained) addStep(i);
    }
    std::string html;
    for (Wanted const& one : wanted) {
        Result<std::string> figure = pictures.figure(result.row.name + "-" + one.name, one.image, one.caption);
        if (!figure) return figure;
        html += *figure;
    }
    return html;
}

std::string tableOf(RowResult const& result) {
    std::string html =
            "<table><tr><th>made exact</th><th>changes, RMS</th><th>mean</th><th>share</th><th>left, RMS</th>"
            "</tr>";
    html += fmt::format("<tr class=\"standard\"><td>the engine's frame</td><td></td><td></td><td></td><td>{}</td></tr>",
                        fixedPercent(result.rms));
    for (StepResult const& step : result.steps) {
        html += fmt::format(
                "<tr><td title=\"{}; exact: {}\">{}</td><td>{}</td><td>{}</td><td>{:.1f} %</td><td>{}</td></tr>",
                escapedHtml(step.approximate), escapedHtml(step.exact), escapedHtml(step.title), fixedPercent(step.own),
                signedPercent(step.bias), step.share * 100, fixedPercent(step.left));
    }
    return html + "</table>";
}

std::string notesOf(RowResult const& result) {
    std::string html = fmt::format(
            "<p class=\"small\">{} Scene <code>{}</code>, {} x {}, {} samples per pixel: standard error {} where the "
            "reference follows the engine, {} of the path tracer. Unexplained beyond the first: {}, at most {} "
            "allowed. Mean "
            "FLIP {:.4f}. 8 bits per component: {} of white.",
            result.isExplained() ? "" : "<b>More than allowed is unexplained.</b>", escapedHtml(result.row.scene),
            result.size.x, result.size.y, result.row.samples, fixedPercent(result.noise),
            fixedPercent(result.tracedNoise), fixedPercent(result.unexplained), fixedPercent(result.row.unexplained),
            result.flip, fixedPercent(result.eightBits));
    if (!result.row.step.empty()) {
        html += fmt::format(" This row is about the step <code>{}</code>: {}, at most {} allowed{}.",
                            escapedHtml(result.row.step), fixedPercent(result.stepError()),
                            fixedPercent(result.row.limit), result.isWithinLimit() ? "" : ": <b>too much</b>");
    }
    for (StepResult const& other : result.alternatives)
        html += fmt::format(" {}: {} RMS, {} mean ({}).", escapedHtml(other.title), fixedPercent(other.own),
                            signedPercent(other.bias), escapedHtml(other.approximate));
    return html + fmt::format("<br><code>{} {}</code></p>", kCompareCommand, escapedHtml(result.row.name));
}

constexpr const char* kIntroduction =
        R"(<section id="against-the-path-tracer"><h2>Against the path tracer</h2><p>From the engine's frame to the exact light,
step by step: each line makes one named approximation exact. Above the line "Unexplained" that happens in the engine; below
it, in the path tracer (<code>tools/reference</code>), which starts with the engine's approximations. <b>Changes</b> is the
effect of the step on the picture, <b>mean</b> how much brighter the approximation is, <b>share</b> its part of the squared
difference (the shares add up to 100 %; a negative one hides another), <b>left</b> the remaining difference from the path
tracer. Differences are relative to the mean of engine and path tracer. Maps are red where the upper picture of a step is
brighter and blue where it is darker, saturated at 25 %, and grey where nothing is compared. Hover over a line to see what it
makes exact.</p>)";

std::string closedFormTable(ComparisonResults const& results) {
    std::string html =
            "<p>The path tracer itself, where radiance is a formula (more of them: <code>ctest -R "
            "tools_reference</code>):</p><table><tr><th>scene</th><th>formula</th><th>expected</th><th>traced"
            "</th><th>standard error</th><th>off by</th></tr>";
    for (ClosedForm const& form : results.closedForms) {
        html += fmt::format(
                "<tr><td>{}</td><td>{}</td><td>{:.6f}</td><td>{:.6f}</td><td>{:.1e}</td><td>{:.1f} standard "
                "errors{}</td></tr>",
                escapedHtml(form.name), escapedHtml(form.formula), form.expected, form.mean, form.standardError,
                form.deviations(), form.agrees() ? "" : " <b>too much</b>");
    }
    return html + "</table>";
}

Result<std::string> fragmentOf(ComparisonResults const& results, Pictures const& pictures) {
    std::string html = kIntroduction;
    html += fmt::format("<p class=\"small\">Commit {}, {}, on {}. All of it: <code>{}</code></p>",
                        escapedHtml(results.commit), escapedHtml(results.date), escapedHtml(results.machine),
                        kCompareCommand);
    html += closedFormTable(results);
    for (RowResult const& row : results.rows) {
        const Result<std::string> figures = figuresOf(row, pictures);
        if (!figures) return figures.error();
        html += fmt::format("<h3 id=\"compare-{}\">{}</h3>{}{}{}", escapedHtml(row.row.name),
                            escapedHtml(row.row.title), *figures, tableOf(row), notesOf(row));
    }
    for (Skipped const& one : results.skipped)
        html += fmt::format("<p class=\"small\">{}: not compared, no {}</p>", escapedHtml(one.name),
                            escapedHtml(one.reason));
    return html + kHowToAddRow + "</section>\n";
}

} // namespace

Json jsonOf(ComparisonResults const& results) {
    Json rows = Json::array(), skipped = Json::array(), forms = Json::array();
    for (ClosedForm const& form : results.closedForms) forms.push_back(jsonOf(form));
    for (RowResult const& row : results.rows) rows.push_back(jsonOf(row));
    for (Skipped const& one : results.skipped) skipped.push_back({ { "name", one.name }, { "reason", one.reason } });
    return { { "machine", results.machine },      { "commit", results.commit }, { "date", results.date },
             { "closedForms", std::move(forms) }, { "rows", std::move(rows) },  { "skipped", std::move(skipped) } };
}

Result<void> writeComparison(ComparisonResults const& results, fs::path const& out) {
    const Result<std::string> fragment = fragmentOf(results, Pictures(out / "comparison"));
    if (!fragment) return fragment.error();
    if (const Result<void> written = tools::writeJson(out / "comparison.json", jsonOf(results), 1); !written)
        return written;
    return assets::replaceFile(out / "comparison.fragment.html", std::as_bytes(std::span(*fragment)));
}

std::string textOf(ComparisonResults const& results) {
    std::string text;
    for (ClosedForm const& form : results.closedForms) {
        text += fmt::format("closed form: {}: {:.6f} for {:.6f}, {:.1f} standard errors off{}\n", form.name, form.mean,
                            form.expected, form.deviations(), form.agrees() ? "" : "  TOO MUCH");
    }
    for (RowResult const& row : results.rows) {
        text += fmt::format("{}: RMS {}, mean {}, noise {}, unexplained {} of at most {}{}\n", row.row.name,
                            fixedPercent(row.rms), signedPercent(row.bias), fixedPercent(row.noise),
                            fixedPercent(row.unexplained), fixedPercent(row.row.unexplained),
                            row.isExplained() ? "" : "  TOO MUCH");
        if (!row.row.step.empty()) {
            text += fmt::format("    {}: {} of at most {}{}\n", row.row.step, fixedPercent(row.stepError()),
                                fixedPercent(row.row.limit), row.isWithinLimit() ? "" : "  TOO MUCH");
        }
        for (StepResult const& step : row.steps) {
            text += fmt::format("    {:<18} changes {:>8}  mean {:>8}  share {:>6.1f} %  left {:>8}\n", step.name,
                                fixedPercent(step.own), signedPercent(step.bias), step.share * 100,
                                fixedPercent(step.left));
        }
    }
    return text;
}

} // namespace filament_core::accuracy
