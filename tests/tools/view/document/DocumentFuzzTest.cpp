// SPDX-License-Identifier: Apache-2.0
// Replays edits of a document, without clang.
#include "tests/fuzz/DocumentFuzzBody.h"
#include "tests/fuzz/TextFormsFuzzBody.h"
#include "tests/tools/view/document/Leaves.h"

#include <gtest/gtest.h>

namespace filament_core::view {
namespace {

/// Without the many options of the view, so that edits hit everything else, too.
std::string shortText() {
    std::string text = toJson(fullDocument());
    for (const char* options : { "\"quality\": {", "\"effects\": {", "\"display\": {" }) {
        const size_t begin = text.find(options) + std::string_view(options).size();
        text.erase(begin, text.find('}', begin) - begin);
    }
    return text;
}

std::string edited(std::string text, Random& random) {
    constexpr std::string_view kMarks = "{}[]:,\"\\-0e9. ntf";
    for (auto edits = 1 + random() % 3; edits > 0 && !text.empty(); --edits) {
        const size_t at = random() % text.size();
        switch (random() % 4) {
        case 0:
            text[at] = kMarks[random() % kMarks.size()];
            break;
        case 1:
            text.erase(at, 1 + random() % 12);
            break;
        case 2:
            text.insert(at, text.substr(random() % text.size(), random() % 24));
            break;
        default:
            text[at] = static_cast<char>(random());
        }
    }
    return text;
}

TEST(DocumentFuzz, AnyTextIsADocumentOrAnErrorOfOneLine) {
    const std::string text = shortText();
    const auto once = [](std::string const& input) {
        return fuzzDocumentOnce({ reinterpret_cast<const uint8_t*>(input.data()), input.size() });
    };
    ASSERT_TRUE(once(text));
    Random random(11);
    size_t documents = 0;
    for (int round = 0; round < 800; ++round) documents += once(edited(text, random)) ? 1 : 0;
    EXPECT_GT(documents, 10u) << "edits of numbers are still documents";
    EXPECT_LT(documents, 400u);
    for (size_t length = 0; length < text.size(); length += 37) once(text.substr(0, length));
    once(std::string(200'000, '['));
}

TEST(DocumentFuzz, AnyTextIsACameraOrAPathOrAnErrorOfOneLine) {
    const auto once = [](std::string const& input) {
        return fuzzTextFormsOnce({ reinterpret_cast<const uint8_t*>(input.data()), input.size() });
    };
    for (std::string const& text : { toJson(fullDocument().paths.at(0)), toJson(fullDocument().view.camera) }) {
        ASSERT_TRUE(once(text));
        Random random(12);
        size_t read = 0;
        for (int round = 0; round < 800; ++round) read += once(edited(text, random)) ? 1 : 0;
        EXPECT_GT(read, 10u) << "edits of numbers are still cameras";
        EXPECT_LT(read, 600u);
        for (size_t length = 0; length < text.size(); length += 7) once(text.substr(0, length));
    }
    ASSERT_TRUE(once(shortText())) << "a document";
}

} // namespace
} // namespace filament_core::view
