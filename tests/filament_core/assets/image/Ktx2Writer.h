// SPDX-License-Identifier: Apache-2.0
/// Ktx2Writer: KTX 2.0 files for tests, written from the specification; every field can be made wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::assets::test {

struct Ktx2Writer {
    using Bytes = std::vector<std::byte>;

    uint32_t format = 37; ///< VK_FORMAT_R8G8B8A8_UNORM
    uint32_t width = 1, height = 1, depth = 0, elements = 0, faces = 1;
    uint32_t levelCount = ~0u; ///< as many as `levels`
    uint32_t compression = 0;
    uint8_t model = 1, transfer = 1, flags = 0;
    std::vector<uint8_t> channels{ 0, 1, 2, 15 };
    std::vector<std::pair<std::string, std::string>> keys{};
    std::vector<Bytes> levels{};
    std::vector<uint64_t> plainBytes{}; ///< empty: those of the levels
    Bytes globalData{};

    Bytes file() const {
        const Bytes description = descriptionBytes(), values = keyBytes();
        const uint64_t descriptionAt = 80 + 24 * levels.size(), valuesAt = descriptionAt + description.size();
        const uint64_t dataAt = (valuesAt + values.size() + 7) / 8 * 8;
        uint64_t levelAt = dataAt + globalData.size();
        Bytes bytes;
        for (const char c : std::string("\xABKTX 20\xBB\r\n\x1A\n")) bytes.push_back(static_cast<std::byte>(c));
        for (const uint32_t number :
             { format, 1u, width, height, depth, elements, faces,
               levelCount == ~0u ? static_cast<uint32_t>(levels.size()) : levelCount, compression })
            put(bytes, number, 4);
        put(bytes, descriptionAt, 4), put(bytes, description.size(), 4);
        put(bytes, values.empty() ? 0 : valuesAt, 4), put(bytes, values.size(), 4);
        put(bytes, globalData.empty() ? 0 : dataAt, 8), put(bytes, globalData.size(), 8);
        for (size_t i = 0; i < levels.size(); ++i) {
            put(bytes, levelAt, 8), put(bytes, levels[i].size(), 8);
            put(bytes, plainBytes.empty() ? levels[i].size() : plainBytes[i], 8);
            levelAt += levels[i].size();
        }
        append(bytes, description), append(bytes, values);
        bytes.resize(dataAt);
        append(bytes, globalData);
        for (Bytes const& level : levels) append(bytes, level);
        return bytes;
    }

private:
    static void put(Bytes& bytes, uint64_t value, int count) {
        for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
    static void append(Bytes& bytes, Bytes const& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

    Bytes descriptionBytes() const {
        Bytes bytes;
        const size_t block = 24 + 16 * channels.size();
        put(bytes, 4 + block, 4);
        put(bytes, 0, 4), put(bytes, 2, 2), put(bytes, block, 2);
        for (const uint8_t byte : { model, uint8_t{ 1 }, transfer, flags }) put(bytes, byte, 1);
        put(bytes, 0, 4), put(bytes, 0, 8);
        for (const uint8_t channel : channels)
            put(bytes, 0, 3), put(bytes, channel, 1), put(bytes, 0, 4), put(bytes, 0, 4), put(bytes, 0xFFFFFFFF, 4);
        return bytes;
    }

    Bytes keyBytes() const {
        Bytes bytes;
        for (auto const& [key, value] : keys) {
            put(bytes, key.size() + value.size() + 2, 4);
            for (const char c : key + '\0' + value + '\0') bytes.push_back(static_cast<std::byte>(c));
            while (bytes.size() % 4) bytes.push_back(std::byte{ 0 });
        }
        return bytes;
    }
};

} // namespace filament_core::assets::test
