// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace filament::accuracy {
namespace {

using Json = nlohmann::ordered_json;

/// Four significant digits: the rest is noise that changes with every run.
double rounded(double value) {
    if (value == 0 || !std::isfinite(value)) return 0;
    const double scale = std::pow(10, 3 - std::floor(std::log10(std::abs(value))));
    return std::round(value * scale) / scale;
}

Json intervalOf(Estimate const& estimate) { return { rounded(estimate.low), rounded(estimate.high) }; }

Json jsonOf(ValueResult const& value) {
    Json json{ { "value", value.value.name },
               { "set", value.value.set },
               { "error", rounded(value.frame.rms) },
               { "ownError", rounded(value.own.rms) },
               { "ownMax", rounded(value.own.max) },
               { "ownFlip", rounded(value.own.flip) },
               { "frameFlip", rounded(value.frame.flip) },
               { "totalError", rounded(value.total) } };
    for (auto const& [backend, timing] : value.timings) {
        json["milliseconds"][backend] = rounded(timing.milliseconds.median);
        json["millisecondsInterval"][backend] = intervalOf(timing.milliseconds);
        json["ratio"][backend] = rounded(timing.ratio.median);
        json["interval"][backend] = intervalOf(timing.ratio);
    }
    return json;
}

Json jsonOf(EffectResult const& result) {
    Effect const& effect = result.effect;
    Json json{ { "name", effect.name },
               { "title", effect.title },
               { "question", effect.question },
               { "reference", describe(effect.reference) },
               { "referenceError", rounded(result.referenceError) },
               { "scene", effect.scene },
               { "command", result.command },
               { "cost", toString(effect.cost) },
               { "frame", effect.frame },
               { "linear", result.linear },
               { "standard", effect.values[effect.standard].name },
               { "best", effect.values[effect.best].name },
               { "values", Json::array() } };
    for (ValueResult const& value : result.values) json["values"].push_back(jsonOf(value));
    return json;
}

} // namespace

Json jsonOf(Results const& results) {
    Json json{ { "program", "filament-accuracy" }, { "version", 1 },
               { "machine", results.machine },     { "driver", results.drivers },
               { "commit", results.commit },       { "date", results.date },
               { "frame", results.frame },         { "size", { results.size.x, results.size.y } },
               { "rounds", results.rounds },       { "effects", Json::array() },
               { "skipped", Json::array() } };
    for (EffectResult const& effect : results.effects) json["effects"].push_back(jsonOf(effect));
    for (Skipped const& one : results.skipped)
        json["skipped"].push_back({ { "name", one.name }, { "reason", one.reason } });
    return json;
}

std::string csvOf(Results const& results) {
    std::string csv = "effect,value,settings,cost,backend,milliseconds,low,high,ratio,ratioLow,ratioHigh,ownRms,ownMax,"
                      "ownFlip,frameRms,frameFlip,totalRms\n";
    for (EffectResult const& effect : results.effects) {
        for (ValueResult const& value : effect.values) {
            for (auto const& [backend, timing] : value.timings) {
                Estimate const &t = timing.milliseconds, &r = timing.ratio;
                csv += fmt::format(
                        "{},{},{},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},"
                        "{:.4g},{:.4g}\n",
                        effect.effect.name, value.value.name, fmt::join(value.value.set, " "),
                        toString(effect.effect.cost), backend, t.median, t.low, t.high, r.median, r.low, r.high,
                        value.own.rms, value.own.max, value.own.flip, value.frame.rms, value.frame.flip, value.total);
            }
        }
    }
    return csv;
}

} // namespace filament::accuracy
