// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/Package.h"
#include "toolkit/paths/Paths.h"

#include <filament_core/Version.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

struct Outcome {
    int status = 0;
    std::string output; ///< both streams
};

const std::string kProgram = (filament_core::tools::buildDir() / "bin/matc ").string();

Outcome shell(std::string const& command) {
    Outcome outcome;
    FILE* const pipe = popen(command.c_str(), "r");
    EXPECT_NE(pipe, nullptr);
    char buffer[4096];
    while (const size_t count = std::fread(buffer, 1, sizeof buffer, pipe)) outcome.output.append(buffer, count);
    outcome.status = WEXITSTATUS(pclose(pipe));
    return outcome;
}

Outcome matc(std::string const& arguments) { return shell(kProgram + arguments + " 2>&1"); }

std::string contents(fs::path const& path) {
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
}

/// A temporary folder, deleted afterwards.
class Matc : public ::testing::Test {
protected:
    void SetUp() override { fs::create_directories(mFolder); }
    void TearDown() override { fs::remove_all(mFolder); }

    std::string file(std::string const& name, std::string const& text) const {
        std::ofstream(mFolder / name) << text;
        return (mFolder / name).string();
    }
    std::string path(std::string const& name) const { return (mFolder / name).string(); }

    filament_core::shader::MaterialPackage package(std::string const& name) const {
        const std::string bytes = contents(path(name));
        auto read = filament_core::shader::readPackage(std::as_bytes(std::span(bytes.data(), bytes.size())));
        if (read) return std::move(*read);
        ADD_FAILURE() << name << ": " << read.error().message;
        return {};
    }

    fs::path mFolder = fs::temp_directory_path() / ("matc_test_" + std::to_string(getpid()));
};

/// Three maps and a normal map, like most materials of models.
constexpr const char* kStandard = R"(material { name : standard, shadingModel : lit, requires : [ uv0 ],
    parameters : [ { name : baseColor, type : sampler2d }, { name : normal, type : sampler2d }, { name : orm, type : sampler2d } ] }
fragment {
    void material(inout MaterialInputs m) {
        m.normal = texture(materialParams_normal, getUV0()).xyz * 2.0 - 1.0;
        prepareMaterial(m);
        m.baseColor = texture(materialParams_baseColor, getUV0());
        vec3 orm = texture(materialParams_orm, getUV0()).rgb;
        m.ambientOcclusion = orm.r;
        m.roughness = orm.g;
        m.metallic = orm.b;
    }
}
)";

constexpr const char* kLit = R"(material { name : stone, shadingModel : lit }
fragment { void material(inout MaterialInputs m) { prepareMaterial(m); m.roughness = 0.5; } }
)";

TEST_F(Matc, WritesTheSameBytesWithAnyNumberOfThreads) {
    const std::string input = file("stone.mat", kLit);
    for (const char* threads : { "1", "2", "7" }) {
        const Outcome outcome = matc(std::string("-j ") + threads + " -o " + path(threads) + " " + input);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
    }
    EXPECT_GT(contents(path("1")).size(), 1000u);
    EXPECT_EQ(contents(path("1")), contents(path("2")));
    EXPECT_EQ(contents(path("1")), contents(path("7")));
}

