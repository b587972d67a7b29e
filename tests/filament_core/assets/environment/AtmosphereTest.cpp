// SPDX-License-Identifier: Apache-2.0
// The air against closed forms, and its light against a path tracer of its own: free flights by tracking through the
// densest air, every order of scattering, no table.
#include "filament_core/assets/environment/Atmosphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace filament_core::assets {
namespace {

using std::numbers::pi;
constexpr double kPerDegree = pi / 180;

double3 sunVector(double degrees) { return { std::cos(degrees * kPerDegree), std::sin(degrees * kPerDegree), 0 }; }

class AtmosphereTest : public ::testing::Test {
protected:
    jobs::JobSystem mJobs{ { .workers = 1 } };
};

TEST_F(AtmosphereTest, VerticalColumnsAreTheScaleHeights) {
    for (const double altitude : { 0.0, 500.0, 5e3, 50e3 }) {
        const AirColumns up = columnsToTop(kGroundRadius + altitude, 1);
        const auto column = [&](double height) {
            return height * (std::exp(-altitude / height) - std::exp(-100e3 / height));
        };
        EXPECT_NEAR(up.rayleigh, column(kRayleighHeight), 1e-3 * column(kRayleighHeight));
        EXPECT_NEAR(up.mie, column(kMieHeight), 1e-3 * column(kMieHeight));
    }
    EXPECT_NEAR(columnsToTop(kGroundRadius, 1).ozone, 15e3, 30);
}

// Chapman 1931: an exponential air seen along the horizon is sqrt(pi X / 2) (1 + 3 / (8 X)) scale heights thick, X the
// radius over the scale height, to 1/X^2.
TEST_F(AtmosphereTest, HorizontalColumnsFollowChapman) {
    const auto chapman = [](double height) {
        const double x = kGroundRadius / height;
        return height * std::sqrt(pi * x / 2) * (1 + 3 / (8 * x));
    };
    const AirColumns level = columnsToTop(kGroundRadius, 0);
    EXPECT_NEAR(level.rayleigh, chapman(kRayleighHeight), 1e-3 * chapman(kRayleighHeight));
    EXPECT_NEAR(level.mie, chapman(kMieHeight), 1e-3 * chapman(kMieHeight));
    // A ray that grazes the ground from 20 km up passes both halves.
    const double radius = kGroundRadius + 20e3, cosine = -std::sqrt(1 - std::pow(kGroundRadius / radius, 2));
    const AirColumns down = columnsToTop(radius, cosine), beyond = columnsToTop(radius, -cosine);
    EXPECT_NEAR(down.rayleigh + beyond.rayleigh, 2 * chapman(kRayleighHeight), 2e-3 * chapman(kRayleighHeight));
}

// The table of columns against columns that are integrated.
TEST_F(AtmosphereTest, SunlightIsThatOfTheIntegral) {
    const Atmosphere air = makeAtmosphere({ .turbidity = 4 }, mJobs);
    double worst = 0;
    for (const double altitude : { 0.0, 37.0, 300.0, 1e3, 4e3, 13e3, 50e3 }) {
        for (double degrees = 0.7; degrees <= 90; degrees += 1.3) {
            const double cosine = std::sin(degrees * kPerDegree), radius = kGroundRadius + altitude;
            const Spectrum table = sunlight(air, radius, cosine);
            const Spectrum exact = transmittance(air.medium, columnsToTop(radius, cosine));
            for (size_t k = 0; k < kBands; ++k) worst = std::max(worst, std::fabs(table[k] - exact[k]));
        }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, 1e-3);
}

TEST_F(AtmosphereTest, PhaseFunctionsConserveEnergyAndHaveTheirMeanCosine) {
    double rayleigh = 0, mie = 0, mean = 0;
    constexpr int kSteps = 20'000;
    for (int i = 0; i < kSteps; ++i) {
        const double cosine = 2 * (i + 0.5) / kSteps - 1, solid = 4 * pi / kSteps;
        rayleigh += rayleighPhase(cosine) * solid;
        mie += miePhase(cosine) * solid;
        mean += miePhase(cosine) * solid * cosine;
    }
    EXPECT_NEAR(rayleigh, 1, 1e-6);
    EXPECT_NEAR(mie, 1, 1e-4);
    EXPECT_NEAR(mean, 0.8098, 1e-3) << "3 g (4 + g^2) / (5 (2 + g^2))";
}

TEST_F(AtmosphereTest, WithoutScatterersTheSkyIsBlackAndTheGroundIsLitByTheSunAlone) {
    const Atmosphere air =
            makeAtmosphere({ .turbidity = 1, .groundAlbedo = float3(0.5f), .air = 0, .ozone = 0 }, mJobs);
    const double3 sun = sunVector(40);
    const ScatteredLight up = scatteredLight(air, kGroundRadius, { 0.6, 0.8, 0 }, sun);
    const ScatteredLight down = scatteredLight(air, kGroundRadius + 1000, { 0, -1, 0 }, sun);
    for (size_t k = 0; k < kBands; ++k) {
        EXPECT_EQ(up.rayleigh[k] + up.mie[k] + up.further[k], 0);
        EXPECT_EQ(up.transmittance[k], 1);
        EXPECT_NEAR(down.further[k], 0.5 / pi * sun.y, 1e-9);
        EXPECT_EQ(sunlight(air, kGroundRadius, sun.y)[k], 1);
    }
}

/// Of the whole sphere around a point: flux through a level plane, upwards or downwards, without the sun.
Spectrum flux(Atmosphere const& air, double radius, double3 sun, bool upwards) {
    constexpr int kPolar = 48, kAzimuth = 24;
    Spectrum sum{};
    for (int j = 0; j < kPolar; ++j) {
        for (int i = 0; i < kAzimuth; ++i) {
            const double square = (j + 0.5) / kPolar, cosine = std::sqrt(square), sine = std::sqrt(1 - square);
            const double azimuth = pi * (i + 0.5) / kAzimuth;
            const double3 d(sine * std::cos(azimuth), upwards ? -cosine : cosine, sine * std::sin(azimuth));
            const ScatteredLight light = scatteredLight(air, radius, d, sun);
            const double between = glm::dot(d, sun);
            for (size_t k = 0; k < kBands; ++k)
                sum[k] += (light.rayleigh[k] * rayleighPhase(between) + light.mie[k] * miePhase(between) +
                           light.further[k]) *
                          pi / (kPolar * kAzimuth);
        }
    }
    return sum;
}

// Over a white ground and without absorption all light leaves again.
TEST_F(AtmosphereTest, OverAWhiteGroundAllLightLeavesAgain) {
    for (const double turbidity : { 1.0, 3.0 }) {
        const Atmosphere air = makeAtmosphere(
                { .turbidity = turbidity, .groundAlbedo = float3(1), .ozone = 0, .mieAlbedo = 1 }, mJobs);
        for (const double degrees : { 90.0, 45.0, 20.0 }) {
            const double3 sun = sunVector(degrees);
            const Spectrum away = flux(air, kTopRadius, sun, true);
            for (size_t k = 0; k < kBands; ++k)
                EXPECT_NEAR(away[k] / sun.y, 1, 0.09) << turbidity << ", " << degrees << " degrees, band " << k;
        }
    }
}

// ---- the path tracer

struct Tracer {
    Atmosphere const& air;
    size_t band;
    std::mt19937_64 random{ 7 };

    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random); }

    double3 around(double3 axis, double cosine) {
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), angle = 2 * pi * uniform();
        const double3 side =
                glm::normalize(glm::cross(axis, std::fabs(axis.x) < 0.7 ? double3(1, 0, 0) : double3(0, 1, 0)));
        return axis * cosine + (side * std::cos(angle) + glm::cross(axis, side) * std::sin(angle)) * sine;
    }

    /// A cosine with the density of a phase function, by rejection.
    template <class Phase>
    double sampled(Phase const& phase, double most) {
        for (;;) {
            const double cosine = 2 * uniform() - 1;
            if (uniform() * most < phase(cosine)) return cosine;
        }
    }

    double sun(double3 p, double3 direction) const {
        const double radius = glm::length(p), cosine = glm::dot(p, direction) / radius;
        const double below = std::sqrt(std::max(0.0, 1 - std::pow(kGroundRadius / std::max(radius, kGroundRadius), 2)));
        if (cosine < -below) return 0;
        return transmittance(air.medium, columnsToTop(std::clamp(radius, kGroundRadius, kTopRadius), cosine))[band];
    }

    /// Radiance of all orders from `first` on; order 1 is light that was scattered once, or by the ground alone.
    double radiance(double3 p, double3 d, double3 sunward) {
        const double densest = air.medium.rayleigh[band] + air.medium.mieExtinction[band] + air.medium.ozone[band];
        double light = 0, weight = 1;
        for (int order = 0; order < 200; ++order) {
            // To the next collision.
            double3 at = p;
            bool ground = false, out = false;
            double rayleigh = 0, mie = 0, extinction = 0;
            for (;;) {
                const double step = -std::log(1 - uniform()) / densest;
                const double b = glm::dot(at, d), c = glm::dot(at, at) - kGroundRadius * kGroundRadius;
                const double root = b * b - c;
                if (b < 0 && root >= 0 && -b - std::sqrt(root) <= step) {
                    at += d * std::max(0.0, -b - std::sqrt(root));
                    ground = true;
                    break;
                }
                at += d * step;
                const double h = glm::length(at) - kGroundRadius;
                if (h > 100e3) {
                    out = true;
                    break;
                }
                rayleigh = air.medium.rayleigh[band] * std::exp(-h / 8e3);
                mie = air.medium.mieScattering[band] * std::exp(-h / 1.2e3);
                extinction = rayleigh + air.medium.mieExtinction[band] * std::exp(-h / 1.2e3) +
                             air.medium.ozone[band] * std::max(0.0, 1 - std::fabs(h - 25e3) / 15e3);
                if (uniform() * densest < extinction) break;
            }
            if (out) return light;
            if (ground) {
                const double3 normal = glm::normalize(at);
                weight *= air.groundAlbedo[band];
                at = normal * (kGroundRadius + 0.01);
                light += weight / pi * std::max(0.0, glm::dot(normal, sunward)) * sun(at, sunward);
                d = around(normal, std::sqrt(uniform()));
            } else {
                weight *= (rayleigh + mie) / extinction;
                const double share = rayleigh / (rayleigh + mie), cosine = glm::dot(d, sunward);
                light += weight * (share * rayleighPhase(cosine) + (1 - share) * miePhase(cosine)) * sun(at, sunward);
                d = around(d, uniform() < share ? sampled(rayleighPhase, rayleighPhase(1))
                                                : sampled(miePhase, miePhase(1)));
            }
            p = at;
            if (weight < 0.1) {
                if (uniform() > 0.5) return light;
                weight *= 2;
            }
        }
        return light;
    }
};

