// SPDX-License-Identifier: Apache-2.0
// What --set accepts besides quality, effects and grading: every choice of the table is one, with the value that it has
// at first.
#include "toolkit/program/SceneChoices.h"

#include <gmock/gmock.h>

namespace filament_core::tools {
namespace {

using ::testing::HasSubstr;

SceneOptions sunny() {
    SceneOptions options;
    options.sun = SunLight{};
    return options;
}

/// What the choices change, as one text.
std::string stateOf(SceneOptions const& o) {
    return fmt::format(
            "{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", o.sun->showsDisc, o.sun->contactShadows,
            o.sun->angularRadiusDegrees, o.sun->haloSize, o.sun->haloFalloff, o.exactShaders,
            static_cast<int>(o.environmentOptions.format), static_cast<int>(o.environmentOptions.roughnessMapping),
            static_cast<int>(o.environmentOptions.sun), o.environmentOptions.lights,
            static_cast<int>(o.modelOptions.positions), static_cast<int>(o.modelOptions.tangents),
            o.modelOptions.filesFromAnywhere, o.modelOptions.allLevels, o.modelOptions.normalMapRoughness,
            o.modelOptions.compressedTextures, o.modelOptions.textureBudgetMegabytes, o.modelOptions.sectionPlanes);
}

TEST(SceneChoices, ChangeWhatTheyName) {
    const std::pair<const char*, const char*> kChanges[] = {
        { "sun.showsDisc", "on" },
        { "sun.contactShadows", "on" },
        { "sun.angularRadiusDegrees", "2" },
        { "sun.haloSize", "3" },
        { "sun.haloFalloff", "7" },
        { "exact", "off" },
        { "environment.format", "RGBM" },
        { "environment.roughnessMapping", "linear" },
        { "environment.sun", "extract" },
        { "environment.lights", "3" },
        { "model.positions", "half" },
        { "model.tangents", "float" },
        { "model.filesFromAnywhere", "on" },
        { "model.allLevels", "on" },
        { "model.normalMapRoughness", "on" },
        { "model.compressedTextures", "on" },
        { "model.textureBudgetMegabytes", "64" },
        { "model.sectionPlanes", "on" },
    };
    for (auto const& [name, value] : kChanges) {
        SceneOptions options = sunny();
        const auto done = setSceneChoice(options, name, value);
        ASSERT_TRUE(done && *done) << name;
        EXPECT_NE(stateOf(options), stateOf(sunny())) << name;
    }
    SceneOptions options;
    EXPECT_TRUE(*setSceneChoice(options, "bloom.dirt", "dirt.png"));
    EXPECT_EQ(options.dirt, "dirt.png");
}

TEST(SceneChoices, RefuseOtherValues) {
    SceneOptions options = sunny();
    EXPECT_THAT(setSceneChoice(options, "exact", "nonsense")->error().message, HasSubstr("off or on"));
    for (PrefixedOptions const& set : prefixedOptions()) {
        for (Option const& option : set.options) {
            const std::string name = fmt::format("{}{}", set.prefix, option.name);
            const auto done = setSceneChoice(options, name, "nonsense");
            ASSERT_TRUE(done) << name;
            ASSERT_FALSE(*done) << name;
            EXPECT_THAT(done->error().message, HasSubstr(rangeOf(option)));
            EXPECT_EQ(stateOf(options), stateOf(sunny())) << name;
        }
    }
}

TEST(SceneChoices, OfASunNeedASunAndOthersBelongToOthers) {
    SceneOptions options;
    EXPECT_THAT(setSceneChoice(options, "sun.showsDisc", "on")->error().message, HasSubstr("a --sun as well"));
    options = sunny();
    EXPECT_THAT(setSceneChoice(options, "sun.haloSiz", "1")->error().message, HasSubstr("'haloSize'"));
    EXPECT_FALSE(setSceneChoice(options, "fresnel", "exact"));
}

} // namespace
} // namespace filament_core::tools
