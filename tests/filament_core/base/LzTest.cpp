// SPDX-License-Identifier: Apache-2.0
#include "filament_core/base/Lz.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>

namespace filament {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytesOf(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    return { bytes.begin(), bytes.end() };
}

TEST(Lz, GivesBackWhatItWasGiven) {
    std::mt19937 random(7);
    for (size_t size : { 0, 1, 3, 4, 5, 17, 300, 70'000 }) {
        for (const uint32_t letters : { 1u, 2u, 20u, 256u }) {
            Bytes bytes(size);
            for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % letters);
            const Bytes compressed = compressBytes(bytes);
            EXPECT_EQ(decompressBytes(compressed, size), bytes) << size << " bytes of " << letters << " letters";
            EXPECT_EQ(compressBytes(bytes), compressed);
        }
    }
}

TEST(Lz, NeedsAFractionOfTheBytesForWhatRepeatsItself) {
    std::string text;
    for (int i = 0; i < 500; ++i) text += "precise highp float _" + std::to_string(i) + " = a * b;\n";
    EXPECT_LT(compressBytes(bytesOf(text)).size() * 4, text.size());
    std::mt19937 random(8);
    Bytes noise(10'000);
    for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
    EXPECT_LT(compressBytes(noise).size(), noise.size() + 100) << "noise stays as long as it is";
}

TEST(Lz, RefusesMoreThanTheLimitBeforeItTakesMemory) {
    const Bytes zeros(1'000'000);
    const Bytes compressed = compressBytes(zeros);
    EXPECT_LT(compressed.size(), 20u);
    EXPECT_FALSE(decompressBytes(compressed, zeros.size() - 1));
    EXPECT_TRUE(decompressBytes(compressed, zeros.size()));
}

TEST(Lz, SurvivesAnyBytes) {
    const Bytes original = compressBytes(bytesOf("to be, or not to be: that is the question; not to be, or to be"));
    for (size_t size = 0; size < original.size(); ++size)
        EXPECT_FALSE(decompressBytes(std::span(original).first(size), 1000)) << "cut at " << size;
    Bytes longer = original;
    longer.push_back(std::byte{ 0 });
    EXPECT_FALSE(decompressBytes(longer, 1000)) << "something is left over";
    std::mt19937 random(9);
    for (int round = 0; round < 100'000; ++round) {
        Bytes bytes = original;
        for (uint32_t edits = 1 + random() % 3; edits > 0; --edits)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        const auto out = decompressBytes(bytes, 1000);
        if (out) EXPECT_LE(out->size(), 1000u);
    }
}

} // namespace
} // namespace filament
