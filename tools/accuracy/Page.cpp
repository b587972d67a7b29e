// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Page.h"

#include "filament_core/assets/files/FileBytes.h"
#include "tools/accuracy/PagePictures.h"
#include "tools/common/Console.h"
#include "tools/common/Html.h"
#include "tools/paths/Paths.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <span>

namespace filament::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCommand = "build/release/bin/filament-accuracy";

constexpr const char* kHead =
        R"(<!doctype html><html lang="en"><head><meta charset="utf-8"><title>What accuracy costs</title><style>
body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:68rem;padding:0 1rem;color:#222;background:#fff}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}td,th{padding:.15rem .7rem;text-align:right;
border-bottom:1px solid #ddd;white-space:nowrap}td:first-child,th:first-child{text-align:left}section{border-top:1px solid
#bbb;margin-top:1.6rem}h2{margin:.8rem 0 .2rem}code{background:#f3f3f3;padding:.1rem .3rem}img{max-width:100%;display:block}
.small{color:#555;font-size:13px}.standard td:first-child{font-weight:bold}pre{background:#f3f3f3;padding:.6rem}
</style></head><body>
)";

std::string percent(double value) {
    if (value == 0) return "0";
    return value < 1e-5 ? fmt::format("{:.1e}", value) : fmt::format("{:.3g} %", value * 100);
}

std::string timeCell(Timing const& timing, bool isStandard) {
    std::string cell = fmt::format("<td title=\"95 % interval {:.4g} to {:.4g} ms\">{:.4g} ms</td>",
                                   timing.milliseconds.low, timing.milliseconds.high, timing.milliseconds.median);
    if (isStandard) return cell + "<td>1</td>";
    return cell + fmt::format("<td>{:.3f} <span class=\"small\">[{:.3f}, {:.3f}]</span></td>", timing.ratio.median,
                              timing.ratio.low, timing.ratio.high);
}

std::string tableOf(EffectResult const& result) {
    Effect const& effect = result.effect;
    const bool hasFlip = effect.reference.kind != ReferenceKind::Integral;
    std::string html = "<table><tr><th>value</th><th>error, RMS</th><th>largest</th>";
    if (hasFlip) html += "<th>FLIP</th>";
    html += "<th>whole frame</th>";
    if (result.values.empty()) return {};
    for (auto const& [backend, timing] : result.values.front().timings)
        html += fmt::format("<th>{}</th><th>&times; {}</th>", tools::escapedHtml(backend),
                            tools::escapedHtml(effect.values[effect.standard].name));
    html += "</tr>";
    for (size_t i = 0; i < result.values.size(); ++i) {
        ValueResult const& value = result.values[i];
        html += fmt::format("<tr{}><td title=\"{}\">{}</td><td>{}</td><td>{}</td>",
                            i == effect.standard ? " class=\"standard\"" : "",
                            tools::escapedHtml(fmt::format("{}", fmt::join(value.value.set, " "))),
                            tools::escapedHtml(value.value.name), percent(value.own.rms), percent(value.own.max));
        if (hasFlip) html += fmt::format("<td>{:.4f}</td>", value.own.flip);
        html += fmt::format("<td>{}</td>", percent(value.frame.rms));
        for (auto const& [backend, timing] : value.timings) html += timeCell(timing, i == effect.standard);
        html += "</tr>";
    }
    return html + "</table>";
}

using Plots = std::map<std::string, std::string>;

std::string imageTag(Plots const& plots, std::string const& name, std::string const& title) {
    const auto plot = plots.find(name);
    if (plot == plots.end()) return {};
    return fmt::format("<img alt=\"{}\" src=\"{}\">", tools::escapedHtml(title), tools::escapedHtml(plot->second));
}

std::string sectionOf(EffectResult const& result, Plots const& plots) {
    Effect const& effect = result.effect;
    std::string reference = describe(effect.reference);
    if (result.referenceError > 0) reference += fmt::format(" (standard error {})", percent(result.referenceError));
    std::string html = fmt::format("<section id=\"{0}\"><h2>{1}</h2><p>{2}</p>", tools::escapedHtml(effect.name),
                                   tools::escapedHtml(effect.title), tools::escapedHtml(effect.question));
    html += imageTag(plots, effect.name, effect.title);
    html += tableOf(result);
    html += fmt::format("<p class=\"small\">Reference: {}. ", tools::escapedHtml(reference));
    if (!effect.scene.empty()) html += fmt::format("Scene: <code>{}</code>. ", tools::escapedHtml(effect.scene));
    html += effect.cost == Cost::Frame ? fmt::format("Time: the device's, for a whole frame of <code>{}</code>. ",
                                                     tools::escapedHtml(effect.frame))
                                       : fmt::format("Time: to load the {} of <code>{}</code> from its file. ",
                                                     toString(effect.cost), tools::escapedHtml(effect.frame));
    html += fmt::format("Whole frame: <code>{}</code> against {}.<br><code>{}</code></p></section>",
                        tools::escapedHtml(effect.frame), tools::escapedHtml(effect.values[effect.best].name),
                        tools::escapedHtml(result.command));
    return html;
}

