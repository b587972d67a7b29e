// SPDX-License-Identifier: Apache-2.0
// .cube files: Adobe 2013, "Cube LUT Specification" 1.0, and what Resolve adds (Developer/LUT/README.txt of its
// installation): input ranges, a curve before the cube, and video range.
#include "base/AsciiText.h"
#include "base/NumberText.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/tables/DisplayColor.h"
#include "shaders/lib/LibCpp.h"

#include <filament_core/Look.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

namespace filament_core {
namespace {

constexpr size_t kMaxBytes = size_t{ 256 } << 20, kMaxTitle = 250;
constexpr uint32_t kMaxCurve = 65536, kMaxCube = 128;
constexpr float kMaxValue = 1e10f;
constexpr std::string_view kBlank = " \t\r";

std::optional<float> finiteNumber(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    return numberOf(word, -kMaxValue, kMaxValue);
}

/// The words of a line before a comment. Returns how many there are; only the first are kept.
size_t wordsOf(std::string_view line, std::array<std::string_view, 4>& words) {
    size_t count = 0;
    for (size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos && line[at] != '#';) {
        const size_t end = std::min(line.find_first_of(kBlank, at), line.size());
        if (count < words.size()) words[count] = line.substr(at, end - at);
        ++count;
        at = line.find_first_not_of(kBlank, end);
    }
    return count;
}

/// Without its quotes, of either kind, and cut at kMaxTitle bytes, but not within a character.
std::string titleOf(std::string_view text) {
    if (!text.empty() && (text[0] == '"' || text[0] == '\'')) {
        const size_t last = text.rfind(text[0]);
        text = text.substr(1, last == 0 ? text.npos : last - 1);
    }
    size_t length = std::min(text.size(), kMaxTitle);
    while (length < text.size() && length > 0 && (static_cast<uint8_t>(text[length]) & 0xC0) == 0x80) --length;
    std::string title(text.substr(0, length));
    for (char& c : title) c = c == '"' || static_cast<unsigned char>(c) < ' ' ? '\'' : c;
    return title;
}

struct InputRange {
    float3 least{ 0 }, most{ 1 };
};

/// A curve or a cube of a file.
struct CubeTable {
    bool isFull() const { return entries.size() == wanted; }

    uint32_t size = 0;
    size_t wanted = 0; ///< entries
    std::vector<float3> entries;
    std::optional<InputRange> range;
};

/// Video range stores [0, 1] as the codes 64 to 940 of 1023 (ITU-R BT.709).
float3 ofVideoRange(float3 value) {
    return glm::clamp((value * 1023.0f - 64.0f) / 876.0f, float3(-kMaxValue), float3(kMaxValue));
}

constexpr std::array<std::string_view, 9> kKeywords{ "TITLE",
                                                     "LUT_1D_SIZE",
                                                     "LUT_3D_SIZE",
                                                     "DOMAIN_MIN",
                                                     "DOMAIN_MAX",
                                                     "LUT_1D_INPUT_RANGE",
                                                     "LUT_3D_INPUT_RANGE",
                                                     "LUT_IN_VIDEO_RANGE",
                                                     "LUT_OUT_VIDEO_RANGE" };

/// Reads line by line; the first error ends it.
class CubeText {
public:
    CubeText(std::string_view text, std::string_view name) : mText(text), mName(name) {}

    Result<std::shared_ptr<const Look>> read() {
        skipByteOrderMark();
        while (!mText.empty() && !mError) {
            const size_t end = std::min(mText.find_first_of("\r\n"), mText.size());
            ++mLine;
            readLine(mText.substr(0, end));
            mText.remove_prefix(end);
            mText.remove_prefix(mText.starts_with("\r\n") ? 2 : std::min<size_t>(mText.size(), 1));
        }
        if (!mError) checkWhole();
        if (mError) return *mError;
        return std::make_shared<const Look>(look());
    }

private:
    template <class... Args>
    void refuse(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
        if (mError) return;
        mError = fail(code, "{}: line {}: {}", mName, mLine, fmt::format(format, std::forward<Args>(args)...));
    }

