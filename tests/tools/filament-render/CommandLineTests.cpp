// SPDX-License-Identifier: Apache-2.0
// The program as a user starts it: every bad input ends with one line and a status, never with a crash.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/image/HdrReader.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/showcase/Showcase.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace filament_core::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string textOf(std::filesystem::path const& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void writeText(std::filesystem::path const& path, std::string const& text) {
    ASSERT_TRUE(assets::replaceFile(path, std::as_bytes(std::span(text))).ok());
}

/// A complete triangle: positions as a data URI.
std::string triangleGltf() {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,)"
           R"("count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
           R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
           R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

class RenderProgram : public ::testing::Test {
protected:
    struct Outcome {
        int status = -1; ///< 128 and more: ended by a signal; 124: took too long
        std::string output, errors;
    };

    static void SetUpTestSuite() {
        sFolder = std::filesystem::temp_directory_path() / ("filament_render_tests_" + std::to_string(::getpid()));
        jobs::JobSystem jobs;
        const auto files = showcase::writeFiles(sFolder, jobs);
        ASSERT_TRUE(files.ok()) << files.error().message;
        writeText(sFolder / "triangle.gltf", triangleGltf());
    }
    static void TearDownTestSuite() { std::filesystem::remove_all(sFolder); }

    /// `environment`: "NAME=value" words for the process.
    static Outcome run(std::string const& arguments, std::string const& environment = "") {
        const std::string command = "cd '" + sFolder.string() + "' && env " + environment + " timeout 120 " +
                                    (tools::buildDir() / "bin/filament-render ").string() + arguments +
                                    " >output 2>errors </dev/null";
        const int status = std::system(command.c_str());
        return { WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), textOf(sFolder / "output"),
                 textOf(sFolder / "errors") };
    }

    /// Ends with status 1 and exactly one line on standard error, which contains `words`.
    static void expectRefused(std::string const& arguments, std::initializer_list<const char*> words,
                              std::string const& environment = "") {
        const Outcome outcome = run(arguments, environment);
        EXPECT_EQ(outcome.status, 1) << arguments << "\n" << outcome.errors;
        EXPECT_THAT(outcome.errors, StartsWith("filament-render: error: ")) << arguments;
        EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
        for (const char* word : words) EXPECT_THAT(outcome.errors, HasSubstr(word)) << arguments;
    }

    static void truncate(const char* from, const char* to, double part) {
        const std::string whole = textOf(sFolder / from);
        writeText(sFolder / to, whole.substr(0, static_cast<size_t>(static_cast<double>(whole.size()) * part)));
    }

    static inline std::filesystem::path sFolder;
};

TEST_F(RenderProgram, ATriangleIsTheSameBitsOnBothBackendsAndReported) {
    const Outcome outcome =
            run("triangle.gltf --size 160x90 --sun 100000 0 -1 -1 --frames 30 --out ok --timing --explain");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors, "");
    EXPECT_THAT(outcome.output, HasSubstr("identical: 100.0000 % of pixels, max difference 0/255"));
    for (const char* file : { "vulkan.png", "gles.png", "diff.png" }) {
        EXPECT_TRUE(std::filesystem::exists(sFolder / "ok" / file)) << file;
    }
    const auto report = nlohmann::json::parse(textOf(sFolder / "ok" / "report.json"));
    EXPECT_EQ(report["size"], nlohmann::json({ 160, 90 }));
    for (const char* backend : { "vulkan", "gles" }) {
        auto const& run = report["backends"][backend];
        EXPECT_EQ(run["frames"].size(), 30u) << backend;
        EXPECT_EQ(run["counts"]["renderables"], 1) << backend;
        EXPECT_EQ(run["counts"]["pipelinesCreatedDuringDraws"], 0) << backend;
        EXPECT_EQ(run["steady"]["pipelinesCreated"], 0) << backend;
        EXPECT_EQ(run["steady"]["heapAllocations"], 0) << backend;
        EXPECT_GE(run["passes"].size(), 1u) << backend;
        EXPECT_GT(run["start"]["firstFrameMs"], 0.0) << backend;
    }
}

