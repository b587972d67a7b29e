// SPDX-License-Identifier: Apache-2.0
/// PlainExr: an uncompressed OpenEXR file of floats with the windows and attributes that a test chooses, written by the
/// "OpenEXR File Layout" (openexr.com), independently of ExrWriter.
#pragma once

#include <filament_core/Math.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::assets {

using ExrBox = std::array<int32_t, 4>; ///< min x, min y, max x, max y, inclusive

struct PlainExr {
    ExrBox data{ 0, 0, 0, 0 };
    std::optional<ExrBox> display{};
    std::optional<std::array<float, 8>> chromaticities{};
    std::optional<uint8_t> envmap{};
    std::optional<float> pixelAspectRatio{}, whiteLuminance{};
    bool isGrey = false;
    std::function<float3(int x, int y)> pixel = [](int, int) {
        return float3(1);
    }; ///< in the coordinates of the windows

    std::vector<std::byte> bytes() const {
        std::vector<std::byte> file;
        add(file, uint32_t{ 20000630 });
        add(file, uint32_t{ 2 });
        std::vector<std::byte> channels;
        for (const char c : std::string_view(isGrey ? "Y" : "BGR")) {
            add(channels, c);
            add(channels, '\0');
            add(channels, std::array<int32_t, 4>{ 2, 0, 1, 1 }); // float, not linear, not subsampled
        }
        add(channels, '\0');
        addAttribute(file, "channels", "chlist", channels);
        addAttribute(file, "compression", "compression", uint8_t{ 0 });
        addAttribute(file, "dataWindow", "box2i", data);
        if (display) addAttribute(file, "displayWindow", "box2i", *display);
        if (chromaticities) addAttribute(file, "chromaticities", "chromaticities", *chromaticities);
        if (envmap) addAttribute(file, "envmap", "envmap", *envmap);
        if (pixelAspectRatio) addAttribute(file, "pixelAspectRatio", "float", *pixelAspectRatio);
        if (whiteLuminance) addAttribute(file, "whiteLuminance", "float", *whiteLuminance);
        add(file, '\0');
        addRows(file);
        return file;
    }

private:
    template <class T>
    static void add(std::vector<std::byte>& to, T const& value) {
        auto const* const first = reinterpret_cast<const std::byte*>(&value);
        to.insert(to.end(), first, first + sizeof(T));
    }
    static void add(std::vector<std::byte>& to, std::vector<std::byte> const& value) {
        to.insert(to.end(), value.begin(), value.end());
    }
    static size_t sizeOf(std::vector<std::byte> const& value) { return value.size(); }
    template <class T>
    static size_t sizeOf(T const&) {
        return sizeof(T);
    }
    template <class T>
    static void addAttribute(std::vector<std::byte>& to, std::string_view name, std::string_view type, T const& value) {
        for (const std::string_view text : { name, type }) {
            for (const char c : text) add(to, c);
            add(to, '\0');
        }
        add(to, static_cast<uint32_t>(sizeOf(value)));
        add(to, value);
    }
    void addRows(std::vector<std::byte>& file) const {
        const auto width = static_cast<size_t>(data[2] - data[0] + 1),
                   height = static_cast<size_t>(data[3] - data[1] + 1);
        const size_t channels = isGrey ? 1 : 3, row = 8 + width * channels * sizeof(float);
        const size_t first = file.size() + height * 8;
        for (size_t y = 0; y < height; ++y) add(file, uint64_t{ first + y * row });
        for (int y = data[1]; y <= data[3]; ++y) {
            add(file, std::array<uint32_t, 2>{ static_cast<uint32_t>(y), static_cast<uint32_t>(row - 8) });
            for (size_t c = 0; c < channels; ++c)
                for (int x = data[0]; x <= data[2]; ++x) add(file, pixel(x, y)[2 - static_cast<int>(c)]);
        }
    }
};

} // namespace filament_core::assets
