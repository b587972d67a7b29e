// SPDX-License-Identifier: Apache-2.0
#include "framegraph/FrameGraph.h"

#include "framegraph/Require.h"

#include <algorithm>

namespace filament_core::framegraph {
namespace {

Previous previousOf(bool clears, bool overwrites) {
    return clears ? Previous::Clear : overwrites ? Previous::Overwrite : Previous::Keep;
}

} // namespace

// ---------------------------------------------------------------------------------------------- graph

void FrameGraph::reset() {
    mPasses.clear();
    mTextures.clear();
    mBuffers.clear();
    mAccesses.clear();
    mBufferAccesses.clear();
}

TextureId FrameGraph::addTexture(Texture const& texture) {
    GraphTextureDesc const& desc = texture.desc;
    require(!desc.name.empty(), "a texture of a frame graph has a name");
    require(desc.format != backend::Format::None && desc.width > 0 && desc.height > 0,
            "texture '{}': needs a format and a size of at least 1 x 1", desc.name);
    require(mTextures.size() < 0xFFFF, "texture '{}': a frame graph holds 65 535 textures", desc.name);
    mTextures.push_back(texture);
    return { static_cast<uint32_t>(mTextures.size()) };
}

TextureId FrameGraph::createTexture(GraphTextureDesc const& desc) { return addTexture({ .desc = desc }); }

TextureId FrameGraph::importTexture(backend::TextureHandle texture, GraphTextureDesc const& desc,
                                    InitialContents contents) {
    require(static_cast<bool>(texture), "texture '{}': imported without a handle", desc.name);
    return addTexture(
            { .desc = desc, .imported = texture, .isImported = true, .contents = contents, .isOutput = true });
}

BufferId FrameGraph::addBuffer(Buffer const& buffer) {
    require(!buffer.name.empty(), "a buffer of a frame graph has a name");
    require(buffer.size > 0, "buffer '{}': needs at least one byte", buffer.name);
    require(mBuffers.size() < 0xFFFF, "buffer '{}': a frame graph holds 65 535 buffers", buffer.name);
    mBuffers.push_back(buffer);
    return { static_cast<uint32_t>(mBuffers.size()) };
}

BufferId FrameGraph::createBuffer(std::string_view name, uint64_t size) {
    return addBuffer({ .name = name, .size = size });
}

BufferId FrameGraph::importBuffer(backend::BufferHandle buffer, std::string_view name, uint64_t size,
                                  InitialContents contents) {
    require(static_cast<bool>(buffer), "buffer '{}': imported without a handle", name);
    return addBuffer({ .name = name,
                       .size = size,
                       .imported = buffer,
                       .isImported = true,
                       .contents = contents,
                       .isOutput = true });
}

void FrameGraph::markOutput(BufferId buffer) {
    require(buffer && buffer.index() < mBuffers.size(), "markOutput: the buffer belongs to another graph or frame");
    mBuffers[buffer.index()].isOutput = true;
}

History FrameGraph::history(GraphTextureDesc const& desc, std::array<float, 4> const& clear, bool beginsAnew) {
    require(backend::formatInfo(desc.format).isRenderable && desc.samples == 1,
            "history '{}': needs a renderable format and one sample a pixel", desc.name);
    for (Texture const& other : mTextures) {
        require(other.history != HistoryRole::Current || other.desc.name != desc.name,
                "history '{}': declared twice in one graph; declare it once and hand on its textures", desc.name);
    }
    constexpr std::string_view kPrevious = "previous ";
    const std::span<char> name = mArena.array<char>(kPrevious.size() + desc.name.size());
    desc.name.copy(std::ranges::copy(kPrevious, name.data()).out, desc.name.size());
    GraphTextureDesc previous = desc;
    previous.name = { name.data(), name.size() };
    return { .previous = addTexture({ .desc = previous,
                                      .contents = InitialContents::Keep,
                                      .history = HistoryRole::Previous,
                                      .clear = clear,
                                      .beginsAnew = beginsAnew }),
             .current = addTexture({ .desc = desc, .isOutput = true, .history = HistoryRole::Current }) };
}

void FrameGraph::markOutput(TextureId texture) {
    require(texture && texture.index() < mTextures.size(), "markOutput: the texture belongs to another graph or frame");
    mTextures[texture.index()].isOutput = true;
}

PassBuilder FrameGraph::beginPass(std::string_view name, PassCode code) {
    require(!name.empty(), "a pass has a name");
    require(mPasses.size() < 0xFFFF, "pass '{}': a frame graph holds 65 535 passes", name);
    mPasses.push_back({ .name = name,
                        .code = code,
                        .firstAccess = static_cast<uint32_t>(mAccesses.size()),
                        .firstBufferAccess = static_cast<uint32_t>(mBufferAccesses.size()) });
    return { *this, static_cast<uint32_t>(mPasses.size() - 1) };
}

Pass& FrameGraph::newest(uint32_t pass) {
    Pass& of = mPasses[pass];
    require(pass + 1 == mPasses.size(), "pass '{}': declare its textures inside its set-up, not later", of.name);
    return of;
}

void FrameGraph::declare(uint32_t pass, BufferAccess const& access) {
    Pass& of = newest(pass);
    require(access.buffer && access.buffer.index() < mBuffers.size(),
            "pass '{}': declares a buffer of another graph or frame", of.name);
    mBufferAccesses.push_back(access);
    ++of.bufferAccessCount;
}

void FrameGraph::declare(uint32_t pass, Access access) {
    Pass& of = newest(pass);
    require(access.texture && access.texture.index() < mTextures.size(),
            "pass '{}': declares a texture of another graph or frame", of.name);
    GraphTextureDesc const& desc = mTextures[access.texture.index()].desc;
    access.range = withCounts(access.range, desc.levels, desc.layers);
    mAccesses.push_back(access);
    ++of.accessCount;
}

// ---------------------------------------------------------------------------------------------- builder

void PassBuilder::writeColor(uint8_t slot, TextureId texture, ColorTarget const& target) {
    mGraph.declare(mPass, Access{ .texture = texture,
                                  .kind = AccessKind::Color,
                                  .previous = previousOf(target.clear.has_value(), target.overwrites),
                                  .slot = slot,
                                  .range = { target.level, 1, target.layer, 1 },
                                  .clear = target.clear.value_or(std::array<float, 4>{}),
                                  .resolve = target.resolve });
}

void PassBuilder::writeDepth(TextureId texture, DepthTarget const& target) {
    mGraph.declare(mPass,
                   Access{ .texture = texture,
                           .kind = AccessKind::Depth,
                           .previous = previousOf(target.clear.has_value(), target.overwrites),
                           .range = { target.level, 1, target.layer, 1 },
                           .clear = { target.clear.value_or(0.0f), static_cast<float>(target.clearStencil), 0, 0 },
                           .resolve = target.resolve });
}

void PassBuilder::testDepth(TextureId texture, uint8_t level, uint16_t layer) {
    mGraph.declare(mPass, Access{ .texture = texture, .kind = AccessKind::DepthTest, .range = { level, 1, layer, 1 } });
}

void PassBuilder::readSampled(TextureId texture, backend::TextureRange range) {
    mGraph.declare(mPass, Access{ .texture = texture, .kind = AccessKind::Sampled, .range = range });
}

void PassBuilder::readInput(TextureId texture, uint8_t attachment, uint8_t level, uint16_t layer) {
    mGraph.declare(mPass, Access{ .texture = texture,
                                  .kind = AccessKind::Input,
                                  .slot = attachment,
                                  .range = { level, 1, layer, 1 } });
}

void PassBuilder::readTransfer(TextureId texture, backend::TextureRange range) {
    mGraph.declare(mPass, Access{ .texture = texture, .kind = AccessKind::TransferRead, .range = range });
}

void PassBuilder::writeTransfer(TextureId texture, backend::TextureRange range) {
    mGraph.declare(mPass, Access{ .texture = texture, .kind = AccessKind::TransferWrite, .range = range });
}

void PassBuilder::readBuffer(BufferId buffer, BufferUse use) {
    mGraph.declare(mPass, BufferAccess{ .buffer = buffer, .use = use });
}

void PassBuilder::writeBuffer(BufferId buffer, BufferUse use, Previous previous) {
    mGraph.declare(mPass, BufferAccess{ .buffer = buffer, .use = use, .writes = true, .previous = previous });
}

void PassBuilder::sideEffect() { mGraph.declareSideEffect(mPass); }

} // namespace filament_core::framegraph
