// SPDX-License-Identifier: Apache-2.0
// filament-reference from outside: its options, its files, its one-line errors.
#include "tests/tools/reference/TestScenes.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/image/HdrReader.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/paths/Paths.h"
#include "tools/reference/Output.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace filament_core::reference {
namespace {

using ::testing::HasSubstr;

Result<std::optional<Options>> parse(std::vector<const char*> words) {
    words.insert(words.begin(), "filament-reference");
    return parseOptions(static_cast<int>(words.size()), words.data());
}

TEST(Options, AreThoseOfFilamentRenderAndItsOwn) {
    const auto parsed = parse({ "m.glb",
                                "--environment",
                                "s.hdr",
                                "--size",
                                "32x16",
                                "--eye",
                                "1",
                                "2",
                                "3",
                                "--sun",
                                "5",
                                "0",
                                "-1",
                                "0",
                                "--integrator",
                                "unoccluded",
                                "--spp",
                                "64",
                                "--error",
                                "0.01",
                                "--seed",
                                "7",
                                "--max-bounces",
                                "3",
                                "--filter",
                                "center",
                                "--occlusion-map",
                                "off",
                                "--visibility",
                                "fast",
                                "--fresnel",
                                "exact",
                                "--diffuse",
                                "disney",
                                "--energy",
                                "single-scatter",
                                "--coupling",
                                "always",
                                "--lobes",
                                "specular",
                                "--ibl-rotation",
                                "90",
                                "--threads",
                                "2",
                                "--error-image" });
    ASSERT_TRUE(parsed.ok() && *parsed) << (parsed ? "" : parsed.error().message);
    Options const& options = **parsed;
    EXPECT_EQ(options.model, "m.glb");
    EXPECT_EQ(options.view.size, uint2(32, 16));
    EXPECT_EQ(options.eye, double3(1, 2, 3));
    EXPECT_EQ(options.sun->illuminance.value, 5);
    ReferenceSettings const& settings = options.settings;
    EXPECT_EQ(settings.integrator, Integrator::Unoccluded);
    EXPECT_EQ(settings.samplesPerPixel, 64u);
    EXPECT_EQ(settings.relativeError, 0.01f);
    EXPECT_EQ(settings.seed, 7u);
    EXPECT_EQ(settings.maxBounces, 3u);
    EXPECT_EQ(settings.filter, PixelFilter::Center);
    EXPECT_EQ(settings.occlusionMap, Switch::Off);
    EXPECT_EQ(settings.bsdf, (BsdfModel{ SpecularVisibility::Fast, FresnelTerm::Exact, DiffuseTerm::Disney,
                                         EnergyTerm::SingleScatter, CouplingTerm::Always, LobeChoice::Specular }));
    EXPECT_EQ(options.rotationDegrees, 90);
    EXPECT_EQ(options.workers, 1);
    EXPECT_TRUE(options.writesErrors);
}

TEST(Options, EveryRefusalNamesTheOptionTheValueAndTheCure) {
    struct Case {
        std::vector<const char*> words;
        const char *option, *cure;
    };
    for (Case const& bad : { Case{ { "--spp", "0" }, "--spp", "1048576" },
                             { { "--error", "0" }, "--error", "1e-6" },
                             { { "--integrator", "photon" }, "--integrator", "path or unoccluded" },
                             { { "--visibility", "none" }, "--visibility", "correlated, fast or uncorrelated" },
                             { { "--specular-light", "sum" }, "--specular-light", "integral or split-sum" },
                             { { "--diffuse-light", "sh" }, "--diffuse-light", "integral or harmonics" },
                             { { "--max-bounces", "1e3" }, "--max-bounces", "4096" },
                             { { "--threads", "0" }, "--threads", "from 1" },
                             { { "--ibl-rotation", "nan" }, "--ibl-rotation", "degrees" },
                             { { "--size", "5" }, "--size", "WIDTHxHEIGHT" },
                             { { "--tile", "0,0,0,1" }, "--tile", "X,Y,W,H" },
                             { { "--samples", "1,16" }, "--samples", "multiples of 16" },
                             { { "--shard", "2/2" }, "--shard", "0 <= I < N" },
                             { { "--shard", "0/2", "--tile", "0,0,8,8" }, "--shard", "without --tile" },
                             { { "--shard", "0/2", "--error", "0.1" }, "--error", "--spp" },
                             { { "--merge", "a", "--shard", "0/2" }, "--merge", "without it" },
                             { { "--merge", "a", "--spp", "8" }, "--merge", "leave out '--spp 8'" },
                             { { "--nonsense" }, "nonsense", "filament-reference --help" } }) {
        const auto parsed = parse(bad.words);
        ASSERT_FALSE(parsed.ok()) << bad.option;
        EXPECT_THAT(parsed.error().message, HasSubstr(bad.option));
        EXPECT_THAT(parsed.error().message, HasSubstr(bad.cure));
        EXPECT_EQ(parsed.error().message.find('\n'), std::string::npos);
    }
}

TEST(Output, PixelsGoThroughTheEnginesToneMapper) {
    ReferenceImage image{ .width = 3, .height = 1, .color = { float3(0), float3(0.5f), float3(1e6f, -1, 0.18f) } };
    const std::vector<std::byte> linear = displayPixels(image, { .toneMapper = ToneMapper::Linear });
    const auto code = [](double v) { return std::byte(static_cast<uint8_t>(std::lround(v * 255))); };
    EXPECT_EQ(linear[0], std::byte{ 0 });
    EXPECT_EQ(linear[3], std::byte{ 255 });
    EXPECT_EQ(linear[4], code(1.055 * std::pow(0.5, 1 / 2.4) - 0.055));
    EXPECT_EQ(linear[8], std::byte{ 255 });
    EXPECT_EQ(linear[9], std::byte{ 0 });
    EXPECT_EQ(linear[10], code(1.055 * std::pow(0.18, 1 / 2.4) - 0.055));
    const std::vector<std::byte> mobile = displayPixels(image, { .toneMapper = ToneMapper::Mobile });
    EXPECT_EQ(mobile[4], code(0.5 / 0.655 * 1.019)) << "its transfer function is included";
}

/// A folder that is deleted with the test.
class Program : public ::testing::Test {
protected:
    Program() { std::filesystem::create_directories(mFolder); }
    ~Program() override { std::filesystem::remove_all(mFolder); }

