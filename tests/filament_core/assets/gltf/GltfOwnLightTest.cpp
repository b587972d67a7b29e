// SPDX-License-Identifier: Apache-2.0
// FILAMENT_light: what it says about a light of KHR_lights_punctual, and what is wrong with it.
#include "tests/filament_core/assets/gltf/GltfSpecimens.h"

#include <gmock/gmock.h>

namespace filament_core::assets::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

ModelData lightOf(std::string const& type, Json own) {
    TestFile file = TestFile::triangle();
    Json light{ { "type", type }, { "intensity", 6 }, { "color", { 0.5, 1, 0.25 } } };
    light["extensions"]["FILAMENT_light"] = std::move(own);
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({ std::move(light) });
    file.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    Result<ModelData> model = file.load();
    EXPECT_TRUE(model) << model.error().message;
    return model ? std::move(*model) : ModelData{};
}

TEST(GltfOwnLight, WithoutALuminanceAnAreaHasTheCandelasOfItsLight) {
    const ModelData model = lightOf(
            "point", Json::parse(R"({ "version": 1, "area": { "shape": "rect", "width": 2, "height": 1.5 } })"));
    ASSERT_EQ(model.lights.size(), 1u);
    EXPECT_EQ(model.lights[0].shape, AreaShape::Rect);
    EXPECT_EQ(model.lights[0].luminance, 2.0f) << "6 cd over 3 square metres";
    EXPECT_THAT(model.warnings, IsEmpty());
}

struct Bad {
    const char* own;
    const char* warning;
    bool isRead; ///< the rest of the extension
};

TEST(GltfOwnLight, BadValuesAreWarningsThatNameThePlace) {
    const Bad all[] = {
        { R"(7)", "lights[0].extensions.FILAMENT_light", false },
        { R"({})", "FILAMENT_light.version: must be a non-negative integer", false },
        { R"({ "version": 2, "castsShadows": false })", "FILAMENT_light.version: 2 is unknown, 1 is read", false },
        { R"({ "version": 1, "castsShadows": 0 })", "FILAMENT_light.castsShadows: must be true or false", false },
        { R"({ "version": 1, "castsShadows": false, "sourceRadius": "x" })", "FILAMENT_light.sourceRadius", false },
        { R"({ "version": 1, "castsShadows": false, "sourceRadius": -1 })",
          "FILAMENT_light.sourceRadius: -1 is outside", true },
        { R"({ "version": 1, "castsShadows": false, "lightChannels": 256 })", "FILAMENT_light.lightChannels", true },
        { R"({ "version": 1, "castsShadows": false, "haloSize": 0 })", "FILAMENT_light.haloSize", true },
        { R"({ "version": 1, "castsShadows": false, "color": [ 1, 2 ] })", "FILAMENT_light.color", false },
        { R"({ "version": 1, "castsShadows": false, "area": { "shape": "star" } })",
          "FILAMENT_light.area.shape: 'star' is none of rect, disc and tube", true },
        { R"({ "version": 1, "castsShadows": false, "area": { "shape": "disc", "radius": -3 } })",
          "FILAMENT_light.area.radius: -3 is outside", true },
        { R"({ "version": 1, "castsShadows": false, "area": { "shape": "disc", "luminance": 1e300 } })",
          "FILAMENT_light.area.luminance", true },
        { R"({ "version": 1, "castsShadows": false, "image": {} })", "FILAMENT_light.image.words", true },
        { R"({ "version": 1, "castsShadows": false, "image": { "words": "cookie.png" } })",
          "FILAMENT_light.image.words: it must be a data URI", true },
        { R"({ "version": 1, "castsShadows": false, "image": { "words": "data:;base64,AQAAAAEAAAAAAAAAAAAAAAUAAAA=" } })",
          "FILAMENT_light.image: is no image for this light", true },
        { R"({ "version": 1, "castsShadows": false, "profile": { "words": "data:;base64,AgAAAAEAAAAAAIA/" } })",
          "FILAMENT_light.profile: is no profile for this light", true },
    };
    for (Bad const& bad : all) {
        SCOPED_TRACE(bad.own);
        const ModelData model = lightOf("point", Json::parse(bad.own));
        ASSERT_EQ(model.lights.size(), 1u);
        EXPECT_THAT(model.warnings, Contains(HasSubstr(bad.warning)));
        EXPECT_EQ(model.lights[0].castsShadows, !bad.isRead);
        EXPECT_EQ(model.lights[0].intensity, 6.0f);
    }
}

TEST(GltfOwnLight, OtherProgramsSeeALightOfTheSameCandelas) {
    const LightData disc{ .type = LightType::Spot,
                          .color = float3(2, 1, 0.5f),
                          .shape = AreaShape::Disc,
                          .sizeMeters = float2(0.5f),
                          .luminance = 8 };
    const Result<Bytes> file = writeGlb({ .lights = { disc, LightData{} } });
    ASSERT_TRUE(file) << file.error().message;
    uint32_t length = 0;
    std::memcpy(&length, &(*file)[12], 4);
    const Json root = Json::parse(std::string(reinterpret_cast<const char*>(file->data() + 20), length));
    const Json lights = root["extensions"]["KHR_lights_punctual"]["lights"];
    EXPECT_EQ(lights[0]["type"], "spot");
    EXPECT_EQ(lights[0]["color"], Json::parse("[ 1.0, 0.5, 0.25 ]"));
    EXPECT_NEAR(lights[0]["intensity"].get<double>(), 2 * 8 * 3.14159265 / 4, 1e-5);
    EXPECT_EQ(lights[0]["extensions"]["FILAMENT_light"]["color"], Json::parse("[ 2.0, 1.0, 0.5 ]"));
    EXPECT_FALSE(lights[1].contains("extensions")) << "nothing to say";
    EXPECT_THAT(root["extensionsUsed"].get<std::vector<std::string>>(), Contains("FILAMENT_light"));
}

} // namespace
} // namespace filament_core::assets::test
