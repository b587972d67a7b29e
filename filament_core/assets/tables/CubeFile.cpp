// SPDX-License-Identifier: Apache-2.0
// .cube files: Adobe 2013, "Cube LUT Specification" 1.0, and the input ranges of the files that Resolve writes.
#include "base/NumberText.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/tables/DisplayColor.h"
#include "shaders/lib/LibCpp.h"

#include <filament_core/Look.h>

#include <array>
#include <optional>

namespace filament_core {
namespace {

constexpr size_t kMaxBytes = size_t{ 256 } << 20, kMaxTitle = 250;
constexpr uint32_t kMaxCurve = 65536, kMaxCube = 128;
constexpr float kMaxValue = 1e10f;
constexpr std::string_view kBlank = " \t\r";

std::string printable(std::string_view text) {
    std::string shown(text.substr(0, 32));
    for (char& c : shown) c = c >= ' ' && c < 127 ? c : '?';
    return shown;
}

std::optional<float> finiteNumber(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    return numberOf(word, -kMaxValue, kMaxValue);
}

/// The words of a line. Returns how many there are; only the first are kept.
size_t wordsOf(std::string_view line, std::array<std::string_view, 4>& words) {
    size_t count = 0;
    for (size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
        const size_t end = std::min(line.find_first_of(kBlank, at), line.size());
        if (count < words.size()) words[count] = line.substr(at, end - at);
        ++count;
        at = line.find_first_not_of(kBlank, end);
    }
    return count;
}

/// Reads line by line; the first error ends it.
class CubeText {
public:
    CubeText(std::string_view text, std::string_view name) : mText(text), mName(name) {}

    Result<std::shared_ptr<const Look>> read() {
        while (!mText.empty() && !mError) {
            const size_t end = mText.find('\n');
            ++mLine;
            readLine(mText.substr(0, end));
            mText.remove_prefix(end == std::string_view::npos ? mText.size() : end + 1);
        }
        if (!mError) checkWhole();
        if (mError) return *mError;
        return std::make_shared<const Look>(std::move(mLook));
    }

private:
    template <class... Args>
    void refuse(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
        if (mError) return;
        mError = fail(code, "{}: line {}: {}", mName, mLine, fmt::format(format, std::forward<Args>(args)...));
    }

    void readLine(std::string_view line) {
        std::array<std::string_view, 4> words;
        const size_t count = wordsOf(line, words);
        if (count == 0 || words[0][0] == '#') return;
        const char first = words[0][0];
        const bool isKeyword = (first >= 'A' && first <= 'Z') || first == '_';
        if (!isKeyword) return readEntry(words, count);
        if (!mLook.entries.empty())
            return refuse(ErrorCode::Corrupt, "'{}' comes after colours; move it before them", printable(words[0]));
        readKeyword(line, words, count);
    }

    void readKeyword(std::string_view line, std::array<std::string_view, 4> const& words, size_t count) {
        const std::string_view keyword = words[0];
        if (keyword == "TITLE") return readTitle(line);
        if (keyword == "LUT_1D_SIZE" || keyword == "LUT_3D_SIZE")
            return readSize(keyword == "LUT_3D_SIZE", words, count);
        if (keyword == "DOMAIN_MIN") return readDomain(mLook.domainMin, words, count);
        if (keyword == "DOMAIN_MAX") return readDomain(mLook.domainMax, words, count);
        if (keyword == "LUT_1D_INPUT_RANGE" || keyword == "LUT_3D_INPUT_RANGE") return readRange(words, count);
        refuse(ErrorCode::Corrupt,
               "'{}' is no keyword of .cube files: TITLE, LUT_1D_SIZE, LUT_3D_SIZE, DOMAIN_MIN, DOMAIN_MAX, "
               "LUT_1D_INPUT_RANGE, LUT_3D_INPUT_RANGE",
               printable(keyword));
    }

    void readTitle(std::string_view line) {
        const size_t first = line.find('"'), last = line.rfind('"');
        if (first == std::string_view::npos || first == last || last - first - 1 > kMaxTitle)
            return refuse(ErrorCode::Corrupt, "expected a TITLE of at most {} characters in quotes", kMaxTitle);
        mLook.title = std::string(line.substr(first + 1, last - first - 1));
        for (char& c : mLook.title) c = c == '"' || static_cast<unsigned char>(c) < ' ' ? '\'' : c;
    }

    void readSize(bool isCube, std::array<std::string_view, 4> const& words, size_t count) {
        if (mLook.size != 0)
            return refuse(ErrorCode::Unsupported, "a second table; a file with a curve before its cube is not read");
        const uint32_t most = isCube ? kMaxCube : kMaxCurve;
        const uint32_t size = count == 2 ? numberOf<uint32_t>(words[1]).value_or(0) : 0;
        if (size < 2 || size > most)
            return refuse(ErrorCode::Unsupported, "{} is '{}', expected a whole number from 2 to {}", words[0],
                          printable(count > 1 ? words[1] : ""), most);
        mLook.size = size;
        mLook.isCube = isCube;
        mWanted = isCube ? size_t{ size } * size * size : size;
    }

