// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/Pipelines.h"

#include "filament_core/base/Log.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>

namespace filament::passes {
namespace {

using namespace backend;

constexpr uint32_t kNoGeometry = 0xFFF;

// always 1 | pass 2 bits | material 20 | geometry layout 12 | slot 12 | variant 8 | culling off 1 | mirrored 1
uint64_t makeKey(uint32_t material, uint32_t geometryLayout, uint32_t slot, uint8_t variant, bool cullingDisabled,
                 bool mirrored) {
    FILAMENT_ASSERT(material < 1u << 20 && geometryLayout <= kNoGeometry && slot < 4096,
                    "at most 2^20 materials, 4095 vertex layouts and 4096 passes with their shading");
    return uint64_t{ 1 } << 63 | static_cast<uint64_t>(material) << 34 | static_cast<uint64_t>(geometryLayout) << 22 |
           static_cast<uint64_t>(slot) << 10 | static_cast<uint64_t>(variant) << 2 |
           static_cast<uint64_t>(cullingDisabled) << 1 | static_cast<uint64_t>(mirrored);
}

// Lights and shading select nothing in an unlit material.
bool isLit(scene::Material const& material) { return material.package.shading != shader::ShadingModel::Unlit; }

uint8_t neededVariant(scene::Material const& material, uint8_t variant) { return isLit(material) ? variant : 0; }

// Materials without such variants are lit in full.
uint16_t withPrecision(scene::Material const& material, uint8_t variant, ShadingPrecision precision) {
    const auto half = static_cast<uint16_t>(variant | shader::kVariantHalf);
    return precision == ShadingPrecision::Half && material.package.findVariant(half) ? half : variant;
}

uint64_t makeKey(uint32_t slot, PipelineUse const& use) {
    scene::Material const& material = *use.instance.material;
    return static_cast<uint64_t>(use.pass) << 54 |
           makeKey(material.id, use.geometryLayout, slot, neededVariant(material, use.variant),
                   use.instance.cullingDisabled, use.mirrored);
}

CullMode cullMode(shader::MaterialPackage const& package, bool cullingDisabled) {
    if (cullingDisabled) return CullMode::None;
    switch (package.culling) {
    case shader::Culling::None:
        return CullMode::None;
    case shader::Culling::Front:
        return CullMode::Front;
    case shader::Culling::Back:
        return CullMode::Back;
    case shader::Culling::FrontAndBack:
        return CullMode::Back; // what is left leaves no trace: see drawsNothing()
    }
    return CullMode::Back;
}

bool drawsNothing(shader::MaterialPackage const& package, bool cullingDisabled) {
    return package.culling == shader::Culling::FrontAndBack && !cullingDisabled;
}

// Colours are pre-multiplied (DESIGN: conventions); coverage accumulates in alpha.
BlendState blendState(shader::MaterialPackage const& package) {
    BlendState over{ .enabled = true,
                     .srcColor = BlendFactor::One,
                     .dstColor = BlendFactor::OneMinusSrcAlpha,
                     .srcAlpha = BlendFactor::One,
                     .dstAlpha = BlendFactor::OneMinusSrcAlpha };
    shader::BlendFunction const& custom = package.blendFunction;
    switch (package.blending) {
    case shader::Blending::Opaque:
    case shader::Blending::Masked:
        return {};
    case shader::Blending::Transparent:
    case shader::Blending::Fade:
        return over;
    case shader::Blending::Add:
        over.dstColor = over.dstAlpha = BlendFactor::One;
        return over;
    case shader::Blending::Multiply:
        over.srcColor = BlendFactor::Zero, over.dstColor = BlendFactor::SrcColor;
        over.srcAlpha = BlendFactor::Zero, over.dstAlpha = BlendFactor::SrcAlpha;
        return over;
    case shader::Blending::Screen:
        over.dstColor = BlendFactor::OneMinusSrcColor, over.dstAlpha = BlendFactor::OneMinusSrcAlpha;
        return over;
    case shader::Blending::Custom:
        over.srcColor = custom.sourceColor, over.dstColor = custom.targetColor;
        over.srcAlpha = custom.sourceAlpha, over.dstAlpha = custom.targetAlpha;
        return over;
    }
    return over;
}

// Materials guide, 4.2.18. The second of two equal depths passes: both passes run the same vertex stage.
void usePass(PipelineDesc& desc, shader::TransparencyMode transparency, prepare::DrawPass pass) {
    if (pass == prepare::DrawPass::Only) return;
    const bool isFirst = pass == prepare::DrawPass::First;
    if (transparency == shader::TransparencyMode::TwoPassesTwoSides) {
        desc.raster.cull = isFirst ? CullMode::Front : CullMode::Back;
    } else if (isFirst) {
        desc.depthStencil.depthWrite = desc.depthStencil.depthCompare != CompareOp::None;
        for (BlendState& blend : desc.blend) blend = { .writeMask = 0 };
    }
}

// The geometry's own attributes, then the instance index in the next buffer slot.
VertexLayout withInstanceIndex(VertexLayout layout) {
    FILAMENT_ASSERT(layout.bufferCount < kMaxVertexBuffers && layout.attributeCount < kMaxVertexAttributes,
                    "a vertex layout leaves room for the instance index");
    layout.attributes[layout.attributeCount++] = { shader::kAttributeInstance, layout.bufferCount, VertexFormat::UInt,
                                                   0 };
    layout.buffers[layout.bufferCount++] = { sizeof(uint32_t), true };
    return layout;
}

} // namespace

uint32_t PipelineCache::slot(PassSlot const& slot) {
    const auto found = std::find(mSlots.begin(), mSlots.end(), slot);
    if (found != mSlots.end()) return static_cast<uint32_t>(found - mSlots.begin());
    mSlots.push_back(slot);
    return static_cast<uint32_t>(mSlots.size() - 1);
}

ProgramHandle PipelineCache::programFor(CommandBuffer& setup, scene::Material& material, uint16_t variant,
                                        ShadingKey shading) {
    const uint32_t key = static_cast<uint32_t>(shading) << 16 | variant;
    for (scene::MaterialProgram const& program : material.programs) {
        if (program.key == key) return program.handle;
    }
    shader::Variant const* code = material.package.findVariant(variant);
    if (!code) {
        log(Severity::Warning, "material '{}' was compiled without variant {} (variantFilter): it is not drawn",
            material.name, variant);
        return {};
    }
    material.programs.push_back({ key, {} });
    try {
        material.programs.back().handle = createProgram(setup, material, *code, shading);
    } catch (...) {
        material.programs.pop_back(); // known is what is recorded
        throw;
    }
    return material.programs.back().handle;
}

ProgramHandle PipelineCache::createProgram(CommandBuffer& setup, scene::Material const& material,
                                           shader::Variant const& code, ShadingKey shading) {
    std::vector<ConstantValue> constants = material.constants;
    if (shading != 0) { // else: the program's own defaults
        for (ConstantValue const& constant : shadingConstants(shading)) constants.push_back(constant);
    }
    const bool spirv = mStream.info().shaderLanguage == ShaderLanguage::SpirV;
    ProgramDesc desc{ .constants = constants, .layout = material.package.layout, .debugName = material.name };
    desc.vertex = spirv ? std::as_bytes(std::span(code.vertexSpirv)) : std::as_bytes(std::span(code.vertexEssl));
    desc.fragment = spirv ? std::as_bytes(std::span(code.fragmentSpirv)) : std::as_bytes(std::span(code.fragmentEssl));
    NewHandle program(mStream, mStream.allocateProgram());
    setup.record(CmdCreateProgram{ program, desc });
    return program.keep();
}

PipelineDesc PipelineCache::describe(PassSlot const& slot, scene::Material const& material, bool cullingDisabled,
                                     uint32_t geometryLayout, bool mirrored) const {
    shader::MaterialPackage const& package = material.package;
    PipelineDesc desc{ .pass = slot.layout, .subpass = slot.subpass, .debugName = material.name };
    desc.raster.cull = cullMode(package, cullingDisabled);
    desc.raster.frontFace = mirrored ? FrontFace::Clockwise : FrontFace::CounterClockwise;
    desc.raster.alphaToCoverage = package.alphaToCoverage && slot.layout.samples > 1;
    if (geometryLayout != kNoGeometry) {
        desc.vertices = withInstanceIndex(mLayouts[geometryLayout].vertices);
        desc.raster.topology = mLayouts[geometryLayout].topology;
    }
    const bool hasDepth = slot.layout.depthFormat != Format::None && slot.layout.subpasses[slot.subpass].usesDepth;
    if (hasDepth && package.depthCulling) {
        // Equal passes too: the sky sits exactly at the far plane, decals exactly on their surface.
        desc.depthStencil.depthCompare =
                slot.depthRange == DepthRange::Reversed ? CompareOp::GreaterEqual : CompareOp::LessEqual;
        desc.depthStencil.depthWrite = package.depthWrite && !drawsNothing(package, cullingDisabled);
    }
    BlendState blend = blendState(package);
    if (!package.colorWrite || drawsNothing(package, cullingDisabled)) blend.writeMask = 0;
    desc.blend.fill(blend);
    return desc;
}

PipelineHandle PipelineCache::create(CommandBuffer& setup, uint64_t key, PipelineDesc const& desc, uint32_t material) {
    mPipelines.reserveOne(); // known is what is recorded
    NewHandle handle(mStream, mStream.allocatePipeline());
    setup.record(CmdCreatePipeline{ handle, desc });
    mPipelines.insert({ key, handle, material });
    return handle.keep();
}

std::optional<PipelineHandle> PipelineCache::find(uint32_t slot, PipelineUse const& use) const {
    PipelineTable::Entry const* entry = mPipelines.find(makeKey(slot, use));
    return entry ? std::optional(entry->handle) : std::nullopt;
}

PipelineHandle PipelineCache::pipelineFor(CommandBuffer& setup, uint32_t slot, PipelineUse const& use) {
    const uint64_t key = makeKey(slot, use);
    if (PipelineTable::Entry const* entry = mPipelines.find(key)) return entry->handle;

    scene::Material& material = *use.instance.material;
    const ShadingKey shading = isLit(material) ? mSlots[slot].shading : ShadingKey{ 0 };
    const uint16_t needed = withPrecision(material, neededVariant(material, use.variant), mSlots[slot].precision);
    const ProgramHandle program = programFor(setup, material, needed, shading);
    if (!program) {
        mPipelines.insert({ key, {}, material.id }); // warn once
        return {};
    }
    PipelineDesc desc =
            describe(mSlots[slot], material, use.instance.cullingDisabled, use.geometryLayout, use.mirrored);
    usePass(desc, material.package.transparency, use.pass);
    desc.program = program;
    return create(setup, key, desc, material.id);
}

PipelineHandle PipelineCache::fullscreenPipeline(CommandBuffer& setup, uint32_t slot, scene::Material& material) {
    const uint64_t key = makeKey(material.id, kNoGeometry, slot, 0, true, false);
    if (PipelineTable::Entry const* entry = mPipelines.find(key)) return entry->handle;
    PipelineDesc desc = describe(mSlots[slot], material, true, kNoGeometry, false);
    desc.program = programFor(setup, material, 0, 0);
    FILAMENT_ASSERT(desc.program, "a full-screen material has variant 0");
    return create(setup, key, desc, material.id);
}

void PipelineCache::forget(CommandBuffer& commands, scene::Material& material) {
    mPipelines.eraseIf([&](PipelineTable::Entry const& entry) {
        if (entry.material != material.id) return false;
        if (entry.handle) {
            mStream.destroy(commands, entry.handle);
        }
        return true;
    });
    for (scene::MaterialProgram const& program : material.programs) mStream.destroy(commands, program.handle);
    material.programs.clear();
}

} // namespace filament::passes
