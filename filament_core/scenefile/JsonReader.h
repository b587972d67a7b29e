// SPDX-License-Identifier: Apache-2.0
/// JsonReader: reads one JSON object strictly, field by field: an unknown key is an error that names the nearest known
/// one.
///   Use     reader.read("size", spec.size); ... return reader.finish();  An absent field does not change the value.
///   Schema  describe(fill) gives the JSON schema of what the same function reads: every field is then known, absent
///           and described. So has() is true, and nothing is wrong.
///   Fails   the first error is kept: "helmet.json: camera.fov: expected a number".
///   Thread  one.
#pragma once

#include "base/Result.h"

#include <filament_core/EnumNames.h>
#include <filament_core/Math.h>

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::scenefile {

using Json = nlohmann::ordered_json;

class JsonReader {
public:
    /// Every message begins with `where`.
    JsonReader(Json const& object, std::string where);

    /// The schema of the object that `fill` reads.
    static Json describe(std::function<void(JsonReader&)> const& fill);

    bool isDescribing() const { return mSchema != nullptr; }
    bool has(const char* key);
    void read(const char* key, bool& value);
    void read(const char* key, std::string& value);
    void read(const char* key, double& value, double low, double high);
    void read(const char* key, float& value, double low, double high);
    void read(const char* key, uint32_t& value, uint32_t low, uint32_t high);
    void read(const char* key, std::vector<std::string>& values);
    /// An object of texts, ascending by name.
    void read(const char* key, std::vector<std::pair<std::string, std::string>>& values);
    /// `count` numbers from `low` to `high`.
    void numbers(const char* key, double* values, size_t count, double low, double high);
    template <int N, class T>
    void read(const char* key, glm::vec<N, T>& value) {
        double all[N];
        for (int i = 0; i < N; ++i) all[i] = static_cast<double>(value[i]);
        numbers(key, all, N, static_cast<double>(std::numeric_limits<T>::lowest()),
                static_cast<double>(std::numeric_limits<T>::max()));
        for (int i = 0; i < N; ++i) value[i] = static_cast<T>(all[i]);
    }
    /// An enumerator by name: `fromName(text)` returns an optional.
    template <class E, class FromName>
    void choice(const char* key, E& value, const char* cure, FromName const& fromName) {
        std::string word;
        read(key, word);
        if (word.empty()) return;
        if (const auto known = fromName(word))
            value = *known;
        else
            complain(key, std::string("'") + word + "' is not known; " + cure);
    }
    /// An enumerator by its place in `words`, which are those of the enumeration in the order of its declaration.
    template <class E>
    void choice(const char* key, E& value, std::span<const std::string_view> words) {
        if (const std::optional<size_t> place = choice(key, words)) value = static_cast<E>(*place);
    }
    /// A nested object: `fill(JsonReader&)` reads it; its errors become errors of this one.
    template <class Fill>
    void object(const char* key, Fill const& fill) {
        if (mSchema) return addObject(key, fill);
        Json const* found = find(key);
        if (found) nested(*found, mWhere + path(key), fill);
    }
    /// A list of objects.
    template <class Fill>
    void objects(const char* key, Fill const& fill) {
        if (mSchema) return addObjects(key, fill);
        const std::vector<Json const*> elements = list(key);
        for (size_t i = 0; i < elements.size(); ++i)
            nested(*elements[i], mWhere + path(key) + "[" + std::to_string(i) + "]", fill);
    }
    /// A list of objects and of texts, which `take(std::string)` reads.
    template <class Fill, class Take>
    void objectsOrTexts(const char* key, Fill const& fill, Take const& take) {
        if (mSchema) return addObjects(key, fill, true);
        const std::vector<Json const*> elements = list(key);
        for (size_t i = 0; i < elements.size(); ++i) {
            if (const std::optional<std::string> text = textOf(*elements[i]))
                take(*text);
            else
                nested(*elements[i], mWhere + path(key) + "[" + std::to_string(i) + "]", fill);
        }
    }
    /// The value of a field that the caller reads, and its schema, JSON text.
    Json const* raw(const char* key, std::string_view schema = "{}");

    void complain(const char* key, std::string const& what);
    Result<void> finish();

private:
    Json const* find(const char* key);
    std::optional<size_t> choice(const char* key, std::span<const std::string_view> words);
    std::vector<Json const*> list(const char* key);
    static std::string path(const char* key) { return std::string(" ") + key; }
    void add(const char* key, Json schema);
    void addList(const char* key, Json elements);
    void addObject(const char* key, std::function<void(JsonReader&)> const& fill);
    void addObjects(const char* key, std::function<void(JsonReader&)> const& fill, bool orTexts = false);
    static std::optional<std::string> textOf(Json const& value);

    template <class Fill>
    void nested(Json const& json, std::string where, Fill const& fill) {
        JsonReader reader(json, std::move(where));
        fill(reader);
        if (const Result<void> done = reader.finish(); !done && !mError) mError = done.error();
    }

    Json const& mObject;
    std::string mWhere;
    Json* mSchema = nullptr; ///< its properties; null: reads
    std::vector<std::string_view> mKnown;
    std::optional<Error> mError;
};

} // namespace filament_core::scenefile