TEST_F(RenderProgram, ASavedFrameHoldsThePictureAndATraceOfEachApiThatDrawsIt) {
    const Outcome outcome =
            run("triangle.gltf --size 80x45 --sun 100000 0 -1 -1 --backend gles --out saved --save-frame saved/frame");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors, "");
    EXPECT_THAT(outcome.output, HasSubstr("saved/frame: filament-replay draws it again"));
    EXPECT_EQ(textOf(sFolder / "saved" / "frame" / "picture.png"), textOf(sFolder / "saved" / "gles.png"));
    const auto frame = nlohmann::json::parse(textOf(sFolder / "saved" / "frame" / "frame.json"));
    EXPECT_EQ(frame["settings"]["arguments"][0], "triangle.gltf");
    ASSERT_EQ(frame["traces"].size(), 2u); // also of the API that the command line did not request
    for (auto const& trace : frame["traces"]) {
        EXPECT_EQ(trace["problem"], "");
        EXPECT_EQ(trace["pictures"][0]["hash"], frame["pictures"][0]["hash"]);
    }
    expectRefused("triangle.gltf --size 80x45 --out saved --save-frame triangle.gltf", { "triangle.gltf" });
}

TEST_F(RenderProgram, CheckingAnAssetDrawsNothingAndEndsWithWhetherItIsPlausible) {
    const std::string triangle = triangleGltf();
    const auto withColor = [&](const char* file, const char* color) {
        std::string text = triangle;
        text.replace(text.find(R"("POSITION":0}})"), 14, R"("POSITION":0},"material":0})");
        text.insert(text.size() - 1, std::string(R"(,"materials":[{"name":"paint","pbrMetallicRoughness":)") +
                                             R"({"metallicFactor":0,"baseColorFactor":)" + color + "}}]");
        writeText(sFolder / file, text);
    };
    withColor("fine.gltf", "[0.5,0.5,0.5,1]");
    withColor("coal.gltf", "[0.01,0.01,0.01,1]");
    const Outcome fine = run("fine.gltf --check-asset --out none"), coal = run("coal.gltf --check-asset --out none");
    EXPECT_EQ(fine.status, 0) << fine.errors;
    EXPECT_EQ(fine.output, "fine.gltf: 1 materials: 0 with values that no real material has, 0 not checked\n");
    EXPECT_EQ(coal.status, 1) << coal.errors;
    EXPECT_EQ(coal.errors, "");
    EXPECT_THAT(coal.output, HasSubstr("material 'paint': 100.0 % of its texels: darkAlbedo: "));
    EXPECT_FALSE(std::filesystem::exists(sFolder / "none"));
    expectRefused("--check-asset", { "--check-asset", "name the model" });
    expectRefused("missing.glb --check-asset", { "missing.glb" });
}

TEST_F(RenderProgram, AFullStandardOutputIsAnError) {
    for (const char* arguments : { "--list-devices", "--help" }) {
        const std::string command = (tools::buildDir() / "bin/filament-render ").string() + arguments +
                                    " >/dev/full 2>" + (sFolder / "errors").string();
        const int status = std::system(command.c_str());
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << arguments;
        EXPECT_THAT(textOf(sFolder / "errors"), HasSubstr("cannot write to the standard output: No space left"));
    }
}

nlohmann::json decisionOf(nlohmann::json const& decisions, std::string_view name) {
    for (nlohmann::json const& decision : decisions) {
        if (decision["name"] == name) return decision;
    }
    ADD_FAILURE() << "no decision about " << name;
    return {};
}

TEST_F(RenderProgram, SteadyFramesWithASkyTakeNothingFromTheHeap) {
    for (const char* more : { "", " --set toneMapping=table32 --set textureFilter=trilinear" }) {
        const Outcome outcome = run("triangle.gltf --size 96x54 --environment showcase.hdr --frames 30 --out sky "
                                    "--timing --explain" +
                                    std::string(more));
        ASSERT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_THAT(outcome.output, HasSubstr("fills what nothing covers"));
        const auto report = nlohmann::json::parse(textOf(sFolder / "sky" / "report.json"));
        for (const char* backend : { "vulkan", "gles" }) {
            auto const& steady = report["backends"][backend]["steady"];
            auto const& decisions = report["backends"][backend]["decisions"];
            EXPECT_EQ(decisionOf(decisions, "sky")["state"], "needed");
            EXPECT_EQ(decisionOf(decisions, "shadows")["state"], "not needed");
            EXPECT_GT(decisionOf(decisions, "color")["gpuMs"], 0.0);
            EXPECT_GE(steady["frames"], 10) << backend;
            EXPECT_EQ(steady["heapAllocations"], 0) << backend << more;
        }
    }
}

