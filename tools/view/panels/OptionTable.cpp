// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/OptionTable.h"

#include "base/NumberText.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace filament::view {
namespace {

Result<void> refused(std::string_view name, std::string_view value, std::string_view range) {
    return fail(ErrorCode::InvalidArgument, "{}: '{}' is not {}", name, value, range);
}

/// What View has beside the tables of Quality, Effects and ColorGrading.
struct PictureOption {
    std::string_view name, range;
    std::string (*get)(View const& view);
    bool (*set)(View& view, std::string_view value); ///< false: no such value
};

template <class T>
bool assign(T& member, std::optional<T> value) {
    if (value) member = *value;
    return value.has_value();
}

const std::array kPictureOptions{
    PictureOption{ "toneMapper", toneMapperNames(),
                   [](View const& view) { return std::string(toString(view.colorGrading.toneMapper)); },
                   [](View& view, std::string_view value) {
                       return assign(view.colorGrading.toneMapper, toneMapperFromName(value));
                   } },
    PictureOption{ "dither", "off or on",
                   [](View const& view) { return std::string(view.colorGrading.dither ? "on" : "off"); },
                   [](View& view, std::string_view value) {
                       return assign(view.colorGrading.dither, value == "on"    ? std::optional(true)
                                                               : value == "off" ? std::optional(false)
                                                                                : std::nullopt);
                   } },
    PictureOption{ "samples", "1 or 4", [](View const& view) { return std::to_string(view.samples); },
                   [](View& view, std::string_view value) {
                       return assign(view.samples, value == "1"   ? std::optional<uint8_t>(1)
                                                   : value == "4" ? std::optional<uint8_t>(4)
                                                                  : std::nullopt);
                   } },
    PictureOption{
            "debugView", debugViewNames(), [](View const& view) { return std::string(toString(view.debugView)); },
            [](View& view, std::string_view value) { return assign(view.debugView, debugViewFromName(value)); } },
};

PictureOption const* findPictureOption(std::string_view name) {
    const auto found = std::ranges::find(kPictureOptions, name, &PictureOption::name);
    return found == kPictureOptions.end() ? nullptr : &*found;
}

/// "a, b or c" as its words; empty if one of them has a space.
std::vector<std::string> wordsOf(std::string_view range) {
    std::vector<std::string> words;
    while (!range.empty()) {
        const size_t comma = range.find(", "), either = range.find(" or ");
        const size_t end = std::min({ comma, either, range.size() });
        words.emplace_back(range.substr(0, end));
        if (words.back().empty() || words.back().find(' ') != std::string::npos) return {};
        range.remove_prefix(end == range.size() ? end : end == comma ? end + 2 : end + 4);
    }
    return words;
}

/// The two numbers of "... from A to B ...".
std::optional<std::pair<double, double>> limitsOf(std::string_view range) {
    constexpr std::string_view kFrom = "from ", kTo = " to ";
    const size_t from = range.find(kFrom);
    if (from == std::string_view::npos) return std::nullopt;
    range.remove_prefix(from + kFrom.size());
    const size_t to = range.find(kTo);
    if (to == std::string_view::npos) return std::nullopt;
    const std::string_view rest = range.substr(to + kTo.size());
    const auto least = numberOf<double>(range.substr(0, to));
    const auto most = numberOf<double>(rest.substr(0, rest.find_first_of(" ,")));
    if (!least || !most || !(*least <= *most)) return std::nullopt;
    return std::pair(*least, *most);
}

/// What setQuality() says of a value that cannot be valid: its range, which qualityChoices() leaves out.
std::string qualityRange(std::string_view name) {
    constexpr std::string_view kIsNot = "is not ";
    Quality quality;
    const Result<void> done = setQuality(quality, name, "?");
    if (done) return {};
    const size_t begin = done.error().message.find(kIsNot);
    return begin == std::string::npos ? std::string() : done.error().message.substr(begin + kIsNot.size());
}

Option makeOption(OptionGroup group, std::string_view name, std::string_view range) {
    Option named{ .group = group, .name = std::string(name) };
    const std::string standard = optionValue({}, named);
    Option option = optionFromRange(range, standard);
    option.group = group;
    option.name = name;
    return option;
}

} // namespace