/// Of those that have ended: unlike the clock, it does not count the work of other programs.
double processorSecondsOfChildren() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](timeval time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// How long it takes is printed for people who compare; no bound holds on every machine.
TEST_F(Matc, CompilesTheStandardMaterialIntoASmallPackage) {
    const std::string input = file("standard.mat", kStandard);
    const double before = processorSecondsOfChildren();
    ASSERT_EQ(matc("-j 1 -o " + path("standard.fmat") + " " + input).status, 0);
    const double seconds = processorSecondsOfChildren() - before;
    const size_t bytes = contents(path("standard.fmat")).size();
    std::printf("standard lit material, both APIs, all variants, one thread: %.2f s, %.0f KB\n", seconds,
                static_cast<double>(bytes) / 1000);
    RecordProperty("bytes", static_cast<int>(bytes));
    EXPECT_LT(bytes, 154'000u) << "one fragment stage for all lights; shadows and area lights are most of it";
}

TEST_F(Matc, ReportsErrorsWithFileAndLineAndWritesNothing) {
    const std::string input = file("stone.mat", "material {\n  shadingModle : lit\n}\nfragment {}\n");
    const Outcome outcome = matc("-o " + path("out.fmat") + " " + input);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.output,
                HasSubstr("stone.mat:2: there is no property 'shadingModle'; did you mean 'shadingModel'?"));
    EXPECT_FALSE(fs::exists(path("out.fmat")));
}

TEST_F(Matc, CompilesSeveralMaterialsIntoAFolderWithTheBytesOfEach) {
    const std::string a = file("a.mat", kLit), b = file("b.mat", "material { shadingModel : lodd }\nfragment {}\n"),
                      c = file("c.mat", kStandard);
    ASSERT_EQ(matc("-o " + path("a.alone") + " " + a).status, 0);
    const Outcome all = matc("-MD -o " + path("") + " " + a + " " + b + " " + c);
    EXPECT_EQ(all.status, 1) << "one of them is wrong";
    EXPECT_THAT(all.output, HasSubstr("Could not compile material " + b));
    EXPECT_EQ(contents(path("a.fmat")), contents(path("a.alone")));
    EXPECT_FALSE(fs::exists(path("b.fmat")));
    EXPECT_FALSE(package("c.fmat").variants.empty());
    EXPECT_THAT(contents(path("c.fmat.d")), HasSubstr("c.fmat: " + c));
    EXPECT_EQ(matc("-o " + path("") + " " + a + " " + c).status, 0);

    const auto refusal = [&](std::string const& arguments) {
        const Outcome outcome = matc(arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        return outcome.output;
    };
    EXPECT_THAT(refusal("-o " + path("one.fmat") + " " + a + " " + c), HasSubstr("give -o FOLDER/"));
    EXPECT_THAT(refusal("-E " + a + " " + c), HasSubstr("nothing to print"));
    EXPECT_THAT(refusal("-MF " + path("all.d") + " -o " + path("") + " " + a), HasSubstr("use -MD"));
    EXPECT_THAT(refusal("-o " + path("") + " -"), HasSubstr("the standard input has no name"));
    EXPECT_THAT(refusal("-o " + path("") + " " + a + " " + a), HasSubstr("two materials would write one package"));
}

TEST_F(Matc, LeavesOutFilteredVariantsAndOtherApis) {
    const std::string input = file("stone.mat", kLit);
    ASSERT_EQ(matc("-o " + path("all") + " " + input).status, 0);
    ASSERT_EQ(matc("-v directionalLighting,dynamicLighting -o " + path("one") + " " + input).status, 0);
    ASSERT_EQ(matc("-v directionalLighting,dynamicLighting -a vulkan -o " + path("vulkan") + " " + input).status, 0);
    const auto isUnlit = [](filament_core::shader::Variant const& variant) {
        return (variant.key & (filament_core::shader::kVariantSun | filament_core::shader::kVariantPunctual)) == 0;
    };
    const std::vector<filament_core::shader::Variant> all = package("all").variants;
    EXPECT_EQ(package("one").variants.size(), static_cast<size_t>(std::ranges::count_if(all, isUnlit)));
    EXPECT_TRUE(std::ranges::all_of(package("one").variants, isUnlit));
    EXPECT_FALSE(std::ranges::all_of(all, isUnlit));
    EXPECT_THAT(package("all").variants[0].fragment->essl, HasSubstr("#version 310 es"));
    EXPECT_EQ(package("vulkan").variants[0].fragment->essl, "");
    EXPECT_EQ(package("vulkan").variants[0].fragment->spirv, package("one").variants[0].fragment->spirv);
    const Outcome misspelt = matc("-v dynamicLightning -o " + path("none") + " " + input);
    EXPECT_EQ(misspelt.status, 1);
    EXPECT_THAT(misspelt.output, HasSubstr("did you mean 'dynamicLighting'?"));
}

TEST_F(Matc, WritesPackagesForBothApisThatAreNoLargerWhenSizeCounts) {
    const std::string input = file("waves.mat", R"(material { shadingModel : unlit, requires : [ uv0 ] }
fragment {
    float wave(vec2 p) {
        vec2 q = fract(sin(p * 12.9898) * 43758.5453);
        return sin(q.x * 7.0 + cos(q.y * 5.0)) * exp(-q.x * q.x) + sqrt(abs(q.y)) * atan(q.x, q.y + 2.0);
    }
    void material(inout MaterialInputs m) {
        prepareMaterial(m);
        vec2 p = getUV0();
        m.baseColor.rgb = vec3(wave(p) + wave(p * 2.0), wave(p * 3.0) + wave(p * 5.0), wave(p * 7.0) + wave(p * 11.0));
    }
}
)");
    ASSERT_EQ(matc("-o " + path("fast") + " " + input).status, 0);
    const Outcome outcome = matc("-S -o " + path("small") + " " + input);
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto words = [&](std::string const& name) { return package(name).variants[0].fragment->spirv.size(); };
    std::printf("for speed %zu, for size %zu words\n", words("fast"), words("small"));
    EXPECT_LE(words("small"), words("fast"));
    EXPECT_LE(package("small").variants[0].fragment->essl.size(), package("fast").variants[0].fragment->essl.size());

    const std::string standard = file("standard.mat", kStandard);
    EXPECT_EQ(matc("-S -o " + path("standard") + " " + standard).status, 0) << "all that a lit material includes";
}

TEST_F(Matc, IncludesFilesBesideTheMaterial) {
    file("half.glsl", "const float kHalf = 0.5;\n");
    const std::string input = file(
            "stone.mat", "material { shadingModel : unlit }\nfragment {\n#include \"half.glsl\"\n"
                         "void material(inout MaterialInputs m) { prepareMaterial(m); m.baseColor *= kHalf; } }\n");
    const Outcome outcome = matc("-o " + path("out") + " " + input);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
}

TEST_F(Matc, RefusesWhatIsNoSmallTextFile) {
    const auto refusal = [&](std::string const& input) {
        const Outcome outcome = matc("-o " + path("out") + " " + input);
        EXPECT_EQ(outcome.status, 1) << input;
        EXPECT_FALSE(fs::exists(path("out")));
        return outcome.output;
    };
    EXPECT_THAT(refusal(mFolder.string()), HasSubstr("': Is a directory"));
    EXPECT_THAT(refusal("/dev/zero"), HasSubstr("larger than 1048576 bytes"));
    EXPECT_THAT(refusal(path("missing.mat")), HasSubstr("there is no such file"));
    const std::string including = "material {}\nfragment {\n#include \".\"\n}\n";
    EXPECT_THAT(refusal(file("includes.mat", including)), HasSubstr("includes.mat:3: cannot find the file \".\""));
}

TEST_F(Matc, IncludesFilesOfOtherFoldersOnlyWhereThatIsAllowed) {
    fs::create_directories(mFolder / "sub");
    const std::string half = file("half.glsl", "const float kHalf = 0.5;\n");
    fs::create_symlink(half, mFolder / "sub" / "link.glsl");
    for (std::string const& name : { std::string("../half.glsl"), half, std::string("link.glsl") }) {
        const std::string input =
                file("sub/stone.mat", "material { shadingModel : unlit }\nfragment {\n#include \"" + name +
                                              "\"\nvoid material(inout MaterialInputs m) { prepareMaterial(m); "
                                              "m.baseColor *= kHalf; } }\n");
        EXPECT_THAT(matc("--preprocess " + input).output, HasSubstr("stone.mat:3: cannot find the file")) << name;
        EXPECT_EQ(matc("--allow-outside --preprocess " + input).status, 0) << name;
    }
}

// The disk is full after so many blocks of 512 bytes. ReplaceFile.AFullDisk... tries every byte.
TEST_F(Matc, KeepsTheGoodPackageIfTheDiskIsFull) {
    const std::string input = file("stone.mat", "material { shadingModel : unlit }\nfragment { void material(inout "
                                                "MaterialInputs m) { prepareMaterial(m); } }\n");
    ASSERT_EQ(matc("-a vulkan -o " + path("good.fmat") + " " + input).status, 0);
    const std::string good = contents(path("good.fmat"));
    for (const char* blocks : { "0", "1", "3" }) {
        const Outcome outcome = shell(std::string("trap '' XFSZ; ulimit -f ") + blocks + "; " + kProgram + "-o " +
                                      path("good.fmat") + " " + input + " 2>&1");
        EXPECT_EQ(outcome.status, 1) << blocks;
        EXPECT_THAT(outcome.output, HasSubstr("good.fmat': File too large"));
        EXPECT_EQ(contents(path("good.fmat")), good) << blocks;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(mFolder), fs::directory_iterator()), 2) << "and nothing beside it";
    EXPECT_EQ(matc("-o /dev/full " + input).status, 1);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Matc, AFullStandardOutputIsAnError) {
    const std::string input = file("stone.mat", kLit);
    for (const char* mode : { "--preprocess ", "--cost ", "--reflect parameters " }) {
        const Outcome outcome = shell(kProgram + mode + input + " 3>&1 >/dev/full 2>&3");
        EXPECT_EQ(outcome.status, 1) << mode;
        EXPECT_THAT(outcome.output, HasSubstr("cannot write to the standard output: No space left on device"));
    }
    EXPECT_EQ(shell(kProgram + "--help >/dev/full").status, 1);
}

TEST_F(Matc, PrintsTheGeneratedGlslOnRequest) {
    const Outcome outcome = matc("--preprocess " + file("stone.mat", kLit));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, HasSubstr("#version 450"));
    EXPECT_THAT(outcome.output, HasSubstr("// ==== variant 3 fragment"));
}

