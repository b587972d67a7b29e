// SPDX-License-Identifier: Apache-2.0
/// What to create, as plain values: every field has a default, a zero description is valid or says why not.
///   All are trivially copyable; spans and names point into the command buffer that carries them (the recorder copies).
#pragma once

#include "backend/api/Format.h"
#include "backend/api/Handles.h"
#include "backend/api/TextureRange.h"

#include <filament_core/NativeWindow.h>
#include <filament_core/OutputSpace.h>
#include <filament_core/Sampler.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace filament_core::backend {

inline constexpr uint32_t kMaxColorAttachments = 8;
inline constexpr uint32_t kMaxSubpasses = 4;
inline constexpr uint32_t kMaxVertexAttributes = 16;
inline constexpr uint32_t kMaxVertexBuffers = 4;
inline constexpr uint32_t kMaxBindGroups = 4;     ///< what every Vulkan device can bind at a time
inline constexpr uint32_t kMaxBindings = 25;      ///< of one group: a block and 24 textures
inline constexpr uint32_t kMaxDynamicOffsets = 4; ///< of one group

struct Rect {
    int32_t x = 0, y = 0; ///< row 0 is the top row
    uint32_t width = 0, height = 0;
    friend bool operator==(Rect const&, Rect const&) = default;
};

struct Viewport {
    float x = 0, y = 0, width = 0, height = 0; ///< pixels, row 0 is the top row; depth range is always [0, 1]
    friend bool operator==(Viewport const&, Viewport const&) = default;
};

// ---------------------------------------------------------------------------------------------- buffers

enum class BufferUsage : uint8_t {
    Vertex = 1,
    Index = 2,
    Uniform = 4,
    Storage = 8,         ///< read and written by dispatches, read by fragment shaders
    TransferSource = 16, ///< read back
};
constexpr BufferUsage operator|(BufferUsage a, BufferUsage b) {
    return static_cast<BufferUsage>(static_cast<uint8_t>(a) | static_cast<uint8_t>(b));
}
constexpr bool has(BufferUsage set, BufferUsage bit) {
    return (static_cast<uint8_t>(set) & static_cast<uint8_t>(bit)) != 0;
}

struct BufferDesc {
    uint64_t size = 0; ///< bytes, > 0
    BufferUsage usage = BufferUsage::Vertex;
    std::string_view debugName;
};

// ---------------------------------------------------------------------------------------------- textures

constexpr bool isCube(TextureKind type) { return type == TextureKind::Cube || type == TextureKind::CubeArray; }

enum class TextureUsage : uint8_t {
    Sampled = 1,
    ColorAttachment = 2,
    DepthAttachment = 4,
    InputAttachment = 8, ///< read by a later subpass of the same pass
    TransferSource = 16, ///< blit from, read back, generate mips
    TransferTarget = 32, ///< upload, blit to, generate mips
    Transient = 64,      ///< never outlives one pass: may live in tile memory only
};
constexpr TextureUsage operator|(TextureUsage a, TextureUsage b) {
    return static_cast<TextureUsage>(static_cast<uint8_t>(a) | static_cast<uint8_t>(b));
}
constexpr bool has(TextureUsage set, TextureUsage bit) {
    return (static_cast<uint8_t>(set) & static_cast<uint8_t>(bit)) != 0;
}

struct DeviceTextureDesc {
    /// Texture3D: uncompressed colours, not blitted: its texels are uploaded or drawn, one slice a pass. What commands
    /// call layers are its slices; deeper levels have fewer.
    TextureKind type = TextureKind::Texture2D;
    Format format = Format::RGBA8;
    TextureUsage usage = TextureUsage::Sampled;
    uint8_t samples = 1; ///< 1 or 4; > 1 only for 2D attachments with one level, which may be sampled, but not copied
    uint8_t levels = 1;  ///< 1..fullMipCount
    uint16_t layers = 1; ///< array layers; a cube has 6 (+x -x +y -y +z -z, the order of both APIs); slices of level 0
    uint32_t width = 1, height = 1;
    std::string_view debugName;
    /// Another texture, whose memory this one takes if it is large enough and of the right kind: of those that share
    /// it, the one that a pass or a transfer wrote last has contents. The memory lives as long as one of them. With
    /// DeviceFeatures::sharedMemory only, and not together with TextureUsage::Transient.
    TextureHandle placedOn{};
};

