// SPDX-License-Identifier: Apache-2.0
#include "toolkit/mutations/Edits.h"

#include "shaders/interface/ShaderInterface.h"

#include <bit>
#include <cstddef>
#include <string>

namespace filament_core::tools {
namespace {

/// Transparent objects in any order weigh the same at any distance.
class OneWeightEdit final : public FrameEdit {
    void changeFrame(CmdUpdateBuffer& command) override {
        writeFloat(copy(command.bytes), offsetof(shader::FrameUniforms, jitter) + 2 * sizeof(float), 0);
    }
};

/// The condition that hideConstantOutputs() gives constant outputs, as SPIRV-Cross writes it, becomes known.
std::string withShownConstants(std::string_view essl) {
    constexpr std::string_view kNeverTrue = "gl_VertexID == 2147483647";
    std::string text(essl);
    for (size_t at = 0; (at = text.find(kNeverTrue, at)) != std::string::npos;)
        text.replace(at, kNeverTrue.size(), "false");
    return text;
}

/// Undoes hideConstantOutputs() (shaders/compiler/OpaqueOutputs.h): the linker sees constant outputs again.
class ConstantOutputsEdit final : public PayloadEdit {
public:
    using PayloadEdit::edit;
    void edit(CmdCreateProgram& command) override {
        const std::string_view text(reinterpret_cast<const char*>(command.desc.vertex.data()),
                                    command.desc.vertex.size());
        const std::string shown = withShownConstants(text);
        std::span<const std::byte> bytes = std::as_bytes(std::span(shown));
        copy(bytes);
        command.desc.vertex = bytes;
    }
};

/// The pass that draws the scene believes that its target has 3 % fewer pixels each way: its block is the first.
class TargetSizeEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        for (const size_t at : { size_t{ 0 }, sizeof(float) }) writeFloat(bytes, at, 0.97f * readFloat(bytes, at));
    }
};

/// The second peeled layer is the first once more, and so are all after it.
class LayerAgainEdit final : public ConstantEdit {
    void editConstant(std::string_view, ConstantValue& constant) const override {
        if (constant.id == shader::kQualityTransparency && constant.bits == shader::kTransparencyNextDepth)
            constant.bits = shader::kTransparencyDepth;
    }
};

class DepthCompareEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.depthStencil.depthWrite) command.desc.depthStencil.depthCompare = CompareOp::Always;
    }
};

/// The tone-aware resolve looks at two of four samples.
class ResolveSamplesEdit final : public ConstantEdit {
    void editConstant(std::string_view program, ConstantValue& constant) const override {
        if (program.starts_with("msaa_resolve") && constant.type == ConstantValue::Type::Int) constant.bits = 2;
    }
};

/// Surfaces believe that their target has one sample a pixel.
class CoverageOffEdit final : public PassBlocksEdit {
    void editBlocks(Bytes& bytes) override {
        for (size_t at = 0; at + sizeof(shader::PassUniforms) <= bytes.size(); at += sizeof(float4)) {
            if (samplesAt(bytes, at) > 1) writeFloat(bytes, at + offsetof(shader::PassUniforms, raster), 1);
        }
    }
};

class DebugThroughEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.debugName == "debug_draw") command.desc.depthStencil.depthCompare = CompareOp::Always;
    }
};

class StencilOffEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override { command.desc.depthStencil.stencilTest = false; }
};

class CullFaceEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.raster.cull == CullMode::Back) command.desc.raster.cull = CullMode::Front;
    }
};

class BlendOffEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        for (BlendState& blend : command.desc.blend) blend.enabled = false;
    }
};

class OtherColorsEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (std::popcount(command.desc.pass.subpasses[command.desc.subpass].colorMask) < 2) return;
        for (BlendState& blend : std::span(command.desc.blend).subspan(1)) blend.writeMask = 0;
    }
};

class FirstLayerEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdBeginPass& command) override {
        for (Attachment& color : command.desc.colors) color.layer = 0;
    }
};

class EqualDepthEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreatePipeline& command) override {
        if (command.desc.depthStencil.depthCompare == CompareOp::Equal)
            command.desc.depthStencil.depthCompare = CompareOp::Always;
    }
};

/// As if culling had left out one object too many.
class FirstInstanceEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdDrawIndexed& command) override {
        if (command.instanceCount < 2) return;
        ++command.firstInstance;
        --command.instanceCount;
    }
};

/// All objects have the bones of the frame's first skin.
class OnePoseEdit final : public NamedBufferEdit {
public:
    OnePoseEdit() : NamedBufferEdit("objects") {}

private:
    void editBuffer(CmdUpdateBuffer& command) override {
        Bytes& objects = copy(command.bytes);
        constexpr size_t kFirstBone = offsetof(shader::ObjectData, flags) + 3 * sizeof(float);
        for (size_t at = 0; at + sizeof(shader::ObjectData) <= objects.size(); at += sizeof(shader::ObjectData))
            writeFloat(objects, at + kFirstBone, 0);
    }
};

/// Of meshes of files, coarser levels of detail alone do not begin with the first index.
class LevelTrianglesEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdDrawIndexed& command) override {
        if (command.firstIndex > 0) command.indexCount -= (command.indexCount / 3 + 15) / 16 * 3;
    }
};

constexpr Mutation kRasterMutations[] = {
    { "depthCompare", "depth test always passes", make<DepthCompareEdit> },
    { "cullFace", "front faces culled instead of back faces", make<CullFaceEdit> },
    { "blendOff", "blending off", make<BlendOffEdit> },
    { "firstInstance", "one object of every instanced draw is missing", make<FirstInstanceEdit> },
    { "onePose", "skinned instances have the pose of the first one", make<OnePoseEdit> },
    { "levelTriangles", "a sixteenth of the triangles of coarser levels of detail is missing",
      make<LevelTrianglesEdit> },
    { "targetSize", "the scene's target 3 % smaller, for shaders", make<TargetSizeEdit> },
    { "oneWeight", "transparent objects in any order weigh the same at any distance", make<OneWeightEdit> },
    { "layerAgain", "every peeled layer is the nearest one", make<LayerAgainEdit> },
    { "resolveSamples", "two of four samples become the pixel where displays weigh them", make<ResolveSamplesEdit> },
    { "coverageOff", "alpha does not reach the coverage", make<CoverageOffEdit> },
    { "stencilOff", "stencil test off", make<StencilOffEdit> },
    { "otherColors", "passes leave all colours of their target but the first as they are", make<OtherColorsEdit> },
    { "firstLayer", "passes draw to the first layer, face or slice of their target", make<FirstLayerEdit> },
    { "equalDepth", "what is drawn where depths are known is drawn everywhere", make<EqualDepthEdit> },
    { "debugThrough", "surfaces do not hide debug drawing", make<DebugThroughEdit> },
    { "constantOutputs", "linkers may know constant vertex outputs", make<ConstantOutputsEdit>, Backend::Gles },
};

} // namespace

std::span<const Mutation> rasterMutations() { return kRasterMutations; }

} // namespace filament_core::tools
