// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Validator.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace filament_core::backend {
namespace {

constexpr uint32_t kSpirvMagic = 0x07230203; // SPIR-V 1.x, section 2.3

bool isUniform(BindingType type) {
    return type == BindingType::UniformBuffer || type == BindingType::DynamicUniformBuffer;
}

constexpr TextureUsage kAttachmentUsage =
        TextureUsage::ColorAttachment | TextureUsage::DepthAttachment | TextureUsage::InputAttachment;
constexpr TextureUsage kTransferUsage = TextureUsage::TransferSource | TextureUsage::TransferTarget;
constexpr TextureUsage kOutlivingUsage = TextureUsage::Sampled | kTransferUsage;

bool beginsLikeSpirv(std::span<const std::byte> bytes) {
    uint32_t magic = 0;
    if (bytes.size() < 20 || bytes.size() % 4 != 0) return false;
    std::memcpy(&magic, bytes.data(), sizeof(magic));
    return magic == kSpirvMagic;
}

} // namespace

template <class C, class Tag, class Object>
bool Validator::mayCreate(ObjectTable<Tag, Object> const& table, C const& command, std::string_view name) {
    enter<C>(Place::OutsidePasses, name);
    return require(static_cast<bool>(command.handle), Harm::Crash, "the handle is none; allocate one") &&
           require(!table.occupied(command.handle), Harm::Crash,
                   "handle {:#x} is in use; destroy the object that has it, or allocate another", command.handle.bits);
}

template <class C, class Tag, class Object>
void Validator::destroy(ObjectTable<Tag, Object>& table, C const& command) {
    enter<C>(Place::OutsidePasses);
    if (need(table, command.handle, "object")) table.destroy(command.handle);
}

void Validator::execute(CmdDestroyBuffer const& command) { destroy(mBuffers, command); }
void Validator::execute(CmdDestroyTexture const& command) { destroy(mTextures, command); }
void Validator::execute(CmdDestroySampler const& command) { destroy(mSamplers, command); }
void Validator::execute(CmdDestroyProgram const& command) { destroy(mPrograms, command); }
void Validator::execute(CmdDestroyPipeline const& command) { destroy(mPipelines, command); }
void Validator::execute(CmdDestroyBindGroup const& command) { destroy(mBindGroups, command); }
void Validator::execute(CmdDestroySurface const& command) { destroy(mSurfaces, command); }

// ---------------------------------------------------------------------------------------------- buffers, textures

void Validator::execute(CmdCreateBuffer const& command) {
    BufferDesc const& desc = command.desc;
    if (!mayCreate(mBuffers, command, desc.debugName)) return;
    require(desc.size > 0, Harm::Crash, "the size is 0; a buffer has at least one byte");
    require(static_cast<uint8_t>(desc.usage) != 0, Harm::Crash, "the usage is empty; say what it is for");
    if (mCommandCrashes) return;
    mBuffers.create(command.handle, { std::string(desc.debugName), { desc.size, desc.usage, {} } });
}

void Validator::execute(CmdCreateTexture const& command) {
    DeviceTextureDesc desc = command.desc;
    if (!mayCreate(mTextures, command, desc.debugName)) return;
    if (require(desc.format > Format::None && desc.format < Format::Count, Harm::Crash, "the format is none")) {
        checkTextureShape(desc);
        checkTextureUsage(desc);
    }
    desc.debugName = {};
    if (mCommandCrashes) return;
    mTextures.create(command.handle, { std::string(command.desc.debugName), desc });
}

