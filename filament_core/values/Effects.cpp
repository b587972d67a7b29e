// SPDX-License-Identifier: Apache-2.0
#include <filament/Effects.h>

#include "base/NumberText.h"
#include "base/Result.h"
#include "base/Suggest.h"

#include <algorithm>
#include <array>
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

/// Numbers with commas between them.
template <class Vector>
std::optional<Vector> vectorOf(std::string_view text, float least, float most) {
    constexpr int kLast = Vector::length() - 1;
    Vector vector{ 0 };
    for (int i = 0; i <= kLast; ++i) {
        const size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i == kLast)) return std::nullopt;
        const std::optional<float> number = numberOf(text.substr(0, comma), least, most);
        if (!number) return std::nullopt;
        vector[i] = *number;
        text.remove_prefix(i == kLast ? 0 : comma + 1);
    }
    return vector;
}

template <auto Group, auto Member>
constexpr EffectField vectorField(std::string_view name, float least, float most, std::string_view range) {
    using Vector = std::remove_cvref_t<decltype(Effects{}.*Group.*Member)>;
    return { { name, range },
             [](EffectField const& field, Effects& effects, std::string_view value) {
                 const std::optional<Vector> vector = vectorOf<Vector>(value, field.least, field.most);
                 if (vector) effects.*Group.*Member = *vector;
                 return vector.has_value();
             },
             [](Effects const& effects) {
                 std::string text;
                 for (int i = 0; i < Vector::length(); ++i)
                     text += fmt::format("{}{}", i > 0 ? "," : "", (effects.*Group.*Member)[i]);
                 return text;
             },
             [](EffectField const& field, Effects& effects) {
                 Vector& vector = effects.*Group.*Member;
                 const Vector initial = Effects{}.*Group.*Member;
                 for (int i = 0; i < Vector::length(); ++i)
                     vector[i] = std::isnan(vector[i]) ? initial[i] : std::clamp(vector[i], field.least, field.most);
             },
             least,
             most };
}

/// The same number for all components, or numbers with commas between them.
template <auto Group, auto Member>
constexpr EffectField scaleField(std::string_view name, float least, float most, std::string_view range) {
    EffectField field = vectorField<Group, Member>(name, least, most, range);
    field.set = [](EffectField const& of, Effects& effects, std::string_view value) {
        using Vector = std::remove_cvref_t<decltype(effects.*Group.*Member)>;
        const std::optional<float> all = numberOf(value, of.least, of.most);
        const std::optional<Vector> vector = all ? Vector(*all) : vectorOf<Vector>(value, of.least, of.most);
        if (vector) effects.*Group.*Member = *vector;
        return vector.has_value();
    };
    return field;
}

constexpr auto kAo = &Effects::ambientOcclusion;
constexpr auto kSsr = &Effects::reflections;
constexpr auto kFog = &Effects::fog;
constexpr auto kContact = &Effects::contactShadows;
constexpr auto kBloom = &Effects::bloom;
constexpr auto kFocus = &Effects::depthOfField;
constexpr auto kMotionBlur = &Effects::motionBlur;
constexpr auto kExposure = &Effects::autoExposure;
constexpr auto kGrading = &Effects::grading;
constexpr auto kVignette = &Effects::vignette;
constexpr auto kGrain = &Effects::grain;
constexpr auto kAberration = &Effects::chromaticAberration;
constexpr auto kResolution = &Effects::resolution;
constexpr auto kSharpening = &Effects::sharpening;
constexpr auto kFlare = &Effects::lensFlare;
constexpr auto kGuardBand = &Effects::guardBand;

