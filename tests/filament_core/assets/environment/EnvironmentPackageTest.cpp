// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/EnvironmentPackage.h"

#include "base/math/Half.h"
#include "base/math/SharedExponent.h"
#include "filament_core/assets/environment/CubePicture.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "tests/filament_core/assets/environment/EnvironmentFuzzBody.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"
#include "tests/filament_core/assets/image/Ktx2Packing.h"
#include "tests/filament_core/assets/image/Ktx2Writer.h"

#include <cstring>

namespace filament_core::assets {
namespace {

using test::Ktx2Writer;
using PackageBytes = std::vector<std::byte>;

class EnvironmentPackageTest : public ::testing::Test {
protected:
    void SetUp() override {
        const HdrImage image =
                pictureOf(16, [](float3 d) { return float3(1 + d.x, 1 + d.y, 0.1f / 3 + 40 * d.z * d.z); });
        ASSERT_TRUE(writeHdr(mFolder / "sky.hdr", image));
    }
    Result<EnvironmentData> load(std::string const& name) { return loadEnvironment(mFolder / name, mJobs, mOptions); }
    Result<EnvironmentData> loadBytes(PackageBytes const& bytes) {
        return loadEnvironmentFromMemory(bytes, "sky.ktx2", mJobs, mOptions);
    }
    /// The metadata of the package.
    PackageBytes package() {
        const auto data = load("sky.hdr");
        return data ? encodeEnvironmentPackage(*data) : PackageBytes();
    }

