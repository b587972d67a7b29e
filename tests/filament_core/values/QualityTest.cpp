// SPDX-License-Identifier: Apache-2.0
// Names of quality choices: each can be read back as written, and errors for unknown ones list valid names.
#include <filament/EnvironmentFormat.h>
#include <filament/Quality.h>

#include <gtest/gtest.h>

namespace filament {
namespace {

TEST(Quality, EveryValueOfEveryChoiceIsReadBackAsItWasSet) {
    for (QualityChoice const& choice : qualityChoices()) {
        for (const std::string_view value : choice.values) {
            Quality quality;
            ASSERT_TRUE(setQuality(quality, choice.name, value)) << choice.name << '=' << value;
            EXPECT_EQ(qualityValue(quality, choice.name), value);
        }
    }
}

TEST(Quality, ValuesOfOneChoiceAreDifferentQualities) {
    for (QualityChoice const& choice : qualityChoices()) {
        for (size_t i = 0; i < choice.values.size(); ++i) {
            for (size_t j = 0; j < i; ++j) {
                Quality a, b;
                ASSERT_TRUE(setQuality(a, choice.name, choice.values[i]) &&
                            setQuality(b, choice.name, choice.values[j]));
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

TEST(Quality, AnUnknownNameSuggestsTheNearestOne) {
    Quality quality;
    const Result<void> result = setQuality(quality, "shBand", "2");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::NotFound);
    EXPECT_NE(result.error().message.find("shBands"), std::string::npos) << result.error().message;
    EXPECT_FALSE(qualityValue(quality, "shBand"));
}

TEST(Quality, AValueOutOfRangeChangesNothingAndNamesTheRange) {
    for (const char* value : { "0", "4", "-1", "2x", "", "99999999999" }) {
        Quality quality;
        const Result<void> result = setQuality(quality, "shBands", value);
        ASSERT_FALSE(result) << value;
        EXPECT_EQ(result.error().code, ErrorCode::InvalidArgument);
        EXPECT_NE(result.error().message.find("1, 2 or 3"), std::string::npos) << result.error().message;
        EXPECT_EQ(quality, Quality{});
    }
    Quality quality;
    const Result<void> result = setQuality(quality, "fresnel", "fresnel");
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("schlick or exact"), std::string::npos) << result.error().message;
}

/// Every word for the options of loading files names one value, and no other word does.
template <class E>
void expectNames(std::initializer_list<const char*> words, std::optional<E> (*fromName)(std::string_view)) {
    uint8_t next = 0;
    for (const char* word : words) {
        const std::optional<E> value = fromName(word);
        ASSERT_TRUE(value) << word;
        EXPECT_EQ(*value, static_cast<E>(next++)) << word;
        EXPECT_STREQ(toString(*value), word);
    }
    EXPECT_FALSE(fromName("none"));
}

TEST(Quality, ChoicesOfLoadingAreReadBackAsTheyAreWritten) {
    expectNames({ "quadratic", "logarithmic", "linear" }, roughnessMappingFromName);
    expectNames({ "asAuthored", "half", "unorm16" }, positionStorageFromName);
    expectNames({ "snorm16", "snorm8", "float" }, tangentStorageFromName);
    for (const char* word : { "RGBA16F", "R11G11B10F", "RGB9E5", "RGBM" }) {
        const std::optional<Format> format = environmentFormatFromName(word);
        ASSERT_TRUE(format) << word;
        EXPECT_STREQ(environmentFormatName(*format), word);
    }
    EXPECT_FALSE(environmentFormatFromName("RGBA8"));
}

TEST(Quality, PresetsHaveNamesAndTheHighOneIsTheDefault) {
    for (const char* name : { "low", "medium", "high", "reference" }) {
        const std::optional<QualityPreset> preset = qualityPresetFromName(name);
        ASSERT_TRUE(preset) << name;
        EXPECT_STREQ(toString(*preset), name);
    }
    EXPECT_FALSE(qualityPresetFromName("ultra"));
    EXPECT_EQ(qualityPreset(QualityPreset::High), Quality{});
    EXPECT_NE(qualityPreset(QualityPreset::Low), qualityPreset(QualityPreset::Medium));
}

} // namespace
} // namespace filament
