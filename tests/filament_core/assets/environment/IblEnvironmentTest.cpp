// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/Environment.h"

#include "base/Log.h"
#include "filament_core/assets/environment/EnvironmentCache.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/base/ScopedVariable.h"
#include "tests/filament_core/assets/environment/EnvironmentFuzzBody.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace filament_core::assets {
namespace {

class IblEnvironmentTest : public ::testing::Test {
protected:
    void SetUp() override {
        mPreviousSink = setLogSink([this](Severity severity, std::string_view line) {
            if (severity >= Severity::Warning) mWarnings.emplace_back(line);
        });
        const HdrImage image = pictureOf(16, [](float3 d) { return float3(1 + d.x, 1 + d.y, 1 + d.z); });
        ASSERT_TRUE(writeHdr(mFolder / "sky.hdr", image));
        mOptions = { .cacheDirectory = mFolder / "cache", .faceSize = 32, .samples = 8 };
    }
    void TearDown() override { setLogSink(mPreviousSink); }

    Result<EnvironmentData> load() { return loadEnvironment(mFolder / "sky.hdr", mJobs, mOptions); }
    std::vector<std::filesystem::path> cacheFiles() const {
        std::vector<std::filesystem::path> files;
        std::error_code error;
        for (auto const& entry : std::filesystem::directory_iterator(mFolder / "cache", error))
            files.push_back(entry.path());
        return files;
    }