    TemporaryFolder mFolder;
    jobs::JobSystem mJobs{ { .workers = 1 } };
    EnvironmentOptions mOptions{ .useCache = false, .faceSize = 32, .samples = 8 };
};

void expectSameCubes(EnvironmentData const& a, EnvironmentData const& b) {
    for (Image EnvironmentData::*cube :
         { &EnvironmentData::specular, &EnvironmentData::sky, &EnvironmentData::irradiance }) {
        EXPECT_EQ((a.*cube).data, (b.*cube).data);
        EXPECT_EQ((a.*cube).width, (b.*cube).width);
        EXPECT_EQ((a.*cube).levels, (b.*cube).levels);
        EXPECT_EQ((a.*cube).layers, (b.*cube).layers);
        EXPECT_EQ((a.*cube).format, (b.*cube).format);
    }
    EXPECT_EQ(std::memcmp(&a.irradianceSh, &b.irradianceSh, sizeof(a.irradianceSh)), 0);
    EXPECT_EQ(a.levelOfRoughnessOne, b.levelOfRoughnessOne);
    EXPECT_EQ(a.mapping, b.mapping);
}

TEST_F(EnvironmentPackageTest, APackageHasTheBitsOfBakingInEveryFormatAndMapping) {
    using backend::Format;
    for (const Format format : { Format::RGBA16F, Format::R11G11B10F, Format::RGB9E5, Format::RGBA8 }) {
        for (const auto mapping :
             { RoughnessMapping::Quadratic, RoughnessMapping::Logarithmic, RoughnessMapping::Linear }) {
            mOptions.format = format, mOptions.mapping = mapping;
            const auto baked = load("sky.hdr");
            ASSERT_TRUE(baked);
            ASSERT_TRUE(writeEnvironmentPackage(*baked, mFolder / "sky.ktx2"));
            mOptions.faceSize = 64; // the file counts
            const auto loaded = load("sky.ktx2");
            mOptions.faceSize = 32;
            ASSERT_TRUE(loaded) << loaded.error().message;
            expectSameCubes(*loaded, *baked);
            EXPECT_EQ(loaded->statistics.sourceWidth, 32u);
            EXPECT_EQ(loaded->statistics.specularLoss.lostEnergy, baked->statistics.specularLoss.lostEnergy);
            EXPECT_EQ(encodeEnvironmentPackage(*loaded), encodeEnvironmentPackage(*baked));
        }
    }
}

TEST_F(EnvironmentPackageTest, AnEnvironmentOfCoefficientsAloneHasNoIrradianceCube) {
    auto baked = load("sky.hdr");
    ASSERT_TRUE(baked);
    baked->irradiance = {};
    const auto loaded = loadBytes(encodeEnvironmentPackage(*baked));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->irradiance.data.empty());
    expectSameCubes(*loaded, *baked);
}

// Another program compresses the texture and keeps the pairs, as the specification wants.
TEST_F(EnvironmentPackageTest, APackageMayBeSupercompressed) {
    const auto baked = load("sky.hdr");
    ASSERT_TRUE(baked);
    const PackageBytes plain = encodeEnvironmentPackage(*baked);
    const auto file = readKtx2(plain, "sky.ktx2");
    ASSERT_TRUE(file);
    Ktx2Writer writer{ .format = 97, .width = 32, .height = 32, .faces = 6, .compression = 2 };
    for (Ktx2Value const& pair : file->values) {
        std::string value(reinterpret_cast<const char*>(pair.value.data()), pair.value.size());
        if (!value.empty() && value.back() == '\0') value.pop_back(); // the writer adds one
        writer.keys.emplace_back(std::string(pair.key), value);
    }
    for (Ktx2Level const& level : file->levels) {
        writer.levels.push_back(test::zstdOf({ level.bytes.begin(), level.bytes.end() }));
        writer.plainBytes.push_back(level.bytes.size());
    }
    const auto loaded = loadBytes(writer.file());
    ASSERT_TRUE(loaded) << loaded.error().message;
    expectSameCubes(*loaded, *baked);
}

struct BrokenPackage {
    const char* what;
    const char* says;
    void (*breakIt)(std::vector<Ktx2Value>&, EnvironmentData&);
};

void replaceValue(std::vector<Ktx2Value>& values, std::string_view key, const char* text) {
    for (Ktx2Value& value : values) {
        if (value.key == key) value = ktx2Text(value.key, text);
    }
}

const BrokenPackage kBrokenPackages[] = {
    { "version", "another layout than 1",
      [](auto& values, auto&) { replaceValue(values, "filament.environment", "3"); } },
    { "no lights", "42 numbers of lights", [](auto& v, auto&) { replaceValue(v, "filament.environment", "2"); } },
    { "lights that are none", "42 numbers of lights",
      [](auto& v, auto&) {
          static std::string zeros; // 42, and no direction
          for (int i = zeros.empty() ? 0 : 42; i < 42; ++i) zeros += "0 ";
          replaceValue(v, "filament.environment", "2");
          v.push_back(ktx2Text("filament.lights", zeros.c_str()));
      } },
    { "mapping", "roughnessMapping", [](auto& v, auto&) { replaceValue(v, "filament.roughnessMapping", "square"); } },
    { "short harmonics", "27 finite", [](auto& v, auto&) { replaceValue(v, "filament.irradianceSh", "1 2 3"); } },
    { "harmonics that are no numbers", "27 finite",
      [](auto& v, auto&) {
          replaceValue(v, "filament.irradianceSh", "nan 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0");
      } },
    { "statistics", "filament.picture",
      [](auto& v, auto&) { replaceValue(v, "filament.picture", "1 2 -3 4 5 6 7 8 9"); } },
    { "no skybox", "has no filament.skybox",
      [](auto& v, auto&) { std::erase_if(v, [](Ktx2Value const& pair) { return pair.key == "filament.skybox"; }); } },
    { "skybox that is a text", "filament.skybox is no KTX 2.0",
      [](auto& v, auto&) { replaceValue(v, "filament.skybox", "blue"); } },
    { "infinite texel", "no light",
      [](auto&, EnvironmentData& data) { data.specular.data[1] = std::byte{ 0x7C }, data.specular.data[0] = {}; } },
    { "negative texel", "no light", [](auto&, EnvironmentData& data) { data.specular.data[1] |= std::byte{ 0x80 }; } },
};

TEST_F(EnvironmentPackageTest, ABrokenPackageIsAnErrorWithPlaceAndCure) {
    const PackageBytes good = package();
    const auto file = readKtx2(good, "sky.ktx2");
    ASSERT_TRUE(file);
    for (BrokenPackage const& broken : kBrokenPackages) {
        auto data = decodeEnvironmentPackage(*file, "sky.ktx2");
        ASSERT_TRUE(data);
        std::vector<Ktx2Value> values = file->values;
        std::erase_if(values, [](Ktx2Value const& pair) { return pair.key == "KTXorientation"; });
        broken.breakIt(values, *data);
        const auto loaded = loadBytes(encodeKtx2(data->specular, values));
        ASSERT_FALSE(loaded) << broken.what;
        EXPECT_NE(loaded.error().message.find(broken.says), std::string::npos) << loaded.error().message;
        EXPECT_NE(loaded.error().message.find("bake it again with cmgen"), std::string::npos);
        EXPECT_NE(loaded.error().message.find("'sky.ktx2'"), std::string::npos);
    }
}

TEST_F(EnvironmentPackageTest, ChangedBytesAreRefusedOrWhole) {
    const PackageBytes good = package();
    ASSERT_TRUE(test::fuzzEnvironmentPackage(good));
    size_t read = 0;
    const size_t texels = good.size() - 6 * 32 * 32 * 8;
    for (uint32_t seed = 0; seed < 600; ++seed) {
        PackageBytes changed = damaged(
                { good.begin(), good.begin() + static_cast<std::ptrdiff_t>(std::min<size_t>(texels, 900)) }, seed, 3);
        changed.insert(changed.end(), good.begin() + 900, good.end());
        read += test::fuzzEnvironmentPackage(changed);
        read += test::fuzzEnvironmentPackage(damaged(good, seed, 3));
    }
    EXPECT_GT(read, 100u); // most texels are as good as others
    EXPECT_LT(read, 1100u);
}

// The cube of an image, texel by texel.
IblCubeLevel radianceCube(uint32_t size) {
    IblCubeLevel level(size);
    for (uint32_t face = 0; face < 6; ++face) {
        for (int y = 0; y < static_cast<int>(size); ++y) {
            for (int x = 0; x < static_cast<int>(size); ++x) {
                const float3 d =
                        glm::normalize(directionFromCube({ face, faceCoordinate(x, size), faceCoordinate(y, size) }));
                level.at(face, x, y) = Texel{ 1 + d.x, 1 + d.y, 1 + d.z, 0 };
            }
        }
    }
    level.fillBorder();
    return level;
}

template <class Put>
PackageBytes levelOf(uint32_t size, Put&& put) {
    PackageBytes bytes;
    const IblCubeLevel cube = radianceCube(size);
    for (uint32_t face = 0; face < 6; ++face) {
        for (int y = 0; y < static_cast<int>(size); ++y) {
            for (int x = 0; x < static_cast<int>(size); ++x) put(bytes, cube.radiance(face, x, y));
        }
    }
    return bytes;
}

template <class T>
void putValue(PackageBytes& bytes, T value) {
    const auto raw = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

PackageBytes halvesOf(uint32_t size) {
    return levelOf(size, [](PackageBytes& bytes, float3 c) {
        for (const float v : { c.x, c.y, c.z, 1.0f }) putValue(bytes, halfFromFloat(v));
    });
}

PackageBytes floatsOf(uint32_t size) {
    return levelOf(size, [](PackageBytes& bytes, float3 c) {
        for (const float v : { c.x, c.y, c.z }) putValue(bytes, v);
    });
}

PackageBytes sharedExponentsOf(uint32_t size) {
    return levelOf(size, [](PackageBytes& bytes, float3 c) { putValue(bytes, packRgb9E5(c)); });
}

Ktx2Writer cubeFile(uint32_t format, uint32_t size, std::vector<PackageBytes> levels) {
    return { .format = format, .width = size, .height = size, .faces = 6, .levels = std::move(levels) };
}

// Radiance 1 + d has coefficients of d alone, whatever the format and size of the cube.
TEST_F(EnvironmentPackageTest, CubeMapsOfOtherProgramsAreBaked) {
    const Ktx2Writer files[] = {
        cubeFile(97, 64, { halvesOf(64) }),           cubeFile(106, 64, { floatsOf(64) }),
        cubeFile(123, 64, { sharedExponentsOf(64) }), cubeFile(97, 64, { halvesOf(64), halvesOf(32), halvesOf(16) }),
        cubeFile(97, 50, { halvesOf(50) }),           cubeFile(97, 12, { halvesOf(12) })
    };
    for (Ktx2Writer const& writer : files) {
        const auto data = loadBytes(writer.file());
        ASSERT_TRUE(data) << data.error().message;
        EXPECT_EQ(data->specular.width, 32u);
        EXPECT_EQ(data->sky.width, writer.width == 12 ? 16u : 64u);
        EXPECT_EQ(data->statistics.sourceWidth, writer.width);
        const auto& sh = data->irradianceSh; // 1, y, z, x: two thirds of a cosine
        EXPECT_NEAR(sh[0].x, 1, 0.01);
        EXPECT_NEAR(sh[3].x, 2.0 / 3, 0.01);
        EXPECT_NEAR(sh[1].y, 2.0 / 3, 0.01);
        EXPECT_NEAR(sh[2].z, 2.0 / 3, 0.01);
        EXPECT_NEAR(sh[1].x, 0, 0.01);
        EXPECT_NEAR(sh[3].z, 0, 0.01);
    }
}

TEST_F(EnvironmentPackageTest, LevelsOfOtherProgramsDoNotCount) {
    const auto one = loadBytes(cubeFile(97, 64, { halvesOf(64) }).file());
    PackageBytes white(size_t{ 6 } * 32 * 32 * 8, std::byte{ 0x3C });
    const auto two = loadBytes(cubeFile(97, 64, { halvesOf(64), white }).file());
    ASSERT_TRUE(one && two);
    expectSameCubes(*one, *two);
}

TEST_F(EnvironmentPackageTest, CubesThatAreNoLightAreRepairedAndCounted) {
    PackageBytes halves = halvesOf(16);
    halves[1] |= std::byte{ 0x80 }; // negative
    const auto data = loadBytes(cubeFile(97, 16, { halves }).file());
    ASSERT_TRUE(data);
    EXPECT_EQ(data->statistics.repairs.negative, 1u);
}

TEST_F(EnvironmentPackageTest, OtherTexturesAreErrorsThatSayWhatTheyAre) {
    Ktx2Writer flat{ .format = 97, .width = 16, .height = 16, .levels = { PackageBytes(16 * 16 * 8) } };
    Ktx2Writer array = cubeFile(97, 16, { PackageBytes(size_t{ 16 } * 16 * 6 * 2 * 8) });
    array.elements = 2;
    const Ktx2Writer codes = cubeFile(37, 16, { PackageBytes(size_t{ 16 } * 16 * 6 * 4) });
    const Ktx2Writer large = cubeFile(97, 4096, { PackageBytes(8) });
    const std::pair<Ktx2Writer const*, const char*> cases[] = { { &flat, "not a cube map" },
                                                                { &array, "an array of cube maps" },
                                                                { &codes, "8 bits a channel" },
                                                                { &large, "more than 2048" } };
    for (const auto& [writer, says] : cases) {
        const auto loaded = loadBytes(writer->file());
        ASSERT_FALSE(loaded) << says;
        EXPECT_EQ(loaded.error().code, ErrorCode::Unsupported);
        EXPECT_NE(loaded.error().message.find(says), std::string::npos) << loaded.error().message;
        EXPECT_NE(loaded.error().message.find("'sky.ktx2'"), std::string::npos);
    }
}

TEST_F(EnvironmentPackageTest, ACubeOfTheSizeWantedKeepsItsTexels) {
    CubePicture picture{ radianceCube(32), {} };
    const IblCube cube = cubeFromPicture(picture, 32, mJobs);
    ASSERT_EQ(cube.size(), 6u);
    for (uint32_t face = 0; face < 6; ++face) {
        for (int i = 0; i < 32; ++i)
            EXPECT_EQ(cube.front().radiance(face, i, 31 - i), picture.radiance.radiance(face, i, 31 - i));
    }
}

} // namespace
} // namespace filament_core::assets