TEST_F(Matc, CountsWhatTheFragmentStagesDo) {
    const Outcome outcome = matc("--cost " + file("standard.mat", kStandard));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, HasSubstr("HAS_AMBIENT_OCCLUSION HAS_NORMAL\n"));
    EXPECT_THAT(outcome.output, HasSubstr("\nsun+punctual "));
    EXPECT_THAT(matc("--cost " + file("stone.mat", kLit)).output, HasSubstr(": no terms\n"));
}

TEST_F(Matc, ListsTheParametersInTheFormOfTheGuide) {
    const std::string input = file("skybox.mat", R"(material {
    parameters : [ { type : bool, name : showSun }, { type : float3, name : weights, }, { type : "float[9]", name : sh },
        { type : samplerCubemap, name : skybox }, { type : sampler2d, format : int, precision : high, name : ids } ],
    blending : masked }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); } }
)");
    const Outcome outcome = matc("--reflect parameters " + input);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output, R"({
  "parameters": [
    {
      "name": "showSun",
      "type": "bool",
      "size": "1"
    },
    {
      "name": "weights",
      "type": "float3",
      "size": "1"
    },
    {
      "name": "sh",
      "type": "float",
      "size": "9"
    },
    {
      "name": "skybox",
      "type": "samplerCubemap",
      "format": "float",
      "precision": "default"
    },
    {
      "name": "ids",
      "type": "sampler2d",
      "format": "int",
      "precision": "high"
    }
  ]
}
)");
    EXPECT_EQ(matc("-r parameters " + file("stone.mat", kLit)).output, "{\n  \"parameters\": []\n}\n");
}

