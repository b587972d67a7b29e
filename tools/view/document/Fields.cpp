// SPDX-License-Identifier: Apache-2.0
#include "tools/view/document/Fields.h"

#include "base/Result.h"

#include <filament/Material.h>

namespace filament::view {
namespace {

template <class Options>
std::vector<std::string_view> namesOfAll(Options const& options) {
    std::vector<std::string_view> names;
    for (auto const& option : options) names.push_back(option.name);
    return names;
}

// Options of filament-render of their own, so no ColorGradingOption.
constexpr std::string_view kToneMapper = "toneMapper", kDither = "dither";

} // namespace

// ParameterValue and ParameterType list the same types in the same order.
const char* parameterTypeName(size_t index) { return toString(static_cast<ParameterType>(index)); }

std::vector<std::string_view> optionNames(Quality const*) { return namesOfAll(qualityChoices()); }
std::vector<std::string_view> optionNames(Effects const*) { return namesOfAll(effectOptions()); }
std::vector<std::string_view> optionNames(ColorGrading const*) {
    std::vector<std::string_view> names = namesOfAll(colorGradingOptions());
    names.insert(names.begin(), { kToneMapper, kDither });
    return names;
}

std::string optionText(Quality const& quality, std::string_view name) {
    return qualityValue(quality, name).value_or("");
}
std::string optionText(Effects const& effects, std::string_view name) {
    return effectValue(effects, name).value_or("");
}
std::string optionText(ColorGrading const& grading, std::string_view name) {
    if (name == kToneMapper) return toString(grading.toneMapper);
    if (name == kDither) return grading.dither ? "on" : "off";
    return colorGradingValue(grading, name).value_or("");
}

Result<void> setOption(Quality& quality, std::string_view name, std::string_view text) {
    return setQuality(quality, name, text);
}
Result<void> setOption(Effects& effects, std::string_view name, std::string_view text) {
    return setEffect(effects, name, text);
}
Result<void> setOption(ColorGrading& grading, std::string_view name, std::string_view text) {
    if (name == kToneMapper) {
        const auto known = toneMapperFromName(text);
        if (known) grading.toneMapper = *known;
        return known ? Result<void>() : fail(ErrorCode::InvalidArgument, "expected {}", toneMapperNames());
    }
    if (name == kDither) {
        if (text == "on" || text == "off") grading.dither = text == "on";
        return text == "on" || text == "off" ? Result<void>() : fail(ErrorCode::InvalidArgument, "expected on or off");
    }
    return setColorGrading(grading, name, text);
}

} // namespace filament::view
