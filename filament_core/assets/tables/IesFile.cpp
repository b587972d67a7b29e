// SPDX-License-Identifier: Apache-2.0
// The format is that of LM-63; Ashdown 1999, "Parsing the IESNA LM-63 Photometric Data File", for its older editions.
#include "filament_core/assets/tables/IesFile.h"

#include "base/AsciiText.h"
#include "base/NumberText.h"
#include "base/math/Elementary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace filament_core::assets {
namespace {

constexpr size_t kMaxIesBytes = size_t{ 16 } << 20, kMaxAngles = 8192, kMaxCandelas = size_t{ 1 } << 20;
constexpr double kMaxCandela = 1e9, kAngleSlack = 1e-3;
constexpr std::string_view kIesBlank = " \t,\f\v";

/// Lines and numbers of a file, and the first error.
class IesText {
public:
    IesText(std::string_view text, std::string_view name) : mText(text), mName(name) {}

    bool ok() const { return !mError; }
    Error error() const { return *mError; }
    bool atEnd() const { return mAt == mText.size(); }

    /// The next line without its end: any of \n, \r\n, \r.
    std::string_view line() {
        const size_t end = std::min(mText.find_first_of("\r\n", mAt), mText.size());
        const std::string_view found = mText.substr(mAt, end - mAt);
        mAt = end;
        skipLineEnd();
        return found;
    }

    template <class... Args>
    void refuse(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
        if (mError) return;
        mError = fail(code, "{}: line {}: {}", mName, mLine, fmt::format(format, std::forward<Args>(args)...));
    }

    /// A finite number of [low, high]; numbers may lie on any lines. `low` after an error.
    double number(const char* what, double low, double high) {
        if (!ok()) return low;
        const std::string_view word = nextWord();
        if (word.empty()) {
            refuse(ErrorCode::Corrupt, "the file ends before {}; it is truncated", what);
            return low;
        }
        const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
        const std::optional<double> value = numberOf<double>(digits);
        if (!value || !(*value >= low && *value <= high)) {
            refuse(ErrorCode::Corrupt, "{} is '{}', expected a number from {} to {}", what, printable(word), low, high);
            return low;
        }
        return *value;
    }

    size_t count(const char* what, size_t low, size_t high) {
        const double value = number(what, static_cast<double>(low), static_cast<double>(high));
        if (value != std::floor(value)) refuse(ErrorCode::Corrupt, "{} is {}, expected a whole number", what, value);
        return static_cast<size_t>(value);
    }

    /// `n` numbers, each above the one before.
    std::vector<double> ascending(const char* what, size_t n, double low, double high) {
        std::vector<double> values;
        for (size_t i = 0; i < n && ok(); ++i) {
            values.push_back(number(what, low, high));
            if (i > 0 && values[i] <= values[i - 1]) {
                refuse(ErrorCode::Corrupt, "{} {} of {} is {}, which is not above the {} before it", what, i + 1, n,
                       values[i], values[i - 1]);
            }
        }
        return values;
    }

private:
    std::string_view nextWord() {
        for (;;) {
            mAt = std::min(mText.find_first_not_of(kIesBlank, mAt), mText.size());
            if (mAt == mText.size() || (mText[mAt] != '\r' && mText[mAt] != '\n')) break;
            skipLineEnd();
        }
        const size_t end = std::min(mText.find_first_of(" \t,\f\v\r\n", mAt), mText.size());
        const std::string_view word = mText.substr(mAt, end - mAt);
        mAt = end;
        return word;
    }

    void skipLineEnd() {
        if (mAt == mText.size()) return;
        if (mText[mAt] == '\r' && mAt + 1 < mText.size() && mText[mAt + 1] == '\n') ++mAt;
        ++mAt;
        ++mLine;
    }