struct Compared {
    double traced, error, computed;
};

/// Irradiance of the ground by the sky.
Compared compareIrradiance(Atmosphere const& air, size_t band, double degrees, int paths) {
    Tracer tracer{ air, band };
    double sum = 0, squares = 0;
    const double3 start(0, kGroundRadius + 0.01, 0);
    for (int i = 0; i < paths; ++i) {
        const double light = pi * tracer.radiance(start, tracer.around({ 0, 1, 0 }, std::sqrt(tracer.uniform())),
                                                  sunVector(degrees));
        sum += light;
        squares += light * light;
    }
    const double mean = sum / paths;
    return { mean, std::sqrt(std::max(0.0, squares / paths - mean * mean) / paths),
             flux(air, kGroundRadius, sunVector(degrees), false)[band] };
}

// The error of the even orders: within 6 % where the sun is 20 degrees and higher, and 16 % where it is at 3 degrees.
TEST_F(AtmosphereTest, IrradianceIsThatOfThePathTracer) {
    for (const double turbidity : { 1.0, 2.5, 6.0 }) {
        for (const float albedo : { 0.0f, 0.9f }) {
            const Atmosphere air = makeAtmosphere({ .turbidity = turbidity, .groundAlbedo = float3(albedo) }, mJobs);
            for (const double degrees : { 60.0, 20.0, 3.0 }) {
                for (const size_t band : { size_t(0), size_t(3) }) {
                    const Compared c = compareIrradiance(air, band, degrees, 2'500);
                    const double bound = (degrees < 10 ? 0.16 : 0.06) * c.traced + 3 * c.error;
                    EXPECT_NEAR(c.computed, c.traced, bound)
                            << "turbidity " << turbidity << ", albedo " << albedo << ", sun at " << degrees
                            << " degrees, " << kBandNanometers[band] << " nm";
                }
            }
        }
    }
}

} // namespace
} // namespace filament_core::assets
