// SPDX-License-Identifier: Apache-2.0
/// Reference: the image that the engine approximates, by Monte Carlo integration in double precision.
///   In      models, lights and an environment in the engine's formats; a camera; settings.
///   Out     scene-linear Rec. 709 times exposure, on the scale of the engine's RGBA16F target, and the standard error
///           of the mean of every pixel. Nothing is clamped: the estimate is unbiased except for `maxBounces`.
///   Thread  render(): any, several calls per TracedScene at once; works on the job system. The same bits for any
///           number of workers.
///   Memory  24 bytes per pixel and 48 per node of Film.h while it runs, 216 with 16 passes; for the scene about 200
///           bytes per triangle, and the models' images.
///   Fails   InvalidArgument in one line for settings outside their ranges; OutOfMemory from Embree.
///   Cost    README.md
#pragma once

#include "base/Result.h"
#include "filament_core/assets/gltf/ModelData.h"
#include "filament_core/assets/image/HdrImage.h"
#include "jobsystem/Cancellation.h"
#include "jobsystem/JobSystem.h"
#include "tools/reference/BsdfModel.h"
#include "tools/reference/LightPictures.h"
#include "tools/reference/LightProfiles.h"

#include <filament_core/Box.h>
#include <filament_core/Camera.h>
#include <filament_core/Effects.h>
#include <filament_core/Light.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::reference {

// ---- what is drawn

struct SurfaceSample;
/// Changes a material at every point of the model, for properties that its file cannot express. Called often, on any
/// thread.
using SurfaceFinish = std::function<void(SurfaceSample&)>;

struct ReferenceModel {
    std::shared_ptr<const assets::ModelData> data;
    double4x4 worldFromModel{ 1.0 };
    SurfaceFinish finish{};
};

