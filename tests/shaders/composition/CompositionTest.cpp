// SPDX-License-Identifier: Apache-2.0
// White furnace and reciprocity of whole materials as composed by shaders/material, with the code that the compiler
// includes: their fragment stages run as C++ in double precision. Prints the least and the most light that each keeps.
#include "tests/shaders/composition/Composition.h"
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

namespace filament_core::shader::composition {
namespace {

using lib64::viewAt;

constexpr double kCosines[] = { 0.05, 0.2, 0.5, 0.9 };
constexpr double kRoughnesses[] = { 0.4, 0.7, 1.0 };
constexpr double kStrengths[] = { 0.15, 1.0 };
constexpr double kMetallics[] = { 0.0, 0.5, 1.0 };

double largest(vec3 color) { return std::max(color.x, std::max(color.y, color.z)); }

/// Integral over light from above (side 1) or below (-1). The midpoints are denser near the horizon and near the plane
/// of the view, where the lobes of grazing views are a hundredth of a radian wide.
vec3 integrate(Composition const& material, Inputs const& inputs, vec3 view, double side, int polar, int azimuth) {
    const double pi = lib64::kPiOfTests, toView = std::atan2(view.y, view.x);
    vec3 sum(0.0);
    for (int i = 0; i < polar; ++i) {
        const double t = (i + 0.5) / polar, c = t * t, s = std::sqrt((1 - c) * (1 + c));
        for (int j = 0; j < azimuth; ++j) {
            const double u = 2 * (j + 0.5) / azimuth - 1, phi = toView + pi + pi * u * u * u;
            const double solidAngle = (2 * t / polar) * (3 * pi * u * u * 2 / azimuth);
            sum += material.light(inputs, view, vec3(s * std::cos(phi), s * std::sin(phi), side * c)) * solidAngle;
        }
    }
    return sum;
}

/// The reflection of light from everywhere.
double albedoOf(Composition const& material, Inputs const& inputs, vec3 view, int steps = 160) {
    return largest(integrate(material, inputs, view, 1, steps, steps) + integrate(material, inputs, view, -1, 24, 24));
}

struct Extremes {
    double least = 1e9, most = 0;
    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

template <class Visit>
void forEachWhiteSurface(Visit const& visit) {
    for (const double metallic : kMetallics) {
        for (const double roughness : kRoughnesses) {
            for (const double strength : kStrengths)
                visit(Inputs{ .metallic = metallic, .roughness = roughness, .strength = strength });
        }
    }
}

std::string textOf(Composition const& material, Inputs const& inputs, double nov) {
    return std::string(material.name) + " metallic " + std::to_string(inputs.metallic) + " roughness " +
           std::to_string(inputs.roughness) + " strength " + std::to_string(inputs.strength) + " nov " +
           std::to_string(nov);
}

/// Along the tangent; for stretched lobes also across it and in between.
std::vector<vec3> viewsOf(std::string const& name, double nov) {
    const vec3 along = viewAt(nov);
    if (name != "anisotropy" && name != "all_layers" && name != "combinations") return { along };
    return { along, vec3(0, along.x, nov), vec3(along.x * 0.6, along.x * 0.8, nov) };
}

Composition const& standard() {
    return *std::ranges::find_if(compositions(), [](auto const& at) { return at.name == std::string("standard"); });
}

TEST(Composition, NoMaterialGivesMoreThanArrivesFromLights) {
    std::printf("| material | white metal | white plastic |\n|---|---|---|\n");
    for (Composition const& material : compositions()) {
        Extremes metals, plastics;
        forEachWhiteSurface([&](Inputs const& inputs) {
            for (const double nov : kCosines) {
                for (const vec3 view : viewsOf(material.name, nov)) {
                    const double white = albedoOf(material, inputs, view);
                    if (inputs.metallic == 1) metals.add(white);
                    if (inputs.metallic == 0) plastics.add(white);
                    EXPECT_LE(white, lib64::kNoGain) << textOf(material, inputs, nov);
                }
            }
        });
        std::printf("| %s | %.3f to %.3f | %.3f to %.3f |\n", material.name, metals.least, metals.most, plastics.least,
                    plastics.most);
    }
}

/// Documented in docs/energy.md.
bool losesSkyLight(std::string const& name) {
    static const std::set<std::string> kLosing{ "cloth_subsurface", "specular_glossiness" };
    return kLosing.contains(name);
}

TEST(Composition, WhiteMaterialsAreAsBrightAsAWhiteSky) {
    std::printf("| material | white sky |\n|---|---|\n");
    for (Composition const& material : compositions()) {
        Extremes sky;
        forEachWhiteSurface([&](Inputs const& inputs) {
            for (const double nov : kCosines) {
                for (const vec3 view : viewsOf(material.name, nov)) {
                    const double seen = largest(material.environment(inputs, view));
                    EXPECT_LE(seen, lib64::kNoGain) << textOf(material, inputs, nov);
                    EXPECT_GE(seen, losesSkyLight(material.name) ? 0.0 : 0.995) << textOf(material, inputs, nov);
                    sky.add(seen);
                }
            }
        });
        std::printf("| %s | %.3f to %.3f |\n", material.name, sky.least, sky.most);
    }
}

// Coat, sheen, grooves, film and transmission, each on or off.
TEST(Composition, NoCombinationOfLayersGivesMoreThanArrives) {
    constexpr int kCombinations = 32, kSteps = 96;
    Composition const& material = *std::ranges::find_if(
            compositions(), [](auto const& at) { return at.name == std::string("combinations"); });
    for (int layers = 0; layers < kCombinations; ++layers) {
        Inputs inputs{ .coat = double(layers & 1),
                       .sheen = double(layers >> 1 & 1),
                       .grooves = double(layers >> 2 & 1),
                       .film = double(layers >> 3 & 1),
                       .through = double(layers >> 4 & 1) };
        for (inputs.metallic = 0; inputs.metallic <= 1; ++inputs.metallic) {
            for (const double roughness : { 0.4, 1.0 }) {
                for (const double nov : { 0.05, 0.2, 0.7 }) {
                    const vec3 view = viewsOf(material.name, nov).back();
                    inputs.roughness = roughness;
                    EXPECT_LE(largest(material.environment(inputs, view)), lib64::kNoGain)
                            << "sky: layers " << layers << ' ' << textOf(material, inputs, nov);
                    EXPECT_LE(albedoOf(material, inputs, view, kSteps), lib64::kNoGain)
                            << "lights: layers " << layers << ' ' << textOf(material, inputs, nov);
                }
            }
        }
    }
}

/// Scattering below a surface is not meant to be reciprocal: a wrapped lobe has no cosine of its own. docs/energy.md.
bool isReciprocal(std::string const& name) {
    static const std::set<std::string> kNot{ "cloth_subsurface", "subsurface" };
    return !kNot.contains(name);
}

TEST(Composition, LayersAreReciprocalButForTheEnergyOfFurtherBounces) {
    const vec3 a = normalize(vec3(0.3, -0.8, 0.2)), b = normalize(vec3(-0.9, 0.1, 0.7));
    size_t compared = 0;
    for (Composition const& material : compositions()) {
        if (!isReciprocal(material.name)) continue;
        forEachWhiteSurface([&](Inputs inputs) {
            inputs.energyCompensation = false; // depends on the view alone
            inputs.color = vec3(0.8, 0.5, 0.3);
            const vec3 there = material.light(inputs, a, b) / b.z, back = material.light(inputs, b, a) / a.z;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(there[c] / back[c], 1, 1e-9) << textOf(material, inputs, a.z) << " component " << c;
            ++compared;
        });
    }
    EXPECT_GT(compared, 0u);
}

TEST(Composition, TheStandardMaterialIsTheLobesOfTheLibrary) {
    Inputs inputs{ .color = vec3(0.8, 0.5, 0.3), .metallic = 1, .roughness = 0.5 };
    inputs.energyCompensation = false;
    const vec3 v = viewAt(0.6), l = normalize(vec3(-0.3, 0.5, 0.7)), h = normalize(v + l);
    const double dv = lib64::ndfGgx(h.z, 0.25) * lib64::visibilitySmithGgxCorrelated(v.z, l.z, 0.25);
    const vec3 f = lib64::fresnelSchlick(inputs.color, 1.0, dot(v, h));
    const vec3 expected = f * (dv * l.z), found = standard().light(inputs, v, l);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-9);
}

} // namespace
} // namespace filament_core::shader::composition
