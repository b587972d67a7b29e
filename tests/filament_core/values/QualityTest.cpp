// SPDX-License-Identifier: Apache-2.0
// Names of quality choices: each can be read back as written, and errors for unknown ones list valid names.
#include <filament_core/EnvironmentFormat.h>
#include <filament_core/Options.h>
#include <filament_core/Quality.h>

#include <gtest/gtest.h>

namespace filament_core {
namespace {

TEST(Quality, ValuesOfOneChoiceAreDifferentQualities) {
    for (Option const& choice : optionsOf<Quality>()) {
        for (size_t i = 0; i < choice.values.size(); ++i) {
            for (size_t j = 0; j < i; ++j) {
                Quality a, b;
                ASSERT_TRUE(setOption(a, choice.name, choice.values[i]) && setOption(b, choice.name, choice.values[j]));
                EXPECT_NE(a, b) << choice.name << ": " << choice.values[i] << ", " << choice.values[j];
            }
        }
    }
}

TEST(Quality, TheDefaultHasNothingToSayAndAChangeNamesItself) {
    Quality quality;
    EXPECT_EQ(toString(quality), "default");
    quality.specularVisibility = SpecularVisibility::Fast;
    quality.shBands = 2;
    EXPECT_EQ(toString(quality), "specularVisibility=fast shBands=2");
}

/// Every word for the options of loading files names one value, and no other word does.
template <class E>
void expectNames(std::initializer_list<const char*> words) {
    uint8_t next = 0;
    for (const char* word : words) {
        const std::optional<E> value = enumFromName<E>(word);
        ASSERT_TRUE(value) << word;
        EXPECT_EQ(*value, static_cast<E>(next++)) << word;
        EXPECT_STREQ(toString(*value), word);
    }
    EXPECT_FALSE(enumFromName<E>("none"));
}

TEST(Quality, ChoicesOfLoadingAreReadBackAsTheyAreWritten) {
    expectNames<RoughnessMapping>({ "quadratic", "logarithmic", "linear" });
    expectNames<PositionStorage>({ "asAuthored", "half", "unorm16" });
    expectNames<TangentStorage>({ "snorm16", "snorm8", "float" });
    expectNames<EnvironmentFormat>({ "RGBA16F", "R11G11B10F", "RGB9E5", "RGBM" });
}

TEST(Quality, PresetsHaveNamesAndTheHighOneIsTheDefault) {
    for (const char* name : { "low", "medium", "high", "reference" }) {
        const std::optional<QualityPreset> preset = enumFromName<QualityPreset>(name);
        ASSERT_TRUE(preset) << name;
        EXPECT_STREQ(toString(*preset), name);
    }
    EXPECT_FALSE(enumFromName<QualityPreset>("ultra"));
    EXPECT_EQ(qualityPreset(QualityPreset::High), Quality{});
    EXPECT_NE(qualityPreset(QualityPreset::Low), qualityPreset(QualityPreset::Medium));
}

} // namespace
} // namespace filament_core
