// SPDX-License-Identifier: Apache-2.0
#include "filament_core/base/Lz.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace filament {
namespace {

constexpr size_t kMinMatch = 4;
constexpr uint32_t kHashBits = 15;
constexpr uint32_t kNone = ~0u;
constexpr int kCandidates = 32; ///< earlier places that are looked at

static_assert(std::endian::native == std::endian::little, "hashes of four bytes would differ");

uint32_t hashOfFour(const std::byte* at) {
    uint32_t four = 0;
    std::memcpy(&four, at, sizeof(four));
    return four * 2654435761u >> (32 - kHashBits);
}

void putNumber(std::vector<std::byte>& out, uint64_t value) {
    for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::byte>(value | 0x80));
    out.push_back(static_cast<std::byte>(value));
}

struct Match {
    size_t length = 0, distance = 0;
};

/// Earlier places with the same four bytes, the nearest first.
class History {
public:
    explicit History(std::span<const std::byte> bytes)
            : mBytes(bytes), mHeads(1u << kHashBits, kNone), mBefore(bytes.size(), kNone) {}

    void add(size_t at) {
        if (at + kMinMatch > mBytes.size()) return;
        uint32_t& head = mHeads[hashOfFour(mBytes.data() + at)];
        mBefore[at] = head;
        head = static_cast<uint32_t>(at);
    }

    /// The longest, and of those the nearest; length 0: none.
    Match longest(size_t at) const {
        Match best;
        if (at + kMinMatch > mBytes.size()) return best;
        uint32_t from = mHeads[hashOfFour(mBytes.data() + at)];
        for (int i = 0; i < kCandidates && from != kNone; ++i, from = mBefore[from]) {
            const auto differs =
                    std::mismatch(mBytes.begin() + static_cast<ptrdiff_t>(at), mBytes.end(), mBytes.begin() + from);
            const auto length = static_cast<size_t>(differs.first - mBytes.begin()) - at;
            if (length >= kMinMatch && length > best.length) best = { length, at - from };
        }
        return best;
    }

private:
    std::span<const std::byte> mBytes;
    std::vector<uint32_t> mHeads, mBefore;
};

/// Numbers and bytes out of what nobody vouches for.
class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : mRest(bytes) {}

    bool atEnd() const { return mRest.empty(); }
    std::optional<uint64_t> number() {
        uint64_t value = 0;
        for (uint32_t shift = 0; shift < 63 && !mRest.empty(); shift += 7) {
            const auto group = static_cast<uint64_t>(mRest[0]);
            mRest = mRest.subspan(1);
            value |= (group & 0x7F) << shift;
            if (group < 0x80) return value;
        }
        return std::nullopt;
    }
    std::optional<std::span<const std::byte>> bytes(uint64_t count) {
        if (count > mRest.size()) return std::nullopt;
        const auto taken = mRest.first(count);
        mRest = mRest.subspan(count);
        return taken;
    }

private:
    std::span<const std::byte> mRest;
};

/// False: there is none, or it does not fit.
bool appendLiterals(Reader& in, std::vector<std::byte>& out, uint64_t size) {
    const auto count = in.number();
    if (!count || *count > size - out.size()) return false;
    const auto literals = in.bytes(*count);
    if (literals) out.insert(out.end(), literals->begin(), literals->end());
    return literals.has_value();
}

bool appendMatch(Reader& in, std::vector<std::byte>& out, uint64_t size) {
    const auto beyond = in.number(), distance = in.number();
    if (!beyond || !distance || *distance == 0 || *distance > out.size()) return false;
    const uint64_t left = size - out.size();
    if (left < kMinMatch || *beyond > left - kMinMatch) return false;
    size_t from = out.size() - *distance;
    for (uint64_t i = 0; i < *beyond + kMinMatch; ++i) out.push_back(out[from++]); // may read what it has just written
    return true;
}

} // namespace

std::vector<std::byte> compressBytes(std::span<const std::byte> bytes) {
    std::vector<std::byte> out;
    putNumber(out, bytes.size());
    History history(bytes);
    size_t literals = 0; // from here on nothing has been written
    for (size_t at = 0; at < bytes.size();) {
        const Match match = history.longest(at);
        if (match.length == 0) {
            history.add(at++);
            continue;
        }
        putNumber(out, at - literals);
        out.insert(out.end(), bytes.begin() + static_cast<ptrdiff_t>(literals),
                   bytes.begin() + static_cast<ptrdiff_t>(at));
        putNumber(out, match.length - kMinMatch);
        putNumber(out, match.distance);
        for (const size_t end = at + match.length; at < end; ++at) history.add(at);
        literals = at;
    }
    if (literals < bytes.size()) {
        putNumber(out, bytes.size() - literals);
        out.insert(out.end(), bytes.begin() + static_cast<ptrdiff_t>(literals), bytes.end());
    }
    return out;
}

std::optional<std::vector<std::byte>> decompressBytes(std::span<const std::byte> compressed, uint64_t maxBytes) {
    Reader in(compressed);
    const auto size = in.number();
    if (!size || *size > maxBytes) return std::nullopt;
    std::vector<std::byte> out;
    out.reserve(*size);
    while (out.size() < *size) {
        if (!appendLiterals(in, out, *size)) return std::nullopt;
        if (out.size() < *size && !appendMatch(in, out, *size)) return std::nullopt;
    }
    if (!in.atEnd()) return std::nullopt;
    return out;
}

} // namespace filament
