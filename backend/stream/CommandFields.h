// SPDX-License-Identifier: Apache-2.0
/// CommandFields: the only list of the fields of commands, by name. Payload copying, the text dump, its reader and the
/// validation messages all iterate over it, so a new field is written down once.
///   Use     visitFields(value, [](const char* name, auto& field) { ... }) in the order of declaration; kFields<T>.name
///           is the name in dumps ("Draw"), HasFields<T> distinguishes a struct from a leaf.
///   Checked a struct with a field that is not listed here does not compile.
///   Cost    everything folds at compile time.
#pragma once

#include "backend/api/Commands.h"

#include <array>
#include <concepts>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace filament_core::backend {

template <class S, class T>
struct Field {
    const char* name;
    T S::*member;
};

template <class S, class... T>
struct FieldList {
    const char* name;
    std::tuple<Field<S, T>...> fields;
    static constexpr size_t kCount = sizeof...(T);
};

namespace detail {

struct AnyValue {
    template <class T>
    constexpr operator T() const noexcept; // only used in unevaluated code
};
template <class S, size_t... I>
constexpr bool hasMembers(std::index_sequence<I...>) {
    return requires { S{ (static_cast<void>(I), AnyValue{})... }; };
}
/// Members of an aggregate: the largest count of initialisers it accepts.
template <class S, size_t N = 16>
constexpr size_t memberCount() {
    if constexpr (hasMembers<S>(std::make_index_sequence<N>{}))
        return N;
    else
        return memberCount<S, N - 1>();
}

template <class S, class... T>
constexpr FieldList<S, T...> list(const char* name, Field<S, T>... fields) {
    static_assert(sizeof...(T) == memberCount<S>(), "a field of this struct is missing in CommandFields.h");
    return { name, { fields... } };
}
template <class S>
constexpr FieldList<S> empty(const char* name) {
    static_assert(memberCount<S>() == 0, "a field of this struct is missing in CommandFields.h");
    return { name, {} };
}

} // namespace detail

/// void: a leaf (number, enum, handle, text, bytes).
struct NoFields {};
template <class S>
inline constexpr NoFields kFields{};

template <class S>
concept HasFields = !std::same_as<std::remove_cv_t<decltype(kFields<std::remove_cv_t<S>>)>, NoFields>;

template <HasFields S, class Visitor>
constexpr void visitFields(S& value, Visitor&& visitor) {
    std::apply([&](auto const&... field) { (visitor(field.name, value.*field.member), ...); },
               kFields<std::remove_cv_t<S>>.fields);
}