TEST_F(Matc, ReportsErrorsInTheFormOfTheGuide) {
    const std::string input =
            file("metal.mat",
                 "material { shadingModel : lit }\n\nfragment {\n    void material(inout MaterialInputs "
                 "material) {\n        prepareMaterial(material);\n        material.metalic = 1.0;\n    }\n}\n");
    const Outcome outcome = matc("-o " + path("out.fmat") + " " + input);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.output, HasSubstr("ERROR: " + input + ":6: 'metalic' : no such field in structure"));
    EXPECT_THAT(outcome.output, HasSubstr("did you mean 'metallic'?"));
    EXPECT_THAT(outcome.output, HasSubstr("\n\nCould not compile material " + input + "\n"));
}

TEST_F(Matc, SaysWhatIsMissing) {
    EXPECT_THAT(matc("-o " + path("out") + " " + path("gone.mat")).output, HasSubstr("cannot read"));
    EXPECT_THAT(matc(file("stone.mat", kLit)).output, HasSubstr("give the package to write with -o"));
    EXPECT_THAT(matc("-o " + path("no/such/folder/x") + " " + file("stone.mat", kLit)).output,
                HasSubstr("cannot write"));
}

// ---------------------------------------------------------------------------------------------- build systems

constexpr const char* kUnlit = "material { shadingModel : unlit }\nfragment {\n#include \"tint.glsl\"\n"
                               "void material(inout MaterialInputs m) { prepareMaterial(m); m.baseColor = tint(); } }";

