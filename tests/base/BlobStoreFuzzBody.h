// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: any bytes behind a correct header are a store, or count as an empty one.
///   Input   what follows the header: entries of key, size and bytes.
#pragma once

#include "base/Assert.h"
#include "base/BlobStore.h"
#include "base/Hash.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>

namespace filament_core::test {

/// Writes the store into `file`. Returns whether it has entries.
inline bool fuzzBlobStore(std::span<const std::byte> entries, std::filesystem::path const& file) {
    constexpr uint64_t kMagic = 0x31424F4C424C4946, kIdentity = 7;
    const std::array<uint64_t, 3> header{ kMagic, kIdentity, hashBytes(entries) };
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(header.data()), sizeof(header));
    out.write(reinterpret_cast<const char*>(entries.data()), static_cast<std::streamsize>(entries.size()));
    out.close();
    BlobStore store(file, kIdentity, 1 << 20);
    uint64_t first = 0;
    if (entries.size() >= sizeof(first)) std::memcpy(&first, entries.data(), sizeof(first));
    FILAMENT_ASSERT(store.find(first).size() <= entries.size(), "a blob is no longer than its file");
    FILAMENT_ASSERT(store.size() * 16 <= entries.size(), "every entry has a header");
    return store.size() > 0;
}

} // namespace filament_core::test
