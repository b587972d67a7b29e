// SPDX-License-Identifier: Apache-2.0
#include <filament_core/SceneFile.h>

#include "toolkit/paths/Paths.h"

#include <filament_core/Options.h>
#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>

namespace filament_core {
namespace {

namespace fs = std::filesystem;

SceneFile parsed(std::string_view text) {
    Result<SceneFile> file = SceneFile::parse(text);
    EXPECT_TRUE(file.ok()) << (file ? "" : file.error().message);
    return file ? std::move(*file) : SceneFile();
}

std::string refusal(std::string_view text) {
    const Result<SceneFile> file = SceneFile::parse(text);
    return file ? "was read" : file.error().message;
}

TEST(SceneFile, EveryConformanceSceneIsTheSameAfterItWasSaved) {
    const fs::path saved = tools::buildDir() / "saved-scene.json";
    size_t files = 0;
    for (auto const& entry : fs::directory_iterator(tools::sourceDir() / "tests/conformance/scenes")) {
        if (entry.path().extension() != ".json") continue;
        const Result<SceneFile> file = SceneFile::load(entry.path());
        ASSERT_TRUE(file.ok()) << file.error().message;
        ASSERT_TRUE(file->save(saved).ok());
        const Result<SceneFile> again = SceneFile::load(saved);
        ASSERT_TRUE(again.ok()) << again.error().message;
        EXPECT_TRUE(*file == *again) << entry.path();
        EXPECT_EQ(file->text(), again->text());
        EXPECT_EQ(file->featureNames(), again->featureNames());
        ++files;
    }
    EXPECT_GT(files, 50u);
}

TEST(SceneFile, SaysWhatIsWrongWithAFile) {
    EXPECT_NE(refusal("{").find("this is no JSON text"), std::string::npos) << refusal("{");
    EXPECT_NE(refusal("[]").find("expected an object"), std::string::npos) << refusal("[]");
    EXPECT_NE(refusal(R"({"version": 2})").find("version 2 is newer than 1"), std::string::npos);
    EXPECT_NE(refusal(R"({"version": 0})").find("version"), std::string::npos);
    EXPECT_NE(refusal(R"({"camera": {"eyes": [0, 0, 0]}})").find("'eyes' is not a field here; did you mean 'eye'"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"camera": {"up": [0, 0, 0]}})").find("up: expected one that is not zero"), std::string::npos);
    EXPECT_NE(refusal(R"({"features": {"a": {"camera": {"near": -1}}}})").find("near"), std::string::npos)
            << "a feature that would be wrong";
    EXPECT_NE(refusal(std::string(1000, '[')).find("nested deeper"), std::string::npos);
    EXPECT_EQ(refusal(R"({"version": 1})"), "was read");
    EXPECT_EQ(refusal("{}"), "was read");
    EXPECT_EQ(SceneFile::load("/no/such/file.json").error().code, ErrorCode::NotFound);
    EXPECT_EQ(SceneFile::parse(R"({"version": 2})").error().code, ErrorCode::Unsupported);
}

TEST(SceneFile, KeepsOrderAndNumbersOfWhatWasNotEdited) {
    SceneFile file =
            parsed(R"({"description": "d", "camera": {"near": 0.1, "eye": [1, 2.50, 3e0]}, "model": "a.glb"})");
    ASSERT_TRUE(file.set("camera.fovDegrees", "30").ok());
    EXPECT_EQ(file.text(), R"({
  "description": "d",
  "camera": {
    "near": 0.1,
    "eye": [
      1,
      2.5,
      3.0
    ],
    "fovDegrees": 30
  },
  "model": "a.glb"
}
)");
}

TEST(SceneFile, KeysNameMembersPlacesAndOptionsWithDots) {
    SceneFile file;
    const auto set = [&](const char* key, const char* value) {
        const Result<void> done = file.set(key, value);
        EXPECT_TRUE(done.ok()) << key << ": " << (done ? "" : done.error().message);
    };
    set("model", "kitchen.glb");
    set("camera.eye", "0,1.6,4");
    set("camera.eye[1]", "1.5");
    set("points[0].candela", "50");
    set("points[1].at", "[1, 2, 3]");
    set("points[1].castsShadows", "off");
    set("effects.fog", "on");
    set("effects.fog.density", "0.25");
    set("view.lod.pixels", "1");
    set("view.viewport.clear", "1,0,0,1");
    set("view.size", "640,480");
    set("description", "12");
    const SceneFileContents contents = file.contents();
    EXPECT_EQ(contents.models.at(0).file, "kitchen.glb");
    EXPECT_EQ(contents.camera.eye.value(), double3(0, 1.5, 4));
    ASSERT_EQ(contents.lights.size(), 2u);
    EXPECT_EQ(std::get<PointLight>(contents.lights[0].light).intensity.value, 50);
    EXPECT_EQ(std::get<PointLight>(contents.lights[1].light).positionWorld, double3(1, 2, 3));
    EXPECT_FALSE(std::get<PointLight>(contents.lights[1].light).castsShadows);
    EXPECT_EQ(optionValue(contents.view.effects, "fog.density"), "0.25");
    EXPECT_EQ(contents.view.lod.pixels, 1);
    EXPECT_EQ(contents.view.viewport.value().clearColor, float4(1, 0, 0, 1));
    EXPECT_EQ(contents.view.size, uint2(640, 480));
    EXPECT_EQ(contents.description, "12");
    EXPECT_EQ(file.get("points[1].at"), "[1,2,3]");
    EXPECT_EQ(file.get("points[2].at"), std::nullopt);
    EXPECT_EQ(file.get("effects.fog.density"), "0.25");
    EXPECT_TRUE(file.erase("points[0]").ok());
    EXPECT_EQ(file.contents().lights.size(), 1u);
    EXPECT_EQ(file.erase("points[4]").error().code, ErrorCode::NotFound);
}

TEST(SceneFile, AnEditThatFailsChangesNothing) {
    SceneFile file = parsed(R"({"points": [ { "candela": 1 } ]})");
    const SceneFile before = file;
    for (auto const& [key, value] :
         std::initializer_list<std::pair<const char*, const char*>>{ { "points[0].candela", "-1" },
                                                                     { "points[0].candles", "1" },
                                                                     { "points[3].candela", "1" },
                                                                     { "points[x]", "1" },
                                                                     { "points[99999999999999999999]", "1" },
                                                                     { "camera", "3" },
                                                                     { "", "3" },
                                                                     { "camera.", "3" },
                                                                     { "effects.fog.density", "thick" },
                                                                     { "[0]", "3" } })
        EXPECT_FALSE(file.set(key, value).ok()) << key;
    EXPECT_TRUE(file == before);
    EXPECT_EQ(file.set("points[0].candela", "-1").error().message,
              "scene points[0]: candela: expected a number from 0 to 1000000000");
}

// Keys and values of random pieces: each is set or refused, and the file can be read again.
TEST(SceneFile, EveryKeyIsSetOrRefused) {
    constexpr const char* kPieces[] = { "camera", "points", "model",    "features", "effects", "view", "eye",
                                        ".",      "[0]",    "[1]",      "[",        "]",       "[-1]", "fog.density",
                                        "on",     "{}",     "[{}]",     "1e400",    "null",    "\"",   "0,1,2",
                                        "copies", "at",     "\xff\xfe", "objects",  "",        "size" };
    std::mt19937 random(3);
    const auto text = [&](uint32_t most) {
        std::string joined;
        for (size_t i = random() % (most + 1); i > 0; --i) joined += kPieces[random() % std::size(kPieces)];
        return joined;
    };
    SceneFile file;
    size_t edits = 0;
    for (int round = 0; round < 3000; ++round) {
        const std::string key = text(4), value = text(2);
        const bool isSet = random() % 8 == 0 ? file.erase(key).ok() : file.set(key, value).ok();
        edits += isSet;
        if (!isSet) continue;
        const Result<SceneFile> again = SceneFile::parse(file.text());
        ASSERT_TRUE(again.ok()) << key << "=" << value << ": " << again.error().message;
    }
    EXPECT_GT(edits, 20u);
}

TEST(SceneFile, LightsOfTheApiComeBack) {
    SceneFile file;
    const PointLight point{ .positionWorld = { 1.1, 2, 3 },
                            .intensity = Candela{ 12.3f },
                            .color = { 1, 0.5f, 0.1f },
                            .rangeMeters = 7.7f,
                            .sourceRadiusMeters = 0.1f,
                            .castsShadows = false,
                            .contactShadows = true,
                            .lightChannels = 6 };
    const SpotLight spot{ .innerConeRadians = 0.1f, .outerConeRadians = 0.6f };
    const RectLight rect{
        .directionWorld = { 0, -1, 0 }, .upWorld = { 1, 0, 0 }, .widthMeters = 0.3f, .isTwoSided = true
    };
    const TubeLight tube{ .lengthMeters = 1.7f, .isVisible = true };
    const SunLight sun{
        .directionWorld = { 0.1f, -1, 0.2f }, .illuminance = Lux{ 5 }, .showsDisc = true, .haloSize = 3
    };
    for (LightDesc const& light : std::initializer_list<LightDesc>{ point, spot, rect, DiscLight{}, tube, sun }) {
        const Result<void> added = file.add(light);
        EXPECT_TRUE(added.ok()) << (added ? "" : added.error().message);
    }
    ASSERT_EQ(file.contents().lights.size(), 6u); // suns, points, spots, rects, discs, tubes
    const auto readPoint = std::get<PointLight>(file.contents().lights[1].light);
    EXPECT_EQ(readPoint.positionWorld, point.positionWorld);
    EXPECT_EQ(readPoint.intensity.value, point.intensity.value);
    EXPECT_EQ(readPoint.color, point.color);
    EXPECT_EQ(readPoint.rangeMeters, point.rangeMeters);
    EXPECT_EQ(readPoint.sourceRadiusMeters, point.sourceRadiusMeters);
    EXPECT_EQ(readPoint.castsShadows, false);
    EXPECT_EQ(readPoint.contactShadows, true);
    EXPECT_EQ(readPoint.lightChannels, 6);
    const auto readSpot = std::get<SpotLight>(file.contents().lights[2].light);
    EXPECT_NEAR(readSpot.outerConeRadians, 0.6f, 1e-7f);
    const auto readRect = std::get<RectLight>(file.contents().lights[3].light);
    EXPECT_EQ(readRect.upWorld, rect.upWorld);
    EXPECT_EQ(readRect.widthMeters, 0.3f);
    EXPECT_TRUE(readRect.isTwoSided);
    EXPECT_TRUE(std::get<TubeLight>(file.contents().lights[5].light).isVisible);
    EXPECT_EQ(std::get<SunLight>(file.contents().lights[0].light).haloSize, 3);
    EXPECT_FALSE(file.add(PointLight{ .intensity = Candela{ -1 } }).ok());
}

TEST(SceneFile, CamerasOfTheApiComeBack) {
    SceneFile file = parsed(R"({"origin": [1000, 0, 0], "camera": {"moves": [0, 0, 1]}})");
    const Camera camera = Camera::lookAt({ 1001.5, 2, 3 }, { 1000, 0.5, 0.25 },
                                         { .verticalFovDegrees = 33.3f, .nearMeters = 0.5f, .shift = { 0.1f, 0 } },
                                         { .iso = 200 }, { 0.3, 1, 0 });
    ASSERT_TRUE(file.setCamera(camera).ok());
    SceneFileCamera const& read = file.contents().camera;
    const Camera again = Camera::lookAt(*read.eye + file.contents().origin, read.at + file.contents().origin, read.lens,
                                        file.contents().exposure, read.up);
    for (int column = 0; column < 4; ++column)
        EXPECT_LT(glm::length(camera.worldFromView[column] - again.worldFromView[column]), 1e-12) << column;
    EXPECT_EQ(read.lens.verticalFovDegrees, 33.3f);
    EXPECT_EQ(read.lens.nearMeters, 0.5f);
    EXPECT_EQ(read.lens.shift, float2(0.1f, 0));
    EXPECT_EQ(read.metersPerFrame, double3(0, 0, 1)) << "kept";
    EXPECT_EQ(file.contents().exposure.iso, 200);
}

/// Another value of an option than the one that it has.
std::string otherValue(Option const& option, std::string const& value) {
    for (std::string_view word : option.values)
        if (word != value) return std::string(word);
    const double middle = option.kind == OptionKind::Integer ? std::floor((option.least + option.most) / 2)
                                                             : (option.least + option.most) / 2;
    return fmt::format("{}", static_cast<float>(middle));
}

TEST(SceneFile, EveryOptionOfAViewComesBack) {
    SceneFile file = parsed(R"({"effects": {"bloom.dirt": "dirt.png"}})");
    View view = file.contents().view;
    const auto change = [](auto& object) {
        for (Option const& option : optionsOf<std::remove_cvref_t<decltype(object)>>())
            EXPECT_TRUE(setOption(object, option.name, otherValue(option, optionValue(option, &object))).ok());
    };
    change(view.quality);
    change(view.effects);
    change(view.display);
    view.size = { 320, 200 };
    view.samples = 4;
    view.clearColor = { 0.1f, 0.2f, 0.3f, 1 };
    view.visibleLayers = 0x81;
    view.debugView = DebugView::Normals;
    const Result<void> set = file.setView(view);
    ASSERT_TRUE(set.ok()) << set.error().message;
    const View read = parsed(file.text()).contents().view;
    const auto expectSame = [](auto const& a, auto const& b) {
        for (Option const& option : optionsOf<std::remove_cvref_t<decltype(a)>>())
            EXPECT_EQ(optionValue(option, &a), optionValue(option, &b)) << option.name;
    };
    expectSame(view.quality, read.quality);
    expectSame(view.effects, read.effects);
    expectSame(view.display, read.display);
    EXPECT_EQ(read.size, view.size);
    EXPECT_EQ(read.samples, 4);
    EXPECT_EQ(read.clearColor, view.clearColor);
    EXPECT_EQ(read.visibleLayers, 0x81);
    EXPECT_EQ(read.debugView, DebugView::Normals);
    EXPECT_EQ(file.contents().dirt, "dirt.png") << "kept";
    ASSERT_TRUE(file.setView(SceneFile().contents().view).ok());
    EXPECT_EQ(file.text(), parsed(R"({"effects": {"bloom.dirt": "dirt.png"}})").text()) << "defaults are not written";
}

TEST(SceneFile, FeaturesAreChangesOfTheScene) {
    const SceneFile file = parsed(R"({"model": "a.glb", "kills": ["x"], "camera": {"near": 0.1},
        "features": {"close": {"camera": {"near": 0.2}}, "bare": {"model": null, "kills": ["y"]}}})");
    EXPECT_EQ(file.featureNames(), (std::vector<std::string>{ "close", "bare" }));
    const SceneFile close = file.feature("close").value();
    EXPECT_EQ(close.name(), "scene/close");
    EXPECT_EQ(close.contents().camera.lens.nearMeters, 0.2f);
    EXPECT_TRUE(close.contents().comparison.kills.empty());
    EXPECT_TRUE(file.feature("bare")->contents().models.empty());
    EXPECT_EQ(file.feature("far").error().message, "scene: there is no feature 'far'; it has close or bare");
}

