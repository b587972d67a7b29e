// SPDX-License-Identifier: Apache-2.0
/// FrameGraph: the passes of a frame, and the textures and buffers that each of them reads and writes. Declarations
/// only: nothing is created, ordered or recorded here; compile() decides, and record() records.
///   In      textures and buffers (created or imported) and passes in the order in which they should run.
///   Thread  one at a time.
///   Memory  pass code lives in the arena; lists keep their capacity over reset(). A steady frame allocates nothing.
///           Captures of pass code are trivially destructible. Names are literals or live as long as the arena.
///   Limits  65 535 textures, buffers and passes.
///   Fails   asserts on a contradictory declaration, naming pass and texture: here and in compile().
///
///   TextureId hdr = graph.createTexture({ .width = w, .height = h, .format = Format::RGBA16F, .name = "hdr" });
///   graph.addPass("sky", [&](PassBuilder& b) { b.writeColor(0, hdr, { .overwrites = true }); },
///           [=](PassContext& c) { return makePipeline(c.commands(), c.passLayout(), c.subpass()); }, // before it
///           [=](PassContext& c, PipelineHandle sky) { drawFullScreen(c.commands(), sky); });         // inside of it
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Arena.h"
#include "framegraph/PassContext.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace filament_core::framegraph {

/// A texture as the graph sees it; its usage is derived from the passes that use it.
struct GraphTextureDesc {
    uint32_t width = 1, height = 1;
    backend::Format format = backend::Format::RGBA8;
    uint8_t samples = 1;
    uint8_t levels = 1;
    uint16_t layers = 1;
    backend::TextureKind type = backend::TextureKind::Texture2D;
    std::string_view name{};
};

enum class InitialContents : uint8_t { Undefined, Keep };

/// What a pass does with the previous contents of its attachment.
enum class Previous : uint8_t {
    Keep,      ///< draws over them (contents never written before are undefined)
    Clear,     ///< replaces them by a colour first
    Overwrite, ///< covers every pixel: the contents are not loaded
};

struct ColorTarget {
    std::optional<std::array<float, 4>> clear{};
    bool overwrites = false; ///< the pass writes every pixel
    uint8_t level = 0;
    uint16_t layer = 0;
    TextureId resolve{}; ///< single-sampled texture that receives the average of the samples
};

struct DepthTarget {
    std::optional<float> clear{}; ///< reversed z: 0 is far
    uint8_t clearStencil = 0;
    bool overwrites = false;
    uint8_t level = 0;
    uint16_t layer = 0;
    TextureId resolve{}; ///< single-sampled texture that receives sample 0; its stencil is undefined then
};

enum class AccessKind : uint8_t { Color, Depth, DepthTest, Sampled, Input, TransferRead, TransferWrite };

constexpr bool isAttachment(AccessKind kind) { return kind <= AccessKind::DepthTest; }
constexpr bool isDepth(AccessKind kind) { return kind == AccessKind::Depth || kind == AccessKind::DepthTest; }
/// Reads the contents whatever `Access::previous` says.
constexpr bool isPureRead(AccessKind kind) {
    return kind != AccessKind::Color && kind != AccessKind::Depth && kind != AccessKind::TransferWrite;
}

/// For inputs of a pass that needs the number of its attachment (PassContext::colorIndex()).
inline constexpr uint8_t kAnyAttachment = 0xFF;

/// One pass's use of one texture.
struct Access {
    TextureId texture;
    AccessKind kind = AccessKind::Sampled;
    Previous previous = Previous::Keep; ///< attachments
    uint8_t slot = 0;                   ///< Color: index when the pass runs by itself. Input: see readInput()
    backend::TextureRange range{};      ///< with counts: one level and layer for attachments and inputs
    std::array<float, 4> clear{};
    TextureId resolve{};
};

enum class HistoryRole : uint8_t { None, Previous, Current };