    struct Outcome {
        int status = -1;
        std::string text; // standard output and standard error
    };
    Outcome run(std::string const& arguments) const {
        const std::string command = "cd '" + mFolder.string() + "' && '" +
                                    (tools::buildDir() / "bin/filament-reference").string() + "' " + arguments +
                                    " 2>&1";
        std::FILE* const pipe = ::popen(command.c_str(), "r");
        Outcome outcome;
        std::array<char, 512> buffer{};
        while (std::fgets(buffer.data(), buffer.size(), pipe)) outcome.text += buffer.data();
        outcome.status = WEXITSTATUS(::pclose(pipe));
        return outcome;
    }
    std::string read(const char* name) const {
        std::ifstream file(mFolder / name, std::ios::binary);
        return { std::istreambuf_iterator<char>(file), {} };
    }
    /// One glowing triangle, facing +z.
    void writeModel() const {
        std::ofstream(mFolder / "triangle.gltf") << R"({ "asset": { "version": "2.0" },
            "buffers": [ { "byteLength": 36, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA" } ],
            "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
            "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1,-1,0], "max": [1,1,0] } ],
            "materials": [ { "emissiveFactor": [1, 0.5, 0.25] } ],
            "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0 } ] } ],
            "nodes": [ { "mesh": 0 } ], "scenes": [ { "nodes": [ 0 ] } ], "scene": 0 })";
    }

