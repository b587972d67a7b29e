// SPDX-License-Identifier: Apache-2.0
// White furnace and reciprocity of whole materials, as shaders/material composes them, with what the compiler leaves of
// them: their fragment stages run as C++ in double precision. Prints what each keeps at least and at most.
#include "tests/shaders/composition/Composition.h"
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>

namespace filament::shader::composition {
namespace {

using lib64::viewAt;

constexpr double kCosines[] = { 0.05, 0.2, 0.5, 0.9 };
constexpr double kRoughnesses[] = { 0.4, 0.7, 1.0 };
constexpr double kStrengths[] = { 0.3, 1.0 };
constexpr double kMetallics[] = { 0.0, 0.5, 1.0 };

double largest(vec3 color) { return std::max(color.x, std::max(color.y, color.z)); }

/// What comes back of light from everywhere, above and below the surface.
double albedoOf(Composition const& material, Inputs const& inputs, double nov) {
    const vec3 view = viewAt(nov);
    const lib64::Quadrature quadrature{ .polar = 160, .azimuth = 180 };
    const auto upper = [&](vec3 l) { return material.light(inputs, view, l); };
    const auto lower = [&](vec3 l) { return material.light(inputs, view, vec3(l.x, l.y, -l.z)); };
    return largest(lib64::integrateUpper(upper, quadrature)) +
           largest(lib64::integrateUpper(lower, { .polar = 32, .azimuth = 32 }));
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

Composition const& standard() {
    return *std::ranges::find_if(compositions(), [](auto const& at) { return at.name == std::string("standard"); });
}

/// Under lights the base adds its diffuse lobe in full to what it reflects, as the reference text has it, so that white
/// plastic gives more than arrives (docs/energy.md). No layer may add to that, and metals have none of it.
double mostFromLights(Inputs const& inputs, double nov) {
    if (inputs.metallic == 1) return lib64::kNoGain;
    return std::max(lib64::kNoGain, albedoOf(standard(), inputs, nov));
}

TEST(Composition, NoLayerAddsLight) {
    std::printf("| material | metal, lights | others, lights | white sky |\n|---|---|---|---|\n");
    for (Composition const& material : compositions()) {
        Extremes metals, others, sky;
        forEachWhiteSurface([&](Inputs const& inputs) {
            for (const double nov : kCosines) {
                const double lit = albedoOf(material, inputs, nov);
                EXPECT_LE(lit, mostFromLights(inputs, nov)) << "lights: " << textOf(material, inputs, nov);
                (inputs.metallic == 1 ? metals : others).add(lit);
                const double seen = largest(material.environment(inputs, viewAt(nov)));
                EXPECT_LE(seen, lib64::kNoGain) << "white sky: " << textOf(material, inputs, nov);
                sky.add(seen);
            }
        });
        std::printf("| %s | %.3f to %.3f | %.3f to %.3f | %.3f to %.3f |\n", material.name, metals.least, metals.most,
                    others.least, others.most, sky.least, sky.most);
    }
}

/// Scattering below a surface is not meant to be: a wrapped lobe has no cosine of its own. docs/energy.md.
bool isReciprocal(std::string const& name) {
    static const std::set<std::string> kNot{ "cloth", "cloth_subsurface", "subsurface" };
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
} // namespace filament::shader::composition
