// SPDX-License-Identifier: Apache-2.0
/// EnumNames: the enumerators of backend/api as text, in both directions. Traces are written and read with these
/// tables.
///   enumName(value)       "RGBA16F"; "" for a value that is not an enumerator.
///   enumFromName<E>(text) nothing for an unknown name.
///   Sets of flags (kIsFlags) are the names of their bits joined by '|', "0" if empty.
#pragma once

#include "backend/api/Descriptions.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace filament_core::backend {

using std::string_view_literals::operator""sv;

/// Names of the enumerators 0, 1, 2, ...; for flags of the bits 0, 1, 2, ...
template <class E>
inline constexpr std::array<std::string_view, 0> kEnumNames{};
template <class E>
inline constexpr bool kIsFlags = false;

template <>
inline constexpr bool kIsFlags<BufferUsage> = true;
template <>
inline constexpr std::array kEnumNames<BufferUsage>{ "Vertex"sv, "Index"sv, "Uniform"sv, "Storage"sv,
                                                     "TransferSource"sv };
template <>
inline constexpr bool kIsFlags<TextureUsage> = true;
template <>
inline constexpr std::array kEnumNames<TextureUsage>{ "Sampled"sv,         "ColorAttachment"sv, "DepthAttachment"sv,
                                                      "InputAttachment"sv, "TransferSource"sv,  "TransferTarget"sv,
                                                      "Transient"sv };
template <>
inline constexpr bool kIsFlags<ShaderStage> = true;
template <>
inline constexpr std::array kEnumNames<ShaderStage>{ "Vertex"sv, "Fragment"sv, "Compute"sv };

template <>
inline constexpr std::array kEnumNames<IndexFormat>{ "UInt16"sv, "UInt32"sv };
template <>
inline constexpr std::array kEnumNames<TextureKind>{ "Texture2D"sv, "Texture2DArray"sv, "Cube"sv, "CubeArray"sv,
                                                     "Texture3D"sv };
static_assert(kEnumNames<TextureKind>.size() == static_cast<size_t>(TextureKind::Texture3D) + 1);
template <>
inline constexpr std::array kEnumNames<Filter>{ "Nearest"sv, "Linear"sv };
template <>
inline constexpr std::array kEnumNames<MipFilter>{ "None"sv, "Nearest"sv, "Linear"sv };
template <>
inline constexpr std::array kEnumNames<WrapMode>{ "Repeat"sv, "MirroredRepeat"sv, "ClampToEdge"sv };
template <>
inline constexpr std::array kEnumNames<CompareOp>{ "None"sv,     "Never"sv,        "Less"sv,
                                                   "Equal"sv,    "LessEqual"sv,    "Greater"sv,
                                                   "NotEqual"sv, "GreaterEqual"sv, "Always"sv };
template <>
inline constexpr std::array kEnumNames<BindingType>{ "UniformBuffer"sv, "DynamicUniformBuffer"sv, "SampledTexture"sv,
                                                     "InputAttachment"sv, "StorageBuffer"sv };
template <>
inline constexpr std::array kEnumNames<ConstantValue::Type>{ "Bool"sv, "Int"sv, "Float"sv };
template <>
inline constexpr std::array kEnumNames<LoadOp>{ "Load"sv, "Clear"sv, "Discard"sv };
template <>
inline constexpr std::array kEnumNames<StoreOp>{ "Store"sv, "Discard"sv };
template <>
inline constexpr std::array kEnumNames<PrimitiveType>{ "Triangles"sv, "TriangleStrip"sv, "Lines"sv, "LineStrip"sv,
                                                       "Points"sv };
template <>
inline constexpr std::array kEnumNames<CullMode>{ "None"sv, "Front"sv, "Back"sv };
template <>
inline constexpr std::array kEnumNames<FrontFace>{ "CounterClockwise"sv, "Clockwise"sv };
template <>
inline constexpr std::array kEnumNames<StencilOp>{ "Keep"sv,           "Zero"sv,           "Replace"sv,
                                                   "IncrementClamp"sv, "DecrementClamp"sv, "Invert"sv,
                                                   "IncrementWrap"sv,  "DecrementWrap"sv };
template <>
inline constexpr std::array kEnumNames<BlendFactor>{ "Zero"sv,
                                                     "One"sv,
                                                     "SrcColor"sv,
                                                     "OneMinusSrcColor"sv,
                                                     "DstColor"sv,
                                                     "OneMinusDstColor"sv,
                                                     "SrcAlpha"sv,
                                                     "OneMinusSrcAlpha"sv,
                                                     "DstAlpha"sv,
                                                     "OneMinusDstAlpha"sv,
                                                     "SrcAlphaSaturate"sv };
template <>
inline constexpr std::array kEnumNames<PresentMode>{ "Fifo"sv, "Mailbox"sv, "Immediate"sv };
template <>
inline constexpr std::array kEnumNames<OutputSpace>{ "Srgb"sv, "LinearRec709"sv, "DisplayP3"sv, "Rec2020Pq"sv };
template <>
inline constexpr std::array kEnumNames<BlendOp>{ "Add"sv, "Subtract"sv, "ReverseSubtract"sv, "Min"sv, "Max"sv };

/// How many enumerators (or bits) there are.
template <class E>
constexpr size_t enumCount() {
    if constexpr (std::is_same_v<E, Format> || std::is_same_v<E, VertexFormat>)
        return static_cast<size_t>(E::Count);
    else
        return kEnumNames<E>.size();
}

/// The name of enumerator (or bit) number `index`.
template <class E>
std::string_view nameAt(size_t index) {
    if constexpr (std::is_same_v<E, Format>)
        return formatInfo(static_cast<Format>(index)).name;
    else if constexpr (std::is_same_v<E, VertexFormat>)
        return vertexFormatInfo(static_cast<VertexFormat>(index)).name;
    else
        return kEnumNames<E>[index];
}

template <class E>
std::string_view enumName(E value) {
    static_assert(enumCount<E>() > 0, "this enum has no names in EnumNames.h");
    const auto index = static_cast<size_t>(value);
    return index < enumCount<E>() ? nameAt<E>(index) : std::string_view{};
}

/// The number of the enumerator (or bit) with this name.
template <class E>
std::optional<size_t> enumIndex(std::string_view name) {
    static_assert(enumCount<E>() > 0, "this enum has no names in EnumNames.h");
    for (size_t i = 0; i < enumCount<E>(); ++i) {
        if (nameAt<E>(i) == name) return i;
    }
    return std::nullopt;
}

} // namespace filament_core::backend
