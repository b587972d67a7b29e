// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/OptionTable.h"

#include "base/NumberText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

template <class T>
bool isOptionOf(Option const& option) {
    return findOption(optionsOf<T>(), option.name) != nullptr;
}

} // namespace

std::vector<OptionGroup> makeOptionGroups() {
    std::vector<OptionGroup> groups{ { "image", {} }, { "quality", {} }, { "effects", {} }, { "color grading", {} } };
    for (Option const& option : optionsOf<View>()) {
        const size_t group = isOptionOf<Quality>(option)            ? 1
                             : isOptionOf<Effects>(option)          ? 2
                             : isOptionOf<DisplayTransform>(option) ? 3
                                                                    : 0;
        groups[group].options.push_back(&option);
    }
    return groups;
}

bool isRated(Option const& option) { return isOptionOf<Quality>(option); }

std::string defaultValue(Option const& option) {
    static const View kView;
    return optionValue(option, &kView);
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
        text += option.kind == OptionKind::Integer ? fmt::format("{:.0f}", std::round(number))
                                                   : fmt::format("{}", number);
    }
    return text;
}

} // namespace filament_core::view
