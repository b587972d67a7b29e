// SPDX-License-Identifier: Apache-2.0
// What two engines have for one pixel: every attachment at its place, and a mark at each value whose bits differ.
#include "tools/view/compare/PixelReport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace filament_core::view {
namespace {

constexpr uint2 kView{ 8, 6 };

/// Its value is the place of the texel.
backend::CapturedAttachment floats(std::string name, uint2 size) {
    backend::CapturedAttachment attachment{
        .name = std::move(name), .format = Format::R32F, .width = size.x, .height = size.y
    };
    for (uint32_t i = 0; i < size.x * size.y; ++i) {
        const auto value = static_cast<float>(i);
        auto const* bytes = reinterpret_cast<std::byte const*>(&value);
        attachment.bytes.insert(attachment.bytes.end(), bytes, bytes + 4);
    }
    return attachment;
}

InspectedFrame smallFrame() {
    InspectedFrame frame{ .size = kView };
    frame.inside.passes.push_back(
            { .name = "color", .attachments = { floats("light", kView), floats("half", { 4, 3 }) } });
    frame.inside.passes.push_back({ .name = "shadows", .attachments = { floats("atlas", { 64, 64 }) } });
    frame.picture = { .width = 8, .height = 6, .pixels = std::vector<std::byte>(8 * 6 * 4, std::byte{ 7 }) };
    frame.surface =
            PixelSurface{ .object = "node 1 'lid', primitive 0", .distanceMeters = 2.5, .positionWorld = { 1, 2, 3 } };
    return frame;
}

PixelRow const& row(std::vector<PixelRow> const& rows, std::string const& name) {
    for (PixelRow const& each : rows)
        if (each.name == name) return each;
    ADD_FAILURE() << "no row " << name;
    return rows.front();
}

TEST(PixelReport, ShowsEveryAttachmentAtItsTexel) {
    const InspectedFrame frame = smallFrame();
    const std::vector<PixelRow> rows = pixelRows({ 5, 3 }, &frame, &frame);
    EXPECT_EQ(row(rows, "light").values[0], "29");
    EXPECT_EQ(row(rows, "light").group, "color");
    EXPECT_EQ(row(rows, "light").detail, "R32F 8x6");
    EXPECT_EQ(row(rows, "half").values[1], "6");
    EXPECT_EQ(row(rows, "half").detail, "R32F 4x3 at 2, 1");
    EXPECT_EQ(row(rows, "displayed").values[0], "7, 7, 7, 7");
    EXPECT_EQ(row(rows, "object").values[0], "node 1 'lid', primitive 0");
    EXPECT_EQ(row(rows, "depth").values[0], "2.5");
    EXPECT_EQ(row(rows, "position").values[0], "1, 2, 3");
    for (PixelRow const& each : rows) EXPECT_FALSE(each.differs) << each.name;
    EXPECT_EQ(unseenAttachments(&frame, nullptr), 1u) << "the atlas";
}

TEST(PixelReport, TellsTheTexturesOfAnExplainedPixel) {
    InspectedFrame own = smallFrame();
    own.explanation.emplace();
    own.explanation->textures = {
        { .value = { 1, 1, 1, 1 } },
        { .parameter = "baseColorMap", .texture = "oak.png", .size = { 64, 32 }, .value = { -0.5, -0.25, 0, 0 } }
    };
    own.explanation->textures.push_back(
            { .parameter = "normalMap", .uv = float2(0.5f, 2), .texel = float3(0.5f, 0.25f, 1) });
    InspectedFrame other = own;
    other.explanation->textures[1].value.z = 0.5;
    const std::vector<PixelRow> rows = pixelRows({ 5, 3 }, &own, &other);
    EXPECT_EQ(row(rows, "none").values[0], "1, 1, 1");
    EXPECT_FALSE(row(rows, "none").differs);
    EXPECT_EQ(row(rows, "baseColorMap").detail, "oak.png 64x32");
    EXPECT_EQ(row(rows, "baseColorMap").values[0], "-0.5, -0.25, 0");
    EXPECT_EQ(row(rows, "baseColorMap").values[1], "-0.5, -0.25, 0.5");
    EXPECT_TRUE(row(rows, "baseColorMap").differs);
    const auto texel = std::ranges::find(rows, "texels, linear", &PixelRow::group);
    ASSERT_NE(texel, rows.end());
    EXPECT_EQ(texel->name, "normalMap");
    EXPECT_EQ(texel->detail, "at 0.5, 2");
    EXPECT_EQ(texel->values[1], "0.5, 0.25, 1");
}

TEST(PixelReport, MarksExactlyWhatDiffers) {
    const InspectedFrame own = smallFrame();
    for (uint32_t byte = 0; byte < 4; ++byte) {
        InspectedFrame other = own;
        other.inside.passes[0].attachments[0].bytes[(3 * 8 + 5) * 4 + byte] ^= std::byte{ 1 }; // one bit
        PixelReport report{ .rows = pixelRows({ 5, 3 }, &own, &other) };
        EXPECT_EQ(report.differing(), 1u) << byte;
        EXPECT_TRUE(row(report.rows, "light").differs);
        report.rows = pixelRows({ 4, 3 }, &own, &other);
        EXPECT_EQ(report.differing(), 0u) << "of the pixel beside it";
    }
    InspectedFrame other = own;
    other.surface->distanceMeters = 2.6;
    EXPECT_TRUE(row(pixelRows({ 0, 0 }, &own, &other), "depth").differs);
    other = own;
    other.picture.pixels[3] = std::byte{ 8 };
    EXPECT_TRUE(row(pixelRows({ 0, 0 }, &own, &other), "displayed").differs);
}

TEST(PixelReport, DifferingBitsAreMarkedEvenIfTheirNumbersReadTheSame) {
    InspectedFrame own = smallFrame(), other = smallFrame();
    const uint32_t quietNan = 0x7FC00000u, otherNan = 0x7FC00001u;
    std::memcpy(own.inside.passes[0].attachments[0].bytes.data(), &quietNan, 4);
    std::memcpy(other.inside.passes[0].attachments[0].bytes.data(), &otherNan, 4);
    const std::vector<PixelRow> rows = pixelRows({ 0, 0 }, &own, &other);
    EXPECT_EQ(row(rows, "light").values[0], row(rows, "light").values[1]);
    EXPECT_TRUE(row(rows, "light").differs);
}

TEST(PixelReport, WhatOneEngineDoesNotHaveDiffers) {
    const InspectedFrame own = smallFrame();
    const std::vector<PixelRow> alone = pixelRows({ 1, 1 }, nullptr, &own);
    EXPECT_EQ(row(alone, "light").values[0], "-");
    EXPECT_EQ(row(alone, "light").values[1], "9");
    EXPECT_TRUE(row(alone, "light").differs);
    InspectedFrame other = own;
    other.inside.passes[0].name = "another pass";
    EXPECT_EQ(row(pixelRows({ 1, 1 }, &own, &other), "light").values[1], "-");
    EXPECT_TRUE(pixelRows({ 1, 1 }, nullptr, nullptr).empty());
}

TEST(PixelReport, ForgetsOnlyWhatHasNoPixel) {
    InspectedFrame frame = smallFrame();
    const std::vector<PixelRow> before = pixelRows({ 7, 5 }, &frame, &frame);
    dropUnseen(frame);
    EXPECT_TRUE(frame.inside.passes[1].attachments[0].bytes.empty());
    const std::vector<PixelRow> after = pixelRows({ 7, 5 }, &frame, &frame);
    ASSERT_EQ(after.size(), before.size());
    for (size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].values, before[i].values);
}