void Validator::checkTextureShape(DeviceTextureDesc const& desc) {
    const bool is3D = desc.type == TextureKind::Texture3D;
    const uint32_t maxSize = is3D ? mInfo.limits.max3DTextureSize : mInfo.limits.maxTextureSize;
    require(desc.width > 0 && desc.height > 0, Harm::Crash, "{} x {} texels; both must be > 0", desc.width,
            desc.height);
    require(desc.width <= maxSize && desc.height <= maxSize, Harm::Crash,
            "{} x {} texels; this device has at most {} (DeviceLimits::{})", desc.width, desc.height, maxSize,
            is3D ? "max3DTextureSize" : "maxTextureSize");
    if (is3D) {
        require(desc.layers <= maxSize, Harm::Crash,
                "{} slices; this device has at most {} (DeviceLimits::max3DTextureSize)", desc.layers, maxSize);
        require(!isCompressed(desc.format) && !hasDepth(desc.format), Harm::Crash,
                "a 3D texture is uncompressed, and has no depth format; {} is for other kinds",
                formatInfo(desc.format).name);
        require(!has(desc.usage, TextureUsage::InputAttachment | TextureUsage::Transient), Harm::Crash,
                "a 3D texture is no input attachment, and not transient; sample it in a later pass");
    }
    const uint32_t full = fullMipCount(desc);
    require(desc.levels >= 1 && desc.levels <= full, Harm::Crash, "{} levels; {} x {} has 1..{}", desc.levels,
            desc.width, desc.height, full);
    const bool is2D = desc.type == TextureKind::Texture2D;
    require(desc.layers >= 1, Harm::Crash, "0 layers; at least 1");
    require(!is2D || desc.layers == 1, Harm::Crash, "a 2D texture has 1 layer, not {}; use Texture2DArray",
            desc.layers);
    if (desc.type == TextureKind::Cube) {
        require(desc.layers == 6 && desc.width == desc.height, Harm::Crash,
                "a cube has 6 square layers, not {} of {} x {}", desc.layers, desc.width, desc.height);
    }
    if (desc.type == TextureKind::CubeArray) {
        require(mInfo.features.cubeArrays, Harm::Crash,
                "an array of cubes needs DeviceFeatures::cubeArrays, which this device lacks");
        require(desc.layers % 6 == 0 && desc.width == desc.height, Harm::Crash,
                "an array of cubes has 6 square layers per cube, not {} of {} x {}", desc.layers, desc.width,
                desc.height);
    }
    require(desc.samples == 1 || (desc.samples == 4 && mInfo.limits.maxSamples >= 4), Harm::Crash,
            "{} samples; this device does 1 or 4", desc.samples);
    const bool isDrawnAlone = is2D && desc.levels == 1 && has(desc.usage, kAttachmentUsage);
    require(desc.samples == 1 || (isDrawnAlone && !has(desc.usage, kTransferUsage)), Harm::Crash,
            "samples > 1 only for 2D attachments with one level; resolve into another texture to copy it");
    require(!isCompressed(desc.format) || mInfo.features.blockCompression, Harm::Crash,
            "format {} needs DeviceFeatures::blockCompression, which this device lacks", formatInfo(desc.format).name);
}

void Validator::checkTextureUsage(DeviceTextureDesc const& desc) {
    FormatInfo const& format = formatInfo(desc.format);
    if (desc.placedOn) {
        require(mInfo.features.sharedMemory, Harm::Crash,
                "placed on another texture, which needs DeviceFeatures::sharedMemory; this device lacks it");
        require(mTextures.find(desc.placedOn), Harm::Crash, "placed on texture {}, which does not exist",
                desc.placedOn.index());
        require(!has(desc.usage, TextureUsage::Transient), Harm::Crash,
                "placed on another texture, but Transient: tile memory is not shared");
    }
    require(has(desc.usage, kAttachmentUsage | kOutlivingUsage), Harm::Crash, "the usage is empty; say what it is for");
    require(!has(desc.usage, kAttachmentUsage) || format.isRenderable, Harm::Crash,
            "format {} cannot be an attachment; drop the attachment usage or choose a renderable format", format.name);
    require(!has(desc.usage, TextureUsage::ColorAttachment) || !format.isSrgb || mInfo.features.srgbAttachments,
            Harm::Crash,
            "format {} as a colour attachment needs DeviceFeatures::srgbAttachments, which this device lacks",
            format.name);
    require(!has(desc.usage, TextureUsage::ColorAttachment) || !hasDepth(desc.format), Harm::Crash,
            "depth format {} cannot be a colour attachment", format.name);
    require(!has(desc.usage, TextureUsage::DepthAttachment) || hasDepth(desc.format), Harm::Crash,
            "colour format {} cannot be a depth attachment", format.name);
    require(!has(desc.usage, TextureUsage::InputAttachment) || has(desc.usage, TextureUsage::ColorAttachment),
            Harm::Crash, "an input attachment is a colour attachment of the same pass; add ColorAttachment");
    require(!has(desc.usage, TextureUsage::Transient) || !has(desc.usage, kOutlivingUsage), Harm::Crash,
            "a transient texture never outlives its pass; drop Transient, or Sampled and Transfer");
}