TEST_F(RenderProgram, TimesOfPassesSumUpToThatOfTheFrame) {
    const Outcome outcome = run("triangle.gltf --size 96x54 --frames 2 --out timed --timing --set bloom=on");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    const auto report = nlohmann::json::parse(textOf(sFolder / "timed" / "report.json"));
    for (const char* backend : { "vulkan", "gles" }) {
        double sum = 0;
        for (auto const& pass : report["backends"][backend]["passes"]) sum += pass["gpuMs"]["median"].get<double>();
        const double frame = report["backends"][backend]["steady"]["gpuMs"]["median"];
        EXPECT_NEAR(sum, frame, 1e-6) << backend << ": of the only steady frame, whose passes of bloom share names";
        EXPECT_GT(frame, 0.0);
    }
}

TEST_F(RenderProgram, SteadyFramesWithShadowsTakeNothingFromTheHeap) {
    for (const std::string more : { "shadows=pcf3", "shadows=pcss --set shadowCascades=4", "shadows=vsm",
                                    "shadows=evsm --set sun.showsDisc=on", "debugView=atlas" }) {
        const Outcome outcome = run("triangle.gltf --size 96x54 --sun 100000 0.2 -1 -1 --frames 30 --out shadowed "
                                    "--timing --set " +
                                    more);
        ASSERT_EQ(outcome.status, 0) << outcome.errors;
        const auto report = nlohmann::json::parse(textOf(sFolder / "shadowed" / "report.json"));
        for (const char* backend : { "vulkan", "gles" }) {
            auto const& run = report["backends"][backend];
            EXPECT_EQ(decisionOf(run["decisions"], "shadows")["state"], "needed") << more;
            EXPECT_GE(run["steady"]["frames"], 10) << backend;
            // What a blur needed goes 16 frames after the only frame that blurred: a driver notes it in a list that
            // grows.
            const int atMost = more.find("vsm") == std::string::npos ? 0 : 1;
            EXPECT_LE(run["steady"]["heapAllocations"], atMost) << backend << ' ' << more;
        }
    }
}

TEST_F(RenderProgram, AMaterialIsShownWithTheValuesOfItsFileAndOfTheCommandLine) {
    writeText(sFolder / "tint.mat", R"(// show: tint=0.5,0.5,0.5 gloss=0.2
        material { parameters : [ { name : tint, type : float3 }, { name : gloss, type : float } ] }
        fragment { void material(inout MaterialInputs m) {
            prepareMaterial(m); m.baseColor.rgb = materialParams.tint; m.roughness = materialParams.gloss; } })");
    const Outcome shown = run("tint.mat --size 64x64 --parameter tint=1,0,0 --out material");
    EXPECT_EQ(shown.status, 0) << shown.errors;
    EXPECT_THAT(shown.output, HasSubstr("identical: 100.0000 % of pixels"));
    expectRefused("tint.mat --parameter tnit=1,0,0", { "tnit", "did you mean 'tint'?" });
    expectRefused("tint.mat --parameter tint=1,0", { "tint", "3 numbers" });
    expectRefused("tint.mat --parameter tint", { "--parameter", "NAME=VALUE" });
    writeText(sFolder / "broken.mat", "material {}\nfragment { void main2() {} }");
    expectRefused("broken.mat", { "broken.mat:2", "material(" });
}

TEST_F(RenderProgram, AModelThatIsNotThereIsNamed) { expectRefused("missing.glb --size 32x32", { "missing.glb" }); }

TEST_F(RenderProgram, AVariantThatTheModelDoesNotHaveIsNamed) {
    expectRefused("triangle.gltf --variant red --size 32x32", { "triangle.gltf", "no variants", "'red'" });
}

TEST_F(RenderProgram, AFolderIsNotAModel) {
    std::filesystem::create_directories(sFolder / "folder.glb");
    expectRefused("folder.glb --size 32x32", { "folder.glb" });
}

