// SPDX-License-Identifier: Apache-2.0
/// documentFromJson(): strict, and for any bytes. The first thing that is wrong is what the error says.
#include "base/Result.h"
#include "base/Suggest.h"
#include "toolkit/json/JsonFile.h"
#include "tools/view/document/DocumentVersion.h"
#include "tools/view/document/Fields.h"
#include "tools/view/document/TextForms.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::view {
namespace {

using tools::Json;

std::string textOf(Json const& json) { return json.get<std::string>(); }

class Reader {
public:
    template <class T>
    void read(std::string const& place, Json const& json, T& value);
    std::optional<std::string> const& error() const { return mError; }
    void refuse(std::string const& place, std::string_view what) {
        if (!mError) mError = fmt::format("{}: {}", place.empty() ? "the document" : place, what);
    }
    template <class T>
    void members(std::string const& place, Json const& json, T& value, std::initializer_list<const char*> besides = {});

private:
    template <class T>
    void number(std::string const& place, Json const& json, T& value);
    template <class At>
    void numbers(std::string const& place, Json const& json, size_t count, At const& at);
    template <class T>
    void options(std::string const& place, Json const& json, T& value);
    template <class T>
    void named(std::string const& place, Json const& json, T& value);
    void light(std::string const& place, Json const& json, LightDesc& value);
    void parameter(std::string const& place, Json const& json, ParameterValue& value);
    bool expectObject(std::string const& place, Json const& json) {
        if (!json.is_object()) refuse(place, "expected an object");
        return json.is_object();
    }
    void unknown(std::string const& place, std::string const& key, std::vector<std::string_view> const& known) {
        refuse(place, fmt::format("there is no field '{}'{}", key, suggestion(key, known)));
    }

