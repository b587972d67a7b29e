// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/FogMedium.h"

#include "shaders/lib/LibCppDouble.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::reference {

namespace lib = shader::lib64;

namespace {

constexpr double kFarthestFog = 1e15; // metres: what lies at infinity
constexpr int kFogSteps = 512;
constexpr double kMostDepth = 60;   // mean optical depth, behind which nothing is left
constexpr double kFogFoldings = 40; // e-foldings from the dense end of a ray, beyond which nothing is left

double brightnessOf(SunLight const& sun) {
    return double(sun.illuminance.value) * glm::dot(double3(sun.color), double3(0.2126, 0.7152, 0.0722));
}

} // namespace

FogMedium::FogMedium(Fog const& fog, double height, FogLight const& light, double3 place)
        : mFog(fog), mHeight(height - double(fog.heightMeters)), mPlace(place),
          mColor(double3(fog.color) * light.ambient) {
    if (fog.colorFromEnvironment && light.environment && !light.environment->isBlack()) {
        mEnvironment = light.environment;
        mColor = double3(fog.color) * light.exposure;
    }
    if (fog.volumetric || !(fog.inScatteringSize > 0) || light.suns.empty()) return;
    SunLight const& sun = *std::ranges::max_element(light.suns, {}, brightnessOf);
    mSun = double3(sun.color) * (double(sun.illuminance.value) * light.exposure * (double(fog.inScatteringSize) + 1) /
                                 (2 * std::numbers::pi));
    mTowardsSun = -glm::normalize(double3(sun.directionWorld));
}

/// By the midpoints of steps from the dense end.
double FogMedium::opticalDepth(double rise, double from, double to) const {
    const double length = std::max(to - from, 0.0), rate = double(mFog.heightFalloff) * std::abs(rise);
    const double lowest = mHeight + std::min(rise * from, rise * to);
    const double reach = rate * length > kFogFoldings ? kFogFoldings / rate : length;
    const double logDensity = std::log(double(mFog.density)) - double(mFog.heightFalloff) * lowest;
    double sum = 0;
    for (int i = 0; i < kFogSteps; ++i)
        sum += std::exp(std::min(logDensity - rate * reach * (i + 0.5) / kFogSteps, 300.0));
    return sum * reach / kFogSteps;
}

double FogMedium::noiseAt(double3 point) const {
    const double period = 256 * double(mFog.noiseMeters);
    const double3 place = mPlace + point, inPeriod = place - period * glm::floor(place / period);
    return double(mFog.noiseAmplitude) *
           lib::fogNoise(inPeriod / double(mFog.noiseMeters), double(mFog.noiseOctaves), 0.0);
}

double FogMedium::logDensityAt(double height) const {
    return std::log(double(mFog.density)) - double(mFog.heightFalloff) * (mHeight + height);
}

/// Of what the density is more or less than its mean. Points where that may absorb are a Poisson process whose rate is
/// the mean density times the amplitude: each is found by the mean optical depth up to it.
double FogMedium::residualTransmittance(double3 origin, double3 direction, double from, double to,
                                        FogNumbers& numbers) const {
    const double amplitude = double(mFog.noiseAmplitude), rate = double(mFog.heightFalloff) * direction.y;
    const double first = std::exp(logDensityAt(origin.y + direction.y * from));
    const double all = lib::fogOpticalDepth(logDensityAt(origin.y), double(mFog.heightFalloff), direction.y, from, to);
    if (all > kMostDepth) return 0;
    double share = 1;
    for (double depth = 0;;) {
        depth -= std::log(numbers.next()) / amplitude;
        if (!(depth < all)) return share;
        const double x = rate * depth / first;
        const double meters = std::abs(x) > 1e-9 ? -std::log1p(-x) / rate : depth / first;
        share *= 1 - noiseAt(origin + direction * (from + meters)) / amplitude;
    }
}

double FogMedium::opacity(double3 direction, double from, double to, FogNumbers numbers) const {
    const double depth = opticalDepth(direction.y, from, to);
    double opaque = -std::expm1(-depth);
    if (varies()) opaque = 1 - std::exp(-depth) * residualTransmittance(double3(0.0), direction, from, to, numbers);
    return std::min(opaque, double(mFog.maximumOpacity));
}

double FogMedium::shareOnTheWay(double3 point, double3 toLight, double distance, FogNumbers numbers) const {
    if (!mFog.attenuatesLight) return 1;
    const double to = std::min(distance, kFarthestFog);
    const double depth = lib::fogOpticalDepth(logDensityAt(point.y), double(mFog.heightFalloff), toLight.y, 0.0, to);
    const double mean = std::exp(-depth);
    return varies() ? mean * residualTransmittance(point, toLight, 0, to, numbers) : mean;
}

FogMedium::Event FogMedium::sample(double3 direction, double distance, double u, FogNumbers numbers) const {
    const bool isCutOff = mFog.cutOffMeters > 0 && distance > double(mFog.cutOffMeters);
    const double start = double(mFog.startMeters), end = std::min(distance, kFarthestFog);
    const double logDensity = std::log(double(mFog.density)) - double(mFog.heightFalloff) * mHeight;
    const auto opacityAt = [&](double to) {
        const double depth = lib::fogOpticalDepth(logDensity, double(mFog.heightFalloff), direction.y, start, to);
        return lib::fogOpacity(depth, double(mFog.maximumOpacity));
    };
    const double all = opacityAt(end);
    if (isCutOff || !(all > 0)) return {};
    double before = start, behind = end;
    for (int i = 0; i < 100; ++i) {
        const double middle = before > 0 && behind > 4 * before ? std::sqrt(before * behind) : 0.5 * (before + behind);
        (opacityAt(middle) < u * all ? before : behind) = middle;
    }
    if (!varies()) return { behind, all };
    const double3 point = direction * behind;
    return { behind,
             all * (1 + noiseAt(point)) * residualTransmittance(double3(0.0), direction, start, behind, numbers) };
}

double3 FogMedium::phase(double3 direction, double3 toLight) const {
    const double scattered = lib::henyeyGreenstein(glm::dot(direction, toLight), double(mFog.anisotropy));
    return double3(mFog.albedo) * (scattered / (4 * std::numbers::pi));
}

double3 FogMedium::colorTowards(double3 direction) const {
    return mEnvironment ? mColor * mEnvironment->harmonicIrradiance(direction) : mColor;
}

double3 FogMedium::inFront(double3 color, double3 share, double3 direction, double distance, FogNumbers numbers) const {
    const bool isCutOff = mFog.cutOffMeters > 0 && distance > double(mFog.cutOffMeters);
    if (!mFog.enabled || mFog.density <= 0 || isCutOff) return color;
    const double to = std::min(distance, kFarthestFog), start = double(mFog.startMeters);
    const double3 fogged = glm::mix(color, share * colorTowards(direction), opacity(direction, start, to, numbers));
    const double cosine = glm::dot(direction, mTowardsSun);
    if (mSun == double3(0.0) || cosine <= 0) return fogged;
    const double scattered = opacity(direction, std::max(start, double(mFog.inScatteringStartMeters)), to, numbers);
    return fogged + share * mSun * (std::pow(cosine, double(mFog.inScatteringSize)) * scattered);
}

} // namespace filament_core::reference