constexpr const char* kMethod = R"(</ul><p>To reproduce everything:</p><pre>{0} --compare --out out/accuracy &amp;&amp;
{0} --out out/accuracy --page docs/accuracy.html</pre><p>Every section names the command that reproduces it alone.</p>
<p><b>Error</b> of a pixel: the difference to the reference over the brighter of both plus 1 % of the reference's mean; RMS
and largest over all pixels that show something. FLIP (Andersson et al. 2020) is what a viewer sees when flipping between the
pictures: 0 nothing, 1 everything. <b>Whole frame</b>: RMS of the scene <code>{1}</code> against the best value of the effect.
<b>Time</b>: medians of {2} turns at {3} x {4}, all values of an effect in turns; the ratio to the standard value (bold) is
taken turn by turn, its 95 % interval by bootstrap. Errors are those of the first backend; if the second one does not draw the
same bits, <a href="quality.md">quality.md</a> says so.</p>
)";

std::string introduction(Results const& results) {
    std::string html = fmt::format(
            R"(<h1>What accuracy costs</h1><p>Measures every approximation of the engine that has an alternative: the error of
each value against its effect's reference, and its cost. {} effects. Commit {}, {}, on {}.</p><ul>)",
            results.effects.size(), tools::escapedHtml(results.commit), tools::escapedHtml(results.date),
            tools::escapedHtml(results.machine));
    for (auto const& [backend, driver] : results.drivers)
        html += fmt::format("<li>{}: {}</li>", tools::escapedHtml(backend), tools::escapedHtml(driver));
    return html + fmt::format(kMethod, kCommand, tools::escapedHtml(results.frame), results.rounds, results.size.x,
                              results.size.y);
}

/// "1.21 vulkan, 1.30 gles", without ratios whose interval includes 1.
std::string ratiosOf(ValueResult const& value) {
    std::string text;
    for (auto const& [backend, timing] : value.timings) {
        if (timing.ratio.low <= 1 && timing.ratio.high >= 1) continue;
        text += fmt::format("{}&times; {:.2f} {}", text.empty() ? "" : ", ", timing.ratio.median,
                            tools::escapedHtml(backend));
    }
    return text.empty() ? "no measurable difference" : text;
}

/// The value with the least error next to the standard one's, and the cost of choosing it.
std::string glanceOf(EffectResult const& result) {
    ValueResult const& standard = result.values[result.effect.standard];
    ValueResult const& best =
            *std::ranges::min_element(result.values, {}, [](ValueResult const& value) { return value.own.rms; });
    std::string row = fmt::format("<tr><td><a href=\"#{}\">{}</a></td><td>{}</td><td>{}</td>",
                                  tools::escapedHtml(result.effect.name), tools::escapedHtml(result.effect.title),
                                  tools::escapedHtml(standard.value.name), percent(standard.own.rms));
    if (&best == &standard) return row + "<td colspan=\"3\" class=\"small\">no value is more exact</td></tr>";
    return row + fmt::format("<td>{}</td><td>{}</td><td>{}</td></tr>", tools::escapedHtml(best.value.name),
                             percent(best.own.rms), ratiosOf(best));
}

std::string glance(Results const& results) {
    std::string html = "<section><h2>At a glance</h2><table><tr><th>effect</th><th>standard</th><th>error</th>"
                       "<th>most exact</th><th>error</th><th>time of the most exact</th></tr>";
    for (EffectResult const& effect : results.effects) html += glanceOf(effect);
    return html + "</table></section>";
}