    std::optional<std::string> mError;
};

std::string inside(std::string const& place, std::string_view key) {
    return place.empty() ? std::string(key) : fmt::format("{}.{}", place, key);
}

template <class T>
void Reader::number(std::string const& place, Json const& json, T& value) {
    const double low = std::is_same_v<T, double> ? -kAnyNumber : static_cast<double>(std::numeric_limits<T>::lowest());
    const double high = std::is_same_v<T, double> ? kAnyNumber : static_cast<double>(std::numeric_limits<T>::max());
    const double number = json.is_number() ? json.get<double>() : std::nan("");
    if (!(number >= low && number <= high))
        return refuse(place, fmt::format("expected a number from {} to {}", low, high));
    if (std::is_integral_v<T> && number != std::floor(number)) return refuse(place, "expected a whole number");
    value = static_cast<T>(number);
}

template <class At>
void Reader::numbers(std::string const& place, Json const& json, size_t count, At const& at) {
    if (!json.is_array() || json.size() != count) return refuse(place, fmt::format("expected {} numbers", count));
    for (size_t i = 0; i < count; ++i) read(place, json[i], at(static_cast<int>(i)));
}

template <class T>
void Reader::options(std::string const& place, Json const& json, T& value) {
    if (!expectObject(place, json)) return;
    for (auto const& [name, text] : json.items()) {
        if (!text.is_string()) return refuse(inside(place, name), "expected a text");
        const Result<void> done = setOption(value, name, textOf(text));
        if (!done) return refuse(inside(place, name), done.error().message);
    }
}

template <class T>
void Reader::members(std::string const& place, Json const& json, T& value, std::initializer_list<const char*> besides) {
    if (!expectObject(place, json)) return;
    std::vector<std::string_view> known(besides.begin(), besides.end());
    forEachField<T>([&](auto const& field) {
        known.push_back(field.name);
        const auto found = json.find(field.name);
        if (found != json.end()) read(inside(place, field.name), *found, value.*field.member);
    });
    for (auto const& [key, ignored] : json.items()) {
        if (std::ranges::find(known, key) == known.end()) return unknown(place, key, known);
    }
}

template <class T>
void Reader::named(std::string const& place, Json const& json, T& value) {
    const auto known = json.is_string() ? fromName(value, textOf(json)) : std::nullopt;
    if (!known) return refuse(place, fmt::format("expected {}", validNames(value)));
    value = *known;
}

/// The alternative of this index, with its defaults.
template <class V, size_t... I>
V alternative(size_t index, std::index_sequence<I...>) {
    V value;
    ((I == index ? static_cast<void>(value.template emplace<I>()) : static_cast<void>(0)), ...);
    return value;
}
template <class V>
V alternative(size_t index) {
    return alternative<V>(index, std::make_index_sequence<std::variant_size_v<V>>());
}

void Reader::light(std::string const& place, Json const& json, LightDesc& value) {
    if (!expectObject(place, json)) return;
    const auto kind = json.find("kind");
    const auto found =
            kind != json.end() && kind->is_string() ? std::ranges::find(kLightKinds, textOf(*kind)) : kLightKinds.end();
    if (found == kLightKinds.end())
        return refuse(inside(place, "kind"), "expected sun, point, spot, rect, disc or tube");
    value = alternative<LightDesc>(static_cast<size_t>(found - kLightKinds.begin()));
    std::visit([&](auto& light) { members(place, json, light, { "kind" }); }, value);
}

void Reader::parameter(std::string const& place, Json const& json, ParameterValue& value) {
    if (!expectObject(place, json)) return;
    const auto type = json.find("type"), held = json.find("value");
    size_t index = 0;
    const std::string name = type != json.end() && type->is_string() ? textOf(*type) : "";
    while (index < std::variant_size_v<ParameterValue> && name != parameterTypeName(index)) ++index;
    if (index == std::variant_size_v<ParameterValue>)
        return refuse(inside(place, "type"), "expected the type of a parameter, such as float3");
    if (held == json.end() || json.size() != 2) return refuse(place, "expected 'type' and 'value'");
    value = alternative<ParameterValue>(index);
    std::visit([&](auto& alternative) { read(inside(place, "value"), *held, alternative); }, value);
}

template <class T>
void Reader::read(std::string const& place, Json const& json, T& value) {
    if (mError) return;
    if constexpr (IsOptions<T>) {
        options(place, json, value);
    } else if constexpr (HasFields<T>) {
        members(place, json, value);
    } else if constexpr (std::is_same_v<T, bool>) {
        if (!json.is_boolean()) return refuse(place, "expected true or false");
        value = json.get<bool>();
    } else if constexpr (IsNumber<T>) {
        number(place, json, value);
    } else if constexpr (IsUnit<T>) {
        number(place, json, value.value);
    } else if constexpr (IsVector<T>) {
        numbers(
                place, json, VectorOf<T>::size, [&](int i) -> auto& { return value[i]; });
    } else if constexpr (IsMatrix<T>) {
        constexpr int kSize = MatrixOf<T>::size;
        numbers(
                place, json, kSize * kSize, [&](int i) -> auto& { return value[i / kSize][i % kSize]; });
    } else if constexpr (std::is_same_v<T, Globals>) {
        numbers(
                place, json, value.size(), [&](int i) -> auto& { return value[static_cast<size_t>(i)]; });
    } else if constexpr (IsNamed<T>) {
        named(place, json, value);
    } else if constexpr (IsOptional<T>) {
        if (json.is_null()) return value.reset();
        read(place, json, value.emplace());
    } else if constexpr (IsList<T>) {
        if (!json.is_array()) return refuse(place, "expected a list");
        value.clear();
        for (size_t i = 0; i < json.size() && !mError; ++i)
            read(fmt::format("{}[{}]", place, i), json[i], value.emplace_back());
    } else if constexpr (std::is_same_v<T, LightDesc>) {
        light(place, json, value);
    } else if constexpr (std::is_same_v<T, ParameterValue>) {
        parameter(place, json, value);
    } else {
        if (!json.is_string()) return refuse(place, "expected a text");
        value = textOf(json);
    }
}

Result<void> checkVersion(Json const& json, std::string_view name) {
    if (!json.is_object()) return fail(ErrorCode::Corrupt, "{}: expected an object", name);
    const auto version = json.find("version");
    if (version == json.end() || !version->is_number_unsigned())
        return fail(ErrorCode::Corrupt, "{}: version: expected {}; is this a document of filament-view?", name,
                    kDocumentVersion);
    if (version->get<uint64_t>() == kDocumentVersion) return {};
    return fail(ErrorCode::Unsupported, "{}: version: this program reads version {}, and the file has {}", name,
                kDocumentVersion, version->get<uint64_t>());
}

Result<void> checkAlone(Document const& document) { return check(document); }
Result<void> checkAlone(CameraPath const& path) { return check(path); }
Result<void> checkAlone(Camera const& camera) {
    Document document;
    document.view.camera = camera;
    return check(document);
}

/// A value that is the whole text, or its only member except for the version.
template <class T>
Result<T> valueOf(Json const& json, const char* member, std::string_view name) {
    T value;
    Reader reader;
    if (!member) {
        reader.members("", json, value, { "version" });
    } else {
        reader.read(member, json[member], value);
        for (auto const& [key, ignored] : json.items())
            if (key != member && key != "version")
                reader.refuse(key, fmt::format("expected nothing beside {}", member));
    }
    if (reader.error()) return fail(ErrorCode::Corrupt, "{}: {}", name, *reader.error());
    if (const Result<void> valid = checkAlone(value); !valid)
        return fail(ErrorCode::Corrupt, "{}: {}", name, valid.error().message);
    return value;
}

/// The tree of a text that this program can read.
Result<Json> parsedVersion(std::string_view text, std::string_view name) {
    if (text.size() > kLongestText) return fail(ErrorCode::Unsupported, "{}: longer than 64 MiB", name);
    Result<Json> json = tools::parseJson(text, name);
    if (!json) return json;
    if (const Result<void> known = checkVersion(*json, name); !known) return known.error();
    return json;
}

} // namespace

Result<Document> documentFromJson(std::string_view text, std::string_view name) {
    const Result<Json> json = parsedVersion(text, name);
    if (!json) return json.error();
    return valueOf<Document>(*json, nullptr, name);
}

Result<AnyText> anyFromJson(std::string_view text, std::string_view name) {
    const auto any = [](auto&& value) { return value ? Result<AnyText>(std::move(*value)) : value.error(); };
    const Result<Json> json = parsedVersion(text, name);
    if (!json) return json.error();
    if (json->contains("camera")) return any(valueOf<Camera>(*json, "camera", name));
    if (json->contains("path")) return any(valueOf<CameraPath>(*json, "path", name));
    return any(valueOf<Document>(*json, nullptr, name));
}

} // namespace filament_core::view