void Validator::execute(CmdCreateSampler const& command) {
    if (!mayCreate(mSamplers, command, {})) return;
    require(command.desc.anisotropy >= 1 && command.desc.anisotropy <= 16, Harm::WrongResult,
            "anisotropy {}; it is 1..16", command.desc.anisotropy);
    if (mCommandCrashes) return;
    mSamplers.create(command.handle, { {}, command.desc });
}

// ---------------------------------------------------------------------------------------------- programs, pipelines

bool Validator::checkBindGroupLayout(BindGroupLayout const& layout, std::string_view where) {
    if (!require(layout.count <= kMaxBindings, Harm::Crash, "{}: {} bindings; at most {}", where, layout.count,
                 kMaxBindings)) {
        return false;
    }
    for (uint32_t i = 1; i < layout.count; ++i) {
        const uint8_t before = layout.bindings[i - 1].binding, here = layout.bindings[i].binding;
        require(before < here, Harm::Crash, "{}: binding {} follows {}; a layout ascends", where, here, before);
    }
    for (uint32_t i = 0; i < layout.count; ++i) {
        BindingDesc const& binding = layout.bindings[i];
        require(binding.inputAttachment == 0 || binding.type == BindingType::InputAttachment, Harm::WrongResult,
                "{}: binding {} names an input attachment and is none", where, binding.binding);
        require(!binding.isMultisampled || binding.type == BindingType::SampledTexture, Harm::WrongResult,
                "{}: binding {} is multisampled and no sampled texture", where, binding.binding);
    }
    return require(layout.dynamicCount() <= kMaxDynamicOffsets, Harm::Crash,
                   "{}: {} dynamic buffers; at most {} of one group", where, layout.dynamicCount(), kMaxDynamicOffsets);
}

void Validator::checkStages(ProgramDesc const& desc) {
    const bool isCompute = !desc.compute.empty();
    require(isCompute ? desc.vertex.empty() && desc.fragment.empty() : !desc.vertex.empty() && !desc.fragment.empty(),
            Harm::Crash, "a program has a vertex and a fragment stage, or a compute stage alone");
    // Drivers of Vulkan may crash on other words; those of OpenGL ES refuse text that they cannot compile.
    if (mInfo.backend != Backend::Vulkan) return;
    const bool isSpirv =
            isCompute ? beginsLikeSpirv(desc.compute) : beginsLikeSpirv(desc.vertex) && beginsLikeSpirv(desc.fragment);
    require(isSpirv, Harm::Crash, "not SPIR-V; DeviceInfo::shaderLanguage says which code this device takes");
}

void Validator::checkBindingStages(BindingDesc const& binding, bool isCompute, uint32_t group) {
    const bool seesCompute = (static_cast<uint8_t>(binding.stages) & static_cast<uint8_t>(ShaderStage::Compute)) != 0;
    require(seesCompute == isCompute && (!isCompute || binding.stages == ShaderStage::Compute), Harm::Crash,
            "group {}: binding {} names stages that the program lacks", group, binding.binding);
    require(!isCompute || binding.type != BindingType::InputAttachment, Harm::Crash,
            "group {}: binding {} is an input attachment; a dispatch has none", group, binding.binding);
    require(isCompute || binding.type != BindingType::StorageBuffer || binding.stages == ShaderStage::Fragment,
            Harm::Crash, "group {}: binding {} is a storage buffer; of draws only the fragment stage reads them", group,
            binding.binding);
}

void Validator::execute(CmdCreateProgram const& command) {
    ProgramDesc const& desc = command.desc;
    if (!mayCreate(mPrograms, command, desc.debugName)) return;
    checkStages(desc);
    const bool isCompute = !desc.compute.empty();
    uint32_t textures = 0, vertexTextures = 0, storage = 0; // units are those of a stage
    for (uint32_t group = 0; group < kMaxBindGroups; ++group) {
        if (!checkBindGroupLayout(desc.layout[group], fmt::format("group {}", group))) return;
        for (uint32_t i = 0; i < desc.layout[group].count; ++i) {
            BindingDesc const& binding = desc.layout[group].bindings[i];
            checkBindingStages(binding, isCompute, group);
            const bool isOfVertex = binding.stages == ShaderStage::Vertex;
            (isOfVertex ? vertexTextures : textures) += binding.type == BindingType::SampledTexture;
            storage += binding.type == BindingType::StorageBuffer;
        }
    }
    const uint32_t mostStorage = isCompute ? mInfo.limits.maxStorageBuffers : mInfo.limits.maxFragmentStorageBuffers;
    require(storage <= mostStorage, Harm::Crash, "{} storage buffers; this device has {} blocks", storage, mostStorage);
    textures = std::max(textures, vertexTextures);
    require(textures <= mInfo.limits.maxTextureUnits, Harm::Crash, "{} sampled textures; this device has {} units",
            textures, mInfo.limits.maxTextureUnits);
    for (size_t i = 0; i < desc.constants.size(); ++i) {
        const auto rest = desc.constants.subspan(i + 1);
        require(std::ranges::find(rest, desc.constants[i].id, &ConstantValue::id) == rest.end(), Harm::WrongResult,
                "constant {} is given twice", desc.constants[i].id);
    }
    if (mCommandCrashes) return;
    mPrograms.create(command.handle, { std::string(desc.debugName), desc.layout, isCompute });
}

