// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/SceneChoices.h"

#include <array>

namespace filament_core::tools {
namespace {

constexpr std::string_view kSun = "sun.", kEnvironment = "environment.", kModel = "model.";

template <class T>
PrefixedOptions prefixed(std::string_view prefix) {
    static const T kDefaults{};
    return { prefix, optionsOf<T>(), &kDefaults };
}

} // namespace

std::span<const PrefixedOptions> prefixedOptions() {
    static const std::array kAll{ prefixed<SunLight>(kSun), prefixed<EnvironmentLoadOptions>(kEnvironment),
                                  prefixed<GltfLoadOptions>(kModel) };
    return kAll;
}

std::optional<Result<void>> setSceneChoice(SceneOptions& options, std::string const& name, std::string const& value) {
    const auto set = [&](auto& object, std::string_view prefix) {
        return setOption(object, std::string_view(name).substr(prefix.size()), value);
    };
    if (name == "exact") {
        if (value != "on" && value != "off")
            return Result<void>(fail(ErrorCode::InvalidArgument, "option exact: '{}' is not off or on", value));
        options.exactShaders = value == "on";
        return Result<void>();
    }
    if (name == "bloom.dirt") {
        options.dirt = value;
        return Result<void>();
    }
    if (name.starts_with(kSun)) {
        if (!options.sun) return Result<void>(fail(ErrorCode::InvalidArgument, "{} needs a --sun as well", name));
        return set(*options.sun, kSun);
    }
    if (name.starts_with(kEnvironment)) return set(options.environmentOptions, kEnvironment);
    if (name.starts_with(kModel)) return set(options.modelOptions, kModel);
    return std::nullopt;
}

} // namespace filament_core::tools