TEST_F(Matc, NamesTheFilesOfAMaterialForMake) {
    const std::string input = file("stone.mat", kUnlit);
    file("tint.glsl", "vec4 tint() { return vec4(0.5); }");
    const Outcome printed = matc("-M " + input);
    EXPECT_EQ(printed.status, 0);
    EXPECT_EQ(printed.output, path("stone.fmat") + ": " + input + " " + path("tint.glsl") + "\n");
    ASSERT_EQ(matc("-MD -o " + path("out.fmat") + " " + input).status, 0);
    EXPECT_EQ(contents(path("out.fmat.d")), path("out.fmat") + ": " + input + " " + path("tint.glsl") + "\n");
    ASSERT_EQ(matc("-MD -MF " + path("deps") + " -o " + path("out.fmat") + " " + input).status, 0);
    EXPECT_EQ(contents(path("deps")), contents(path("out.fmat.d")));
}

TEST_F(Matc, ReadsTheStandardInput) {
    const std::string input = file("stone.mat", kUnlit);
    file("tint.glsl", "vec4 tint() { return vec4(0.5); }");
    ASSERT_EQ(matc("-o " + path("a") + " " + input).status, 0);
    const Outcome piped = shell("cd " + mFolder.string() + " && " + kProgram + "-o b - < stone.mat 2>&1");
    EXPECT_EQ(piped.status, 0) << piped.output;
    EXPECT_EQ(contents(path("a")), contents(path("b")));
    const Outcome broken = shell("echo material | " + kProgram + "-o " + path("c") + " - 2>&1");
    EXPECT_EQ(broken.status, 1);
    EXPECT_THAT(broken.output, HasSubstr("ERROR: standard input:2: expected '{'"));
}

TEST_F(Matc, DefinesMacrosAndFillsTemplates) {
    const std::string input = file("t.mat", "material { name : ${NAME}, shadingModel : ${MODEL} }\nfragment { void "
                                            "material(inout MaterialInputs m) { prepareMaterial(m);\n#if LEVEL > 2\n"
                                            "m.baseColor.r = AMOUNT;\n#else\nmissing();\n#endif\n} }");
    ASSERT_EQ(matc("-D LEVEL=3 -DAMOUNT=0.25 -T NAME=stone -T MODEL=unlit -o " + path("out") + " " + input).status, 0);
    EXPECT_EQ(package("out").name, "stone");
    EXPECT_EQ(package("out").shading, filament_core::shader::ShadingModel::Unlit);
    const Outcome without = matc("-T NAME=stone -o " + path("none") + " " + input);
    EXPECT_EQ(without.status, 1);
    EXPECT_THAT(without.output, HasSubstr("t.mat:1: the template name 'MODEL' has no value; give -T MODEL=VALUE"));
    const Outcome low = matc("-D LEVEL -T NAME=a -T MODEL=lit -o " + path("none") + " " + input);
    EXPECT_THAT(low.output, HasSubstr("t.mat:6: 'missing' : no matching overloaded function found"));
    EXPECT_EQ(matc("-D 2=3 -o " + path("none") + " " + input).status, 2);
}

