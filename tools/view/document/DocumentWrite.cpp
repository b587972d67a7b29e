// SPDX-License-Identifier: Apache-2.0
/// toJson(): every field of a document, so that a later default changes nothing of what was saved.
#include "base/NumberText.h"
#include "toolkit/json/JsonFile.h"
#include "tools/view/document/DocumentVersion.h"
#include "tools/view/document/Fields.h"
#include "tools/view/document/TextForms.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace filament_core::view {
namespace {

using tools::Json;

/// The shortest decimal that is this float again.
double shortest(float value) {
    const double decimal = std::isfinite(value) ? *numberOf<double>(fmt::format("{}", value)) : 0;
    return static_cast<float>(decimal) == value ? decimal : static_cast<double>(value);
}

template <class T>
Json jsonOf(T const& value);

template <class T>
Json listOf(T const& values, size_t count) {
    Json list = Json::array();
    for (size_t i = 0; i < count; ++i) list.push_back(jsonOf(values[static_cast<int>(i)]));
    return list;
}

/// Its numbers in one row, column by column.
template <class M>
Json matrixOf(M const& matrix) {
    Json list = Json::array();
    for (int column = 0; column < MatrixOf<M>::size; ++column) {
        for (int row = 0; row < MatrixOf<M>::size; ++row) list.push_back(jsonOf(matrix[column][row]));
    }
    return list;
}

template <class T>
Json textsOf(T const& options) {
    Json json = Json::object();
    for (Option const& option : optionsOf<T>()) json[std::string(option.name)] = optionValue(option, &options);
    return json;
}

template <class T>
Json membersOf(T const& value) {
    Json json = Json::object();
    forEachField<T>([&](auto const& field) { json[field.name] = jsonOf(value.*field.member); });
    return json;
}

Json lightOf(LightDesc const& any) {
    Json json{ { "kind", kLightKinds[any.index()] } };
    std::visit([&](auto const& light) { json.update(membersOf(light)); }, any);
    return json;
}

Json parameterOf(ParameterValue const& value) {
    return { { "type", parameterTypeName(value.index()) },
             { "value", std::visit([](auto const& held) { return jsonOf(held); }, value) } };
}

template <class T>
Json jsonOf(T const& value) {
    if constexpr (IsOptions<T>)
        return textsOf(value);
    else if constexpr (HasFields<T>)
        return membersOf(value);
    else if constexpr (std::is_same_v<T, float>)
        return shortest(value);
    else if constexpr (IsUnit<T>)
        return shortest(value.value);
    else if constexpr (IsVector<T>)
        return listOf(value, VectorOf<T>::size);
    else if constexpr (IsMatrix<T>)
        return matrixOf(value);
    else if constexpr (std::is_same_v<T, Globals>)
        return Json{ jsonOf(value[0]), jsonOf(value[1]), jsonOf(value[2]), jsonOf(value[3]) };
    else if constexpr (IsNamed<T>)
        return Json(nameOf(value) ? nameOf(value) : "");
    else if constexpr (IsOptional<T>)
        return value ? jsonOf(*value) : Json();
    else if constexpr (IsList<T>)
        return listOf(value, value.size());
    else if constexpr (std::is_same_v<T, LightDesc>)
        return lightOf(value);
    else if constexpr (std::is_same_v<T, ParameterValue>)
        return parameterOf(value);
    else if constexpr (std::is_same_v<T, std::filesystem::path>)
        return value.string();
    else
        return value;
}

} // namespace

std::string toJson(Document const& document) {
    Json json{ { "version", kDocumentVersion } };
    json.update(membersOf(document));
    return tools::jsonText(json);
}

std::string toJson(Camera const& camera) {
    return tools::jsonText({ { "version", kDocumentVersion }, { "camera", membersOf(camera) } });
}
std::string toJson(CameraPath const& path) {
    return tools::jsonText({ { "version", kDocumentVersion }, { "path", membersOf(path) } });
}

} // namespace filament_core::view
