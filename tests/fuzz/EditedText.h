// SPDX-License-Identifier: Apache-2.0
/// EditedText: a text with one to three edits anywhere, for replay tests of fuzzers: another mark or byte, a piece that
/// is missing, a piece of the same text, a line less, or, seldom, the end missing.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace filament_core::test {

inline void edit(std::string& text, std::mt19937& random, std::string_view marks) {
    const size_t at = random() % text.size();
    switch (random() % 16) {
    case 0:
        return text.resize(at);
    case 1:
    case 2: {
        const size_t begin = text.rfind('\n', at);
        if (begin != std::string::npos) text.erase(begin, text.find('\n', begin + 1) - begin);
        return;
    }
    case 3:
        text[at] = static_cast<char>(random());
        return;
    case 4:
    case 5:
    case 6:
    case 7:
        text.erase(at, 1 + random() % 12);
        return;
    case 8:
    case 9:
    case 10:
    case 11:
        text.insert(at, text.substr(random() % text.size(), random() % 40));
        return;
    default:
        text[at] = marks[random() % marks.size()];
    }
}

/// `marks`: characters that mean something in the format.
inline std::string editedText(std::string text, std::mt19937& random,
                              std::string_view marks = "{}[]:,\"\\-0e9. ntf=@+|\n") {
    for (auto edits = 1 + random() % 3; edits > 0 && !text.empty(); --edits) edit(text, random, marks);
    return text;
}

} // namespace filament_core::test