TEST_F(Matc, EndsWithTheStatusThatItsHelpNames) {
    const std::string input = file("stone.mat", kLit);
    const Outcome help = matc("--help");
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.output, HasSubstr("Exit status: 0 written or printed; 1 the material"));
    const Outcome version = matc("--version");
    EXPECT_EQ(version.status, 0);
    EXPECT_THAT(version.output, HasSubstr("matc of filament_core " + std::string(filament_core::versionText())));
    EXPECT_EQ(matc(input).status, 2) << "no -o";
    EXPECT_EQ(matc("--no-such-option " + input).status, 2);
    EXPECT_EQ(matc("-a metal -o x " + input).status, 2);
    EXPECT_EQ(matc("-o " + path("x") + " " + path("gone.mat")).status, 1);
    EXPECT_EQ(matc("-E " + input).output, matc("--preprocess " + input).output);
}

TEST_F(Matc, PrintsEachErrorAndEachWarningOnALine) {
    const std::string input =
            file("e.mat", "material { parameters : [ { name : unused, type : float } ] }\nfragment {\n"
                          "void material(inout MaterialInputs m) { prepareMaterial(m);\nm.a = 1.0;\n"
                          "m.b = 1.0; } }");
    const Outcome broken = matc("-o " + path("x") + " " + input);
    EXPECT_THAT(broken.output, HasSubstr("e.mat:4: 'a' :"));
    EXPECT_THAT(broken.output, HasSubstr("\nERROR: " + input + ":5: 'b' :"));
    const std::string good =
            file("g.mat", "material { shadingModel : unlit, parameters : [ { name : unused, type : float } ] }\n"
                          "fragment { void material(inout MaterialInputs m) { prepareMaterial(m); } }");
    EXPECT_THAT(matc("-o " + path("x") + " " + good).output, HasSubstr("WARNING: " + good + ":1: no code reads"));
    EXPECT_EQ(matc("-w -o " + path("x") + " " + good).output, "");
}

// ---------------------------------------------------------------------------------------------- matinfo

Outcome matinfo(std::string const& arguments) {
    return shell((filament_core::tools::buildDir() / "bin/matinfo ").string() + arguments + " 2>&1");
}

TEST_F(Matc, MatinfoShowsWhatAPackageHolds) {
    ASSERT_EQ(matc("-o " + path("standard.fmat") + " " + file("standard.mat", kStandard)).status, 0);
    const Outcome shown = matinfo(path("standard.fmat"));
    EXPECT_EQ(shown.status, 0);
    for (const char* text :
         { "standard", "3 parameters", "sampler2d", "baseColor", "attributes            position tangents uv0",
           "18 variants", "directionalLighting dynamicLighting shadowReceiver skinning", "no lights" }) {
        EXPECT_THAT(shown.output, HasSubstr(text));
    }
    const std::string size = std::to_string(package("standard.fmat").variants[0].fragment->spirv.size() * 4);
    EXPECT_THAT(shown.output, HasSubstr(size));
}

TEST_F(Matc, MatinfoPrintsTheCodeOfEitherApi) {
    const std::string input = file("standard.mat", kStandard);
    ASSERT_EQ(matc("-v shadowReceiver,skinning,debugViews -o " + path("standard.fmat") + " " + input).status, 0);
    const std::string of = path("standard.fmat");
    EXPECT_EQ(matinfo("--code opengl --variant 3 " + of).output,
              package("standard.fmat").findVariant(3)->fragment->essl);
    EXPECT_THAT(matinfo("--code vulkan --stage vertex " + of).output, HasSubstr("OpEntryPoint Vertex"));
    const Outcome none = matinfo("--code opengl --variant 77 " + of);
    EXPECT_EQ(none.status, 1);
    EXPECT_THAT(none.output, HasSubstr("the package has no variant 77"));
    EXPECT_EQ(matinfo(file("no.fmat", "no package")).status, 1);
    EXPECT_EQ(matinfo("--code metal " + of).status, 2);
}

} // namespace
