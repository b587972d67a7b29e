// SPDX-License-Identifier: Apache-2.0
/// zstdOf, zlibOf: levels of KTX 2.0 files for tests, supercompressed.
#pragma once

#include <cstddef>
#include <vector>

#include <zlib.h>
#include <zstd.h>

namespace filament_core::assets::test {

inline std::vector<std::byte> zstdOf(std::vector<std::byte> const& bytes) {
    std::vector<std::byte> packed(ZSTD_compressBound(bytes.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
    return packed;
}

inline std::vector<std::byte> zlibOf(std::vector<std::byte> const& bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::byte> packed(size);
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
             bytes.size());
    packed.resize(size);
    return packed;
}

} // namespace filament_core::assets::test
