// SPDX-License-Identifier: Apache-2.0
#include "base/Assert.h"
#include "tools/reference/PartialFilm.h"
#include "tools/reference/PathTracer.h"
#include "tools/reference/Reference.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

namespace filament_core::reference {
namespace {

constexpr uint32_t kMaxSide = 16384, kMaxSamples = 1u << 20, kMaxBounces = 4096;
constexpr uint32_t kPassesBeforeStop = 4; // before an error estimate may stop the rendering
constexpr size_t kPixelsPerJob = 32;

Result<void> check(ReferenceView const& view, ReferenceSettings const& settings) {
    const auto refuse = [](const char* what, auto value, const char* cure) {
        return Result<void>(fail(ErrorCode::InvalidArgument, "{} {}: give {}", what, value, cure));
    };
    if (view.size.x < 1 || view.size.x > kMaxSide) return refuse("width", view.size.x, "1 to 16384 pixels");
    if (view.size.y < 1 || view.size.y > kMaxSide) return refuse("height", view.size.y, "1 to 16384 pixels");
    if (settings.samplesPerPixel < 1 || settings.samplesPerPixel > kMaxSamples) {
        return refuse("samples per pixel", settings.samplesPerPixel, "1 to 1048576");
    }
    if (settings.maxBounces < 1 || settings.maxBounces > kMaxBounces) {
        return refuse("most bounces", settings.maxBounces, "1 to 4096");
    }
    if (!(settings.relativeError >= 0) || settings.relativeError > 1) {
        return refuse("relative error", settings.relativeError, "a number from 0 to 1");
    }
    if (!(settings.occlusionRadius >= 0) || !std::isfinite(settings.occlusionRadius))
        return refuse("occlusion radius", settings.occlusionRadius, "metres, 0 for none");
    if (settings.occlusionRadius > 0 && settings.integrator == Integrator::Path)
        return refuse("occlusion radius", "with paths, which find all occlusion", "the integrator unoccluded");
    if (settings.occlusionRays < 1 || settings.occlusionRays > 65536)
        return refuse("occlusion rays", settings.occlusionRays, "1 to 65536");
    BsdfModel const& bsdf = settings.bsdf;
    const bool isPrefiltered =
            bsdf.specularLight == SpecularLight::SplitSum || bsdf.diffuseLight == DiffuseLight::Harmonics;
    if (isPrefiltered && settings.integrator == Integrator::Path)
        return refuse("pre-filtered light", "under shadows", "the integrator unoccluded");
    if (bsdf.diffuseLight == DiffuseLight::Harmonics && bsdf.diffuse != DiffuseTerm::Lambert)
        return refuse("harmonics", "for a diffuse lobe of Disney", "Lambert's");
    const float fov = view.camera.lens.verticalFovDegrees, factor = view.camera.exposure.factor();
    if (!(fov > 0 && fov < 180)) return refuse("vertical field of view", fov, "degrees between 0 and 180");
    if (!(factor > 0) || !std::isfinite(factor)) return refuse("exposure factor", factor, "a usable exposure");
    return {};
}

/// For a part of an image, whose view and settings were checked.
Result<void> checkRegion(FilmRegion const& region, uint2 size, PassPlan const& plan) {
    const FilmRegion picture{ { 0, 0 }, size, { 0, plan.passes } };
    const bool isEmpty = region.size.x == 0 || region.size.y == 0 || region.passes.count == 0;
    if (isEmpty || intersection(region, picture) != region)
        return fail(ErrorCode::InvalidArgument, "{} are not in the picture: it has {}", toString(region),
                    toString(picture));
    const uint64_t pixels = uint64_t(region.size.x) * region.size.y;
    if (pixels * sizeof(PixelSums) * nodesOf(region.passes).size() > kMaxPartBytes)
        return fail(ErrorCode::InvalidArgument, "{}: too large for one file; give smaller tiles", toString(region));
    return {};
}

/// Camera rays, as Camera::clipFromView() would unproject them, in double precision.
class Lens {
public:
    Lens(ReferenceView const& view, double3 sceneOrigin)
            : mOrigin(view.camera.position() - sceneOrigin), mWorldFromView(view.camera.worldFromView),
              mSize(view.size), mNear(double(view.camera.lens.nearMeters)),
              mTangent(std::tan(glm::radians(double(view.camera.lens.verticalFovDegrees)) / 2)) {}