TEST_F(RenderProgram, ATruncatedModelIsNamed) {
    for (const double part : { 0.0, 0.000002, 0.001, 0.3, 0.99 }) {
        truncate("showcase.glb", "cut.glb", part);
        expectRefused("cut.glb --backend gles --size 32x32", { "cut.glb" });
    }
}

TEST_F(RenderProgram, AnEnvironmentThatIsNotThereIsNamed) {
    expectRefused("triangle.gltf --size 32x32 --environment missing.hdr", { "missing.hdr" });
    expectRefused("triangle.gltf --size 32x32 --environment .", { "." });
}

TEST_F(RenderProgram, ATruncatedEnvironmentIsNamed) {
    for (const double part : { 0.0, 0.0001, 0.5 }) {
        truncate("showcase.hdr", "cut.hdr", part);
        expectRefused("triangle.gltf --backend gles --size 32x32 --environment cut.hdr", { "cut.hdr" });
    }
}

TEST_F(RenderProgram, NotANumberInsideAModelIsNoCrash) {
    std::string text = triangleGltf();
    const std::string positions = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    text.replace(text.find(positions), 8, "AADAfwAA"); // the first float is a NaN
    writeText(sFolder / "nan.gltf", text);
    const Outcome outcome = run("nan.gltf --backend gles --size 32x32 --out nan");
    EXPECT_LE(outcome.status, 1) << outcome.errors;
    EXPECT_NE(outcome.errors, "");
}

TEST_F(RenderProgram, AModelThatCannotBeDrawnAsItSaysEndsWithAStatus) {
    const auto expectStatus = [](const char* added, const char* reason) {
        std::string text = triangleGltf();
        text.insert(text.find(R"("attributes")"), R"("material":0,)");
        text.insert(text.find('{') + 1, added);
        writeText(sFolder / "lacking.gltf", text);
        const Outcome outcome = run("lacking.gltf --backend gles --size 32x32 --out lacking");
        EXPECT_EQ(outcome.status, 1) << added;
        EXPECT_NE(outcome.errors.find(reason), std::string::npos) << outcome.errors;
    };
    expectStatus(R"("extensionsRequired": [ "EXT_wax" ], "extensionsUsed": [ "EXT_wax" ], "materials": [ {} ],)",
                 "EXT_wax is required");
    expectStatus(R"("images": [ { "uri": "none.png" } ], "textures": [ { "source": 0 } ],
                    "materials": [ { "emissiveTexture": { "index": 0 } } ],)",
                 "none.png");
}

// KHR_animation_pointer: the triangle begins to shine. Its keys are numbers of its positions.
TEST_F(RenderProgram, TimeMovesWhatAnimationsPointTo) {
    auto file = nlohmann::json::parse(triangleGltf());
    file["materials"] = nlohmann::json::parse(
            R"([ { "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 100000 } } } ])");
    file["meshes"][0]["primitives"][0]["material"] = 0;
    const auto add = [&](size_t offset, const char* type) {
        file["accessors"].push_back({ { "bufferView", 0 },
                                      { "byteOffset", offset },
                                      { "componentType", 5126 },
                                      { "count", 2 },
                                      { "type", type } });
        return file["accessors"].size() - 1;
    };
    const size_t times = add(8, "SCALAR"), colors = add(0, "VEC3"); // 0, 1; black, red
    nlohmann::json target{ { "path", "pointer" } };
    target["extensions"]["KHR_animation_pointer"]["pointer"] = "/materials/0/emissiveFactor";
    file["animations"] = { { { "samplers", { { { "input", times }, { "output", colors } } } },
                             { "channels", { { { "sampler", 0 }, { "target", target } } } } } };
    writeText(sFolder / "shining.gltf", file.dump());
    for (const char* seconds : { "0", "1" }) {
        const Outcome outcome = run(std::string("shining.gltf --size 32x32 --time ") + seconds + " --out at" + seconds);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_THAT(outcome.output, HasSubstr("identical: 100.0000 % of pixels"));
    }
    EXPECT_NE(textOf(sFolder / "at0" / "gles.png"), textOf(sFolder / "at1" / "gles.png"));
}