    std::filesystem::path mFolder =
            std::filesystem::temp_directory_path() / ("filament-reference-" + std::to_string(::getpid()));
};

TEST_F(Program, WritesPictureErrorsAndReport) {
    writeModel();
    const Outcome outcome = run("triangle.gltf --environment none --size 16x8 --eye 0 0 2 --spp 16 --error-image "
                                "--tone-mapper linear --out out");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto picture = assets::readHdrImage(mFolder / "out/reference.exr");
    ASSERT_TRUE(picture.ok());
    ASSERT_EQ(picture->width, 16u);
    EXPECT_EQ(picture->at(8, 4), float3(1, 0.5f, 0.25f));
    EXPECT_EQ(picture->at(0, 0), float3(0));
    EXPECT_TRUE(assets::readHdrImage(mFolder / "out/error.exr").ok());
    const auto display = assets::readPng(mFolder / "out/reference.png");
    ASSERT_TRUE(display.ok());
    EXPECT_EQ(display->data[(4 * 16 + 8) * 4], std::byte{ 255 });
    const auto report = nlohmann::json::parse(read("out/report.json"));
    EXPECT_EQ(report["samplesPerPixel"], 16);
    EXPECT_EQ(report["lostSamples"], 0);
    EXPECT_GT(report["relativeStandardError"], 0) << "edges are noisy";
    EXPECT_GT(report["rays"], 16 * 8 * 16 - 1);
    EXPECT_FALSE(report.contains("seconds")) << "the same run gives the same bytes";
    EXPECT_GT(nlohmann::json::parse(read("out/times.json"))["seconds"], 0);
    EXPECT_EQ(outcome.text.find('\r'), std::string::npos) << "no progress bar into a pipe";
}

// A quad that mirrors what is behind the camera, in front of what it does not cover.
TEST_F(Program, AModelStandsUnderItsOwnSkyUnlessAnotherIsNamed) {
    assets::CubeLight light;
    assets::IblCubeLevel& level = light.levels.emplace_back(16);
    for (uint32_t i = 0; i < 6 * 256; ++i) {
        const uint32_t face = i / 256;
        level.at(face, static_cast<int>(i % 16), static_cast<int>(i / 16 % 16)) =
                assets::Texel{ face == 4 ? 1.0f : 0.0f, face == 5 ? 1.0f : 0.0f, 0.5f, 0 };
    }
    light.worldFromCube[2].z = -1; // the cube's +z is the world's -z
    assets::GlbScene scene;
    scene.imageBasedLight = *assets::glbImageBasedLight(light, scene.images);
    scene.imageBasedLight->intensity = 2;
    scene.materials = { { .name = "mirror", .metallicFactor = 1, .roughnessFactor = 0 } };
    scene.meshes = { { .name = "quad",
                       .primitives = { { .positions = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } },
                                         .normals = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 } },
                                         .indices = { 0, 1, 2, 0, 2, 3 },
                                         .material = 0 } } } };
    scene.nodes = { { .name = "quad", .mesh = 0 } };
    const Result<std::vector<std::byte>> file = assets::writeGlb(scene);
    ASSERT_TRUE(file && assets::replaceFile(mFolder / "mirror.glb", *file).ok());
    const std::string arguments = "mirror.glb --size 32x16 --eye 0 0 4 --fov 20 --spp 64 --exposure 1 1 100 "
                                  "--ibl-intensity 1.2 --out out ";
    Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto picture = assets::readHdrImage(mFolder / "out/reference.exr");
    ASSERT_TRUE(picture.ok());
    EXPECT_LT(glm::distance(picture->at(0, 8), float3(2, 0, 1)), 0.01f) << "the fifth picture is seen towards -z";
    EXPECT_LT(glm::distance(picture->at(16, 8), float3(0, 2, 1)), 0.05f) << "the sixth towards +z";
    outcome = run(arguments + "--environment none");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(assets::readHdrImage(mFolder / "out/reference.exr")->at(0, 8), float3(0));
}

TEST_F(Program, SaysInOneLineWhatIsWrongAndFails) {
    writeModel();
    std::ofstream(mFolder / "file") << "no folder";
    std::ofstream(mFolder / "sky.hdr") << "no picture";
    for (const char* arguments : { "missing.glb", "triangle.gltf --environment missing.hdr",
                                   "triangle.gltf --environment sky.hdr", "triangle.gltf --out file/x", "--spp x" }) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 1) << arguments;
        EXPECT_THAT(outcome.text, ::testing::StartsWith("filament-reference: error: ")) << arguments;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    }
}

