// SPDX-License-Identifier: Apache-2.0
#include <filament/RenderPreset.h>

#include <gtest/gtest.h>

namespace filament {
namespace {

constexpr RenderPreset kAll[] = { RenderPreset::Fast, RenderPreset::Balanced, RenderPreset::Fine,
                                  RenderPreset::Cinematic };

TEST(RenderPreset, HasANameByWhichItIsFound) {
    for (const RenderPreset preset : kAll) EXPECT_EQ(renderPresetFromName(toString(preset)), preset);
    EXPECT_FALSE(renderPresetFromName("Fast"));
    EXPECT_FALSE(renderPresetFromName(""));
}

TEST(RenderPreset, ReplacesWhatAnotherOneHasSet) {
    for (const RenderPreset before : kAll) {
        for (const RenderPreset preset : kAll) {
            View changed{ .samples = 4 }, fresh;
            applyPreset(changed, before);
            changed.quality.shBands = 1;
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
        view.effects.grading = { .enabled = true, .contrast = 1.2f };
        view.effects.fog = { .enabled = true, .density = 0.4f };
        view.effects.depthOfField = { .enabled = true, .focusMeters = 7 };
        view.colorGrading.toneMapper = ToneMapper::Agx;
        const View before = view;
        applyPreset(view, preset);
        Effects expected = before.effects;
        expected.bloom.enabled = view.effects.bloom.enabled;
        expected.motionBlur.enabled = view.effects.motionBlur.enabled;
        EXPECT_EQ(view.effects, expected) << toString(preset);
        EXPECT_EQ(view.colorGrading.toneMapper, ToneMapper::Agx);
    }
}

} // namespace
} // namespace filament