TEST(SceneFile, ModelsAreAListOfWhatTheOneModelIs) {
    const SceneFile file = parsed(R"({"model": "a.glb", "copies": [{}, {"at": [1, 0, 0]}],
        "models": [{"model": "b.glb", "variant": "red", "geometry": {"deformable": "off"}}]})");
    ASSERT_EQ(file.contents().models.size(), 2u);
    EXPECT_EQ(file.contents().models[0].copies.size(), 2u);
    EXPECT_EQ(file.contents().models[1].file, "b.glb");
    EXPECT_EQ(file.contents().models[1].variant, "red");
    EXPECT_FALSE(file.contents().models[1].options.deformable);
    EXPECT_EQ(file.contents().models[1].copies.size(), 1u);
    EXPECT_NE(refusal(R"({"models": [{"model": "a.glb", "copies": [{"depthWrite": true}]}]})").find("raster states"),
              std::string::npos);
}

TEST(SceneFile, ModelsOfAListMayBePaths) {
    SceneFile file = parsed(R"({"models": ["a.glb", {"model": "b.glb"}]})");
    ASSERT_TRUE(file.set("models[2]", "c.glb").ok());
    ASSERT_TRUE(file.set("models[0]", R"({"model": "d.glb", "variant": "red"})").ok());
    ASSERT_EQ(file.contents().models.size(), 3u);
    EXPECT_EQ(file.contents().models[0].variant, "red");
    EXPECT_EQ(file.contents().models[1].file, "b.glb");
    EXPECT_EQ(file.contents().models[2].file, "c.glb");
    EXPECT_EQ(file.contents().models[2].copies.size(), 1u);
    EXPECT_NE(refusal(R"({"models": [4]})").find("models[0]: expected an object"), std::string::npos);
}

} // namespace
} // namespace filament_core