/// Layers of one level: slices of a 3D texture are halved, others stay.
uint32_t layersOfLevel(DeviceTextureDesc const& desc, uint32_t level);
/// The most levels that such a texture may have.
uint32_t fullMipCount(DeviceTextureDesc const& desc);

/// Of all levels, layers and samples, tightly packed.
uint64_t textureBytes(DeviceTextureDesc const& desc);

using filament_core::Filter;
using filament_core::MipFilter;
using filament_core::WrapMode;

/// `None`: an ordinary sampler without comparison.
enum class CompareOp : uint8_t { None, Never, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always };

/// Unlike the public Sampler it filters and repeats nothing by default: passes read most textures texel by texel, and
/// traces leave out what is as here.
struct SamplerDesc {
    Filter magFilter = Filter::Nearest;
    Filter minFilter = Filter::Nearest;
    MipFilter mipFilter = MipFilter::None;
    WrapMode wrapU = WrapMode::ClampToEdge;
    WrapMode wrapV = WrapMode::ClampToEdge;
    WrapMode wrapW = WrapMode::ClampToEdge;
    CompareOp compare = CompareOp::None;
    uint8_t anisotropy = 1; ///< 1..16
    friend bool operator==(SamplerDesc const&, SamplerDesc const&) = default;
};

// ---------------------------------------------------------------------------------------------- programs

enum class ShaderStage : uint8_t { Vertex = 1, Fragment = 2, Both = 3, Compute = 4 };

enum class BindingType : uint8_t {
    UniformBuffer,        ///< offset fixed in the bind group
    DynamicUniformBuffer, ///< plus an offset given with each CmdBindGroup
    SampledTexture,       ///< texture and sampler together
    InputAttachment,      ///< the pixel that an earlier subpass wrote; no sampler
    StorageBuffer,        ///< offset fixed in the bind group; dispatches read and write it, fragment shaders read it
};

struct BindingDesc {
    uint8_t binding = 0;
    BindingType type = BindingType::UniformBuffer;
    ShaderStage stages = ShaderStage::Both;
    uint8_t inputAttachment = 0; ///< InputAttachment only: index of the colour attachment it reads
    /// SampledTexture only: a texture of several samples a texel, which shaders fetch one by one (sampler2DMS).
    bool isMultisampled = false;
    friend bool operator==(BindingDesc const&, BindingDesc const&) = default;
};

/// The shape of one bind group: `count` bindings, ascending by `binding`.
struct BindGroupLayout {
    std::array<BindingDesc, kMaxBindings> bindings{};
    uint8_t count = 0;
    friend bool operator==(BindGroupLayout const&, BindGroupLayout const&) = default;

    uint32_t dynamicCount() const {
        uint32_t dynamic = 0;
        for (uint32_t i = 0; i < count; ++i) dynamic += bindings[i].type == BindingType::DynamicUniformBuffer;
        return dynamic;
    }
};

/// By group index; unused groups have count 0. The lower the index, the longer a group stays bound: Vulkan keeps the
/// groups below the first one whose layout differs from the last pipeline's.
using ProgramLayout = std::array<BindGroupLayout, kMaxBindGroups>;

/// OpenGL ES knows no groups: uniform blocks, storage blocks and textures are numbered on, each kind by itself, group
/// after group, in the order of the layout. The shader compiler and the GLES driver both number with this function, and
/// nothing else.
///   Returns the block index for uniform and storage buffers, the texture unit for sampled textures; 0xFF if there is
///   none.
uint8_t flatBinding(ProgramLayout const& layout, uint32_t group, uint8_t binding);

/// A specialisation constant: bool, int and float travel as 32 bits.
struct ConstantValue {
    uint32_t id = 0;
    uint32_t bits = 0;
    enum class Type : uint8_t { Bool, Int, Float } type = Type::Bool;
};

struct ProgramDesc {
    /// SPIR-V words (Vulkan) or ESSL text (GLES): as DeviceInfo::shaderLanguage requires.
    std::span<const std::byte> vertex;
    std::span<const std::byte> fragment;
    std::span<const std::byte> compute; ///< alone: a program for CmdDispatch
    std::span<const ConstantValue> constants;
    ProgramLayout layout{};
    std::string_view debugName;
};

