// SPDX-License-Identifier: Apache-2.0
/// Reference: the picture that the engine approximates, by Monte Carlo integration in double precision.
///   In      models, lights and an environment as the engine takes them; a camera; settings.
///   Out     scene-linear Rec. 709 times exposure, the scale of the engine's RGBA16F target, and for every pixel the
///           standard error of its mean. No clamping: the estimate is unbiased but for `maxBounces`.
///   Thread  render(): any, one call per TracedScene or many at once; works on the job system. The same bits for any
///           number of workers.
///   Memory  72 bytes a pixel while it runs; the scene about 200 bytes a triangle and the models' images.
///   Fails   InvalidArgument in one line for settings outside of their ranges; OutOfMemory from Embree.
///   Cost    README.md
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/ModelData.h"
#include "filament_core/assets/image/HdrImage.h"
#include "jobsystem/JobSystem.h"
#include "tools/reference/BsdfModel.h"

#include <filament/Box.h>
#include <filament/Camera.h>
#include <filament/Light.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament::reference {

// ---- what is drawn

struct SurfaceSample;
/// What a material says beyond the words of its file, at every point of the model. Called on any thread, often.
using SurfaceFinish = std::function<void(SurfaceSample&)>;

struct ReferenceModel {
    std::shared_ptr<const assets::ModelData> data;
    double4x4 worldFromModel{ 1.0 };
    SurfaceFinish finish{};
};

/// An equirectangular picture, placed as <filament/Environment.h> says; between its pixels bilinear.
struct ReferenceEnvironment {
    std::shared_ptr<const assets::HdrImage> image;
    Lux illuminance{ 30'000 }; ///< what radiance 1 of the picture stands for
    float rotationRadians = 0; ///< around +Y
    bool skybox = true;        ///< seen by the camera; it gives light in any case
};

struct ReferenceScene {
    std::vector<ReferenceModel> models;
    std::optional<ReferenceEnvironment> environment;
    std::vector<SunLight> suns; ///< all of them shine; the engine keeps the brightest
    std::vector<PointLight> points;
    std::vector<SpotLight> spots;
};

/// Of all parts, as the engine's Model::bounds() has it: for fitToUnitCube().
Box modelBounds(assets::ModelData const& model);

// ---- how it is drawn

struct ReferenceView {
    Camera camera{};
    uint2 size{ 640, 360 };
    float4 clearColor{ 0, 0, 0, 1 }; ///< as View::clearColor
};

enum class Integrator : uint8_t {
    Path,       ///< global illumination: visibility and all bounces
    Unoccluded, ///< one reflection of light that nothing blocks: the integral that image-based lighting approximates
};

/// Which technique finds the environment and glowing surfaces. Both and each alone have the same mean; the others exist
/// to test that.
enum class Sampling : uint8_t { Both, Bsdf, Light };

enum class PixelFilter : uint8_t {
    Box,    ///< the mean over the pixel
    Center, ///< the radiance at its centre: the very point that a rasteriser without anti-aliasing shades
};

enum class Switch : uint8_t { Auto, Off, On };

struct ReferenceSettings {
    Integrator integrator = Integrator::Path;
    uint32_t samplesPerPixel = 256; ///< [1, 2^20]: rounded up to whole passes
    float relativeError = 0;        ///< > 0: stop when RenderStatistics::relativeError is below it
    uint32_t maxBounces =
            64; ///< [1, 4096] reflections, going through does not count; Russian roulette ends most paths much earlier
    uint32_t seed = 1;
    PixelFilter filter = PixelFilter::Box;
    Sampling sampling = Sampling::Both;
    BsdfModel bsdf{};
    Switch occlusionMap = Switch::Auto; ///< Auto: used by Unoccluded, not by Path, which finds the real occlusion
};

// ---- what comes out

struct RenderStatistics {
    uint32_t samplesPerPixel = 0, passes = 0;
    /// Root mean square of the pixels' standard errors over the mean, both of luminance.
    double relativeError = 0;
    double meanLuminance = 0;
    uint64_t rays = 0;        ///< traced, shadow rays among them
    uint64_t lostSamples = 0; ///< not finite and counted as black: a defect to report, 0
    double seconds = 0;
};

struct ReferenceImage {
    uint32_t width = 0, height = 0;
    std::vector<float3> color;         ///< scene-linear times exposure; row 0 is the top row
    std::vector<float3> standardError; ///< of `color`, same unit
    RenderStatistics statistics;
};

struct RenderProgress {
    uint32_t samplesDone = 0, samplesTotal = 0; ///< per pixel
    double relativeError = 0;                   ///< 0: not known yet
    double seconds = 0;                         ///< since the start
};

/// After every pass, on the calling thread; false stops, and what is there is returned.
using Progress = std::function<bool(RenderProgress const&)>;

/// A scene ready to be traced: rays find surfaces, surfaces find materials. Immutable.
class TracedScene;
struct TracedSceneDeleter {
    void operator()(TracedScene const* scene) const;
};
using TracedScenePtr = std::unique_ptr<TracedScene const, TracedSceneDeleter>;

/// Fails: InvalidArgument for a missing model or picture and for lights that are not finite.
Result<TracedScenePtr> prepare(ReferenceScene const& scene, jobs::JobSystem& jobs);
/// One line each: what the scene holds and no ray can hit (lines, points), and what is left out of its materials.
std::vector<std::string> const& warnings(TracedScene const& scene);

Result<ReferenceImage> render(TracedScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
                              jobs::JobSystem& jobs, Progress const& progress = {});
/// prepare() and render().
Result<ReferenceImage> render(ReferenceScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
                              jobs::JobSystem& jobs, Progress const& progress = {});

} // namespace filament::reference
