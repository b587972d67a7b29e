// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Options.h>

#include "base/Assert.h"
#include "base/NumberText.h"
#include "base/Result.h"
#include "base/Suggest.h"
#include "filament_core/values/OptionRows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core {
namespace {

constexpr size_t kMostComponents = 4;
constexpr double kFewIntegers = 4; // so many are listed one by one

/// The components of a field, which are exact as doubles.
using Numbers = std::array<double, kMostComponents>;

/// Calls visit.operator()<N>() with the type of one stored number.
template <class Visit>
auto withType(Option::Storage storage, Visit const& visit) {
    switch (storage) {
    case Option::Storage::Bool:
    case Option::Storage::Enum8:
    case Option::Storage::Uint8:
        return visit.template operator()<uint8_t>();
    case Option::Storage::Uint16:
        return visit.template operator()<uint16_t>();
    case Option::Storage::Uint32:
        return visit.template operator()<uint32_t>();
    case Option::Storage::Float:
        return visit.template operator()<float>();
    case Option::Storage::Double:
        break;
    }
    return visit.template operator()<double>();
}

Numbers load(Option const& option, void const* object) {
    return withType(option.storage, [&]<class N>() {
        Numbers numbers{};
        for (size_t i = 0; i < option.components; ++i) {
            N number;
            std::memcpy(&number, static_cast<std::byte const*>(object) + option.offset + i * sizeof(N), sizeof(N));
            numbers[i] = static_cast<double>(number);
        }
        return numbers;
    });
}

void store(Option const& option, void* object, Numbers const& numbers) {
    withType(option.storage, [&]<class N>() {
        for (size_t i = 0; i < option.components; ++i) {
            const auto number = static_cast<N>(numbers[i]);
            std::memcpy(static_cast<std::byte*>(object) + option.offset + i * sizeof(N), &number, sizeof(N));
        }
    });
}

/// A limit as the field stores it: 0.0001 rounds down to a float.
double limitOf(Option const& option, double limit) {
    const auto most = static_cast<double>(std::numeric_limits<float>::max());
    return option.storage == Option::Storage::Float && std::abs(limit) <= most
                   ? static_cast<double>(static_cast<float>(limit))
                   : limit;
}

bool isInRange(Option const& option, double number) { // NaN is in none
    return number >= limitOf(option, option.least) && number <= limitOf(option, option.most);
}

std::optional<double> parsedNumber(Option const& option, std::string_view text) {
    std::optional<double> number;
    if (option.storage == Option::Storage::Float) {
        if (const auto given = numberOf<float>(text)) number = static_cast<double>(*given);
    } else {
        number = numberOf<double>(text);
    }
    return number && isInRange(option, *number) ? number : std::nullopt;
}

/// One number for all components, or as many as there are.
std::optional<Numbers> parsedNumbers(Option const& option, std::string_view text) {
    Numbers numbers{};
    if (const auto all = parsedNumber(option, text)) {
        numbers.fill(*all);
        return numbers;
    }
    const size_t last = option.components - size_t{ 1 };
    for (size_t i = 0; i <= last; ++i) {
        const size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i == last)) return std::nullopt;
        const auto number = parsedNumber(option, text.substr(0, comma));
        if (!number) return std::nullopt;
        numbers[i] = *number;
        text.remove_prefix(i == last ? 0 : comma + 1);
    }
    return numbers;
}

std::string integerText(double number) { return fmt::format("{:.0f}", number); }

std::optional<Numbers> parsedInteger(Option const& option, std::string_view text) {
    const auto number = numberOf<uint32_t>(text);
    if (!number || !isInRange(option, *number)) return std::nullopt;
    const bool isListed = std::ranges::find(option.values, integerText(*number)) != option.values.end();
    return option.onlyValues && !isListed ? std::nullopt : std::optional(Numbers{ static_cast<double>(*number) });
}

std::optional<Numbers> parsed(Option const& option, std::string_view text) {
    if (option.kind == OptionKind::Number) return parsedNumbers(option, text);
    if (option.kind == OptionKind::Integer) return parsedInteger(option, text);
    const auto found = std::ranges::find(option.values, text);
    if (found == option.values.end()) return std::nullopt;
    return Numbers{ static_cast<double>(found - option.values.begin()) };
}