struct Texture {
    GraphTextureDesc desc;
    backend::TextureHandle imported{};
    bool isImported = false;
    InitialContents contents = InitialContents::Undefined;
    bool isOutput = false; ///< wanted after the last pass: imported, marked, or what the next frame calls previous
    HistoryRole history = HistoryRole::None; ///< Previous: the texture declared next is its Current
    std::array<float, 4> clear{};            ///< Previous: what it holds where there is no frame before
    bool beginsAnew = false;                 ///< Previous: as if there was none
};

/// A texture that outlives its frame.
struct History {
    TextureId previous; ///< as a frame before this one left it; only read
    TextureId current;  ///< of this frame: written first, then read like any texture; previous of the next frame
};

/// What a pass does with a buffer: dispatches and fragment shaders see it as storage, draws as the others, and
/// transfers upload it or read it back.
enum class BufferUse : uint8_t { Storage, Uniform, Vertex, Index, Transfer };

/// One pass's use of one buffer.
struct BufferAccess {
    BufferId buffer;
    BufferUse use = BufferUse::Storage;
    bool writes = false;
    Previous previous = Previous::Keep; ///< writes: Overwrite replaces all bytes
};

struct Buffer {
    std::string_view name{};
    uint64_t size = 0;
    backend::BufferHandle imported{};
    bool isImported = false;
    InitialContents contents = InitialContents::Undefined;
    bool isOutput = false; ///< wanted after the last pass: imported or marked
};

struct Pass {
    std::string_view name{};
    PassCode code;
    uint32_t firstAccess = 0, accessCount = 0;
    uint32_t firstBufferAccess = 0, bufferAccessCount = 0;
    bool hasSideEffect = false;
};

class FrameGraph;

/// Given to the set-up of a pass: what it will read and write.
class PassBuilder {
public:
    PassBuilder(FrameGraph& graph, uint32_t pass) : mGraph(graph), mPass(pass) {}

    /// Slots 0, 1, ... without gaps; the fragment shader's output locations when the pass is not merged.
    void writeColor(uint8_t slot, TextureId texture, ColorTarget const& target = {});
    /// Tested and written.
    void writeDepth(TextureId texture, DepthTarget const& target = {});
    /// Attached for testing only; the pass's pipelines must not write it.
    void testDepth(TextureId texture, uint8_t level = 0, uint16_t layer = 0);
    /// Through a sampler, anywhere in `range`: all of the texture, one level (backend::oneLevel(2)), one layer, ... The
    /// pass may attach other levels and layers of the same texture. Bind groups name the same range or a part of it.
    void readSampled(TextureId texture, backend::TextureRange range = {});
    /// At the current pixel only. If the pass could be merged with the one that wrote the texture, it is a subpass
    /// input (PassContext::isMerged() is true), otherwise the pass must sample it at the pixel's centre.
    /// `attachment`: for programs with fixed attachment numbers: inputs 0, 1, ..., then the slots of writeColor(). If
    /// the merged pass would have other numbers, the pass is not merged.
    void readInput(TextureId texture, uint8_t attachment = kAnyAttachment, uint8_t level = 0, uint16_t layer = 0);
    /// Blits from it, reads it back, generates mips.
    void readTransfer(TextureId texture, backend::TextureRange range = {});
    /// Uploads or blits to it, generates mips; the rest keeps its contents.
    void writeTransfer(TextureId texture, backend::TextureRange range = {});
    /// Dispatches, draws or transfers of this pass read it, as `use` says.
    void readBuffer(BufferId buffer, BufferUse use);
    /// Dispatches (Storage) or uploads (Transfer) write it; passes with attachments cannot. Overwrite: all of it.
    void writeBuffer(BufferId buffer, BufferUse use, Previous previous = Previous::Keep);
    /// The pass runs even if nothing reads its results (read-backs, uploads to buffers outside of the graph).
    void sideEffect();

private:
    FrameGraph& mGraph;
    uint32_t mPass;
};

class FrameGraph {
public:
    /// The arena is reset by its owner, together with this graph: arena.reset(); graph.reset();
    explicit FrameGraph(Arena& arena) : mArena(arena) {}
    FrameGraph(FrameGraph const&) = delete;
    FrameGraph& operator=(FrameGraph const&) = delete;

    void reset();

