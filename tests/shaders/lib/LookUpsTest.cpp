// SPDX-License-Identifier: Apache-2.0
// look_ups.glsl beside the lobe itself: radiance of round lamps, which the fit has not seen, through two and three
// look-ups, summed over directions of the sphere.
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace filament_core::shader {
namespace {

using namespace lib;

constexpr int kDirections = 6000, kSkies = 150;

/// Directions of equal areas: a spiral of golden angles.
std::vector<double3> sphereOfDirections() {
    std::vector<double3> directions;
    for (int i = 0; i < kDirections; ++i) {
        const double z = 1 - 2 * (i + 0.5) / kDirections, turn = std::numbers::pi * (1 + std::sqrt(5.0)) * (i + 0.5);
        const double sine = std::sqrt(1 - z * z);
        directions.emplace_back(sine * std::cos(turn), sine * std::sin(turn), z);
    }
    return directions;
}

struct LookUpsTest : testing::Test {
    std::vector<double3> lights = sphereOfDirections();
    std::vector<std::vector<double>> skies;

    LookUpsTest() {
        std::mt19937 random(5);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> size(0.1, 0.6);
        for (int i = 0; i < kSkies; ++i) {
            const double3 lamp = glm::normalize(double3(normal(random), normal(random), normal(random)));
            const double wide = size(random);
            std::vector<double> sky;
            for (double3 const& light : lights)
                sky.push_back(0.05 + std::exp((glm::dot(light, lamp) - 1) / (wide * wide)));
            skies.push_back(std::move(sky));
        }
    }

    template <typename Weight>
    std::vector<double> seen(Weight const& weight) const {
        std::vector<double> sums(skies.size());
        double all = 0;
        for (size_t i = 0; i < lights.size(); ++i) {
            const double part = weight(lights[i]);
            all += part;
            for (size_t sky = 0; part != 0 && sky < skies.size(); ++sky) sums[sky] += part * skies[sky][i];
        }
        for (double& sum : sums) sum /= all;
        return sums;
    }

    std::vector<double> exact(double nov, double roughness) const {
        const double3 view(std::sqrt(1 - nov * nov), 0, nov);
        const auto alpha = static_cast<float>(roughness * roughness);
        return seen([&](double3 const& light) {
            if (light.z <= 0) return 0.0;
            const double3 half = glm::normalize(light + view);
            const auto nol = static_cast<float>(light.z), noh = static_cast<float>(std::min(half.z, 1.0));
            return double{ ndfGgx(noh, alpha) * visibilitySmithGgxCorrelated(static_cast<float>(nov), nol, alpha) *
                           nol };
        });
    }

    /// What the pre-filtered cube has in a direction of the plane of normal and view.
    std::vector<double> texel(double nov, double turn, double roughness) const {
        const double3 mirrored(-std::sqrt(1 - nov * nov), 0, nov);
        const double3 at = glm::normalize(glm::mix(double3(0, 0, 1), mirrored, turn));
        const auto alpha = static_cast<float>(roughness * roughness);
        return seen([&](double3 const& light) {
            const double cosine = glm::dot(light, at);
            if (cosine <= 0) return 0.0;
            const auto noh = static_cast<float>(std::sqrt(std::min(0.5 + 0.5 * cosine, 1.0)));
            return double{ ndfGgx(noh, alpha) } * cosine;
        });
    }

    /// Relative root mean square of the difference to the lobe over all skies; look-ups as (turn, roughness).
    double error(double nov, double roughness, std::vector<vec2> const& lookUps) const {
        const std::vector<double> wanted = exact(nov, roughness);
        std::vector<double> mean(skies.size());
        for (vec2 const lookUp : lookUps) {
            const std::vector<double> own = texel(nov, lookUp.x, lookUp.y);
            for (size_t i = 0; i < mean.size(); ++i) mean[i] += own[i] / static_cast<double>(lookUps.size());
        }
        double difference = 0, whole = 0;
        for (size_t i = 0; i < mean.size(); ++i) {
            difference += (mean[i] - wanted[i]) * (mean[i] - wanted[i]);
            whole += wanted[i] * wanted[i];
        }
        return std::sqrt(difference / whole);
    }
};

std::vector<vec2> fitted(int count, float r, float c) {
    std::vector<vec2> lookUps;
    for (int i = 0; i < count; ++i) lookUps.push_back(lookUpOf(count, i, r, c));
    return lookUps;
}
/// How far along the mirrored view dominantSpecularDirection() lies.
std::vector<vec2> dominantOf(float r) {
    return { { dominantSpecularDirection(vec3(0, 0, 0), vec3(1, 0, 0), r * r).x, r } };
}

TEST_F(LookUpsTest, EachMoreIsNearerToTheLobe) {
    double dominant = 0, two = 0, three = 0;
    int count = 0;
    for (const float roughness : { 0.4f, 0.55f, 0.7f, 0.85f, 1.0f }) {
        for (const float nov : { 0.1f, 0.3f, 0.6f, 0.9f }) {
            dominant += error(nov, roughness, dominantOf(roughness));
            two += error(nov, roughness, fitted(2, roughness, nov));
            three += error(nov, roughness, fitted(3, roughness, nov));
            ++count;
        }
    }
    RecordProperty("dominant", std::to_string(dominant / count));
    RecordProperty("two", std::to_string(two / count));
    EXPECT_LT(two, 0.55 * dominant);
    EXPECT_LT(three, 0.45 * dominant);
    EXPECT_LT(two / count, 0.12);
}

TEST_F(LookUpsTest, OfMirrorsAreTheMirroredView) {
    for (float c = 0; c <= 1; c += 0.125f) {
        for (int count = 2; count <= 3; ++count) {
            for (vec2 const lookUp : fitted(count, 0, c)) EXPECT_EQ(lookUp, vec2(1, 0));
        }
    }
}

TEST_F(LookUpsTest, StayInTheirRangesForAllSurfaces) {
    vec2 low(0), high(0);
    for (int i = 0; i <= 64; ++i) {
        for (int j = 0; j <= 64; ++j) {
            const float r = static_cast<float>(i) / 64, c = static_cast<float>(j) / 64;
            for (int count = 2; count <= 3; ++count) {
                for (vec2 const lookUp : fitted(count, r, c)) {
                    low = glm::min(low, lookUp);
                    high = glm::max(high, lookUp);
                }
            }
        }
    }
    EXPECT_GT(low.x, -1.6f);
    EXPECT_LT(high.x, 1.4f);
    EXPECT_GE(low.y, 0);
    EXPECT_LE(high.y, 1);
}

} // namespace
} // namespace filament_core::shader