constexpr const char* kHowToAdd =
        R"(<section><h2>Adding an effect</h2><p>An object in <code>tools/accuracy/effects.json</code>:</p><pre>{
  "name": "specularVisibility", "title": "Masking of microfacets", "choice": "specularVisibility",
  "question": "What do square roots in the visibility term buy?",
  "scene": "sun-chart",
  "reference": { "kind": "traced", "set": ["specularVisibility=correlated"] }
}</pre><p><code>values</code> chooses among the values of the choice, or lists several settings each
(<code>"diffuseIrradiance=sphericalHarmonics shBands=2"</code>); <code>standard</code> and <code>best</code> name values (the
first one unless told otherwise); <code>base</code> are settings of all values; <code>cost</code> is <code>frame</code>,
<code>environment</code> or <code>model</code>. References: <code>setting</code> (the engine with <code>set</code>),
<code>scene</code>, <code>supersampled</code> (<code>factor</code>), <code>traced</code> (<code>samples</code>), <code>otherBackend</code>,
<code>furnace</code>, <code>integral</code>. Scenes are files as in <a href="conformance.md">conformance.md</a>.</p></section>)";

std::string skippedHtml(Results const& results) {
    if (results.skipped.empty()) return {};
    std::string html = "<section><h2>Not measured</h2><ul>";
    for (Skipped const& one : results.skipped)
        html += fmt::format("<li>{}: needs {}</li>", tools::escapedHtml(one.name), tools::escapedHtml(one.reason));
    return html + "</ul></section>";
}

Result<void> writeText(fs::path const& path, std::string const& text) {
    return assets::replaceFile(path, std::as_bytes(std::span(text)));
}

/// One process for all plots, because starting matplotlib takes longer than drawing.
void drawPlots(fs::path const& out) {
    const std::string command =
            fmt::format("'{}' '{}/tools/plot/plot.py' accuracy '{}' -o '{}'", tools::plotPython().string(),
                        tools::sourceDir().string(), (out / "results.json").string(), (out / "plots").string());
    if (std::system(command.c_str()) != 0) tools::printWarning("no plots: tools/plot/plot.py failed");
}

Result<std::vector<std::string>> sectionsOf(ReportPlaces const& places, PagePictures& pictures) {
    std::vector<fs::path> files = places.include;
    std::error_code error;
    for (auto const& entry : fs::directory_iterator(places.out, error))
        if (entry.path().string().ends_with(".fragment.html")) files.push_back(entry.path());
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(places.include.size()), files.end());
    std::vector<std::string> sections;
    for (fs::path const& file : files) {
        const auto bytes = assets::readFileBytes(file);
        if (!bytes) {
            tools::printWarning(bytes.error().message);
            continue;
        }
        const std::string fragment(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        Result<std::string> section = pictures.adopt(fragment, file.parent_path());
        if (!section) return section.error();
        sections.push_back(std::move(*section));
    }
    return sections;
}

/// Of the effects whose plots exist.
Result<Plots> plotsOf(Results const& results, fs::path const& folder, PagePictures& pictures) {
    std::vector<std::string> names{ "frames" };
    for (EffectResult const& effect : results.effects) names.push_back(effect.effect.name);
    Plots plots;
    for (std::string const& name : names) {
        const fs::path file = folder / (name + ".svg");
        if (!fs::exists(file)) continue;
        Result<std::string> address = pictures.add(file);
        if (!address) return address.error();
        plots[name] = std::move(*address);
    }
    return plots;
}

} // namespace

std::string htmlOf(Results const& results, Plots const& plots, std::vector<std::string> const& sections) {
    std::string html = kHead + introduction(results) + glance(results);
    if (const std::string frames = imageTag(plots, "frames", "Whole frames"); !frames.empty())
        html += R"(<section><h2>Whole frames</h2><p>Presets, budgets, and every value of every effect alone: time and error of
the same frame, against a frame with the best value of everything.</p>)" +
                frames + "</section>";
    for (EffectResult const& effect : results.effects) html += sectionOf(effect, plots);
    for (std::string const& section : sections) html += section;
    return html + skippedHtml(results) + kHowToAdd + "</body></html>\n";
}

Result<void> writeReport(Results const& results, ReportPlaces const& places) {
    Results complete = results;
    for (EffectResult& effect : complete.effects)
        effect.command = fmt::format("{} --effect {}", kCommand, effect.effect.name);
    if (auto done = writeText(places.out / "results.json", jsonOf(complete).dump(1) + "\n"); !done) return done;
    if (auto done = writeText(places.out / "results.csv", csvOf(complete)); !done) return done;
    if (places.plots) drawPlots(places.out);
    PagePictures pictures(places.page);
    const Result<Plots> plots = plotsOf(complete, places.out / "plots", pictures);
    if (!plots) return plots.error();
    const Result<std::vector<std::string>> sections = sectionsOf(places, pictures);
    if (!sections) return sections.error();
    pictures.removeOthers();
    return writeText(places.page, htmlOf(complete, *plots, *sections));
}

} // namespace filament::accuracy