    /// Lives from its first to its last use in the frame; contents undefined before it is written.
    TextureId createTexture(GraphTextureDesc const& desc);
    /// A texture that exists outside. What passes write to it is kept.
    TextureId importTexture(backend::TextureHandle texture, GraphTextureDesc const& desc, InitialContents contents);
    /// As createTexture(), importTexture() and markOutput(), for `size` bytes.
    BufferId createBuffer(std::string_view name, uint64_t size);
    BufferId importBuffer(backend::BufferHandle buffer, std::string_view name, uint64_t size, InitialContents contents);
    void markOutput(BufferId buffer);
    /// A texture that is kept from frame to frame under desc.name, with two textures of the pool that swap roles
    /// whenever `current` was written. Without a frame before this one, or with one whose description was another,
    /// `previous` is filled with `clear` (for depth formats {depth, stencil}) before the first pass:
    /// PassContext::historyAge() tells. So it is with `beginsAnew`: what was kept is not what this frame follows. The
    /// textures share no memory with others, and are freed after TransientPool's keepFrames graphs without them.
    History history(GraphTextureDesc const& desc, std::array<float, 4> const& clear = {}, bool beginsAnew = false);
    /// The contents are needed after the frame although no pass reads them. Imported textures are always outputs.
    void markOutput(TextureId texture);

    /// `setup(PassBuilder&)` is called at once, `execute(PassContext&)` by record(), if the pass runs. A pass with
    /// attachments records the inside of a backend pass; one without records commands for outside of passes.
    template <class Setup, class Execute>
    PassId addPass(std::string_view name, Setup&& setup, Execute&& execute) {
        return addPass(
                name, std::forward<Setup>(setup), [](PassContext&) { return Nothing{}; },
                [execute = std::forward<Execute>(execute)](PassContext& context, Nothing) mutable {
                    execute(context);
                });
    }

    /// Also has `beforePass(PassContext&)`: called before the pass (or the merged pass that it is part of) begins,
    /// where objects may be created and contents be uploaded; what it returns is given to
    /// `execute(PassContext&, value)`.
    template <class Setup, class BeforePass, class Execute>
    PassId addPass(std::string_view name, Setup&& setup, BeforePass&& beforePass, Execute&& execute) {
        PassBuilder builder = beginPass(
                name, makePassCode(mArena, std::forward<BeforePass>(beforePass), std::forward<Execute>(execute)));
        std::forward<Setup>(setup)(builder);
        return { static_cast<uint32_t>(mPasses.size()) };
    }

    std::span<const Pass> passes() const { return mPasses; }
    std::span<const Texture> textures() const { return mTextures; }
    std::span<const Access> accesses(Pass const& pass) const {
        return std::span(mAccesses).subspan(pass.firstAccess, pass.accessCount);
    }
    Texture const& texture(TextureId id) const { return mTextures[id.index()]; }
    std::span<const Buffer> buffers() const { return mBuffers; }
    std::span<const BufferAccess> bufferAccesses(Pass const& pass) const {
        return std::span(mBufferAccesses).subspan(pass.firstBufferAccess, pass.bufferAccessCount);
    }
    Buffer const& buffer(BufferId id) const { return mBuffers[id.index()]; }
    Arena& arena() const { return mArena; }

    // For PassBuilder; `pass` is the newest one.
    void declare(uint32_t pass, Access access);
    void declare(uint32_t pass, BufferAccess const& access);
    void declareSideEffect(uint32_t pass) { mPasses[pass].hasSideEffect = true; }

private:
    struct Nothing {};

    PassBuilder beginPass(std::string_view name, PassCode code);
    TextureId addTexture(Texture const& texture);
    BufferId addBuffer(Buffer const& buffer);
    Pass& newest(uint32_t pass);

    Arena& mArena;
    std::vector<Pass> mPasses;
    std::vector<Texture> mTextures;
    std::vector<Buffer> mBuffers;
    std::vector<Access> mAccesses; // pass after pass
    std::vector<BufferAccess> mBufferAccesses;
};

} // namespace filament_core::framegraph
