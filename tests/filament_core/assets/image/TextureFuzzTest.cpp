// SPDX-License-Identifier: Apache-2.0
// The body of tests/fuzz/TextureFuzz.cpp, on damaged files of every kind.
#include "tests/filament_core/assets/blocks/BasisWriter.h"
#include "tests/filament_core/assets/image/DdsWriter.h"
#include "tests/filament_core/assets/image/Ktx2Writer.h"
#include "tests/fuzz/TextureFuzzBody.h"

#include <gtest/gtest.h>

#include <random>

namespace filament_core::assets::test {
namespace {

using FuzzBytes = std::vector<std::byte>;

FuzzBytes fuzzNoise(size_t count, std::mt19937& random) {
    FuzzBytes bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    return bytes;
}

/// A small file of each kind of texel.
std::vector<FuzzBytes> textureFiles(std::mt19937& random) {
    std::vector<FuzzBytes> files;
    for (const uint32_t format : { 9u, 64u, 97u, 109u, 123u, 131u, 139u, 142u, 144u, 145u, 151u, 154u, 165u }) {
        const bool isPlain = format < 131;
        const size_t bytes = isPlain ? 16 * 64 : 16 * 4;
        for (const size_t size : { bytes, bytes / 2, size_t{ 64 }, size_t{ 32 }, size_t{ 8 } })
            files.push_back(
                    Ktx2Writer{ .format = format, .width = 8, .height = 8, .levels = { fuzzNoise(size, random) } }
                            .file());
    }
    files.push_back(Ktx2Writer{ .format = 0,
                                .width = 8,
                                .height = 8,
                                .model = 166,
                                .channels = { 3 },
                                .keys = { { "KTXswizzle", "rrrg" }, { "KTXorientation", "ru" } },
                                .levels = { fuzzNoise(64, random), fuzzNoise(16, random) } }
                            .file());
    BasisWriter writer(20, 20, false, 1);
    std::vector<blocks::Texel8> texels;
    const FuzzBytes slice = writer.slice(20, 20, texels);
    Ktx2Writer basis{
        .format = 0, .width = 20, .height = 20, .compression = 1, .model = 163, .channels = { 0 }, .levels = { slice }
    };
    basis.globalData = writer.globalData({ { .length = static_cast<uint32_t>(slice.size()) } });
    files.push_back(basis.file());
    for (const uint32_t dxgi : { 0u, 2u, 26u, 28u, 65u, 71u, 83u, 95u, 98u })
        files.push_back(
                DdsWriter{ .dxgi = dxgi, .width = 4, .height = 4, .levels = 3, .texels = fuzzNoise(16 * 21, random) }
                        .file());
    files.push_back(DdsWriter{ .fourCc = "DXT5", .width = 4, .height = 4, .texels = fuzzNoise(16, random) }.file());
    return files;
}

TEST(TextureFuzz, DamagedFilesAreErrorsOfOneLineOrTextures) {
    std::mt19937 random(1);
    uint32_t read = 0, refused = 0;
    for (FuzzBytes const& file : textureFiles(random)) {
        for (int turn = 0; turn < 200; ++turn) {
            FuzzBytes damaged = file;
            for (uint32_t i = 0; i <= random() % 4; ++i)
                damaged[random() % damaged.size()] = static_cast<std::byte>(random());
            if (random() % 8 == 0) damaged.resize(random() % damaged.size());
            ++(fuzzTexture(damaged) ? read : refused);
        }
    }
    EXPECT_GT(read, 500u);
    EXPECT_GT(refused, 500u);
}

TEST(TextureFuzz, DamagedCodebooksAreErrorsOrTexels) {
    std::mt19937 random(2);
    BasisWriter writer(20, 20, false, 1);
    std::vector<blocks::Texel8> texels;
    const FuzzBytes slice = writer.slice(37, 29, texels), books = writer.globalData({ {} });
    FuzzBytes file{ static_cast<std::byte>(books.size() & 255), static_cast<std::byte>(books.size() >> 8) };
    file.insert(file.end(), books.begin(), books.end());
    file.insert(file.end(), slice.begin(), slice.end());
    ASSERT_TRUE(fuzzBasis(file));
    for (int turn = 0; turn < 5000; ++turn) {
        FuzzBytes damaged = file;
        for (uint32_t i = 0; i <= random() % 4; ++i)
            damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        fuzzBasis(damaged);
    }
}

} // namespace
} // namespace filament_core::assets::test
