// SPDX-License-Identifier: Apache-2.0
/// DdsWriter: DDS files for tests, written from Microsoft's documentation; every field can be made wrong.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::assets::test {

struct DdsWriter {
    using Bytes = std::vector<std::byte>;

    uint32_t dxgi = 0;     ///< with a second header; 0: without
    std::string fourCc{};  ///< of four characters; empty: masks
    uint32_t flags = 0x41; ///< of masks: colours with alpha
    uint32_t bits = 32;    ///< of masks
    std::array<uint32_t, 4> masks{ 0xFF, 0xFF00, 0xFF0000, 0xFF000000 };
    uint32_t width = 1, height = 1, levels = 1;
    uint32_t caps2 = 0;                                     ///< 0x200: a cube; 0x200000: a volume
    uint32_t dimension = 3, misc = 0, array = 1, misc2 = 0; ///< of the second header
    Bytes texels{};

    Bytes file() const {
        Bytes bytes;
        const auto put = [&](uint32_t value) {
            for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
        };
        const std::string code = dxgi ? "DX10" : fourCc;
        const auto putCode = [&](std::string const& text) {
            for (size_t i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(i < text.size() ? text[i] : 0));
        };
        putCode("DDS ");
        put(124), put(0x1007), put(height), put(width), put(0), put(0), put(levels);
        for (int i = 0; i < 11; ++i) put(0);
        put(32), put(code.empty() ? flags : 4), putCode(code), put(bits);
        for (const uint32_t mask : masks) put(mask);
        put(0x1000), put(caps2), put(0), put(0), put(0);
        if (dxgi) put(dxgi), put(dimension), put(misc), put(array), put(misc2);
        bytes.insert(bytes.end(), texels.begin(), texels.end());
        return bytes;
    }
};

} // namespace filament_core::assets::test
