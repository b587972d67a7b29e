// SPDX-License-Identifier: Apache-2.0
#include <filament/View.h>

#include <array>
#include <utility>

namespace filament {
namespace {

constexpr std::array<std::pair<ToneMapper, std::string_view>, 4> kNames{ {
        { ToneMapper::Linear, "linear" },
        { ToneMapper::Aces, "aces" },
        { ToneMapper::Filmic, "filmic" },
        { ToneMapper::Mobile, "mobile" },
} };

} // namespace

const char* toString(ToneMapper toneMapper) { return kNames[static_cast<size_t>(toneMapper)].second.data(); }

std::optional<ToneMapper> toneMapperFromName(std::string_view name) {
    for (auto const& [toneMapper, known] : kNames) {
        if (known == name) return toneMapper;
    }
    return std::nullopt;
}

} // namespace filament
