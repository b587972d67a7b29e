// SPDX-License-Identifier: Apache-2.0
/// loadEnvironment: an equirectangular .hdr or .exr as light and background.
///   World direction d sees the image at u = 0.5 - atan2(d.x, d.z) / 2pi, v = acos(d.y) / pi.
///   Cost    the first time a second or two on the workers; then from a cache on disk, by content, in milliseconds.
///   Errors  file and reason in one line.
#pragma once

#include <filament/Engine.h>
#include <filament/EnvironmentFormat.h>
#include <filament/Gltf.h>

#include <filesystem>
#include <memory>

namespace filament {

struct EnvironmentLoadOptions {
    uint32_t faceSize = 256;         ///< texels of a cube face, power of two in [16, 2048]
    Format format = Format::RGBA16F; ///< or R11G11B10F, RGB9E5, RGBA8 (as RGBM): half the memory
    RoughnessMapping roughnessMapping = RoughnessMapping::Quadratic;
    uint32_t samples = 512; ///< pieces of the sky that each texel integrates, about
    LoadProgress progress{};
};

class Environment {
public:
    Environment(Environment&&) noexcept;
    Environment& operator=(Environment&&) noexcept;
    ~Environment();

    IndirectLight indirectLight() const;
    Skybox skybox() const;

    struct Impl;
    explicit Environment(std::unique_ptr<Impl> impl);

private:
    std::unique_ptr<Impl> mImpl;
};

Result<Environment> loadEnvironment(Engine& engine, std::filesystem::path const& path,
                                    EnvironmentLoadOptions const& options = {});

} // namespace filament
