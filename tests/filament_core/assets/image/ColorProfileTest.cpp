// SPDX-License-Identifier: Apache-2.0
// What PNG, JPEG, WebP and AVIF files say of their colours: nothing of what is sRGB, and a warning of everything else.
#include "filament_core/assets/image/ColorProfile.h"

#include "base/Log.h"
#include "base/math/ColorSpaces.h"
#include "base/math/Elementary.h"
#include "filament_core/assets/image/PictureDecoder.h"
#include "filament_core/assets/image/PngChunks.h"
#include "filament_core/assets/image/Zlib.h"
#include "tests/filament_core/assets/image/AvifFile.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <gmock/gmock.h>

#include <array>
#include <string>

namespace filament_core::assets {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using ProfileBytes = std::vector<std::byte>;

constexpr Chromaticities kDisplayP3{ { 0.68, 0.32 }, { 0.265, 0.69 }, { 0.15, 0.06 }, { 0.3127, 0.329 } };
constexpr Chromaticities kAdobeRgb{ { 0.64, 0.33 }, { 0.21, 0.71 }, { 0.15, 0.06 }, { 0.3127, 0.329 } };
constexpr double2 kD50{ 0.3457, 0.3585 };

void put(ProfileBytes& to, uint32_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        to.push_back(static_cast<std::byte>(value >> shift & 0xFF));
}
void put(ProfileBytes& to, std::string_view text) {
    for (const char c : text) to.push_back(static_cast<std::byte>(c));
}
void putFixed(ProfileBytes& to, double value) {
    put(to, static_cast<uint32_t>(static_cast<int32_t>(value * 65536 + (value < 0 ? -0.5 : 0.5))), 4);
}

enum class Curve { Parametric, Table, Gamma22, Gamma18, Linear };

ProfileBytes curveTag(Curve curve) {
    ProfileBytes tag;
    put(tag, curve == Curve::Parametric ? "para" : "curv");
    put(tag, 0, 4);
    if (curve == Curve::Parametric) { // of sRGB, ICC.1 table 68, function 3
        put(tag, 3, 2), put(tag, 0, 2);
        for (const double value : { 2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045 }) putFixed(tag, value);
    } else if (curve == Curve::Table) {
        put(tag, 1024, 4);
        for (uint32_t i = 0; i < 1024; ++i) {
            const double x = i / 1023.0;
            const double light = x <= 0.04045 ? x / 12.92 : elementary::pow((x + 0.055) / 1.055, 2.4);
            put(tag, static_cast<uint32_t>(light * 65535 + 0.5), 2);
        }
    } else {
        put(tag, curve == Curve::Linear ? 0 : 1, 4);
        if (curve != Curve::Linear)
            put(tag, static_cast<uint32_t>((curve == Curve::Gamma22 ? 2.2 : 1.8) * 256 + 0.5), 2);
    }
    return tag;
}

ProfileBytes nameTag(std::string_view name, bool isVersion4) {
    ProfileBytes tag;
    put(tag, isVersion4 ? "mluc" : "desc");
    put(tag, 0, 4);
    if (isVersion4) {
        put(tag, 1, 4), put(tag, 12, 4), put(tag, "enUS"), put(tag, static_cast<uint32_t>(2 * name.size()), 4),
                put(tag, 28, 4);
        for (const char c : name) put(tag, static_cast<uint32_t>(c), 2);
    } else {
        put(tag, static_cast<uint32_t>(name.size() + 1), 4), put(tag, name), put(tag, 0, 1);
    }
    return tag;
}

struct Profile {
    std::string_view name = "sRGB", space = "RGB ";
    Chromaticities primaries = kRec709Chromaticities;
    Curve curve = Curve::Parametric;
    bool isVersion4 = false, isOfTables = false;

