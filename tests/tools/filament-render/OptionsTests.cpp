// SPDX-License-Identifier: Apache-2.0
// Size: AllReachTheirFields is a list: every option on a command line once, every field once.
#include "tools/filament-render/Options.h"

#include <filament_core/RenderPreset.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filament_core::tools {
namespace {

using ::testing::HasSubstr;

Result<std::optional<Options>> parse(std::initializer_list<const char*> arguments) {
    std::vector<const char*> words{ "filament-render" };
    words.insert(words.end(), arguments);
    return parseOptions(static_cast<int>(words.size()), words.data());
}

Options parsed(std::initializer_list<const char*> arguments) {
    const auto result = parse(arguments);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() && *result ? **result : Options{};
}

std::string refused(std::initializer_list<const char*> arguments) {
    const auto result = parse(arguments);
    EXPECT_FALSE(result.ok());
    return result.ok() ? "" : result.error().message;
}

TEST(Options, WithoutArgumentsAreThoseOfTheManual) {
    const Options options = parsed({});
    EXPECT_TRUE(options.model.empty() && options.environment.empty());
    EXPECT_EQ(options.backends, (std::vector{ Backend::Vulkan, Backend::Gles }));
    EXPECT_EQ(options.view.size, uint2(1280, 720));
    EXPECT_EQ(options.frames, 1u);
    EXPECT_TRUE(options.fit);
    EXPECT_EQ(options.eye, double3(0.9, 0.6, 1.5));
    EXPECT_EQ(options.at, double3(0));
    EXPECT_EQ(options.fovDegrees, 40.0f);
    EXPECT_NEAR(options.exposure.ev100(), 14.966f, 0.001f); // log2(16^2 / 0.008)
    EXPECT_EQ(options.iblIntensity.value, 30'000.0f);
    EXPECT_FALSE(options.sun);
    EXPECT_TRUE(options.skybox);
    EXPECT_EQ(options.view.display.toneMapper, ToneMapper::Aces);
    EXPECT_FALSE(options.view.display.dither);
    EXPECT_EQ(options.tolerance, 0u);
    EXPECT_EQ(options.out, "out");
}

TEST(Options, ATimeIsAnyFiniteNumberOfSecondsAndAnAnimationAnyWord) {
    EXPECT_FALSE(parsed({}).seconds);
    const Options options = parsed({ "--time", "-0.25", "--animation", "Walk" });
    EXPECT_EQ(options.seconds, -0.25);
    EXPECT_EQ(options.animation, "Walk");
    EXPECT_THAT(refused({ "--time", "soon" }), HasSubstr("--time: 'soon'"));
    EXPECT_THAT(refused({ "--time", "inf" }), HasSubstr("seconds from -1e6 to 1e6"));
}

TEST(Options, WhatIsChosenWhenFilesAreLoadedIsSetByNameAsWell) {
    const auto options =
            parsed({ "--set", "environment.format=RGBM", "--set", "environment.roughnessMapping=linear", "--set",
                     "model.positions=unorm16", "--set", "model.tangents=snorm8", "--set", "exact=off" });
    EXPECT_EQ(options.environmentOptions.format, EnvironmentFormat::Rgbm);
    EXPECT_EQ(options.environmentOptions.roughnessMapping, RoughnessMapping::Linear);
    EXPECT_EQ(options.modelOptions.positions, PositionStorage::Unorm16);
    EXPECT_EQ(options.modelOptions.tangents, TangentStorage::Snorm8);
    EXPECT_FALSE(options.exactShaders);
    EXPECT_FALSE(options.modelOptions.filesFromAnywhere);
    EXPECT_TRUE(parsed({ "--set", "model.filesFromAnywhere=on" }).modelOptions.filesFromAnywhere);
    EXPECT_THAT(refused({ "--set", "model.filesFromAnywhere=all" }), HasSubstr("off or on"));
}

TEST(Options, DebugViewsAreSetByName) {
    EXPECT_EQ(parsed({}).view.debugView, DebugView::None);
    for (size_t i = 0; i < kDebugViewCount; ++i) {
        const auto view = static_cast<DebugView>(i);
        const std::string word = std::string("debugView=") + toString(view);
        EXPECT_EQ(parsed({ "--set", word.c_str() }).view.debugView, view);
    }
    EXPECT_THAT(refused({ "--set", "debugView=brightness" }), HasSubstr(listed(enumNames<DebugView>())));
}

TEST(Options, SharesAndAnExplainedPixelAreInThePicture) {
    EXPECT_FALSE(parsed({}).shares || parsed({}).explainPixel);
    EXPECT_EQ(parsed({ "--shares", "effects" }).shares, ShareTerms::Effects);
    EXPECT_THAT(refused({ "--shares", "lamps" }), HasSubstr("lights, effects or all"));
    EXPECT_EQ(parsed({ "--size", "64x32", "--explain-pixel", "63,31" }).explainPixel, uint2(63, 31));
    for (const char* words : { "64,0", "3", "3,", "3,32", "-1,0", "1,2,3" })
        EXPECT_THAT(refused({ "--size", "64x32", "--explain-pixel", words }), HasSubstr("below 64,32")) << words;
}

TEST(Options, AovsAreNamesEachOnce) {
    EXPECT_TRUE(parsed({}).aovs.empty());
    EXPECT_EQ(parsed({ "--eye", "1", "2", "3" }).previousEye, double3(1, 2, 3));
    EXPECT_EQ(parsed({ "--previous-at", "1", "2", "3" }).previousAt, double3(1, 2, 3));
    EXPECT_EQ(parsed({ "--frame-rate", "30" }).framesPerSecond, 30);
    for (const char* words : { "0", "-1", "nan", "1e5" })
        EXPECT_THAT(refused({ "--frame-rate", words }), HasSubstr("frames per second above 0")) << words;
    EXPECT_THAT(refused({ "--previous-eye", "0", "0", "0" }), HasSubstr("look at another one"));
    EXPECT_EQ(parsed({ "--aovs", "normal,depth" }).aovs, (std::vector{ Aov::Normal, Aov::Depth }));
    for (const char* words : { "none", "depth,depth", "beauty", "depth,,normal" })
        EXPECT_THAT(refused({ "--aovs", words }), HasSubstr("depth, position")) << words;
}

TEST(Options, DirtOfTheLensIsAFile) {
    EXPECT_EQ(parsed({}).dirt, "");
    const Options options = parsed({ "--set", "bloom=on", "--set", "bloom.dirt=a/b.png", "--set", "lensFlare=on" });
    EXPECT_EQ(options.dirt, "a/b.png");
    EXPECT_TRUE(options.view.effects.bloom.enabled && options.view.effects.lensFlare.enabled);
}

TEST(Options, TheDiscOfTheSunIsSetByName) {
    const Options options =
            parsed({ "--sun", "1000", "0", "-1", "0", "--set", "sun.showsDisc=on", "--set", "sun.haloSize=4", "--set",
                     "sun.haloFalloff=2.5", "--set", "sun.angularRadiusDegrees=1.5" });
    ASSERT_TRUE(options.sun);
    EXPECT_TRUE(options.sun->showsDisc);
    EXPECT_EQ(options.sun->haloSize, 4.0f);
    EXPECT_EQ(options.sun->haloFalloff, 2.5f);
    EXPECT_EQ(options.sun->angularRadiusDegrees, 1.5f);
    EXPECT_THAT(refused({ "--set", "sun.showsDisc=on" }), HasSubstr("a --sun as well"));
    EXPECT_THAT(refused({ "--sun", "1", "0", "-1", "0", "--set", "sun.haloSize=0" }), HasSubstr("from 1 to 1000"));
    EXPECT_THAT(refused({ "--sun", "1", "0", "-1", "0", "--set", "sun.size=1" }), HasSubstr("no option 'size'"));
}

TEST(Options, ASkyTakesThePlaceOfAnEnvironment) {
    EXPECT_FALSE(parsed({}).sky);
    const Options options = parsed({ "--sky", "3", "0.3", "0.5", "-0.8", "--sky-altitude", "1500", "--sky-fog" });
    ASSERT_TRUE(options.sky);
    EXPECT_EQ(options.sky->turbidity, 3.0f);
    EXPECT_EQ(options.sky->directionToSun, float3(0.3f, 0.5f, -0.8f));
    EXPECT_EQ(options.sky->altitudeMeters, 1500.0f);
    EXPECT_TRUE(options.skyFog);
    EXPECT_EQ(options.environment, "none");
    EXPECT_EQ(options.iblIntensity.value, 1000.0f); // kcd/m^2
    EXPECT_THAT(refused({ "--sky", "0.5", "0", "1", "0" }), HasSubstr("turbidity from 1 to 10"));
    EXPECT_THAT(refused({ "--sky", "2", "0", "0", "0" }), HasSubstr("not zero"));
    EXPECT_THAT(refused({ "--sky", "2", "0", "1", "0", "--environment", "a.hdr" }), HasSubstr("either a sky"));
    EXPECT_THAT(refused({ "--sky", "2", "0", "1", "0", "--sky-altitude", "6e4" }), HasSubstr("from 0 to 50000"));
    EXPECT_THAT(refused({ "--sky-altitude", "1" }), HasSubstr("with --sky"));
    EXPECT_THAT(refused({ "--sky-fog" }), HasSubstr("a --sky"));
}

TEST(Options, AQualityIsAPresetAndThenItsChangesInTheirOrder) {
    EXPECT_EQ(parsed({}).view.quality, Quality{});
    EXPECT_EQ(parsed({ "--quality", "low" }).view.quality, qualityPreset(QualityPreset::Low));
    Quality expected = qualityPreset(QualityPreset::Low);
    expected.shBands = 1;
    expected.fresnel = FresnelTerm::Exact;
    EXPECT_EQ(parsed({ "--set", "shBands=3", "--quality", "low", "--set", "fresnel=exact", "--set", "shBands=1" })
                      .view.quality,
              expected);
}

TEST(Options, APresetOfTheViewComesBeforeAQualityAndItsChanges) {
    View fine;
    applyPreset(fine, RenderPreset::Fine);
    EXPECT_EQ(parsed({ "--preset", "fine" }).view.quality, fine.quality);
    EXPECT_EQ(parsed({ "--preset", "fine" }).view.effects, fine.effects);
    EXPECT_EQ(parsed({ "--preset", "fine", "--quality", "low" }).view.quality, qualityPreset(QualityPreset::Low));
    const Options changed = parsed({ "--set", "bloom=off", "--set", "antiAliasing=fxaa", "--preset", "fine" });
    EXPECT_FALSE(changed.view.effects.bloom.enabled);
    EXPECT_EQ(changed.view.quality.antiAliasing, AntiAliasing::Fxaa);
    EXPECT_THAT(refused({ "--preset", "best" }), HasSubstr("fast, balanced, fine or cinematic"));
}

TEST(Options, AWrongQualityNamesWhatWouldBeRight) {
    const auto messageOf = [](std::vector<const char*> words) {
        words.insert(words.begin(), "filament-render");
        const auto result = parseOptions(static_cast<int>(words.size()), words.data());
        EXPECT_FALSE(result);
        return result ? std::string() : result.error().message;
    };
    EXPECT_NE(messageOf({ "--quality", "ultra" }).find("low, medium, high or reference"), std::string::npos);
    EXPECT_NE(messageOf({ "--set", "shBands" }).find("NAME=VALUE"), std::string::npos);
    EXPECT_NE(messageOf({ "--set", "environment.format=RGBE" }).find("RGBM"), std::string::npos);
    EXPECT_NE(messageOf({ "--set", "shBand=2" }).find("shBands"), std::string::npos);
    EXPECT_NE(messageOf({ "--set", "fresnel=no" }).find("schlick or exact"), std::string::npos);
}

TEST(Options, AllReachTheirFields) {
    const Options options = parsed({ "a b.glb",
                                     "--variant",
                                     "dark wood",
                                     "--environment",
                                     "sky.hdr",
                                     "--backend",
                                     "gles",
                                     "--size",
                                     "64x48",
                                     "--frames",
                                     "7",
                                     "--no-fit",
                                     "--eye",
                                     "-1",
                                     "-.5",
                                     "2e1",
                                     "--at",
                                     "1",
                                     "2",
                                     "3",
                                     "--fov",
                                     "60",
                                     "--exposure",
                                     "4",
                                     "0.01",
                                     "400",
                                     "--ibl-intensity",
                                     "5",
                                     "--sun",
                                     "1000",
                                     "0",
                                     "-1",
                                     "0.5",
                                     "--skybox",
                                     "off",
                                     "--tone-mapper",
                                     "filmic",
                                     "--dither",
                                     "on",
                                     "--tolerance",
                                     "2",
                                     "--out",
                                     "x/y",
                                     "--format",
                                     "exr",
                                     "--check-asset",
                                     "--timing",
                                     "--explain",
                                     "--trace",
                                     "--copies",
                                     "9",
                                     "--trace-jobs",
                                     "jobs.json",
                                     "--save-gltf",
                                     "scene.glb",
                                     "--save-frame",
                                     "frame",
                                     "--workers",
                                     "3",
                                     "--affinity",
                                     "big-cores",
                                     "--driver-core",
                                     "0",
                                     "--repin",
                                     "--require-device",
                                     "llvm" });
    EXPECT_EQ(options.model, "a b.glb");
    EXPECT_EQ(options.environment, "sky.hdr");
    EXPECT_EQ(options.backends, std::vector{ Backend::Gles });
    EXPECT_EQ(options.view.size, uint2(64, 48));
    EXPECT_EQ(options.frames, 7u);
    EXPECT_FALSE(options.fit);
    EXPECT_EQ(options.eye, double3(-1, -0.5, 20));
    EXPECT_EQ(options.at, double3(1, 2, 3));
    EXPECT_EQ(options.fovDegrees, 60.0f);
    EXPECT_EQ(options.exposure.iso, 400.0f);
    EXPECT_EQ(options.iblIntensity.value, 5.0f);
    ASSERT_TRUE(options.sun);
    EXPECT_EQ(options.sun->illuminance.value, 1000.0f);
    EXPECT_EQ(options.sun->directionWorld, float3(0, -1, 0.5f));
    EXPECT_FALSE(options.skybox);
    EXPECT_EQ(options.view.display.toneMapper, ToneMapper::Filmic);
    EXPECT_TRUE(options.view.display.dither);
    EXPECT_EQ(options.tolerance, 2u);
    EXPECT_EQ(options.out, "x/y");
    EXPECT_EQ(options.format, PictureFormat::Exr);
    EXPECT_TRUE(options.timing && options.explain && options.trace && options.checkAsset);
    EXPECT_EQ(options.copies, 9u);
    EXPECT_EQ(options.traceJobs, "jobs.json");
    EXPECT_EQ(options.saveFrame, "frame");
    EXPECT_EQ(options.saveGltf, "scene.glb");
    EXPECT_EQ(options.arguments.front(), "a b.glb");
    EXPECT_EQ(options.arguments.back(), "llvm");
    EXPECT_EQ(options.workers, 3);
    EXPECT_EQ(options.affinity, ThreadAffinity::BigCores);
    EXPECT_EQ(options.driverCore, 0);
    EXPECT_TRUE(options.repinAfterWaits);
    EXPECT_EQ(options.requireDevice, "llvm");
}

TEST(Options, AModelMayFollowAnOptionWithSeveralValues) {
    const Options options = parsed({ "--eye", "1", "2", "3", "model.glb" });
    EXPECT_EQ(options.model, "model.glb");
    EXPECT_EQ(options.eye, double3(1, 2, 3));
}

TEST(Options, EveryRefusalNamesTheOptionTheValueAndTheCure) {
    struct Case {
        std::initializer_list<const char*> arguments;
        const char *option, *value, *cure;
    };
    const Case cases[] = {
        { { "--backend", "metal" }, "--backend", "metal", "vulkan, gles or both" },
        { { "--size", "0x720" }, "--size", "0x720", "16384" },
        { { "--size", "1280" }, "--size", "1280", "WIDTHxHEIGHT" },
        { { "--size", "-5x5" }, "--size", "-5x5", "WIDTHxHEIGHT" },
        { { "--size", "99999x99999" }, "--size", "99999", "16384" },
        { { "--size", "4294967297x1" }, "--size", "4294967297", "16384" },
        { { "--frames", "0" }, "--frames", "0", "from 1" },
        { { "--frames", "1.5" }, "--frames", "1.5", "whole number" },
        { { "--copies", "0" }, "--copies", "0", "from 1" },
        { { "--workers", "-2" }, "--workers", "-2", "0 to 256" },
        { { "--workers", "257" }, "--workers", "257", "0 to 256" },
        { { "--affinity", "all" }, "--affinity", "all", "big-cores" },
        { { "--driver-core", "first" }, "--driver-core", "first", "none, last or the number" },
        { { "--driver-core", "-1" }, "--driver-core", "-1", "none, last or the number" },
        { { "--eye", "nan", "0", "0" }, "--eye", "nan 0 0", "finite" },
        { { "--eye", "0", "inf", "0" }, "--eye", "inf", "finite" },
        { { "--at", "0", "1e999", "0" }, "--at", "1e999", "finite" },
        { { "--at", "0", "zero", "0" }, "--at", "zero", "three" },
        { { "--fov", "180" }, "--fov", "180", "179" },
        { { "--fov", "NaN" }, "--fov", "NaN", "degrees" },
        { { "--exposure", "0", "1", "100" }, "--exposure", "0 1 100", "aperture" },
        { { "--exposure", "16", "nan", "100" }, "--exposure", "nan", "aperture" },
        { { "--ibl-intensity", "-1" }, "--ibl-intensity", "-1", "lux" },
        { { "--sun", "1000", "0", "0", "0" }, "--sun", "1000 0 0 0", "not zero" },
        { { "--sun", "nan", "0", "-1", "0" }, "--sun", "nan", "lux" },
        { { "--skybox", "maybe" }, "--skybox", "maybe", "on or off" },
        { { "--dither", "2" }, "--dither", "2", "on or off" },
        { { "--tone-mapper", "reinhard" }, "--tone-mapper", "reinhard", "aces" },
        { { "--format", "jpg" }, "--format", "jpg", "png, png16 or exr" },
        { { "--tolerance", "256" }, "--tolerance", "256", "255" },
        { { "--out", "" }, "--out", "''", "folder" },
    };
    for (Case const& bad : cases) {
        const std::string message = refused(bad.arguments);
        EXPECT_THAT(message, HasSubstr(bad.option));
        EXPECT_THAT(message, HasSubstr(bad.value));
        EXPECT_THAT(message, HasSubstr(bad.cure));
    }
}

TEST(Options, WhatIsNotAnOptionIsRefusedOnOneLineThatPointsToTheHelp) {
    for (auto arguments : { std::initializer_list<const char*>{ "--enviroment", "sky.hdr" },
                            { "--eye", "1", "2" },
                            { "--size" },
                            { "one.glb", "two.glb" },
                            { "-nan" } }) {
        const std::string message = refused(arguments);
        EXPECT_THAT(message, HasSubstr("--help"));
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

TEST(Options, EyeAndTargetAtOnePointAreRefused) {
    EXPECT_THAT(refused({ "--eye", "1", "2", "3", "--at", "1", "2", "3" }), HasSubstr("same point"));
}

} // namespace
} // namespace filament_core::tools