    /// Pixel coordinates: (0, 0) is the upper left corner of the image.
    Ray rayThrough(double2 point) const {
        const double aspect = double(mSize.x) / mSize.y;
        const double3 view(mTangent * aspect * (2 * point.x / mSize.x - 1), mTangent * (1 - 2 * point.y / mSize.y), -1);
        const double length = glm::length(view);
        return { .origin = mOrigin,
                 .direction = glm::normalize(mWorldFromView * view),
                 .nearest = mNear * length, // the near plane is perpendicular to the view, not to the ray
                 .skipsBackFaces = true };
    }

private:
    double3 mOrigin;
    double3x3 mWorldFromView;
    uint2 mSize;
    double mNear, mTangent;
};

FogMedium fogOf(TracedScene const& scene, ReferenceView const& view) {
    const auto exposure = double(view.camera.exposure.factor());
    const double lux = scene.environmentLux();
    return { view.fog,
             view.camera.position().y,
             { lux > 0 ? lux * exposure : 1.0, exposure, scene.suns(), &scene.environment() },
             view.camera.position() - double3(view.fog.noiseWind) * view.timeSeconds };
}

bool isFinite(double3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// One image while it is made.
class Rendering {
public:
    /// All of it.
    Rendering(TracedScene const& scene, ReferenceView const& view, ReferenceSettings const& settings)
            : Rendering(scene, view, settings, { { 0, 0 }, view.size, { 0, planOf(settings).passes } }) {}
    Rendering(TracedScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
              FilmRegion const& region)
            : mSettings(settings), mPlan(planOf(settings)), mRegion(region), mWidth(view.size.x),
              mFilm(region.size.x, region.size.y, region.passes.first), mLens(view, scene.origin()),
              mTracer(scene, mSettings, double(view.camera.exposure.factor()), double3(view.clearColor),
                      fogOf(scene, view)) {}

    bool isFinished() const { return mFilm.passes().count >= mRegion.passes.count; }

    bool runPass(jobs::JobSystem& jobs, jobs::Cancellation const* cancelled) {
        const auto isCancelled = [cancelled] { return cancelled && cancelled->isRequested(); };
        const size_t pixels = size_t(mFilm.width()) * mFilm.height();
        mFilm.beginPass();
        jobs::parallelFor<"pixels">(jobs, pixels, kPixelsPerJob, [&](size_t begin, size_t end) {
            uint64_t rays = 0, lost = 0;
            for (size_t pixel = begin; pixel < end && !isCancelled(); ++pixel)
                mFilm.add(pixel, meanOf(pixel, rays, lost));
            mRays += rays;
            mLost += lost;
        });
        if (isCancelled()) return false;
        mFilm.finishPass();
        mFilm.measure(mStatistics);
        return true;
    }

    RenderStatistics const& statistics() const { return mStatistics; }
    uint32_t samplesDone() const { return mFilm.passes().count * mPlan.samplesPerPass; }
    uint32_t samplesTotal() const { return mRegion.passes.count * mPlan.samplesPerPass; }

    ReferenceImage finish(double seconds) const {
        ReferenceImage image;
        mFilm.develop(image);
        image.statistics.samplesPerPixel = samplesDone();
        image.statistics.rays = mRays;
        image.statistics.lostSamples = mLost;
        image.statistics.seconds = seconds;
        return image;
    }

    /// Ends the rendering.
    PartialFilm takePart(double seconds) {
        FilmRegion done = mRegion;
        done.passes = mFilm.passes();
        return { done, mFilm.takeNodes(), mRays, mLost, seconds };
    }

private:
    /// `index` is that of the film; the noise is that of the pixel in the image.
    double3 meanOf(size_t index, uint64_t& rays, uint64_t& lost) const {
        const size_t x = mRegion.offset.x + index % mFilm.width(), y = mRegion.offset.y + index / mFilm.width();
        const uint64_t stream = hashOf(hashOf(mSettings.seed, mFilm.passes().end()), y * mWidth + x);
        const double2 corner(static_cast<double>(x), static_cast<double>(y));
        double3 sum(0.0);
        for (uint32_t i = 0; i < mPlan.samplesPerPass; ++i) {
            const SampleStream numbers(stream, i);
            const double2 inside = mSettings.filter == PixelFilter::Box ? numbers.pair(0) : double2(0.5);
            const double3 radiance = mTracer.radiance(mLens.rayThrough(corner + inside), numbers, rays);
            if (isFinite(radiance))
                sum += radiance;
            else
                ++lost;
        }
        return sum / double(mPlan.samplesPerPass);
    }

    ReferenceSettings mSettings;
    PassPlan mPlan;
    FilmRegion mRegion;
    size_t mWidth; // of the image
    Film mFilm;
    Lens mLens;
    PathTracer mTracer;
    RenderStatistics mStatistics;
    std::atomic<uint64_t> mRays{ 0 }, mLost{ 0 };
};

} // namespace

struct ProgressiveRender::Impl {
    Impl(TracedScene const& scene, ReferenceView const& view, ReferenceSettings const& settings)
            : rendering(scene, view, settings) {}