    void skipByteOrderMark() {
        if (mText.starts_with("\xEF\xBB\xBF")) mText.remove_prefix(3);
        if (!mText.starts_with("\xFF\xFE") && !mText.starts_with("\xFE\xFF")) return;
        mLine = 1;
        refuse(ErrorCode::Unsupported, "the text is UTF-16; save it as UTF-8");
    }

    void readLine(std::string_view line) {
        std::array<std::string_view, 4> words;
        const size_t count = wordsOf(line, words);
        if (count == 0) return;
        const auto known = std::ranges::find(kKeywords, lowerCase(words[0]), lowerCase);
        const char first = words[0][0];
        const bool isKeyword = (first >= 'A' && first <= 'Z') || first == '_' || known != kKeywords.end();
        if (!isKeyword) return readEntry(words, count);
        const bool isBetweenTables = mCurve.isFull() && mCube.entries.empty();
        if (!isBetweenTables && !(mCurve.entries.empty() && mCube.entries.empty()))
            return refuse(ErrorCode::Corrupt, "'{}' comes after colours; move it before them", printable(words[0]));
        if (known != kKeywords.end()) return readKeyword(*known, line, words, count);
        refuse(ErrorCode::Corrupt, "'{}' is no keyword of .cube files: {}; put # before a line to leave it out",
               printable(words[0]), fmt::join(kKeywords, ", "));
    }

    void readKeyword(std::string_view keyword, std::string_view line, std::array<std::string_view, 4> const& words,
                     size_t count) {
        if (keyword == "TITLE") {
            mTitle = titleOf(withoutBlanks(withoutBlanks(line, kBlank).substr(keyword.size()), kBlank));
            return;
        }
        if (keyword == "LUT_1D_SIZE") return readSize(mCurve, kMaxCurve, words, count);
        if (keyword == "LUT_3D_SIZE") return readSize(mCube, kMaxCube, words, count);
        if (keyword == "DOMAIN_MIN") return readDomain(mDomain.least, words, count);
        if (keyword == "DOMAIN_MAX") return readDomain(mDomain.most, words, count);
        if (keyword == "LUT_1D_INPUT_RANGE") return readRange(mCurve, words, count);
        if (keyword == "LUT_3D_INPUT_RANGE") return readRange(mCube, words, count);
        if (count != 1) return refuse(ErrorCode::Corrupt, "{} has {} values, expected none", keyword, count - 1);
        (keyword == "LUT_IN_VIDEO_RANGE" ? mIsVideoIn : mIsVideoOut) = true;
    }

    void readSize(CubeTable& table, uint32_t most, std::array<std::string_view, 4> const& words, size_t count) {
        if (table.size != 0) return refuse(ErrorCode::Corrupt, "a second {}; keep one of them", printable(words[0]));
        const uint32_t size = count == 2 ? numberOf<uint32_t>(words[1]).value_or(0) : 0;
        if (size < 2 || size > most)
            return refuse(ErrorCode::Unsupported, "{} is '{}', expected a whole number from 2 to {}", words[0],
                          printable(count > 1 ? words[1] : ""), most);
        table.size = size;
        table.wanted = &table == &mCube ? size_t{ size } * size * size : size;
    }

    void readDomain(float3& corner, std::array<std::string_view, 4> const& words, size_t count) {
        if (count != 4) return refuse(ErrorCode::Corrupt, "{} has {} numbers, expected 3", words[0], count - 1);
        for (int c = 0; c < 3; ++c) readNumber(words[static_cast<size_t>(c) + 1], corner[c]);
    }

    void readRange(CubeTable& table, std::array<std::string_view, 4> const& words, size_t count) {
        if (count != 3) return refuse(ErrorCode::Corrupt, "{} has {} numbers, expected 2", words[0], count - 1);
        float least = 0, most = 1;
        readNumber(words[1], least);
        readNumber(words[2], most);
        table.range = InputRange{ float3(least), float3(most) };
    }

    void readNumber(std::string_view word, float& value) {
        const std::optional<float> number = finiteNumber(word);
        if (!number) return refuse(ErrorCode::Corrupt, "'{}' is not a number from -1e10 to 1e10", printable(word));
        value = *number;
    }