TEST(PixelReport, TexelsOfSmallerAttachmentsCoverThePixel) {
    EXPECT_EQ(texelOf({ 6, 4 }, { 7, 5 }, { 7, 5 }), uint2(6, 4));
    EXPECT_EQ(texelOf({ 6, 4 }, { 7, 5 }, { 4, 3 }), uint2(3, 2)) << "rounded up";
    EXPECT_EQ(texelOf({ 6, 4 }, { 7, 5 }, { 3, 2 }), uint2(2, 1)) << "rounded down: the last one";
    EXPECT_EQ(texelOf({ 6, 4 }, { 7, 5 }, { 1, 1 }), uint2(0, 0));
    EXPECT_EQ(texelOf({ 6, 4 }, { 7, 5 }, { 7, 4 }), std::nullopt);
    EXPECT_EQ(texelOf({ 6, 4 }, { 7, 5 }, { 64, 64 }), std::nullopt);
    EXPECT_EQ(texelOf({ 6, 4 }, { 7, 5 }, { 0, 0 }), std::nullopt);
    for (uint32_t size = 1; size < 40; ++size) { // every texel of every level is reached, and none beyond
        for (uint32_t x = 0; x < size; ++x) {
            for (uint32_t level = 0; level < 6; ++level) {
                const uint2 attachment(std::max(1u, size >> level));
                const auto texel = texelOf(uint2(x), uint2(size), attachment);
                ASSERT_TRUE(texel.has_value());
                EXPECT_LT(texel->x, attachment.x);
            }
        }
    }
}

} // namespace
} // namespace filament_core::view
