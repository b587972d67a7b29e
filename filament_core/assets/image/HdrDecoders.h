// SPDX-License-Identifier: Apache-2.0
/// The two decoders behind HdrReader.h and the byte cursor that they share. Private to this folder.
///   Fails   a decoder returns an Error whose message is only the reason; HdrReader adds the file and the cure.
///   Thread  any.
#pragma once

#include "base/Result.h"
#include "base/math/ColorSpaces.h"
#include "filament_core/assets/image/HdrImage.h"

#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

namespace filament_core::assets {

/// Reads forward through bytes and never past their end. Little-endian, like the files and all supported machines.
class ByteCursor {
public:
    explicit ByteCursor(std::span<const std::byte> bytes) : mBytes(bytes) {}

    size_t remaining() const { return mBytes.size(); }
    std::span<const std::byte> rest() const { return mBytes; }

    /// The next `count` bytes; nothing if there are fewer.
    std::optional<std::span<const std::byte>> take(size_t count) {
        if (count > mBytes.size()) return std::nullopt;
        const auto taken = mBytes.first(count);
        mBytes = mBytes.subspan(count);
        return taken;
    }

    template <class T>
    std::optional<T> read() {
        static_assert(std::is_trivially_copyable_v<T> && std::endian::native == std::endian::little);
        const auto taken = take(sizeof(T));
        if (!taken) return std::nullopt;
        T value;
        std::memcpy(&value, taken->data(), sizeof(T));
        return value;
    }

    /// The text before the next `end`, which is skipped; nothing if there is none within `limit` characters.
    std::optional<std::string_view> readUntil(char end, size_t limit) {
        const std::string_view text(reinterpret_cast<const char*>(mBytes.data()), std::min(mBytes.size(), limit + 1));
        const size_t length = text.find(end);
        if (length == std::string_view::npos) return std::nullopt;
        mBytes = mBytes.subspan(length + 1);
        return text.substr(0, length);
    }

private:
    std::span<const std::byte> mBytes;
};

/// Nothing if width x height is a supported size, otherwise the reason.
std::optional<Error> checkHdrSize(int64_t width, int64_t height);

enum class HdrPart : uint8_t { Header, All };

struct DecodedHdr {
    HdrImage image; ///< without pixels of HdrPart::Header
    std::optional<Chromaticities> primaries{};
};

bool isRgbe(std::span<const std::byte> bytes);
Result<DecodedHdr> decodeRgbe(std::span<const std::byte> bytes, HdrPart part);

bool isExr(std::span<const std::byte> bytes);
Result<DecodedHdr> decodeExr(std::span<const std::byte> bytes, HdrPart part);

} // namespace filament_core::assets