const char* toString(OptionGroup group) {
    constexpr std::array kNames{ "picture", "quality", "effects", "grading" };
    return kNames[static_cast<size_t>(group)];
}

Option optionFromRange(std::string_view range, std::string_view standard) {
    Option option{ .range = std::string(range), .standard = std::string(standard) };
    if (const auto limits = limitsOf(range)) {
        option.kind = OptionKind::Number;
        option.least = limits->first;
        option.most = limits->second;
        option.components = 1 + static_cast<uint32_t>(std::ranges::count(standard, ','));
        option.isWhole = range.find("whole") != std::string_view::npos;
        return option;
    }
    option.words = wordsOf(range);
    if (option.words.size() < 2) option.words.clear();
    const bool isSwitch = option.words == std::vector<std::string>{ "off", "on" };
    option.kind = isSwitch ? OptionKind::Switch : option.words.empty() ? OptionKind::Text : OptionKind::Choice;
    return option;
}

std::vector<Option> makeOptions() {
    std::vector<Option> options;
    for (PictureOption const& option : kPictureOptions)
        options.push_back(makeOption(OptionGroup::Picture, option.name, option.range));
    for (QualityChoice const& choice : qualityChoices()) {
        options.push_back(makeOption(OptionGroup::Quality, choice.name, qualityRange(choice.name)));
        if (options.back().kind == OptionKind::Number)
            options.back().words.assign(choice.values.begin(), choice.values.end());
    }
    for (EffectOption const& option : effectOptions())
        options.push_back(makeOption(OptionGroup::Effects, option.name, option.range));
    for (ColorGradingOption const& option : colorGradingOptions())
        options.push_back(makeOption(OptionGroup::Grading, option.name, option.range));
    return options;
}

std::string optionValue(View const& view, Option const& option) {
    switch (option.group) {
    case OptionGroup::Picture:
        return findPictureOption(option.name) ? findPictureOption(option.name)->get(view) : std::string();
    case OptionGroup::Quality:
        return qualityValue(view.quality, option.name).value_or("");
    case OptionGroup::Effects:
        return effectValue(view.effects, option.name).value_or("");
    case OptionGroup::Grading:
        return colorGradingValue(view.colorGrading, option.name).value_or("");
    }
    return {};
}

Result<void> setOption(View& view, Option const& option, std::string_view value) {
    switch (option.group) {
    case OptionGroup::Picture:
        break;
    case OptionGroup::Quality:
        return setQuality(view.quality, option.name, value);
    case OptionGroup::Effects:
        return setEffect(view.effects, option.name, value);
    case OptionGroup::Grading:
        return setColorGrading(view.colorGrading, option.name, value);
    }
    PictureOption const* picture = findPictureOption(option.name);
    if (!picture) return fail(ErrorCode::NotFound, "a view has no option '{}'", option.name);
    return picture->set(view, value) ? Result<void>() : refused(option.name, value, picture->range);
}

std::vector<float> optionNumbers(Option const& option, std::string_view value) {
    std::vector<float> numbers;
    while (!value.empty()) {
        const size_t end = std::min(value.find(','), value.size());
        const auto number = numberOf<double>(value.substr(0, end));
        if (!number) return {};
        numbers.push_back(static_cast<float>(*number));
        value.remove_prefix(std::min(end + 1, value.size()));
    }
    if (numbers.size() != option.components) numbers.clear();
    return numbers;
}

std::string optionText(Option const& option, std::span<const float> numbers) {
    std::string text;
    for (const float number : numbers) {
        if (!text.empty()) text += ',';
        text += option.isWhole ? fmt::format("{:.0f}", std::round(number)) : fmt::format("{}", number);
    }
    return text;
}

} // namespace filament::view