    Rendering rendering;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    bool isCancelled = false;

    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
};

ProgressiveRender::ProgressiveRender(std::unique_ptr<Impl> impl) : mImpl(std::move(impl)) {}
ProgressiveRender::ProgressiveRender(ProgressiveRender&&) noexcept = default;
ProgressiveRender& ProgressiveRender::operator=(ProgressiveRender&&) noexcept = default;
ProgressiveRender::~ProgressiveRender() = default;

Result<ProgressiveRender> ProgressiveRender::start(TracedScene const& scene, ReferenceView const& view,
                                                   ReferenceSettings const& settings) {
    if (const Result<void> checked = check(view, settings); !checked) return checked.error();
    return ProgressiveRender(std::make_unique<Impl>(scene, view, settings));
}

bool ProgressiveRender::runPass(jobs::JobSystem& jobs, jobs::Cancellation const* cancelled) {
    FILAMENT_ASSERT(!mImpl->isCancelled && !isFinished(), "no pass follows the last one or one that was cancelled");
    mImpl->isCancelled = !mImpl->rendering.runPass(jobs, cancelled);
    return !mImpl->isCancelled;
}

bool ProgressiveRender::isFinished() const { return mImpl->rendering.isFinished(); }

RenderProgress ProgressiveRender::progress() const {
    Rendering const& rendering = mImpl->rendering;
    return { rendering.samplesDone(), rendering.samplesTotal(), rendering.statistics().relativeError,
             mImpl->seconds() };
}

ReferenceImage ProgressiveRender::image() const {
    FILAMENT_ASSERT(!mImpl->isCancelled && mImpl->rendering.samplesDone() > 0, "a picture has whole passes");
    return mImpl->rendering.finish(mImpl->seconds());
}

Result<ReferenceImage> render(TracedScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
                              jobs::JobSystem& jobs, Progress const& progress) {
    Result<ProgressiveRender> rendering = ProgressiveRender::start(scene, view, settings);
    if (!rendering) return rendering.error();
    for (uint32_t pass = 1; !rendering->isFinished(); ++pass) {
        rendering->runPass(jobs);
        const RenderProgress now = rendering->progress();
        const bool goesOn = !progress || progress(now);
        const bool isGood = pass >= kPassesBeforeStop && now.relativeError <= double(settings.relativeError);
        if (!goesOn || (settings.relativeError > 0 && isGood)) break;
    }
    return rendering->image();
}

Result<PartialFilm> renderPart(TracedScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
                               FilmRegion const& region, jobs::JobSystem& jobs, Progress const& progress) {
    if (const Result<void> checked = check(view, settings); !checked) return checked.error();
    if (const Result<void> checked = checkRegion(region, view.size, planOf(settings)); !checked) return checked.error();
    FILAMENT_ASSERT(settings.relativeError == 0, "a part has no error of the picture");
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [start] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    Rendering rendering(scene, view, settings, region);
    for (bool goesOn = true; goesOn && !rendering.isFinished();) {
        rendering.runPass(jobs, nullptr);
        goesOn = !progress || progress({ rendering.samplesDone(), rendering.samplesTotal(),
                                         rendering.statistics().relativeError, seconds() });
    }
    return rendering.takePart(seconds());
}

Result<ReferenceImage> render(ReferenceScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
                              jobs::JobSystem& jobs, Progress const& progress) {
    const Result<TracedScenePtr> traced = prepare(scene, jobs);
    if (!traced) return traced.error();
    return render(**traced, view, settings, jobs, progress);
}

} // namespace filament_core::reference
