// SPDX-License-Identifier: Apache-2.0
#include <filament/Effects.h>

#include "base/Result.h"
#include "base/Suggest.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace filament {
namespace {

/// How one field is read, written and kept in range.
struct EffectField {
    EffectOption option;
    bool (*set)(Effects& effects, std::string_view value); ///< false: not a value of its range
    std::string (*get)(Effects const& effects);
    void (*clamp)(Effects& effects);
};

std::optional<float> numberOf(std::string_view text, float least, float most) {
    float number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool isNumber = error == std::errc{} && end == text.data() + text.size();
    if (!isNumber || !(number >= least && number <= most)) return std::nullopt;
    return number;
}

template <auto Group, auto Member, float Least, float Most>
constexpr EffectField numberField(std::string_view name, std::string_view range) {
    return { { name, range },
             [](Effects& effects, std::string_view value) {
                 const std::optional<float> number = numberOf(value, Least, Most);
                 if (number) effects.*Group.*Member = *number;
                 return number.has_value();
             },
             [](Effects const& effects) { return fmt::format("{}", effects.*Group.*Member); },
             [](Effects& effects) {
                 float& number = effects.*Group.*Member;
                 number = std::isnan(number) ? Effects{}.*Group.*Member : std::clamp(number, Least, Most);
             } };
}

template <auto Group, auto Member>
constexpr EffectField switchField(std::string_view name) {
    return { { name, "off or on" },
             [](Effects& effects, std::string_view value) {
                 if (value != "on" && value != "off") return false;
                 effects.*Group.*Member = value == "on";
                 return true;
             },
             [](Effects const& effects) { return std::string(effects.*Group.*Member ? "on" : "off"); },
             [](Effects&) {} };
}

std::optional<LinearColor> colorOf(std::string_view text, float most) {
    LinearColor color{ 0 };
    for (int i = 0; i < 3; ++i) {
        const size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i == 2)) return std::nullopt;
        const std::optional<float> number = numberOf(text.substr(0, comma), 0, most);
        if (!number) return std::nullopt;
        color[i] = *number;
        text.remove_prefix(i == 2 ? 0 : comma + 1);
    }
    return color;
}

template <auto Group, auto Member, float Most>
constexpr EffectField colorField(std::string_view name, std::string_view range) {
    return { { name, range },
             [](Effects& effects, std::string_view value) {
                 const std::optional<LinearColor> color = colorOf(value, Most);
                 if (color) effects.*Group.*Member = *color;
                 return color.has_value();
             },
             [](Effects const& effects) {
                 LinearColor const& color = effects.*Group.*Member;
                 return fmt::format("{},{},{}", color.x, color.y, color.z);
             },
             [](Effects& effects) {
                 LinearColor& color = effects.*Group.*Member;
                 const LinearColor initial = Effects{}.*Group.*Member;
                 for (int i = 0; i < 3; ++i)
                     color[i] = std::isnan(color[i]) ? initial[i] : std::clamp(color[i], 0.0f, Most);
             } };
}

constexpr auto kAo = &Effects::ambientOcclusion;
constexpr auto kSsr = &Effects::reflections;
constexpr auto kFog = &Effects::fog;
constexpr auto kContact = &Effects::contactShadows;

constexpr std::array kEffectFields{
    numberField<kAo, &AmbientOcclusion::radiusMeters, 1e-4f, 1e4f>("ao.radiusMeters", "metres from 0.0001 to 10000"),
    numberField<kAo, &AmbientOcclusion::intensity, 0.0f, 8.0f>("ao.intensity", "a number from 0 to 8"),
    numberField<kSsr, &ScreenReflections::distanceMeters, 1e-3f, 1e5f>("ssr.distanceMeters",
                                                                       "metres from 0.001 to 100000"),
    numberField<kSsr, &ScreenReflections::thicknessMeters, 1e-4f, 1e4f>("ssr.thicknessMeters",
                                                                        "metres from 0.0001 to 10000"),
    switchField<kFog, &Fog::enabled>("fog"),
    numberField<kFog, &Fog::density, 0.0f, 1e4f>("fog.density", "1/m from 0 to 10000"),
    numberField<kFog, &Fog::startMeters, 0.0f, 1e6f>("fog.startMeters", "metres from 0 to 1000000"),
    numberField<kFog, &Fog::cutOffMeters, 0.0f, 1e9f>("fog.cutOffMeters", "metres from 0 to 1000000000"),
    numberField<kFog, &Fog::heightMeters, -1e6f, 1e6f>("fog.heightMeters", "metres from -1000000 to 1000000"),
    numberField<kFog, &Fog::heightFalloff, 0.0f, 1e3f>("fog.heightFalloff", "1/m from 0 to 1000"),
    numberField<kFog, &Fog::maximumOpacity, 0.0f, 1.0f>("fog.maximumOpacity", "a number from 0 to 1"),
    colorField<kFog, &Fog::color, 1e3f>("fog.color", "R,G,B, each from 0 to 1000"),
    switchField<kFog, &Fog::colorFromEnvironment>("fog.colorFromEnvironment"),
    numberField<kFog, &Fog::inScatteringStartMeters, 0.0f, 1e6f>("fog.inScatteringStartMeters",
                                                                 "metres from 0 to 1000000"),
    numberField<kFog, &Fog::inScatteringSize, 0.0f, 1e3f>("fog.inScatteringSize", "a number from 0 to 1000"),
    numberField<kContact, &ContactShadows::distanceMeters, 1e-4f, 1e4f>("contactShadows.distanceMeters",
                                                                        "metres from 0.0001 to 10000"),
    numberField<kContact, &ContactShadows::thicknessMeters, 1e-5f, 1e4f>("contactShadows.thicknessMeters",
                                                                         "metres from 0.00001 to 10000"),
};

EffectField const* findEffect(std::string_view name) {
    const auto found = std::ranges::find(kEffectFields, name, [](EffectField const& f) { return f.option.name; });
    return found == kEffectFields.end() ? nullptr : &*found;
}

} // namespace

std::span<const EffectOption> effectOptions() {
    static const std::array kOptions = [] {
        std::array<EffectOption, kEffectFields.size()> options;
        std::ranges::transform(kEffectFields, options.begin(), &EffectField::option);
        return options;
    }();
    return kOptions;
}

Result<void> setEffect(Effects& effects, std::string_view name, std::string_view value) {
    EffectField const* field = findEffect(name);
    if (!field) {
        return fail(ErrorCode::NotFound, "there is no effect option '{}'{}", name,
                    suggestion(name, namesOf(effectOptions())));
    }
    if (field->set(effects, value)) return {};
    return fail(ErrorCode::InvalidArgument, "effect option {}: '{}' is not {}", name, value, field->option.range);
}

std::optional<std::string> effectValue(Effects const& effects, std::string_view name) {
    EffectField const* field = findEffect(name);
    return field ? std::optional(field->get(effects)) : std::nullopt;
}

Effects clamped(Effects const& effects) {
    Effects result = effects;
    for (EffectField const& field : kEffectFields) field.clamp(result);
    return result;
}

} // namespace filament
