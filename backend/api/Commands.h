// SPDX-License-Identifier: Apache-2.0
/// The one list of commands. Recorder, dispatch, validation, text dump and every driver derive from it: a driver that
/// forgets one does not compile, and the error names it.
///   A command is a plain struct. Spans and names in it point into the memory of the command buffer that carries it.
///   Order   commands execute in the order of recording, as if each finished before the next one starts.
///   Where   [P] only inside a pass, [O] only outside of passes, [ ] anywhere.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/api/ReplayProgress.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace filament_core::backend {

// clang-format off
// Objects [O]. Destroying an object that earlier commands use is fine: the driver keeps it until the GPU is done.
struct CmdCreateBuffer { BufferHandle handle; BufferDesc desc; };
struct CmdCreateTexture { TextureHandle handle; DeviceTextureDesc desc; };
struct CmdCreateSampler { SamplerHandle handle; SamplerDesc desc; };
struct CmdCreateProgram { ProgramHandle handle; ProgramDesc desc; };
struct CmdCreatePipeline { PipelineHandle handle; PipelineDesc desc; };
struct CmdCreateBindGroup { BindGroupHandle handle; BindGroupDesc desc; };
struct CmdCreateSurface { SurfaceHandle handle; SurfaceDesc desc; };
struct CmdDestroyBuffer { BufferHandle handle; };
struct CmdDestroyTexture { TextureHandle handle; };
struct CmdDestroySampler { SamplerHandle handle; };
struct CmdDestroyProgram { ProgramHandle handle; };
struct CmdDestroyPipeline { PipelineHandle handle; };
struct CmdDestroyBindGroup { BindGroupHandle handle; };
struct CmdDestroySurface { SurfaceHandle handle; };

// Contents [O].
/// Replaces bytes [offset, offset + bytes.size()) of a buffer.
struct CmdUpdateBuffer { BufferHandle buffer; uint64_t offset = 0; std::span<const std::byte> bytes; };
/// Replaces a rectangle of one level of `layerCount` layers, or slices. `bytes`: tightly packed rows, top row first,
/// layer after layer.
struct CmdUploadTexture {
    TextureHandle texture;
    uint8_t level = 0;
    uint16_t layer = 0, layerCount = 1;
    Rect rect{};
    std::span<const std::byte> bytes;
};
/// Fills levels 1.. of every layer from level 0, each the 2x2 box average of the one above. Not of sRGB: upload those.
struct CmdGenerateMips { TextureHandle texture; };
/// Copies with scaling between single-sampled colour textures. The target is not sRGB; an sRGB source is decoded.
struct CmdBlit {
    TextureHandle source, target;
    uint8_t sourceLevel = 0, targetLevel = 0;
    uint16_t sourceLayer = 0, targetLayer = 0;
    Rect sourceRect{}, targetRect{};
    Filter filter = Filter::Nearest;
};
/// Answers `ticket` with bytes [offset, offset + size) of a buffer.
struct CmdReadBuffer { BufferHandle buffer; uint64_t offset = 0, size = 0; Ticket ticket; };
/// Answers `ticket` with the texels of a rectangle, tightly packed, top row first (depth formats: D32F floats).
struct CmdReadTexture { TextureHandle texture; uint8_t level = 0; uint16_t layer = 0; Rect rect{}; Ticket ticket; };

// Passes. Viewport and scissor are reset to the area, everything else is unbound at the start of a pass.
struct CmdBeginPass { PassDesc desc; };                                              // [O]
struct CmdNextSubpass {};                                                            // [P] keeps nothing bound
struct CmdEndPass {};                                                                // [P]
struct CmdSetViewport { Viewport viewport; };                                        // [P]
struct CmdSetScissor { Rect rect; };                                                 // [P]
struct CmdSetStencilReference { uint8_t front = 0, back = 0; };                      // [P]
/// Inside of passes for draws, outside of them for dispatches; beginning and ending a pass unbind everything.
struct CmdBindPipeline { PipelineHandle pipeline; };                                 // [ ]
/// Bindings stay valid across pipelines whose program layouts agree in this group and all before it. [ ]
struct CmdBindGroup {
    BindGroupHandle group;
    uint8_t index = 0;
    uint8_t dynamicCount = 0;
    std::array<uint32_t, kMaxDynamicOffsets> dynamicOffsets{}; ///< bytes, in the order of the layout
};
struct CmdBindVertexBuffers {                                                        // [P]
    std::array<BufferHandle, kMaxVertexBuffers> buffers{};
    std::array<uint64_t, kMaxVertexBuffers> offsets{};
    uint8_t count = 0;
};
struct CmdBindIndexBuffer { BufferHandle buffer; uint64_t offset = 0; IndexFormat type = IndexFormat::UInt16; }; // [P]
struct CmdDraw { uint32_t vertexCount = 0, instanceCount = 1, firstVertex = 0, firstInstance = 0; };         // [P]
struct CmdDrawIndexed {                                                              // [P]
    uint32_t indexCount = 0, instanceCount = 1, firstIndex = 0;
    int32_t vertexOffset = 0;
    uint32_t firstInstance = 0; ///< offsets per-instance attributes; shaders must not read the instance id
};

