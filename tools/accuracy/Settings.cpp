// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Settings.h"

#include "base/Suggest.h"
#include "tools/common/CommandLine.h"
#include "tools/materials/PlainMaterials.h"

#include <filament/QualityBudget.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

namespace filament::accuracy {
namespace {

using Words = std::span<const std::string_view>;

/// A setting that is no option of View.
struct Choice {
    std::string_view name;
    Words values; ///< those worth measuring
    bool (*set)(Settings& settings, std::string const& value);
    std::string_view range;               ///< for the error
    std::string Settings::*key = nullptr; ///< which of the keys the word belongs to, if it loads something else
};

constexpr std::string_view kSwitch[] = { "off", "on" };
constexpr std::string_view kPresets[] = { "low", "medium", "high", "reference" };
constexpr std::string_view kBudgets[] = { "0.8", "0.9", "1", "1.1", "1.2", "1.4" };
constexpr std::string_view kEnvironmentSamples[] = { "16", "64", "256", "512", "1024", "4096" };
constexpr std::string_view kFaceSizes[] = { "32", "64", "128", "256", "512" };
constexpr std::string_view kFormats[] = { "RGBA16F", "R11G11B10F", "RGB9E5", "RGBM" };
constexpr std::string_view kMappings[] = { "quadratic", "logarithmic", "linear" };
constexpr std::string_view kPositions[] = { "asAuthored", "half", "unorm16" };
constexpr std::string_view kTangents[] = { "float", "snorm16", "snorm8" };

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

bool setEnvironmentSamples(Settings& settings, std::string const& value) {
    const auto number = tools::wholeNumber(value, 1, 65536);
    if (number) settings.environment.samples = *number;
    return number.has_value();
}

bool setFaceSize(Settings& settings, std::string const& value) {
    const auto number = tools::wholeNumber(value, 16, 2048);
    if (!number || !std::has_single_bit(*number)) return false;
    settings.environment.faceSize = *number;
    return true;
}

/// Sets a field of the loading options to an enumerator, by name.
template <auto FromName, auto Options, auto Field>
bool setByName(Settings& settings, std::string const& value) {
    const auto found = FromName(value);
    if (found) settings.*Options.*Field = *found;
    return found.has_value();
}

constexpr auto setFormat =
        setByName<environmentFormatFromName, &Settings::environment, &EnvironmentLoadOptions::format>;
constexpr auto setMapping =
        setByName<enumFromName<RoughnessMapping>, &Settings::environment, &EnvironmentLoadOptions::roughnessMapping>;
constexpr auto setPositions = setByName<enumFromName<PositionStorage>, &Settings::model, &GltfLoadOptions::positions>;
constexpr auto setTangents = setByName<enumFromName<TangentStorage>, &Settings::model, &GltfLoadOptions::tangents>;

bool setExact(Settings& settings, std::string const& value) {
    if (value != "on" && value != "off") return false;
    settings.engine.exactShaders = value == "on";
    settings.engine.debug.plainMaterials = &tools::plainMaterial;
    settings.engineKey = value == "on" ? "" : "exact=off"; // the default needs no separate engine
    return true;
}

constexpr std::array kChoices{
    Choice{ "preset", kPresets, setPreset, "low, medium, high or reference" },
    Choice{ "budget", kBudgets, setBudget, "how many times the default's time, above 0" },
    Choice{ "exact", kSwitch, setExact, "off or on" },
    Choice{ "environment.samples", kEnvironmentSamples, setEnvironmentSamples, "a whole number from 1 to 65536",
            &Settings::environmentKey },
    Choice{ "environment.faceSize", kFaceSizes, setFaceSize, "a power of two from 16 to 2048",
            &Settings::environmentKey },
    Choice{ "environment.format", kFormats, setFormat, "RGBA16F, R11G11B10F, RGB9E5 or RGBM",
            &Settings::environmentKey },
    Choice{ "environment.roughnessMapping", kMappings, setMapping, "quadratic, logarithmic or linear",
            &Settings::environmentKey },
    Choice{ "model.positions", kPositions, setPositions, "asAuthored, half or unorm16", &Settings::modelKey },
    Choice{ "model.tangents", kTangents, setTangents, "float, snorm16 or snorm8", &Settings::modelKey },
};

Choice const* findChoice(std::string_view name) {
    const auto found = std::ranges::find(kChoices, name, &Choice::name);
    return found == kChoices.end() ? nullptr : &*found;
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
    Choice const* choice = findChoice(name);
    if (!choice) {
        Result<void> done = setOption(settings.view, name, value);
        return !done && done.error().code == ErrorCode::NotFound ? Result<void>(unknown(name)) : done;
    }
    if (!choice->set(settings, value))
        return fail(ErrorCode::InvalidArgument, "setting {}: '{}' is not {}", name, value, choice->range);
    if (choice->key) (settings.*choice->key += ' ') += word;
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
    else if (Option const* option = findOption(optionsOf<View>(), choice))
        words = option->values;
    return { words.begin(), words.end() };
}

} // namespace filament::accuracy
