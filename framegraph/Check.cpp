// SPDX-License-Identifier: Apache-2.0
// The rules that a graph must follow. Every message names the pass, the texture and the remedy.
#include "framegraph/CompileSteps.h"
#include "framegraph/Require.h"
#include "framegraph/Subresources.h"

#include <algorithm>

namespace filament_core::framegraph {
namespace {

struct Size {
    uint32_t width = 0, height = 0;
    friend bool operator==(Size, Size) = default;
};

Size sizeOfLevel(GraphTextureDesc const& desc, uint8_t level) {
    return { std::max(1u, desc.width >> level), std::max(1u, desc.height >> level) };
}

/// "texture 'bloom'", with level and layer if it has several.
std::string nameOf(GraphTextureDesc const& desc, uint8_t level, uint16_t layer) {
    std::string name = fmt::format("texture '{}'", desc.name);
    if (desc.levels > 1) name += fmt::format(" level {}", level);
    if (desc.layers > 1) name += fmt::format(" layer {}", layer);
    return name;
}

bool writes(Access const& access, TextureId texture, backend::TextureRange const& part) {
    if (isPureRead(access.kind)) return false;
    if (access.resolve == texture && overlap(kResolved, part)) return true;
    return access.texture == texture && overlap(access.range, part);
}

/// A later pass that writes this part of the texture: tells a wrong order from a missing pass.
std::string_view laterWriter(FrameGraph const& graph, uint32_t after, TextureId texture,
                             backend::TextureRange const& part) {
    for (uint32_t pass = after + 1; pass < graph.passes().size(); ++pass) {
        for (Access const& access : graph.accesses(graph.passes()[pass])) {
            if (writes(access, texture, part)) return graph.passes()[pass].name;
        }
    }
    return {};
}

std::string_view laterWriter(FrameGraph const& graph, uint32_t after, BufferId buffer) {
    for (uint32_t pass = after + 1; pass < graph.passes().size(); ++pass) {
        for (BufferAccess const& access : graph.bufferAccesses(graph.passes()[pass])) {
            if (access.writes && access.buffer == buffer) return graph.passes()[pass].name;
        }
    }
    return {};
}

void checkRange(FrameGraph const& graph, Pass const& pass, Access const& access) {
    GraphTextureDesc const& desc = graph.texture(access.texture).desc;
    backend::TextureRange const& range = access.range;
    const bool isThere = exists(range, desc.levels, desc.layers);
    if (isAttachment(access.kind)) {
        const uint32_t slices = backend::layersOfLevel({ .type = desc.type, .layers = desc.layers }, range.level);
        require(isThere && range.layer < slices,
                "pass '{}': texture '{}' has {} levels and {} layers; level {}, layer {} is attached", pass.name,
                desc.name, desc.levels, slices, range.level, range.layer);
    } else {
        require(isThere, "pass '{}': texture '{}' has {} levels and {} layers; declared are {} from {} and {} from {}",
                pass.name, desc.name, desc.levels, desc.layers, range.levelCount, range.level, range.layerCount,
                range.layer);
    }
}

/// Tracks, from pass to pass, which levels and layers have contents.
class Written {
public:
    explicit Written(FrameGraph const& graph)
            : mGraph(graph), mSubresources(graph), mWritten(graph.arena().array<bool>(mSubresources.count())) {
        for (uint32_t i = 0; i < graph.textures().size(); ++i) {
            Texture const& texture = graph.textures()[i];
            if (texture.contents == InitialContents::Keep) add({ i + 1 }, Subresources::all(texture.desc));
        }
        for (uint32_t i = 0; i < graph.buffers().size(); ++i) {
            mWritten[mSubresources.of(BufferId{ i + 1 })] = graph.buffers()[i].contents == InitialContents::Keep;
        }
    }

    void checkReads(uint32_t pass) const {
        for (Access const& access : mGraph.accesses(mGraph.passes()[pass])) {
            if (!isPureRead(access.kind)) continue;
            mSubresources.any(access.texture, access.range, [&](uint32_t number, uint8_t level, uint16_t layer) {
                if (!mWritten[number]) tellUnwritten(pass, access.texture, level, layer);
                return false;
            });
        }
        for (BufferAccess const& access : mGraph.bufferAccesses(mGraph.passes()[pass])) {
            if (!access.writes && !mWritten[mSubresources.of(access.buffer)]) tellUnwritten(pass, access.buffer);
        }
    }