// Compute.
/// Runs groupsX * groupsY * groupsZ work groups of the bound pipeline's program.
struct CmdDispatch { uint32_t groupsX = 1, groupsY = 1, groupsZ = 1; };              // [O]

// Windows.
/// Shows a single-sampled RGBA8 or RGB10A2 texture in the window, as it is: its texel 0,0 in the upper left corner,
/// black where the window is larger. May wait for the window system. A window that shows nothing (minimised) is
/// skipped.
struct CmdPresent { SurfaceHandle surface; TextureHandle texture; };                 // [O]

// Frames, measuring, names.
struct CmdBeginFrame { uint64_t frame = 0; };       // [O]
struct CmdEndFrame { uint64_t frame = 0; };         // [O] work so far starts on the GPU; finished tickets are answered
struct CmdBeginTimer { Ticket ticket; };            // [O] timers may nest
struct CmdEndTimer { Ticket ticket; };              // [O] answers with the GPU nanoseconds in between
struct CmdPushGroup { std::string_view name; };
struct CmdPopGroup {};
// clang-format on

template <class... C>
struct TypeList {
    static constexpr uint32_t kCount = sizeof...(C);
};

using Commands =
        TypeList<CmdCreateBuffer, CmdCreateTexture, CmdCreateSampler, CmdCreateProgram, CmdCreatePipeline,
                 CmdCreateBindGroup, CmdCreateSurface, CmdDestroyBuffer, CmdDestroyTexture, CmdDestroySampler,
                 CmdDestroyProgram, CmdDestroyPipeline, CmdDestroyBindGroup, CmdDestroySurface, CmdUpdateBuffer,
                 CmdUploadTexture, CmdGenerateMips, CmdBlit, CmdReadBuffer, CmdReadTexture, CmdBeginPass,
                 CmdNextSubpass, CmdEndPass, CmdSetViewport, CmdSetScissor, CmdSetStencilReference, CmdBindPipeline,
                 CmdBindGroup, CmdBindVertexBuffers, CmdBindIndexBuffer, CmdDraw, CmdDrawIndexed, CmdDispatch,
                 CmdPresent, CmdBeginFrame, CmdEndFrame, CmdBeginTimer, CmdEndTimer, CmdPushGroup, CmdPopGroup>;

/// Position of a command in the list; its id in the stream.
template <class C, class List = Commands>
inline constexpr uint32_t kCommandId = ~0u;
template <class C, class... Rest>
inline constexpr uint32_t kCommandId<C, TypeList<C, Rest...>> = 0;
template <class C, class First, class... Rest>
requires(!std::same_as<C, First>) inline constexpr uint32_t kCommandId<C, TypeList<First, Rest...>> =
        1 + kCommandId<C, TypeList<Rest...>>;

template <class D, class C>
concept Executes = requires(D& driver, C const& command) {
    driver.execute(command);
};

template <class D, class C>
struct MustExecute {
    static_assert(Executes<D, C>, "this driver lacks a command");
    static_assert(std::is_trivially_copyable_v<C>, "a command is plain data");
};

// ---------------------------------------------------------------------------------------------- the stream in memory

/// Precedes every command in a chunk; the command follows at the next multiple of kCommandAlignment. Eight, so that the
/// commands of a draw (header and all) take half a cache line each.
inline constexpr size_t kCommandAlignment = 8;
struct CommandHeader {
    uint32_t id = 0;
    uint32_t bytes = 0; ///< from this header to the next one, a multiple of kCommandAlignment
};

struct CommandChunk {
    const std::byte* data = nullptr;
    size_t size = 0; ///< bytes of complete commands
};

/// A recorded stream as a driver sees it: chunks in order.
using CommandView = std::span<const CommandChunk>;

namespace detail {
template <class D, class C>
void executeOne(D& driver, const std::byte* command) {
    driver.execute(*reinterpret_cast<C const*>(command));
}
template <class D, class... C>
constexpr auto makeTable(TypeList<C...>) {
    static_assert((sizeof(MustExecute<D, C>) && ...));
    return std::array<void (*)(D&, const std::byte*), sizeof...(C)>{ &executeOne<D, C>... };
}
} // namespace detail

/// Calls driver.execute(command) for every command of the stream, in order; publishes which one it is in. One indirect
/// call and one store a command.
template <class D>
void replay(CommandView view, D& driver) {
    static constexpr auto kTable = detail::makeTable<D>(Commands{});
    ReplayProgress unwatched;
    ReplayProgress* const watched = ReplayProgress::ofThisThread();
    ReplayProgress& progress = watched ? *watched : unwatched;
    for (CommandChunk const& chunk : view) {
        const std::byte* const end = chunk.data + chunk.size;
        for (const std::byte* at = chunk.data; at < end;) {
            auto const& header = *reinterpret_cast<CommandHeader const*>(at);
            const std::byte* const command = at + kCommandAlignment;
            at += header.bytes;
            progress.enter(command);
            kTable[header.id](driver, command);
        }
    }
    progress.leave();
}

} // namespace filament_core::backend