// One line per field: the name in dumps is the name in the code.
#define FILAMENT_FIELD(S, member)                                                                                      \
    Field<S, decltype(S::member)> { #member, &S::member }

#define FILAMENT_FIELDS(S, name, ...)                                                                                  \
    template <>                                                                                                        \
    inline constexpr auto kFields<S> = detail::list<S>(name, __VA_ARGS__)
#define FILAMENT_NO_FIELDS(S, name)                                                                                    \
    template <>                                                                                                        \
    inline constexpr auto kFields<S> = detail::empty<S>(name)

// ---------------------------------------------------------------------------------------------- descriptions

FILAMENT_FIELDS(Rect, "Rect", FILAMENT_FIELD(Rect, x), FILAMENT_FIELD(Rect, y), FILAMENT_FIELD(Rect, width),
                FILAMENT_FIELD(Rect, height));
FILAMENT_FIELDS(Viewport, "Viewport", FILAMENT_FIELD(Viewport, x), FILAMENT_FIELD(Viewport, y),
                FILAMENT_FIELD(Viewport, width), FILAMENT_FIELD(Viewport, height));
FILAMENT_FIELDS(BufferDesc, "BufferDesc", FILAMENT_FIELD(BufferDesc, size), FILAMENT_FIELD(BufferDesc, usage),
                FILAMENT_FIELD(BufferDesc, debugName));
FILAMENT_FIELDS(DeviceTextureDesc, "DeviceTextureDesc", FILAMENT_FIELD(DeviceTextureDesc, type),
                FILAMENT_FIELD(DeviceTextureDesc, format), FILAMENT_FIELD(DeviceTextureDesc, usage),
                FILAMENT_FIELD(DeviceTextureDesc, samples), FILAMENT_FIELD(DeviceTextureDesc, levels),
                FILAMENT_FIELD(DeviceTextureDesc, layers), FILAMENT_FIELD(DeviceTextureDesc, width),
                FILAMENT_FIELD(DeviceTextureDesc, height), FILAMENT_FIELD(DeviceTextureDesc, debugName),
                FILAMENT_FIELD(DeviceTextureDesc, placedOn));
FILAMENT_FIELDS(SamplerDesc, "SamplerDesc", FILAMENT_FIELD(SamplerDesc, magFilter),
                FILAMENT_FIELD(SamplerDesc, minFilter), FILAMENT_FIELD(SamplerDesc, mipFilter),
                FILAMENT_FIELD(SamplerDesc, wrapU), FILAMENT_FIELD(SamplerDesc, wrapV),
                FILAMENT_FIELD(SamplerDesc, wrapW), FILAMENT_FIELD(SamplerDesc, compare),
                FILAMENT_FIELD(SamplerDesc, anisotropy));
FILAMENT_FIELDS(BindingDesc, "BindingDesc", FILAMENT_FIELD(BindingDesc, binding), FILAMENT_FIELD(BindingDesc, type),
                FILAMENT_FIELD(BindingDesc, stages), FILAMENT_FIELD(BindingDesc, inputAttachment),
                FILAMENT_FIELD(BindingDesc, isMultisampled));
FILAMENT_FIELDS(BindGroupLayout, "BindGroupLayout", FILAMENT_FIELD(BindGroupLayout, bindings),
                FILAMENT_FIELD(BindGroupLayout, count));
FILAMENT_FIELDS(ConstantValue, "ConstantValue", FILAMENT_FIELD(ConstantValue, id), FILAMENT_FIELD(ConstantValue, bits),
                FILAMENT_FIELD(ConstantValue, type));
FILAMENT_FIELDS(ProgramDesc, "ProgramDesc", FILAMENT_FIELD(ProgramDesc, vertex), FILAMENT_FIELD(ProgramDesc, fragment),
                FILAMENT_FIELD(ProgramDesc, compute), FILAMENT_FIELD(ProgramDesc, constants),
                FILAMENT_FIELD(ProgramDesc, layout), FILAMENT_FIELD(ProgramDesc, debugName));
FILAMENT_FIELDS(SubpassDesc, "SubpassDesc", FILAMENT_FIELD(SubpassDesc, colorMask),
                FILAMENT_FIELD(SubpassDesc, inputMask), FILAMENT_FIELD(SubpassDesc, usesDepth));
FILAMENT_FIELDS(PassLayout, "PassLayout", FILAMENT_FIELD(PassLayout, colorFormats),
                FILAMENT_FIELD(PassLayout, depthFormat), FILAMENT_FIELD(PassLayout, colorCount),
                FILAMENT_FIELD(PassLayout, samples), FILAMENT_FIELD(PassLayout, resolveMask),
                FILAMENT_FIELD(PassLayout, resolvesDepth), FILAMENT_FIELD(PassLayout, subpassCount),
                FILAMENT_FIELD(PassLayout, subpasses));
FILAMENT_FIELDS(Attachment, "Attachment", FILAMENT_FIELD(Attachment, texture), FILAMENT_FIELD(Attachment, level),
                FILAMENT_FIELD(Attachment, layer), FILAMENT_FIELD(Attachment, load), FILAMENT_FIELD(Attachment, store),
                FILAMENT_FIELD(Attachment, clear), FILAMENT_FIELD(Attachment, resolve));
FILAMENT_FIELDS(PassDesc, "PassDesc", FILAMENT_FIELD(PassDesc, layout), FILAMENT_FIELD(PassDesc, colors),
                FILAMENT_FIELD(PassDesc, depth), FILAMENT_FIELD(PassDesc, area), FILAMENT_FIELD(PassDesc, debugName));
FILAMENT_FIELDS(VertexAttribute, "VertexAttribute", FILAMENT_FIELD(VertexAttribute, location),
                FILAMENT_FIELD(VertexAttribute, buffer), FILAMENT_FIELD(VertexAttribute, format),
                FILAMENT_FIELD(VertexAttribute, offset));
FILAMENT_FIELDS(VertexBufferLayout, "VertexBufferLayout", FILAMENT_FIELD(VertexBufferLayout, stride),
                FILAMENT_FIELD(VertexBufferLayout, perInstance));
FILAMENT_FIELDS(VertexLayout, "VertexLayout", FILAMENT_FIELD(VertexLayout, attributes),
                FILAMENT_FIELD(VertexLayout, buffers), FILAMENT_FIELD(VertexLayout, attributeCount),
                FILAMENT_FIELD(VertexLayout, bufferCount));
FILAMENT_FIELDS(RasterState, "RasterState", FILAMENT_FIELD(RasterState, topology), FILAMENT_FIELD(RasterState, cull),
                FILAMENT_FIELD(RasterState, frontFace), FILAMENT_FIELD(RasterState, depthClamp),
                FILAMENT_FIELD(RasterState, depthBiasConstant), FILAMENT_FIELD(RasterState, depthBiasSlope),
                FILAMENT_FIELD(RasterState, alphaToCoverage));
FILAMENT_FIELDS(StencilFace, "StencilFace", FILAMENT_FIELD(StencilFace, compare), FILAMENT_FIELD(StencilFace, fail),
                FILAMENT_FIELD(StencilFace, depthFail), FILAMENT_FIELD(StencilFace, pass),
                FILAMENT_FIELD(StencilFace, readMask), FILAMENT_FIELD(StencilFace, writeMask));
FILAMENT_FIELDS(DepthStencilState, "DepthStencilState", FILAMENT_FIELD(DepthStencilState, depthCompare),
                FILAMENT_FIELD(DepthStencilState, depthWrite), FILAMENT_FIELD(DepthStencilState, stencilTest),
                FILAMENT_FIELD(DepthStencilState, front), FILAMENT_FIELD(DepthStencilState, back));
FILAMENT_FIELDS(BlendState, "BlendState", FILAMENT_FIELD(BlendState, enabled), FILAMENT_FIELD(BlendState, srcColor),
                FILAMENT_FIELD(BlendState, dstColor), FILAMENT_FIELD(BlendState, srcAlpha),
                FILAMENT_FIELD(BlendState, dstAlpha), FILAMENT_FIELD(BlendState, colorOp),
                FILAMENT_FIELD(BlendState, alphaOp), FILAMENT_FIELD(BlendState, writeMask));
FILAMENT_FIELDS(PipelineDesc, "PipelineDesc", FILAMENT_FIELD(PipelineDesc, program), FILAMENT_FIELD(PipelineDesc, pass),
                FILAMENT_FIELD(PipelineDesc, subpass), FILAMENT_FIELD(PipelineDesc, vertices),
                FILAMENT_FIELD(PipelineDesc, raster), FILAMENT_FIELD(PipelineDesc, depthStencil),
                FILAMENT_FIELD(PipelineDesc, blend), FILAMENT_FIELD(PipelineDesc, debugName));
FILAMENT_FIELDS(TextureRange, "TextureRange", FILAMENT_FIELD(TextureRange, level),
                FILAMENT_FIELD(TextureRange, levelCount), FILAMENT_FIELD(TextureRange, layer),
                FILAMENT_FIELD(TextureRange, layerCount));
FILAMENT_FIELDS(BindGroupEntry, "BindGroupEntry", FILAMENT_FIELD(BindGroupEntry, binding),
                FILAMENT_FIELD(BindGroupEntry, buffer), FILAMENT_FIELD(BindGroupEntry, offset),
                FILAMENT_FIELD(BindGroupEntry, size), FILAMENT_FIELD(BindGroupEntry, texture),
                FILAMENT_FIELD(BindGroupEntry, sampler), FILAMENT_FIELD(BindGroupEntry, range));
FILAMENT_FIELDS(BindGroupDesc, "BindGroupDesc", FILAMENT_FIELD(BindGroupDesc, layout),
                FILAMENT_FIELD(BindGroupDesc, entries), FILAMENT_FIELD(BindGroupDesc, debugName));

FILAMENT_FIELDS(SurfaceDesc, "SurfaceDesc", FILAMENT_FIELD(SurfaceDesc, window),
                FILAMENT_FIELD(SurfaceDesc, presentMode), FILAMENT_FIELD(SurfaceDesc, space),
                FILAMENT_FIELD(SurfaceDesc, peakNits), FILAMENT_FIELD(SurfaceDesc, spaces),
                FILAMENT_FIELD(SurfaceDesc, gate), FILAMENT_FIELD(SurfaceDesc, debugName));

// ---------------------------------------------------------------------------------------------- commands

#define FILAMENT_CREATE_FIELDS(C, name) FILAMENT_FIELDS(C, name, FILAMENT_FIELD(C, handle), FILAMENT_FIELD(C, desc))
#define FILAMENT_DESTROY_FIELDS(C, name) FILAMENT_FIELDS(C, name, FILAMENT_FIELD(C, handle))
FILAMENT_CREATE_FIELDS(CmdCreateBuffer, "CreateBuffer");
FILAMENT_CREATE_FIELDS(CmdCreateTexture, "CreateTexture");
FILAMENT_CREATE_FIELDS(CmdCreateSampler, "CreateSampler");
FILAMENT_CREATE_FIELDS(CmdCreateProgram, "CreateProgram");
FILAMENT_CREATE_FIELDS(CmdCreatePipeline, "CreatePipeline");
FILAMENT_CREATE_FIELDS(CmdCreateBindGroup, "CreateBindGroup");
FILAMENT_CREATE_FIELDS(CmdCreateSurface, "CreateSurface");
FILAMENT_DESTROY_FIELDS(CmdDestroyBuffer, "DestroyBuffer");
FILAMENT_DESTROY_FIELDS(CmdDestroyTexture, "DestroyTexture");
FILAMENT_DESTROY_FIELDS(CmdDestroySampler, "DestroySampler");
FILAMENT_DESTROY_FIELDS(CmdDestroyProgram, "DestroyProgram");
FILAMENT_DESTROY_FIELDS(CmdDestroyPipeline, "DestroyPipeline");
FILAMENT_DESTROY_FIELDS(CmdDestroyBindGroup, "DestroyBindGroup");
FILAMENT_DESTROY_FIELDS(CmdDestroySurface, "DestroySurface");
FILAMENT_FIELDS(CmdUpdateBuffer, "UpdateBuffer", FILAMENT_FIELD(CmdUpdateBuffer, buffer),
                FILAMENT_FIELD(CmdUpdateBuffer, offset), FILAMENT_FIELD(CmdUpdateBuffer, bytes));
FILAMENT_FIELDS(CmdUploadTexture, "UploadTexture", FILAMENT_FIELD(CmdUploadTexture, texture),
                FILAMENT_FIELD(CmdUploadTexture, level), FILAMENT_FIELD(CmdUploadTexture, layer),
                FILAMENT_FIELD(CmdUploadTexture, layerCount), FILAMENT_FIELD(CmdUploadTexture, rect),
                FILAMENT_FIELD(CmdUploadTexture, bytes));
FILAMENT_FIELDS(CmdGenerateMips, "GenerateMips", FILAMENT_FIELD(CmdGenerateMips, texture));
FILAMENT_FIELDS(CmdBlit, "Blit", FILAMENT_FIELD(CmdBlit, source), FILAMENT_FIELD(CmdBlit, target),
                FILAMENT_FIELD(CmdBlit, sourceLevel), FILAMENT_FIELD(CmdBlit, targetLevel),
                FILAMENT_FIELD(CmdBlit, sourceLayer), FILAMENT_FIELD(CmdBlit, targetLayer),
                FILAMENT_FIELD(CmdBlit, sourceRect), FILAMENT_FIELD(CmdBlit, targetRect),
                FILAMENT_FIELD(CmdBlit, filter));
FILAMENT_FIELDS(CmdReadBuffer, "ReadBuffer", FILAMENT_FIELD(CmdReadBuffer, buffer),
                FILAMENT_FIELD(CmdReadBuffer, offset), FILAMENT_FIELD(CmdReadBuffer, size),
                FILAMENT_FIELD(CmdReadBuffer, ticket));
FILAMENT_FIELDS(CmdReadTexture, "ReadTexture", FILAMENT_FIELD(CmdReadTexture, texture),
                FILAMENT_FIELD(CmdReadTexture, level), FILAMENT_FIELD(CmdReadTexture, layer),
                FILAMENT_FIELD(CmdReadTexture, rect), FILAMENT_FIELD(CmdReadTexture, ticket));
FILAMENT_FIELDS(CmdBeginPass, "BeginPass", FILAMENT_FIELD(CmdBeginPass, desc));
FILAMENT_NO_FIELDS(CmdNextSubpass, "NextSubpass");
FILAMENT_NO_FIELDS(CmdEndPass, "EndPass");
FILAMENT_FIELDS(CmdSetViewport, "SetViewport", FILAMENT_FIELD(CmdSetViewport, viewport));
FILAMENT_FIELDS(CmdSetScissor, "SetScissor", FILAMENT_FIELD(CmdSetScissor, rect));
FILAMENT_FIELDS(CmdSetStencilReference, "SetStencilReference", FILAMENT_FIELD(CmdSetStencilReference, front),
                FILAMENT_FIELD(CmdSetStencilReference, back));
FILAMENT_FIELDS(CmdBindPipeline, "BindPipeline", FILAMENT_FIELD(CmdBindPipeline, pipeline));
FILAMENT_FIELDS(CmdBindGroup, "BindGroup", FILAMENT_FIELD(CmdBindGroup, group), FILAMENT_FIELD(CmdBindGroup, index),
                FILAMENT_FIELD(CmdBindGroup, dynamicCount), FILAMENT_FIELD(CmdBindGroup, dynamicOffsets));
FILAMENT_FIELDS(CmdBindVertexBuffers, "BindVertexBuffers", FILAMENT_FIELD(CmdBindVertexBuffers, buffers),
                FILAMENT_FIELD(CmdBindVertexBuffers, offsets), FILAMENT_FIELD(CmdBindVertexBuffers, count));
FILAMENT_FIELDS(CmdBindIndexBuffer, "BindIndexBuffer", FILAMENT_FIELD(CmdBindIndexBuffer, buffer),
                FILAMENT_FIELD(CmdBindIndexBuffer, offset), FILAMENT_FIELD(CmdBindIndexBuffer, type));
FILAMENT_FIELDS(CmdDraw, "Draw", FILAMENT_FIELD(CmdDraw, vertexCount), FILAMENT_FIELD(CmdDraw, instanceCount),
                FILAMENT_FIELD(CmdDraw, firstVertex), FILAMENT_FIELD(CmdDraw, firstInstance));
FILAMENT_FIELDS(CmdDrawIndexed, "DrawIndexed", FILAMENT_FIELD(CmdDrawIndexed, indexCount),
                FILAMENT_FIELD(CmdDrawIndexed, instanceCount), FILAMENT_FIELD(CmdDrawIndexed, firstIndex),
                FILAMENT_FIELD(CmdDrawIndexed, vertexOffset), FILAMENT_FIELD(CmdDrawIndexed, firstInstance));
FILAMENT_FIELDS(CmdDispatch, "Dispatch", FILAMENT_FIELD(CmdDispatch, groupsX), FILAMENT_FIELD(CmdDispatch, groupsY),
                FILAMENT_FIELD(CmdDispatch, groupsZ));
FILAMENT_FIELDS(CmdPresent, "Present", FILAMENT_FIELD(CmdPresent, surface), FILAMENT_FIELD(CmdPresent, texture));
FILAMENT_FIELDS(CmdBeginFrame, "BeginFrame", FILAMENT_FIELD(CmdBeginFrame, frame));
FILAMENT_FIELDS(CmdEndFrame, "EndFrame", FILAMENT_FIELD(CmdEndFrame, frame));
FILAMENT_FIELDS(CmdBeginTimer, "BeginTimer", FILAMENT_FIELD(CmdBeginTimer, ticket));
FILAMENT_FIELDS(CmdEndTimer, "EndTimer", FILAMENT_FIELD(CmdEndTimer, ticket));
FILAMENT_FIELDS(CmdPushGroup, "PushGroup", FILAMENT_FIELD(CmdPushGroup, name));
FILAMENT_NO_FIELDS(CmdPopGroup, "PopGroup");

#undef FILAMENT_FIELD
#undef FILAMENT_FIELDS
#undef FILAMENT_NO_FIELDS
#undef FILAMENT_CREATE_FIELDS
#undef FILAMENT_DESTROY_FIELDS

// ---------------------------------------------------------------------------------------------- kinds of fields

template <class T>
inline constexpr bool kIsSpan = false;
template <class T>
inline constexpr bool kIsSpan<std::span<T>> = true;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, size_t N>
inline constexpr bool kIsArray<std::array<T, N>> = true;
template <class T>
inline constexpr bool kIsHandle = false;
template <class Tag>
inline constexpr bool kIsHandle<Handle<Tag>> = true;

} // namespace filament_core::backend