    void addWrites(uint32_t pass) {
        for (Access const& access : mGraph.accesses(mGraph.passes()[pass])) {
            if (isPureRead(access.kind)) continue;
            add(access.texture, access.range);
            if (access.resolve) add(access.resolve, kResolved);
        }
        for (BufferAccess const& access : mGraph.bufferAccesses(mGraph.passes()[pass])) {
            if (access.writes) mWritten[mSubresources.of(access.buffer)] = true;
        }
    }

private:
    void add(TextureId texture, backend::TextureRange const& range) {
        mSubresources.forEach(texture, range, [&](uint32_t number) { mWritten[number] = true; });
    }

    void tellUnwritten(uint32_t pass, TextureId texture, uint8_t level, uint16_t layer) const {
        tellUnwritten(pass, nameOf(mGraph.texture(texture).desc, level, layer),
                      laterWriter(mGraph, pass, texture, { level, 1, layer, 1 }));
    }

    void tellUnwritten(uint32_t pass, BufferId buffer) const {
        tellUnwritten(pass, fmt::format("buffer '{}'", mGraph.buffer(buffer).name), laterWriter(mGraph, pass, buffer));
    }

    void tellUnwritten(uint32_t pass, std::string const& what, std::string_view later) const {
        const std::string_view name = mGraph.passes()[pass].name;
        require(!later.empty(), "pass '{}' reads {}, which no pass writes: write it, or import it with its contents",
                name, what);
        require(false, "pass '{}' reads {} before pass '{}' writes it: declare the writer first", name, what, later);
    }

