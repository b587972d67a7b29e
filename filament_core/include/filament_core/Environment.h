// SPDX-License-Identifier: Apache-2.0
/// loadEnvironment: loads a picture (equirectangular .hdr or .exr, cube map in .ktx2) as light and background.
///   Space   world direction d sees a panorama at u = 0.5 - atan2(d.x, d.z) / 2pi, v = acos(d.y) / pi.
///   Cost    a second or two on the workers the first time; after that milliseconds, from a disk cache keyed by
///           content.
///   Errors  one line with file and reason.
///   Thread  the app thread, which waits for the workers; loadEnvironmentAsync() of <filament_core/LoadTicket.h> does
///           not.
#pragma once

#include <filament_core/Engine.h>
#include <filament_core/EnvironmentLights.h>
#include <filament_core/LoadOptions.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace filament_core {

class Environment {
public:
    Environment(Environment&&) noexcept = default;
    Environment& operator=(Environment&&) noexcept = default;

    IndirectLight indirectLight() const;
    Skybox skybox() const;
    /// What EnvironmentLoadOptions::sun took out of indirectLight(). Scene::setEnvironment() adds it as SunLights;
    /// after setIndirectLight() and setSkybox() a program adds sunLightOf() each.
    EnvironmentLights const& lights() const;

    struct Impl;
    explicit Environment(std::shared_ptr<Impl> impl) : mImpl(std::move(impl)) {}

private:
    std::shared_ptr<Impl> mImpl; ///< not shared
};

/// `path`: an equirectangular .hdr or .exr, a cube map of floats in a .ktx2, or a package (.ktx2 or .fenv) that cmgen
/// baked from one of them; sizes, format, mapping and lights are then those of the package.
Result<Environment> loadEnvironment(Engine& engine, std::filesystem::path const& path,
                                    EnvironmentLoadOptions const& options = {});

/// Such a file in memory; `name` stands for it in messages.
Result<Environment> loadEnvironment(Engine& engine, std::span<const std::byte> file, std::string_view name,
                                    EnvironmentLoadOptions const& options = {});

} // namespace filament_core
