// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/RasterStates.h"

#include "base/Assert.h"
#include "shaders/interface/ShaderInterface.h"

#include <array>

namespace filament_core::passes {
namespace {

using namespace backend;

CullMode cullMode(scene::InstanceRaster const& raster) {
    if (raster.cullingDisabled) return CullMode::None;
    switch (raster.culling) {
    case shader::Culling::None:
        return CullMode::None;
    case shader::Culling::Front:
        return CullMode::Front;
    case shader::Culling::Back:
        return CullMode::Back;
    case shader::Culling::FrontAndBack:
        return CullMode::Back; // the remaining faces have no effect: see drawsNothing()
    }
    return CullMode::Back;
}

bool drawsNothing(scene::InstanceRaster const& raster) {
    return raster.culling == shader::Culling::FrontAndBack && !raster.cullingDisabled;
}

// Equal depths pass, too: the sky lies exactly on the far plane, decals exactly on their surface. Devices write no
// depth while the test is off, so "no test" is a test that always passes.
DepthStencilState depthState(scene::InstanceRaster const& raster, DepthRange range) {
    const CompareOp nearer = range == DepthRange::Reversed ? CompareOp::GreaterEqual : CompareOp::LessEqual;
    const bool writes = raster.depthWrite && !drawsNothing(raster);
    if (!raster.depthCulling && !writes) return {};
    return { .depthCompare = raster.depthCulling ? nearer : CompareOp::Always, .depthWrite = writes };
}

// Whatever is nearer than the depth that is known is equal to it, unless a section plane cuts it off.
PipelineDesc leavingMotion(PipelineDesc desc, PassSlot const& slot) {
    desc.raster.cull = CullMode::None; // what was culled in the prepass has other depths
    const CompareOp nearer = slot.depthRange == DepthRange::Reversed ? CompareOp::GreaterEqual : CompareOp::LessEqual;
    desc.depthStencil = { .depthCompare = slot.cutsSections ? CompareOp::Equal : nearer, .depthWrite = false };
    return desc;
}

StencilOp stencilOp(StencilOperation operation) {
    static_assert(static_cast<int>(StencilOperation::Keep) == static_cast<int>(StencilOp::Keep) &&
                  static_cast<int>(StencilOperation::Zero) == static_cast<int>(StencilOp::Zero) &&
                  static_cast<int>(StencilOperation::Replace) == static_cast<int>(StencilOp::Replace) &&
                  static_cast<int>(StencilOperation::IncrementClamp) == static_cast<int>(StencilOp::IncrementClamp) &&
                  static_cast<int>(StencilOperation::DecrementClamp) == static_cast<int>(StencilOp::DecrementClamp) &&
                  static_cast<int>(StencilOperation::Invert) == static_cast<int>(StencilOp::Invert) &&
                  static_cast<int>(StencilOperation::IncrementWrap) == static_cast<int>(StencilOp::IncrementWrap) &&
                  static_cast<int>(StencilOperation::DecrementWrap) == static_cast<int>(StencilOp::DecrementWrap));
    return static_cast<StencilOp>(operation);
}

CompareOp compareOp(StencilTest test) {
    static constexpr std::array kCompares{ CompareOp::Never,   CompareOp::Less,     CompareOp::LessEqual,
                                           CompareOp::Equal,   CompareOp::NotEqual, CompareOp::GreaterEqual,
                                           CompareOp::Greater, CompareOp::Always };
    return kCompares[static_cast<size_t>(test)];
}

backend::StencilFace stencilFace(filament_core::StencilFace const& face) {
    return { .compare = compareOp(face.test),
             .fail = stencilOp(face.onFail),
             .depthFail = stencilOp(face.onDepthFail),
             .pass = stencilOp(face.onPass),
             .readMask = face.readMask,
             .writeMask = face.writeMask };
}

void useStencil(PipelineDesc& desc, PassSlot const& slot) {
    if (!slot.stencil) return;
    desc.depthStencil.stencilTest = true;
    desc.depthStencil.front = stencilFace(slot.stencil->front);
    desc.depthStencil.back = stencilFace(slot.stencil->back);
}

// The faces that are drawn stop light, so hulls whose far side alone is seen (outlines) do not darken what they
// enclose.
PipelineDesc leavingShadow(PipelineDesc desc, PassSlot const& slot, scene::InstanceRaster const& raster) {
    desc.depthStencil = { .depthCompare = slot.equalsDepth ? CompareOp::Equal : CompareOp::GreaterEqual,
                          .depthWrite = !drawsNothing(raster) };
    useStencil(desc, slot);
    return desc;
}

// The depths of transparent objects count as well: the nearest surface is seen.
PipelineDesc leavingEdges(PipelineDesc desc, scene::InstanceRaster const& raster, DepthRange range) {
    desc.depthStencil = { .depthCompare =
                                  range == DepthRange::Reversed ? CompareOp::GreaterEqual : CompareOp::LessEqual,
                          .depthWrite = !drawsNothing(raster) };
    if (drawsNothing(raster)) desc.blend[0].writeMask = 0;
    return desc;
}

// Nothing is written: what masks cut out is nearer than the depth that is there, and what they leave equals it. Other
// opaque surfaces may lie behind their own depth (pixelDepthOffset); what the depth does not know is tested as it was.
PipelineDesc leavingTriangles(PipelineDesc desc, scene::Material const& material, scene::InstanceRaster const& raster,
                              DepthRange range) {
    desc.depthStencil = depthState(raster, range);
    desc.depthStencil.depthWrite = false;
    const bool isCut = material.package.blending == shader::Blending::Masked;
    if (isCut && raster.depthCulling && raster.depthWrite) desc.depthStencil.depthCompare = CompareOp::Equal;
    if (drawsNothing(raster) || !raster.colorWrite) desc.blend[0].writeMask = 0;
    return desc;
}

PipelineDesc leavingPick(PipelineDesc desc, scene::InstanceRaster const& raster) {
    desc.depthStencil = { .depthCompare = CompareOp::GreaterEqual, .depthWrite = !drawsNothing(raster) };
    return desc;
}

// Colours are pre-multiplied: Porter and Duff 1984, "Compositing Digital Images". Coverage accumulates in alpha.
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

BlendState debugBlendState(DebugSlot debug, scene::Material const& material) {
    if (debug == DebugSlot::Coverage && material.isBlended())
        return { .enabled = true,
                 .srcColor = BlendFactor::One,
                 .dstColor = BlendFactor::OneMinusSrcAlpha,
                 .srcAlpha = BlendFactor::One,
                 .dstAlpha = BlendFactor::OneMinusSrcAlpha };
    if (debug != DebugSlot::Counts) return {};
    return { .enabled = true,
             .srcColor = BlendFactor::One,
             .dstColor = BlendFactor::One,
             .srcAlpha = BlendFactor::One,
             .dstAlpha = BlendFactor::One };
}

// What one of the passes of TransparencyPass.h leaves.
void composeInAnyOrder(PipelineDesc& desc, shader::TransparencyTerm term) {
    BlendState& blend = desc.blend[0];
    switch (term) {
    case shader::kTransparencyWeightedLight:
        blend.dstColor = blend.dstAlpha = BlendFactor::One;
        return;
    case shader::kTransparencyDepth:
    case shader::kTransparencyNextDepth:
        blend = { .writeMask = 0 };
        desc.depthStencil.depthWrite = true;
        return;
    case shader::kTransparencyLayer: // under those that are there; alpha is the share of light that they let through
        blend.srcColor = BlendFactor::DstAlpha, blend.dstColor = BlendFactor::One;
        blend.srcAlpha = BlendFactor::Zero, blend.dstAlpha = BlendFactor::OneMinusSrcAlpha;
        return;
    default:
        return;
    }
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

/// `geometry`: null: of a triangle over the whole target.
PipelineDesc statesOf(PassSlot const& slot, scene::Material const& material, scene::InstanceRaster const& raster,
                      scene::GeometryLayout const* geometry, bool mirrored) {
    PipelineDesc desc{ .pass = slot.layout, .subpass = slot.subpass, .debugName = material.name };
    desc.raster.cull = cullMode(raster);
    desc.raster.frontFace = mirrored ? FrontFace::Clockwise : FrontFace::CounterClockwise;
    if (geometry) {
        desc.vertices = withInstanceIndex(geometry->vertices);
        desc.raster.topology = geometry->topology;
    }
    if (slot.isShadowMap) return leavingShadow(desc, slot, raster);
    if (slot.motionOnly) return leavingMotion(desc, slot);
    if (slot.isPick) return leavingPick(desc, raster);
    if (slot.debug == DebugSlot::Edges) return leavingEdges(desc, raster, slot.depthRange);
    if (slot.debug == DebugSlot::Triangles) return leavingTriangles(desc, material, raster, slot.depthRange);
    const bool hasDepth = slot.layout.depthFormat != Format::None && slot.layout.subpasses[slot.subpass].usesDepth;
    if (hasDepth) desc.depthStencil = depthState(raster, slot.depthRange);
    if (slot.equalsDepth) desc.depthStencil.depthCompare = CompareOp::Equal;
    useStencil(desc, slot);
    if (slot.depthOnly) {
        composeInAnyOrder(desc, slot.transparency);
        return desc;
    }
    BlendState blend =
            slot.debug == DebugSlot::None ? blendState(material.package) : debugBlendState(slot.debug, material);
    if (!raster.colorWrite || drawsNothing(raster)) blend.writeMask = 0;
    desc.blend.fill(blend);
    composeInAnyOrder(desc, slot.transparency);
    return desc;
}

} // namespace

PipelineDesc surfaceStates(PassSlot const& slot, PipelineUse const& use, scene::InstanceRaster const& raster,
                           scene::GeometryLayout const& geometry) {
    scene::Material const& material = *use.instance.material;
    PipelineDesc desc = statesOf(slot, material, raster, &geometry, use.mirrored);
    usePass(desc, material.package.transparency, use.pass);
    if (slot.equalsDepth && use.pass == prepare::DrawPass::Second) desc.raster.cull = CullMode::Front; // SlabCaps.cpp
    if (slot.isPick && use.pass == prepare::DrawPass::Second) desc.raster.cull = CullMode::Back; // PreparedPick::fronts
    return desc;
}

PipelineDesc fullScreenStates(PassSlot const& slot, scene::Material const& material) {
    scene::InstanceRaster raster = scene::initialRaster(material.package);
    raster.cullingDisabled = true;
    PipelineDesc desc = statesOf(slot, material, raster, nullptr, false);
    if (slot.depthOnly) desc.depthStencil = depthState(raster, slot.depthRange);
    useStencil(desc, slot);
    return desc;
}

} // namespace filament_core::passes
