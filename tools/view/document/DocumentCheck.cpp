// SPDX-License-Identifier: Apache-2.0
/// check(): the ranges of all fields, then the rules that several fields obey together.
#include "base/Result.h"
#include "tools/view/document/Fields.h"
#include "tools/view/document/TextForms.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

namespace filament_core::view {
namespace {

/// Keeps the first thing that is wrong, with its place.
class Checker {
public:
    template <class T>
    void visit(std::string const& place, T const& value, double low, double high);
    Result<void> result() const { return mError ? Result<void>(*mError) : Result<void>(); }

private:
    void refuse(std::string const& place, std::string_view rule) {
        if (!mError) mError = fail(ErrorCode::InvalidArgument, "{}: {}", place, rule);
    }
    void expect(bool isMet, std::string const& place, std::string_view rule) {
        if (!isMet) refuse(place, rule);
    }
    template <class T>
    void number(std::string const& place, T value, double low, double high);
    template <class T>
    void members(std::string const& place, T const& value) {
        forEachField<T>([&](auto const& field) {
            const std::string inner = place.empty() ? field.name : place + "." + field.name;
            visit(inner, value.*field.member, field.low, field.high);
        });
    }
    template <class T>
    void options(std::string const& place, T const& value);
    template <class T, class Key>
    void unique(std::string const& place, std::vector<T> const& list, std::string_view what, Key const& keyOf);

    // Rules of single parts; the others have none.
    template <class T>
    void rules(std::string const&, T const&) {}
    void rules(std::string const& place, Lens const& lens);
    void rules(std::string const& place, Camera const& camera);
    void rules(std::string const& place, View const& view);
    void rules(std::string const& place, EnvironmentLoadOptions const& options);
    void rules(std::string const& place, SpotLight const& light);
    void rules(std::string const& place, CameraPath const& path);
    void rules(std::string const& place, Document const& document);
    void direction(std::string const& place, float3 direction) {
        expect(glm::length(double3(direction)) > 0, place, "expected a direction that is not zero");
    }

