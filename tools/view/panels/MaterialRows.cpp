// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/MaterialRows.h"

#include "tools/view/panels/PanelText.h"
#include "tools/view/stage/Stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace filament_core::view {
namespace {

template <class T>
constexpr bool isMatrix = std::is_same_v<T, float3x3> || std::is_same_v<T, float4x4>;

template <class T>
T roundedTo(double number) {
    if constexpr (std::is_same_v<T, bool>)
        return number != 0;
    else if constexpr (std::is_floating_point_v<T>)
        return static_cast<T>(number);
    else {
        const double whole = std::isnan(number) ? 0 : std::round(number);
        return static_cast<T>(std::clamp(whole, static_cast<double>(std::numeric_limits<T>::min()),
                                         static_cast<double>(std::numeric_limits<T>::max())));
    }
}

bool nameIsColor(std::string_view name) {
    return matchesFilter(name, "color") || matchesFilter(name, "tint") || matchesFilter(name, "emissive");
}

void append(std::string& text, std::string_view word) { text += fmt::format("{}{}", text.empty() ? "" : ", ", word); }

} // namespace

ParameterKind parameterKind(ParameterDescription const& description) {
    const ParameterType type = description.type;
    if (type >= ParameterType::Sampler2D) return ParameterKind::Texture;
    if (description.arraySize > 0 || type == ParameterType::Float3x3 || type == ParameterType::Float4x4)
        return ParameterKind::Other;
    if (type <= ParameterType::Bool4) return ParameterKind::Switch;
    const bool isThreeOrFour = type == ParameterType::Float3 || type == ParameterType::Float4;
    return isThreeOrFour && nameIsColor(description.name) ? ParameterKind::Color : ParameterKind::Number;
}

bool takesPicture(ParameterDescription const& description) {
    return description.type == ParameterType::Sampler2D && description.format == SamplerFormat::Float &&
           description.arraySize == 0;
}

bool holdsData(std::string_view parameter) {
    constexpr std::array<std::string_view, 13> kWords{ "normal",    "roughness",  "metallic",  "occlusion",
                                                       "height",    "bump",       "thickness", "transmission",
                                                       "clearcoat", "anisotropy", "iridescen", "displace",
                                                       "direction" };
    return std::ranges::any_of(kWords, [&](std::string_view word) { return matchesFilter(parameter, word); });
}

std::vector<MaterialRow> materialRows(Stage const& stage, Document const& document, std::string_view filter) {
    std::vector<MaterialRow> rows;
    for (CopyMaterial const& material : stage.materials()) {
        if (!matchesFilter(material.name, filter)) continue;
        auto row = std::ranges::find(rows, material.name, &MaterialRow::name);
        if (row == rows.end()) {
            const auto edits = std::ranges::count(document.materials, material.name, &MaterialEdit::material) +
                               std::ranges::count(document.textures, material.name, &TextureEdit::material);
            rows.push_back({ .name = material.name,
                             .instance = material.instance,
                             .material = material.material,
                             .edits = static_cast<uint32_t>(edits) });
            row = rows.end() - 1;
        }
        row->renderables += material.renderables;
    }
    return rows;
}

std::vector<ParameterRow> parameterRows(Stage& stage, MaterialRow const& material, Document const& document) {
    std::vector<ParameterRow> rows;
    for (ParameterDescription const& parameter : stage.engine().describe(material.material).parameters) {
        ParameterRow row{ .description = parameter, .kind = parameterKind(parameter) };
        if (row.kind != ParameterKind::Texture && parameter.arraySize == 0)
            if (Result<ParameterValue> value = stage.parameter(material.instance, parameter.name)) row.value = *value;
        const auto isOfRow = [&](auto const& edit) {
            return edit.material == material.name && edit.parameter == parameter.name;
        };
        if (const auto found = std::ranges::find_if(document.textures, isOfRow); found != document.textures.end())
            row.texture = *found;
        row.isEdited = row.texture || std::ranges::any_of(document.materials, isOfRow);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string describeMaterial(MaterialDescription const& description) {
    constexpr std::array kShading{ "unlit", "lit", "subsurface", "cloth", "specular glossiness" };
    constexpr std::array kBlending{ "opaque", "masked", "transparent", "fade", "add", "multiply", "screen", "custom" };
    std::string text;
    append(text, kShading[static_cast<size_t>(description.shading)]);
    append(text, kBlending[static_cast<size_t>(description.blending)]);
    if (description.doubleSided) append(text, "double sided");
    append(text, fmt::format("{} variants", description.variants.size()));
    std::string terms;
    for (std::string const& term : description.terms) append(terms, term);
    return terms.empty() ? text : fmt::format("{}; sets {}", text, terms);
}

std::vector<double> componentsOf(ParameterValue const& value) {
    return std::visit(
            [](auto const& held) {
                using T = std::remove_cvref_t<decltype(held)>;
                std::vector<double> components;
                if constexpr (std::is_arithmetic_v<T>) {
                    components.push_back(static_cast<double>(held));
                } else if constexpr (!isMatrix<T>) {
                    for (int i = 0; i < T::length(); ++i) components.push_back(static_cast<double>(held[i]));
                }
                return components;
            },
            value);
}

ParameterValue withComponents(ParameterValue const& value, std::vector<double> const& components) {
    ParameterValue changed = value;
    std::visit(
            [&](auto& held) {
                using T = std::remove_cvref_t<decltype(held)>;
                if constexpr (std::is_arithmetic_v<T>) {
                    if (!components.empty()) held = roundedTo<T>(components[0]);
                } else if constexpr (!isMatrix<T>) {
                    const int count = std::min(T::length(), static_cast<int>(components.size()));
                    for (int i = 0; i < count; ++i)
                        held[i] = roundedTo<typename T::value_type>(components[static_cast<size_t>(i)]);
                }
            },
            changed);
    return changed;
}

} // namespace filament_core::view
