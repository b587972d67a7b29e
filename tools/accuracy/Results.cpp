// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace filament_core::accuracy {
namespace {

using tools::Json;

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

std::string csvLine(Json const& effect, Json const& value, std::string const& backend) {
    Json const &milliseconds = value.at("millisecondsInterval").at(backend), &ratio = value.at("interval").at(backend);
    std::string line =
            fmt::format("{},{},{},{},{}", effect.at("name").get<std::string>(), value.at("value").get<std::string>(),
                        fmt::join(value.at("set").get<std::vector<std::string>>(), " "),
                        effect.at("cost").get<std::string>(), backend);
    for (Json const* number :
         { &value.at("milliseconds").at(backend), &milliseconds.at(0), &milliseconds.at(1),
           &value.at("ratio").at(backend), &ratio.at(0), &ratio.at(1), &value.at("ownError"), &value.at("ownMax"),
           &value.at("ownFlip"), &value.at("error"), &value.at("frameFlip"), &value.at("totalError") })
        line += fmt::format(",{:.4g}", number->get<double>());
    return line + '\n';
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

std::string csvOf(Json const& data) {
    std::string csv = "effect,value,settings,cost,backend,milliseconds,low,high,ratio,ratioLow,ratioHigh,ownRms,ownMax,"
                      "ownFlip,frameRms,frameFlip,totalRms\n";
    for (Json const& effect : data.at("effects")) {
        for (Json const& value : effect.at("values")) {
            const Json timings = value.value("milliseconds", Json::object());
            for (auto const& [backend, milliseconds] : timings.items()) csv += csvLine(effect, value, backend);
        }
    }
    return csv;
}

} // namespace filament_core::accuracy
