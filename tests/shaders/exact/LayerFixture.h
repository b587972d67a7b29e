// SPDX-License-Identifier: Apache-2.0
/// LayerBits: small materials drawn on both devices, which must agree to the bit.
#pragma once

#include "tests/shaders/exact/PictureFixture.h"

#include <algorithm>
#include <cmath>

namespace filament_core::shader::test {

/// One colour channel of the pixels that the object covers.
using Pixels = std::vector<float>;

class LayerBits : public PictureFixture {
protected:
    /// `code` runs after prepareMaterial(), `before` runs before it; `amount` is the parameter materialParams.amount.
    static MaterialScene scene(std::string const& code, float amount = 1, std::string const& properties = "",
                               std::string const& before = "") {
        MaterialScene scene;
        scene.source = "material { parameters : [ { name : amount, type : float } ],\n" + properties +
                       " }\nfragment { void material(inout MaterialInputs m) {\n" + before + "\nprepareMaterial(m);\n" +
                       "float amount = materialParams.amount;\n" + code + "\n} }";
        scene.parameters = { { "amount", { amount } } };
        scene.frame.exposure.x = 1;
        return scene;
    }

    /// White light from everywhere.
    static MaterialScene furnace(MaterialScene scene) {
        scene.frame.ambient = { 1, 0, 3, 0 };
        scene.frame.irradianceSh[0] = { 1, 1, 1, 0 };
        return scene;
    }

    /// A sun, and lights around the surface, one of which grazes it.
    static MaterialScene lights(MaterialScene scene) {
        scene.variant = kVariantSun | kVariantPunctual;
        scene.frame.sunDirection = { 0.36f, 0.48f, 0.8f, 1 };
        scene.frame.sunIlluminance = { 3, 2.5f, 2, 0 };
        scene.lights = {
            { { 0.5f, 0.4f, -1.2f, 0.04f }, { 2, 1, 0.5f, 0 }, { 0, 0, -1, 0 }, {} },
            { { -0.6f, -0.4f, -1.0f, 0 }, { 0.5f, 2, 1, 1 }, { 0.3f, 0.2f, -0.93f, 4 }, { -3, 0, 0, 0 } },
            { { 1.5f, 0.1f, -1.95f, 0 }, { 1, 1, 1, 0 }, { 0, 0, -1, 0 }, {} },
        };
        return scene;
    }

    /// One channel of draw(), for the pixels that the object covers.
    static Pixels render(MaterialScene const& scene, size_t channel = 0) {
        const std::vector<float> rgba = draw(scene);
        if (rgba.empty()) return {};
        Pixels pixels;
        for (size_t i = 0; i < rgba.size(); i += 4) {
            if (rgba[i + 3] != 0.0f) pixels.push_back(rgba[i + channel]);
        }
        EXPECT_GT(pixels.size(), 3000u);
        return pixels;
    }

    static double mean(Pixels const& pixels) {
        double sum = 0;
        for (const float value : pixels) sum += static_cast<double>(value);
        return sum / static_cast<double>(std::max<size_t>(pixels.size(), 1));
    }
    static float most(Pixels const& pixels) { return pixels.empty() ? 0 : std::ranges::max(pixels); }
    static float least(Pixels const& pixels) { return pixels.empty() ? 0 : std::ranges::min(pixels); }

    /// The largest difference.
    static float distance(Pixels const& a, Pixels const& b) {
        EXPECT_EQ(a.size(), b.size());
        float largest = 0;
        for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
        return largest;
    }
};

inline constexpr const char* kBlack = "m.baseColor.rgb = vec3(0.0);";

} // namespace filament_core::shader::test
