// SPDX-License-Identifier: Apache-2.0
#include "framegraph/Explain.h"

#include "framegraph/Memory.h"

#include <fmt/format.h>

#include <iterator>

namespace filament_core::framegraph {
namespace {

using backend::LoadOp;
using backend::StoreOp;

using Text = std::back_insert_iterator<std::string>;

std::string_view nameOf(CompiledGraph const& plan, TextureId texture) { return plan.graph->texture(texture).desc.name; }

std::string_view nameOf(CompiledGraph const& plan, BufferId buffer) { return plan.graph->buffer(buffer).name; }

/// "'bloom'", with level and layer if it has several.
std::string nameOf(CompiledGraph const& plan, TextureId texture, uint8_t level, uint16_t layer) {
    GraphTextureDesc const& desc = plan.graph->texture(texture).desc;
    std::string name = fmt::format("'{}'", desc.name);
    if (desc.levels > 1) name += fmt::format(" level {}", level);
    if (desc.layers > 1) name += fmt::format(" layer {}", layer);
    return name;
}

/// Which part of its texture an access touches: "level 2", "levels 0 to 4, layer 1"; empty for the whole texture.
std::string partOf(CompiledGraph const& plan, Access const& access) {
    GraphTextureDesc const& desc = plan.graph->texture(access.texture).desc;
    const auto span = [](const char* what, uint32_t first, uint32_t count) {
        return count == 1 ? fmt::format("{} {}", what, first)
                          : fmt::format("{}s {} to {}", what, first, first + count - 1);
    };
    std::string part;
    if (access.range.levelCount < desc.levels) part = span("level", access.range.level, access.range.levelCount);
    if (access.range.layerCount == desc.layers) return part;
    return part + (part.empty() ? "" : ", ") + span("layer", access.range.layer, access.range.layerCount);
}

std::string reasonOf(CompiledGraph const& plan, PassDecision const& decision) {
    switch (decision.reason) {
    case Reason::Unread:
        return "culled: nobody reads what it writes";
    case Reason::SideEffect:
        return "runs: it has a side effect";
    case Reason::WritesOutput:
        if (decision.becauseBuffer)
            return fmt::format("runs: it writes output buffer '{}'", nameOf(plan, decision.becauseBuffer));
        return fmt::format("runs: it writes output {}", nameOf(plan, decision.because, decision.level, decision.layer));
    case Reason::ReadLater:
        if (decision.becauseBuffer)
            return fmt::format("runs: buffer '{}' is read by '{}'", nameOf(plan, decision.becauseBuffer),
                               plan.graph->passes()[decision.reader].name);
        return fmt::format("runs: {} is read by '{}'", nameOf(plan, decision.because, decision.level, decision.layer),
                           plan.graph->passes()[decision.reader].name);
    }
    return {};
}

const char* mergeOf(Merge merge) {
    switch (merge) {
    case Merge::NotAsked:
        return "";
    case Merge::Merged:
        return "; merged with the pass before it";
    case Merge::DeviceCannot:
        return "; not merged: the device has no merged passes";
    case Merge::NotBefore:
        return "; not merged: the pass before it did not write all of its inputs";
    case Merge::DifferentSize:
        return "; not merged: the sizes differ";
    case Merge::Multisampled:
        return "; not merged: multisampled";
    case Merge::OtherAttachments:
        return "; not merged: its program numbers its attachments otherwise";
    case Merge::ReadsElsewhere:
        return "; not merged: an attachment is also sampled";
    case Merge::ClearsAgain:
        return "; not merged: it clears an attachment that is in use";
    case Merge::DifferentDepth:
        return "; not merged: it needs another depth attachment";
    case Merge::TooManyAttachments:
        return "; not merged: too many colour attachments";
    case Merge::TooManySubpasses:
        return "; not merged: too many subpasses";
    }
    return "";
}

const char* nameOf(LoadOp load) { return load == LoadOp::Load ? "load" : load == LoadOp::Clear ? "clear" : "discard"; }
const char* nameOf(StoreOp store) { return store == StoreOp::Store ? "store" : "discard"; }

void putAttachment(Text text, CompiledGraph const& plan, std::string_view role, GroupAttachment const& attachment) {
    fmt::format_to(text, "    {} {}: {}, {}", role,
                   nameOf(plan, attachment.texture, attachment.level, attachment.layer), nameOf(attachment.load),
                   nameOf(attachment.store));
    if (attachment.resolve) fmt::format_to(text, ", resolve to '{}'", nameOf(plan, attachment.resolve));
    fmt::format_to(text, "\n");
}

void putPasses(Text text, CompiledGraph const& plan) {
    fmt::format_to(text, "passes: {} declared, {} run in {} groups\n", plan.passes.size(), plan.order.size(),
                   plan.groups.size());
    for (size_t i = 0; i < plan.passes.size(); ++i) {
        fmt::format_to(text, "  {} '{}' {}\n", i, plan.graph->passes()[i].name, describePass(plan, i));
    }
}

// Reads of parts of textures. Reads of whole textures appear only in the drawing.
void putPartReads(Text text, CompiledGraph const& plan, PassGroup const& group) {
    for (const uint32_t pass : plan.order.subspan(group.first, group.count)) {
        for (Access const& access : plan.graph->accesses(plan.graph->passes()[pass])) {
            if (isAttachment(access.kind)) continue;
            const std::string part = partOf(plan, access);
            if (part.empty()) continue;
            fmt::format_to(text, "    {} '{}' {}\n", isPureRead(access.kind) ? "reads" : "writes",
                           nameOf(plan, access.texture), part);
        }
    }
}

void putGroups(Text text, CompiledGraph const& plan) {
    fmt::format_to(text, "groups:\n");
    for (size_t i = 0; i < plan.groups.size(); ++i) {
        PassGroup const& group = plan.groups[i];
        if (!group.hasAttachments()) {
            fmt::format_to(text, "  {} '{}' outside of passes\n", i, group.name);
            putPartReads(text, plan, group);
            continue;
        }
        fmt::format_to(text, "  {} '{}' {} x {}, {} sample(s), {} subpass(es)\n", i, group.name, group.width,
                       group.height, group.samples, group.count);
        for (uint32_t c = 0; c < group.colorCount; ++c)
            putAttachment(text, plan, fmt::format("colour {}", c), group.colors[c]);
        if (group.depth.texture) putAttachment(text, plan, "depth", group.depth);
        putPartReads(text, plan, group);
    }
}

const char* originOf(Texture const& texture) {
    if (texture.history != HistoryRole::None) return ", history";
    return texture.isImported ? ", imported" : texture.isOutput ? ", output" : "";
}

// Other transients in the same memory.
void putSharing(Text text, CompiledGraph const& plan, size_t texture) {
    const char* before = ", shares memory with ";
    for (size_t i = 0; i < plan.textures.size(); ++i) {
        if (i == texture || plan.textures[i].memory != plan.textures[texture].memory) continue;
        fmt::format_to(text, "{}'{}'", before, plan.graph->textures()[i].desc.name);
        before = ", ";
    }
}

void putTextures(Text text, CompiledGraph const& plan) {
    fmt::format_to(text, "textures:\n");
    for (size_t i = 0; i < plan.textures.size(); ++i) {
        Texture const& texture = plan.graph->textures()[i];
        TexturePlan const& of = plan.textures[i];
        fmt::format_to(text, "  '{}' {} x {} {}", texture.desc.name, texture.desc.width, texture.desc.height,
                       backend::formatInfo(texture.desc.format).name);
        if (texture.desc.samples > 1) fmt::format_to(text, " {} samples", texture.desc.samples);
        fmt::format_to(text, "{}", originOf(texture));
        if (!of.lifetime.isUsed()) {
            fmt::format_to(text, ", unused\n");
            continue;
        }
        fmt::format_to(text, ", groups {} to {}", of.lifetime.first, of.lifetime.last);
        if (has(of.usage, backend::TextureUsage::Transient)) fmt::format_to(text, ", never leaves the tile");
        if (texture.history == HistoryRole::Current) fmt::format_to(text, ", kept for the next frame");
        if (texture.history == HistoryRole::Previous && of.historyAge == 0)
            fmt::format_to(text, ", no frame before: cleared");
        if (texture.history == HistoryRole::Previous && of.historyAge > 0)
            fmt::format_to(text, ", written {} graph(s) ago", of.historyAge);
        if (of.memory != kNone) putSharing(text, plan, i);
        fmt::format_to(text, "\n");
    }
}

void putMemory(Text text, CompiledGraph const& plan) {
    const AttachmentMemory memory = attachmentMemory(plan);
    constexpr double kMegabyte = 1e6;
    const double all = static_cast<double>(memory.bytes + memory.saved);
    fmt::format_to(text,
                   "memory: {:.2f} MB of textures, {:.2f} MB of them in the tile; sharing saves {:.2f} MB, {:.0f} %\n",
                   static_cast<double>(memory.bytes) / kMegabyte, static_cast<double>(memory.inTile) / kMegabyte,
                   static_cast<double>(memory.saved) / kMegabyte,
                   all > 0 ? 100 * static_cast<double>(memory.saved) / all : 0.0);
}

const char* nameOf(BufferUse use) {
    switch (use) {
    case BufferUse::Storage:
        return "storage";
    case BufferUse::Uniform:
        return "uniforms";
    case BufferUse::Vertex:
        return "vertices";
    case BufferUse::Index:
        return "indices";
    case BufferUse::Transfer:
        return "transfer";
    }
    return "";
}

void putBuffers(Text text, CompiledGraph const& plan) {
    if (plan.buffers.empty()) return;
    fmt::format_to(text, "buffers:\n");
    for (size_t i = 0; i < plan.buffers.size(); ++i) {
        Buffer const& buffer = plan.graph->buffers()[i];
        BufferPlan const& of = plan.buffers[i];
        fmt::format_to(text, "  '{}' {} bytes{}", buffer.name, buffer.size,
                       buffer.isImported ? ", imported"
                       : buffer.isOutput ? ", output"
                                         : "");
        if (!of.lifetime.isUsed()) {
            fmt::format_to(text, ", unused\n");
            continue;
        }
        fmt::format_to(text, ", groups {} to {}", of.lifetime.first, of.lifetime.last);
        const char* before = ", shares memory with ";
        for (size_t j = 0; j < plan.buffers.size() && !buffer.isImported; ++j) {
            if (j == i || plan.buffers[j].handle != of.handle) continue;
            fmt::format_to(text, "{}'{}'", before, plan.graph->buffers()[j].name);
            before = ", ";
        }
        fmt::format_to(text, "\n");
    }
}

// ---------------------------------------------------------------------------------------------- graphviz

std::string escaped(std::string_view name) {
    std::string result;
    for (const char c : name) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

void putPassNode(Text text, CompiledGraph const& plan, uint32_t pass, const char* indent) {
    fmt::format_to(text, "{}p{} [shape=box, label=\"{}\"{}];\n", indent, pass, escaped(plan.graph->passes()[pass].name),
                   plan.passes[pass].runs() ? "" : ", style=dashed");
}

void putPassNodes(Text text, CompiledGraph const& plan) {
    for (uint32_t pass = 0; pass < plan.passes.size(); ++pass) {
        const bool merged = plan.passes[pass].runs() && plan.groups[plan.passes[pass].group].count > 1;
        if (!merged) putPassNode(text, plan, pass, "  ");
    }
    for (size_t i = 0; i < plan.groups.size(); ++i) {
        if (plan.groups[i].count < 2) continue;
        fmt::format_to(text, "  subgraph cluster_{} {{\n    label=\"merged\";\n", i);
        for (const uint32_t pass : plan.order.subspan(plan.groups[i].first, plan.groups[i].count)) {
            putPassNode(text, plan, pass, "    ");
        }
        fmt::format_to(text, "  }}\n");
    }
}

void putEdges(Text text, CompiledGraph const& plan) {
    for (size_t pass = 0; pass < plan.passes.size(); ++pass) {
        for (Access const& access : plan.graph->accesses(plan.graph->passes()[pass])) {
            std::string label = partOf(plan, access);
            if (access.kind == AccessKind::Input) label += label.empty() ? "pixel" : ", pixel";
            if (!label.empty()) label = fmt::format(" [label=\"{}\"]", label);
            if (isPureRead(access.kind)) {
                fmt::format_to(text, "  t{} -> p{}{};\n", access.texture.index(), pass, label);
            } else {
                fmt::format_to(text, "  p{} -> t{}{};\n", pass, access.texture.index(), label);
            }
            if (access.resolve)
                fmt::format_to(text, "  p{} -> t{} [label=\"resolve\"];\n", pass, access.resolve.index());
        }
        for (BufferAccess const& access : plan.graph->bufferAccesses(plan.graph->passes()[pass])) {
            const char* form =
                    access.writes ? "  p{1} -> b{0} [label=\"{2}\"];\n" : "  b{0} -> p{1} [label=\"{2}\"];\n";
            fmt::format_to(text, fmt::runtime(form), access.buffer.index(), pass, nameOf(access.use));
        }
    }
}

} // namespace

std::string describePass(CompiledGraph const& plan, size_t pass) {
    PassDecision const& decision = plan.passes[pass];
    return reasonOf(plan, decision) + mergeOf(decision.merge);
}

std::string toText(CompiledGraph const& plan) {
    std::string result;
    const Text text(result);
    putPasses(text, plan);
    putGroups(text, plan);
    putTextures(text, plan);
    putMemory(text, plan);
    putBuffers(text, plan);
    return result;
}

std::string toGraphviz(CompiledGraph const& plan) {
    std::string result;
    const Text text(result);
    fmt::format_to(text, "digraph frame {{\n  rankdir=LR;\n");
    putPassNodes(text, plan);
    for (size_t i = 0; i < plan.textures.size(); ++i) {
        Texture const& texture = plan.graph->textures()[i];
        fmt::format_to(text, "  t{} [shape=ellipse, label=\"{}\\n{} x {} {}\"{}];\n", i, escaped(texture.desc.name),
                       texture.desc.width, texture.desc.height, backend::formatInfo(texture.desc.format).name,
                       texture.isOutput ? ", peripheries=2" : "");
    }
    for (size_t i = 0; i < plan.buffers.size(); ++i) {
        Buffer const& buffer = plan.graph->buffers()[i];
        fmt::format_to(text, "  b{} [shape=cylinder, label=\"{}\\n{} bytes\"{}];\n", i, escaped(buffer.name),
                       buffer.size, buffer.isOutput ? ", peripheries=2" : "");
    }
    putEdges(text, plan);
    fmt::format_to(text, "}}\n");
    return result;
}

} // namespace filament_core::framegraph