void Validator::execute(CmdCreatePipeline const& command) {
    PipelineDesc desc = command.desc;
    if (!mayCreate(mPipelines, command, desc.debugName)) return;
    ProgramModel const* program = need(mPrograms, desc.program, "program");
    if (!program) return;
    if (!program->isCompute) checkDrawPipeline(desc, program->layout);
    desc.debugName = {};
    if (mCommandCrashes) return;
    mPipelines.create(command.handle,
                      { std::string(command.desc.debugName), desc, program->layout, program->isCompute });
}

void Validator::checkDrawPipeline(PipelineDesc const& desc, ProgramLayout const& program) {
    checkPassLayout(desc.pass);
    checkVertexLayout(desc.vertices);
    const bool subpassExists =
            require(desc.subpass < std::min<uint32_t>(desc.pass.subpassCount, kMaxSubpasses), Harm::Crash,
                    "subpass {} of {}; count from 0", desc.subpass, desc.pass.subpassCount);
    if (subpassExists) checkPipelineState(desc, program);
}

void Validator::checkVertexLayout(VertexLayout const& layout) {
    const bool counts =
            require(layout.attributeCount <= std::min(kMaxVertexAttributes, mInfo.limits.maxVertexAttributes) &&
                            layout.bufferCount <= kMaxVertexBuffers,
                    Harm::Crash, "{} attributes in {} buffers; at most {} in {}", layout.attributeCount,
                    layout.bufferCount, kMaxVertexAttributes, kMaxVertexBuffers);
    if (!counts) return;
    uint32_t seen = 0;
    for (uint32_t i = 0; i < layout.attributeCount; ++i) {
        VertexAttribute const& at = layout.attributes[i];
        if (!require(at.location < kMaxVertexAttributes && at.buffer < layout.bufferCount, Harm::Crash,
                     "attribute {} reads buffer {} of {}", at.location, at.buffer, layout.bufferCount) ||
            !require(at.format > VertexFormat::None && at.format < VertexFormat::Count, Harm::Crash,
                     "attribute {} has no format", at.location)) {
            continue;
        }
        require((seen >> at.location & 1) == 0, Harm::Crash, "attribute {} is given twice", at.location);
        seen |= 1u << at.location;
        VertexFormatInfo const& format = vertexFormatInfo(at.format);
        const uint32_t stride = layout.buffers[at.buffer].stride;
        const uint32_t unit = std::max(1u, format.bytes / std::max<uint32_t>(1, format.components));
        require(at.offset + format.bytes <= stride, Harm::Crash, "attribute {}: bytes {}..{} of a stride of {}",
                at.location, at.offset, at.offset + format.bytes, stride);
        require(at.offset % unit == 0 && stride % unit == 0, Harm::Crash,
                "attribute {}: offset {} and stride {} must be multiples of {} for {}", at.location, at.offset, stride,
                unit, format.name);
    }
}

