// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/PathTracer.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/AmbientOcclusion.h"
#include "tools/reference/Material.h"
#include "tools/reference/Mixture.h"
#include "tools/reference/ScatteringMedium.h"

#include <algorithm>
#include <numbers>

namespace filament_core::reference {

namespace lib = shader::lib64;

namespace {

// Pairs of dimensions of the sample's numbers: pair 0 is the pixel's, then six per bounce; layers have their own.
enum BounceDimension : uint32_t { kChoices, kEnvironment, kReflection, kRoulette, kEmission, kSource, kPerBounce };
constexpr uint32_t kFirstBounce = 1, kFirstLayer = 1u << 20, kColor = 1u << 21, kMixture = 1u << 22,
                   kAreaPoint = 1u << 23, kOpenDirections = 1u << 24, kFlights = 1u << 25, kFog = 1u << 26,
                   kFogOpacity = 1u << 27, kFogToEvent = 1u << 28, kFogToLight = 1u << 29;

constexpr uint32_t kRouletteFrom = 4; // before this event, no path ends by roulette
constexpr uint32_t kMostFlights = 1u << 16, kScatterRouletteFrom = 8, kPairsOfFlight = 3;
constexpr uint32_t kMostEvents = 1u << 16; // limit of the dimensions of a path

double powerHeuristic(double pdf, double otherPdf) {
    const double a = pdf * pdf, b = otherPdf * otherPdf;
    return a > 0 ? a / (a + b) : 0;
}

// A shading normal must not carry light through a triangle: both normals must agree on whether it is transmitted.
bool isOnOneSide(SurfaceSample const& surface, double3 direction) {
    const bool isAbove = glm::dot(direction, surface.geometricNormal) > 0;
    if (!surface.transmits()) return isAbove;
    return isAbove == (glm::dot(direction, surface.normal) > 0);
}

} // namespace

struct PathTracer::Path {
    Ray ray;
    SampleStream const& numbers;
    uint64_t& rays;
    Hit hit{};
    bool isCamera = true;
    double3 throughput{ 1.0 };
    double bsdfPdf = 0;  // of the direction, after a reflection
    uint32_t bounce = 0; // reflections on either side of a surface
    uint32_t events = 0; // reflections, and crossings of surfaces
    uint32_t layers = 0;
    PassedTriangles passed{};
    int color = -1;                     // the only one it carries after dispersion
    double spread = 1;                  // index^2 of the medium, by which radiance there is larger
    bool isBehindGlass = false;         // no light was sampled where the ray began: straight crossing, or scattered
    std::optional<MediumSample> medium; // that it entered
    uint32_t flights = 0;               // through solids that scatter
    std::optional<SeenArea> area;       // that it ended at

