// SPDX-License-Identifier: Apache-2.0
// OpenEXR's DWAA and DWAB, as "Technical Introduction to OpenEXR", section "Data Compression", and the comments of
// OpenEXR's ImfDwaCompressor.cpp (openexr.com) describe them.
//   Rules in the block say by the end of a channel's name how it is stored.
//   Cosine  like JPEG: a curve that spreads values evenly, Y'CbCr if there are three colours, a cosine transform of
//           squares of 8 x 8, whose coefficients are halves. The means of all squares come first, compressed on their
//           own; of the others, runs of zeros are one word each.
//   Runs    exact: the first bytes of all samples, then the second, ..., as run lengths in a zlib stream.
//   Plain   exact: a zlib stream.
#include "base/AsciiText.h"
#include "base/math/Elementary.h"
#include "base/math/Half.h"
#include "filament_core/assets/image/ExrBlock.h"
#include "filament_core/assets/image/HdrDecoders.h"
#include "filament_core/assets/image/Zlib.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>

namespace filament_core::assets {
namespace {

constexpr size_t kSide = 8, kSquare = kSide * kSide;
constexpr size_t kNoChannel = ~size_t{ 0 };

enum class Scheme : uint8_t { Plain, Cosine, Runs, Count };
enum class WordCoding : uint64_t { Huffman, Zlib };

struct Rule {
    std::string suffix; ///< what follows the last '.' of a channel's name, or all of it
    Scheme scheme = Scheme::Plain;
    ExrType type = ExrType::Half;
    std::optional<size_t> color{}; ///< red, green, blue: those of a layer are stored together
    bool ignoresCase = false;      ///< then the suffix is in lower case
};

/// The numbers at the start of a block, in this order.
struct Sizes {
    uint64_t version, plain, packedPlain, packedWords, packedMeans, packedRuns, runs, runsRaw, words, means;
    WordCoding wordCoding;
};

/// Of blocks that list none.
std::vector<Rule> rulesOfVersion1() {
    std::vector<Rule> rules;
    for (const ExrType type : { ExrType::Half, ExrType::Float }) {
        constexpr std::array<std::pair<const char*, size_t>, 7> kColors{
            { { "r", 0 }, { "red", 0 }, { "g", 1 }, { "grn", 1 }, { "green", 1 }, { "b", 2 }, { "blu", 2 } }
        };
        for (auto const& [name, color] : kColors) rules.push_back({ name, Scheme::Cosine, type, color, true });
        rules.push_back({ "blue", Scheme::Cosine, type, 2, true });
        for (const char* name : { "y", "by", "ry" }) rules.push_back({ name, Scheme::Cosine, type, {}, true });
    }
    for (const ExrType type : { ExrType::Uint, ExrType::Half, ExrType::Float })
        rules.push_back({ "a", Scheme::Runs, type, {}, true });
    return rules;
}

std::optional<std::vector<Rule>> readRules(ByteCursor& cursor) {
    const auto size = cursor.read<uint16_t>(); // its own two bytes are part of it
    const auto bytes = size && *size >= 2 ? cursor.take(*size - size_t{ 2 }) : std::nullopt;
    if (!bytes) return std::nullopt;
    std::vector<Rule> rules;
    for (ByteCursor at(*bytes); at.remaining() > 0;) {
        const auto suffix = at.readUntil('\0', 255);
        const auto flags = suffix ? at.read<uint8_t>() : std::nullopt;
        const auto type = flags ? at.read<uint8_t>() : std::nullopt;
        if (!type) return std::nullopt;
        const auto scheme = static_cast<Scheme>(*flags >> 2 & 3);
        const unsigned color = *flags >> 4;
        if (scheme >= Scheme::Count || color > 3 || *type > static_cast<uint8_t>(ExrType::Float)) return std::nullopt;
        Rule& rule = rules.emplace_back(
                Rule{ std::string(*suffix), scheme, static_cast<ExrType>(*type), {}, (*flags & 1) != 0 });
        if (color > 0) rule.color = color - 1;
    }
    return rules;
}

/// How each channel is stored, and which are stored as three colours.
struct Plan {
    std::vector<Scheme> schemes;               ///< by channel
    std::vector<std::array<size_t, 3>> colors; ///< channels of red, green and blue
    std::vector<size_t> single;                ///< those with a cosine transform of their own
};

Plan planFor(ExrBlock const& block, std::vector<Rule> const& rules) {
    Plan plan{ std::vector<Scheme>(block.channels.size(), Scheme::Plain), {}, {} };
    std::map<std::string, std::array<size_t, 3>> layers;
    for (size_t i = 0; i < block.channels.size(); ++i) {
        const std::string_view name = block.channels[i].name;
        const size_t dot = name.rfind('.');
        const std::string_view suffix = dot == std::string_view::npos ? name : name.substr(dot + 1);
        const std::string layer(name.substr(0, name.size() - suffix.size()));
        for (Rule const& rule : rules) {
            if (rule.type != block.channels[i].type) continue;
            if (rule.suffix != (rule.ignoresCase ? lowerCase(suffix) : suffix)) continue;
            plan.schemes[i] = rule.scheme;
            if (!rule.color) continue;
            auto& colors = layers.try_emplace(layer, std::array{ kNoChannel, kNoChannel, kNoChannel }).first->second;
            colors[*rule.color] = i;
        }
    }
    std::vector<bool> isInLayer(block.channels.size());
    for (auto const& [layer, colors] : layers) {
        if (std::ranges::count(colors, kNoChannel) > 0) continue;
        plan.colors.push_back(colors);
        for (const size_t channel : colors) isInLayer[channel] = true;
    }
    for (size_t i = 0; i < block.channels.size(); ++i)
        if (plan.schemes[i] == Scheme::Cosine && !isInLayer[i]) plan.single.push_back(i);
    return plan;
}

/// The sum of bytes of the channels of a scheme.
size_t bytesOf(ExrBlock const& block, Plan const& plan, Scheme scheme) {
    size_t bytes = 0;
    for (size_t i = 0; i < block.channels.size(); ++i)
        if (plan.schemes[i] == scheme) bytes += block.channels[i].bytes() * block.width * block.rows;
    return bytes;
}

size_t columnOf(ExrBlock const& block, size_t channel) {
    size_t column = 0;
    for (size_t i = 0; i < channel; ++i) column += block.channels[i].bytes() * block.width;
    return column;
}

// ---------------------------------------------------------------------------------------------- cosine transform

/// kBasis[u][x]: the orthonormal cosine of frequency u at sample x.
std::array<std::array<float, kSide>, kSide> makeBasis() {
    constexpr float kCosines[] = { 1,           0.98078528f, 0.92387953f,
                                   0.83146961f, 0.70710678f, 0.55557023f,
                                   0.38268343f, 0.19509032f, 0 }; // of multiples of pi / 16
    std::array<std::array<float, kSide>, kSide> basis;
    for (size_t u = 0; u < kSide; ++u) {
        for (size_t x = 0; x < kSide; ++x) {
            const size_t turn = (2 * x + 1) * u % 32, half = turn > 16 ? 32 - turn : turn;
            const float cosine = half > 8 ? -kCosines[16 - half] : kCosines[half];
            basis[u][x] = (u == 0 ? kCosines[4] : cosine) * 0.5f;
        }
    }
    return basis;
}

using Square = std::array<float, kSquare>;

/// Columns, then rows, each a sum in the order of frequencies.
Square inverseCosines(Square const& frequencies) {
    static const auto basis = makeBasis();
    Square columns{}, samples{};
    for (size_t v = 0; v < kSide; ++v)
        for (size_t y = 0; y < kSide; ++y)
            for (size_t u = 0; u < kSide; ++u) columns[y * kSide + u] += frequencies[v * kSide + u] * basis[v][y];
    for (size_t y = 0; y < kSide; ++y)
        for (size_t u = 0; u < kSide; ++u)
            for (size_t x = 0; x < kSide; ++x) samples[y * kSide + x] += columns[y * kSide + u] * basis[u][x];
    return samples;
}

/// Where the n-th coefficient belongs: along diagonals, from low frequencies to high ones, as in JPEG.
std::array<size_t, kSquare> makeZigzag() {
    std::array<size_t, kSquare> order;
    size_t n = 0;
    for (size_t sum = 0; sum <= 2 * (kSide - 1); ++sum) {
        for (size_t i = 0; i <= sum; ++i) {
            const size_t y = sum % 2 == 0 ? sum - i : i, x = sum - y;
            if (x < kSide && y < kSide) order[n++] = y * kSide + x;
        }
    }
    return order;
}

/// Of Rec. 709's Y'CbCr; the constants are part of the format.
void convertToColors(std::array<Square, 3>& planes) {
    for (size_t i = 0; i < kSquare; ++i) {
        const float luma = planes[0][i], blue = planes[1][i], red = planes[2][i];
        planes[0][i] = luma + 1.5747f * red;
        planes[1][i] = luma - 0.1873f * blue - 0.4682f * red;
        planes[2][i] = luma + 1.8556f * blue;
    }
}

/// From values that are spread evenly to light, by half: a power of 2.2 up to 1, beyond it an exponential that
/// continues it.
std::vector<uint16_t> makeCurve() {
    std::vector<uint16_t> curve(1 << 16);
    const double base = elementary::pow(2.7182818, 2.2);
    for (uint32_t bits = 0; bits < curve.size(); ++bits) {
        const double value = floatFromHalf(static_cast<uint16_t>(bits)), size = std::abs(value);
        if (!std::isfinite(value)) continue;
        const double light = size <= 1 ? elementary::pow(size, 2.2) : elementary::pow(base, size - 1);
        curve[bits] = halfFromFloat(static_cast<float>(std::copysign(light, value)));
    }
    return curve;
}

class CosineChannels {
public:
    CosineChannels(ExrBlock const& block, std::span<const uint16_t> means, std::span<const uint16_t> words)
            : mBlock(block), mMeans(means), mWords(words) {}

