// SPDX-License-Identifier: Apache-2.0
#include "base/math/Elementary.h"
#include "filament_core/assets/image/ChannelTransfer.h"
#include "filament_core/assets/image/ColorProfile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace filament_core::assets {
namespace {

/// Tags of a profile; numbers have their highest byte first. What lies outside of it is zero.
class IccTags {
public:
    explicit IccTags(std::span<const std::byte> profile) : mBytes(profile) {}

    uint32_t number(size_t at, size_t bytes) const {
        uint32_t value = 0;
        for (size_t i = 0; i < bytes; ++i)
            value = value << 8 | (at + i < mBytes.size() ? std::to_integer<uint32_t>(mBytes[at + i]) : 0);
        return value;
    }
    double fixed(size_t at) const { return static_cast<int32_t>(number(at, 4)) / 65536.0; }
    std::string_view text(size_t at, size_t length) const {
        const std::string_view all(reinterpret_cast<const char*>(mBytes.data()), mBytes.size());
        return at < all.size() ? all.substr(at, length) : std::string_view();
    }
    /// Where the tag lies; 0 if there is none.
    size_t find(std::string_view name) const {
        const uint32_t count = std::min(number(128, 4), 256u);
        for (size_t i = 0; i < count; ++i) {
            const size_t entry = 132 + 12 * i;
            if (text(entry, 4) == name) return number(entry + 4, 4);
        }
        return 0;
    }

private:
    std::span<const std::byte> mBytes;
};

/// The description: ASCII in version 2, UTF-16 in version 4.
std::string iccName(IccTags const& tags) {
    const size_t at = tags.find("desc");
    std::string name;
    if (at != 0 && tags.text(at, 4) == "desc") {
        name = tags.text(at + 12, std::min(tags.number(at + 8, 4), 64u));
    } else if (at != 0 && tags.text(at, 4) == "mluc") {
        const size_t length = std::min(tags.number(at + 20, 4), 128u), first = at + tags.number(at + 24, 4);
        for (size_t i = 0; i + 1 < length; i += 2) {
            const uint32_t code = tags.number(first + i, 2);
            name += code < 127 ? static_cast<char>(code) : '?';
        }
    }
    while (!name.empty() && (name.back() == '\0' || name.back() == ' ')) name.pop_back();
    for (char& c : name) c = c >= ' ' && c < 127 ? c : '?';
    return name;
}

/// A parametric curve, ICC.1 table 68; NaN of an unknown one.
double parametric(IccTags const& tags, size_t at, double x) {
    const uint32_t type = tags.number(at + 8, 2);
    std::array<double, 7> p{}; // g a b c d e f
    constexpr std::array<size_t, 5> kCounts{ 1, 3, 4, 5, 7 };
    if (type >= kCounts.size()) return std::nan("");
    for (size_t i = 0; i < kCounts[type]; ++i) p[i] = tags.fixed(at + 12 + 4 * i);
    const auto [g, a, b, c, d, e, f] = p;
    const auto power = [&](double base) { return base > 0 ? elementary::pow(base, p[0]) : 0.0; };
    switch (type) {
    case 0:
        return power(x);
    case 1:
        return a * x + b >= 0 ? power(a * x + b) : 0;
    case 2:
        return a * x + b >= 0 ? power(a * x + b) + c : c;
    case 3:
        return x >= d ? power(a * x + b) : c * x;
    default:
        return x >= d ? power(a * x + b) + e : c * x + f;
    }
}

double curveAt(IccTags const& tags, size_t at, double x) {
    if (tags.text(at, 4) == "para") return parametric(tags, at, x);
    if (at == 0 || tags.text(at, 4) != "curv") return std::nan("");
    const uint32_t count = tags.number(at + 8, 4);
    if (count == 0) return x;
    if (count == 1) return elementary::pow(x, tags.number(at + 12, 2) / 256.0);
    const double place = x * (count - 1);
    const size_t low = std::min(static_cast<size_t>(place), size_t{ count } - 2);
    const auto entry = [&](size_t i) { return tags.number(at + 12 + 2 * i, 2) / 65535.0; };
    return entry(low) + (entry(low + 1) - entry(low)) * (place - static_cast<double>(low));
}

bool isSrgbCurve(IccTags const& tags, std::string_view name) {
    const size_t at = tags.find(name);
    for (int i = 1; i <= 16; ++i) {
        const double x = i / 16.0;
        if (!(std::abs(curveAt(tags, at, x) - linearFromSrgb(x)) < 0.01)) return false; // NaN too
    }
    return true;
}

/// IEC 61966-2-1 under D50, as profiles of it have it.
bool hasSrgbPrimaries(IccTags const& tags) {
    struct Colorant {
        std::string_view name;
        std::array<double, 3> xyz;
    };
    constexpr std::array<Colorant, 3> kColorants{ { { "rXYZ", { 0.4361, 0.2225, 0.0139 } },
                                                    { "gXYZ", { 0.3851, 0.7169, 0.0971 } },
                                                    { "bXYZ", { 0.1431, 0.0606, 0.7141 } } } };
    return std::ranges::all_of(kColorants, [&](Colorant const& colorant) {
        const size_t at = tags.find(colorant.name);
        for (size_t i = 0; i < 3; ++i) {
            if (at == 0 || !(std::abs(tags.fixed(at + 8 + 4 * i) - colorant.xyz[i]) < 0.01)) return false;
        }
        return true;
    });
}

} // namespace

std::optional<std::string> foreignIccProfile(std::span<const std::byte> profile) {
    const IccTags tags(profile);
    if (profile.size() < 132 || tags.text(36, 4) != "acsp") return std::nullopt; // not a profile
    const std::string_view space = tags.text(16, 4);
    if (space == "GRAY" && isSrgbCurve(tags, "kTRC")) return std::nullopt;
    if (space == "RGB " && hasSrgbPrimaries(tags) && isSrgbCurve(tags, "rTRC") && isSrgbCurve(tags, "gTRC") &&
        isSrgbCurve(tags, "bTRC"))
        return std::nullopt;
    return fmt::format("the ICC profile '{}'", iccName(tags));
}

} // namespace filament_core::assets
