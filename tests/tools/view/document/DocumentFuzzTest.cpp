// SPDX-License-Identifier: Apache-2.0
// Replays edits of a document, without clang.
#include "tests/fuzz/DocumentFuzzBody.h"
#include "tests/fuzz/EditedText.h"
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

TEST(DocumentFuzz, AnyTextIsADocumentOrAnErrorOfOneLine) {
    const std::string text = shortText();
    const auto once = [](std::string const& input) {
        return fuzzDocumentOnce({ reinterpret_cast<const uint8_t*>(input.data()), input.size() });
    };
    ASSERT_TRUE(once(text));
    Random random(11);
    size_t documents = 0;
    for (int round = 0; round < 800; ++round) documents += once(test::editedText(text, random)) ? 1 : 0;
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
        for (int round = 0; round < 800; ++round) read += once(test::editedText(text, random)) ? 1 : 0;
        EXPECT_GT(read, 10u) << "edits of numbers are still cameras";
        EXPECT_LT(read, 600u);
        for (size_t length = 0; length < text.size(); length += 7) once(text.substr(0, length));
    }
    ASSERT_TRUE(once(shortText())) << "a document";
}

} // namespace
} // namespace filament_core::view
