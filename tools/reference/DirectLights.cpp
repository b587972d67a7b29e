// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/DirectLights.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/Microfacets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

double inverseSquare(float range) { return range > 0 ? 1 / (double(range) * range) : 0; }

// Across a unit direction, nearest to `side`.
double3 across(double3 direction, double3 side) {
    const double3 part = side - direction * glm::dot(side, direction);
    if (glm::dot(part, part) > 1e-12 * glm::dot(side, side) && glm::dot(side, side) > 0) return glm::normalize(part);
    return across(direction, std::abs(direction.x) < 0.7 ? double3(1, 0, 0) : double3(0, 1, 0));
}

} // namespace

double3 DirectSample::towardsPoint(double2 u) const {
    if (radius <= 0) return direction;
    const double azimuth = 2 * std::numbers::pi * u.x, away = radius * std::sqrt(u.y);
    const Frame frame(direction);
    return glm::normalize(direction + (frame.tangent * std::cos(azimuth) + frame.bitangent * std::sin(azimuth)) * away);
}

template <class AreaLight>
DirectLights::Light DirectLights::areaOf(AreaLight const& area, double factor) {
    return { .position = area.positionWorld,
             .intensity = double3(area.color) * (double(area.luminance.value) * factor),
             .inverseSquaredRange = inverseSquare(area.rangeMeters),
             .castsShadows = area.castsShadows,
             .isVisible = area.isVisible };
}

void DirectLights::add(RectLight const& rect, double factor) {
    Light light = areaOf(rect, factor);
    light.shape = Light::Shape::Rect;
    light.axis = glm::normalize(double3(rect.directionWorld));
    const double3 up = across(light.axis, double3(rect.upWorld));
    light.halfX = glm::cross(light.axis, up) * (rect.widthMeters * 0.5);
    light.halfY = up * (rect.heightMeters * 0.5);
    light.isTwoSided = rect.isTwoSided;
    light.area = double(rect.widthMeters) * rect.heightMeters;
    mLights.push_back(light);
}

void DirectLights::add(DiscLight const& disc, double factor) {
    Light light = areaOf(disc, factor);
    light.shape = Light::Shape::Disc;
    light.axis = glm::normalize(double3(disc.directionWorld));
    light.halfX = across(light.axis, double3(0.0)) * double(disc.radiusMeters);
    light.halfY = glm::cross(light.halfX, light.axis);
    light.isTwoSided = disc.isTwoSided;
    light.area = lib::kPi * double(disc.radiusMeters) * disc.radiusMeters;
    mLights.push_back(light);
}

void DirectLights::add(TubeLight const& tube, double factor) {
    Light light = areaOf(tube, factor);
    light.shape = Light::Shape::Tube;
    light.axis = glm::normalize(double3(tube.axisWorld));
    light.halfX = light.axis * (tube.lengthMeters * 0.5);
    light.halfY = across(light.axis, double3(0.0));
    light.radius = tube.radiusMeters;
    light.area = lib::kTwoPi * light.radius * tube.lengthMeters;
    mLights.push_back(light);
}

void DirectLights::setProfile(Light& light, std::vector<ProfilePtr> const& profiles, size_t index, float3 direction,
                              float3 up) {
    if (index >= profiles.size() || !profiles[index]) return;
    light.profile = profiles[index];
    light.axis = glm::normalize(double3(direction));
    light.profileX = glm::cross(light.axis, across(light.axis, double3(up)));
}

void DirectLights::setImage(Light& light, std::vector<LightPicturePtr> const& images, size_t index, float3 direction,
                            float3 up) {
    if (index >= images.size() || !images[index]) return;
    light.image = images[index];
    light.axis = glm::normalize(double3(direction));
    light.imageRight = glm::cross(light.axis, across(light.axis, double3(up)));
    light.imageDown = glm::cross(light.axis, light.imageRight);
}

