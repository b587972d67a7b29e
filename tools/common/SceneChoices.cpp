// SPDX-License-Identifier: Apache-2.0
#include "tools/common/SceneChoices.h"

#include "tools/common/CommandLine.h"

#include <algorithm>
#include <array>

namespace filament::tools {
namespace {

/// How one choice is set; `option` is "--set NAME", for errors.
struct ChoiceField {
    SceneChoice choice;
    Result<void> (*set)(SceneOptions& options, const char* option, std::string const& value);
};

/// `known` holds the value that a word stands for, or nothing.
template <class T, class Known>
Result<void> choose(T& member, Known const& known, const char* option, std::string const& value, const char* cure) {
    if (!known) return invalidOption(option, value, cure);
    member = *known;
    return {};
}

template <auto Member>
Result<void> setSunSwitch(SceneOptions& options, const char* option, std::string const& value) {
    if (!options.sun) return invalidOption(option, value, "a --sun as well");
    return convertSwitch(option, value, (*options.sun).*Member);
}

Result<void> setSunNumber(SceneOptions& options, const char* option, std::string const& value, float SunLight::*member,
                          double least, double most, const char* cure) {
    if (!options.sun) return invalidOption(option, value, "a --sun as well");
    const auto given = finiteNumber(value);
    if (!given || *given < least || *given > most) return invalidOption(option, value, cure);
    (*options.sun).*member = static_cast<float>(*given);
    return {};
}

Result<void> setModelFiles(SceneOptions& options, const char* option, std::string const& value) {
    if (value != "folder" && value != "anywhere") return invalidOption(option, value, "folder or anywhere");
    options.modelOptions.filesFromAnywhere = value == "anywhere";
    return {};
}

Result<void> setModelLevels(SceneOptions& options, const char* option, std::string const& value) {
    if (value != "finest" && value != "all") return invalidOption(option, value, "finest or all");
    options.modelOptions.allLevels = value == "all";
    return {};
}

using ChoiceText = std::string const&;

constexpr std::array kChoiceFields{
    ChoiceField{ { "bloom.dirt", "a picture", "", "the dirt of the lens, through which [bloom](bloom.md) is seen" },
                 [](SceneOptions& o, const char*, ChoiceText value) {
                     o.dirt = value;
                     return Result<void>();
                 } },
    ChoiceField{ { "sun.showsDisc", "on, off", "off", "draws the disc of the `--sun`" },
                 setSunSwitch<&SunLight::showsDisc> },
    ChoiceField{
            { "sun.contactShadows", "on, off", "off", "[contact shadows](shadows.md#contact-shadows) of the `--sun`" },
            setSunSwitch<&SunLight::contactShadows> },
    ChoiceField{ { "sun.angularRadiusDegrees", "degrees from 0 to 20", "0.2665", "how large the disc is" },
                 [](SceneOptions& o, const char* option, ChoiceText value) {
                     return setSunNumber(o, option, value, &SunLight::angularRadiusDegrees, 0, 20,
                                         "degrees from 0 to 20");
                 } },
    ChoiceField{ { "sun.haloSize", "a number from 1 to 1000", "10",
                   "how large the halo round the disc is, in radii of the disc" },
                 [](SceneOptions& o, const char* option, ChoiceText value) {
                     return setSunNumber(o, option, value, &SunLight::haloSize, 1, 1000, "a number from 1 to 1000");
                 } },
    ChoiceField{ { "sun.haloFalloff", "a number from 0 to 10000", "80", "how fast the halo fades" },
                 [](SceneOptions& o, const char* option, ChoiceText value) {
                     return setSunNumber(o, option, value, &SunLight::haloFalloff, 0, 10'000,
                                         "a number from 0 to 10000");
                 } },
    ChoiceField{ { "exact", "on, off", "on", "off leaves arithmetic to the drivers: the bits then differ" },
                 [](SceneOptions& o, const char* option, ChoiceText value) {
                     return convertSwitch(option, value, o.exactShaders);
                 } },
    ChoiceField{ { "environment.format", "RGBA16F, R11G11B10F, RGB9E5, RGBM", "RGBA16F",
                   "how environments are stored: [quality](quality.md)" },
                 [](SceneOptions& o, const char* option, ChoiceText value) {
                     return choose(o.environmentOptions.format, environmentFormatFromName(value), option, value,
                                   "RGBA16F, R11G11B10F, RGB9E5 or RGBM");
                 } },
    ChoiceField{ { "environment.roughnessMapping", "quadratic, logarithmic, linear", "quadratic",
                   "which roughness each mip level of an environment has" },
                 [](SceneOptions& o, const char* option, ChoiceText value) {
                     return choose(o.environmentOptions.roughnessMapping, enumFromName<RoughnessMapping>(value), option,
                                   value, "quadratic, logarithmic or linear");
                 } },
    ChoiceField{ { "model.positions", "asAuthored, half, unorm16", "asAuthored", "how positions are stored" },
                 [](SceneOptions& o, const char* option, ChoiceText value) {
                     return choose(o.modelOptions.positions, enumFromName<PositionStorage>(value), option, value,
                                   "asAuthored, half or unorm16");
                 } },
    ChoiceField{ { "model.tangents", "snorm16, snorm8, float", "snorm16", "how tangent frames are stored" },
                 [](SceneOptions& o, const char* option, ChoiceText value) {
                     return choose(o.modelOptions.tangents, enumFromName<TangentStorage>(value), option, value,
                                   "snorm16, snorm8 or float");
                 } },
    ChoiceField{ { "model.levels", "finest, all", "finest",
                   "of things with levels of detail: `all` draws those that the view asks for" },
                 setModelLevels },
    ChoiceField{ { "model.files", "folder, anywhere", "folder",
                   "whether buffers and images outside of the model's folder are opened" },
                 setModelFiles },
};

} // namespace

std::span<const SceneChoice> sceneChoices() {
    static const std::array kChoices = [] {
        std::array<SceneChoice, kChoiceFields.size()> choices;
        std::ranges::transform(kChoiceFields, choices.begin(), &ChoiceField::choice);
        return choices;
    }();
    return kChoices;
}

std::optional<Result<void>> setSceneChoice(SceneOptions& options, std::string const& name, std::string const& value) {
    const auto found = std::ranges::find(kChoiceFields, name, [](ChoiceField const& each) { return each.choice.name; });
    if (found != kChoiceFields.end()) return found->set(options, ("--set " + name).c_str(), value);
    if (!name.starts_with("sun.")) return std::nullopt;
    return Result<void>(invalidOption(
            "--set", name,
            "sun.showsDisc, sun.contactShadows, sun.angularRadiusDegrees, sun.haloSize or sun.haloFalloff"));
}

} // namespace filament::tools