    FrameGraph const& mGraph;
    Subresources mSubresources;
    std::span<bool> mWritten;
};

void checkAttachment(FrameGraph const& graph, Pass const& pass, Access const& access) {
    GraphTextureDesc const& desc = graph.texture(access.texture).desc;
    require(backend::hasDepth(desc.format) == isDepth(access.kind),
            "pass '{}': texture '{}' has format {}: wrong for a {} attachment", pass.name, desc.name,
            backend::formatInfo(desc.format).name, isDepth(access.kind) ? "depth" : "colour");
}

void checkResolve(FrameGraph const& graph, Pass const& pass, Access const& access) {
    GraphTextureDesc const& from = graph.texture(access.texture).desc;
    require(access.resolve.index() < graph.textures().size(),
            "pass '{}': resolves '{}' to a texture of another graph or frame", pass.name, from.name);
    GraphTextureDesc const& to = graph.texture(access.resolve).desc;
    require(from.samples > 1 && to.samples == 1,
            "pass '{}': resolves '{}' ({} samples) to '{}' ({} samples): needs many to one", pass.name, from.name,
            from.samples, to.name, to.samples);
    require(from.format == to.format && sizeOfLevel(from, access.range.level) == sizeOfLevel(to, 0),
            "pass '{}': resolves '{}' to '{}', which has another format or size", pass.name, from.name, to.name);
}

// One pass: all attachments agree in size and samples, colour slots have no gaps, at most one depth attachment.
void checkAttachmentsAgree(FrameGraph const& graph, Pass const& pass) {
    uint32_t slots = 0, depths = 0;
    Access const* reference = nullptr;
    for (Access const& access : graph.accesses(pass)) {
        if (!isAttachment(access.kind)) continue;
        checkAttachment(graph, pass, access);
        if (access.resolve) checkResolve(graph, pass, access);
        GraphTextureDesc const& desc = graph.texture(access.texture).desc;
        if (access.kind == AccessKind::Color) {
            require(access.slot < backend::kMaxColorAttachments && (slots >> access.slot & 1) == 0,
                    "pass '{}': colour slot {} of '{}' is taken or beyond {}", pass.name, access.slot, desc.name,
                    backend::kMaxColorAttachments - 1);
            slots |= 1u << access.slot;
        } else {
            require(++depths == 1, "pass '{}': '{}' is a second depth attachment", pass.name, desc.name);
        }
        if (!reference) reference = &access;
        GraphTextureDesc const& first = graph.texture(reference->texture).desc;
        const Size expected = sizeOfLevel(first, reference->range.level), size = sizeOfLevel(desc, access.range.level);
        require(size == expected, "pass '{}': attachment '{}' is {} x {}, attachment '{}' is {} x {}", pass.name,
                desc.name, size.width, size.height, first.name, expected.width, expected.height);
        require(desc.samples == first.samples, "pass '{}': attachment '{}' has {} samples, attachment '{}' has {}",
                pass.name, desc.name, desc.samples, first.name, first.samples);
    }
    require((slots & (slots + 1)) == 0, "pass '{}': colour slots have gaps; number them 0, 1, ...", pass.name);
}

// A level and layer has one role per pass; other parts of the same texture may have different roles.
void checkPairs(FrameGraph const& graph, Pass const& pass, Access const& a, std::span<const Access> accesses) {
    GraphTextureDesc const& desc = graph.texture(a.texture).desc;
    for (Access const& b : accesses) {
        const bool isSame = &a == &b;
        if (a.resolve) {
            require((b.texture != a.resolve || !overlap(b.range, kResolved)) && (isSame || b.resolve != a.resolve),
                    "pass '{}': texture '{}' is a resolve target and something else", pass.name,
                    graph.texture(a.resolve).desc.name);
        }
        if (isSame || !isAttachment(a.kind) || a.texture != b.texture || !overlap(a.range, b.range)) continue;
        const std::string what = nameOf(desc, a.range.level, a.range.layer);
        require(isAttachment(b.kind), "pass '{}': {} is attached and read at the same time", pass.name, what);
        require(false, "pass '{}': {} is attached twice", pass.name, what);
    }
}

void checkNotPrevious(FrameGraph const& graph, Pass const& pass, Access const& access) {
    for (const TextureId written : { isPureRead(access.kind) ? TextureId{} : access.texture, access.resolve }) {
        require(!written || graph.texture(written).history != HistoryRole::Previous,
                "pass '{}': writes texture '{}', which a frame before this one left; write the current one", pass.name,
                graph.texture(written ? written : access.texture).desc.name);
    }
}

void checkBuffer(FrameGraph const& graph, Pass const& pass, BufferAccess const& access, bool attaches) {
    if (!access.writes) return;
    const std::string_view name = graph.buffer(access.buffer).name;
    require(access.use == BufferUse::Storage || access.use == BufferUse::Transfer,
            "pass '{}': writes buffer '{}', but not as storage or by a transfer", pass.name, name);
    require(access.previous != Previous::Clear, "pass '{}': buffer '{}' cannot be cleared; overwrite it", pass.name,
            name);
    require(!attaches, "pass '{}': has attachments and writes buffer '{}'; write it in a pass of its own", pass.name,
            name);
}

void checkRoles(FrameGraph const& graph, Pass const& pass) {
    const std::span<const Access> accesses = graph.accesses(pass);
    bool attaches = false, transfers = false, reads = false;
    for (Access const& access : accesses) {
        GraphTextureDesc const& desc = graph.texture(access.texture).desc;
        attaches |= isAttachment(access.kind);
        reads |= access.kind == AccessKind::Input;
        transfers |= access.kind == AccessKind::TransferRead || access.kind == AccessKind::TransferWrite;
        require(isAttachment(access.kind) || access.kind == AccessKind::Sampled || desc.samples == 1,
                "pass '{}': reads multisampled texture '{}' otherwise than sample by sample; resolve it and read the "
                "target",
                pass.name, desc.name);
        checkNotPrevious(graph, pass, access);
        checkPairs(graph, pass, access, accesses);
    }
    for (BufferAccess const& access : graph.bufferAccesses(pass)) {
        checkBuffer(graph, pass, access, attaches);
        transfers |= access.use == BufferUse::Transfer;
    }
    require(attaches || !reads, "pass '{}': reads the current pixel of an input, but has no attachments", pass.name);
    require(!attaches || !transfers, "pass '{}': has attachments and transfers; make the transfers a pass of their own",
            pass.name);
}

} // namespace

void checkDeclarations(FrameGraph const& graph) {
    for (Pass const& pass : graph.passes()) {
        // Ranges first: the other checks count levels and layers by them.
        for (Access const& access : graph.accesses(pass)) checkRange(graph, pass, access);
    }
    // Reads are checked before the writes of their pass count: a pass cannot read what it is about to write.
    Written written(graph);
    for (uint32_t i = 0; i < graph.passes().size(); ++i) {
        written.checkReads(i);
        checkAttachmentsAgree(graph, graph.passes()[i]);
        checkRoles(graph, graph.passes()[i]);
        written.addWrites(i);
    }
}

} // namespace filament_core::framegraph