/// By its image, at a point.
double3 DirectLights::colorOf(Light const& light, double3 position) {
    if (!light.image) return double3(1.0);
    const double3 from = position - light.position;
    const double2 at(glm::dot(from, light.imageRight), glm::dot(from, light.imageDown));
    if (light.isSun) return light.image->at(at + light.imageOffset);
    const double forward = glm::dot(from, light.axis);
    if (!light.isSpot) return light.image->towards({ at.x, at.y, forward });
    if (forward <= 0) return double3(0.0);
    const double2 place = at / forward + 0.5;
    const bool isInside =
            glm::all(glm::greaterThanEqual(place, double2(0.0))) && glm::all(glm::lessThanEqual(place, double2(1.0)));
    return isInside ? light.image->at(place) : double3(0.0);
}

/// Of its intensity, in a unit direction from the light.
double DirectLights::shareOf(Light const& light, double3 away) {
    if (!light.profile) return 1;
    const double3 y = glm::cross(light.profileX, light.axis);
    const double3 local(glm::dot(away, light.profileX), glm::dot(away, y), -glm::dot(away, light.axis));
    return light.profile->candelasAt(local) / double{ light.profile->peak };
}

DirectLights::DirectLights(LightSet const& lights, double factor) {
    const auto scaled = [&](LinearColor color, float value) { return double3(color) * (double(value) * factor); };
    for (size_t i = 0; i < lights.suns.size(); ++i) {
        SunLight const& sun = lights.suns[i];
        mLights.push_back({ .isSun = true,
                            .axis = glm::normalize(double3(sun.directionWorld)),
                            .intensity = scaled(sun.color, sun.illuminance.value),
                            .radius = std::tan(glm::radians(double(sun.angularRadiusDegrees))),
                            .castsShadows = sun.castsShadows,
                            .showsDisc = sun.showsDisc,
                            .haloSize = sun.haloSize,
                            .haloFalloff = sun.haloFalloff });
        setImage(mLights.back(), lights.sunImages, i, sun.directionWorld, sun.upWorld);
        if (!mLights.back().image) continue;
        Light& light = mLights.back();
        const double2 meters = double(sun.cookieMeters) * double2(1, light.image->aspect());
        light.imageRight /= meters.x, light.imageDown /= meters.y;
        light.imageOffset =
                double2(glm::dot(lights.origin, light.imageRight), glm::dot(lights.origin, light.imageDown)) -
                double2(sun.cookieOffsetMeters) / meters;
    }
    for (size_t i = 0; i < lights.points.size(); ++i) {
        PointLight const& point = lights.points[i];
        mLights.push_back({ .position = point.positionWorld,
                            .intensity = scaled(point.color, point.intensity.value),
                            .inverseSquaredRange = inverseSquare(point.rangeMeters),
                            .radius = point.sourceRadiusMeters,
                            .castsShadows = point.castsShadows });
        setProfile(mLights.back(), lights.pointProfiles, i, point.directionWorld, point.upWorld);
        setImage(mLights.back(), lights.pointImages, i, point.directionWorld, point.upWorld);
    }
    for (size_t i = 0; i < lights.spots.size(); ++i) {
        SpotLight const& spot = lights.spots[i];
        // KHR_lights_punctual, with the engine's minimum difference of the cosines.
        const double cosOuter = std::cos(double(spot.outerConeRadians));
        const double cosInner = std::cos(std::min<double>(spot.innerConeRadians, spot.outerConeRadians));
        const double scale = 1 / std::max(1e-3, cosInner - cosOuter);
        mLights.push_back({ .isSpot = true,
                            .position = spot.positionWorld,
                            .axis = glm::normalize(double3(spot.directionWorld)),
                            .intensity = scaled(spot.color, spot.intensity.value),
                            .inverseSquaredRange = inverseSquare(spot.rangeMeters),
                            .spotScale = scale,
                            .spotOffset = -cosOuter * scale,
                            .radius = spot.sourceRadiusMeters,
                            .castsShadows = spot.castsShadows });
        setProfile(mLights.back(), lights.spotProfiles, i, spot.directionWorld, spot.upWorld);
        setImage(mLights.back(), lights.spotImages, i, spot.directionWorld, spot.upWorld);
        if (!mLights.back().image) continue;
        // The shorter side touches the cone.
        const double width = 2 * std::tan(std::min<double>(spot.outerConeRadians, glm::radians(80.0)));
        const double aspect = mLights.back().image->aspect();
        mLights.back().imageRight /= width * std::max(1 / aspect, 1.0);
        mLights.back().imageDown /= width * std::max(aspect, 1.0);
    }
    for (size_t i = 0; i < lights.rects.size(); ++i) {
        add(lights.rects[i], factor);
        if (i < lights.rectImages.size()) mLights.back().image = lights.rectImages[i];
    }
    for (DiscLight const& disc : lights.discs) add(disc, factor);
    for (TubeLight const& tube : lights.tubes) add(tube, factor);
    mHasVisible = std::ranges::any_of(mLights, &Light::isVisible);
}

