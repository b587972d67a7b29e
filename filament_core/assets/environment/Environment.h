// SPDX-License-Identifier: Apache-2.0
/// loadEnvironment: turns an equirectangular .hdr or .exr into the cubes and coefficients that light a scene.
///   In      a panorama (Panorama.h) or a cube map in a KTX 2.0 file (CubePicture.h); world direction d sees one
///           at u = 0.5 - atan2(d.x, d.z) / 2pi, v = acos(d.y) / pi. Or a file of writeEnvironmentPackage() or
///           writeBakedEnvironment(), whose sizes, format and mapping then count.
///   Out     EnvironmentData, with the same bits from the cache and from the baker, for any number of workers.
///   Cache   one file per content of the panorama, options and baker version, in `cacheDirectory`. Damaged files are
///           detected by their checksum and baked again; a directory that cannot be written causes a warning, not an
///           error.
///   Thread  any; two simultaneous loads of the same panorama bake twice and leave one file.
///   Memory  the panorama and about 60 MiB while baking; 7.3 MiB for the result with faces of 256 texels in RGBA16F.
///   Fails   NotFound, Unreadable, Corrupt, Unsupported, OutOfMemory with file, reason and cure; InvalidArgument for
///           options.
///   Cost    about a second on two cores for a 1024 x 512 panorama the first time, then about 10 ms.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/environment/IblBaker.h"
#include "jobsystem/Cancellation.h"

#include <filament_core/EnvironmentLights.h>

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace filament_core::assets {

/// Called on the loading thread: stage name, steps done, steps in total.
using EnvironmentProgress = std::function<void(std::string_view stage, size_t done, size_t total)>;

struct EnvironmentOptions {
    /// Empty: $XDG_CACHE_HOME/filament_core, or ~/.cache/filament_core.
    std::filesystem::path cacheDirectory{};
    bool useCache = true;
    uint32_t faceSize = 256; ///< texels per side of a specular face, power of two in [16, 2048]
    uint32_t samples = 512;  ///< approximate number of pieces of the sky per texel; [1, 65536]
    backend::Format format = backend::Format::RGBA16F; ///< or R11G11B10F, RGB9E5, RGBA8: RGBM
    RoughnessMapping mapping = RoughnessMapping::Quadratic;
    EnvironmentSun sun = EnvironmentSun::Keep; ///< what is not kept leaves `specular` and the irradiance, not `sky`
    uint32_t lights = 1;                       ///< at most, of EnvironmentSun::Fit; [1, 4]
    EnvironmentProgress progress{};
    /// Requested from any thread: the load ends before its next step, with Cancelled. Must outlive it.
    jobs::Cancellation const* cancellation = nullptr;
};

struct EnvironmentStatistics {
    uint32_t sourceWidth = 0, sourceHeight = 0;
    HdrRepairs repairs;               ///< of the panorama
    EncodeLoss specularLoss, skyLoss; ///< caused by the range of the format
    bool fromCache = false;
};

/// Between texels 3 degrees apart a cosine lobe is linear to 0.1 %, but at the horizon of small lamps it bends.
inline constexpr uint32_t kIrradianceFaceSize = 32;

struct EnvironmentData {
    Image specular; ///< cube
    Image sky;      ///< cube, one level: the panorama itself at its own pixel density
    /// Cube, one level of kIrradianceFaceSize texels: irradiance / pi, always RGBA16F. Without texels for an
    /// environment of which only the coefficients are known.
    Image irradiance;
    std::array<float4, 9> irradianceSh{}; ///< see shaders/lib/ibl.glsl
    float levelOfRoughnessOne = 0;
    RoughnessMapping mapping = RoughnessMapping::Quadratic; ///< the roughness of each level of `specular`
    float3x3 worldFromCube{ 1.0f };                         ///< of a panorama: the identity
    EnvironmentStatistics statistics;
    EnvironmentLights lights{}; ///< what was taken out
};

Result<EnvironmentData> loadEnvironment(std::filesystem::path const& path, jobs::JobSystem& jobs,
                                        EnvironmentOptions const& options = {});

/// The bytes of such a file; `name` stands for it in messages.
Result<EnvironmentData> loadEnvironmentFromMemory(std::span<const std::byte> file, std::string_view name,
                                                  jobs::JobSystem& jobs, EnvironmentOptions const& options = {});

/// For generated skies, without file and cache.
Result<EnvironmentData> bakeEnvironment(HdrImage const& image, jobs::JobSystem& jobs,
                                        EnvironmentOptions const& options = {});

/// A KTX 2.0 file that loadEnvironment() reads without baking, on any machine, with the same bits
/// (EnvironmentPackage.h). `data` is that of a panorama: it has no rotation.
Result<void> writeEnvironmentPackage(EnvironmentData const& data, std::filesystem::path const& path);

/// In the layout of the cache. It belongs to this version of the baker: others reject it with an error.
Result<void> writeBakedEnvironment(EnvironmentData const& data, std::filesystem::path const& path);

/// Texels per side of a sky face for a panorama of this width, a power of two in [16, 512]: at least a quarter of the
/// horizon.
uint32_t skyFaceSize(uint32_t sourceWidth);

/// The directory from `options`, or the user's cache directory; empty if there is none.
std::filesystem::path environmentCacheDirectory(EnvironmentOptions const& options);

} // namespace filament_core::assets
