// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Settings.h"

#include "base/Suggest.h"
#include "toolkit/materials/PlainMaterials.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/QualityBudget.h>

#include <algorithm>
#include <array>
#include <optional>

namespace filament_core::accuracy {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::string_view kEnvironment = "environment.", kModel = "model.";

/// A setting that is no option of View.
struct Choice {
    std::string_view name;
    Words values; ///< those worth measuring
    bool (*set)(Settings& settings, std::string const& value);
    std::string_view range; ///< for the error
};

constexpr std::string_view kSwitch[] = { "off", "on" };
constexpr std::string_view kPresets[] = { "low", "medium", "high", "reference" };
constexpr std::string_view kBudgets[] = { "0.8", "0.9", "1", "1.1", "1.2", "1.4" };
bool setPreset(Settings& settings, std::string const& value) {
    const std::optional<QualityPreset> preset = enumFromName<QualityPreset>(value);
    if (preset) settings.view.quality = qualityPreset(*preset);
    return preset.has_value();
}

/// The settings that the library's own cost table affords for a multiple of the default's time.
bool setBudget(Settings& settings, std::string const& value) {
    constexpr double kDefaultMilliseconds = 100; // arbitrary: only ratios count
    const std::optional<double> times = tools::finiteNumber(value);
    if (!times || !(*times > 0)) return false;
    const Result<QualityDecision> decision = chooseQuality(
            { .gpuMilliseconds = *times * kDefaultMilliseconds, .frameMilliseconds = kDefaultMilliseconds });
    if (decision) settings.view.quality = decision->quality;
    return decision.ok();
}

bool setExact(Settings& settings, std::string const& value) {
    if (value != "on" && value != "off") return false;
    settings.engine.exactShaders = value == "on";
    settings.engine.debug.plainMaterials = &tools::plainMaterial;
    settings.engineKey = value == "on" ? "" : "exact=off"; // the default needs no separate engine
    return true;
}

/// 0 for "off". Finer ones bake for hours.
std::optional<double> bakeNumber(std::string const& value, double least, double most) {
    if (value == "off") return 0;
    const std::optional<double> number = tools::finiteNumber(value);
    return number && *number >= least && *number <= most ? number : std::nullopt;
}

constexpr std::string_view kGridMeters[] = { "off", "1", "0.5" };
bool setGrid(Settings& settings, std::string const& value) {
    const std::optional<double> meters = bakeNumber(value, 0.05, 100);
    if (meters) settings.bake.gridMeters = *meters;
    return meters.has_value();
}

constexpr std::string_view kLightmapTexels[] = { "off", "4", "8", "16" };
bool setLightmap(Settings& settings, std::string const& value) {
    const std::optional<double> texels = bakeNumber(value, 0.1, 64);
    if (texels) settings.bake.texelsPerMeter = *texels;
    return texels.has_value();
}

constexpr std::array kChoices{
    Choice{ "preset", kPresets, setPreset, "low, medium, high or reference" },
    Choice{ "budget", kBudgets, setBudget, "how many times the default's time, above 0" },
    Choice{ "exact", kSwitch, setExact, "off or on" },
    Choice{ "bake.grid", kGridMeters, setGrid, "off or metres between probes, 0.05 to 100" },
    Choice{ "bake.lightmap", kLightmapTexels, setLightmap, "off or texels a metre, 0.1 to 64" },
};

Choice const* findChoice(std::string_view name) {
    const auto found = std::ranges::find(kChoices, name, &Choice::name);
    return found == kChoices.end() ? nullptr : &*found;
}

Option const* findLoadedOrShown(std::string_view name) {
    if (name.starts_with(kEnvironment))
        return findOption(optionsOf<EnvironmentLoadOptions>(), name.substr(kEnvironment.size()));
    if (name.starts_with(kModel)) return findOption(optionsOf<GltfLoadOptions>(), name.substr(kModel.size()));
    return findOption(optionsOf<View>(), name);
}

Error unknown(std::string_view name) {
    std::vector<std::string_view> known;
    for (Choice const& choice : kChoices) known.push_back(choice.name);
    for (Option const& option : optionsOf<View>()) known.push_back(option.name);
    return fail(ErrorCode::NotFound, "there is no setting '{}'{}", name, suggestion(name, known));
}

} // namespace

Result<void> change(Settings& settings, std::string_view word) {
    const size_t equals = word.find('=');
    if (equals == std::string_view::npos)
        return fail(ErrorCode::InvalidArgument, "'{}' is not a setting; write NAME=VALUE", word);
    const std::string_view name = word.substr(0, equals);
    const std::string value(word.substr(equals + 1));
    if (name.starts_with(kEnvironment)) {
        (settings.environmentKey += ' ') += word;
        return setOption(settings.environment, name.substr(kEnvironment.size()), value);
    }
    if (name.starts_with(kModel)) {
        (settings.modelKey += ' ') += word;
        return setOption(settings.model, name.substr(kModel.size()), value);
    }
    Choice const* choice = findChoice(name);
    if (!choice) {
        Result<void> done = setOption(settings.view, name, value);
        return !done && done.error().code == ErrorCode::NotFound ? Result<void>(unknown(name)) : done;
    }
    if (!choice->set(settings, value))
        return fail(ErrorCode::InvalidArgument, "setting {}: '{}' is not {}", name, value, choice->range);
    return {};
}

Result<void> change(Settings& settings, std::span<const std::string> words) {
    for (std::string const& word : words) {
        if (Result<void> done = change(settings, word); !done) return done;
    }
    return {};
}

std::vector<std::string> valuesOf(std::string_view choice) {
    Words words;
    if (Choice const* own = findChoice(choice))
        words = own->values;
    else if (Option const* option = findLoadedOrShown(choice))
        words = option->values;
    return { words.begin(), words.end() };
}

} // namespace filament_core::accuracy
