// SPDX-License-Identifier: Apache-2.0
// Cost tables as JSON: reading names a reason for everything that is refused, writing puts one value on a line.
#include "base/Suggest.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/files/JsonTree.h"

#include <filament_core/Options.h>
#include <filament_core/Quality.h>
#include <filament_core/QualityCosts.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace filament_core {
namespace {

using assets::Diagnostics;
using assets::JsonNode;

// Limits beyond those of optionsOf<Quality>(): they bound the work of reading and choosing.
constexpr size_t kMaxEffects = 64, kMaxValues = 16;
constexpr double kMaxError = 100, kMinMilliseconds = 1e-6, kMaxMilliseconds = 1e6, kMaxSide = 65536;
constexpr double kMaxRatio = kMaxMilliseconds / kMinMilliseconds;

struct BackendKey {
    Backend backend;
    const char* key;
};
constexpr BackendKey kBackends[] = { { Backend::Vulkan, "vulkan" }, { Backend::Gles, "gles" } };

double numberOf(JsonNode const& node, double low, double high) {
    const double value = node.number(-1);
    if (value >= low && value <= high) return value;
    node.diagnostics().refuse(ErrorCode::InvalidArgument, "{}: must be a number from {} to {}", node.path(), low, high);
    return low;
}

QualityCost::Time readTime(JsonNode const& value, const char* key) {
    QualityCost::Time time;
    const JsonNode milliseconds = value["milliseconds"][key];
    if (!milliseconds.exists()) return time;
    time.milliseconds = numberOf(milliseconds, kMinMilliseconds, kMaxMilliseconds);
    const JsonNode interval = value["interval"][key];
    std::array<double, 2> ratios{ 1, 1 };
    if (!interval.numbers(ratios)) {
        time.lowRatio = time.highRatio = 0; // not measured: readEffect() fills in the ratio itself
        return time;
    }
    if (!(ratios[0] > 0 && ratios[0] <= ratios[1] && ratios[1] <= kMaxRatio)) {
        value.diagnostics().refuse(ErrorCode::InvalidArgument,
                                   "{}: must be the least and the largest ratio to the default's time",
                                   interval.path());
    }
    time.lowRatio = ratios[0];
    time.highRatio = ratios[1];
    return time;
}

QualityCost readValue(JsonNode const& node, std::string const& choice) {
    QualityCost cost;
    cost.value = node["value"].text();
    Quality probe;
    if (const Result<void> known = setOption(probe, choice, cost.value); !known) {
        node.diagnostics().refuse(ErrorCode::InvalidArgument, "{}.value: {}", node.path(), known.error().message);
    } else {
        cost.value = *optionValue(probe, choice); // "064" is "64"
    }
    cost.error = numberOf(node["error"], 0, kMaxError);
    for (auto const& [backend, key] : kBackends) cost.on(backend) = readTime(node, key);
    return cost;
}

/// Without a measured interval, the ratio counts as exact.
void fillIntervals(QualityEffect& effect, QualityCost const& standard) {
    for (QualityCost& cost : effect.values) {
        for (auto const& [backend, key] : kBackends) {
            QualityCost::Time& time = cost.on(backend);
            if (time.lowRatio > 0) continue;
            const double base = standard.on(backend).milliseconds;
            time.lowRatio = time.highRatio = base > 0 ? time.milliseconds / base : 1;
        }
    }
}

bool isChoice(std::string_view name) {
    return std::ranges::any_of(optionsOf<Quality>(), [&](Option const& choice) { return choice.name == name; });
}

QualityEffect readEffect(JsonNode const& node) {
    Diagnostics& diagnostics = node.diagnostics();
    QualityEffect effect{ .name = node["name"].text(), .values = {} };
    if (!isChoice(effect.name)) {
        diagnostics.refuse(ErrorCode::InvalidArgument, "{}.name: there is no quality choice '{}'{}", node.path(),
                           effect.name, suggestion(effect.name, namesOf(optionsOf<Quality>())));
        return effect;
    }
    const std::string standard = *optionValue(Quality{}, effect.name);
    const JsonNode values = node["values"];
    if (values.elementCount() > kMaxValues) {
        diagnostics.refuse(ErrorCode::InvalidArgument, "{}: more than {} values", values.path(), kMaxValues);
        return effect;
    }
    for (JsonNode const& element : values.elements()) {
        QualityCost cost = readValue(element, effect.name);
        if (std::ranges::find(effect.values, cost.value, &QualityCost::value) != effect.values.end())
            diagnostics.refuse(ErrorCode::InvalidArgument, "{}: '{}' is there twice", element.path(), cost.value);
        effect.values.push_back(std::move(cost));
    }
    const auto found = std::ranges::find(effect.values, standard, &QualityCost::value);
    if (found == effect.values.end()) {
        diagnostics.refuse(ErrorCode::InvalidArgument,
                           "{}: '{}', the default that the others are compared with, is missing", values.path(),
                           standard);
        return effect;
    }
    fillIntervals(effect, QualityCost(*found));
    return effect;
}

void readEffects(JsonNode const& node, QualityCosts& costs) {
    Diagnostics& diagnostics = node.diagnostics();
    if (const size_t count = node.elementCount(); count == 0 || count > kMaxEffects) {
        return diagnostics.refuse(ErrorCode::InvalidArgument, "{}: must be a list of 1 to {} effects", node.path(),
                                  kMaxEffects);
    }
    for (JsonNode const& element : node.elements()) {
        QualityEffect effect = readEffect(element);
        if (std::ranges::find(costs.effects, effect.name, &QualityEffect::name) != costs.effects.end())
            diagnostics.refuse(ErrorCode::InvalidArgument, "{}: '{}' is there twice", element.path(), effect.name);
        costs.effects.push_back(std::move(effect));
    }
}

/// A backend must be measured for every value or for none.
void checkBackends(QualityCosts const& costs, Diagnostics& diagnostics) {
    size_t complete = 0;
    for (auto const& [backend, key] : kBackends) {
        size_t measured = 0, total = 0;
        QualityCost const* lacking = nullptr;
        std::string_view where;
        for (QualityEffect const& effect : costs.effects) {
            for (QualityCost const& cost : effect.values) {
                ++total;
                if (cost.on(backend).milliseconds > 0) {
                    ++measured;
                } else if (!lacking) {
                    lacking = &cost;
                    where = effect.name;
                }
            }
        }
        if (measured == total) {
            ++complete;
        } else if (measured > 0) {
            diagnostics.refuse(ErrorCode::InvalidArgument, "{}={}: no milliseconds.{}, which others have", where,
                               lacking->value, key);
        }
    }
    if (complete == 0)
        diagnostics.refuse(ErrorCode::InvalidArgument, "no milliseconds of vulkan or gles; measure at least one");
}

uint2 readSize(JsonNode const& node) {
    std::array<double, 2> size{};
    const auto isSide = [](double side) { return side >= 1 && side <= kMaxSide && side == std::floor(side); };
    if (!node.numbers(size) || !isSide(size[0]) || !isSide(size[1])) {
        node.diagnostics().refuse(ErrorCode::InvalidArgument, "{}: must be width and height in pixels", node.path());
        return uint2(1);
    }
    return { static_cast<uint32_t>(size[0]), static_cast<uint32_t>(size[1]) };
}

std::string quoted(std::string const& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string timesOf(QualityCost const& cost) {
    std::string milliseconds, intervals;
    for (auto const& [backend, key] : kBackends) {
        QualityCost::Time const& time = cost.on(backend);
        if (time.milliseconds <= 0) continue;
        const char* comma = milliseconds.empty() ? "" : ", ";
        milliseconds += fmt::format("{}\"{}\": {:.6g}", comma, key, time.milliseconds);
        intervals += fmt::format("{}\"{}\": [{:.5g}, {:.5g}]", comma, key, time.lowRatio, time.highRatio);
    }
    return fmt::format("\"milliseconds\": {{ {} }}, \"interval\": {{ {} }}", milliseconds, intervals);
}

} // namespace

Result<QualityCosts> readQualityCosts(std::string_view json, std::string_view name) {
    Diagnostics diagnostics;
    const assets::JsonTree tree(std::as_bytes(std::span(json)), diagnostics);
    QualityCosts costs;
    if (diagnostics.ok()) {
        const JsonNode root = tree.root(diagnostics);
        costs.machine = root["machine"].text();
        costs.driver = root["driver"].text();
        costs.commit = root["commit"].text();
        costs.size = readSize(root["size"]);
        readEffects(root["effects"], costs);
    }
    if (diagnostics.ok()) checkBackends(costs, diagnostics);
    if (diagnostics.ok()) return costs;
    return fail(diagnostics.error().code, "{}: {}", name, diagnostics.error().message);
}

Result<QualityCosts> loadQualityCosts(std::filesystem::path const& file) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    return readQualityCosts({ reinterpret_cast<const char*>(bytes->data()), bytes->size() }, file.string());
}

std::string toJson(QualityCosts const& costs) {
    std::string text =
            fmt::format("{{\n  \"machine\": {},\n  \"driver\": {},\n  \"commit\": {},\n  \"size\": [{}, {}],\n"
                        "  \"effects\": [",
                        quoted(costs.machine), quoted(costs.driver), quoted(costs.commit), costs.size.x, costs.size.y);
    for (QualityEffect const& effect : costs.effects) {
        text += &effect == &costs.effects.front() ? "\n" : ",\n";
        text += fmt::format("    {{ \"name\": {}, \"values\": [", quoted(effect.name));
        for (QualityCost const& cost : effect.values) {
            text += &cost == &effect.values.front() ? "\n" : ",\n";
            text += fmt::format("      {{ \"value\": {}, \"error\": {:.6g}, {} }}", quoted(cost.value), cost.error,
                                timesOf(cost));
        }
        text += " ] }";
    }
    return text + " ]\n}\n";
}

} // namespace filament_core
