// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Ktx2File.h"

#include "filament_core/assets/image/ImageDecoder.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace filament_core::assets {
namespace {

using Ktx2Bytes = std::span<const std::byte>;

constexpr std::string_view kKtx2Identifier("\xABKTX 20\xBB\r\n\x1A\n", 12);
constexpr uint64_t kKtx2Header = 80, kKtx2LevelEntry = 24;
constexpr uint32_t kMaxKtx2Layers = 2048;
constexpr uint64_t kMaxKtx2Texels = uint64_t{ 1 } << 28;

uint64_t numberAt(Ktx2Bytes bytes, size_t at, size_t count) {
    uint64_t value = 0;
    for (size_t i = 0; i < count; ++i) value |= std::to_integer<uint64_t>(bytes[at + i]) << (8 * i);
    return value;
}

/// Reads the parts of one file; the first error ends it.
class Ktx2Reader {
public:
    Ktx2Reader(Ktx2Bytes bytes, std::string_view name) : mBytes(bytes), mName(name) {}

    Result<Ktx2File> read() {
        if (mBytes.size() < kKtx2Header) return damaged("the file is cut short");
        readHeader();
        if (!mError) readLevels();
        if (!mError) readDescription();
        if (!mError) readKeysAndValues();
        if (!mError) mFile.globalData = part("supercompression global data", number64(64), number64(72));
        if (mError) return *mError;
        return std::move(mFile);
    }

private:
    uint32_t number(size_t at) const { return static_cast<uint32_t>(numberAt(mBytes, at, 4)); }
    uint64_t number64(size_t at) const { return numberAt(mBytes, at, 8); }

    Error damaged(std::string const& what) {
        Error error = fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: {}; export it again", mName, what);
        if (!mError) mError = error;
        return error;
    }
    void refuse(std::string const& what, const char* cure) {
        if (!mError) mError = fail(ErrorCode::Unsupported, "image '{}' {}; {}", mName, what, cure);
    }

    /// Bytes of the file; nothing and an error if they are not in it.
    Ktx2Bytes part(std::string_view what, uint64_t offset, uint64_t length) {
        if (length == 0) return {};
        if (offset > mBytes.size() || length > mBytes.size() - offset) {
            damaged(fmt::format("its {} is {} bytes from byte {} on, and the file has {}", what, length, offset,
                                mBytes.size()));
            return {};
        }
        return mBytes.subspan(offset, length);
    }

    void readHeader() {
        mFile.format = number(12);
        mFile.width = number(20), mFile.height = number(24);
        const uint32_t depth = number(28), elements = number(32), faces = number(36);
        if (mFile.width == 0) damaged("it is 0 texels wide");
        if (mFile.height == 0) refuse("has one dimension", "export it as a two-dimensional texture");
        if (depth != 0) refuse("has three dimensions", "export it as a two-dimensional texture");
        if (mFile.width > kMaxImageSide || mFile.height > kMaxImageSide)
            refuse(fmt::format("is {} x {} texels, more than {} on a side", mFile.width, mFile.height, kMaxImageSide),
                   "make it smaller");
        if (faces != 1 && faces != 6) damaged(fmt::format("it has {} faces, not 1 or 6", faces));
        if (faces == 6 && mFile.width != mFile.height) damaged("it is a cube whose faces are no squares");
        mFile.isCube = faces == 6;
        mFile.isArray = elements > 0;
        const uint64_t layers = uint64_t{ std::max(elements, 1u) } * faces;
        if (layers > kMaxKtx2Layers || layers * mFile.width * mFile.height > kMaxKtx2Texels)
            refuse(fmt::format("has {} layers of {} x {} texels, more than {} or 2^28 texels", layers, mFile.width,
                               mFile.height, kMaxKtx2Layers),
                   "make it smaller");
        mFile.layers = static_cast<uint32_t>(layers);
        const uint32_t compression = number(44);
        if (compression > static_cast<uint32_t>(Ktx2Compression::Zlib))
            refuse(fmt::format("has supercompression {}, which is not known", compression),
                   "export it with Zstandard or without");
        mFile.compression = static_cast<Ktx2Compression>(compression);
    }

