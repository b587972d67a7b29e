// SPDX-License-Identifier: Apache-2.0
// Half of the mutations keep the form of a module, because one that changes a length or moves a word is mostly refused
// by the first walk: another operand, another operation of the same length, an instruction twice, moved or left out.
#include "tests/backend/vulkan/ShaderWordsFuzzBody.h"

#include <cstddef>
#include <random>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t maxSize);

namespace {

using Words = std::vector<uint32_t>;

struct Span {
    size_t at = 0, count = 0;
};

/// The instructions of a file, from where its module begins.
std::vector<Span> instructionsOf(Words const& words) {
    constexpr size_t kHeader = 5;
    std::vector<Span> found;
    size_t at = 1 + 2 * size_t{ words[0] >> 8 & 63 } + kHeader;
    for (; at < words.size() && words[at] >> 16 != 0; at += found.back().count)
        found.push_back({ at, std::min<size_t>(words[at] >> 16, words.size() - at) });
    return found;
}

void changeOne(Words& words, std::vector<Span> const& instructions, std::mt19937& random) {
    const Span it = instructions[random() % instructions.size()], other = instructions[random() % instructions.size()];
    const auto begin = [&](Span span) { return words.begin() + static_cast<ptrdiff_t>(span.at); };
    const auto end = [&](Span span) { return words.begin() + static_cast<ptrdiff_t>(span.at + span.count); };
    const Words copy(begin(it), end(it));
    const uint32_t word = words[random() % words.size()];
    switch (random() % 5) {
    case 0: // an operand that occurs elsewhere
        if (it.count > 1) words[it.at + 1 + random() % (it.count - 1)] = word;
        break;
    case 1:
        words[it.at] = (words[it.at] & 0xFFFF0000) | (words[other.at] & 0xFFFF);
        break;
    case 2:
        words.insert(begin(other), copy.begin(), copy.end());
        break;
    case 3:
        words.erase(begin(it), end(it));
        break;
    default: // cut short or lengthened into its neighbour's words
        words[it.at] = (words[it.at] & 0xFFFF) | (words[other.at] & 0xFFFF0000);
    }
}

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned int seed) {
    std::mt19937 random(seed);
    Words words(size / sizeof(uint32_t));
    if (words.empty() || random() % 2 == 0) return LLVMFuzzerMutate(data, size, maxSize);
    std::memcpy(words.data(), data, words.size() * sizeof(uint32_t));
    for (auto edits = 1 + random() % 4; edits > 0; --edits) {
        const std::vector<Span> instructions = instructionsOf(words);
        if (instructions.empty()) break;
        changeOne(words, instructions, random);
    }
    words.resize(std::min(words.size(), maxSize / sizeof(uint32_t)));
    std::memcpy(data, words.data(), words.size() * sizeof(uint32_t));
    return words.size() * sizeof(uint32_t);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    filament_core::backend::vulkan::fuzzShaderWords(std::span(data, size));
    return 0;
}
