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
    bool (*set)(EffectField const& field, Effects& effects,
                std::string_view value); ///< false: not a value of its range
    std::string (*get)(Effects const& effects);
    void (*clamp)(EffectField const& field, Effects& effects);
    float least = 0, most = 0; ///< of numbers and components
};

std::optional<float> numberOf(std::string_view text, float least, float most) {
    float number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool isNumber = error == std::errc{} && end == text.data() + text.size();
    if (!isNumber || !(number >= least && number <= most)) return std::nullopt;
    return number;
}

template <auto Group, auto Member>
constexpr EffectField numberField(std::string_view name, float least, float most, std::string_view range) {
    return { { name, range },
             [](EffectField const& field, Effects& effects, std::string_view value) {
                 const std::optional<float> number = numberOf(value, field.least, field.most);
                 if (number) effects.*Group.*Member = *number;
                 return number.has_value();
             },
             [](Effects const& effects) { return fmt::format("{}", effects.*Group.*Member); },
             [](EffectField const& field, Effects& effects) {
                 float& number = effects.*Group.*Member;
                 number = std::isnan(number) ? Effects{}.*Group.*Member : std::clamp(number, field.least, field.most);
             },
             least,
             most };
}

template <auto Group, auto Member>
constexpr EffectField switchField(std::string_view name) {
    return { { name, "off or on" },
             [](EffectField const&, Effects& effects, std::string_view value) {
                 if (value != "on" && value != "off") return false;
                 effects.*Group.*Member = value == "on";
                 return true;
             },
             [](Effects const& effects) { return std::string(effects.*Group.*Member ? "on" : "off"); },
             [](EffectField const&, Effects&) {} };
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

template <auto Group, auto Member>
constexpr EffectField colorField(std::string_view name, float most, std::string_view range) {
    return { { name, range },
             [](EffectField const& field, Effects& effects, std::string_view value) {
                 const std::optional<LinearColor> color = colorOf(value, field.most);
                 if (color) effects.*Group.*Member = *color;
                 return color.has_value();
             },
             [](Effects const& effects) {
                 LinearColor const& color = effects.*Group.*Member;
                 return fmt::format("{},{},{}", color.x, color.y, color.z);
             },
             [](EffectField const& field, Effects& effects) {
                 LinearColor& color = effects.*Group.*Member;
                 const LinearColor initial = Effects{}.*Group.*Member;
                 for (int i = 0; i < 3; ++i)
                     color[i] = std::isnan(color[i]) ? initial[i] : std::clamp(color[i], field.least, field.most);
             },
             0,
             most };
}

constexpr auto kAo = &Effects::ambientOcclusion;
constexpr auto kSsr = &Effects::reflections;
constexpr auto kFog = &Effects::fog;
constexpr auto kContact = &Effects::contactShadows;
constexpr auto kBloom = &Effects::bloom;

constexpr std::array kEffectFields{
    numberField<kAo, &AmbientOcclusion::radiusMeters>("ao.radiusMeters", 1e-4f, 1e4f, "metres from 0.0001 to 10000"),
    numberField<kAo, &AmbientOcclusion::intensity>("ao.intensity", 0.0f, 8.0f, "a number from 0 to 8"),
    numberField<kSsr, &ScreenReflections::distanceMeters>("ssr.distanceMeters", 1e-3f, 1e5f,
                                                          "metres from 0.001 to 100000"),
    numberField<kSsr, &ScreenReflections::thicknessMeters>("ssr.thicknessMeters", 1e-4f, 1e4f,
                                                           "metres from 0.0001 to 10000"),
    switchField<kFog, &Fog::enabled>("fog"),
    numberField<kFog, &Fog::density>("fog.density", 0.0f, 1e4f, "1/m from 0 to 10000"),
    numberField<kFog, &Fog::startMeters>("fog.startMeters", 0.0f, 1e6f, "metres from 0 to 1000000"),
    numberField<kFog, &Fog::cutOffMeters>("fog.cutOffMeters", 0.0f, 1e9f, "metres from 0 to 1000000000"),
    numberField<kFog, &Fog::heightMeters>("fog.heightMeters", -1e6f, 1e6f, "metres from -1000000 to 1000000"),
    numberField<kFog, &Fog::heightFalloff>("fog.heightFalloff", 0.0f, 1e3f, "1/m from 0 to 1000"),
    numberField<kFog, &Fog::maximumOpacity>("fog.maximumOpacity", 0.0f, 1.0f, "a number from 0 to 1"),
    colorField<kFog, &Fog::color>("fog.color", 1e3f, "R,G,B, each from 0 to 1000"),
    switchField<kFog, &Fog::colorFromEnvironment>("fog.colorFromEnvironment"),
    numberField<kFog, &Fog::inScatteringStartMeters>("fog.inScatteringStartMeters", 0.0f, 1e6f,
                                                     "metres from 0 to 1000000"),
    numberField<kFog, &Fog::inScatteringSize>("fog.inScatteringSize", 0.0f, 1e3f, "a number from 0 to 1000"),
    numberField<kContact, &ContactShadows::distanceMeters>("contactShadows.distanceMeters", 1e-4f, 1e4f,
                                                           "metres from 0.0001 to 10000"),
    numberField<kContact, &ContactShadows::thicknessMeters>("contactShadows.thicknessMeters", 1e-5f, 1e4f,
                                                            "metres from 0.00001 to 10000"),
    switchField<kBloom, &Bloom::enabled>("bloom"),
    numberField<kBloom, &Bloom::strength>("bloom.strength", 0.0f, 1.0f, "a number from 0 to 1"),
    numberField<kBloom, &Bloom::radius>("bloom.radius", 1e-3f, 1.0f, "a number from 0.001 to 1"),
    numberField<kBloom, &Bloom::threshold>("bloom.threshold", 0.0f, 1e4f, "a number from 0 to 10000"),
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
    if (field->set(*field, effects, value)) return {};
    return fail(ErrorCode::InvalidArgument, "effect option {}: '{}' is not {}", name, value, field->option.range);
}

std::optional<std::string> effectValue(Effects const& effects, std::string_view name) {
    EffectField const* field = findEffect(name);
    return field ? std::optional(field->get(effects)) : std::nullopt;
}

Effects clamped(Effects const& effects) {
    Effects result = effects;
    for (EffectField const& field : kEffectFields) field.clamp(field, result);
    return result;
}

} // namespace filament