// ---------------------------------------------------------------------------------------------- passes

/// What one subpass does with the attachments of its pass; bit i stands for colour attachment i.
struct SubpassDesc {
    uint8_t colorMask = 0xFF; ///< written; bits beyond colorCount are ignored
    uint8_t inputMask = 0;    ///< read at the current pixel: subpass input on Vulkan, framebuffer fetch on GLES
    bool usesDepth = true;    ///< tests or writes the depth attachment, if the pass has one
    friend bool operator==(SubpassDesc const&, SubpassDesc const&) = default;
};

/// What a pipeline must know about the pass it draws in. Equal layouts are compatible.
///   Rules   samples > 1 excludes subpassCount > 1; resolveMask needs samples > 1.
struct PassLayout {
    std::array<Format, kMaxColorAttachments> colorFormats{}; ///< attachmentFormat() of the textures
    Format depthFormat = Format::None;
    uint8_t colorCount = 0;
    uint8_t samples = 1;
    uint8_t resolveMask = 0;    ///< colour attachments with a resolve target: the average of the samples
    bool resolvesDepth = false; ///< the depth attachment has one: the value of sample 0
    uint8_t subpassCount = 1;
    std::array<SubpassDesc, kMaxSubpasses> subpasses{};
    friend bool operator==(PassLayout const&, PassLayout const&) = default;
};

enum class LoadOp : uint8_t { Load, Clear, Discard };
enum class StoreOp : uint8_t { Store, Discard };

struct Attachment {
    TextureHandle texture;
    uint8_t level = 0;
    uint16_t layer = 0;
    LoadOp load = LoadOp::Clear;
    StoreOp store = StoreOp::Store;
    std::array<float, 4> clear{}; ///< colour, or {depth, stencil, -, -}
    TextureHandle resolve;        ///< single-sampled target, level 0 layer 0; the stencil of one is undefined then
};

/// Attachment i of `colors` is stored as layout.colorFormats[i]: attachmentFormat(). All have the size of `area` or are
/// larger.
struct PassDesc {
    PassLayout layout{};
    std::array<Attachment, kMaxColorAttachments> colors{};
    Attachment depth{};
    Rect area{}; ///< pixels outside keep their values only with LoadOp::Load
    std::string_view debugName;
};

// ---------------------------------------------------------------------------------------------- pipelines

struct VertexAttribute {
    uint8_t location = 0;
    uint8_t buffer = 0; ///< slot of CmdBindVertexBuffers
    VertexFormat format = VertexFormat::None;
    uint16_t offset = 0;
    friend bool operator==(VertexAttribute const&, VertexAttribute const&) = default;
};

struct VertexBufferLayout {
    uint16_t stride = 0;
    bool perInstance = false;
    friend bool operator==(VertexBufferLayout const&, VertexBufferLayout const&) = default;
};

/// Attributes that the program reads and the layout lacks read as (0, 0, 0, 1) on both APIs.
struct VertexLayout {
    std::array<VertexAttribute, kMaxVertexAttributes> attributes{};
    std::array<VertexBufferLayout, kMaxVertexBuffers> buffers{};
    uint8_t attributeCount = 0;
    uint8_t bufferCount = 0;
    friend bool operator==(VertexLayout const&, VertexLayout const&) = default;
};

enum class CullMode : uint8_t { None, Front, Back };
/// As seen in the image (row 0 at the top), on both APIs.
enum class FrontFace : uint8_t { CounterClockwise, Clockwise };

struct RasterState {
    PrimitiveType topology = PrimitiveType::Triangles;
    CullMode cull = CullMode::Back;
    FrontFace frontFace = FrontFace::CounterClockwise;
    bool depthClamp = false;
    float depthBiasConstant = 0;
    float depthBiasSlope = 0;
    bool alphaToCoverage = false;
    friend bool operator==(RasterState const&, RasterState const&) = default;
};

enum class StencilOp : uint8_t {
    Keep,
    Zero,
    Replace,
    IncrementClamp,
    DecrementClamp,
    Invert,
    IncrementWrap,
    DecrementWrap
};