/// An equirectangular image, oriented as in <filament_core/Environment.h>; interpolated bilinearly.
struct ReferenceEnvironment {
    std::shared_ptr<const assets::HdrImage> image;
    Lux illuminance{ 30'000 }; ///< illuminance that radiance 1 of the image stands for
    float rotationRadians = 0; ///< around +Y
    bool skybox = true;        ///< visible to the camera; it gives light in any case
};

struct ReferenceScene {
    std::vector<ReferenceModel> models;
    std::optional<ReferenceEnvironment> environment;
    std::vector<SunLight> suns;
    std::vector<PointLight> points;
    std::vector<SpotLight> spots;
    std::vector<RectLight> rects; ///< no ray sees them: they are lights, not surfaces
    std::vector<DiscLight> discs;
    std::vector<TubeLight> tubes;
    std::vector<ProfilePtr> pointProfiles, spotProfiles; ///< see LightSet
    std::vector<LightPicturePtr> sunImages, pointImages, spotImages, rectImages;
};

/// The image-based light of a model's file, for `image` of an environment; null: it names none. The irradiance is that
/// of the radiance: coefficients in the file are not read.
std::shared_ptr<const assets::HdrImage> pictureOfLight(assets::ModelData const& model, jobs::JobSystem& jobs);

/// Bounds of all parts, like the engine's Model::bounds(): for fitToUnitCube().
Box modelBounds(assets::ModelData const& model);

// ---- how it is drawn

struct ReferenceView {
    Camera camera{};
    uint2 size{ 640, 360 };
    float4 clearColor{ 0, 0, 0, 1 }; ///< as View::clearColor
    Fog fog{};                       ///< as Effects::fog; FogMedium.h
    double timeSeconds = 0;          ///< as View::timeSeconds, for its wind
};

enum class Integrator : uint8_t {
    Path,       ///< global illumination: visibility and all bounces
    Unoccluded, ///< one reflection of unoccluded light: the integral that image-based lighting approximates. With
    ///< ReferenceSettings::lightsCastShadows that of suns, points, spots and areas is occluded, as by shadow maps
};

/// Which technique finds the environment and glowing surfaces. Both have the same mean as each alone; the others exist
/// to test that.
enum class Sampling : uint8_t { Both, Bsdf, Light };

enum class PixelFilter : uint8_t {
    Box,    ///< the mean over the pixel
    Center, ///< the radiance at its centre: the point that a rasteriser without anti-aliasing shades
};

enum class Switch : uint8_t { Auto, Off, On };

struct ReferenceSettings {
    Integrator integrator = Integrator::Path;
    uint32_t samplesPerPixel = 256; ///< [1, 2^20]: rounded up to whole passes
    float relativeError = 0;        ///< > 0: stop when RenderStatistics::relativeError is below it
    uint32_t maxBounces =
            64; ///< [1, 4096] reflections, without transmissions; Russian roulette ends most paths much earlier
    uint32_t seed = 1;
    PixelFilter filter = PixelFilter::Box;
    Sampling sampling = Sampling::Both;
    BsdfModel bsdf{};
    bool lightsCastShadows = false; ///< of Unoccluded; Path always does
    bool coloredShadows =
            false; ///< of these lights: they pass straight through what transmits light, which else stops them
    /// > 0: Unoccluded dims indirect light by what lies within so many metres, with the engine's formula
    /// (AmbientOcclusion.h)
    double occlusionRadius = 0;
    uint32_t occlusionRays = 64;        ///< for that, each sample of a pixel; [1, 65536]
    bool occlusionBends = false;        ///< diffuse light comes from the mean open direction
    Switch occlusionMap = Switch::Auto; ///< Auto: used by Unoccluded, not by Path, which computes the real occlusion
};

// ---- what comes out

struct RenderStatistics {
    uint32_t samplesPerPixel = 0, passes = 0;
    /// Root mean square of the pixels' standard errors over the mean, both of luminance.
    double relativeError = 0;
    double meanLuminance = 0;
    uint64_t rays = 0;        ///< traced, shadow rays among them
    uint64_t lostSamples = 0; ///< not finite, counted as black: a defect to report, normally 0
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

/// Called after every pass on the calling thread; false stops the rendering, which returns the result so far.
using Progress = std::function<bool(RenderProgress const&)>;

/// A scene ready to be traced: rays find surfaces, surfaces find materials. Immutable.
class TracedScene;
struct TracedSceneDeleter {
    void operator()(TracedScene const* scene) const;
};
using TracedScenePtr = std::unique_ptr<TracedScene const, TracedSceneDeleter>;

/// Fails: InvalidArgument for a missing model or image, and for lights that are not finite.
Result<TracedScenePtr> prepare(ReferenceScene const& scene, jobs::JobSystem& jobs);
/// One line each for objects that no ray can hit (lines, points) and for unsupported parts of materials.
std::vector<std::string> const& warnings(TracedScene const& scene);

Result<ReferenceImage> render(TracedScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
                              jobs::JobSystem& jobs, Progress const& progress = {});
/// The same pass by pass, for a viewer: after the last pass the bits are those of render() with these settings, before
/// that those of render() that `progress` stopped there.
///   Thread  one at a time.   Life: `scene` must outlive it.
class ProgressiveRender {
public:
    /// Fails: as render().
    static Result<ProgressiveRender> start(TracedScene const& scene, ReferenceView const& view,
                                           ReferenceSettings const& settings);
    ProgressiveRender(ProgressiveRender&&) noexcept;
    ProgressiveRender& operator=(ProgressiveRender&&) noexcept;
    ~ProgressiveRender();

    /// False: `cancelled` was requested, which is asked before every pixel. What was done of the pass is then part of
    /// no image, and no pass may follow.
    bool runPass(jobs::JobSystem& jobs, jobs::Cancellation const* cancelled = nullptr);
    bool isFinished() const; ///< all samples are taken
    RenderProgress progress() const;
    /// After whole passes, at least one.
    ReferenceImage image() const;

private:
    struct Impl;
    explicit ProgressiveRender(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> mImpl;
};

/// prepare() and render().
Result<ReferenceImage> render(ReferenceScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
                              jobs::JobSystem& jobs, Progress const& progress = {});

} // namespace filament_core::reference
