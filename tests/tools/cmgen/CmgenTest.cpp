// SPDX-License-Identifier: Apache-2.0
// The program, from its command line to the package that the engine reads.
#include "filament_core/assets/environment/Environment.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/paths/Paths.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace filament_core::assets {
namespace {

namespace fs = std::filesystem;

class Cmgen : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(mFolder);
        HdrImage sky{ .width = 32, .height = 16, .pixels = {}, .repairs = {} };
        for (uint32_t i = 0; i < 32 * 16; ++i) sky.pixels.emplace_back(0.1f + static_cast<float>(i % 7), 1, 2);
        ASSERT_TRUE(writeHdr(mFolder / "sky.hdr", sky));
    }
    void TearDown() override { fs::remove_all(mFolder); }

    /// Its exit status; mOutput has what it printed. Paths are relative to the folder of the test.
    int cmgen(std::string const& arguments) {
        const std::string program = (tools::buildDir() / "bin/cmgen").string();
        FILE* const pipe =
                popen(("cd '" + mFolder.string() + "' && '" + program + "' " + arguments + " 2>&1").c_str(), "r");
        if (!pipe) return -1;
        mOutput.clear();
        char buffer[4096];
        while (const size_t count = std::fread(buffer, 1, sizeof buffer, pipe)) mOutput.append(buffer, count);
        return WEXITSTATUS(pclose(pipe));
    }

    Result<EnvironmentData> load(std::string const& name) {
        return loadEnvironment(mFolder / name, mJobs, { .useCache = false, .faceSize = 32, .samples = 8 });
    }

    fs::path mFolder = fs::temp_directory_path() / ("cmgen_test_" + std::to_string(::getpid()));
    jobs::JobSystem mJobs{ { .workers = 0 } };
    std::string mOutput;
};

TEST_F(Cmgen, WritesPackagesOfBothKindsWithTheBitsOfBaking) {
    const auto baked = load("sky.hdr");
    ASSERT_TRUE(baked);
    for (const char* kind : { "ktx2", "fenv" }) {
        ASSERT_EQ(cmgen(std::string("sky.hdr --size 32 --samples 8 --out out --package ") + kind), 0) << mOutput;
        const auto loaded = load(std::string("out/sky.") + kind);
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(loaded->specular.data, baked->specular.data);
        EXPECT_EQ(loaded->sky.data, baked->sky.data);
        EXPECT_EQ(loaded->irradiance.data, baked->irradiance.data);
        EXPECT_EQ(loaded->irradianceSh, baked->irradianceSh);
    }
    EXPECT_THAT(mOutput, testing::HasSubstr("32 x 16 -> 2 levels from 32 texels a face, baked in"));
    EXPECT_TRUE(fs::exists(mFolder / "out/specular-0.exr"));
}

TEST_F(Cmgen, APackageBecomesTheSamePackageButNeverReplacesItself) {
    ASSERT_EQ(cmgen("sky.hdr --size 32 --samples 8"), 0) << mOutput;
    ASSERT_EQ(cmgen("sky.ktx2 --out again"), 0) << mOutput;
    EXPECT_EQ(*readFileBytes(mFolder / "sky.ktx2"), *readFileBytes(mFolder / "again/sky.ktx2"));
    EXPECT_EQ(cmgen("sky.ktx2"), 1);
    EXPECT_THAT(mOutput, testing::HasSubstr("cmgen: error: './sky.ktx2' would replace its own picture"));
    EXPECT_EQ(cmgen("sky.hdr --package png"), 1);
    EXPECT_THAT(mOutput, testing::HasSubstr("'cmgen --help' lists the options"));
}

} // namespace
} // namespace filament_core::assets