    std::string_view mText, mName;
    size_t mAt = 0, mLine = 1;
    std::optional<Error> mError;
};

std::string_view trimmed(std::string_view text) { return withoutBlanks(text, " \t"); }

/// Whether the second ballast factor of files with this first line counts: in the editions of 1986, which has no line
/// of its own, and 1991, "IESNA91". Later ones begin with "IESNA:LM-63-1995" or "IES:LM-63-2019"; programs vary case,
/// blanks and punctuation.
bool isOldEdition(std::string_view line) {
    std::string letters = lowerCase(line);
    std::erase_if(letters, [](char c) { return (c < 'a' || c > 'z') && (c < '0' || c > '9'); });
    for (const std::string_view name : { "iesnalm63", "ieslm63" }) {
        if (!letters.starts_with(name)) continue;
        const std::string_view year = std::string_view(letters).substr(name.size());
        return year.starts_with("1986") || year.starts_with("1991");
    }
    return true;
}

/// What follows "TILT=", if the line is of this form.
std::optional<std::string> tiltOf(std::string_view line) {
    if (!lowerCase(line.substr(0, 4)).starts_with("tilt")) return std::nullopt;
    const std::string_view rest = trimmed(line.substr(4));
    if (!rest.starts_with('=')) return std::nullopt;
    return std::string(trimmed(rest.substr(1)));
}

/// Up to TILT=...; returns what follows it. `isOld`: editions whose second ballast factor counts.
std::string readHeader(IesText& text, bool& isOld) {
    std::string_view line = trimmed(text.line());
    while (line.empty() && !text.atEnd()) line = trimmed(text.line());
    isOld = isOldEdition(line);
    for (;; line = trimmed(text.line())) {
        if (const std::optional<std::string> tilt = tiltOf(line)) return *tilt;
        if (!text.atEnd()) continue;
        text.refuse(ErrorCode::Corrupt, "there is no line 'TILT=': this is not a photometric file of LM-63");
        return {};
    }
}

/// The factor of a luminaire that is not tilted.
double readTilt(IesText& text, std::string const& tilt) {
    const std::string word = lowerCase(tilt);
    if (word == "none") return 1;
    if (word.empty()) text.refuse(ErrorCode::Corrupt, "TILT= names nothing; expected TILT=NONE or TILT=INCLUDE");
    if (word != "include") {
        text.refuse(ErrorCode::Unsupported, "TILT={} names another file; put its data into this one with TILT=INCLUDE",
                    printable(tilt));
        return 1;
    }
    text.number("the lamp's geometry", 1, 3);
    const size_t pairs = text.count("the number of tilt angles", 1, kMaxAngles);
    const std::vector<double> angles = text.ascending("tilt angle", pairs, -360, 360);
    double factor = 1;
    for (size_t i = 0; i < pairs && text.ok(); ++i) {
        const double value = text.number("a tilt factor", 0, 1e6);
        if (text.ok() && angles[i] == 0) factor = value;
    }
    return factor;
}

struct IesNumbers {
    double factor = 1;
    size_t verticals = 0, horizontals = 0;
};

IesNumbers readNumbers(IesText& text, IesFile& file, bool isOld) {
    IesNumbers numbers;
    text.number("the number of lamps", 0, 1e6);
    text.number("the lumens per lamp", -1, 1e12);
    numbers.factor = text.number("the candela multiplier", 0, 1e9);
    numbers.verticals = text.count("the number of vertical angles", 2, kMaxAngles);
    numbers.horizontals = text.count("the number of horizontal angles", 1, kMaxAngles);
    const size_t type = text.count("the photometric type", 1, 3);
    file.type = type == 1 ? IesType::C : type == 2 ? IesType::B : IesType::A;
    text.count("the units type", 1, 2);
    for (const char* side : { "the width", "the length", "the height" }) text.number(side, -1e6, 1e6);
    numbers.factor *= text.number("the ballast factor", 0, 1e6);
    const double second = text.number("the field behind the ballast factor", -1e9, 1e9);
    if (isOld && second < 0) text.refuse(ErrorCode::Corrupt, "the ballast-lamp factor is {}, expected >= 0", second);
    if (isOld) numbers.factor *= second; // later editions keep the field for other uses
    text.number("the input watts", 0, 1e12);
    if (text.ok() && numbers.verticals * numbers.horizontals > kMaxCandelas) {
        text.refuse(ErrorCode::Corrupt, "{} x {} candelas are more than {}", numbers.verticals, numbers.horizontals,
                    kMaxCandelas);
    }
    return numbers;
}

bool isNear(double a, double b) { return std::abs(a - b) <= kAngleSlack; }

void checkEnds(IesText& text, IesFile const& file) {
    const double first = file.horizontal.front(), last = file.horizontal.back();
    const bool isSingle = file.horizontal.size() == 1;
    if (file.type != IesType::C) {
        if (isSingle || ((isNear(first, 0) || first < 0) && last > 0)) return;
        return text.refuse(ErrorCode::Unsupported,
                           "horizontal angles from {} to {} are no symmetry of types A and B: expected one alone, 0 to "
                           "90, or -90 to 90",
                           first, last);
    }
    const bool isQuarterOrHalf = isNear(first, 0) && (isNear(last, 90) || isNear(last, 180));
    const bool isSideways = isNear(first, 90) && isNear(last, 270); // LM-63-1995
    const bool isWhole = isNear(first, 0) && last > 180 + kAngleSlack;
    if (isSingle || isQuarterOrHalf || isSideways || isWhole) return;
    text.refuse(
            ErrorCode::Unsupported,
            "horizontal angles from {} to {} are no symmetry of type C: expected 0 alone, or 0 to 90, 180 or 360, or "
            "90 to 270",
            first, last);
}

void readCandelas(IesText& text, IesFile& file, double factor) {
    const size_t count = file.vertical.size() * file.horizontal.size();
    for (size_t i = 0; i < count && text.ok(); ++i) {
        const double candela = text.number("a candela value", 0, 1e12) * factor;
        if (!(candela <= kMaxCandela)) {
            text.refuse(ErrorCode::Corrupt, "a candela value times its factors is {}, more than {}", candela,
                        kMaxCandela);
        }
        file.candelas.push_back(static_cast<float>(candela));
        file.peak = std::max(file.peak, file.candelas.back());
    }
    if (text.ok() && !(file.peak > 0)) text.refuse(ErrorCode::Corrupt, "all candelas are zero: the luminaire is dark");
}

// ---- evaluation

constexpr double kDegrees = 180 / std::numbers::pi;

/// Where `angle` lies between two entries.
struct Span {
    size_t first = 0, next = 0;
    double weight = 0; ///< of `next`
};

std::optional<Span> find(std::vector<double> const& angles, double angle) {
    if (!(angle >= angles.front() - 1e-9 && angle <= angles.back() + 1e-9)) return std::nullopt;
    const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
    const auto next = std::min<size_t>(static_cast<size_t>(above - angles.begin()), angles.size() - 1);
    const size_t first = next == 0 ? 0 : next - 1;
    if (first == next) return Span{ first, next, 0 };
    return Span{ first, next, std::clamp((angle - angles[first]) / (angles[next] - angles[first]), 0.0, 1.0) };
}

/// Types A and B: files with angles from 0 on are symmetric.
std::optional<Span> findSideways(std::vector<double> const& angles, double angle) {
    return find(angles, isNear(angles.front(), 0) ? std::abs(angle) : angle);
}

/// Type C; `angle` of [0, 360).
std::optional<Span> findAround(std::vector<double> const& angles, double angle) {
    if (angles.size() == 1) return Span{};
    const double last = angles.back();
    if (isNear(angles.front(), 90) && isNear(last, 270)) { // mirrored at the plane of 90 and 270 degrees
        if (angle < 90) return find(angles, 180 - angle);
        return find(angles, angle > 270 ? 540 - angle : angle);
    }
    if (isNear(last, 180) || isNear(last, 90)) {
        double folded = angle > 180 ? 360 - angle : angle;
        if (isNear(last, 90) && folded > 90) folded = 180 - folded;
        return find(angles, std::min(folded, last));
    }
    if (angle <= last) return find(angles, angle);
    // From the last angle on to the first, 360 degrees.
    return Span{ angles.size() - 1, 0, std::clamp((angle - last) / (360 - last + angles.front()), 0.0, 1.0) };
}

struct IesAngles {
    double vertical = 0, horizontal = 0;
};

IesAngles anglesOf(IesType type, double3 const& d) {
    const double forward = -d.z;
    if (type == IesType::C) {
        const double around = elementary::atan2(d.y, d.x) * kDegrees;
        return { elementary::atan2(elementary::hypot(d.x, d.y), forward) * kDegrees,
                 around < 0 ? around + 360 : around };
    }
    if (type == IesType::A)
        return { elementary::atan2(d.x, elementary::hypot(d.y, forward)) * kDegrees,
                 elementary::atan2(-d.y, forward) * kDegrees };
    return { elementary::atan2(d.x, forward) * kDegrees,
             elementary::atan2(-d.y, elementary::hypot(d.x, forward)) * kDegrees };
}

/// Types A and B with one horizontal angle measured one plane through the axis, in which angles mean what those of type
/// C do: the luminaire is taken as one of revolution. Below zero lies the other half of the plane.
void turnAroundAxis(IesFile& file) {
    const std::vector<double> angles = std::exchange(file.vertical, {});
    const std::vector<float> candelas = std::exchange(file.candelas, {});
    for (const double angle : angles) file.vertical.push_back(std::abs(angle));
    if (angles.front() < 0 && angles.back() > 0) file.vertical.push_back(0);
    std::ranges::sort(file.vertical);
    const auto last = std::unique(file.vertical.begin(), file.vertical.end());
    file.vertical.erase(last, file.vertical.end());
    file.type = IesType::C;
    file.horizontal = angles.front() < 0 ? std::vector<double>{ 0, 180 } : std::vector<double>{ 0 };
    for (const double side : { 1.0, -1.0 }) {
        if (side < 0 && file.horizontal.size() == 1) break;
        for (const double angle : file.vertical) {
            const std::optional<Span> at = find(angles, side * angle);
            const auto candela = [&](size_t i) { return static_cast<double>(candelas[i]); };
            const double value = at ? candela(at->first) + (candela(at->next) - candela(at->first)) * at->weight : 0.0;
            file.candelas.push_back(static_cast<float>(value));
        }
    }
}

} // namespace