    ProfileBytes bytes() const {
        std::vector<std::pair<std::string, ProfileBytes>> tags{ { "desc", nameTag(name, isVersion4) } };
        const double3x3 xyz = whiteAdaptation(primaries.white, kD50) * xyzFromRgb(primaries);
        for (int c = 0; c < 3 && !isOfTables; ++c) {
            const std::string component(1, "rgb"[c]);
            ProfileBytes tag;
            put(tag, "XYZ "), put(tag, 0, 4);
            for (int i = 0; i < 3; ++i) putFixed(tag, xyz[c][i]);
            tags.emplace_back(component + "XYZ", tag);
            tags.emplace_back(component + "TRC", curveTag(curve));
        }
        tags.emplace_back("kTRC", curveTag(curve));
        ProfileBytes file;
        const auto putZeros = [&](int words) {
            for (int i = 0; i < words; ++i) put(file, 0, 4);
        };
        putZeros(4), put(file, space), putZeros(4), put(file, "acsp"), putZeros(22);
        put(file, static_cast<uint32_t>(tags.size()), 4);
        size_t at = 132 + 12 * tags.size();
        for (auto const& [tagName, tag] : tags) {
            put(file, tagName), put(file, static_cast<uint32_t>(at), 4),
                    put(file, static_cast<uint32_t>(tag.size()), 4);
            at += tag.size();
        }
        for (auto const& [tagName, tag] : tags) file.insert(file.end(), tag.begin(), tag.end());
        return file;
    }
};

using PngChunk = std::pair<std::string_view, ProfileBytes>;

/// One pixel behind the chunks.
ProfileBytes pngWith(std::vector<PngChunk> const& chunks) {
    ProfileBytes file;
    put(file, "\x89PNG\r\n\x1A\n");
    ProfileBytes header;
    put(header, 1, 4), put(header, 1, 4), put(header, 0x08020000, 4), put(header, 0, 1);
    appendPngChunk(file, "IHDR", header);
    for (auto const& [name, data] : chunks) appendPngChunk(file, name, data);
    appendPngChunk(file, "IDAT", deflateZlib(ProfileBytes(4), 9));
    appendPngChunk(file, "IEND", {});
    return file;
}

PngChunk numbers(std::string_view name, std::vector<uint32_t> const& values) {
    PngChunk chunk{ name, {} };
    for (const uint32_t value : values) put(chunk.second, value, 4);
    return chunk;
}

PngChunk iccChunk(ProfileBytes const& profile) {
    PngChunk chunk{ "iCCP", {} };
    put(chunk.second, "name"), put(chunk.second, 0, 2);
    const ProfileBytes packed = deflateZlib(profile, 9);
    chunk.second.insert(chunk.second.end(), packed.begin(), packed.end());
    return chunk;
}

/// In segments of at most `part` bytes, the last one first.
ProfileBytes jpegWith(ProfileBytes const& profile, size_t part) {
    ProfileBytes file;
    put(file, 0xFFD8, 2);
    const size_t count = (profile.size() + part - 1) / part;
    for (size_t i = count; i-- > 0;) {
        const size_t size = std::min(part, profile.size() - i * part);
        put(file, 0xFFE2, 2), put(file, static_cast<uint32_t>(size + 16), 2),
                put(file, std::string_view("ICC_PROFILE\0", 12));
        put(file, static_cast<uint32_t>(i + 1), 1), put(file, static_cast<uint32_t>(count), 1);
        const auto first = profile.begin() + static_cast<std::ptrdiff_t>(i * part);
        file.insert(file.end(), first, first + static_cast<std::ptrdiff_t>(size));
    }
    put(file, 0xFFDA, 2), put(file, 2, 2);
    return file;
}

ProfileBytes webpWith(ProfileBytes const& profile) {
    ProfileBytes file;
    put(file, "RIFF"), put(file, 0, 4), put(file, "WEBPVP8X"), put(file, 0x0A000000, 4);
    file.resize(file.size() + 10);
    put(file, "ICCP");
    for (int shift = 0; shift < 32; shift += 8) put(file, static_cast<uint32_t>(profile.size() >> shift & 0xFF), 1);
    file.insert(file.end(), profile.begin(), profile.end());
    return file;
}

ProfileBytes avifWith(ProfileBytes const& profile) {
    test::AvifFile file;
    file.change = [&](avifImage& image) {
        static_cast<void>(
                avifImageSetProfileICC(&image, reinterpret_cast<const uint8_t*>(profile.data()), profile.size()));
    };
    return file.file();
}

// The same profile in every kind of file; of sRGB in its curves and versions, and of other spaces.
TEST(ColorProfile, EveryContainerHandsOutItsProfile) {
    size_t cases = 0;
    for (const bool isVersion4 : { false, true }) {
        for (const Curve curve : { Curve::Parametric, Curve::Table, Curve::Gamma22, Curve::Gamma18, Curve::Linear }) {
            for (auto const& [name, primaries] : { std::pair("sRGB", kRec709Chromaticities),
                                                   { "Display P3", kDisplayP3 },
                                                   { "Adobe RGB (1998)", kAdobeRgb } }) {
                for (const bool isOfTables : { false, true }) {
                    const Profile profile{ .name = name,
                                           .primaries = primaries,
                                           .curve = curve,
                                           .isVersion4 = isVersion4,
                                           .isOfTables = isOfTables };
                    const ProfileBytes bytes = profile.bytes();
                    const bool isSrgb = primaries.red == kRec709Chromaticities.red &&
                                        primaries.green == kRec709Chromaticities.green && !isOfTables &&
                                        curve != Curve::Gamma18 && curve != Curve::Linear;
                    const auto expected =
                            isSrgb ? std::nullopt
                                   : std::optional(fmt::format("the ICC profile '{}'", std::string(name)));
                    EXPECT_EQ(foreignIccProfile(bytes), expected) << static_cast<int>(curve);
                    EXPECT_EQ(foreignColorSpace(pngWith({ iccChunk(bytes) })), expected);
                    EXPECT_EQ(foreignColorSpace(jpegWith(bytes, 60000)), expected);
                    EXPECT_EQ(foreignColorSpace(jpegWith(bytes, 100)), expected);
                    EXPECT_EQ(foreignColorSpace(webpWith(bytes)), expected);
                    ++cases;
                }
            }
        }
    }
    EXPECT_EQ(cases, 2u * 5 * 3 * 2);
    EXPECT_EQ(foreignColorSpace(avifWith(Profile{ .name = "Wide", .primaries = kAdobeRgb }.bytes())),
              "the ICC profile 'Wide'");
    EXPECT_EQ(foreignColorSpace(avifWith(Profile{}.bytes())), std::nullopt);
    EXPECT_EQ(foreignIccProfile(Profile{ .space = "GRAY" }.bytes()), std::nullopt);
    EXPECT_EQ(foreignIccProfile(Profile{ .name = "Press", .space = "CMYK" }.bytes()), "the ICC profile 'Press'");
}

TEST(ColorProfile, ChunksOfAPngCountInTheOrderOfItsSpecification) {
    const PngChunk srgb{ "sRGB", ProfileBytes(1) },
            linear = numbers("gAMA", { 100000 }), usual = numbers("gAMA", { 45455 }), mac = numbers("gAMA", { 55556 }),
            rec709 = numbers("cHRM", { 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000 }),
            adobe = numbers("cHRM", { 31270, 32900, 64000, 33000, 21000, 71000, 15000, 6000 }),
            p3 = numbers("cICP", { 12u << 24 | 13u << 16 | 1 }), cicp = numbers("cICP", { 1u << 24 | 13u << 16 | 1 }),
            pq = numbers("cICP", { 9u << 24 | 16u << 16 | 1 }),
            icc = iccChunk(Profile{ .name = "P3", .primaries = kDisplayP3 }.bytes());
    const auto space = [](std::vector<PngChunk> const& chunks) { return foreignColorSpace(pngWith(chunks)); };
    for (auto const& chunks : { std::vector<PngChunk>{},
                                { srgb },
                                { usual },
                                { usual, rec709 },
                                { srgb, linear, adobe },
                                { cicp },
                                { cicp, icc },
                                { rec709 } })
        EXPECT_EQ(space(chunks), std::nullopt);
    EXPECT_EQ(space({ linear }), "the gamma 1 of gAMA");
    EXPECT_EQ(space({ mac, rec709 }), "the gamma 0.55556 of gAMA");
    EXPECT_THAT(space({ usual, adobe }).value_or(""), HasSubstr("the primaries 0.64 0.33, 0.21 0.71, 0.15 0.06"));
    EXPECT_EQ(space({ p3, srgb }), "CICP primaries 12 and transfer characteristics 13");
    EXPECT_EQ(space({ pq }), "CICP primaries 9 and transfer characteristics 16");
    EXPECT_EQ(space({ icc, srgb }), "the ICC profile 'P3'");
}

TEST(ColorProfile, APictureOfColoursWarnsAndKeepsItsCodes) {
    const ProfileBytes plain = pngWith({}),
                       wide = pngWith({ iccChunk(Profile{ .name = "P3", .primaries = kDisplayP3 }.bytes()) });
    for (const bool isColor : { false, true }) {
        std::vector<std::string> lines;
        const LogSink before = setLogSink([&](Severity, std::string_view line) { lines.emplace_back(line); });
        const auto picture = decodePicture(wide, "wide.png", { .isColor = isColor });
        EXPECT_TRUE(decodePicture(plain, "plain.png", { .isColor = isColor }));
        setLogSink(before);
        ASSERT_TRUE(picture) << picture.error().message;
        EXPECT_EQ(picture->data, decodePicture(plain, "plain.png", { .isColor = isColor })->data);
        if (isColor)
            EXPECT_THAT(lines,
                        ElementsAre("'wide.png' declares the ICC profile 'P3', but its colours are taken as those of "
                                    "sRGB; convert it to sRGB"));
        else
            EXPECT_TRUE(lines.empty()) << "numbers have no colour space";
    }
}

TEST(ColorProfile, DamagedFilesDeclareSomethingOrNothingInOneLine) {
    const ProfileBytes profile = Profile{ .name = "P3", .primaries = kDisplayP3, .isVersion4 = true }.bytes();
    const std::array files{ pngWith({ iccChunk(profile), numbers("cHRM", std::vector<uint32_t>(8, 30000)) }),
                            jpegWith(profile, 100), webpWith(profile), avifWith(profile), profile };
    size_t declared = 0;
    for (uint32_t seed = 0; seed < 5000; ++seed) {
        const ProfileBytes file = damaged(files[seed % files.size()], seed);
        for (auto const& space : { foreignColorSpace(file), foreignIccProfile(file) }) {
            if (!space) continue;
            ++declared;
            for (const char c : *space) ASSERT_TRUE(c >= ' ' && c < 127) << seed;
        }
    }
    EXPECT_GT(declared, 1000u);
}

} // namespace
} // namespace filament_core::assets
