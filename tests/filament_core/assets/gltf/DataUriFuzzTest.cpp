// SPDX-License-Identifier: Apache-2.0
// Data URIs: what RFC 2397 and RFC 4648 allow is read, and edits of it give bytes or an error.
#include "tests/fuzz/DataUriFuzzBody.h"

#include "filament_core/assets/gltf/GltfLoader.h"
#include "jobsystem/JobSystem.h"
#include "tests/filament_core/assets/FaultFile.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

namespace filament_core::assets {
namespace {

TEST(DataUri, SurvivesEditsAnywhere) {
    std::mt19937 random(2397);
    constexpr std::string_view kMarks = "=+/%;,:-_ \nAz0\xff";
    constexpr std::string_view kOriginal = "application/octet-stream;base64,AAECAwQFBgcICQoLDA0ODw==";
    size_t accepted = 0;
    for (int round = 0; round < 5000; ++round) {
        std::string text(kOriginal);
        for (auto edits = random() % 4; edits > 0; --edits) {
            const size_t at = random() % text.size();
            if (random() % 3 == 0)
                text.erase(at, 1 + random() % 4);
            else
                text[at] = kMarks[random() % kMarks.size()];
            if (text.empty()) break;
        }
        accepted += test::fuzzDataUri(text);
    }
    EXPECT_GT(accepted, 500u);
    EXPECT_LT(accepted, 5000u);
}

TEST(DataUri, OfOddTextsIsAnErrorOrItsBytes) {
    for (const char* text : { "", ",", ";base64,", ";base64", "base64,AAAA", ";base64,A", ";base64,AA",
                              ";base64,A===", ";base64,====", ";base64,AA=A", "text/plain,%", "text/plain,%4",
                              "text/plain,%zz", "a;b;c," })
        test::fuzzDataUri(text);
}

/// A character of a base64 text, percent-encoded.
std::string escaped(char c, bool isLower) {
    return isLower ? fmt::format("%{:02x}", static_cast<unsigned>(c))
                   : fmt::format("%{:02X}", static_cast<unsigned>(c));
}

// RFC 2397 by its letter, and what encoders of MIME, of query strings and people's hands make of it.
TEST(DataUri, EverySpellingOfTheSameBytesGivesThem) {
    const std::vector<std::byte> bytes{ std::byte{ 0xFB }, std::byte{ 0xEF }, std::byte{ 0xFF }, std::byte{ 0 },
                                        std::byte{ 1 },    std::byte{ 2 },    std::byte{ 3 } };
    constexpr std::string_view kText = "++//AAECAw"; // two characters of padding are missing
    size_t cases = 0;
    for (const std::string_view scheme : { "data:", "DATA:", "Data:", " data:", "\n\tdata:" }) {
        for (const std::string_view type : { "", "application/octet-stream", "Application/Octet-Stream",
                                             "image/png;charset=UTF-8", "a/b;c=\"d\";e=f" }) {
            for (const std::string_view base64 :
                 { ";base64", ";BASE64", ";Base64", "; base64 ", ";base64;charset=utf-8" }) {
                for (int form = 0; form < 10; ++form) {
                    std::string data;
                    for (size_t i = 0; i < kText.size(); ++i) {
                        const char c = kText[i];
                        if (form == 0)
                            data += c == '+' ? '-' : c == '/' ? '_' : c; // the alphabet for URLs
                        else if (form == 1 || form == 2)
                            data += c == '+' || c == '/' ? escaped(c, form == 2) : std::string(1, c);
                        else
                            data += c;
                        if (form == 3 && i % 3 == 2) data += '\n';
                        if (form == 4 && i % 4 == 3) data += "\r\n\t ";
                        if (form == 5 && i % 5 == 4) data += "%0A";
                    }
                    constexpr std::array<std::string_view, 10> kEnds{ "==",       "==", "%3D%3D", "=\n=\n", "==",
                                                                      "==%0D%0A", "",   "=",      " ",      "%3d=" };
                    data += kEnds[static_cast<size_t>(form)];
                    const std::string uri = fmt::format("{}{}{},{}", scheme, type, base64, data);
                    const auto read = readGltfUri(uri, GltfFolder("/nonexistent"));
                    ASSERT_TRUE(read.ok()) << read.error().message << '\n' << uri;
                    ASSERT_EQ(*read, bytes) << uri;
                    ++cases;
                }
            }
        }
    }
    EXPECT_EQ(cases, 5u * 5 * 5 * 10);
}

TEST(DataUri, BrokenOnesSayWhatIsWrongAndWhere) {
    const auto errorOf = [](const char* uri) { return readGltfUri(uri, GltfFolder("/nonexistent")).error().message; };
    EXPECT_EQ(errorOf("data:image/png;base64,AAAA{AAA"),
              "the data URI holds a character that is not base64 (code 123 at 4); encode it again");
    EXPECT_EQ(errorOf("data:;base64,AA=A"),
              "the data URI holds a character that is not base64 (code 61 at 2); encode it again");
    EXPECT_EQ(errorOf("DATA:image/png;base64"), "the data URI has no comma before its data; write data:;base64,...");
    EXPECT_EQ(readGltfUri("data:;base64x,AAAA", GltfFolder("/nonexistent"))->size(), 4u) << "plain text";
}

TEST(DataUri, AModelWhoseImageIsWrappedIsRead) {
    SKIP_WITHOUT_FAULT_FILES();
    jobs::JobSystem jobs;
    const auto model = loadGltf(faultFile("data_uri_wrapped.gltf"), jobs);
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
}

} // namespace
} // namespace filament_core::assets