constexpr const char* kTriangle = "triangle.gltf --environment none --size 24x16 --eye -.3 0 2 --spp 40 --error-image "
                                  "--no-fit ";

TEST_F(Program, MergesShardsToTheFilesOfOneRun) {
    writeModel();
    ASSERT_EQ(run(std::string(kTriangle) + "--out whole").status, 0);
    for (int shard = 0; shard < 3; ++shard) {
        const Outcome outcome =
                run(fmt::format("{} --threads {} --shard {}/3 --out part{}", kTriangle, shard + 1, shard, shard));
        ASSERT_EQ(outcome.status, 0) << outcome.text;
    }
    Outcome outcome = run("--merge part2 part0 part1/part.film --out merged");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    for (const std::string name : { "reference.exr", "reference.png", "error.exr", "report.json" }) {
        EXPECT_EQ(read(("merged/" + name).c_str()), read(("whole/" + name).c_str())) << name;
        EXPECT_FALSE(read(("merged/" + name).c_str()).empty()) << name;
    }
    outcome = run("--merge part0 part2 --out merged");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.text, HasSubstr("missing: shard 1/3; run --shard 1/3"));
}

TEST_F(Program, MergesTilesAndSamplesToTheFilesOfOneRun) {
    writeModel();
    ASSERT_EQ(run(std::string(kTriangle) + "--out whole").status, 0);
    ASSERT_EQ(run(std::string(kTriangle) + "--tile 0/2x1 --samples 0,14 --out a").status, 0);
    ASSERT_EQ(run(std::string(kTriangle) + "--tile 12,0,12,16 --samples 0,14 --out b").status, 0);
    ASSERT_EQ(run(std::string(kTriangle) + "--samples 14,26 --out c").status, 0);
    ASSERT_EQ(run("--merge c b a --out merged").status, 0);
    for (const char* name : { "reference.exr", "report.json" })
        EXPECT_EQ(read((std::string("merged/") + name).c_str()), read((std::string("whole/") + name).c_str())) << name;
}

TEST(Options, OfAPartLeaveThoseOfThePicture) {
    const auto whole = parse({ "--spp", "64", "m.glb", "--sun", "5", "0", "-1", "0", "--no-fit", "--set", "fog=on",
                               "--set", "fog.density=0.2", "--ao-bent" });
    const auto part = parse({ "m.glb",  "--spp",   "64",        "--ao-bent", "--sun",  "5",     "0",
                              "-1",     "0",       "--no-fit",  "--set",     "fog=on", "--set", "fog.density=0.2",
                              "--tile", "0,0,8,8", "--threads", "2",         "--out",  "x" });
    ASSERT_TRUE(whole.ok() && part.ok() && *whole && *part) << (part ? "" : part.error().message);
    EXPECT_EQ((*part)->arguments, (*whole)->arguments);
    EXPECT_EQ((*part)->part->size, uint2(8, 8));
    EXPECT_FALSE((*whole)->part);
    std::vector<const char*> words;
    for (std::string const& word : (*whole)->arguments) words.push_back(word.c_str());
    const auto again = parse(words);
    ASSERT_TRUE(again.ok() && *again);
    EXPECT_EQ((*again)->arguments, (*whole)->arguments);
    EXPECT_EQ((*again)->model, "m.glb");
    EXPECT_FALSE((*again)->fit);
    EXPECT_EQ((*again)->sun->illuminance.value, 5);
    EXPECT_TRUE((*again)->settings.occlusionBends);
}

TEST_F(Program, PrintsItsOptions) {
    const Outcome outcome = run("--help");
    EXPECT_EQ(outcome.status, 0);
    for (const char* option : { "--environment", "--integrator", "--error-image" }) {
        EXPECT_THAT(outcome.text, HasSubstr(option));
    }
}

} // namespace
} // namespace filament_core::reference