    std::optional<Error> mError;
};

template <class T>
void Checker::number(std::string const& place, T value, double low, double high) {
    const auto number = static_cast<double>(value);
    low = std::max(low, static_cast<double>(std::numeric_limits<T>::lowest()));
    high = std::min(high, static_cast<double>(std::numeric_limits<T>::max()));
    if (!(number >= low && number <= high)) refuse(place, fmt::format("expected a number from {} to {}", low, high));
}

template <class T>
void Checker::options(std::string const& place, T const& value) {
    for (Option const& option : optionsOf<T>()) {
        T copy = value;
        if (const Result<void> done = setOption(copy, option.name, optionValue(option, &value)); !done)
            return refuse(place, done.error().message);
    }
}

template <class T>
void Checker::visit(std::string const& place, T const& value, double low, double high) {
    if (mError) return;
    if constexpr (IsOptions<T>) {
        options(place, value);
    } else if constexpr (HasFields<T>) {
        members(place, value);
        rules(place, value);
        if constexpr (requires { value.directionWorld; }) direction(place + ".directionWorld", value.directionWorld);
        if constexpr (requires { value.axisWorld; }) direction(place + ".axisWorld", value.axisWorld);
    } else if constexpr (IsNumber<T>) {
        number(place, value, low, high);
    } else if constexpr (IsUnit<T>) {
        number(place, value.value, low, high);
    } else if constexpr (IsVector<T>) {
        for (int i = 0; i < VectorOf<T>::size; ++i) visit(place, value[i], low, high);
    } else if constexpr (IsMatrix<T>) {
        for (int i = 0; i < MatrixOf<T>::size; ++i) visit(place, value[i], low, high);
    } else if constexpr (std::is_same_v<T, Globals>) {
        for (float4 const& each : value) visit(place, each, low, high);
    } else if constexpr (IsOptional<T>) {
        if (value) visit(place, *value, low, high);
    } else if constexpr (IsList<T>) {
        for (size_t i = 0; i < value.size(); ++i) visit(fmt::format("{}[{}]", place, i), value[i], low, high);
    } else if constexpr (std::is_same_v<T, LightDesc> || std::is_same_v<T, ParameterValue>) {
        std::visit([&](auto const& held) { visit(place, held, low, high); }, value);
    }
    // Switches, texts, paths and enumerators may be anything.
}

template <class T, class Key>
void Checker::unique(std::string const& place, std::vector<T> const& list, std::string_view what, Key const& keyOf) {
    std::set<decltype(keyOf(list[0]))> known;
    for (size_t i = 0; i < list.size(); ++i)
        expect(known.insert(keyOf(list[i])).second, fmt::format("{}[{}]", place, i),
               fmt::format("expected one edit of a {}, and this is the second", what));
}

void Checker::rules(std::string const& place, Lens const& lens) {
    if (lens.isOrthographic())
        expect(lens.farMeters > lens.nearMeters, place + ".farMeters", "expected more than nearMeters");
    else
        expect(lens.nearMeters > 0, place + ".nearMeters", "expected more than 0");
}

void Checker::rules(std::string const& place, Camera const& camera) {
    double4x4 const& m = camera.worldFromView;
    const glm::dmat3 turn(m);
    const glm::dmat3 off = glm::transpose(turn) * turn - glm::dmat3(1.0);
    double most = 0;
    for (int i = 0; i < 3; ++i) most = std::max({ most, std::abs(off[i].x), std::abs(off[i].y), std::abs(off[i].z) });
    const bool isAffine = m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1;
    expect(most < 1e-3 && glm::determinant(turn) > 0 && isAffine, place + ".worldFromView",
           "expected a rotation and a position, column by column");
}

void Checker::rules(std::string const& place, View const& view) {
    expect(view.samples == 1 || view.samples == 4, place + ".samples", "expected 1 or 4");
}

void Checker::rules(std::string const& place, EnvironmentLoadOptions const& options) {
    expect(std::has_single_bit(options.faceSize), place + ".faceSize", "expected a power of two from 16 to 2048");
    expect(nameOf(options.sun), place + ".sun", std::string("expected ") + validNames(options.sun));
    expect(nameOf(options.format), place + ".format", std::string("expected ") + validNames(options.format));
}

void Checker::rules(std::string const& place, SpotLight const& light) {
    expect(light.innerConeRadians < light.outerConeRadians, place + ".innerConeRadians",
           "expected less than outerConeRadians");
}

void Checker::rules(std::string const& place, CameraPath const& path) {
    for (size_t i = 1; i < path.keys.size(); ++i)
        expect(path.keys[i].seconds > path.keys[i - 1].seconds, fmt::format("{}.keys[{}].seconds", place, i),
               "expected more than that of the key before");
}

void Checker::rules(std::string const&, Document const& document) {
    unique("nodes", document.nodes, "node", [](NodeEdit const& edit) { return edit.node; });
    unique("modelLights", document.modelLights, "light", [](ModelLightEdit const& edit) { return edit.light; });
    unique("morphs", document.morphs, "target", [](MorphEdit const& edit) { return std::string_view(edit.target); });
    unique("materials", document.materials, "parameter", [](MaterialEdit const& edit) {
        return std::pair<std::string_view, std::string_view>(edit.material, edit.parameter);
    });
    unique("textures", document.textures, "parameter", [](TextureEdit const& edit) {
        return std::pair<std::string_view, std::string_view>(edit.material, edit.parameter);
    });
}

} // namespace

Result<void> check(Document const& document) {
    Checker checker;
    checker.visit("", document, -kAnyNumber, kAnyNumber);
    return checker.result();
}

Result<void> check(CameraPath const& path) {
    Checker checker;
    checker.visit("path", path, -kAnyNumber, kAnyNumber);
    return checker.result();
}

} // namespace filament_core::view
