// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/AnalyticSky.h"

#include "base/math/Elementary.h"
#include "filament_core/assets/environment/IblDirections.h"

#include <glm/common.hpp>

#include <array>

namespace filament_core::assets {
namespace {

constexpr double kSunAngularRadius = 0.00465; // radians: 16 arc minutes
constexpr double kSunLuminance = 1.96e6;      // kcd/m^2 above the atmosphere: 133 klx over the disc's 6.8e-5 sr
constexpr uint32_t kRowsPerJob = 4;

struct Perez {
    double a, b, c, d, e;
};

// Perez et al. 1993, the shape of a clear sky; theta from the zenith, gamma from the sun.
double perez(Perez const& p, double cosTheta, double gamma, double cosGamma) {
    return (1 + p.a * elementary::exp(p.b / cosTheta)) *
           (1 + p.c * elementary::exp(p.d * gamma) + p.e * cosGamma * cosGamma);
}

// Preetham et al. 1999, appendix A.2: distribution coefficients and zenith values, linear in turbidity.
struct Sky {
    double3 sun;                 // unit
    std::array<Perez, 3> shape;  // of Y, x, y
    std::array<double, 3> scale; // zenith value / shape at the zenith
};

std::array<double, 3> zenithValues(double t, double sunTheta) {
    const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * sunTheta);
    const double s = sunTheta, s2 = s * s, s3 = s2 * s;
    const double luminance = (4.0453 * t - 4.9710) * elementary::tan(chi) - 0.2155 * t + 2.4192;
    const double x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                     t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                     (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
    const double y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                     t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                     (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
    return { std::max(luminance, 0.0), x, y };
}

Sky makeSky(AnalyticSkyOptions const& options) {
    const double t = options.turbidity;
    Sky sky;
    sky.sun = glm::normalize(double3(options.sunDirection));
    sky.shape[0] = { 0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                     -0.0670 * t + 0.3703 };
    sky.shape[1] = { -0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                     -0.0033 * t + 0.0452 };
    sky.shape[2] = { -0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                     -0.0109 * t + 0.0529 };
    const double sunTheta = elementary::acos(std::clamp(sky.sun.y, 0.0, 1.0));
    const std::array<double, 3> zenith = zenithValues(t, sunTheta);
    for (size_t i = 0; i < 3; ++i) {
        sky.scale[i] = zenith[i] / perez(sky.shape[i], 1, sunTheta, elementary::cos(sunTheta));
    }
    return sky;
}

// CIE xyY -> linear Rec. 709 (IEC 61966-2-1, D65). Colours outside the gamut are clipped.
double3 rec709FromXyY(double x, double y, double luminance) {
    const double X = luminance * x / y, Z = luminance * (1 - x - y) / y;
    const double3 rgb(3.2406 * X - 1.5372 * luminance - 0.4986 * Z, -0.9689 * X + 1.8758 * luminance + 0.0415 * Z,
                      0.0557 * X - 0.2040 * luminance + 1.0570 * Z);
    return glm::max(rgb, double3(0.0));
}

// The model ends at the horizon, where 1 / cos(theta) diverges; a degree above it, the sky is stable.
double3 skyRadiance(Sky const& sky, double3 direction) {
    const double cosTheta = std::max(direction.y, 0.01);
    const double cosGamma = std::clamp(glm::dot(direction, sky.sun), -1.0, 1.0), gamma = elementary::acos(cosGamma);
    std::array<double, 3> value;
    for (size_t i = 0; i < 3; ++i) value[i] = sky.scale[i] * perez(sky.shape[i], cosTheta, gamma, cosGamma);
    return rec709FromXyY(value[1], value[2], std::max(value[0], 0.0));
}

// The fraction of sunlight that the air transmits at 650, 550 and 450 nm. Preetham et al. 1999, appendix A.1; relative
// optical mass of Kasten and Young 1989.
double3 sunTransmittance(double turbidity, double sunElevationSine) {
    const double degrees = elementary::asin(std::clamp(sunElevationSine, 0.0, 1.0)) * 180 / std::numbers::pi;
    const double mass = 1 / (std::max(sunElevationSine, 0.0) + 0.50572 * elementary::pow(degrees + 6.07995, -1.6364));
    const double beta = 0.04608 * turbidity - 0.04586;
    const auto transmittance = [&](double micrometers) {
        const double rayleigh = 0.008735 * elementary::pow(micrometers, -4.08);
        const double aerosol = beta * elementary::pow(micrometers, -1.3);
        return elementary::exp(-(rayleigh + aerosol) * mass);
    };
    return { transmittance(0.65), transmittance(0.55), transmittance(0.45) };
}

double3 sunRadiance(AnalyticSkyOptions const& options, Sky const& sky) {
    return kSunLuminance * sunTransmittance(options.turbidity, sky.sun.y);
}

double sunSolidAngle() { return 2 * std::numbers::pi * (1 - elementary::cos(kSunAngularRadius)); }

double polarOfRow(double row, uint32_t height) { return row / height * std::numbers::pi; }

double pixelSolidAngle(uint32_t row, uint32_t height) {
    return std::numbers::pi / height *
           (elementary::cos(polarOfRow(row, height)) - elementary::cos(polarOfRow(row + 1, height)));
}

// Fraction of the pixel (column, row) that the disc covers, from 16 x 16 points.
double discCoverage(uint32_t column, uint32_t row, uint32_t height, double3 sun) {
    constexpr int kPoints = 16;
    int inside = 0;
    for (int j = 0; j < kPoints; ++j) {
        for (int i = 0; i < kPoints; ++i) {
            const double u = (column + (i + 0.5) / kPoints) / (2 * height), v = (row + (j + 0.5) / kPoints) / height;
            const double azimuth = (0.5 - u) * 2 * std::numbers::pi, polar = v * std::numbers::pi;
            const double3 d(elementary::sin(azimuth) * elementary::sin(polar), elementary::cos(polar),
                            elementary::cos(azimuth) * elementary::sin(polar));
            const double3 difference = d - sun; // chord: at such angles acos has no digits left
            inside += glm::dot(difference, difference) <= kSunAngularRadius * kSunAngularRadius;
        }
    }
    return inside / static_cast<double>(kPoints * kPoints);
}

struct CoveredPixel {
    uint32_t x, y;
    double share;
};

std::vector<CoveredPixel> pixelsUnderDisc(uint32_t width, uint32_t height, double3 sun) {
    const double pixelDiagonal = std::numbers::pi / height * std::numbers::sqrt2;
    const double reach = kSunAngularRadius + pixelDiagonal, sunPolar = elementary::acos(std::clamp(sun.y, -1.0, 1.0));
    std::vector<CoveredPixel> covered;
    for (uint32_t y = 0; y < height; ++y) {
        if (std::fabs(polarOfRow(y + 0.5, height) - sunPolar) > reach) continue;
        for (uint32_t x = 0; x < width; ++x) {
            const float2 centre((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
            if (glm::distance(double3(directionFromEquirect(centre)), sun) > reach) continue;
            const double share = discCoverage(x, y, height, sun);
            if (share > 0) covered.push_back({ x, y, share });
        }
    }
    return covered;
}

// Adds the disc to the pixels that it touches, scaled so that its irradiance is exact.
void addSunDisc(HdrImage& image, AnalyticSkyOptions const& options, Sky const& sky) {
    std::vector<CoveredPixel> covered = pixelsUnderDisc(image.width, image.height, sky.sun);
    double solidAngle = 0;
    for (CoveredPixel const& pixel : covered) solidAngle += pixel.share * pixelSolidAngle(pixel.y, image.height);
    if (covered.empty()) { // smaller than the point spacing: put it all into one pixel
        const float2 uv = equirectFromDirection(float3(sky.sun));
        const auto x = std::min(static_cast<uint32_t>(uv.x * static_cast<float>(image.width)), image.width - 1);
        const auto y = std::min(static_cast<uint32_t>(uv.y * static_cast<float>(image.height)), image.height - 1);
        covered.push_back({ x, y, 1 });
        solidAngle = pixelSolidAngle(y, image.height);
    }
    const double3 radiance = sunRadiance(options, sky) * (sunSolidAngle() / solidAngle);
    for (CoveredPixel const& pixel : covered) image.at(pixel.x, pixel.y) += float3(radiance * pixel.share);
}

// Irradiance of the upper hemisphere on the ground; rows are summed in order.
double3 groundIrradiance(HdrImage const& image, AnalyticSkyOptions const& options, Sky const& sky) {
    double3 irradiance(0.0);
    for (uint32_t y = 0; y < image.height / 2; ++y) {
        double3 row(0.0);
        for (uint32_t x = 0; x < image.width; ++x) row += double3(image.at(x, y));
        irradiance += row * (pixelSolidAngle(y, image.height) * elementary::cos(polarOfRow(y + 0.5, image.height)));
    }
    if (options.sunDisc) irradiance += sunRadiance(options, sky) * (sunSolidAngle() * std::max(sky.sun.y, 0.0));
    return irradiance;
}

Result<void> checkOptions(AnalyticSkyOptions const& options) {
    if (options.height < 8 || options.height > 4096 || options.height % 2 != 0) {
        return fail(ErrorCode::InvalidArgument, "sky height {} is not an even number in [8, 4096]", options.height);
    }
    if (!(options.turbidity >= 1.7f && options.turbidity <= 10.0f)) {
        return fail(ErrorCode::InvalidArgument, "sky turbidity {} is not in [1.7, 10]", options.turbidity);
    }
    const float length = glm::length(options.sunDirection);
    if (!(length > 0 && std::isfinite(length)) || options.sunDirection.y < 0) {
        return fail(ErrorCode::InvalidArgument, "the sun of a sky is not at or above the horizon: ({}, {}, {})",
                    options.sunDirection.x, options.sunDirection.y, options.sunDirection.z);
    }
    return {};
}

} // namespace

float3 analyticSunIlluminance(AnalyticSkyOptions const& options) {
    return float3(sunRadiance(options, makeSky(options)) * sunSolidAngle());
}

Result<HdrImage> makeAnalyticSky(AnalyticSkyOptions const& options, jobs::JobSystem& jobs) {
    if (auto checked = checkOptions(options); !checked) return checked.error();
    const Sky sky = makeSky(options);
    HdrImage image{ .width = options.height * 2, .height = options.height, .pixels = {}, .repairs = {} };
    image.pixels.resize(size_t(image.width) * image.height);
    jobs::parallelFor<"sky">(jobs, image.height / 2, kRowsPerJob, [&](size_t begin, size_t end) {
        for (auto y = static_cast<uint32_t>(begin); y < end; ++y) {
            for (uint32_t x = 0; x < image.width; ++x) {
                const float2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                                (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height));
                image.at(x, y) = float3(skyRadiance(sky, double3(directionFromEquirect(uv))));
            }
        }
    });
    const float3 ground = options.groundAlbedo * float3(groundIrradiance(image, options, sky) / std::numbers::pi);
    std::fill(image.pixels.begin() + static_cast<std::ptrdiff_t>(image.pixels.size() / 2), image.pixels.end(), ground);
    if (options.sunDisc) addSunDisc(image, options, sky);
    return image;
}

} // namespace filament_core::assets