struct StencilFace {
    CompareOp compare = CompareOp::Always;
    StencilOp fail = StencilOp::Keep;
    StencilOp depthFail = StencilOp::Keep;
    StencilOp pass = StencilOp::Keep;
    uint8_t readMask = 0xFF;
    uint8_t writeMask = 0xFF;
    friend bool operator==(StencilFace const&, StencilFace const&) = default;
};

/// The reference value is dynamic: CmdSetStencilReference.
struct DepthStencilState {
    CompareOp depthCompare = CompareOp::None; ///< None: no depth test, no depth write
    bool depthWrite = false;
    bool stencilTest = false;
    StencilFace front{}, back{};
    friend bool operator==(DepthStencilState const&, DepthStencilState const&) = default;
};

enum class BlendFactor : uint8_t {
    Zero,
    One,
    SrcColor,
    OneMinusSrcColor,
    DstColor,
    OneMinusDstColor,
    SrcAlpha,
    OneMinusSrcAlpha,
    DstAlpha,
    OneMinusDstAlpha,
    SrcAlphaSaturate,
};
enum class BlendOp : uint8_t { Add, Subtract, ReverseSubtract, Min, Max };

struct BlendState {
    bool enabled = false;
    BlendFactor srcColor = BlendFactor::One, dstColor = BlendFactor::Zero;
    BlendFactor srcAlpha = BlendFactor::One, dstAlpha = BlendFactor::Zero;
    BlendOp colorOp = BlendOp::Add, alphaOp = BlendOp::Add;
    uint8_t writeMask = 0xF; ///< bit 0 red .. bit 3 alpha
    friend bool operator==(BlendState const&, BlendState const&) = default;
};

/// A colour attachment that the program has no output for keeps its contents. Of a pipeline for CmdDispatch only the
/// program and the name count.
struct PipelineDesc {
    ProgramHandle program;
    PassLayout pass{};
    uint8_t subpass = 0;
    VertexLayout vertices{};
    RasterState raster{};
    DepthStencilState depthStencil{};
    std::array<BlendState, kMaxColorAttachments> blend{}; ///< by colour attachment index of the pass
    std::string_view debugName;
};

// ---------------------------------------------------------------------------------------------- bind groups

struct BindGroupEntry {
    uint8_t binding = 0;
    BufferHandle buffer; ///< uniform and storage buffers
    uint64_t offset = 0; ///< bytes, a multiple of DeviceLimits::uniformOffsetAlignment or storageOffsetAlignment
    uint32_t size = 0;   ///< bytes visible to the shader, <= DeviceLimits::maxUniformBlockBytes or maxStorageBlockBytes
    TextureHandle texture; ///< sampled textures and input attachments
    SamplerHandle sampler; ///< sampled textures
    /// What the shader sees of the texture: its level 0 and layer 0 are the first ones of the range. Cubes show all
    /// their layers; an input attachment is one level and layer. A pass may attach other parts of a texture that it
    /// samples.
    TextureRange range{};
    friend bool operator==(BindGroupEntry const&, BindGroupEntry const&) = default;
};

/// Immutable once made. Every binding of the layout has exactly one entry.
struct BindGroupDesc {
    BindGroupLayout layout{};
    std::span<const BindGroupEntry> entries;
    std::string_view debugName;
};

// ---------------------------------------------------------------------------------------------- windows

struct SurfaceDesc {
    uint64_t window = 0; ///< NativeWindow::handle, of the window system of DriverOptions::display
    PresentMode presentMode = PresentMode::Fifo; ///< Fifo where the device has no such mode
    OutputSpace space = OutputSpace::Srgb;       ///< how the window reads what is presented to it
    float peakNits = 203; ///< cd/m^2 of the brightest pixel, which displays are told of with Rec2020Pq
    /// Set: the surface is only asked, and nothing is presented to it. Answered as a read-back: a byte for each
    /// OutputSpace that the window can have; none: it cannot be opened.
    Ticket spaces{};
    uint64_t gate = 0; ///< a number of WindowGate.h; 0: presenting waits for the window
    std::string_view debugName;
};

} // namespace filament_core::backend