    static size_t squares(ExrBlock const& block) {
        return (block.width + kSide - 1) / kSide * ((block.rows + kSide - 1) / kSide);
    }

    /// One channel, or three colours. False: words are missing.
    template <size_t N>
    bool expand(std::array<size_t, N> const& channels, std::span<std::byte> out) {
        const size_t count = squares(mBlock), across = (mBlock.width + kSide - 1) / kSide;
        const auto means = mMeans.first(N * count);
        mMeans = mMeans.subspan(N * count);
        for (size_t square = 0; square < count; ++square) {
            std::array<Square, N> planes;
            for (size_t i = 0; i < N; ++i) {
                if (!readCoefficients(means[i * count + square], planes[i])) return false;
                planes[i] = inverseCosines(planes[i]);
            }
            if constexpr (N == 3) convertToColors(planes);
            for (size_t i = 0; i < N; ++i)
                write(planes[i], channels[i], N == 3, square % across * kSide, square / across * kSide, out);
        }
        return true;
    }

private:
    bool readCoefficients(uint16_t mean, Square& frequencies) {
        static const auto zigzag = makeZigzag();
        constexpr uint16_t kEnd = 0xFF00; // and words above: as many zeros as their low byte says
        frequencies.fill(0);
        frequencies[0] = floatFromHalf(mean);
        for (size_t n = 1; n < kSquare;) {
            if (mWords.empty()) return false;
            const uint16_t word = mWords.front();
            mWords = mWords.subspan(1);
            if (word == kEnd) break;
            if (word > kEnd)
                n += word - kEnd;
            else
                frequencies[zigzag[n++]] = floatFromHalf(word);
        }
        return true;
    }