void Validator::checkPipelineState(PipelineDesc const& desc, ProgramLayout const& program) {
    SubpassDesc const& subpass = desc.pass.subpasses[desc.subpass];
    DepthStencilState const& depth = desc.depthStencil;
    const bool depthThere = desc.pass.depthFormat != Format::None && subpass.usesDepth;
    require(depth.depthCompare == CompareOp::None || depthThere, Harm::WrongResult,
            "a depth test without a depth attachment; set depthCompare to None or give the pass depth");
    require(!depth.stencilTest || (depthThere && hasStencil(desc.pass.depthFormat)), Harm::WrongResult,
            "a stencil test without stencil; use a depth attachment of format D32FS8");
    require(!desc.raster.depthClamp || mInfo.features.depthClamp, Harm::Crash, "this device has no depth clamp");
    const uint32_t colors = std::min<uint32_t>(desc.pass.colorCount, kMaxColorAttachments);
    for (uint32_t i = 0; i < colors; ++i) {
        require(!desc.blend[i].enabled || formatInfo(desc.pass.colorFormats[i]).kind != FormatKind::UnsignedInteger,
                Harm::Crash, "colour {} is an integer format and cannot blend", i);
    }
    for (BindGroupLayout const& group : program) {
        for (uint32_t i = 0; i < group.count; ++i) {
            BindingDesc const& binding = group.bindings[i];
            if (binding.type != BindingType::InputAttachment) continue;
            require(binding.inputAttachment < colors && (subpass.inputMask >> binding.inputAttachment & 1), Harm::Crash,
                    "the program reads colour {} of the pass; set that bit in inputMask of subpass {}",
                    binding.inputAttachment, desc.subpass);
        }
    }
}

// ---------------------------------------------------------------------------------------------- bind groups

void Validator::execute(CmdCreateBindGroup const& command) {
    BindGroupDesc const& desc = command.desc;
    if (!mayCreate(mBindGroups, command, desc.debugName)) return;
    if (!checkBindGroupLayout(desc.layout, "layout")) return;
    require(desc.entries.size() == desc.layout.count, Harm::Crash, "{} entries for {} bindings; each has exactly one",
            desc.entries.size(), desc.layout.count);
    for (uint32_t i = 0; i < desc.layout.count; ++i) {
        BindingDesc const& binding = desc.layout.bindings[i];
        const auto count = std::ranges::count(desc.entries, binding.binding, &BindGroupEntry::binding);
        if (!require(count == 1, Harm::Crash, "binding {} has {} entries; each has exactly one", binding.binding,
                     count))
            continue;
        checkEntry(binding, *std::ranges::find(desc.entries, binding.binding, &BindGroupEntry::binding));
    }
    if (mCommandCrashes) return;
    mBindGroups.create(command.handle,
                       { std::string(desc.debugName), desc.layout, { desc.entries.begin(), desc.entries.end() } });
}

void Validator::checkEntry(BindingDesc const& binding, BindGroupEntry const& entry) {
    if (isUniform(binding.type))
        checkUniformEntry(entry);
    else if (binding.type == BindingType::StorageBuffer)
        checkStorageEntry(entry);
    else
        checkTextureEntry(binding, entry);
}

void Validator::checkBufferRange(BindGroupEntry const& entry, BufferModel const& buffer, uint32_t alignment,
                                 uint32_t maxBytes, const char* limits) {
    require(entry.offset % alignment == 0, Harm::Crash,
            "binding {}: offset {} is no multiple of {} (DeviceLimits::{}OffsetAlignment)", entry.binding, entry.offset,
            alignment, limits);
    require(entry.size > 0 && entry.size <= maxBytes, Harm::Crash, "binding {}: {} bytes visible; 1..{}", entry.binding,
            entry.size, maxBytes);
    require(entry.offset <= buffer.desc.size && entry.size <= buffer.desc.size - entry.offset, Harm::Crash,
            "binding {}: bytes {}..{} of buffer '{}', which has {}", entry.binding, entry.offset,
            entry.offset + entry.size, buffer.name, buffer.desc.size);
}

void Validator::checkUniformEntry(BindGroupEntry const& entry) {
    BufferModel const* buffer = need(mBuffers, entry.buffer, "uniform buffer");
    if (!buffer) return;
    require(has(buffer->desc.usage, BufferUsage::Uniform), Harm::Crash,
            "binding {}: buffer '{}' lacks BufferUsage::Uniform", entry.binding, buffer->name);
    checkBufferRange(entry, *buffer, mInfo.limits.uniformOffsetAlignment, mInfo.limits.maxUniformBlockBytes, "uniform");
}

void Validator::checkStorageEntry(BindGroupEntry const& entry) {
    BufferModel const* buffer = need(mBuffers, entry.buffer, "storage buffer");
    if (!buffer) return;
    require(has(buffer->desc.usage, BufferUsage::Storage), Harm::Crash,
            "binding {}: buffer '{}' lacks BufferUsage::Storage", entry.binding, buffer->name);
    checkBufferRange(entry, *buffer, mInfo.limits.storageOffsetAlignment, mInfo.limits.maxStorageBlockBytes, "storage");
}

