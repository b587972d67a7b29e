// SPDX-License-Identifier: Apache-2.0
// Every preset of a view on both APIs: what runs, and that the bits are the same.
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/RenderPreset.h>
#include <filament_core/Renderer.h>

#include <set>

namespace filament_core {
namespace {

using test::MaterialStage;

constexpr RenderPreset kPresetsOfViews[] = { RenderPreset::Fast, RenderPreset::Balanced, RenderPreset::Fine,
                                             RenderPreset::Cinematic };

struct PresetFrame {
    Image image;
    std::set<std::string> needed; ///< effects
};

/// The third frame of a mirror below a sky.
PresetFrame drawnWith(RenderPreset preset, Backend backend) {
    auto engine = test::makeEngine(backend);
    if (!engine) return {};
    MaterialStage stage(*engine);
    stage.keep(std::make_shared<test::SkyObjects>(stage, test::kDirectionSky));
    stage.view.size = { 48, 48 };
    test::addSphere(stage, stage.material(test::text("shadingModel : lit, reflections : screenspace",
                                                     "material.baseColor.rgb = vec3(0.7); material.roughness = 0.2;"),
                                          test::kNoLights));
    applyPreset(stage.view, preset);
    Renderer renderer(*engine);
    PresetFrame frame;
    for (int i = 0; i < 3; ++i) frame.image = test::renderLinear(*engine, renderer, stage.scene, stage.view);
    for (EffectDecision const& decision : renderer.decisions())
        if (decision.state == EffectDecision::State::Needed) frame.needed.insert(decision.name);
    test::expectNoErrors(*engine);
    return frame;
}

TEST(RenderPresetPictures, HaveTheSameBitsOnBothApis) {
    const std::vector<std::set<std::string>> expected{
        { "fxaa" },
        { "ambient occlusion", "bloom", "fxaa" },
        { "ambient occlusion", "bloom", "reflections", "taa" },
        { "ambient occlusion", "bloom", "reflections", "taa" }, // nothing moves: no motion blur
    };
    const std::set<std::string> effects{ "ambient occlusion", "bloom", "fxaa", "motion blur", "reflections", "taa" };
    for (size_t i = 0; i < std::size(kPresetsOfViews); ++i) {
        SCOPED_TRACE(toString(kPresetsOfViews[i]));
        const PresetFrame vulkan = drawnWith(kPresetsOfViews[i], Backend::Vulkan);
        const PresetFrame gles = drawnWith(kPresetsOfViews[i], Backend::Gles);
        EXPECT_EQ(test::differingPixels(vulkan.image, gles.image), 0u);
        std::set<std::string> needed;
        std::ranges::set_intersection(vulkan.needed, effects, std::inserter(needed, needed.end()));
        EXPECT_EQ(needed, expected[i]);
        EXPECT_EQ(vulkan.needed, gles.needed);
    }
}

} // namespace
} // namespace filament_core
