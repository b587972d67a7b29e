// SPDX-License-Identifier: Apache-2.0
// The rules of a graph. Every message names the pass, the texture and what to do.
#include "framegraph/CompileSteps.h"
#include "framegraph/Require.h"

#include <algorithm>

namespace filament::framegraph {
namespace {

struct Size {
    uint32_t width = 0, height = 0;
    friend bool operator==(Size, Size) = default;
};

Size sizeOfLevel(GraphTextureDesc const& desc, uint8_t level) {
    return { std::max(1u, desc.width >> level), std::max(1u, desc.height >> level) };
}

/// A later pass that writes the texture, to tell a wrong order from a forgotten pass.
std::string_view laterWriter(FrameGraph const& graph, uint32_t after, TextureId texture) {
    for (uint32_t pass = after + 1; pass < graph.passes().size(); ++pass) {
        for (Access const& access : graph.accesses(graph.passes()[pass])) {
            const bool writes = !isPureRead(access.kind) && (access.texture == texture || access.resolve == texture);
            if (writes) return graph.passes()[pass].name;
        }
    }
    return {};
}

void checkWrittenBefore(FrameGraph const& graph, uint32_t pass, std::span<const bool> written) {
    for (Access const& access : graph.accesses(graph.passes()[pass])) {
        if (!isPureRead(access.kind) || written[access.texture.index()]) continue;
        const std::string_view name = graph.passes()[pass].name, texture = graph.texture(access.texture).desc.name;
        const std::string_view later = laterWriter(graph, pass, access.texture);
        require(!later.empty(),
                "pass '{}' reads texture '{}', which no pass writes: write it, or import it with its contents", name,
                texture);
        require(false, "pass '{}' reads texture '{}' before pass '{}' writes it: declare the writer first", name,
                texture, later);
    }
}

void markWritten(FrameGraph const& graph, uint32_t pass, std::span<bool> written) {
    for (Access const& access : graph.accesses(graph.passes()[pass])) {
        if (isPureRead(access.kind)) continue;
        written[access.texture.index()] = true;
        if (access.resolve) written[access.resolve.index()] = true;
    }
}

void checkAttachment(FrameGraph const& graph, Pass const& pass, Access const& access) {
    GraphTextureDesc const& desc = graph.texture(access.texture).desc;
    require(access.level < desc.levels && access.layer < desc.layers,
            "pass '{}': texture '{}' has {} levels and {} layers; level {}, layer {} is attached", pass.name, desc.name,
            desc.levels, desc.layers, access.level, access.layer);
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
    require(from.format == to.format && sizeOfLevel(from, access.level) == sizeOfLevel(to, 0),
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
        const Size expected = sizeOfLevel(first, reference->level), size = sizeOfLevel(desc, access.level);
        require(size == expected, "pass '{}': attachment '{}' is {} x {}, attachment '{}' is {} x {}", pass.name,
                desc.name, size.width, size.height, first.name, expected.width, expected.height);
        require(desc.samples == first.samples, "pass '{}': attachment '{}' has {} samples, attachment '{}' has {}",
                pass.name, desc.name, desc.samples, first.name, first.samples);
    }
    require((slots & (slots + 1)) == 0, "pass '{}': colour slots have gaps; number them 0, 1, ...", pass.name);
}

// A texture has one role in a pass, except that several levels or layers of it may be attached.
void checkRoles(FrameGraph const& graph, Pass const& pass) {
    const std::span<const Access> accesses = graph.accesses(pass);
    bool attaches = false, transfers = false, reads = false;
    for (size_t i = 0; i < accesses.size(); ++i) {
        Access const& a = accesses[i];
        const std::string_view name = graph.texture(a.texture).desc.name;
        attaches |= isAttachment(a.kind);
        reads |= a.kind == AccessKind::Input;
        require(isAttachment(a.kind) || graph.texture(a.texture).desc.samples == 1,
                "pass '{}': reads multisampled texture '{}'; resolve it and read the target", pass.name, name);
        transfers |= a.kind == AccessKind::TransferRead || a.kind == AccessKind::TransferWrite;
        for (size_t j = 0; j < accesses.size(); ++j) {
            Access const& b = accesses[j];
            require(!isAttachment(a.kind) || b.texture != a.texture || isAttachment(b.kind),
                    "pass '{}': texture '{}' is attached and read at the same time", pass.name, name);
            require(i == j || !isAttachment(a.kind) || !isAttachment(b.kind) || a.texture != b.texture ||
                            a.level != b.level || a.layer != b.layer,
                    "pass '{}': texture '{}' is attached twice", pass.name, name);
            require(!a.resolve || (b.texture != a.resolve && (i == j || b.resolve != a.resolve)),
                    "pass '{}': texture '{}' is a resolve target and something else", pass.name,
                    graph.texture(a.resolve ? a.resolve : a.texture).desc.name);
        }
    }
    require(attaches || !reads, "pass '{}': reads the current pixel of an input, but has no attachments", pass.name);
    require(!attaches || !transfers, "pass '{}': has attachments and transfers; make the transfers a pass of their own",
            pass.name);
}

} // namespace

void checkDeclarations(FrameGraph const& graph) {
    const std::span<bool> written = graph.arena().array<bool>(graph.textures().size());
    for (size_t i = 0; i < written.size(); ++i) {
        Texture const& texture = graph.textures()[i];
        written[i] = texture.isImported && texture.contents == InitialContents::Keep;
    }
    for (uint32_t i = 0; i < graph.passes().size(); ++i) {
        checkWrittenBefore(graph, i, written);
        checkAttachmentsAgree(graph, graph.passes()[i]);
        checkRoles(graph, graph.passes()[i]);
        markWritten(graph, i, written);
    }
}

} // namespace filament::framegraph