void Validator::checkEntryRange(BindingDesc const& binding, BindGroupEntry const& entry, TextureModel const& texture) {
    DeviceTextureDesc const& desc = texture.desc;
    const TextureRange range = withCounts(entry.range, desc.levels, desc.layers);
    if (!require(exists(range, desc.levels, desc.layers), Harm::Crash,
                 "binding {}: {} levels from {} and {} layers from {} of texture '{}', which has {} and {}",
                 entry.binding, range.levelCount, range.level, range.layerCount, range.layer, texture.name, desc.levels,
                 desc.layers)) {
        return;
    }
    if (binding.type == BindingType::InputAttachment) {
        require(range.levelCount == 1 && range.layerCount == 1, Harm::Crash,
                "binding {}: an input attachment is one level and layer of '{}'; name them in the range", entry.binding,
                texture.name);
        return;
    }
    const bool isWhole = range.levelCount == desc.levels && range.layerCount == desc.layers;
    require(isWhole || mInfo.features.textureViews, Harm::Crash,
            "binding {} shows a part of texture '{}'; this device lacks DeviceFeatures::textureViews", entry.binding,
            texture.name);
    require(desc.type != TextureKind::Texture3D || isWhole, Harm::Crash,
            "binding {}: 3D texture '{}' shows all of its levels and slices", entry.binding, texture.name);
    require(desc.type != TextureKind::Cube || range.layerCount == 6, Harm::Crash,
            "binding {}: cube '{}' shows all of its 6 layers, not {}", entry.binding, texture.name, range.layerCount);
    require(desc.type != TextureKind::CubeArray || (range.layer % 6 == 0 && range.layerCount % 6 == 0), Harm::Crash,
            "binding {}: array of cubes '{}' shows whole cubes, not {} layers from {}", entry.binding, texture.name,
            range.layerCount, range.layer);
}

void Validator::checkTextureEntry(BindingDesc const& binding, BindGroupEntry const& entry) {
    TextureModel const* texture = need(mTextures, entry.texture, "texture");
    if (!texture) return;
    checkEntryRange(binding, entry, *texture);
    if (binding.type == BindingType::InputAttachment) {
        require(has(texture->desc.usage, TextureUsage::InputAttachment), Harm::Crash,
                "binding {}: texture '{}' lacks TextureUsage::InputAttachment", entry.binding, texture->name);
        require(!entry.sampler, Harm::WrongResult, "binding {}: an input attachment has no sampler", entry.binding);
        return;
    }
    require(has(texture->desc.usage, TextureUsage::Sampled), Harm::Crash,
            "binding {}: texture '{}' lacks TextureUsage::Sampled", entry.binding, texture->name);
    require(binding.isMultisampled == (texture->desc.samples > 1), Harm::Crash,
            "binding {}: texture '{}' has {} samples, the layout says {}", entry.binding, texture->name,
            texture->desc.samples, binding.isMultisampled ? "several" : "one");
    SamplerModel const* sampler = need(mSamplers, entry.sampler, "sampler");
    if (!sampler) return;
    const FormatKind kind = formatInfo(texture->desc.format).kind;
    require(sampler->desc.compare == CompareOp::None || kind >= FormatKind::Depth, Harm::WrongResult,
            "binding {}: a comparing sampler needs a depth format, '{}' has {}", entry.binding, texture->name,
            formatInfo(texture->desc.format).name);
    const bool filters = sampler->desc.magFilter == Filter::Linear || sampler->desc.minFilter == Filter::Linear ||
                         sampler->desc.mipFilter == MipFilter::Linear;
    const bool isInteger = kind == FormatKind::UnsignedInteger || kind == FormatKind::SignedInteger;
    require(!filters || !isInteger, Harm::WrongResult,
            "binding {}: integer texture '{}' cannot be filtered; use Nearest", entry.binding, texture->name);
}

// ---------------------------------------------------------------------------------------------- surfaces

void Validator::execute(CmdCreateSurface const& command) {
    SurfaceDesc const& desc = command.desc;
    if (!mayCreate(mSurfaces, command, desc.debugName)) return;
    require(desc.window != 0, Harm::Crash, "the window is none; give it the handle of one");
    if (!mCommandCrashes) mSurfaces.create(command.handle, { std::string(desc.debugName), desc.space });
}

} // namespace filament_core::backend