    TemporaryFolder mFolder;
    jobs::JobSystem mJobs{ { .workers = 1 } };
    EnvironmentOptions mOptions;
    std::vector<std::string> mWarnings;
    LogSink mPreviousSink;
};

void expectSameBits(EnvironmentData const& a, EnvironmentData const& b) {
    EXPECT_EQ(a.specular.data, b.specular.data);
    EXPECT_EQ(a.specular.levels, b.specular.levels);
    EXPECT_EQ(a.specular.format, b.specular.format);
    EXPECT_EQ(a.specular.layers, b.specular.layers);
    EXPECT_EQ(a.sky.data, b.sky.data);
    EXPECT_EQ(a.sky.width, b.sky.width);
    EXPECT_EQ(a.irradiance.data, b.irradiance.data);
    EXPECT_EQ(std::memcmp(&a.irradianceSh, &b.irradianceSh, sizeof(a.irradianceSh)), 0);
    EXPECT_EQ(a.levelOfRoughnessOne, b.levelOfRoughnessOne);
    EXPECT_EQ(a.statistics.sourceWidth, b.statistics.sourceWidth);
    EXPECT_EQ(a.statistics.repairs, b.statistics.repairs);
    EXPECT_EQ(a.statistics.specularLoss.lostEnergy, b.statistics.specularLoss.lostEnergy);
}

TEST_F(IblEnvironmentTest, TheSecondLoadComesFromTheCacheWithTheSameBits) {
    const auto first = load(), second = load();
    ASSERT_TRUE(first) << first.error().message;
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_FALSE(first->statistics.fromCache);
    EXPECT_TRUE(second->statistics.fromCache);
    expectSameBits(*first, *second);
    EXPECT_EQ(cacheFiles().size(), 1u);
    EXPECT_TRUE(mWarnings.empty());
}

TEST_F(IblEnvironmentTest, ShapesAreWhatTheRendererExpects) {
    mOptions.faceSize = 256;
    mOptions.samples = 1;
    const auto data = load();
    ASSERT_TRUE(data) << data.error().message;
    EXPECT_EQ(data->specular.width, 256u);
    EXPECT_EQ(data->specular.layers, 6u);
    EXPECT_EQ(data->specular.levels, 5u);
    EXPECT_EQ(data->levelOfRoughnessOne, 4.0f);
    EXPECT_EQ(data->sky.layers, 6u);
    EXPECT_EQ(data->sky.levels, 1u);
    EXPECT_EQ(data->irradiance.layers, 6u);
    EXPECT_EQ(data->irradiance.width, kIrradianceFaceSize);
    EXPECT_EQ(data->sky.width, 16u) << "a picture of 32 pixels needs no more";
    EXPECT_EQ(skyFaceSize(1024), 256u);
    EXPECT_EQ(skyFaceSize(1025), 512u);
    EXPECT_EQ(skyFaceSize(16384), 512u);
}

TEST_F(IblEnvironmentTest, OtherOptionsOrContentMissTheCache) {
    ASSERT_TRUE(load());
    mOptions.samples = 9;
    EXPECT_FALSE(load()->statistics.fromCache);
    mOptions.format = backend::Format::R11G11B10F;
    const auto packed = load();
    EXPECT_FALSE(packed->statistics.fromCache);
    EXPECT_EQ(packed->specular.format, backend::Format::R11G11B10F);
    ASSERT_TRUE(writeHdr(mFolder / "sky.hdr", pictureOf(16, [](float3) { return float3(2.0f); })));
    EXPECT_FALSE(load()->statistics.fromCache);
    mOptions.mapping = RoughnessMapping::Linear;
    EXPECT_FALSE(load()->statistics.fromCache);
    EXPECT_EQ(cacheFiles().size(), 5u);
}

TEST_F(IblEnvironmentTest, ADamagedCacheFileIsNoticedAndBakedAgain) {
    const auto first = load();
    ASSERT_TRUE(first);
    const std::filesystem::path file = cacheFiles().at(0);
    const std::vector<std::byte> good = readFileBytes(file).value();
    for (const size_t at : { size_t(0), size_t(20), size_t(100), good.size() / 2, good.size() - 1 }) {
        std::vector<std::byte> bad = good;
        bad[at] ^= std::byte{ 1 };
        ASSERT_TRUE(replaceFile(file, bad));
        const auto again = load();
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_FALSE(again->statistics.fromCache) << "byte " << at << " differs";
        expectSameBits(*first, *again);
    }
    EXPECT_EQ(mWarnings.size(), 5u);
    EXPECT_TRUE(load()->statistics.fromCache) << "the last load repaired the file";
}

TEST_F(IblEnvironmentTest, RandomBytesInTheCacheNeverCrash) {
    const auto data = load();
    ASSERT_TRUE(data);
    const uint64_t key = 42;
    const std::vector<std::byte> good = encodeEnvironment(*data, key);
    ASSERT_TRUE(decodeEnvironment(good, key));
    EXPECT_FALSE(decodeEnvironment(good, key + 1)) << "the key of something else";
    std::vector<std::byte> head(good.begin(), good.begin() + 400);
    for (uint32_t seed = 0; seed < 3000; ++seed) EXPECT_FALSE(decodeEnvironment(damaged(head, seed), key));
    for (uint32_t seed = 0; seed < 50; ++seed) {
        const std::vector<std::byte> bad = damaged(good, seed);
        EXPECT_EQ(decodeEnvironment(bad, key).ok(), bad == good);
    }
}

// Anyone can compute the checksum of a baked environment: what it describes must be a texture that a device can hold.
TEST_F(IblEnvironmentTest, ChangedHeadersWithARightChecksumAreRefusedOrWhole) {
    const auto data = load();
    ASSERT_TRUE(data);
    const std::vector<std::byte> good = encodeEnvironment(*data, 0);
    ASSERT_TRUE(test::fuzzEnvironment(good));
    size_t read = 0;
    for (uint32_t seed = 0; seed < 400; ++seed) {
        std::vector<std::byte> changed = damaged({ good.begin(), good.begin() + 296 }, seed, 3);
        changed.insert(changed.end(), good.begin() + 296, good.end());
        read += test::fuzzEnvironment(changed);
    }
    EXPECT_GT(read, 20u); // statistics and coefficients may have any finite value
    EXPECT_LT(read, 390u);
}

TEST_F(IblEnvironmentTest, LevelsBelowOneTexelAreRefused) {
    EnvironmentData data;
    const auto cube = [](uint32_t size, uint32_t levels) {
        Image image{ .width = size, .height = size, .layers = 6, .levels = levels, .format = backend::Format::RGBA16F };
        image.data.resize(image.levelOffset(levels));
        return image;
    };
    data.specular = cube(4, 3);
    data.sky = cube(4, 1);
    data.irradiance = cube(kIrradianceFaceSize, 1);
    EXPECT_TRUE(decodeEnvironment(encodeEnvironment(data, 1), 1));
    data.specular = cube(4, 4);
    EXPECT_FALSE(decodeEnvironment(encodeEnvironment(data, 1), 1));
    data.specular = cube(4, 3);
    data.irradianceSh[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(decodeEnvironment(encodeEnvironment(data, 1), 1));
}

TEST_F(IblEnvironmentTest, ACacheThatCannotBeWrittenCostsAWarningOnly) {
    ASSERT_TRUE(replaceFile(mFolder / "file", std::vector<std::byte>(1)));
    mOptions.cacheDirectory = mFolder / "file"; // a file in place of a folder fails even for root, unlike permissions
    const auto data = load();
    ASSERT_TRUE(data) << data.error().message;
    ASSERT_EQ(mWarnings.size(), 1u);
    EXPECT_NE(mWarnings[0].find("not cached"), std::string::npos);
}

TEST_F(IblEnvironmentTest, WritingToTheCacheRemovesWhatKilledWritersLeftThere) {
    const std::filesystem::path left = mFolder / "cache" / "0123456789abcdef.env.1-0";
    ASSERT_TRUE(replaceFile(left, std::vector<std::byte>(1)));
    std::filesystem::last_write_time(left, std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
    ASSERT_TRUE(load());
    ASSERT_EQ(cacheFiles().size(), 1u);
    EXPECT_NE(cacheFiles()[0], left);
    EXPECT_TRUE(mWarnings.empty());
}

TEST_F(IblEnvironmentTest, WithoutCacheNothingIsWritten) {
    mOptions.useCache = false;
    ASSERT_TRUE(load());
    EXPECT_TRUE(cacheFiles().empty());
}

TEST_F(IblEnvironmentTest, ErrorsNameTheFileOrTheOption) {
    EXPECT_EQ(loadEnvironment(mFolder / "none.hdr", mJobs, mOptions).error().code, ErrorCode::NotFound);
    ASSERT_TRUE(replaceFile(mFolder / "bad.hdr", std::vector<std::byte>(100)));
    const auto bad = loadEnvironment(mFolder / "bad.hdr", mJobs, mOptions);
    EXPECT_EQ(bad.error().code, ErrorCode::Unsupported);
    EXPECT_NE(bad.error().message.find("bad.hdr"), std::string::npos);
    for (const uint32_t size : { 0u, 8u, 100u, 4096u }) {
        mOptions.faceSize = size;
        EXPECT_EQ(load().error().code, ErrorCode::InvalidArgument) << size;
    }
    mOptions.faceSize = 32;
    mOptions.samples = 0;
    EXPECT_EQ(load().error().code, ErrorCode::InvalidArgument);
    mOptions.samples = 8;
    mOptions.format = backend::Format::R8;
    EXPECT_EQ(load().error().code, ErrorCode::InvalidArgument);
}

TEST_F(IblEnvironmentTest, ABakedFileTakesThePlaceOfThePictureWithTheSameBits) {
    for (const RoughnessMapping mapping : { RoughnessMapping::Quadratic, RoughnessMapping::Linear }) {
        mOptions.mapping = mapping;
        mOptions.format = backend::Format::RGB9E5;
        const auto baked = load();
        ASSERT_TRUE(baked);
        EXPECT_EQ(baked->mapping, mapping);
        const std::filesystem::path file = mFolder / "sky.fenv";
        ASSERT_TRUE(writeBakedEnvironment(*baked, file));
        // options of the call do not count: what is in the file does
        const auto loaded = loadEnvironment(file, mJobs, { .cacheDirectory = mFolder / "unused", .faceSize = 64 });
        ASSERT_TRUE(loaded) << loaded.error().message;
        expectSameBits(*loaded, *baked);
        EXPECT_EQ(loaded->mapping, mapping);
        EXPECT_FALSE(std::filesystem::exists(mFolder / "unused"));
    }
}

TEST_F(IblEnvironmentTest, ADamagedBakedFileIsAnErrorWithItsCure) {
    const auto baked = load();
    ASSERT_TRUE(baked);
    const std::filesystem::path file = mFolder / "sky.fenv";
    ASSERT_TRUE(writeBakedEnvironment(*baked, file));
    std::vector<std::byte> bytes = *readFileBytes(file);
    const auto expectRefused = [&](std::vector<std::byte> const& damaged) {
        ASSERT_TRUE(replaceFile(file, damaged));
        const auto loaded = loadEnvironment(file, mJobs, mOptions);
        ASSERT_FALSE(loaded);
        EXPECT_NE(loaded.error().message.find("bake it again with cmgen"), std::string::npos) << loaded.error().message;
        EXPECT_NE(loaded.error().message.find(file.string()), std::string::npos);
    };
    for (size_t at = 8; at < bytes.size(); at += bytes.size() / 97) { // behind the magic number
        std::vector<std::byte> damaged = bytes;
        damaged[at] ^= std::byte{ 1 };
        expectRefused(damaged);
    }
    for (size_t left : { size_t{ 8 }, size_t{ 100 }, bytes.size() - 1 })
        expectRefused(std::vector(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(left)));
}

TEST_F(IblEnvironmentTest, ProgressNamesEachStageOnce) {
    std::vector<std::string> stages;
    mOptions.progress = [&](std::string_view stage, size_t done, size_t total) {
        EXPECT_LE(done, total);
        if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    };
    ASSERT_TRUE(load());
    EXPECT_EQ(stages, (std::vector<std::string>{ "decode", "project", "prefilter" }));
}

TEST_F(IblEnvironmentTest, TheCacheIsInTheUsersCacheDirectory) {
    const filament_core::test::ScopedVariable cache("XDG_CACHE_HOME", "/some/cache");
    EXPECT_EQ(environmentCacheDirectory({}), "/some/cache/filament_core");
    EXPECT_EQ(environmentCacheDirectory(mOptions), mFolder / "cache");
    cache.set("relative"); // the specification says: ignore it
    EXPECT_NE(environmentCacheDirectory({}), "relative/filament_core");
}

} // namespace
} // namespace filament_core::assets
