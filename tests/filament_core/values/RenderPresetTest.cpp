// SPDX-License-Identifier: Apache-2.0
#include <filament_core/RenderPreset.h>

#include <gtest/gtest.h>

namespace filament_core {
namespace {

constexpr RenderPreset kAll[] = { RenderPreset::Fast, RenderPreset::Balanced, RenderPreset::Fine,
                                  RenderPreset::Cinematic };

TEST(RenderPreset, HasANameByWhichItIsFound) {
    for (const RenderPreset preset : kAll) EXPECT_EQ(enumFromName<RenderPreset>(toString(preset)), preset);
    EXPECT_FALSE(enumFromName<RenderPreset>("Fast"));
    EXPECT_FALSE(enumFromName<RenderPreset>(""));
}

TEST(RenderPreset, ReplacesWhatAnotherOneHasSet) {
    for (const RenderPreset before : kAll) {
        for (const RenderPreset preset : kAll) {
            View changed{ .samples = 4 }, fresh;
            applyPreset(changed, before);
            changed.quality.shBands = 1;
            changed.effects.ambientOcclusion.samples = 32;
            changed.effects.resolution.upscaling = Upscaling::Bilinear;
            applyPreset(changed, preset);
            applyPreset(fresh, preset);
            EXPECT_EQ(changed.quality, fresh.quality) << toString(before) << ", " << toString(preset);
            EXPECT_EQ(changed.effects, fresh.effects) << toString(before) << ", " << toString(preset);
            EXPECT_EQ(changed.samples, fresh.samples);
        }
    }
}

TEST(RenderPreset, LeavesWhatIsAMatterOfTaste) {
    for (const RenderPreset preset : kAll) {
        View view;
        view.effects.bloom.strength = 0.3f;
        view.effects.ambientOcclusion.radiusMeters = 0.7f;
        view.effects.colorGrading = { .enabled = true, .contrast = 1.2f };
        view.effects.fog = { .enabled = true, .density = 0.4f };
        view.effects.depthOfField = { .enabled = true, .focusMeters = 7 };
        view.display.toneMapper = ToneMapper::Agx;
        const View before = view;
        applyPreset(view, preset);
        EXPECT_EQ(view.effects.bloom.strength, 0.3f);
        EXPECT_EQ(view.effects.ambientOcclusion.radiusMeters, 0.7f);
        EXPECT_EQ(view.effects.colorGrading, before.effects.colorGrading) << toString(preset);
        EXPECT_EQ(view.effects.fog, before.effects.fog) << toString(preset);
        EXPECT_EQ(view.effects.depthOfField, before.effects.depthOfField) << toString(preset);
        EXPECT_EQ(view.display.toneMapper, ToneMapper::Agx);
    }
}

} // namespace
} // namespace filament_core