    void readDomain(float3& corner, std::array<std::string_view, 4> const& words, size_t count) {
        if (count != 4) return refuse(ErrorCode::Corrupt, "{} has {} numbers, expected 3", words[0], count - 1);
        for (int c = 0; c < 3; ++c) readNumber(words[static_cast<size_t>(c) + 1], corner[c]);
    }

    void readRange(std::array<std::string_view, 4> const& words, size_t count) {
        if (count != 3) return refuse(ErrorCode::Corrupt, "{} has {} numbers, expected 2", words[0], count - 1);
        float least = 0, most = 1;
        readNumber(words[1], least);
        readNumber(words[2], most);
        mLook.domainMin = float3(least), mLook.domainMax = float3(most);
    }

    void readNumber(std::string_view word, float& value) {
        const std::optional<float> number = finiteNumber(word);
        if (!number) return refuse(ErrorCode::Corrupt, "'{}' is not a number from -1e10 to 1e10", printable(word));
        value = *number;
    }

    void readEntry(std::array<std::string_view, 4> const& words, size_t count) {
        if (mWanted == 0)
            return refuse(ErrorCode::Corrupt, "'{}' comes before LUT_1D_SIZE or LUT_3D_SIZE", printable(words[0]));
        if (count != 3) return refuse(ErrorCode::Corrupt, "a colour has {} numbers, expected 3", count);
        if (mLook.entries.size() == mWanted)
            return refuse(ErrorCode::Corrupt, "more colours than the {} of its size; remove them", mWanted);
        float3 entry(0);
        for (int c = 0; c < 3; ++c) readNumber(words[static_cast<size_t>(c)], entry[c]);
        mLook.entries.push_back(entry);
    }

    void checkWhole() {
        if (mWanted == 0) return refuse(ErrorCode::Corrupt, "no LUT_1D_SIZE or LUT_3D_SIZE; it is no .cube file");
        if (mLook.entries.size() < mWanted)
            return refuse(ErrorCode::Corrupt, "the file ends after {} of {} colours; it is truncated",
                          mLook.entries.size(), mWanted);
        for (int c = 0; c < 3; ++c) {
            if (!(mLook.domainMin[c] < mLook.domainMax[c]))
                return refuse(ErrorCode::Corrupt, "DOMAIN_MIN {} is not below DOMAIN_MAX {}", mLook.domainMin[c],
                              mLook.domainMax[c]);
        }
    }

    std::string_view mText, mName;
    size_t mLine = 0, mWanted = 0;
    Look mLook;
    std::optional<Error> mError;
};

std::string rowOf(float3 v) { return fmt::format("{} {} {}\n", v.x, v.y, v.z); }

} // namespace

Result<std::shared_ptr<const Look>> parseLook(std::string_view text, std::string_view name) {
    return CubeText(text, name).read();
}

Result<std::shared_ptr<const Look>> loadLook(std::filesystem::path const& path) {
    const Result<std::string> text = assets::readText(path, kMaxBytes);
    if (!text) return text.error();
    return parseLook(*text, path.string());
}

std::string cubeText(Look const& look) {
    std::string text;
    if (!look.title.empty()) text += fmt::format("TITLE \"{}\"\n", look.title);
    text += fmt::format("LUT_{}D_SIZE {}\n", look.isCube ? 3 : 1, look.size);
    text += "DOMAIN_MIN " + rowOf(look.domainMin) + "DOMAIN_MAX " + rowOf(look.domainMax);
    for (float3 const& entry : look.entries) text += rowOf(entry);
    return text;
}

Result<void> saveLook(std::filesystem::path const& path, Look const& look) {
    const std::string text = cubeText(look);
    return assets::replaceFile(path, std::as_bytes(std::span(text)));
}

Look bakeLook(DisplayTransform const& display, ColorGrading const& grading, uint32_t size) {
    namespace lib = shader::lib;
    const assets::DisplayColor displayColor(display, grading.enabled ? &grading : nullptr);
    Look look{ .title = "ACEScct of linear Rec. 709 to display",
               .size = std::clamp(size, 2u, kMaxCube),
               .domainMin = float3(lib::gradingLog(0.0f)),
               .entries = {} };
    const auto lightAt = [&](uint32_t i) {
        const float share = static_cast<float>(i) / static_cast<float>(look.size - 1);
        return std::max(lib::lightFromGradingLog(look.domainMin.x + share * (1 - look.domainMin.x)), 0.0f);
    };
    look.entries.reserve(size_t{ look.size } * look.size * look.size);
    for (uint32_t b = 0; b < look.size; ++b)
        for (uint32_t g = 0; g < look.size; ++g)
            for (uint32_t r = 0; r < look.size; ++r)
                look.entries.push_back(displayColor(float3(lightAt(r), lightAt(g), lightAt(b))));
    return look;
}

} // namespace filament_core