    void write(Square const& samples, size_t channel, bool isColor, size_t left, size_t top,
               std::span<std::byte> out) const {
        static const std::vector<uint16_t> curve = makeCurve();
        ExrChannel const& as = mBlock.channels[channel];
        const size_t pitch = mBlock.rowBytes(), column = columnOf(mBlock, channel);
        for (size_t y = 0; y < std::min(kSide, mBlock.rows - top); ++y) {
            for (size_t x = 0; x < std::min(kSide, mBlock.width - left); ++x) {
                uint16_t half = halfFromFloat(samples[y * kSide + x]);
                if (isColor || !as.isPerceptual) half = curve[half];
                std::byte* const at = &out[(top + y) * pitch + column + (left + x) * as.bytes()];
                const float value = floatFromHalf(half);
                if (as.type == ExrType::Half)
                    std::memcpy(at, &half, sizeof half);
                else
                    std::memcpy(at, &value, sizeof value);
            }
        }
    }

    ExrBlock const& mBlock;
    std::span<const uint16_t> mMeans, mWords; // that no channel has taken
};

// ---------------------------------------------------------------------------------------------- the parts of a block

std::optional<std::vector<uint16_t>> readWords(std::span<const std::byte> packed, size_t count, WordCoding coding) {
    std::vector<uint16_t> words(count);
    if (count == 0) return words;
    const bool isRead = coding == WordCoding::Huffman ? expandHuffman(packed, words)
                                                      : inflateZlib(packed, std::as_writable_bytes(std::span(words)));
    return isRead ? std::optional(std::move(words)) : std::nullopt;
}

std::optional<std::vector<uint16_t>> readMeans(std::span<const std::byte> packed, size_t count) {
    std::vector<uint16_t> means(count);
    const auto bytes = std::as_writable_bytes(std::span(means));
    if (count == 0) return means;
    if (!inflateZlib(packed, bytes)) return std::nullopt;
    undoPredictor(bytes);
    return means;
}

bool expandRunChannels(ExrBlock const& block, Plan const& plan, Sizes const& sizes, std::span<const std::byte> packed,
                       std::span<std::byte> out) {
    const size_t bytes = bytesOf(block, plan, Scheme::Runs), samples = block.width * block.rows;
    if (bytes == 0) return true;
    constexpr uint64_t kWorst = 2; // bytes that run lengths may take for one
    if (sizes.runsRaw != bytes || sizes.runs > kWorst * bytes) return false;
    std::vector<std::byte> runs(sizes.runs), planes(bytes);
    if (!inflateZlib(packed, runs) || !expandRuns(runs, planes)) return false;
    const size_t pitch = block.rowBytes();
    size_t plane = 0;
    for (size_t i = 0; i < block.channels.size(); ++i) {
        if (plan.schemes[i] != Scheme::Runs) continue;
        const size_t size = block.channels[i].bytes(), column = columnOf(block, i);
        for (size_t byte = 0; byte < size; ++byte, plane += samples)
            for (size_t s = 0; s < samples; ++s)
                out[s / block.width * pitch + column + s % block.width * size + byte] = planes[plane + s];
    }
    return true;
}

bool expandPlainChannels(ExrBlock const& block, Plan const& plan, Sizes const& sizes, std::span<const std::byte> packed,
                         std::span<std::byte> out) {
    const size_t bytes = bytesOf(block, plan, Scheme::Plain);
    if (bytes == 0) return true;
    std::vector<std::byte> rows(bytes);
    if (sizes.plain != bytes || !inflateZlib(packed, rows)) return false;
    size_t at = 0;
    for (size_t i = 0; i < block.channels.size(); ++i) {
        if (plan.schemes[i] != Scheme::Plain) continue;
        const size_t width = block.channels[i].bytes() * block.width, column = columnOf(block, i);
        for (size_t y = 0; y < block.rows; ++y, at += width)
            std::memcpy(&out[y * block.rowBytes() + column], &rows[at], width);
    }
    return true;
}

bool expandCosineChannels(ExrBlock const& block, Plan const& plan, Sizes const& sizes,
                          std::span<const std::byte> packedMeans, std::span<const std::byte> packedWords,
                          std::span<std::byte> out) {
    const size_t squares = CosineChannels::squares(block) * (plan.colors.size() * 3 + plan.single.size());
    if (sizes.means != squares || sizes.words > squares * kSquare) return false;
    const auto means = readMeans(packedMeans, squares);
    const auto words = readWords(packedWords, static_cast<size_t>(sizes.words), sizes.wordCoding);
    if (!means || !words) return false;
    CosineChannels channels(block, *means, *words);
    for (auto const& colors : plan.colors)
        if (!channels.expand(colors, out)) return false;
    for (const size_t channel : plan.single)
        if (!channels.expand(std::array{ channel }, out)) return false;
    return true;
}

/// Integers have no cosine transform, whatever the rules of a damaged block say.
bool isPossible(ExrBlock const& block, Plan const& plan) {
    const auto isCosineOfIntegers = [&](size_t channel) { return block.channels[channel].type == ExrType::Uint; };
    return std::ranges::none_of(plan.single, isCosineOfIntegers) &&
           std::ranges::none_of(plan.colors, [&](auto const& colors) {
               return std::ranges::any_of(colors, [&](size_t channel) {
                   return isCosineOfIntegers(channel) || plan.schemes[channel] != Scheme::Cosine;
               });
           });
}

} // namespace

bool expandDwa(ExrBlock const& block, std::span<const std::byte> packed, std::span<std::byte> out) {
    ByteCursor cursor(packed);
    const auto sizes = cursor.read<Sizes>();
    if (!sizes || sizes->version > 2 || sizes->wordCoding > WordCoding::Zlib) return false;
    const auto rules = sizes->version == 2 ? readRules(cursor) : std::optional(rulesOfVersion1());
    const auto plain = rules ? cursor.take(sizes->packedPlain) : std::nullopt;
    const auto words = plain ? cursor.take(sizes->packedWords) : std::nullopt;
    const auto means = words ? cursor.take(sizes->packedMeans) : std::nullopt;
    const auto runs = means ? cursor.take(sizes->packedRuns) : std::nullopt;
    if (!runs) return false;
    const Plan plan = planFor(block, *rules);
    return isPossible(block, plan) && expandPlainChannels(block, plan, *sizes, *plain, out) &&
           expandRunChannels(block, plan, *sizes, *runs, out) &&
           expandCosineChannels(block, plan, *sizes, *means, *words, out);
}

} // namespace filament_core::assets
