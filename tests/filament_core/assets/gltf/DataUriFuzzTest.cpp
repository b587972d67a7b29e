// SPDX-License-Identifier: Apache-2.0
// Data URIs: what RFC 2397 and RFC 4648 allow is read, and edits of it give bytes or an error.
#include "tests/fuzz/DataUriFuzzBody.h"

#include <gtest/gtest.h>

#include <random>

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

} // namespace
} // namespace filament_core::assets