    void readLevels() {
        const uint32_t count = std::max(number(40), 1u);
        const auto most = static_cast<uint32_t>(std::bit_width(std::max(mFile.width, mFile.height)));
        if (count > most) {
            damaged(fmt::format("it has {} levels, and its size has only {}", count, most));
            return;
        }
        if (mBytes.size() < kKtx2Header + kKtx2LevelEntry * count) {
            damaged("the file is cut short");
            return;
        }
        for (uint32_t level = 0; level < count; ++level) {
            const size_t at = kKtx2Header + kKtx2LevelEntry * level;
            const Ktx2Bytes bytes = part(fmt::format("level {}", level), number64(at), number64(at + 8));
            if (bytes.empty()) damaged(fmt::format("its level {} is empty", level));
            mFile.levels.push_back({ bytes, number64(at + 16) });
        }
    }

    /// The basic block, which is the first one.
    void readDescription() {
        constexpr size_t kTotal = 4, kBlockHeader = 24, kSample = 16;
        const Ktx2Bytes bytes = part("data format descriptor", number(48), number(52));
        if (mError) return;
        if (bytes.size() < kTotal + kBlockHeader || numberAt(bytes, 4, 4) != 0) {
            damaged("it has no basic data format descriptor");
            return;
        }
        const uint64_t size = numberAt(bytes, 10, 2);
        if (size < kBlockHeader || size > bytes.size() - kTotal || (size - kBlockHeader) % kSample != 0) {
            damaged(fmt::format("its data format descriptor has a block of {} bytes", size));
            return;
        }
        Ktx2Description& description = mFile.description;
        description.model = static_cast<uint8_t>(numberAt(bytes, 12, 1));
        description.transfer = static_cast<uint8_t>(numberAt(bytes, 14, 1));
        description.isPremultiplied = (numberAt(bytes, 15, 1) & 1) != 0;
        for (size_t at = kTotal + kBlockHeader; at < kTotal + size; at += kSample)
            description.channels.push_back(static_cast<uint8_t>(numberAt(bytes, at + 3, 1) & 15));
    }

    void readKeysAndValues() {
        const Ktx2Bytes bytes = part("key/value data", number(56), number(60));
        for (size_t at = 0; at + 4 <= bytes.size();) {
            const uint64_t length = numberAt(bytes, at, 4);
            at += 4;
            if (length > bytes.size() - at) {
                damaged("its key/value data are cut short");
                return;
            }
            const std::string_view entry(reinterpret_cast<const char*>(bytes.data() + at), length);
            if (const size_t end = entry.find('\0'); end != std::string_view::npos) {
                mFile.values.push_back({ entry.substr(0, end), bytes.subspan(at + end + 1, length - end - 1) });
                readValue(entry.substr(0, end), entry.substr(end + 1));
            }
            at += std::min<uint64_t>((length + 3) / 4 * 4, bytes.size() - at);
        }
    }

    void readValue(std::string_view key, std::string_view value) {
        value = value.substr(0, value.find('\0'));
        if (key == "KTXswizzle") {
            if (value.size() != 4 || value.find_first_not_of("rgba01") != std::string_view::npos)
                damaged("its KTXswizzle is not four of r, g, b, a, 0 and 1");
            else
                std::copy(value.begin(), value.end(), mFile.swizzle.begin());
        } else if (key == "KTXorientation") {
            mFile.isFlippedX = value.starts_with('l');
            mFile.isFlippedY = value.size() > 1 && value[1] == 'u';
        }
    }

    Ktx2Bytes mBytes;
    std::string_view mName;
    Ktx2File mFile;
    std::optional<Error> mError;
};

} // namespace

std::optional<std::span<const std::byte>> Ktx2File::value(std::string_view key) const {
    const auto found = std::ranges::find(values, key, &Ktx2Value::key);
    return found == values.end() ? std::nullopt : std::optional(found->value);
}

bool isKtx2(std::span<const std::byte> bytes) {
    return bytes.size() >= kKtx2Identifier.size() &&
           std::memcmp(bytes.data(), kKtx2Identifier.data(), kKtx2Identifier.size()) == 0;
}

uint2 ktx2Size(std::span<const std::byte> bytes) {
    if (!isKtx2(bytes) || bytes.size() < kKtx2Header) return uint2(0);
    return { static_cast<uint32_t>(numberAt(bytes, 20, 4)), static_cast<uint32_t>(numberAt(bytes, 24, 4)) };
}

Result<Ktx2File> readKtx2(std::span<const std::byte> bytes, std::string_view name) {
    if (!isKtx2(bytes))
        return fail(ErrorCode::Unsupported, "image '{}' is not KTX 2.0; export it as KTX 2.0, PNG or JPEG", name);
    return Ktx2Reader(bytes, name).read();
}

} // namespace filament_core::assets
