// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Repack.h"

#include "base/Assert.h"

#include <bit>
#include <cstring>

namespace filament_core::backend::gles {
namespace {

template <class T>
T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

template <class T>
void store(std::byte* to, T value) {
    std::memcpy(to, &value, sizeof(T));
}

// The 11- and 10-bit floats are halves without a sign and with 6 and 5 bits of mantissa (OpenGL ES 3.1, 2.3.4.3).
uint32_t packedSmallFloats(const std::byte* texel) {
    const uint32_t red = exactHalfBits(load<float>(texel)) >> 4;
    const uint32_t green = exactHalfBits(load<float>(texel + 4)) >> 4;
    const uint32_t blue = exactHalfBits(load<float>(texel + 8)) >> 5;
    return red | green << 11 | blue << 22;
}

void repackComponent(FormatInfo const& info, const std::byte* from, std::byte* to) {
    const uint32_t bytes = info.bytesPerBlock / info.components;
    if (info.kind == FormatKind::UnsignedInteger && bytes == 1) {
        store(to, static_cast<uint8_t>(load<uint32_t>(from)));
    } else if (info.isFloat && bytes == 2) {
        store(to, exactHalfBits(load<float>(from)));
    } else {
        std::memcpy(to, from, bytes); // the same width on both sides
    }
}

} // namespace

uint16_t exactHalfBits(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t sign = (bits >> 16) & 0x8000u;
    const int exponent = static_cast<int>((bits >> 23) & 0xFF) - 127;
    const uint32_t mantissa = bits & 0x7FFFFFu;
    if (exponent == 128) return static_cast<uint16_t>(sign | 0x7C00u | mantissa >> 13 | (mantissa ? 0x200u : 0u));
    if (exponent < -24) return static_cast<uint16_t>(sign); // zero: no smaller value is exact
    if (exponent < -14) return static_cast<uint16_t>(sign | (mantissa | 0x800000u) >> (-exponent - 1));
    return static_cast<uint16_t>(sign | static_cast<uint32_t>(exponent + 15) << 10 | mantissa >> 13);
}

uint32_t genericBytes(Format format) {
    FormatInfo const& info = formatInfo(format);
    return info.isFloat || info.kind == FormatKind::UnsignedInteger ? 16 : 4;
}

bool canRepack(Format format) {
    FormatInfo const& info = formatInfo(format);
    return info.isRenderable && info.kind <= FormatKind::UnsignedInteger && format != Format::RGB10A2;
}

void repack(Format format, std::span<const std::byte> generic, std::span<std::byte> packed) {
    FILAMENT_ASSERT(canRepack(format), "repack() knows the renderable colour formats of equal components");
    FormatInfo const& info = formatInfo(format);
    const size_t sourceTexel = genericBytes(format), targetTexel = info.bytesPerBlock;
    const size_t sourceStep = sourceTexel / 4, targetStep = targetTexel / info.components;
    const std::byte* from = generic.data();
    std::byte* to = packed.data();
    for (const std::byte* end = from + generic.size(); from < end; from += sourceTexel, to += targetTexel) {
        if (format == Format::R11G11B10F) {
            store(to, packedSmallFloats(from));
            continue;
        }
        for (size_t i = 0; i < info.components; ++i) repackComponent(info, from + i * sourceStep, to + i * targetStep);
    }
}

} // namespace filament_core::backend::gles
