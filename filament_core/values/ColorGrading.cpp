// SPDX-License-Identifier: Apache-2.0
#include <filament/ColorGrading.h>

#include "base/NumberText.h"
#include "base/Result.h"
#include "base/Suggest.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament {
namespace {

// In the order of the enumerators.
constexpr std::array<std::string_view, 9> kToneMappers{ "linear",     "aces",          "filmic",  "mobile",      "agx",
                                                        "pbrNeutral", "acesReference", "generic", "displayRange" };
constexpr std::array<std::string_view, 3> kAgxLooks{ "base", "golden", "punchy" };
constexpr std::array<std::string_view, 4> kOutputSpaces{ "srgb", "linearRec709", "displayP3", "rec2020Pq" };

template <class E, size_t N>
std::optional<E> valueOf(std::array<std::string_view, N> const& words, std::string_view name) {
    const auto found = std::ranges::find(words, name);
    return found == words.end() ? std::nullopt : std::optional(static_cast<E>(found - words.begin()));
}

/// How one field is read and written.
struct Field {
    ColorGradingOption option;
    bool (*set)(Field const& field, ColorGrading& grading, std::string_view value); ///< false: not a value of its range
    std::string (*get)(ColorGrading const& grading);
    float* (*number)(ColorGrading& grading) = nullptr; ///< to keep in range; null: a word
    float least = 0, most = 0;
};

template <auto Number>
constexpr Field numberField(std::string_view name, float least, float most, std::string_view range) {
    return { { name, range },
             [](Field const& field, ColorGrading& grading, std::string_view value) {
                 const std::optional<float> number = numberOf(value, field.least, field.most);
                 if (number) *Number(grading) = *number;
                 return number.has_value();
             },
             [](ColorGrading const& grading) {
                 ColorGrading copy = grading;
                 return fmt::format("{}", *Number(copy));
             },
             Number,
             least,
             most };
}

template <auto Member, auto FromName>
constexpr Field wordField(std::string_view name, std::string_view range) {
    return { { name, range },
             [](Field const&, ColorGrading& grading, std::string_view value) {
                 const auto found = FromName(value);
                 if (found) grading.*Member = *found;
                 return found.has_value();
             },
             [](ColorGrading const& grading) { return std::string(toString(grading.*Member)); } };
}

constexpr auto kContrast = [](ColorGrading& grading) { return &grading.toneCurve.contrast; };
constexpr auto kMidGreyIn = [](ColorGrading& grading) { return &grading.toneCurve.midGreyIn; };
constexpr auto kMidGreyOut = [](ColorGrading& grading) { return &grading.toneCurve.midGreyOut; };
constexpr auto kMaximum = [](ColorGrading& grading) { return &grading.toneCurve.maximum; };
constexpr auto kWhiteNits = [](ColorGrading& grading) { return &grading.whiteNits; };

constexpr std::array kFields{
    wordField<&ColorGrading::agxLook, agxLookFromName>("agxLook", "base, golden or punchy"),
    numberField<kContrast>("toneCurve.contrast", 0.1f, 5.0f, "a number from 0.1 to 5"),
    numberField<kMidGreyIn>("toneCurve.midGreyIn", 0.001f, 1.0f, "a number from 0.001 to 1"),
    numberField<kMidGreyOut>("toneCurve.midGreyOut", 0.001f, 0.99f, "a number from 0.001 to 0.99"),
    numberField<kMaximum>("toneCurve.maximum", 1.0f, 256.0f, "a number from 1 to 256"),
    wordField<&ColorGrading::outputSpace, outputSpaceFromName>("outputSpace",
                                                               "srgb, linearRec709, displayP3 or rec2020Pq"),
    numberField<kWhiteNits>("whiteNits", 80.0f, 10'000.0f, "cd/m^2 from 80 to 10000"),
};

Field const* findField(std::string_view name) {
    const auto found = std::ranges::find(kFields, name, [](Field const& field) { return field.option.name; });
    return found == kFields.end() ? nullptr : &*found;
}

} // namespace

const char* toString(ToneMapper toneMapper) { return kToneMappers[static_cast<size_t>(toneMapper)].data(); }
const char* toString(AgxLook look) { return kAgxLooks[static_cast<size_t>(look)].data(); }
const char* toString(OutputSpace space) { return kOutputSpaces[static_cast<size_t>(space)].data(); }

std::optional<ToneMapper> toneMapperFromName(std::string_view name) { return valueOf<ToneMapper>(kToneMappers, name); }
std::optional<AgxLook> agxLookFromName(std::string_view name) { return valueOf<AgxLook>(kAgxLooks, name); }
std::optional<OutputSpace> outputSpaceFromName(std::string_view name) {
    return valueOf<OutputSpace>(kOutputSpaces, name);
}

std::span<const ColorGradingOption> colorGradingOptions() {
    static const std::array kOptions = [] {
        std::array<ColorGradingOption, kFields.size()> options;
        std::ranges::transform(kFields, options.begin(), &Field::option);
        return options;
    }();
    return kOptions;
}

Result<void> setColorGrading(ColorGrading& grading, std::string_view name, std::string_view value) {
    Field const* field = findField(name);
    if (!field) {
        std::array<std::string_view, kFields.size()> known;
        std::ranges::transform(kFields, known.begin(), [](Field const& each) { return each.option.name; });
        return fail(ErrorCode::NotFound, "colour grading has no '{}'{}", name, suggestion(name, known));
    }
    if (!field->set(*field, grading, value))
        return fail(ErrorCode::InvalidArgument, "colour grading {}: '{}' is not {}", name, value, field->option.range);
    return {};
}

std::optional<std::string> colorGradingValue(ColorGrading const& grading, std::string_view name) {
    Field const* field = findField(name);
    return field ? std::optional(field->get(grading)) : std::nullopt;
}

ColorGrading clamped(ColorGrading const& grading) {
    ColorGrading result = grading;
    ColorGrading initial;
    for (Field const& field : kFields) {
        if (!field.number) continue;
        float& number = *field.number(result);
        number = std::isnan(number) ? *field.number(initial) : std::clamp(number, field.least, field.most);
    }
    return result;
}

} // namespace filament
