// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/Compression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>

namespace filament_core::shader {
namespace {

using Bytes = std::vector<std::byte>;
using ::testing::HasSubstr;

constexpr uint32_t kMany = 1 << 24;

Bytes bytesOf(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    return { bytes.begin(), bytes.end() };
}

void setClaim(Bytes& packed, uint32_t size) {
    for (int i = 0; i < 4; ++i) packed[static_cast<size_t>(i)] = static_cast<std::byte>(size >> (8 * i));
}

std::string refusal(std::span<const std::byte> packed, uint32_t maxBytes = kMany) {
    const Result<Bytes> out = decompressBytes(packed, maxBytes);
    if (out) return "accepted";
    EXPECT_EQ(out.error().code, ErrorCode::Corrupt);
    return out.error().message;
}

TEST(Compression, GivesBackWhatItWasGiven) {
    std::mt19937 random(7);
    for (const size_t size : { 1, 3, 17, 300, 70'000 }) {
        for (const uint32_t letters : { 1u, 2u, 20u, 256u }) {
            Bytes bytes(size);
            for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % letters);
            const Bytes packed = compressBytes(bytes);
            const Result<Bytes> out = decompressBytes(packed, static_cast<uint32_t>(size));
            ASSERT_TRUE(out) << out.error().message;
            EXPECT_EQ(*out, bytes) << size << " bytes of " << letters << " letters";
            EXPECT_EQ(compressBytes(bytes), packed);
        }
    }
}

TEST(Compression, RefusesMoreThanTheLimit) {
    const Bytes packed = compressBytes(Bytes(1'000'000));
    EXPECT_LT(packed.size(), 100u);
    EXPECT_THAT(refusal(packed, 999'999), HasSubstr("more bytes than the engine accepts"));
    EXPECT_TRUE(decompressBytes(packed, 1'000'000));
}

TEST(Compression, RefusesAClaimThatTheBytesCannotHoldBeforeItTakesMemory) {
    Bytes packed = compressBytes(bytesOf("void main() {}"));
    const auto frame = static_cast<uint32_t>(packed.size() - 4);
    setClaim(packed, 32768 * frame + 1);
    EXPECT_THAT(refusal(packed), HasSubstr("more bytes than it holds"));
    setClaim(packed, ~0u);
    EXPECT_THAT(refusal(packed, ~0u), HasSubstr("more bytes than it holds"));
}

TEST(Compression, RefusesEverySizeButItsOwn) {
    const std::string_view text = "to be, or not to be: that is the question";
    Bytes packed = compressBytes(bytesOf(text));
    const auto size = static_cast<uint32_t>(text.size());
    for (const uint32_t claim : { 1u, size - 1, size + 1 }) {
        setClaim(packed, claim);
        EXPECT_THAT(refusal(packed), HasSubstr("longer or shorter than it claims"));
    }
    setClaim(packed, 0);
    EXPECT_THAT(refusal(packed), HasSubstr("claims to be empty"));
}

TEST(Compression, RefusesWhatDoesNotEndWithTheFrame) {
    const Bytes original = compressBytes(bytesOf("to be, or not to be: that is the question; not to be, or to be"));
    for (size_t size = 0; size < original.size(); ++size)
        EXPECT_FALSE(decompressBytes(std::span(original).first(size), kMany)) << "cut at " << size;
    EXPECT_THAT(refusal(std::span(original).first(3)), HasSubstr("ends within its size"));
    EXPECT_THAT(refusal(std::span(original).first(original.size() - 1)), HasSubstr("cut short"));
    Bytes longer = original;
    longer.push_back(std::byte{ 0 });
    EXPECT_THAT(refusal(longer), HasSubstr("left over"));
    Bytes twice = original; // the library alone would unpack both frames
    twice.insert(twice.end(), original.begin() + 4, original.end());
    EXPECT_THAT(refusal(twice), HasSubstr("left over"));
    Bytes other = original;
    other[4] ^= std::byte{ 1 }; // of the magic number
    EXPECT_THAT(refusal(other), HasSubstr("malformed"));
}

// Code in common that is far apart, as two precisions of a stage have it.
TEST(Compression, FindsWhatIsHundredsOfKilobytesAway) {
    std::mt19937 random(3);
    Bytes bytes(300'000);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    const size_t once = compressBytes(bytes).size();
    bytes.insert(bytes.end(), bytes.begin(), bytes.end());
    EXPECT_LT(compressBytes(bytes).size(), once + 1000);
}

TEST(Compression, SurvivesAnyBytes) {
    const Bytes original = compressBytes(bytesOf("to be, or not to be: that is the question; not to be, or to be"));
    std::mt19937 random(9);
    size_t accepted = 0;
    for (int round = 0; round < 100'000; ++round) {
        Bytes bytes = original;
        for (auto edits = 1 + random() % 3; edits > 0; --edits)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        const Result<Bytes> out = decompressBytes(bytes, 1000);
        EXPECT_LE(out ? out->size() : 0, 1000u);
        accepted += out.ok();
    }
    EXPECT_GT(accepted, 0u) << "without a checksum other letters are other text";
}

} // namespace
} // namespace filament_core::shader