    double2 pair(BounceDimension dimension) const {
        return numbers.pair(kFirstBounce + events * kPerBounce + dimension);
    }
};

PathTracer::PathTracer(TracedScene const& scene, ReferenceSettings const& settings, double exposure, double3 background,
                       FogMedium fog)
        : mScene(scene), mSettings(settings), mExposure(exposure), mBackground(background), mFog(fog),
          mUseOcclusion(settings.occlusionRadius > 0 || settings.occlusionMap == Switch::On ||
                        (settings.occlusionMap == Switch::Auto && settings.integrator == Integrator::Unoccluded)) {}

double3 PathTracer::radiance(Ray const& ray, SampleStream const& numbers, uint64_t& rays) const {
    Path path{ .ray = ray, .numbers = numbers, .rays = rays };
    const std::optional<SurfaceSample> first = nextSurface(path);
    // Of the light that reaches the camera: blended surfaces in front may have let only a part through.
    const double3 share = path.throughput;
    const bool isArea = path.area.has_value();
    const double distance = first    ? path.hit.distance
                            : isArea ? path.area->distance
                                     : std::numeric_limits<double>::infinity();
    const double3 light = follow(path, first);
    if (!first && !isArea && !mScene.skybox()) return light;
    const double3 seen = mFog.inFront(light, share, ray.direction, distance, { &numbers, kFogOpacity });
    return mFog.isLit() ? seen + share * scatteredByFog(path, ray, distance) : seen;
}

// As the light that a white Lambert surface reflects, which is the irradiance over pi.
Arriving PathTracer::arriving(ReceivingPoint const& point, LampLight lamps, SampleStream const& numbers,
                              uint64_t& rays) const {
    SurfaceSample surface;
    surface.position = point.position;
    surface.normal = surface.view = point.normal;
    surface.geometricNormal = point.geometricNormal;
    surface.diffuse = double3(1.0);
    surface.selfAvoidance = point.selfAvoidance;
    const Bsdf white(surface, { .coupling = CouplingTerm::Never, .lobes = LobeChoice::Diffuse }, false, false);
    Path path{ .numbers = numbers, .rays = rays };
    double3 sum(0.0);
    if (!mScene.environment().isBlack() && mSettings.sampling != Sampling::Bsdf)
        sum += environmentSample(path, surface, white) * mExposure;
    if (lamps == LampLight::Direct && !mScene.directLights().empty())
        sum += directSample(path, surface, white) * mExposure;
    sum += emissiveSample(path, surface, white);
    Arriving arriving;
    if (reflect(path, surface, white)) {
        const std::optional<SurfaceSample> first = nextSurface(path);
        arriving.fromSky = !first && !path.area;
        if (first) {
            Part const& part = mScene.part(path.hit);
            const bool isBack = glm::dot(faceNormal(part, path.hit.point.triangle), path.ray.direction) > 0;
            arriving.fromBehind = isBack && !part.material->doubleSided && !first->transmits();
            if (!first->transmits()) arriving.meters = path.hit.distance;
        }
        sum += follow(path, first);
    }
    arriving.irradiance = sum * std::numbers::pi;
    return arriving;
}

/// The light of one lamp at one point of the fog.
double3 PathTracer::scatteredByFog(Path& path, Ray const& camera, double distance) const {
    if (mScene.directLights().empty()) return double3(0.0);
    const double2 choice = path.numbers.pair(kFog);
    const FogMedium::Event event = mFog.sample(camera.direction, distance, choice.x, { &path.numbers, kFogToEvent });
    if (event.opacity <= 0) return double3(0.0);
    const double3 point = camera.origin + camera.direction * event.distance;
    const DirectSample lamp = mScene.directLights().sample(point, choice.y, path.numbers.pair(kFog + 1));
    const double arrives = mFog.shareOnTheWay(camera.direction * event.distance, lamp.direction, lamp.distance,
                                              { &path.numbers, kFogToLight });
    const double3 light =
            lamp.illuminance * mFog.phase(camera.direction, lamp.direction) * (event.opacity * arrives * mExposure);
    if (light == double3(0.0) || !lamp.castsShadows) return light;
    const bool hasShadows = mSettings.integrator != Integrator::Unoccluded || mSettings.lightsCastShadows;
    if (!hasShadows) return light;
    ++path.rays;
    const double3 towards = lamp.towardsPoint(path.numbers.pair(kFog + 2));
    return light * mScene.transmittance({ .origin = point, .direction = towards, .farthest = lamp.distance },
                                        mSettings.coloredShadows);
}

/// The light that comes from a surface, or from where none is.
double3 PathTracer::follow(Path& path, std::optional<SurfaceSample> surface) const {
    double3 sum(0.0);
    for (; surface; surface = nextSurface(path)) {
        if (!crossMedium(path, surface)) return sum;
        if (!surface) break;
        // Absorbed on the way here, whatever part of the surface is met: so before the choice of the part.
        if (surface->transmits()) enterSurface(path, *surface);
        if (surface->mixture) meetPart(*surface, path.numbers.pair(kMixture + path.events).x);
        // The film changes the f0 of the part that was met.
        coverWithFilm(*surface);
        if (mSettings.occlusionRadius > 0 && surface->scatters && surface->opacity >= 1)
            occludeAmbientLight(mScene, mSettings, path.numbers, kOpenDirections, *surface, path.rays);
        // Before the limit of bounces: what a surface emits is seen where a path ends, too.
        sum += path.throughput * surface->emitted * emissionWeight(path);
        if (!surface->scatters || path.bounce >= mSettings.maxBounces) return sum;
        const Bsdf bsdf = bsdfAt(*surface);
        sum += path.throughput * (lightAt(path, *surface, bsdf) + emissiveSample(path, *surface, bsdf));
        if (mSettings.integrator == Integrator::Unoccluded || !reflect(path, *surface, bsdf)) return sum;
    }
    return sum + path.throughput * missed(path);
}

/// Follows the path through a solid that scatters to the next surface. False: it ended inside.
bool PathTracer::crossMedium(Path& path, std::optional<SurfaceSample>& surface) const {
    const bool isInside = surface->medium && surface->medium->isFromInside;
    if (!isInside || mSettings.integrator == Integrator::Unoccluded) return true;
    // That of the point of entry: maps may give the exit another colour.
    const MediumSample medium = path.medium.value_or(*surface->medium);
    while (surface) {
        const uint32_t dimension = kFlights + path.flights++ * kPairsOfFlight;
        const Flight flight = sampleFlight(medium, path.throughput, path.hit.distance, path.numbers.pair(dimension));
        path.throughput *= flight.weight;
        if (!flight.scatters) return true;
        const double largest = std::max({ path.throughput.x, path.throughput.y, path.throughput.z }) * path.spread;
        if (!(largest > 0) || path.flights >= kMostFlights) return false;
        // Dark paths only: roulette at each of the many flights in a bright medium would add noise.
        if (path.flights > kScatterRouletteFrom && largest < 0.5) {
            if (path.numbers.pair(dimension + 1).x >= 2 * largest) return false;
            path.throughput /= 2 * largest;
        }
        path.ray = { .origin = path.ray.origin + path.ray.direction * flight.distance,
                     .direction = turned(path.ray.direction, medium.anisotropy, path.numbers.pair(dimension + 2)) };
        path.passed.count = 0;
        path.isCamera = false;
        path.isBehindGlass = true;
        surface = nextSurface(path);
    }
    return true;
}

/// Applies the absorption on the way to the inner side of a solid, and chooses the colour that continues.
void PathTracer::enterSurface(Path& path, SurfaceSample& surface) const {
    TransmissionSample& below = surface.transmission;
    if (below.isThin) return;
    if (below.isFromInside) {
        if (!surface.medium) path.throughput *= lib::transmittance(below.absorption, path.hit.distance);
        if (mSettings.bsdf.solidTint == SolidTint::Once) below.color = double3(below.share);
    }
    if (!(below.dispersion > 0) || mSettings.integrator == Integrator::Unoccluded) return;
    // One colour of three, with three times its weight. Once chosen it stays, because the three have parted.
    if (path.color < 0) {
        path.color = std::min(static_cast<int>(path.numbers.pair(kColor).x * 3), 2);
        double3 only(0.0);
        only[path.color] = 3;
        path.throughput *= only;
    }
    below.ior = lib::dispersedIor(below.ior, below.dispersion)[path.color];
}

Bsdf PathTracer::bsdfAt(SurfaceSample const& surface) const {
    return Bsdf(surface, mSettings.bsdf, mUseOcclusion, mSettings.integrator == Integrator::Unoccluded);
}

// The next surface on the path. Blended surfaces are chosen at random; a lamp's reflection may outshine a low opacity.
std::optional<SurfaceSample> PathTracer::nextSurface(Path& path) const {
    path.ray.passed = path.passed.count > 0 ? &path.passed : nullptr;
    while (true) {
        ++path.rays;
        const std::optional<Hit> hit = mScene.nearest(path.ray);
        path.area = mScene.directLights().seenArea(path.ray.origin, path.ray.direction, path.ray.nearest,
                                                   hit ? hit->distance : path.ray.farthest);
        if (!hit || path.area) return {};
        path.hit = *hit;
        SurfaceSample surface = surfaceAt(mScene.part(*hit), hit->point, -path.ray.direction);
        if (surface.opacity >= 1) return surface;

        const double chance = 0.1 + 0.9 * surface.opacity;
        if (path.numbers.pair(kFirstLayer + path.layers++).x < chance || path.passed.isFull()) {
            path.throughput *= surface.opacity / chance;
            return surface;
        }
        path.throughput *= (1 - surface.opacity) / (1 - chance);
        // The ray continues at the same distance and leaves out what it has passed by name: an offset could skip
        // another surface that lies right behind.
        path.passed.triangles[path.passed.count++] = { hit->part, hit->point.triangle };
        path.ray.passed = &path.passed;
        path.ray.nearest = hit->distance;
    }
}

double3 PathTracer::missed(Path const& path) const {
    EnvironmentLight const& environment = mScene.environment();
    // Where a light was sampled, the surface has the light of areas already.
    if (path.area) return path.isCamera || path.isBehindGlass ? path.area->luminance * mExposure : double3(0.0);
    if (path.isCamera) {
        const double3 discs = mScene.directLights().discsIn(path.ray.direction) * mExposure;
        return discs + (mScene.skybox() ? environment.radiance(path.ray.direction) * mExposure : mBackground);
    }
    if (environment.isBlack()) return double3(0.0);
    const double weight = path.isBehindGlass ? 1 : environmentWeight(path.bsdfPdf, path.ray.direction);
    return weight > 0 ? environment.radiance(path.ray.direction) * (mExposure * weight) : double3(0.0);
}

/// Weight of the environment if the BSDF's sample finds it.
double PathTracer::environmentWeight(double bsdfPdf, double3 direction) const {
    switch (mSettings.sampling) {
    case Sampling::Bsdf:
        return 1;
    case Sampling::Light:
        return 0;
    case Sampling::Both:
        break;
    }
    return powerHeuristic(bsdfPdf, mScene.environment().pdf(direction));
}

double3 PathTracer::lightAt(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const {
    double3 sum(0.0);
    if (!mScene.environment().isBlack()) {
        if (mSettings.sampling != Sampling::Bsdf) sum += environmentSample(path, surface, bsdf);
        if (mSettings.integrator == Integrator::Unoccluded) sum += unoccludedBsdfSample(path, bsdf);
        const double3 open = mUseOcclusion && surface.bentNormal ? *surface.bentNormal : surface.normal;
        sum += bsdf.harmonicAlbedo() * mScene.environment().harmonicIrradiance(open);
    }
    if (!mScene.directLights().empty()) sum += directSample(path, surface, bsdf);
    return sum * mExposure;
}

double3 PathTracer::environmentSample(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const {
    const EnvironmentSample sample = mScene.environment().sample(path.pair(kEnvironment));
    const double3 reflected = bsdf.evaluate(sample.direction, LightSource::Ambient) * sample.radiance;
    if (reflected == double3(0.0)) return reflected;
    const double share = visibility(path, surface, sample.direction, std::numeric_limits<double>::infinity());
    if (share == 0) return double3(0.0);
    const double weight =
            mSettings.sampling == Sampling::Light ? 1 : powerHeuristic(sample.pdf, bsdf.pdf(sample.direction));
    return reflected * (share * weight / sample.pdf);
}

/// Weight of a glowing surface that a reflected path hits; emissiveSample() accounts for the rest.
double PathTracer::emissionWeight(Path const& path) const {
    if (path.isCamera || path.isBehindGlass || mSettings.sampling == Sampling::Bsdf) return 1;
    const double pdf = mScene.emissiveLights().pdf(path.hit, path.ray.direction);
    if (mSettings.sampling == Sampling::Light) return pdf > 0 ? 0 : 1;
    return powerHeuristic(path.bsdfPdf, pdf);
}

double3 PathTracer::emissiveSample(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const {
    EmissiveLights const& lights = mScene.emissiveLights();
    const bool isOn = mSettings.integrator == Integrator::Path && mSettings.sampling != Sampling::Bsdf;
    if (lights.empty() || !isOn) return double3(0.0);
    // The triangle is chosen by the second number of the roulette's pair, which roulette does not use.
    const EmissiveSample sample = lights.sample(surface.position, path.pair(kEmission), path.pair(kRoulette).y);
    if (!(sample.pdf > 0)) return double3(0.0);
    const double3 reflected = bsdf.evaluate(sample.direction, LightSource::Ambient) * sample.radiance;
    if (reflected == double3(0.0)) return reflected;
    // Stop before the light itself.
    const double farthest = sample.distance - std::max(sample.distance * 1e-5, 2 * surface.selfAvoidance);
    if (farthest <= 0) return double3(0.0);
    const double share = visibility(path, surface, sample.direction, farthest);
    const double weight =
            mSettings.sampling == Sampling::Light ? 1 : powerHeuristic(sample.pdf, bsdf.pdf(sample.direction));
    return reflected * (share * weight / sample.pdf);
}

double3 PathTracer::directSample(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const {
    const DirectSample sample = mScene.directLights().sample(surface.position, path.pair(kChoices).x,
                                                             path.numbers.pair(kAreaPoint + path.events));
    const double3 reflected = bsdf.evaluate(sample.direction, LightSource::Direct) * sample.illuminance;
    if (reflected == double3(0.0)) return reflected;
    const bool isOpen =
            !sample.castsShadows || (mSettings.integrator == Integrator::Unoccluded && !mSettings.lightsCastShadows);
    if (isOpen) return reflected;
    return reflected * tracedVisibility(path, surface, sample.towardsPoint(path.pair(kSource)), sample.distance,
                                        mSettings.coloredShadows);
}

double3 PathTracer::unoccludedBsdfSample(Path const& path, Bsdf const& bsdf) const {
    if (mSettings.sampling == Sampling::Light) return double3(0.0);
    const BsdfSample sample = bsdf.sample(path.pair(kReflection), path.pair(kChoices).y);
    if (sample.pdf <= 0 || sample.isStraight) return double3(0.0);
    const double weight = environmentWeight(sample.pdf, sample.direction);
    return bsdf.evaluate(sample.direction, LightSource::Ambient) * mScene.environment().radiance(sample.direction) *
           (weight / sample.pdf);
}

double PathTracer::visibility(Path& path, SurfaceSample const& surface, double3 direction, double distance) const {
    if (mSettings.integrator == Integrator::Unoccluded) return 1;
    return tracedVisibility(path, surface, direction, distance, false).x;
}

double3 PathTracer::tracedVisibility(Path& path, SurfaceSample const& surface, double3 direction, double distance,
                                     bool throughGlass) const {
    if (!isOnOneSide(surface, direction)) return double3(0.0);
    ++path.rays;
    return mScene.transmittance(
            { .origin = surface.rayOrigin(direction), .direction = direction, .farthest = distance }, throughGlass);
}

bool PathTracer::reflect(Path& path, SurfaceSample const& surface, Bsdf const& bsdf) const {
    const BsdfSample sample = bsdf.sample(path.pair(kReflection), path.pair(kChoices).y);
    if (sample.pdf <= 0 || !(sample.isStraight || isOnOneSide(surface, sample.direction))) return false;
    const double3 share =
            sample.isStraight ? bsdf.straightShare() : bsdf.evaluate(sample.direction, LightSource::Ambient);
    path.throughput *= share / sample.pdf;
    const double largest = std::max({ path.throughput.x, path.throughput.y, path.throughput.z });
    if (!(largest > 0)) return false;
    const bool entersOrLeaves = !surface.transmission.isThin && glm::dot(sample.direction, surface.geometricNormal) < 0;
    if (entersOrLeaves) path.spread = surface.transmission.isFromInside ? 1 : lib::sq(surface.transmission.ior);
    // Roulette by what the path would carry outside: inside of glass radiance is scaled by the squared index, which
    // says nothing of its worth (Pharr, Jakob, Humphreys 2023, sections 9.5.2 and 13.4).
    if (path.events >= kRouletteFrom && largest * path.spread < 1) {
        const double survival = std::min(largest * path.spread, 0.95);
        if (path.pair(kRoulette).x >= survival) return false;
        path.throughput /= survival;
    }
    path.passed.count = 0;
    const bool goesThrough = sample.isStraight || glm::dot(sample.direction, surface.geometricNormal) < 0;
    if (!goesThrough) ++path.bounce;
    if (goesThrough) {
        path.medium = surface.medium;
        if (surface.medium && surface.medium->isFromInside) path.medium.reset();
    }
    if (++path.events >= kMostEvents) return false;
    if (sample.isStraight) {
        path.isBehindGlass = true;
        path.ray = { .origin = surface.rayOrigin(path.ray.direction), .direction = path.ray.direction };
        return true;
    }
    path.ray = { .origin = surface.rayOrigin(sample.direction), .direction = sample.direction };
    path.isCamera = path.isBehindGlass = false;
    path.bsdfPdf = sample.pdf;
    return true;
}

} // namespace filament_core::reference