TEST_F(RenderProgram, AZeroSizeIsRefused) { expectRefused("triangle.gltf --size 0x0", { "--size", "0x0" }); }

TEST_F(RenderProgram, AnUnknownBackendIsRefused) {
    expectRefused("triangle.gltf --backend metal", { "--backend", "metal", "vulkan, gles or both" });
}

TEST_F(RenderProgram, AnUnknownDeviceIsRefusedOnce) {
    expectRefused("triangle.gltf --size 32x32 --require-device 'no such card'", { "no such card" });
    expectRefused("triangle.gltf --size 32x32 --backend gles --require-device 'no such card'", { "no such card" });
}

TEST_F(RenderProgram, NotANumberOnTheCommandLineIsRefused) {
    expectRefused("triangle.gltf --eye nan 0 0", { "--eye", "nan" });
    expectRefused("triangle.gltf --exposure 16 nan 100", { "--exposure", "nan" });
}

TEST_F(RenderProgram, AFolderThatCannotBeWrittenIsNamed) {
    writeText(sFolder / "file", "");
    expectRefused("triangle.gltf --backend gles --size 32x32 --out file", { "--out", "file" });
    expectRefused("triangle.gltf --backend gles --size 32x32 --out /proc/here", { "--out", "/proc/here" });
}

TEST_F(RenderProgram, WithoutAVulkanDriverVulkanIsRefusedAndOpenGlEsStillDrawn) {
    const std::string none = "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent";
    expectRefused("triangle.gltf --size 32x32 --backend vulkan --out vk", { "Vulkan" }, none);
    expectRefused("triangle.gltf --size 32x32 --out only_gles", { "Vulkan" }, none);
    EXPECT_TRUE(std::filesystem::exists(sFolder / "only_gles" / "gles.png"));
    EXPECT_FALSE(std::filesystem::exists(sFolder / "only_gles" / "vulkan.png"));
    const auto report = nlohmann::json::parse(textOf(sFolder / "only_gles" / "report.json"));
    EXPECT_TRUE(report["backends"].contains("gles"));
    EXPECT_THAT(report["errors"].dump(), HasSubstr("Vulkan"));
    const Outcome devices = run("--list-devices", none);
    EXPECT_EQ(devices.status, 0) << devices.errors;
    EXPECT_THAT(devices.output, StartsWith("gles"));
}

TEST_F(RenderProgram, WithoutAnEglVendorOpenGlEsIsRefusedAndVulkanStillDrawn) {
    const std::string none = "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent";
    expectRefused("triangle.gltf --size 32x32 --out only_vulkan", { "EGL" }, none);
    EXPECT_TRUE(std::filesystem::exists(sFolder / "only_vulkan" / "vulkan.png"));
    EXPECT_FALSE(std::filesystem::exists(sFolder / "only_vulkan" / "gles.png"));
}

TEST_F(RenderProgram, WithoutAnyDriverTheOneLineNamesBoth) {
    const std::string none =
            "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent";
    expectRefused("triangle.gltf --size 32x32", { "Vulkan", "EGL" }, none);
    expectRefused("--list-devices", { "no device" }, none);
}

TEST_F(RenderProgram, PicturesOfTenBitsArePngsOf16WithTheSameBitsAsWell) {
    const Outcome outcome = run("triangle.gltf --size 64x64 --sun 100000 0 -1 -1 --format png16 --set "
                                "outputSpace=rec2020Pq --tone-mapper linear --out ten");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("identical: 100.0000 %"));
    for (const char* file : { "vulkan.png", "gles.png" }) {
        const auto bytes = assets::readFileBytes(sFolder / "ten" / file);
        ASSERT_TRUE(bytes.ok());
        EXPECT_EQ((*bytes)[24], std::byte{ 16 }) << file; // bits of a channel, PNG 11.2.2
    }
}

TEST_F(RenderProgram, LinearPicturesAreHalfFloatsWithTheSameBitsAsWell) {
    const Outcome outcome = run("triangle.gltf --size 64x64 --sun 100000 0 -1 -1 --format exr --out exr");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("identical: 100.0000 %"));
    EXPECT_TRUE(std::filesystem::exists(sFolder / "exr" / "vulkan.exr"));
    EXPECT_TRUE(std::filesystem::exists(sFolder / "exr" / "gles.exr"));
}

