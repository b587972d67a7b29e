// SPDX-License-Identifier: Apache-2.0
/// Leaves: every single value of a document, to be changed alone or together.
///   forEachLeaf(document, visit)   calls visit(place, change): change(random) gives the value another one.
///   fullDocument()                 one of everything: every kind of light, every type of parameter, both kinds of
///                                  lens.
#pragma once

#include "tools/view/document/Fields.h"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

namespace filament_core::view {

using Random = std::mt19937;
using Change = std::function<void(Random&)>;
using VisitLeaf = std::function<void(std::string const& place, Change const& change)>;

inline double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

/// "a, b or c" as a list.
inline std::vector<std::string> wordsOf(std::string_view names) {
    std::vector<std::string> words;
    for (size_t at = 0; at < names.size();) {
        const size_t end = std::min(names.find_first_of(", ", at), names.size());
        if (end > at && names.substr(at, end - at) != "or") words.emplace_back(names.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

/// Another number of [low, high].
template <class T>
T otherNumber(T old, double low, double high, Random& random) {
    const bool isWhole = std::is_integral_v<T>;
    low = std::max(low, std::is_unsigned_v<T> ? 0.0 : -1000.0);
    high = std::min(high, isWhole ? static_cast<double>(std::numeric_limits<T>::max()) : low + 2000.0);
    for (;;) {
        const auto number = static_cast<T>(between(random, low, high));
        if (number != old) return number;
    }
}

/// A text that the option takes and that is another one; the same if there is none.
template <class T>
void changeOption(T& options, std::string_view name, Random& random) {
    static const std::vector<std::string> kTexts = [] {
        std::vector<std::string> texts{ "on", "off", "true", "false" };
        for (const char* number :
             { "0", "1", "2", "3", "4", "8", "16", "64", "100", "128", "0.1", "0.3", "0.7", "0.25", "1.5", "-0.5" })
            texts.push_back(number);
        for (const char* list :
             { "0.1,0.2,0.3", "0.9,0.8,0.7", "1,1.5,2", "0.5,0.75", "0.6,0.9", "0.1,0.2,0.3,0.4", "1,2,3,4" })
            texts.push_back(list);
        for (Option const& option : optionsOf<View>())
            texts.insert(texts.end(), option.values.begin(), option.values.end());
        return texts;
    }();
    const std::string old = *optionValue(options, name);
    const size_t first = random() % kTexts.size();
    for (size_t i = 0; i < kTexts.size(); ++i) {
        T copy = options;
        if (setOption(copy, name, kTexts[(first + i) % kTexts.size()]).ok() && *optionValue(copy, name) != old) {
            options = copy;
            return;
        }
    }
}

class LeafWalk {
public:
    explicit LeafWalk(VisitLeaf const& visit) : mVisit(visit) {}

    template <class T>
    void walk(std::string const& place, T& value, double low, double high) {
        if constexpr (IsOptions<T>) {
            for (Option const& option : optionsOf<T>())
                leaf(fmt::format("{}.{}", place, option.name),
                     [&](Random& random) { changeOption(value, option.name, random); });
        } else if constexpr (std::is_same_v<T, Camera>) {
            camera(place, value);
        } else if constexpr (std::is_same_v<T, CameraPath>) {
            path(place, value);
        } else if constexpr (std::is_same_v<T, EnvironmentLoadOptions>) {
            leaf(place + ".faceSize", [&](Random&) { value.faceSize = value.faceSize == 256 ? 512 : 256; });
            leaf(place + ".format", [&](Random& random) { value.format = otherName(value.format, random); });
            leaf(place + ".roughnessMapping",
                 [&](Random& random) { value.roughnessMapping = otherName(value.roughnessMapping, random); });
            walk(place + ".samples", value.samples, 1, 65536);
        } else if constexpr (HasFields<T>) {
            forEachField<T>([&](auto const& field) {
                const std::string inner = place.empty() ? field.name : place + "." + field.name;
                if (inner == "view.samples")
                    samples(inner, value.*field.member);
                else
                    walk(inner, value.*field.member, field.low, field.high);
            });
        } else if constexpr (IsVector<T>) {
            for (int i = 0; i < VectorOf<T>::size; ++i) element(place, value, i, low, high);
        } else if constexpr (IsMatrix<T>) {
            for (int i = 0; i < MatrixOf<T>::size; ++i) walk(place, value[i], low, high);
        } else if constexpr (std::is_same_v<T, Globals>) {
            for (float4& each : value) walk(place, each, low, high);
        } else if constexpr (IsOptional<T>) {
            leaf(place, [&](Random&) { value ? value.reset() : static_cast<void>(value.emplace()); });
            if (value) walk(place, *value, low, high);
        } else if constexpr (IsList<T>) {
            leaf(place, [&](Random&) {
                if (!value.empty()) value.pop_back();
            });
            for (size_t i = 0; i < value.size(); ++i) walk(fmt::format("{}[{}]", place, i), value[i], low, high);
        } else if constexpr (std::is_same_v<T, LightDesc>) {
            leaf(place, [&](Random&) {
                value.index() == 0 ? static_cast<void>(value = PointLight{}) : static_cast<void>(value = SunLight{});
            });
            std::visit([&](auto& held) { walk(place, held, low, high); }, value);
        } else if constexpr (std::is_same_v<T, ParameterValue>) {
            leaf(place, [&](Random&) {
                value.index() == 0 ? static_cast<void>(value = 0.5f) : static_cast<void>(value = true);
            });
            std::visit([&](auto& held) { walk(place + ".value", held, low, high); }, value);
        } else {
            leaf(place, [&, low, high](Random& random) { change(value, low, high, random); });
        }
    }

private:
    void leaf(std::string const& place, Change const& change) { mVisit(place, change); }

    template <class T>
    void element(std::string const& place, T& vector, int i, double low, double high) {
        leaf(place, [&vector, i, low, high](Random& random) {
            if constexpr (std::is_same_v<typename T::value_type, bool>)
                vector[i] = !vector[i];
            else
                vector[i] = otherNumber(vector[i], low, high, random);
        });
    }
    template <class T>
    void samples(std::string const& place, T& value) {
        if constexpr (std::is_same_v<T, uint8_t>) leaf(place, [&](Random&) { value = value == 1 ? 4 : 1; });
    }
    void camera(std::string const& place, Camera& camera) {
        leaf(place + ".worldFromView", [&](Random& random) {
            camera.worldFromView = glm::rotate(camera.worldFromView, between(random, 0.1, 1), double3(1, 2, 3));
        });
        leaf(place + ".worldFromView", [&](Random& random) { camera.worldFromView[3].y += between(random, 1, 9); });
        walk(place + ".lens", camera.lens, 0, 0);
        walk(place + ".exposure", camera.exposure, 0, 0);
    }
    /// The times of its keys ascend.
    void path(std::string const& place, CameraPath& path) {
        for (size_t i = 0; i < path.keys.size(); ++i) {
            leaf(fmt::format("{}.keys[{}].seconds", place, i), [&, i](Random& random) {
                for (size_t later = i; later < path.keys.size(); ++later)
                    path.keys[later].seconds += between(random, 1, 2);
            });
            walk(fmt::format("{}.keys[{}].camera", place, i), path.keys[i].camera, 0, 0);
        }
        leaf(place + ".keys", [&](Random&) {
            if (!path.keys.empty()) path.keys.pop_back();
        });
        walk(place + ".name", path.name, 0, 0);
        walk(place + ".isClosed", path.isClosed, 0, 0);
        walk(place + ".closingSeconds", path.closingSeconds, 0.1, 100);
    }
    template <class T>
    static void change(T& value, double low, double high, Random& random) {
        if constexpr (std::is_same_v<T, bool>)
            value = !value;
        else if constexpr (IsNumber<T>)
            value = otherNumber(value, low, high, random);
        else if constexpr (IsUnit<T>)
            value.value = otherNumber(value.value, low, high, random);
        else if constexpr (IsNamed<T>)
            value = otherName(value, random);
        else
            value = fmt::format("{}-\u00e9\"\\{}", random(), std::is_same_v<T, std::string> ? "\n" : "");
    }
    template <class E>
    static E otherName(E old, Random& random) {
        const std::vector<std::string> names = wordsOf(validNames(old));
        for (;;) {
            const std::optional<E> value = fromName(old, names[random() % names.size()]);
            EXPECT_TRUE(value.has_value());
            if (value && *value != old) return *value;
        }
    }

    VisitLeaf const& mVisit;
};

inline void forEachLeaf(Document& document, VisitLeaf const& visit) {
    LeafWalk(visit).walk("", document, -kAnyNumber, kAnyNumber);
}

template <size_t... I>
std::vector<MaterialEdit> everyParameter(std::index_sequence<I...>) {
    return { MaterialEdit{ "paint", fmt::format("of type {}", I), ParameterValue(std::in_place_index<I>) }... };
}

inline Document fullDocument() {
    Document document;
    document.model.file = "helmet.glb";
    document.nodes = { { .node = 3, .isVisible = false }, { .node = 1, .parentFromNode = double4x4(2.0) } };
    document.materials = everyParameter(std::make_index_sequence<std::variant_size_v<ParameterValue>>());
    document.textures = { { "paint", "baseColorMap", "wood.png", false }, { "paint", "normalMap", "bumps.png", true } };
    document.lights = { { .light = SunLight{} },  { .light = PointLight{} }, { .light = SpotLight{} },
                        { .light = RectLight{} }, { .light = DiscLight{} },  { .light = TubeLight{} } };
    document.probes = { { .name = "room", .file = "room.ktx2" } };
    document.grids = { { .file = "room.grid" } };
    document.modelLights = { { .light = 0 }, { .light = 2, .replacement = SpotLight{ .innerConeRadians = 0.1f } } };
    document.playback.animation = 2;
    document.morphs = { { .target = "smile", .weight = 0.5f } };
    document.bookmarks = { { .name = "front" } };
    document.bookmarks.front().camera.lens.orthographicHeight = 2;
    document.paths = { { .name = "around", .keys = { { .seconds = 0 }, { .seconds = 1 }, { .seconds = 3.5 } } } };
    return document;
}

} // namespace filament_core::view