/// Along a ray to a side that shines; infinite: it meets none.
double DirectLights::distanceTo(Light const& light, double3 origin, double3 direction) {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const double3 from = origin - light.position;
    if (light.shape == Light::Shape::Tube) { // from outside: the first of two
        const double3 across = direction - light.axis * glm::dot(direction, light.axis);
        const double3 offset = from - light.axis * glm::dot(from, light.axis);
        const double a = glm::dot(across, across), b = glm::dot(offset, across);
        const double root = b * b - a * (glm::dot(offset, offset) - light.radius * light.radius);
        if (!(a > 0) || root < 0) return kNowhere;
        const double distance = (-b - std::sqrt(root)) / a;
        const double along = glm::dot(from + direction * distance, light.axis);
        return std::abs(along) <= glm::length(light.halfX) ? distance : kNowhere;
    }
    const double facing = -glm::dot(direction, light.axis);
    if (facing == 0 || (facing < 0 && !light.isTwoSided)) return kNowhere;
    const double distance = glm::dot(from, light.axis) / facing;
    const double3 at = from + direction * distance;
    const double x = glm::dot(at, light.halfX) / glm::dot(light.halfX, light.halfX);
    const double y = glm::dot(at, light.halfY) / glm::dot(light.halfY, light.halfY);
    const bool isInside = light.shape == Light::Shape::Disc ? x * x + y * y <= 1 : std::abs(x) <= 1 && std::abs(y) <= 1;
    return isInside ? distance : kNowhere;
}

/// Of the image of a rectangle, at a point of it.
double3 DirectLights::shownBy(Light const& light, double3 at) {
    if (!light.image) return double3(1.0);
    const double3 from = at - light.position;
    const double2 place(glm::dot(from, light.halfX) / glm::dot(light.halfX, light.halfX),
                        glm::dot(from, light.halfY) / glm::dot(light.halfY, light.halfY));
    return light.image->at(0.5 - 0.5 * place);
}

std::optional<SeenArea> DirectLights::seenArea(double3 origin, double3 direction, double nearest,
                                               double farthest) const {
    std::optional<SeenArea> seen;
    if (!mHasVisible) return seen;
    for (Light const& light : mLights) {
        if (!light.isVisible) continue;
        const double distance = distanceTo(light, origin, direction);
        if (distance > nearest && distance < (seen ? seen->distance : farthest))
            seen = SeenArea{ distance, light.intensity * shownBy(light, origin + direction * distance) };
    }
    return seen;
}

double3 DirectLights::discsIn(double3 direction) const {
    constexpr double kSmallestRadius = 1.745329252e-5; // the engine's: 0.001 degrees
    double3 sum(0.0);
    for (Light const& light : mLights) {
        if (!light.showsDisc) continue;
        const double radius = std::atan(std::max(light.radius, kSmallestRadius));
        const double outer = std::min(radius * light.haloSize, double{ lib::kPi });
        const double aside = glm::length(glm::cross(direction, light.axis));
        const double angle = std::atan2(aside, -glm::dot(direction, light.axis));
        double share = angle <= radius ? 1 : 0;
        if (angle > radius && angle < outer)
            share = std::pow((std::cos(angle) - std::cos(outer)) / (std::cos(radius) - std::cos(outer)),
                             light.haloFalloff);
        sum += light.intensity * (share / (lib::kPi * std::sin(radius) * std::sin(radius)));
    }
    return sum;
}

