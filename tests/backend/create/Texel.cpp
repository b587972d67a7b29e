// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/create/Texel.h"

#include "base/math/Half.h"

#include <cmath>

namespace filament_core::backend {
namespace {

template <class T>
void put(Bytes& to, T value) {
    const size_t at = to.size();
    to.resize(at + sizeof(T));
    std::memcpy(to.data() + at, &value, sizeof(T));
}

/// As many components as the format has.
template <class T>
void putEach(Bytes& to, Rgba const& color, FormatInfo const& info) {
    for (uint32_t i = 0; i < info.components; ++i) put(to, static_cast<T>(color[i]));
}

template <class T>
T get(const std::byte* from, size_t index) {
    T value;
    std::memcpy(&value, from + index * sizeof(T), sizeof(T));
    return value;
}

template <class T>
void getEach(const std::byte* from, Rgba& color, FormatInfo const& info) {
    for (uint32_t i = 0; i < info.components; ++i) color[i] = static_cast<float>(get<T>(from, i));
}

double unorm(double value, uint32_t maximum) { return std::round(value * maximum); }

// Shared exponent: 9 bits of mantissa each, exponent bias 15 (OpenGL ES 3.2, section 8.5.2).
Rgba decodeRgb9e5(uint32_t bits) {
    const double scale = std::ldexp(1.0, static_cast<int>(bits >> 27) - 15 - 9);
    return { static_cast<float>((bits & 511) * scale), static_cast<float>((bits >> 9 & 511) * scale),
             static_cast<float>((bits >> 18 & 511) * scale), 1 };
}

} // namespace

double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Bytes encodeTexel(Format format, Rgba const& color) {
    Bytes bytes;
    FormatInfo const& info = formatInfo(format);
    switch (format) {
    case Format::R8:
    case Format::RG8:
    case Format::RGBA8:
    case Format::RGBA8Srgb:
        for (uint32_t i = 0; i < info.components; ++i) {
            const double value = info.isSrgb && i < 3 ? srgbFromLinear(color[i]) : double{ color[i] };
            put(bytes, static_cast<uint8_t>(unorm(value, 255)));
        }
        break;
    case Format::R8UI:
    case Format::RGBA8UI:
        putEach<uint8_t>(bytes, color, info);
        break;
    case Format::R8I:
    case Format::RGBA8I:
        putEach<int8_t>(bytes, color, info);
        break;
    case Format::R32I:
    case Format::RG32I:
        putEach<int32_t>(bytes, color, info);
        break;
    case Format::R32UI:
    case Format::RG32UI:
        putEach<uint32_t>(bytes, color, info);
        break;
    case Format::RGB10A2:
        put(bytes, static_cast<uint32_t>(unorm(color[0], 1023)) | static_cast<uint32_t>(unorm(color[1], 1023)) << 10 |
                           static_cast<uint32_t>(unorm(color[2], 1023)) << 20 |
                           static_cast<uint32_t>(unorm(color[3], 3)) << 30);
        break;
    case Format::R16F:
    case Format::RG16F:
    case Format::RGBA16F:
        for (uint32_t i = 0; i < info.components; ++i) put(bytes, halfFromFloat(color[i]));
        break;
    case Format::R32F:
    case Format::RG32F:
    case Format::RGBA32F:
        putEach<float>(bytes, color, info);
        break;
    case Format::R11G11B10F:
        put(bytes, packR11G11B10F({ color[0], color[1], color[2] }));
        break;
    default:
        ADD_FAILURE() << "no encoder for " << info.name;
    }
    return bytes;
}

Rgba decodeTexel(Format format, const std::byte* bytes) {
    Rgba color{ 0, 0, 0, 1 };
    FormatInfo const& info = formatInfo(format);
    switch (format) {
    case Format::R8:
    case Format::RG8:
    case Format::RGBA8:
    case Format::RGBA8Srgb:
        for (uint32_t i = 0; i < info.components; ++i) {
            const double value = get<uint8_t>(bytes, i) / 255.0;
            color[i] = static_cast<float>(info.isSrgb && i < 3 ? linearFromSrgb(value) : value);
        }
        return color;
    case Format::R8UI:
    case Format::RGBA8UI:
        getEach<uint8_t>(bytes, color, info);
        return color;
    case Format::R8I:
    case Format::RGBA8I:
        getEach<int8_t>(bytes, color, info);
        return color;
    case Format::R32I:
    case Format::RG32I:
        getEach<int32_t>(bytes, color, info);
        return color;
    case Format::R32UI:
    case Format::RG32UI:
        getEach<uint32_t>(bytes, color, info);
        return color;
    case Format::RGB10A2: {
        const auto bits = get<uint32_t>(bytes, 0);
        return { static_cast<float>((bits & 1023) / 1023.0), static_cast<float>((bits >> 10 & 1023) / 1023.0),
                 static_cast<float>((bits >> 20 & 1023) / 1023.0), static_cast<float>((bits >> 30) / 3.0) };
    }
    case Format::R16F:
    case Format::RG16F:
    case Format::RGBA16F:
        for (uint32_t i = 0; i < info.components; ++i) color[i] = floatFromHalf(get<uint16_t>(bytes, i));
        return color;
    case Format::R32F:
    case Format::RG32F:
    case Format::RGBA32F:
        getEach<float>(bytes, color, info);
        return color;
    case Format::R11G11B10F: {
        const float3 rgb = unpackR11G11B10F(get<uint32_t>(bytes, 0));
        return { rgb.x, rgb.y, rgb.z, 1 };
    }
    case Format::RGB9E5:
        return decodeRgb9e5(get<uint32_t>(bytes, 0));
    default:
        ADD_FAILURE() << "no decoder for " << info.name;
        return color;
    }
}

} // namespace filament_core::backend