    void readEntry(std::array<std::string_view, 4> const& words, size_t count) {
        if (mCurve.wanted + mCube.wanted == 0)
            return refuse(ErrorCode::Corrupt, "'{}' comes before LUT_1D_SIZE or LUT_3D_SIZE", printable(words[0]));
        if (count != 3) return refuse(ErrorCode::Corrupt, "a colour has {} numbers, expected 3", count);
        CubeTable& table = mCurve.isFull() ? mCube : mCurve; // Resolve: the curve comes first
        if (table.isFull())
            return refuse(ErrorCode::Corrupt, "more colours than the {} of its size; remove them",
                          mCurve.wanted + mCube.wanted);
        float3 entry(0);
        for (int c = 0; c < 3; ++c) readNumber(words[static_cast<size_t>(c)], entry[c]);
        table.entries.push_back(entry);
    }

    void checkWhole() {
        const size_t wanted = mCurve.wanted + mCube.wanted, found = mCurve.entries.size() + mCube.entries.size();
        if (wanted == 0) return refuse(ErrorCode::Corrupt, "no LUT_1D_SIZE or LUT_3D_SIZE; it is no .cube file");
        if (found < wanted)
            return refuse(ErrorCode::Corrupt, "the file ends after {} of {} colours; it is truncated", found, wanted);
        resolveRanges();
        for (CubeTable const* table : { &mCurve, &mCube }) {
            if (table->size == 0) continue;
            for (int c = 0; c < 3; ++c) {
                if (!(table->range->least[c] < table->range->most[c]))
                    return refuse(ErrorCode::Corrupt, "DOMAIN_MIN {} is not below DOMAIN_MAX {}",
                                  table->range->least[c], table->range->most[c]);
            }
        }
    }

    /// What the keywords mean for each table. An affine change of inputs or results is exact: both interpolations
    /// commute with it.
    void resolveRanges() {
        const bool hasCurve = mCurve.size != 0, hasCube = mCube.size != 0;
        CubeTable& first = hasCurve ? mCurve : mCube;
        CubeTable& last = hasCube ? mCube : mCurve;
        if (!first.range && !(hasCurve && hasCube)) first.range = (hasCurve ? mCube : mCurve).range;
        if (!first.range) first.range = mDomain;
        if (!last.range) last.range = InputRange{};
        if (mIsVideoIn) first.range = InputRange{ ofVideoRange(first.range->least), ofVideoRange(first.range->most) };
        if (!mIsVideoOut) return;
        for (float3& entry : last.entries) entry = ofVideoRange(entry);
    }

    Look look() {
        Look look{ .title = std::move(mTitle), .isCube = mCube.size != 0, .entries = {} };
        CubeTable& last = look.isCube ? mCube : mCurve;
        look.size = last.size;
        look.domainMin = last.range->least, look.domainMax = last.range->most;
        look.entries = std::move(last.entries);
        if (!look.isCube || mCurve.size == 0) return look;
        look.shaperMin = mCurve.range->least, look.shaperMax = mCurve.range->most;
        look.shaper = std::move(mCurve.entries);
        return look;
    }

    std::string_view mText, mName;
    size_t mLine = 0;
    std::string mTitle;
    CubeTable mCurve, mCube;
    InputRange mDomain;
    bool mIsVideoIn = false, mIsVideoOut = false;
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
    if (!look.shaper.empty()) {
        text += fmt::format("LUT_1D_SIZE {}\nDOMAIN_MIN {}DOMAIN_MAX {}", look.shaper.size(), rowOf(look.shaperMin),
                            rowOf(look.shaperMax));
        text += fmt::format("LUT_3D_SIZE {}\nLUT_3D_INPUT_RANGE {} {}\n", look.size, look.domainMin.x,
                            look.domainMax.x);
    } else {
        text += fmt::format("LUT_{}D_SIZE {}\n", look.isCube ? 3 : 1, look.size);
        text += "DOMAIN_MIN " + rowOf(look.domainMin) + "DOMAIN_MAX " + rowOf(look.domainMax);
    }
    for (float3 const& entry : look.shaper) text += rowOf(entry);
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