/// Without an exponent, as people write it: "0.00001", "1000000".
std::string limitText(double limit) {
    if (std::abs(limit) >= 1 || limit == 0)
        return fmt::format("{:.10g}", limit).find('e') == std::string::npos ? fmt::format("{:.10g}", limit)
                                                                            : integerText(limit);
    std::string text = fmt::format("{:.9f}", limit);
    return text.substr(0, text.find_last_not_of('0') + 1);
}

bool isUnlimited(double limit) { return std::abs(limit) > static_cast<double>(std::numeric_limits<float>::max()) / 2; }

std::string limitsText(Option const& option) {
    const bool hasLeast = !isUnlimited(option.least), hasMost = !isUnlimited(option.most);
    if (hasLeast && hasMost) return fmt::format(" from {} to {}", limitText(option.least), limitText(option.most));
    if (hasLeast) return fmt::format(", at least {}", limitText(option.least));
    return hasMost ? fmt::format(", at most {}", limitText(option.most)) : std::string();
}

std::string integerRange(Option const& option) {
    if (option.onlyValues) return listed(option.values);
    if (option.most - option.least >= kFewIntegers)
        return fmt::format("{}{}", option.unit.empty() ? "a whole number" : option.unit, limitsText(option));
    std::vector<std::string> texts;
    for (double number = option.least; number <= option.most; ++number) texts.push_back(integerText(number));
    return listed(std::vector<std::string_view>(texts.begin(), texts.end()));
}

} // namespace

Option const* findOption(std::span<const Option> options, std::string_view name) {
    const auto found = std::ranges::find(options, name, &Option::name);
    return found == options.end() ? nullptr : &*found;
}

std::string rangeOf(Option const& option) {
    switch (option.kind) {
    case OptionKind::Switch:
    case OptionKind::Choice:
        return listed(option.values);
    case OptionKind::Integer:
        return integerRange(option);
    case OptionKind::Number:
        break;
    }
    if (option.components == 1)
        return fmt::format("{}{}", option.unit.empty() ? "a number" : option.unit, limitsText(option));
    return fmt::format("{}, each{}, or one number for all", option.unit, limitsText(option));
}

Result<void> setOption(std::span<const Option> options, void* object, std::string_view name, std::string_view value) {
    Option const* option = findOption(options, name);
    if (!option) {
        return fail(ErrorCode::NotFound, "there is no option '{}'{}", name, suggestion(name, namesOf(options)));
    }
    const auto numbers = parsed(*option, value);
    if (!numbers) return fail(ErrorCode::InvalidArgument, "option {}: '{}' is not {}", name, value, rangeOf(*option));
    store(*option, object, *numbers);
    return {};
}

std::string optionValue(Option const& option, void const* object) {
    const Numbers numbers = load(option, object);
    if (option.kind == OptionKind::Integer) return integerText(numbers[0]);
    if (option.kind != OptionKind::Number) {
        const auto index = static_cast<size_t>(numbers[0]);
        FILAMENT_ASSERT(index < option.values.size(), "a choice has one of the values of its enumeration");
        return std::string(option.values[index]);
    }
    std::string text;
    for (size_t i = 0; i < option.components; ++i) {
        if (i > 0) text += ',';
        text += option.storage == Option::Storage::Float ? fmt::format("{}", static_cast<float>(numbers[i]))
                                                         : fmt::format("{}", numbers[i]);
    }
    return text;
}

std::span<const std::byte> bytesOf(Option const& option, void const* object) {
    const size_t size = withType(option.storage, []<class N>() { return sizeof(N); });
    return { static_cast<std::byte const*>(object) + option.offset, option.components * size };
}

void clampOptions(std::span<const Option> options, void* object, void const* defaults) {
    for (Option const& option : options) {
        if (option.kind != OptionKind::Number && option.kind != OptionKind::Integer) continue;
        Numbers numbers = load(option, object);
        const Numbers initial = load(option, defaults);
        for (size_t i = 0; i < option.components; ++i)
            numbers[i] = std::isnan(numbers[i])
                                 ? initial[i]
                                 : std::clamp(numbers[i], limitOf(option, option.least), limitOf(option, option.most));
        store(option, object, numbers);
    }
}

} // namespace filament_core
