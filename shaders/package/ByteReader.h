// SPDX-License-Identifier: Apache-2.0
/// ByteReader: reads little-endian values from untrusted bytes.
///   Fails   reading past the end gives zeros and empty spans, and failed() stays true from then on.
///   Memory  allocates only what it returns, never more than the remaining bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace filament_core::shader {

class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : mRest(bytes) {}

    bool failed() const { return mFailed; }
    bool atEnd() const { return mRest.empty(); }

    std::span<const std::byte> bytes(size_t count) {
        if (count > mRest.size()) {
            mFailed = true;
            mRest = {};
            return {};
        }
        const auto taken = mRest.first(count);
        mRest = mRest.subspan(count);
        return taken;
    }

    uint8_t u8() {
        const auto byte = bytes(1);
        return byte.empty() ? uint8_t{ 0 } : static_cast<uint8_t>(byte[0]);
    }

    uint16_t u16() {
        const uint8_t low = u8();
        return static_cast<uint16_t>(low | u8() << 8);
    }

    uint32_t u32() {
        const auto four = bytes(4);
        uint32_t value = 0;
        for (size_t i = 0; i < four.size(); ++i) value |= static_cast<uint32_t>(four[i]) << (8 * i);
        return value;
    }

    uint64_t u64() {
        const uint64_t low = u32();
        return low | static_cast<uint64_t>(u32()) << 32;
    }

    float f32() { return std::bit_cast<float>(u32()); }

    std::string text() {
        const auto characters = bytes(u32());
        return { reinterpret_cast<const char*>(characters.data()), characters.size() };
    }

private:
    std::span<const std::byte> mRest;
    bool mFailed = false;
};

} // namespace filament_core::shader
