// SPDX-License-Identifier: Apache-2.0
/// PictureFixture: images of materials on both devices, which must agree to the bit.
#pragma once

#include "tests/shaders/exact/BothDevices.h"
#include "tests/shaders/exact/MaterialRig.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core::shader::test {

class PictureFixture : public BothDevices<MaterialRig> {
protected:
    /// Renders on both, expects finite values and, except for variants in 16 bits, equal bits. Returns the RGBA
    /// image, or nothing after an error.
    static std::vector<float> draw(MaterialScene const& scene) {
        const Result<std::vector<float>> onVulkan = vulkan().render(scene), onGles = gles().render(scene);
        EXPECT_TRUE(onVulkan) << (onVulkan ? "" : onVulkan.error().message) << scene.source;
        EXPECT_TRUE(onGles) << (onGles ? "" : onGles.error().message) << scene.source;
        if (!onVulkan || !onGles) return {};
        if ((scene.variant & kVariantHalf) == 0) { // each driver chooses where it rounds to 16 bits
            EXPECT_EQ(differentValues(*onVulkan, *onGles), 0u)
                    << "variant " << scene.variant << ", " << (scene.source.empty() ? scene.material : scene.source);
        }
        for (auto const* each : { &*onVulkan, &*onGles }) {
            EXPECT_TRUE(std::ranges::all_of(*each, [](float value) { return std::isfinite(value); })) << scene.source;
        }
        return *onVulkan;
    }

private:
    /// Compares bits; a missing image differs.
    static size_t differentValues(std::vector<float> const& a, std::vector<float> const& b) {
        size_t different = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
        for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            different += std::bit_cast<uint32_t>(a[i]) != std::bit_cast<uint32_t>(b[i]);
        return different;
    }
};

} // namespace filament_core::shader::test
