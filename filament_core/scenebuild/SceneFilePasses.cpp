// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenebuild/SceneFilePasses.h"

#include "base/NumberText.h"
#include "base/Suggest.h"

#include <filament_core/Image.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace filament_core::scenebuild {
namespace {

/// Nothing if a word is neither a number nor a truth.
std::optional<std::vector<double>> numbersIn(std::string_view words) {
    std::vector<double> numbers;
    while (true) {
        const size_t end = std::min(words.find(','), words.size());
        std::string_view word = words.substr(0, end);
        while (word.starts_with(' ')) word.remove_prefix(1);
        while (word.ends_with(' ')) word.remove_suffix(1);
        const bool isTruth = word == "true" || word == "false";
        const std::optional<double> number = isTruth ? (word == "true" ? 1.0 : 0.0) : numberOf<double>(word);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers.push_back(*number);
        if (end == words.size()) return numbers;
        words.remove_prefix(end + 1);
    }
}

template <class T>
constexpr size_t componentsOf() {
    if constexpr (std::is_arithmetic_v<T>)
        return 1;
    else
        return static_cast<size_t>(T::length()) * componentsOf<std::remove_cvref_t<decltype(std::declval<T&>()[0])>>();
}

/// Components of a vector; matrices by column.
template <class T>
T valueFrom(const double* numbers) {
    if constexpr (std::is_same_v<T, bool>) {
        return *numbers != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
        return static_cast<T>(*numbers);
    } else {
        using Part = std::remove_cvref_t<decltype(std::declval<T&>()[0])>;
        T value{};
        for (int i = 0; i < T::length(); ++i)
            value[i] = valueFrom<Part>(numbers + static_cast<size_t>(i) * componentsOf<Part>());
        return value;
    }
}

/// If the parameter has the type of this alternative. The alternatives are in the order of ParameterType.
template <size_t Type>
bool setAs(Engine& engine, MaterialInstance instance, ParameterDescription const& parameter, std::string const& words,
           Result<void>& done) {
    if (static_cast<size_t>(parameter.type) != Type) return false;
    using T = std::variant_alternative_t<Type, ParameterValue>;
    const size_t count = std::max(parameter.arraySize, 1u), each = componentsOf<T>();
    const std::optional<std::vector<double>> numbers = numbersIn(words);
    if (!numbers || numbers->size() != count * each) {
        done = fail(ErrorCode::InvalidArgument, "parameter '{}' takes {} numbers, separated by commas, not '{}'",
                    parameter.name, count * each, words);
    } else if (parameter.arraySize == 0) {
        done = engine.set(instance, parameter.name, ParameterValue(valueFrom<T>(numbers->data())));
    } else {
        for (uint32_t i = 0; i < parameter.arraySize && done; ++i) {
            const T value = valueFrom<T>(numbers->data() + i * each);
            done = engine.set(instance, parameter.name, ParameterArray(std::span(&value, 1)), i);
        }
    }
    return true;
}

template <size_t... Types>
Result<void> setNumbers(Engine& engine, MaterialInstance instance, ParameterDescription const& parameter,
                        std::string const& words, std::index_sequence<Types...>) {
    Result<void> done;
    (void)(setAs<Types>(engine, instance, parameter, words, done) || ...);
    return done;
}

Result<std::vector<MaterialConstant>> constantsOf(MaterialDescription const& material, SceneFilePass const& pass) {
    std::vector<MaterialConstant> constants;
    for (ConstantDescription const& constant : material.constants) {
        const auto given = std::ranges::find(pass.values, constant.name, &std::pair<std::string, std::string>::first);
        if (given == pass.values.end()) continue;
        const std::optional<std::vector<double>> numbers = numbersIn(given->second);
        if (!numbers || numbers->size() != 1)
            return fail(ErrorCode::InvalidArgument, "constant '{}' takes a number, not '{}'", constant.name,
                        given->second);
        MaterialConstant& added = constants.emplace_back();
        added.name = constant.name;
        std::visit([&](auto value) { added.value = valueFrom<decltype(value)>(numbers->data()); },
                   constant.defaultValue);
    }
    return constants;
}

Result<void> setTexture(Engine& engine, MaterialInstance instance, std::string const& parameter,
                        std::string const& words, ImagePath const& imagePath, BuiltScene& built) {
    const Result<std::filesystem::path> path = imagePath(words);
    if (!path) return path.error();
    const Result<Image> image = loadImage(*path);
    if (!image) return image.error();
    if (std::max(image->width, image->height) > engine.device().maxTextureSize)
        return fail(ErrorCode::Unsupported, "'{}' is larger than {} pixels a side", path->string(),
                    engine.device().maxTextureSize);
    built.passTextures.push_back(engine.own(engine.create(textureOf(*image, words))));
    return engine.set(instance, parameter, built.passTextures.back());
}

} // namespace

Result<void> addPass(Engine& engine, SceneFilePass const& pass, std::span<const std::byte> package,
                     std::string const& name, ImagePath const& imagePath, BuiltScene& built) {
    Result<Material> material = engine.create(MaterialDesc{ .package = package, .name = name });
    if (!material) return material.error();
    Owned<Material> first = engine.own(*material);
    const Result<std::vector<MaterialConstant>> constants = constantsOf(engine.describe(first), pass);
    if (!constants) return constants.error();
    if (!constants->empty()) {
        material = engine.create(MaterialDesc{ .package = package, .constants = *constants, .name = name });
        if (!material) return material.error();
        first = engine.own(*material);
    }
    MaterialDescription const& described = engine.describe(first);
    built.passInstances.push_back(engine.own(engine.createInstance(first, name)));
    const MaterialInstance instance = built.passInstances.back();
    built.passMaterials.push_back(std::move(first));
    std::vector<std::string_view> known;
    for (ParameterDescription const& parameter : described.parameters) known.emplace_back(parameter.name);
    for (auto const& [key, words] : pass.values) {
        if (std::ranges::find(described.constants, key, &ConstantDescription::name) != described.constants.end())
            continue;
        ParameterDescription const* const parameter = described.findParameter(key);
        if (!parameter)
            return fail(ErrorCode::NotFound, "material '{}' has no parameter or constant '{}'{}", name, key,
                        suggestion(key, known));
        const bool isTexture = static_cast<size_t>(parameter->type) >= std::variant_size_v<ParameterValue>;
        Result<void> set = isTexture ? setTexture(engine, instance, key, words, imagePath, built)
                                     : setNumbers(engine, instance, *parameter, words,
                                                  std::make_index_sequence<std::variant_size_v<ParameterValue>>());
        if (!set) return set;
    }
    built.passes.push_back({ instance, pass.place });
    return {};
}

} // namespace filament_core::scenebuild
