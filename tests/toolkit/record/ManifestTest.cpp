// SPDX-License-Identifier: Apache-2.0
#include "toolkit/record/Manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace filament_core::record {
namespace {

using ::testing::HasSubstr;

Manifest fullManifest() {
    Manifest manifest{ .program = "test", .commit = "c0ffee", .machine = "m", .settings = R"({"a":[1,{"b":null}]})" };
    manifest.pictures = {
        { .name = "a", .format = Format::RGBA8, .size = { 3, 2 }, .hash = 0xffffffffffffffffull },
        { .name = "b-2", .format = Format::RGB10A2, .size = { 16384, 1 }, .space = OutputSpace::Rec2020Pq, .hash = 1 }
    };
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        manifest.traces.push_back({ .backend = backend,
                                    .device = "d",
                                    .driver = "\"v\"",
                                    .textBytes = 1ull << 33,
                                    .textHash = 2,
                                    .payloadBytes = 7,
                                    .payloadHash = 3,
                                    .problem = "p",
                                    .pictures = { { 5, 6 }, { 0, 0 } } });
        manifest.traces.back().frames = {
            { .index = 4,
              .passes = { { .name = "color + tone map",
                            .draws = 9,
                            .attachments = { { .name = "c", .format = Format::R11G11B10F, .size = { 1, 2 }, .hash = 8 },
                                             { .name = "d", .format = Format::D32F, .size = { 1, 2 }, .hash = 9 } } },
                          { .name = "" } } }
        };
    }
    return manifest;
}

TEST(Manifest, IsReadAsItWasWritten) {
    const std::string text = toJson(fullManifest());
    const Result<Manifest> read = parseManifest(text, "frame.json");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(toJson(*read), text);
    EXPECT_EQ(read->traces[1].frames[0].passes[0].attachments[1].hash, 9u);
    EXPECT_EQ(read->traces[0].textBytes, 1ull << 33);
    EXPECT_EQ(read->pictures[0].hash, 0xffffffffffffffffull);
    EXPECT_EQ(read->pictures[1].space, OutputSpace::Rec2020Pq);
    EXPECT_EQ(read->settings, R"({"a":[1,{"b":null}]})");
}

TEST(Manifest, EveryNameOfAnApiAndAPictureIsAFileInTheFolder) {
    EXPECT_EQ(tracePath("f", Backend::Vulkan), "f/vulkan.trace");
    EXPECT_EQ(payloadPath("f", Backend::Gles), "f/gles.trace.bin");
    EXPECT_EQ(picturePath("f", { .name = "a", .format = Format::RGBA16F }), "f/a.exr");
    for (const char* name : { "", "..", "a/b", "A", "a.b", "a b", "0123456789012345678901234567890123" })
        EXPECT_FALSE(isPictureName(name)) << name;
    for (const char* name : { "a", "picture-1", "01234567890123456789012345678901" })
        EXPECT_TRUE(isPictureName(name)) << name;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles, Backend::Null })
        EXPECT_EQ(enumFromName<Backend>(toString(backend)), backend);
    EXPECT_FALSE(enumFromName<Backend>("metal"));
}

/// What a change of the whole manifest makes the reader say.
std::string complaintAbout(std::function<void(Manifest&)> const& change) {
    Manifest manifest = fullManifest();
    change(manifest);
    const Result<Manifest> read = parseManifest(toJson(manifest), "frame.json");
    if (read) return "accepted";
    EXPECT_EQ(read.error().code, ErrorCode::Corrupt);
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
    EXPECT_THAT(read.error().message, HasSubstr("frame.json"));
    return read.error().message;
}

TEST(Manifest, ContradictionsAreNamed) {
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.pictures.clear(); }), HasSubstr("pictures: expected at least one"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.pictures[1].name = "a"; }), HasSubstr("'a' is there twice"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.pictures[1].name = "../a"; }), HasSubstr("name: expected"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.pictures[0].format = Format::R8; }), HasSubstr("format: expected"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.pictures[0].size.x = 16385; }), HasSubstr("size: expected"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.traces[1].backend = Backend::Vulkan; }),
                HasSubstr("vulkan is there twice"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.traces[1].backend = Backend::Null; }), HasSubstr("'null'"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.traces[0].pictures.pop_back(); }),
                HasSubstr("draws 1 of 2 pictures"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.traces[0].device = "a\nb"; }), HasSubstr("in one line"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.machine = std::string(5000, 'x'); }), HasSubstr("4096"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.traces[0].frames.resize(9); }), HasSubstr("at most 8"));
    EXPECT_THAT(complaintAbout([](Manifest& m) { m.traces.resize(3, m.traces[0]); }), HasSubstr("at most 2"));
}

TEST(Manifest, TextThatIsNoneIsRefusedInOneLine) {
    for (const char* text : { "", "{", "[]", "3", "{}", R"({"version": "filament-frame 2"})",
                              R"({"version": "filament-frame 1"})", R"({"version": "filament-frame 1", "x": 1})" }) {
        const Result<Manifest> read = parseManifest(text, "frame.json");
        ASSERT_FALSE(read.ok()) << text;
        EXPECT_EQ(read.error().code, ErrorCode::Corrupt) << text;
        EXPECT_THAT(read.error().message, HasSubstr("frame.json: ")) << text;
        EXPECT_EQ(read.error().message.find('\n'), std::string::npos) << text;
    }
    std::string text = toJson(fullManifest());
    text.replace(text.find("ffffffffffffffff"), 16, "FFFFFFFFFFFFFFFF");
    EXPECT_THAT(parseManifest(text, "frame.json").error().message, HasSubstr("hash: expected 16 lower-case"));
}

TEST(Manifest, SettingsAreNotNestedWithoutEnd) {
    const auto nested = [](size_t depth) {
        return R"({"version": "filament-frame 1", "settings": )" + std::string(depth, '[') + "\"]]\\\"]\"" +
               std::string(depth, ']') + "}";
    };
    EXPECT_THAT(parseManifest(nested(255), "frame.json").error().message, HasSubstr("pictures: expected"));
    for (const size_t depth : { 256, 2'000'000 })
        EXPECT_THAT(parseManifest(nested(depth), "frame.json").error().message,
                    HasSubstr("frame.json: nested deeper than 256"))
                << depth;
}

TEST(Manifest, AFolderWithoutOneIsNoSavedFrame) {
    const Result<Manifest> read = readManifest("no/such/folder");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().code, ErrorCode::NotFound);
    EXPECT_THAT(read.error().message, HasSubstr("'no/such/folder' is no saved frame"));
}

} // namespace
} // namespace filament_core::record
