// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Zlib.h"

#include <zlib.h>

#include <new>

namespace filament_core::assets {

std::vector<std::byte> deflateZlib(std::span<const std::byte> bytes, int level) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::vector<std::byte> out(size);
    auto* const to = reinterpret_cast<Bytef*>(out.data());
    const auto* const from = reinterpret_cast<const Bytef*>(bytes.data());
    if (compress2(to, &size, from, static_cast<uLong>(bytes.size()), level) != Z_OK) throw std::bad_alloc();
    out.resize(size);
    return out;
}

bool inflateZlib(std::span<const std::byte> packed, std::span<std::byte> out) {
    uLongf size = out.size();
    return uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                      packed.size()) == Z_OK &&
           size == out.size();
}

} // namespace filament_core::assets