constexpr std::string_view kFactors = "R,G,B, each from 0 to 4", kShares = "R,G,B, each from -2 to 2",
                           kGammas = "R,G,B, each from 0.1 to 10", kStops = "stops from -16 to 16",
                           kShare = "a number from 0 to 1", kSpeed = "stops a second from 0 to 1000";

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
    vectorField<kFog, &Fog::color>("fog.color", 0.0f, 1e3f, "R,G,B, each from 0 to 1000"),
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
    numberField<kBloom, &Bloom::dirtStrength>("bloom.dirtStrength", 0.0f, 1.0f, kShare),
    switchField<kFlare, &LensFlare::enabled>("lensFlare"),
    numberField<kFlare, &LensFlare::threshold>("lensFlare.threshold", 0.0f, 1e4f, "a number from 0 to 10000"),
    numberField<kFlare, &LensFlare::ghostStrength>("lensFlare.ghostStrength", 0.0f, 1.0f, kShare),
    numberField<kFlare, &LensFlare::ghostCount>("lensFlare.ghostCount", 0.0f, 8.0f, "a number from 0 to 8"),
    numberField<kFlare, &LensFlare::ghostSpacing>("lensFlare.ghostSpacing", 0.05f, 2.0f, "a number from 0.05 to 2"),
    numberField<kFlare, &LensFlare::ghostRadius>("lensFlare.ghostRadius", 0.005f, 0.25f, "a number from 0.005 to 0.25"),
    numberField<kFlare, &LensFlare::haloStrength>("lensFlare.haloStrength", 0.0f, 1.0f, kShare),
    numberField<kFlare, &LensFlare::haloRadius>("lensFlare.haloRadius", 0.05f, 1.0f, "a number from 0.05 to 1"),
    numberField<kFlare, &LensFlare::haloThickness>("lensFlare.haloThickness", 0.0f, 1.0f, kShare),
    numberField<kFlare, &LensFlare::dispersion>("lensFlare.dispersion", 0.0f, 1.0f, kShare),
    switchField<kFocus, &DepthOfField::enabled>("depthOfField"),
    numberField<kFocus, &DepthOfField::focusMeters>("depthOfField.focusMeters", 0.0f, 1e9f,
                                                    "metres from 0 to 1000000000"),
    numberField<kFocus, &DepthOfField::blurScale>("depthOfField.blurScale", 0.0f, 100.0f, "a number from 0 to 100"),
    numberField<kFocus, &DepthOfField::maxRadius>("depthOfField.maxRadius", 0.0f, 0.1f, "a number from 0 to 0.1"),
    numberField<kFocus, &DepthOfField::blades>("depthOfField.blades", 0.0f, 16.0f, "a number from 0 to 16"),
    switchField<kMotionBlur, &MotionBlur::enabled>("motionBlur"),
    numberField<kMotionBlur, &MotionBlur::shutterDegrees>("motionBlur.shutterDegrees", 0.0f, 360.0f,
                                                          "degrees from 0 to 360"),
    numberField<kMotionBlur, &MotionBlur::maxRadius>("motionBlur.maxRadius", 0.0f, 0.1f, "a number from 0 to 0.1"),
    switchField<kExposure, &AutoExposure::enabled>("autoExposure"),
    numberField<kExposure, &AutoExposure::lowPercentile>("autoExposure.lowPercentile", 0.0f, 1.0f, kShare),
    numberField<kExposure, &AutoExposure::highPercentile>("autoExposure.highPercentile", 0.0f, 1.0f, kShare),
    numberField<kExposure, &AutoExposure::compensation>("autoExposure.compensation", -16.0f, 16.0f, kStops),
    numberField<kExposure, &AutoExposure::minStops>("autoExposure.minStops", -16.0f, 16.0f, kStops),
    numberField<kExposure, &AutoExposure::maxStops>("autoExposure.maxStops", -16.0f, 16.0f, kStops),
    numberField<kExposure, &AutoExposure::speedUp>("autoExposure.speedUp", 0.0f, 1e3f, kSpeed),
    numberField<kExposure, &AutoExposure::speedDown>("autoExposure.speedDown", 0.0f, 1e3f, kSpeed),
    switchField<kGrading, &Grading::enabled>("grading"),
    numberField<kGrading, &Grading::nightAdaptation>("grading.nightAdaptation", 0.0f, 1.0f, kShare),
    numberField<kGrading, &Grading::exposure>("grading.exposure", -16.0f, 16.0f, kStops),
    numberField<kGrading, &Grading::temperature>("grading.temperature", -1.0f, 1.0f, "a number from -1 to 1"),
    numberField<kGrading, &Grading::tint>("grading.tint", -1.0f, 1.0f, "a number from -1 to 1"),
    vectorField<kGrading, &Grading::mixRed>("grading.mixRed", -2.0f, 2.0f, kShares),
    vectorField<kGrading, &Grading::mixGreen>("grading.mixGreen", -2.0f, 2.0f, kShares),
    vectorField<kGrading, &Grading::mixBlue>("grading.mixBlue", -2.0f, 2.0f, kShares),
    vectorField<kGrading, &Grading::shadows>("grading.shadows", 0.0f, 4.0f, kFactors),
    vectorField<kGrading, &Grading::midtones>("grading.midtones", 0.0f, 4.0f, kFactors),
    vectorField<kGrading, &Grading::highlights>("grading.highlights", 0.0f, 4.0f, kFactors),
    vectorField<kGrading, &Grading::tonalRanges>("grading.tonalRanges", 0.0f, 100.0f, "A,B,C,D, each from 0 to 100"),
    vectorField<kGrading, &Grading::slope>("grading.slope", 0.0f, 4.0f, kFactors),
    vectorField<kGrading, &Grading::offset>("grading.offset", -1.0f, 1.0f, "R,G,B, each from -1 to 1"),
    vectorField<kGrading, &Grading::power>("grading.power", 0.1f, 10.0f, kGammas),
    numberField<kGrading, &Grading::contrast>("grading.contrast", 0.0f, 2.0f, "a number from 0 to 2"),
    numberField<kGrading, &Grading::saturation>("grading.saturation", 0.0f, 3.0f, "a number from 0 to 3"),
    numberField<kGrading, &Grading::vibrance>("grading.vibrance", 0.0f, 3.0f, "a number from 0 to 3"),
    vectorField<kGrading, &Grading::shadowGamma>("grading.shadowGamma", 0.1f, 10.0f, kGammas),
    vectorField<kGrading, &Grading::midPoint>("grading.midPoint", 1e-3f, 100.0f, "R,G,B, each from 0.001 to 100"),
    vectorField<kGrading, &Grading::highlightScale>("grading.highlightScale", 0.0f, 10.0f, "R,G,B, each from 0 to 10"),
    switchField<kGrading, &Grading::gamutMapping>("grading.gamutMapping"),
    switchField<kVignette, &Vignette::enabled>("vignette"),
    numberField<kVignette, &Vignette::midPoint>("vignette.midPoint", 0.0f, 1.0f, "a number from 0 to 1"),
    numberField<kVignette, &Vignette::roundness>("vignette.roundness", 0.0f, 1.0f, "a number from 0 to 1"),
    numberField<kVignette, &Vignette::feather>("vignette.feather", 0.05f, 1.0f, "a number from 0.05 to 1"),
    vectorField<kVignette, &Vignette::color>("vignette.color", 0.0f, 1.0f, "R,G,B, each from 0 to 1"),
    switchField<kGrain, &Grain::enabled>("grain"),
    numberField<kGrain, &Grain::strength>("grain.strength", 0.0f, 1.0f, "a number from 0 to 1"),
    numberField<kGrain, &Grain::size>("grain.size", 1.0f, 8.0f, "pixels from 1 to 8"),
    switchField<kAberration, &ChromaticAberration::enabled>("chromaticAberration"),
    numberField<kAberration, &ChromaticAberration::strength>("chromaticAberration.strength", 0.0f, 0.1f,
                                                             "a number from 0 to 0.1"),
    scaleField<kResolution, &Resolution::scale>("resolution.scale", 0.5f, 1.0f, "a number from 0.5 to 1, or two: X,Y"),
    switchField<kResolution, &Resolution::dynamic>("resolution.dynamic"),
    numberField<kResolution, &Resolution::targetMilliseconds>("resolution.targetMilliseconds", 0.1f, 1e3f,
                                                              "milliseconds from 0.1 to 1000"),
    numberField<kResolution, &Resolution::leastScale>("resolution.leastScale", 0.5f, 1.0f, "a number from 0.5 to 1"),
    numberField<kResolution, &Resolution::headroom>("resolution.headroom", 0.0f, 0.5f, "a number from 0 to 0.5"),
    numberField<kResolution, &Resolution::history>("resolution.history", 1.0f, 32.0f, "frames from 1 to 32"),
    switchField<kResolution, &Resolution::uniform>("resolution.uniform"),
    switchField<kSharpening, &Sharpening::enabled>("sharpening"),
    numberField<kSharpening, &Sharpening::strength>("sharpening.strength", 0.0f, 1.0f, kShare),
    switchField<kGuardBand, &GuardBand::enabled>("guardBand"),
    numberField<kGuardBand, &GuardBand::width>("guardBand.width", 0.0f, 0.5f, "a number from 0 to 0.5"),
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