TEST_F(RenderProgram, AModelThatNothingLightsStandsUnderTheShowcasesSkyUnlessNoneIsAskedFor) {
    const auto brightest = [](const char* environment) {
        EXPECT_EQ(run(std::string("triangle.gltf --backend gles --size 32x32 --format exr --out sky ") + environment)
                          .status,
                  0);
        const auto picture = assets::readHdrImage(sFolder / "sky" / "gles.exr");
        EXPECT_TRUE(picture) << environment;
        float most = 0;
        if (picture) {
            for (const float3 pixel : picture->pixels) most = std::max({ most, pixel.x, pixel.y, pixel.z });
        }
        return most;
    };
    EXPECT_GT(brightest(""), 0.1f);
    EXPECT_EQ(brightest("--environment none"), 0.0f);
}

/// A triangle under a sky of its own: red, green and blue of 0.25, 0.5 and 1.
std::vector<std::byte> triangleWithLight() {
    assets::CubeLight light;
    assets::IblCubeLevel& level = light.levels.emplace_back(1);
    for (uint32_t face = 0; face < 6; ++face) level.at(face, 0, 0) = assets::Texel{ 0.25f, 0.5f, 1, 0 };
    light.irradianceSh[0] = float4(0.25f, 0.5f, 1, 0);
    light.worldFromCube[2].z = -1;
    assets::GlbScene scene;
    scene.imageBasedLight = *assets::glbImageBasedLight(light, scene.images);
    scene.meshes = { { .name = "triangle",
                       .primitives = { { .positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } } } } } };
    scene.nodes = { { .name = "triangle", .mesh = 0 } };
    return *assets::writeGlb(scene);
}

TEST_F(RenderProgram, AModelStandsUnderItsOwnSkyUnlessAnotherIsNamed) {
    ASSERT_TRUE(assets::replaceFile(sFolder / "light.glb", triangleWithLight()).ok());
    const auto corner = [](std::string const& more) {
        const Outcome outcome = run("light.glb --size 32x32 --format exr --out own " + more);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_THAT(outcome.output, HasSubstr("identical: 100.0000 %"));
        const auto picture = assets::readHdrImage(sFolder / "own" / "gles.exr");
        EXPECT_TRUE(picture) << more;
        return picture ? picture->at(0, 0) : float3(0);
    };
    const auto environmentInReport = [] {
        return nlohmann::json::parse(textOf(sFolder / "own" / "report.json"))["environment"].get<std::string>();
    };
    const float3 own = corner("--exposure 1 1 100 --ibl-intensity 1.2");
    EXPECT_NEAR(own.x, 0.25f, 3e-3f); // codes of 8 bits
    EXPECT_NEAR(own.y, 0.5f, 3e-3f);
    EXPECT_NEAR(own.z, 1, 3e-3f);
    EXPECT_EQ(environmentInReport(), "light.glb (EXT_lights_image_based)");
    EXPECT_EQ(corner("--exposure 1 1 100 --ibl-intensity 1.2 --sun 1000 0 -1 0"), own) << "a sun is no environment";
    EXPECT_EQ(corner("--environment none"), float3(0));
    EXPECT_EQ(environmentInReport(), "");
    EXPECT_GT(corner("--environment showcase.hdr").y, 0.01f);
    EXPECT_EQ(environmentInReport(), "showcase.hdr");
    EXPECT_EQ(corner("--skybox off"), float3(0)) << "only the triangle is lit";
}

TEST_F(RenderProgram, HelpListsTheOptionsAndSucceeds) {
    const Outcome outcome = run("--help");
    EXPECT_EQ(outcome.status, 0);
    for (const char* option : { "--variant",      "--environment",    "--backend",       "--size",
                                "--frames",       "--no-fit",         "--eye",           "--at",
                                "--fov",          "--exposure",       "--ibl-intensity", "--sun",
                                "--skybox",       "--tone-mapper",    "--dither",        "--out",
                                "--format",       "--timing",         "--explain",       "--check-asset",
                                "--list-devices", "--require-device", "--tolerance" }) {
        EXPECT_THAT(outcome.output, HasSubstr(option));
    }
}

} // namespace
} // namespace filament_core::tools