double IesFile::candelasAt(double3 const& direction) const {
    const IesAngles angles = anglesOf(type, direction);
    const std::optional<Span> down = find(vertical, angles.vertical);
    const std::optional<Span> around = type == IesType::C ? findAround(horizontal, angles.horizontal)
                                                          : findSideways(horizontal, angles.horizontal);
    if (!down || !around) return 0;
    const auto column = [&](size_t plane) {
        const double a = static_cast<double>(candelas[plane * vertical.size() + down->first]);
        const double b = static_cast<double>(candelas[plane * vertical.size() + down->next]);
        return a + (b - a) * down->weight;
    };
    const double first = column(around->first);
    return first + (column(around->next) - first) * around->weight;
}

Result<IesFile> readIes(std::span<const std::byte> bytes, std::string_view name) {
    if (bytes.size() > kMaxIesBytes)
        return fail(ErrorCode::Unsupported, "{}: {} bytes are more than {} MiB", name, bytes.size(),
                    kMaxIesBytes >> 20);
    std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3); // a byte order mark
    IesText text(content, name);
    IesFile file;
    bool isOld = false;
    const std::string tilt = readHeader(text, isOld);
    double factor = text.ok() ? readTilt(text, tilt) : 1;
    const IesNumbers numbers = readNumbers(text, file, isOld);
    factor *= numbers.factor;
    const double least = file.type == IesType::C ? 0 : -90, most = file.type == IesType::C ? 180 : 90;
    file.vertical = text.ascending("vertical angle", numbers.verticals, least, most);
    const double widest = file.type == IesType::C ? 360 : 90;
    file.horizontal = text.ascending("horizontal angle", numbers.horizontals, least, widest);
    if (text.ok()) checkEnds(text, file);
    if (text.ok()) readCandelas(text, file, factor);
    if (!text.ok()) return text.error();
    if (file.type != IesType::C && file.horizontal.size() == 1) turnAroundAxis(file);
    return file;
}

} // namespace filament_core::assets