DirectLights::Emitter DirectLights::emitterAt(Light const& light, double2 u) {
    if (light.shape == Light::Shape::Tube) {
        const double turn = lib::kTwoPi * u.y;
        const double3 normal = std::cos(turn) * light.halfY + std::sin(turn) * glm::cross(light.axis, light.halfY);
        return { light.position + light.halfX * (2 * u.x - 1) + normal * light.radius, normal };
    }
    double2 at = u * 2.0 - 1.0;
    if (light.shape == Light::Shape::Disc)
        at = std::sqrt(u.x) * double2(std::cos(lib::kTwoPi * u.y), std::sin(lib::kTwoPi * u.y));
    return { light.position + light.halfX * at.x + light.halfY * at.y, light.axis };
}

/// The lux of one point of the area that stands for all of it: nits times the cosine over the squared distance, divided
/// by its density, one over the area.
DirectSample DirectLights::arrivingFromArea(Light const& light, double3 position, double2 u) {
    const Emitter emitter = emitterAt(light, u);
    const double3 toLight = emitter.position - position;
    const double distance = glm::length(toLight);
    if (!(distance > 0)) return {};
    const double3 direction = toLight / distance;
    const double facing = -glm::dot(direction, emitter.normal);
    const double cosine = light.isTwoSided ? std::abs(facing) : std::max(facing, 0.0);
    const double window = lib::rangeWindow(light.position - position, light.inverseSquaredRange);
    const double3 emitted = light.image ? light.image->at(double2(1.0) - u) : double3(1.0); // seen from its front
    return { .direction = direction,
             .illuminance = light.intensity * emitted * (cosine * window * light.area / (distance * distance)),
             .distance = distance,
             .castsShadows = light.castsShadows };
}

/// For the choice among lights: more than 0 wherever the light shines.
double DirectLights::weightOf(Light const& light, double3 position) {
    if (light.shape == Light::Shape::None) return lib::luminance(arriving(light, position, {}).illuminance);
    const double3 toLight = light.position - position;
    const bool isBehind = light.shape != Light::Shape::Tube && !light.isTwoSided && glm::dot(toLight, light.axis) >= 0;
    if (isBehind) return 0;
    const double window = lib::rangeWindow(toLight, light.inverseSquaredRange);
    return lib::luminance(light.intensity) * window * light.area / std::max(glm::dot(toLight, toLight), light.area);
}

DirectSample DirectLights::arriving(Light const& light, double3 position, double2 onArea) {
    if (light.shape != Light::Shape::None) return arrivingFromArea(light, position, onArea);
    if (light.isSun)
        return { .direction = -light.axis,
                 .illuminance = light.intensity * colorOf(light, position),
                 .radius = light.radius,
                 .castsShadows = light.castsShadows };
    const double3 toLight = light.position - position;
    const double distance = glm::length(toLight);
    if (!(distance > 0)) return {};
    const double3 direction = toLight / distance;
    double attenuation = lib::distanceAttenuation(toLight, light.inverseSquaredRange);
    if (light.isSpot) {
        attenuation *= lib::spotAttenuation(direction, light.axis, light.spotScale, light.spotOffset);
    }
    attenuation *= shareOf(light, -direction);
    return { direction, light.intensity * colorOf(light, position) * attenuation, distance, light.radius / distance,
             light.castsShadows };
}

DirectSample DirectLights::sample(double3 position, double u, double2 onArea) const {
    if (mLights.size() == 1) return arriving(mLights.front(), position, onArea);
    double total = 0;
    for (Light const& light : mLights) total += weightOf(light, position);
    double remaining = u * total;
    DirectSample chosen;
    for (Light const& light : mLights) {
        const double weight = weightOf(light, position);
        if (weight <= 0) continue;
        chosen = arriving(light, position, onArea);
        chosen.illuminance *= total / weight;
        remaining -= weight;
        if (remaining < 0) break; // rounding may leave a rest: then the last light that shines
    }
    return chosen;
}

} // namespace filament_core::reference
