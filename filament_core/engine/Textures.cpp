// SPDX-License-Identifier: Apache-2.0
// Textures, buffers and targets: public descriptions -> commands.
#include "backend/stream/RecordingGuards.h"
#include "base/ApiCall.h"
#include "base/Log.h"
#include "filament_core/assets/image/MipMaps.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/RequiredAttributes.h"
#include "filament_core/engine/materials/TextureParameters.h"
#include "filament_core/scene/VertexPositions.h"

#include <algorithm>

namespace filament_core {

using engine::PublicCall;

namespace {

using namespace backend;

constexpr uint32_t kMostLayers = 2048; // of the desktop's drivers; devices may have fewer

backend::DeviceTextureDesc backendDesc(filament_core::TextureDesc const& desc) {
    FILAMENT_ASSERT(desc.width > 0 && desc.height > 0 && desc.layers > 0 && desc.levels > 0,
                    "a texture has at least one texel, layer and level");
    FILAMENT_ASSERT(desc.layers <= kMostLayers, "a texture has at most 2048 layers");
    FILAMENT_ASSERT(desc.kind != TextureKind::Cube || (desc.layers == 6 && desc.width == desc.height),
                    "a cube has six square layers");
    FILAMENT_ASSERT(desc.kind != TextureKind::CubeArray || (desc.layers % 6 == 0 && desc.width == desc.height),
                    "an array of cubes has six square layers per cube");
    FILAMENT_ASSERT(desc.kind != TextureKind::Texture3D || (!desc.generateMips && !isCompressed(desc.format)),
                    "a 3D texture has an uncompressed format, and all of its levels in `pixels`, or draws them");
    FILAMENT_ASSERT(!desc.renderable || formatInfo(desc.format).isRenderable,
                    "a renderable texture, or a swap chain, has a format that passes can write");
    TextureUsage usage = TextureUsage::Sampled | TextureUsage::TransferTarget | TextureUsage::TransferSource;
    if (desc.renderable) usage = usage | TextureUsage::ColorAttachment;
    backend::DeviceTextureDesc device{ .type = desc.kind,
                                       .format = desc.format,
                                       .usage = usage,
                                       .levels = static_cast<uint8_t>(desc.levels),
                                       .layers = static_cast<uint16_t>(desc.layers),
                                       .width = desc.width,
                                       .height = desc.height };
    const uint32_t full = fullMipCount(device);
    FILAMENT_ASSERT(desc.levels <= full, "a texture has at most floor(log2(size)) + 1 levels");
    if (desc.generateMips) device.levels = static_cast<uint8_t>(full);
    return device;
}

/// With or without a copy of the command's bytes.
template <class C>
void recordBytes(CommandBuffer& commands, C const& command, engine::BytesOwner const& owner) {
    if (owner)
        commands.recordAdopted(command);
    else
        commands.record(command);
}

// One upload per level; all layers of a level are contiguous.
void uploadLevels(CommandBuffer& commands, TextureHandle handle, filament_core::TextureDesc const& desc,
                  engine::BytesOwner const& owner) {
    if (owner) commands.keep(owner);
    const DeviceTextureDesc layered{ .type = desc.kind, .layers = static_cast<uint16_t>(desc.layers) };
    const uint32_t levels = desc.generateMips ? 1 : desc.levels;
    size_t offset = 0;
    for (uint32_t level = 0; level < levels; ++level) {
        const uint32_t width = std::max(1u, desc.width >> level), height = std::max(1u, desc.height >> level);
        const uint32_t layers = layersOfLevel(layered, level);
        const size_t bytes = imageBytes(desc.format, width, height) * layers;
        FILAMENT_ASSERT(offset + bytes <= desc.pixels.size(), "`pixels` holds all layers of all levels");
        recordBytes(commands,
                    CmdUploadTexture{ handle,
                                      static_cast<uint8_t>(level),
                                      0,
                                      static_cast<uint16_t>(layers),
                                      { 0, 0, width, height },
                                      desc.pixels.subspan(offset, bytes) },
                    owner);
        offset += bytes;
    }
}

/// sRGB is not encoded by the driver: Mesa's CPU drivers use the processor's estimate of the reciprocal square root,
/// whose bits differ between processors (docs/conformance.md).
bool makesMipsHere(filament_core::TextureDesc const& desc) {
    return desc.generateMips && desc.format == Format::RGBA8Srgb;
}

assets::Image mipsOf(filament_core::TextureDesc const& desc) {
    assets::Image base{ .width = desc.width, .height = desc.height, .layers = desc.layers };
    FILAMENT_ASSERT(base.levelBytes(0) <= desc.pixels.size(), "`pixels` holds all layers of level 0");
    const auto level0 = desc.pixels.first(base.levelBytes(0));
    base.data.assign(level0.begin(), level0.end());
    return assets::withMipMaps(std::move(base), true);
}

void uploadPixels(CommandBuffer& commands, TextureHandle handle, filament_core::TextureDesc const& desc,
                  engine::BytesOwner const& owner) {
    if (!makesMipsHere(desc)) {
        uploadLevels(commands, handle, desc, owner);
        if (desc.generateMips) commands.record(CmdGenerateMips{ handle });
        return;
    }
    const auto mips = std::make_shared<const assets::Image>(mipsOf(desc));
    filament_core::TextureDesc whole = desc;
    whole.levels = mips->levels, whole.generateMips = false, whole.pixels = mips->data;
    uploadLevels(commands, handle, whole, mips);
}

void recordBuffer(Engine::Impl& engine, BufferHandle handle, BufferUsage usage, std::span<const std::byte> data,
                  std::string const& name, engine::BytesOwner const& owner) {
    engine.pending.record(CmdCreateBuffer{ handle, { data.size(), usage, name } });
    if (owner) engine.pending.keep(owner);
    recordBytes(engine.pending, CmdUpdateBuffer{ handle, 0, data }, owner);
}

// The driver would also reject it, but only after all of its uses have been recorded.
bool fitsDevice(Engine::Impl& engine, filament_core::TextureDesc const& desc) {
    const bool is3D = desc.kind == TextureKind::Texture3D;
    const uint32_t most = is3D ? engine.device.max3DTextureSize : engine.device.maxTextureSize;
    if (std::max({ desc.width, desc.height, is3D ? desc.layers : 1u }) <= most) return true;
    const std::string size = is3D ? fmt::format("{} x {} x {}", desc.width, desc.height, desc.layers)
                                  : fmt::format("{} x {}", desc.width, desc.height);
    engine.report(
            fmt::format("texture '{}': {} texels; this device supports at most {} per side: it has no texels, and "
                        "drawing to it and reading from it are skipped",
                        desc.name, size, most));
    return false;
}

} // namespace

Texture Engine::Impl::createTexture(filament_core::TextureDesc const& desc, engine::BytesOwner const& holder) {
    engine::Draft draft(textures);
    engine::TextureState& state = draft.state();
    state.desc = backendDesc(desc);
    state.name = desc.name;
    if (!fitsDevice(*this, desc)) return draft.keep();
    backend::DeviceTextureDesc created = state.desc;
    created.debugName = state.name;
    NewHandle handle(*stream, stream->allocateTexture());
    // A texture without its texels would show what the memory held before: both commands are recorded, or none.
    AllOrNothing all(pending);
    pending.record(CmdCreateTexture{ handle, created });
    if (!desc.pixels.empty()) uploadPixels(pending, handle, desc, holder);
    all.complete();
    state.handle = handle.keep();
    state.hasContents = !desc.pixels.empty();
    return draft.keep();
}

namespace {

/// Of the vertices that every device takes (OpenGL ES 3.1, table 20.40; Vulkan's required limits).
constexpr uint32_t kMostStride = 2048;
static_assert(kMaxVertexStreams < kMaxVertexBuffers, "the instance index is one more");

void requireNew(VertexLayout const& layout, Attribute attribute, uint8_t stream) {
    for (VertexAttribute const& known : std::span(layout.attributes).first(layout.attributeCount)) {
        if (known.location != static_cast<uint8_t>(attribute)) continue;
        misused(fmt::format("streams {} and {} both have attribute {}; a vertex has each of them once", known.buffer,
                            stream, engine::nameOf(attribute)));
    }
}

/// The next stream of the layout.
void addStream(VertexLayout& layout, uint32_t vertexCount, uint32_t stride,
               std::vector<AttributeDesc> const& attributes, std::span<const std::byte> data) {
    const uint8_t stream = layout.bufferCount++;
    FILAMENT_ASSERT(vertexCount > 0 && stride > 0 && stride % 4 == 0,
                    "a vertex buffer has vertices and a stride that is a multiple of 4");
    FILAMENT_ASSERT(stride <= kMostStride, "a stride is at most 2048 bytes");
    if (data.size() != static_cast<size_t>(vertexCount) * stride) {
        if (stream == 0) misused("`data` holds vertexCount * stride bytes");
        misused(fmt::format(
                "stream {} has {} bytes, which is not {} vertices of {} bytes: streams have as many vertices "
                "as the buffer",
                stream, data.size(), vertexCount, stride));
    }
    FILAMENT_ASSERT(layout.attributeCount + attributes.size() < kMaxVertexAttributes, "at most 15 vertex attributes");
    layout.buffers[stream].stride = static_cast<uint16_t>(stride);
    for (AttributeDesc const& attribute : attributes) {
        const uint32_t bytes = vertexFormatInfo(attribute.format).bytes;
        FILAMENT_ASSERT(bytes <= stride && attribute.offset <= stride - bytes,
                        "an attribute lies inside of the stride");
        requireNew(layout, attribute.attribute, stream);
        layout.attributes[layout.attributeCount++] = { static_cast<uint8_t>(attribute.attribute), stream,
                                                       attribute.format, static_cast<uint16_t>(attribute.offset) };
    }
}

VertexLayout layoutOf(VertexBufferDesc const& desc) {
    if (desc.streams.size() >= kMaxVertexStreams)
        misused(fmt::format("{} vertex streams, but at most {} can be bound", desc.streams.size() + 1,
                            kMaxVertexStreams));
    VertexLayout layout;
    addStream(layout, desc.vertexCount, desc.stride, desc.attributes, desc.data);
    for (VertexStreamDesc const& stream : desc.streams) {
        if (stream.attributes.empty()) misused("a vertex stream has an attribute");
        addStream(layout, desc.vertexCount, stream.stride, stream.attributes, stream.data);
    }
    return layout;
}

/// Of the positions, in whichever stream they are.
scene::MinMax boundsOf(VertexLayout const& layout, VertexBufferDesc const& desc) {
    scene::MinMax bounds = scene::boundsOf(layout, desc.data);
    for (size_t i = 0; i < desc.streams.size() && bounds.empty(); ++i)
        bounds = scene::boundsOf(layout, desc.streams[i].data, static_cast<uint8_t>(i + 1));
    return bounds;
}

} // namespace

VertexBuffer Engine::Impl::createVertexBuffer(VertexBufferDesc const& desc, engine::BytesOwner const& holder,
                                              std::optional<scene::MinMax> const& bounds) {
    const VertexLayout layout = layoutOf(desc);
    engine::Draft draft(vertexBuffers);
    engine::VertexBufferState& state = draft.state();
    state.layout = layout;
    state.vertexCount = desc.vertexCount;
    state.bounds = bounds ? *bounds : boundsOf(layout, desc);
    state.name = desc.name;
    // All streams, or none: a handle that is kept has a buffer.
    NewHandle first(*stream, stream->allocateBuffer());
    std::array<std::optional<NewHandle<BufferTag>>, kMaxVertexStreams - 1> others;
    for (size_t i = 0; i < desc.streams.size(); ++i) others[i].emplace(*stream, stream->allocateBuffer());
    AllOrNothing all(pending);
    recordBuffer(*this, first, BufferUsage::Vertex | BufferUsage::TransferSource, desc.data, desc.name, holder);
    for (size_t i = 0; i < desc.streams.size(); ++i)
        recordBuffer(*this, *others[i], BufferUsage::Vertex | BufferUsage::TransferSource, desc.streams[i].data,
                     desc.name, {});
    all.complete();
    state.handle = first.keep();
    for (size_t i = 0; i < desc.streams.size(); ++i) state.streams[i] = others[i]->keep();
    return draft.keep();
}

IndexBuffer Engine::Impl::createIndexBuffer(IndexBufferDesc const& desc, engine::BytesOwner const& holder) {
    const size_t bytes = static_cast<size_t>(desc.indexCount) * (desc.format == IndexFormat::UInt16 ? 2 : 4);
    FILAMENT_ASSERT(desc.indexCount > 0 && desc.data.size() == bytes, "`data` holds indexCount indices, at least one");
    engine::Draft draft(indexBuffers);
    engine::IndexBufferState& state = draft.state();
    state.format = desc.format;
    state.indexCount = desc.indexCount;
    state.name = desc.name;
    NewHandle handle(*stream, stream->allocateBuffer());
    AllOrNothing both(pending);
    recordBuffer(*this, handle, BufferUsage::Index | BufferUsage::TransferSource, desc.data, desc.name, holder);
    both.complete();
    state.handle = handle.keep();
    return draft.keep();
}

// ---------------------------------------------------------------------------------------------- the public functions

Texture Engine::create(filament_core::TextureDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(TextureDesc)", desc.name);
    return mImpl->orNone("texture", desc.name, [&] { return mImpl->createTexture(desc); });
}

VertexBuffer Engine::create(VertexBufferDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(VertexBufferDesc)", desc.name);
    return mImpl->orNone("vertex buffer", desc.name, [&] { return mImpl->createVertexBuffer(desc); });
}

IndexBuffer Engine::create(IndexBufferDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(IndexBufferDesc)", desc.name);
    return mImpl->orNone("index buffer", desc.name, [&] { return mImpl->createIndexBuffer(desc); });
}

IndirectLight Engine::create(IndirectLightDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(IndirectLightDesc)", desc.name);
    return mImpl->orNone("indirect light", desc.name, [&] {
        FILAMENT_ASSERT(desc.specularLevels >= 1, "an indirect light has at least one specular level");
        engine::Draft draft(mImpl->indirectLights);
        engine::IndirectLightState& state = draft.state();
        state.light.specular = mImpl->textureHandle(desc.specular);
        if (desc.irradiance) state.light.irradiance = mImpl->textureHandle(desc.irradiance);
        state.light.storage = { .isRgbm = mImpl->textures.get(desc.specular).desc.format == Format::RGBA8,
                                .hasIrradianceCube = static_cast<bool>(desc.irradiance),
                                .mapping = desc.mapping };
        DeviceTextureDesc const& cube = mImpl->textures.get(desc.specular).desc;
        state.light.shape = { .format = cube.format, .size = cube.width, .levels = cube.levels };
        state.light.levelOfRoughnessOne = static_cast<float>(desc.specularLevels - 1);
        state.light.irradianceSh = desc.irradianceSh;
        state.light.worldFromCube = desc.worldFromCube;
        state.name = desc.name;
        return draft.keep();
    });
}

Skybox Engine::create(SkyboxDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(SkyboxDesc)", desc.name);
    return mImpl->orNone("skybox", desc.name, [&] {
        engine::Draft draft(mImpl->skyboxes);
        engine::TextureState const& cube = mImpl->textures.get(desc.cube);
        draft.state() = { cube.handle, cube.desc.format == Format::RGBA8, desc.worldFromCube, desc.name };
        return draft.keep();
    });
}

namespace {

uint2 sizeOfLevel(DeviceTextureDesc const& desc, uint32_t level) {
    return { std::max(1u, desc.width >> level), std::max(1u, desc.height >> level) };
}

bool isRenderable(DeviceTextureDesc const& desc) { return has(desc.usage, TextureUsage::ColorAttachment); }

bool isPicture(DeviceTextureDesc const& desc, uint2 size) {
    return desc.type == TextureKind::Texture2D && isRenderable(desc) && uint2(desc.width, desc.height) == size;
}

void checkTarget(engine::HandleTable<TextureObject, engine::TextureState> const& textures,
                 RenderTargetDesc const& desc) {
    FILAMENT_ASSERT(desc.color, "a render target has a colour");
    DeviceTextureDesc const& color = textures.get(desc.color).desc;
    const bool isShown = attachmentFormat(color.format) == Format::RGBA8 || color.format == Format::RGB10A2;
    const bool isFloat = color.format == Format::RGBA16F || color.format == Format::RGBA32F;
    FILAMENT_ASSERT(isRenderable(color) && (isShown || isFloat),
                    "the colour of a render target is a renderable texture of RGBA8, RGBA8Srgb, RGB10A2, RGBA16F or "
                    "RGBA32F");
    FILAMENT_ASSERT(desc.level < color.levels && desc.layer < color.layers,
                    "the level and the layer of a render target are those of its colour");
    if (desc.layer >= layersOfLevel(color, desc.level))
        misused(fmt::format("level {} of a 3D texture has {} slices, and the render target is slice {}", desc.level,
                            layersOfLevel(color, desc.level), desc.layer));
    FILAMENT_ASSERT(!desc.generateMips || color.type != TextureKind::Texture3D,
                    "mips of a 3D texture are not generated; draw to the slices of each level");
    FILAMENT_ASSERT(!desc.generateMips || (desc.level == 0 &&
                                           (!formatInfo(color.format).isSrgb || color.type == TextureKind::Texture2D)),
                    "a render target that generates mips draws to level 0, and to a 2D texture if it is RGBA8Srgb");
    FILAMENT_ASSERT(!desc.generateMips || color.levels > 1,
                    "the colour of a render target that generates mips has several levels");
    const uint2 size = sizeOfLevel(color, desc.level);
    FILAMENT_ASSERT(desc.others.size() <= 3, "a render target has at most three other colours");
    for (const Texture other : desc.others)
        FILAMENT_ASSERT(isPicture(textures.get(other).desc, size),
                        "other colours of a render target are renderable 2D textures, as large as what is drawn");
    if (!desc.depth) return;
    DeviceTextureDesc const& depth = textures.get(desc.depth).desc;
    FILAMENT_ASSERT(isPicture(depth, size) && depth.format == Format::R32F,
                    "the depth of a render target is a renderable 2D texture of R32F, as large as what is drawn");
}

} // namespace

RenderTarget Engine::create(RenderTargetDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(RenderTargetDesc)", desc.name);
    checkTarget(mImpl->textures, desc);
    return mImpl->orNone("render target", desc.name, [&] {
        engine::Draft draft(mImpl->renderTargets);
        draft.state() = { .color = desc.color,
                          .depth = desc.depth,
                          .generateMips = desc.generateMips,
                          .level = static_cast<uint8_t>(desc.level),
                          .layer = static_cast<uint16_t>(desc.layer),
                          .others = desc.others,
                          .hasContents = mImpl->textures.get(desc.color).hasContents,
                          .name = desc.name };
        return draft.keep();
    });
}

Texture Engine::colorOf(RenderTarget target) const {
    const PublicCall call(mImpl, "Engine::colorOf(RenderTarget)");
    const Texture color = mImpl->renderTargets.get(target).color;
    return mImpl->textures.isLive(color) ? color : Texture{};
}

Texture Engine::depthOf(RenderTarget target) const {
    const PublicCall call(mImpl, "Engine::depthOf(RenderTarget)");
    const Texture depth = mImpl->renderTargets.get(target).depth;
    return mImpl->textures.isLive(depth) ? depth : Texture{};
}

} // namespace filament_core
