// SPDX-License-Identifier: Apache-2.0
// Size: objectCases() and drawCases() are tables: one rule of the driver contract per line.
// A case consists of a correct world, one broken command, the words of the message, and whether a driver still sees the
// command.
#include "backend/layers/Validated.h"

#include "backend/null/NullDriver.h"
#include "tests/backend/layers/LayerTestKit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace filament_core::backend {
namespace {

using namespace kit;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void recordMultisampledGroup(CommandBuffer& to, std::function<void(BindGroupLayout&)> const& change);

class Validated : public testing::Test {
protected:
    Errors mErrors;
    std::unique_ptr<Driver> mDriver = validate(createNullDriver(mErrors), mErrors);

    void execute(std::function<void(CommandBuffer&)> const& record) {
        CommandBuffer commands;
        record(commands);
        mDriver->execute(commands.view());
    }
};

TEST_F(Validated, IsSilentAboutACorrectStreamThatUsesEveryCommandAndForwardsIt) {
    execute(recordObjects);
    for (uint64_t frame = 0; frame < 3; ++frame) {
        execute([&](CommandBuffer& to) { recordFrame(to, frame, 10 + 3 * frame); });
    }
    execute(recordDestroys);
    EXPECT_THAT(mErrors.messages, IsEmpty());
    EXPECT_EQ(mDriver->statistics().draws, 6u);
    EXPECT_EQ(mDriver->statistics().dispatches, 3u);
    EXPECT_EQ(mDriver->statistics().deviceBytes, 0u);
}

TEST_F(Validated, IsSilentAboutACorrectMergedPass) {
    execute([](CommandBuffer& to) {
        const TextureHandle a = TextureHandle::make(0, 1), b = TextureHandle::make(1, 1);
        using enum TextureUsage;
        to.record(CmdCreateTexture{
                a, { .usage = ColorAttachment | InputAttachment | Transient, .width = 8, .height = 8 } });
        to.record(CmdCreateTexture{ b, { .usage = ColorAttachment, .width = 8, .height = 8 } });
        PassDesc desc = mergedPassDesc(a, b);
        desc.colors[0].store = StoreOp::Discard;
        CmdCreateProgram program = createProgram();
        program.desc.layout = {};
        program.desc.layout[0].count = 1;
        program.desc.layout[0].bindings[0] = { .binding = 2,
                                               .type = BindingType::InputAttachment,
                                               .inputAttachment = 0 };
        to.record(program);
        to.record(CmdCreatePipeline{ kPipeline, { .program = kProgram, .pass = desc.layout, .subpass = 1 } });
        const std::vector<BindGroupEntry> entries{ { .binding = 2, .texture = a } };
        to.record(CmdCreateBindGroup{ kGroup, { .layout = program.desc.layout[0], .entries = entries } });
        to.record(CmdBeginPass{ desc });
        to.record(CmdNextSubpass{});
        to.record(CmdBindPipeline{ kPipeline });
        to.record(CmdBindGroup{ .group = kGroup, .index = 0 });
        to.record(CmdDraw{ .vertexCount = 3 });
        to.record(CmdEndPass{});
    });
    EXPECT_THAT(mErrors.messages, IsEmpty());
}

TEST_F(Validated, IsSilentAboutSrgbThatIsUploadedBlittedFromAndReadBack) {
    execute(recordObjects);
    execute([](CommandBuffer& to) {
        const TextureHandle srgb = TextureHandle::make(20, 1);
        using enum TextureUsage;
        to.record(CmdCreateTexture{ srgb, { .format = Format::RGBA8Srgb, .usage = TransferTarget | TransferSource } });
        const std::vector<std::byte> texel = bytes(4);
        to.record(CmdUploadTexture{ .texture = srgb, .rect = { 0, 0, 1, 1 }, .bytes = texel });
        to.record(CmdBlit{
                .source = srgb, .target = kColor, .sourceRect = { 0, 0, 1, 1 }, .targetRect = { 0, 0, 1, 1 } });
        to.record(CmdReadTexture{ .texture = srgb, .rect = { 0, 0, 1, 1 }, .ticket = { 5 } });
    });
    EXPECT_THAT(mErrors.messages, IsEmpty());
}

TEST_F(Validated, IsSilentAboutSrgbWhoseBytesAPassStores) {
    execute(recordObjects);
    execute([](CommandBuffer& to) {
        const TextureHandle srgb = TextureHandle::make(20, 1), samples = TextureHandle::make(21, 1);
        using enum TextureUsage;
        to.record(CmdCreateTexture{ srgb, { .format = Format::RGBA8Srgb, .usage = ColorAttachment | Sampled } });
        to.record(CmdCreateTexture{ samples, { .format = Format::RGBA8Srgb, .usage = ColorAttachment, .samples = 4 } });
        PassDesc desc{ .area = { 0, 0, 1, 1 }, .debugName = "codes" };
        desc.layout = { .colorFormats = { attachmentFormat(Format::RGBA8Srgb) }, .colorCount = 1 };
        desc.colors[0].texture = srgb;
        to.record(CmdBeginPass{ desc });
        to.record(CmdEndPass{});
        desc.layout.samples = 4, desc.layout.resolveMask = 1;
        desc.colors[0].texture = samples, desc.colors[0].resolve = srgb;
        to.record(CmdBeginPass{ desc });
        to.record(CmdEndPass{});
    });
    EXPECT_THAT(mErrors.messages, IsEmpty());
}

TEST_F(Validated, IsSilentAboutTexturesOfSeveralSamplesThatAreSampledAsSuch) {
    execute(recordObjects);
    execute([](CommandBuffer& to) { recordMultisampledGroup(to, [](BindGroupLayout&) {}); });
    EXPECT_THAT(mErrors.messages, IsEmpty());
}

TEST_F(Validated, NamesCommandObjectPassRuleAndCureInOneLine) {
    execute(recordObjects);
    execute([](CommandBuffer& to) {
        to.record(CmdBeginPass{ passDesc() });
        to.record(CmdBindPipeline{ kPipeline });
        to.record(CmdDraw{ .vertexCount = 0 });
        to.record(CmdEndPass{});
    });
    ASSERT_EQ(mErrors.messages.size(), 2u);
    EXPECT_EQ(mErrors.messages[0],
              "command 3 Draw 'painted' in pass 'main': group 1 is not bound, or was lost by a pipeline of "
              "another layout; record CmdBindGroup");
    EXPECT_EQ(mErrors.messages[1], "a stream of 4 commands was dropped: a driver could crash on the errors above");
    EXPECT_THAT(mErrors.kinds, testing::Each(DriverErrorKind::Validation));
}

TEST_F(Validated, ADroppedStreamLeavesTheWorldAsItWas) {
    execute(recordObjects);
    execute([](CommandBuffer& to) {
        to.record(CmdDestroyTexture{ kImage });
        to.record(CmdCreateBuffer{ BufferHandle::make(9, 1), { .size = 8 } });
        to.record(CmdEndPass{}); // drops the stream
    });
    ASSERT_EQ(mErrors.messages.size(), 2u);
    mErrors.messages.clear();
    execute([](CommandBuffer& to) { recordFrame(to); }); // kImage still lives
    EXPECT_THAT(mErrors.messages, IsEmpty());
    execute([](CommandBuffer& to) { to.record(CmdDestroyBuffer{ BufferHandle::make(9, 1) }); });
    EXPECT_THAT(mErrors.messages, ElementsAre(HasSubstr("does not exist"), HasSubstr("dropped")));
    execute([](CommandBuffer& to) { to.record(CmdCreateBuffer{ BufferHandle::make(9, 1), { .size = 8 } }); });
    EXPECT_EQ(mErrors.messages.size(), 2u) << "the name is free again";
}

// ---------------------------------------------------------------------------------------------- one case a rule

enum class Outcome : uint8_t { Forwarded, Dropped };

struct Case {
    const char* name;
    std::function<void(CommandBuffer&)> breakOne; ///< recorded after all objects were made
    const char* expected;                         ///< part of the first message
    Outcome outcome = Outcome::Dropped;
};

void PrintTo(Case const& one, std::ostream* out) { *out << one.name; }

// A pass with everything bound; `change` may replace the bindings, `draw` is the command under test.
void inPass(CommandBuffer& to, std::function<void(CommandBuffer&)> const& draw, PassDesc const& desc = passDesc()) {
    to.record(CmdBeginPass{ desc });
    recordBindings(to);
    draw(to);
    to.record(CmdEndPass{});
}

constexpr std::array<std::byte, 4> kTexel{}; // of RGBA8

CmdCreateTexture textureWith(std::function<void(DeviceTextureDesc&)> const& change) {
    CmdCreateTexture command{ TextureHandle::make(20, 1), { .width = 8, .height = 8 } };
    change(command.desc);
    return command;
}

/// Of four slices, as texture 20.
void recordVolume(CommandBuffer& to) {
    to.record(textureWith([](auto& d) {
        d.type = TextureKind::Texture3D, d.layers = 4, d.levels = 2;
        d.usage = TextureUsage::Sampled | TextureUsage::ColorAttachment;
    }));
}

void recordPassWith(CommandBuffer& to, std::function<void(PassDesc&)> const& change) {
    PassDesc desc = passDesc();
    change(desc);
    to.record(CmdBeginPass{ desc });
    to.record(CmdEndPass{});
}

void recordPipelineWith(CommandBuffer& to, std::function<void(PipelineDesc&)> const& change) {
    PipelineDesc desc = pipelineDesc();
    change(desc);
    to.record(CmdCreatePipeline{ PipelineHandle::make(20, 1), desc });
}

void recordGroupWith(CommandBuffer& to, std::function<void(std::vector<BindGroupEntry>&)> const& change) {
    std::vector<BindGroupEntry> entries = groupEntries();
    change(entries);
    to.record(CmdCreateBindGroup{ BindGroupHandle::make(20, 1), { .layout = groupLayout(), .entries = entries } });
}

/// A group with a texture of four samples.
void recordMultisampledGroup(CommandBuffer& to, std::function<void(BindGroupLayout&)> const& change) {
    const TextureHandle samples = TextureHandle::make(20, 1);
    using enum TextureUsage;
    to.record(CmdCreateTexture{
            samples,
            { .usage = ColorAttachment | Sampled, .samples = 4, .width = 8, .height = 8, .debugName = "samples" } });
    BindGroupLayout layout = groupLayout();
    layout.bindings[1].isMultisampled = true;
    change(layout);
    std::vector<BindGroupEntry> entries = groupEntries();
    entries[1].texture = samples;
    to.record(CmdCreateBindGroup{ BindGroupHandle::make(20, 1), { .layout = layout, .entries = entries } });
}

CmdUploadTexture uploadWith(std::vector<std::byte> const& data, std::function<void(CmdUploadTexture&)> const& change) {
    CmdUploadTexture command{ .texture = kImage, .rect = { 0, 0, 8, 8 }, .bytes = data };
    change(command);
    return command;
}

CmdBlit blitWith(std::function<void(CmdBlit&)> const& change) {
    CmdBlit command{ .source = kImage, .target = kColor, .sourceRect = { 0, 0, 8, 8 }, .targetRect = { 0, 0, 8, 8 } };
    change(command);
    return command;
}

using C = CommandBuffer;

void makeSrgb(DeviceTextureDesc& desc) {
    desc.format = Format::RGBA8Srgb, desc.levels = 4;
    desc.usage = TextureUsage::Sampled | TextureUsage::TransferSource | TextureUsage::TransferTarget;
}

std::vector<Case> objectCases() {
    return {
        { "PipelineOfAnSrgbPass",
          [](C& to) { recordPipelineWith(to, [](auto& d) { d.pass.colorFormats[0] = Format::RGBA8Srgb; }); },
          "colour 0 has format RGBA8Srgb; passes store its bytes: say attachmentFormat(), which is RGBA8" },
        { "NoneHandle",
          [](C& to) {
              to.record(CmdCreateBuffer{ {}, { .size = 4 } });
          },
          "the handle is none" },
        { "HandleInUse",
          [](C& to) {
              to.record(CmdCreateBuffer{ kVertices, { .size = 4 } });
          },
          "is in use" },
        { "OtherGenerationInUse",
          [](C& to) {
              to.record(CmdCreateBuffer{ BufferHandle::make(0, 2), { .size = 4 } });
          },
          "is in use" },
        { "DestroyTwice",
          [](C& to) {
              to.record(CmdDestroyBuffer{ kVertices });
              to.record(CmdDestroyBuffer{ kVertices });
          },
          "was destroyed" },
        { "DestroyUnknown", [](C& to) { to.record(CmdDestroySampler{ SamplerHandle::make(77, 1) }); },
          "does not exist" },
        { "EmptyBuffer",
          [](C& to) {
              to.record(CmdCreateBuffer{ BufferHandle::make(20, 1), {} });
          },
          "the size is 0" },
        { "CreateInPass",
          [](C& to) {
              inPass(to, [](C& in) { in.record(CmdCreateBuffer{ BufferHandle::make(20, 1), { .size = 4 } }); });
          },
          "only outside of passes" },
        { "TextureWithoutFormat", [](C& to) { to.record(textureWith([](auto& d) { d.format = Format::None; })); },
          "format is none" },
        { "TextureOfZeroWidth", [](C& to) { to.record(textureWith([](auto& d) { d.width = 0; })); },
          "both must be > 0" },
        { "TextureTooLarge", [](C& to) { to.record(textureWith([](auto& d) { d.height = 99'999; })); },
          "maxTextureSize" },
        { "TooManyLevels", [](C& to) { to.record(textureWith([](auto& d) { d.levels = 5; })); },
          "5 levels; 8 x 8 has 1..4" },
        { "LayersOf2D", [](C& to) { to.record(textureWith([](auto& d) { d.layers = 2; })); }, "use Texture2DArray" },
        { "SlicesBeyondTheLimit",
          [](C& to) { to.record(textureWith([](auto& d) { d.type = TextureKind::Texture3D, d.layers = 9'999; })); },
          "max3DTextureSize" },
        { "InputAttachmentOf3D",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.type = TextureKind::Texture3D, d.layers = 2;
                  d.usage = TextureUsage::InputAttachment | TextureUsage::ColorAttachment;
              }));
          },
          "a 3D texture is no input attachment" },
        { "DepthOf3D",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.type = TextureKind::Texture3D, d.layers = 2, d.format = Format::D32F;
                  d.usage = TextureUsage::DepthAttachment;
              }));
          },
          "a 3D texture is uncompressed, and has no depth format; D32F is for other kinds" },
        { "CompressedSlices",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.type = TextureKind::Texture3D, d.layers = 2, d.format = Format::BC7,
                  d.usage = TextureUsage::Sampled;
              }));
          },
          "a 3D texture is uncompressed" },
        { "SliceOfASmallerLevel",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.type = TextureKind::Texture3D, d.layers = 4, d.levels = 2;
                  d.usage = TextureUsage::Sampled | TextureUsage::TransferTarget;
              }));
              to.record(CmdUploadTexture{ .texture = TextureHandle::make(20, 1),
                                          .level = 1,
                                          .layer = 2,
                                          .rect = { 0, 0, 1, 1 },
                                          .bytes = kTexel });
          },
          "layers 2..3 of 2" },
        { "MipsOf3D",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.type = TextureKind::Texture3D, d.layers = 4, d.levels = 2;
                  d.usage = TextureUsage::TransferSource | TextureUsage::TransferTarget;
              }));
              to.record(CmdGenerateMips{ TextureHandle::make(20, 1) });
          },
          "mips of a 3D texture cannot be generated" },
        { "CubeOf5", [](C& to) { to.record(textureWith([](auto& d) { d.type = TextureKind::Cube, d.layers = 5; })); },
          "6 square layers" },
        { "CubesOf8",
          [](C& to) { to.record(textureWith([](auto& d) { d.type = TextureKind::CubeArray, d.layers = 8; })); },
          "6 square layers per cube" },
        { "TwoSamples",
          [](C& to) {
              to.record(textureWith([](auto& d) { d.samples = 2, d.usage = TextureUsage::ColorAttachment; }));
          },
          "2 samples" },
        { "CopiedMultisample",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.samples = 4, d.usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource;
              }));
          },
          "resolve into another" },
        { "MultisampledUniforms",
          [](C& to) {
              recordMultisampledGroup(to, [](BindGroupLayout& layout) { layout.bindings[0].isMultisampled = true; });
          },
          "binding 0 is multisampled and no sampled texture", Outcome::Forwarded },
        { "MultisampleBoundAsOne",
          [](C& to) {
              recordMultisampledGroup(to, [](BindGroupLayout& layout) { layout.bindings[1].isMultisampled = false; });
          },
          "'samples' has 4 samples, the layout says one" },
        { "OneBoundAsMultisample",
          [](C& to) {
              BindGroupLayout layout = groupLayout();
              layout.bindings[1].isMultisampled = true;
              const std::vector<BindGroupEntry> entries = groupEntries();
              to.record(CmdCreateBindGroup{ BindGroupHandle::make(20, 1), { .layout = layout, .entries = entries } });
          },
          "has 1 samples, the layout says several" },
        { "MultisampleThatIsNotDrawn", [](C& to) { to.record(textureWith([](auto& d) { d.samples = 4; })); },
          "only for 2D attachments" },
        { "OnNoTexture",
          [](C& to) { to.record(textureWith([](auto& d) { d.placedOn = TextureHandle::make(99, 1); })); },
          "placed on texture 99, which does not exist" },
        { "TransientOnAnother",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.placedOn = TextureHandle::make(1, 1);
                  d.usage = TextureUsage::ColorAttachment | TextureUsage::Transient;
              }));
          },
          "tile memory is not shared" },
        { "UnrenderableAttachment",
          [](C& to) {
              to.record(
                      textureWith([](auto& d) { d.format = Format::RGB9E5, d.usage = TextureUsage::ColorAttachment; }));
          },
          "RGB9E5 cannot be an attachment" },
        { "DepthAsColor",
          [](C& to) {
              to.record(textureWith([](auto& d) { d.format = Format::D32F, d.usage = TextureUsage::ColorAttachment; }));
          },
          "cannot be a colour attachment" },
        { "SampledTransient",
          [](C& to) {
              to.record(textureWith([](auto& d) { d.usage = TextureUsage::Transient | TextureUsage::Sampled; }));
          },
          "never outlives its pass" },
        { "Anisotropy17",
          [](C& to) {
              to.record(CmdCreateSampler{ SamplerHandle::make(20, 1), { .anisotropy = 17 } });
          },
          "it is 1..16", Outcome::Forwarded },
        { "ProgramWithoutCode",
          [](C& to) {
              to.record(CmdCreateProgram{ ProgramHandle::make(20, 1), {} });
          },
          "has a vertex and a fragment stage" },
        { "UnorderedLayout",
          [](C& to) {
              CmdCreateProgram command = createProgram();
              command.handle = ProgramHandle::make(20, 1);
              std::swap(command.desc.layout[1].bindings[0], command.desc.layout[1].bindings[1]);
              to.record(command);
          },
          "group 1: binding 0 follows 3" },
        { "PipelineWithoutProgram", [](C& to) { recordPipelineWith(to, [](auto& d) { d.program = {}; }); },
          "the program is none" },
        { "PipelineSubpassOutOfRange", [](C& to) { recordPipelineWith(to, [](auto& d) { d.subpass = 1; }); },
          "subpass 1 of 1" },
        { "AttributeBeyondStride",
          [](C& to) { recordPipelineWith(to, [](auto& d) { d.vertices.attributes[1].offset = 6; }); },
          "bytes 6..10 of a stride of 8" },
        { "AttributeTwice",
          [](C& to) { recordPipelineWith(to, [](auto& d) { d.vertices.attributes[1].location = 0; }); },
          "attribute 0 is given twice" },
        { "AttributeOfMissingBuffer",
          [](C& to) { recordPipelineWith(to, [](auto& d) { d.vertices.attributes[0].buffer = 2; }); },
          "reads buffer 2 of 2" },
        { "DepthTestWithoutDepth",
          [](C& to) { recordPipelineWith(to, [](auto& d) { d.pass.depthFormat = Format::None; }); },
          "a depth test without a depth attachment", Outcome::Forwarded },
        { "StencilTestWithoutStencil",
          [](C& to) { recordPipelineWith(to, [](auto& d) { d.depthStencil.stencilTest = true; }); },
          "a stencil test without stencil", Outcome::Forwarded },
        { "BlendOfIntegers",
          [](C& to) {
              recordPipelineWith(to,
                                 [](auto& d) { d.pass.colorFormats[0] = Format::R32UI, d.blend[0].enabled = true; });
          },
          "cannot blend" },
    };
}

std::vector<Case> groupCases() {
    return {
        { "EntryMissing", [](C& to) { recordGroupWith(to, [](auto& e) { e.pop_back(); }); },
          "1 entries for 2 bindings" },
        { "EntryTwice", [](C& to) { recordGroupWith(to, [](auto& e) { e[1] = e[0]; }); }, "binding 0 has 2 entries" },
        { "BufferWithoutUniformUsage", [](C& to) { recordGroupWith(to, [](auto& e) { e[0].buffer = kVertices; }); },
          "'vertices' lacks BufferUsage::Uniform" },
        { "UnalignedUniform", [](C& to) { recordGroupWith(to, [](auto& e) { e[0].offset = 16; }); },
          "no multiple of 256" },
        { "UniformBeyondBuffer", [](C& to) { recordGroupWith(to, [](auto& e) { e[0].offset = 512; }); },
          "bytes 512..576 of buffer" },
        { "UniformOfZeroBytes", [](C& to) { recordGroupWith(to, [](auto& e) { e[0].size = 0; }); }, "0 bytes visible" },
        { "DestroyedTexture",
          [](C& to) {
              to.record(CmdDestroyTexture{ kImage });
              recordGroupWith(to, [](auto&) {});
          },
          "the texture 0x100002 was destroyed" },
        { "TextureWithoutSampledUsage", [](C& to) { recordGroupWith(to, [](auto& e) { e[1].texture = kColor; }); },
          "'color' lacks TextureUsage::Sampled" },
        { "CompareOnColor", [](C& to) { recordGroupWith(to, [](auto& e) { e[1].sampler = kCompare; }); },
          "a comparing sampler needs a depth format", Outcome::Forwarded },
        { "RangeBeyondTheTexture", [](C& to) { recordGroupWith(to, [](auto& e) {
                                                   e[1].range = { 3, 2, 0, 1 };
                                               }); },
          "2 levels from 3 and 1 layers from 0 of texture 'image', which has 4 and 1" },
        { "RangeFromBeyondTheTexture", [](C& to) { recordGroupWith(to, [](auto& e) { e[1].range.layer = 1; }); },
          "0 layers from 1 of texture 'image'" },
        { "SomeLayersOfACube",
          [](C& to) {
              to.record(textureWith([](auto& d) { d.type = TextureKind::Cube, d.layers = 6, d.height = d.width; }));
              recordGroupWith(to, [](auto& e) {
                  e[1].texture = TextureHandle::make(20, 1), e[1].range = { 0, 1, 0, 5 };
              });
          },
          "shows all of its 6 layers, not 5" },
        { "ACubeAndAHalf",
          [](C& to) {
              to.record(
                      textureWith([](auto& d) { d.type = TextureKind::CubeArray, d.layers = 12, d.height = d.width; }));
              recordGroupWith(to, [](auto& e) {
                  e[1].texture = TextureHandle::make(20, 1), e[1].range = { 0, 1, 0, 9 };
              });
          },
          "shows whole cubes, not 9 layers from 0" },
        { "MissingSampler", [](C& to) { recordGroupWith(to, [](auto& e) { e[1].sampler = {}; }); },
          "the sampler is none" },
    };
}

std::vector<Case> contentCases() {
    static const std::vector<std::byte> data = bytes(256), blocks = bytes(8);
    return {
        { "UpdateBeyondTheEnd",
          [](C& to) {
              to.record(CmdUpdateBuffer{ kIndices, 1, std::span(data).first(60) });
          },
          "bytes 1..61" },
        { "UpdateInPass", [](C& to) { inPass(to, [](C& in) {
                                          in.record(CmdUpdateBuffer{ kIndices, 0, blocks });
                                      }); },
          "only outside" },
        { "UploadOfTooFewBytes", [](C& to) { to.record(uploadWith(blocks, [](auto&) {})); },
          "8 bytes for 8 x 8 x 1 texels of RGBA8; that is 256" },
        { "UploadOfMissingLevel", [](C& to) { to.record(uploadWith(data, [](auto& c) { c.level = 4; })); },
          "level 4 of 4" },
        { "UploadOfMissingLayer", [](C& to) { to.record(uploadWith(data, [](auto& c) { c.layer = 1; })); },
          "layers 1..2 of 1" },
        { "UploadOutsideOfTheLevel", [](C& to) { to.record(uploadWith(data, [](auto& c) { c.level = 1; })); },
          "leaves level 1 of 4 x 4" },
        { "UploadAtNegativeX", [](C& to) { to.record(uploadWith(data, [](auto& c) { c.rect.x = -1; })); },
          "rectangle -1,0" },
        { "UploadWithoutUsage", [](C& to) { to.record(uploadWith(data, [](auto& c) { c.texture = kDepth; })); },
          "lacks TextureUsage::TransferTarget" },
        { "UploadThroughBlocks",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.format = Format::BC1, d.usage = TextureUsage::Sampled | TextureUsage::TransferTarget;
              }));
              to.record(uploadWith(blocks, [](auto& c) {
                  c.texture = TextureHandle::make(20, 1), c.rect = { 2, 0, 4, 4 };
              }));
          },
          "cuts through 4x4 blocks" },
        { "MipsWithoutUsage", [](C& to) { to.record(CmdGenerateMips{ kDepth }); },
          "needs TransferSource and TransferTarget" },
        { "MipsOfSrgb",
          [](C& to) {
              to.record(textureWith(makeSrgb));
              to.record(CmdGenerateMips{ TextureHandle::make(20, 1) });
          },
          "generating mips would let the driver encode RGBA8Srgb" },
        { "BlitToSrgb",
          [](C& to) {
              to.record(textureWith(makeSrgb));
              to.record(blitWith([](auto& c) { c.target = TextureHandle::make(20, 1); }));
          },
          "would let the driver encode RGBA8Srgb" },
        { "BlitWithoutUsage", [](C& to) { to.record(blitWith([](auto& c) { c.source = kDepth; })); },
          "source 'depth' lacks" },
        { "BlitOutside", [](C& to) { to.record(blitWith([](auto& c) {
                                         c.targetRect = { 10, 10, 8, 8 };
                                     })); },
          "target 'color': rectangle" },
        { "BlitOntoItself", [](C& to) { to.record(blitWith([](auto& c) { c.target = kImage; })); }, "overlap",
          Outcome::Forwarded },
        { "ReadWithoutUsage",
          [](C& to) {
              to.record(CmdReadTexture{ .texture = kDepth, .rect = { 0, 0, 1, 1 }, .ticket = { 5 } });
          },
          "lacks TextureUsage::TransferSource" },
        { "ReadOutside",
          [](C& to) {
              to.record(CmdReadTexture{ .texture = kColor, .rect = { 0, 0, 17, 1 }, .ticket = { 5 } });
          },
          "leaves level 0 of 16 x 16" },
        { "ReadWithoutTicket",
          [](C& to) {
              to.record(CmdReadTexture{ .texture = kColor, .rect = { 0, 0, 1, 1 } });
          },
          "ticket is none", Outcome::Forwarded },
        { "TicketTwice",
          [](C& to) {
              for (int i = 0; i < 2; ++i)
                  to.record(CmdReadTexture{ .texture = kColor, .rect = { 0, 0, 1, 1 }, .ticket = { 5 } });
          },
          "ticket 5 was used before", Outcome::Forwarded },
    };
}

std::vector<Case> passCases() {
    return {
        { "PassInPass", [](C& to) { inPass(to, [](C& in) { in.record(CmdBeginPass{ passDesc() }); }); },
          "only outside of passes" },
        { "EndWithoutBegin", [](C& to) { to.record(CmdEndPass{}); }, "only inside a pass" },
        { "PassLeftOpen", [](C& to) { to.record(CmdBeginPass{ passDesc() }); }, "pass 'main' is still open" },
        { "DrawOutsideOfPasses", [](C& to) { to.record(CmdDraw{ .vertexCount = 3 }); }, "only inside a pass" },
        { "NoAttachments",
          [](C& to) { recordPassWith(to, [](auto& d) {
                          d = { .area = { 0, 0, 1, 1 }, .debugName = "main" };
                      }); },
          "without attachments" },
        { "EmptyArea", [](C& to) { recordPassWith(to, [](auto& d) { d.area.width = 0; }); }, "is empty" },
        { "AreaLargerThanAttachment", [](C& to) { recordPassWith(to, [](auto& d) { d.area.width = 17; }); },
          "colour 0 'color' is smaller than the area" },
        { "AttachmentMissing", [](C& to) { recordPassWith(to, [](auto& d) { d.colors[0].texture = {}; }); },
          "the colour 0 is none" },
        { "AttachmentOfOtherFormat",
          [](C& to) { recordPassWith(to, [](auto& d) { d.layout.colorFormats[0] = Format::RGBA16F; }); },
          "has format RGBA8, the layout says RGBA16F" },
        { "AttachmentOfSrgb",
          [](C& to) { recordPassWith(to, [](auto& d) { d.layout.colorFormats[0] = Format::RGBA8Srgb; }); },
          "colour 0 has format RGBA8Srgb; passes store its bytes: say attachmentFormat(), which is RGBA8" },
        { "AttachmentOfOtherSampleCount",
          [](C& to) { recordPassWith(to, [](auto& d) { d.colors[0].texture = kSamples4; }); },
          "has 4 samples, the layout says 1" },
        { "AttachmentWithoutUsage",
          [](C& to) { recordPassWith(to, [](auto& d) {
                          d.colors[0].texture = kImage, d.area = { 0, 0, 8, 8 };
                      }); },
          "'image' lacks TextureUsage::ColorAttachment" },
        { "SliceThatTheLevelLacks",
          [](C& to) {
              recordVolume(to);
              recordPassWith(to, [](auto& d) {
                  d.colors[0] = { .texture = TextureHandle::make(20, 1), .level = 1, .layer = 2 };
                  d.layout.depthFormat = Format::None, d.depth = {}, d.area = { 0, 0, 4, 4 };
              });
          },
          "level 1 of 2, slice 2 of 2" },
        { "TwoSlicesOfOneLevel",
          [](C& to) {
              recordVolume(to);
              recordPassWith(to, [](auto& d) {
                  d.layout.colorCount = 2, d.layout.colorFormats[1] = d.layout.colorFormats[0];
                  for (uint16_t i = 0; i < 2; ++i) d.colors[i] = { .texture = TextureHandle::make(20, 1), .layer = i };
                  d.layout.depthFormat = Format::None, d.depth = {}, d.area = { 0, 0, 8, 8 };
              });
          },
          "colours 0 and 1 are slices of one level of 3D texture" },
        { "AttachmentLevelMissing", [](C& to) { recordPassWith(to, [](auto& d) { d.colors[0].level = 1; }); },
          "level 1 of 1" },
        { "DepthOfOtherFormat", [](C& to) { recordPassWith(to, [](auto& d) { d.layout.depthFormat = Format::D16; }); },
          "depth 'depth' has format D32F, the layout says D16" },
        { "ResolveWithoutSamples",
          [](C& to) { recordPassWith(to, [](auto& d) { d.layout.resolveMask = 1, d.colors[0].resolve = kColor; }); },
          "a resolve needs samples > 1" },
        { "ResolveOfNumbersToCodes",
          [](C& to) {
              to.record(textureWith(
                      [](auto& d) { d.format = Format::RGBA8Srgb, d.usage = TextureUsage::ColorAttachment; }));
              recordPassWith(to, [](auto& d) {
                  d.layout.depthFormat = Format::None, d.layout.samples = 4, d.layout.resolveMask = 1;
                  d.colors[0].texture = kSamples4, d.colors[0].resolve = TextureHandle::make(20, 1);
                  d.area = { 0, 0, 8, 8 };
              });
          },
          "has format RGBA8Srgb, colour 0 has RGBA8" },
        { "ResolveNotInMask", [](C& to) { recordPassWith(to, [](auto& d) { d.colors[0].resolve = kColor; }); },
          "resolveMask does not name it", Outcome::Forwarded },
        { "DepthResolveNotInTheLayout", [](C& to) { recordPassWith(to, [](auto& d) { d.depth.resolve = kDepth; }); },
          "depth has a resolve target, but the layout does not say", Outcome::Forwarded },
        { "DepthResolveOfOneSample",
          [](C& to) { recordPassWith(to, [](auto& d) { d.layout.resolvesDepth = true, d.depth.resolve = kDepth; }); },
          "resolvesDepth needs a depth attachment of samples > 1" },
        { "DepthResolveToAnotherFormat",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.format = Format::D32F, d.usage = TextureUsage::DepthAttachment, d.samples = 4;
              }));
              recordPassWith(to, [](auto& d) {
                  d.layout.colorCount = 0, d.layout.samples = 4, d.layout.resolvesDepth = true;
                  d.depth = { .texture = TextureHandle::make(20, 1), .resolve = kColor };
                  d.area = { 0, 0, 8, 8 };
              });
          },
          "resolve target 'color' has format RGBA8, depth has D32F" },
        { "SameImageTwice",
          [](C& to) {
              recordPassWith(to, [](auto& d) {
                  d.layout.colorCount = 2;
                  d.layout.colorFormats[1] = Format::RGBA8;
                  d.colors[1] = d.colors[0];
              });
          },
          "colours 0 and 1 are the same image" },
        { "SamplesAndSubpasses",
          [](C& to) { recordPassWith(to, [](auto& d) { d.layout.samples = 4, d.layout.subpassCount = 2; }); },
          "samples > 1 excludes subpasses" },
        { "InputBeforeWritten", [](C& to) { recordPassWith(to, [](auto& d) { d.layout.subpasses[0].inputMask = 1; }); },
          "earlier ones wrote only 0x0" },
        { "TooManySubpasses", [](C& to) { inPass(to, [](C& in) { in.record(CmdNextSubpass{}); }); },
          "the pass has only 1 subpasses" },
        { "GroupLeftOpen", [](C& to) { to.record(CmdPushGroup{ "left" }); }, "group 'left' is still open",
          Outcome::Forwarded },
        { "PopWithoutPush", [](C& to) { to.record(CmdPopGroup{}); }, "no group is open", Outcome::Forwarded },
        { "TimerLeftOpen", [](C& to) { to.record(CmdBeginTimer{ { 3 } }); }, "1 timers are still open" },
        { "TimerNeverBegun", [](C& to) { to.record(CmdEndTimer{ { 3 } }); }, "timer 3 is not open" },
        { "TimersCrossed",
          [](C& to) {
              to.record(CmdBeginTimer{ { 3 } });
              to.record(CmdBeginTimer{ { 4 } });
              to.record(CmdEndTimer{ { 3 } });
              to.record(CmdEndTimer{ { 4 } });
          },
          "timer 4 began inside of timer 3" },
        { "FrameInFrame",
          [](C& to) {
              to.record(CmdBeginFrame{ 1 });
              to.record(CmdBeginFrame{ 2 });
          },
          "a frame is open", Outcome::Forwarded },
        { "EndOfNoFrame", [](C& to) { to.record(CmdEndFrame{ 1 }); }, "no frame is open", Outcome::Forwarded },
    };
}

std::vector<Case> surfaceCases() {
    const auto other = SurfaceHandle::make(7, 1);
    return {
        { "SurfaceOfNoWindow",
          [=](C& to) {
              to.record(CmdCreateSurface{ other, {} });
          },
          "the window is none" },
        { "SurfaceTwice",
          [](C& to) {
              to.record(CmdCreateSurface{ kWindow, { .window = 1 } });
          },
          "is in use" },
        { "PresentToNoSurface",
          [=](C& to) {
              to.record(CmdPresent{ other, kColor });
          },
          "the surface 0x100007" },
        { "PresentNoTexture",
          [](C& to) {
              to.record(CmdPresent{ kWindow, {} });
          },
          "the texture is none" },
        { "PresentInAPass", [](C& to) { inPass(to, [](C& in) {
                                            in.record(CmdPresent{ kWindow, kColor });
                                        }); },
          "only outside of passes" },
        { "PresentSamples",
          [](C& to) {
              to.record(CmdPresent{ kWindow, kSamples4 });
          },
          "lacks TextureUsage" },
        { "PresentLight",
          [](C& to) {
              const auto light = TextureHandle::make(20, 1);
              to.record(CmdCreateTexture{ light,
                                          { .format = Format::RGBA16F,
                                            .usage = TextureUsage::TransferSource,
                                            .width = 4,
                                            .height = 4,
                                            .debugName = "light" } });
              to.record(CmdPresent{ kWindow, light });
          },
          "'light' is RGBA16F; a window shows RGBA8 or RGB10A2", Outcome::Forwarded },
        { "SurfaceDestroyedTwice",
          [](C& to) {
              to.record(CmdDestroySurface{ kWindow });
              to.record(CmdDestroySurface{ kWindow });
          },
          "was destroyed" },
    };
}

std::vector<Case> drawCases() {
    return {
        { "NoPipeline",
          [](C& to) {
              to.record(CmdBeginPass{ passDesc() });
              to.record(CmdDraw{ .vertexCount = 3 });
              to.record(CmdEndPass{});
          },
          "no pipeline is bound" },
        { "PipelineOfAnotherPass",
          [](C& to) {
              PassDesc desc = passDesc();
              desc.layout.depthFormat = Format::None;
              desc.depth = {};
              inPass(
                      to, [](C&) {}, desc);
          },
          "made for another PassLayout" },
        { "GroupIndexOutOfRange",
          [](C& to) {
              inPass(to, [](C& in) { in.record(CmdBindGroup{ .group = kGroup, .index = 4, .dynamicCount = 1 }); });
          },
          "group index 4; 0..3" },
        { "DynamicOffsetMissing",
          [](C& to) { inPass(to, [](C& in) { in.record(CmdBindGroup{ .group = kGroup, .index = 1 }); }); },
          "0 dynamic offsets; the layout has 1" },
        { "DynamicOffsetUnaligned",
          [](C& to) {
              inPass(to, [](C& in) {
                  in.record(CmdBindGroup{ .group = kGroup, .index = 1, .dynamicCount = 1, .dynamicOffsets = { 4 } });
              });
          },
          "dynamic offset 4 is no multiple of 256" },
        { "DynamicOffsetBeyondTheEnd",
          [](C& to) {
              inPass(to, [](C& in) {
                  in.record(CmdBindGroup{ .group = kGroup, .index = 1, .dynamicCount = 1, .dynamicOffsets = { 512 } });
              });
          },
          "leave buffer 'uniforms' of 512 bytes" },
        { "VertexBufferWithoutUsage",
          [](C& to) {
              inPass(to, [](C& in) { in.record(CmdBindVertexBuffers{ .buffers = { kIndices }, .count = 1 }); });
          },
          "'indices' lacks BufferUsage::Vertex" },
        { "IndexBufferWithoutUsage",
          [](C& to) { inPass(to, [](C& in) { in.record(CmdBindIndexBuffer{ .buffer = kVertices }); }); },
          "lacks BufferUsage::Index" },
        { "IndexOffsetUnaligned",
          [](C& to) { inPass(to, [](C& in) { in.record(CmdBindIndexBuffer{ .buffer = kIndices, .offset = 1 }); }); },
          "no multiple of 2" },
        { "VertexBufferMissing",
          [](C& to) {
              inPass(to, [](C& in) {
                  in.record(CmdBindVertexBuffers{ .buffers = { kVertices }, .count = 1 });
                  in.record(CmdDraw{ .vertexCount = 3 });
              });
          },
          "attribute 5 reads vertex buffer 1, which is not bound" },
        { "IndexBufferMissing",
          [](C& to) {
              to.record(CmdBeginPass{ passDesc() });
              to.record(CmdBindPipeline{ kPipeline });
              to.record(CmdBindGroup{ .group = kGroup, .index = 1, .dynamicCount = 1 });
              to.record(CmdDrawIndexed{ .indexCount = 3 });
              to.record(CmdEndPass{});
          },
          "no index buffer is bound" },
        { "VerticesBeyondTheEnd", [](C& to) { inPass(to, [](C& in) { in.record(CmdDraw{ .vertexCount = 21 }); }); },
          "vertex 20 ends at byte 252" },
        { "InstancesBeyondTheEnd",
          [](C& to) {
              inPass(to,
                     [](C& in) { in.record(CmdDraw{ .vertexCount = 3, .instanceCount = 1, .firstInstance = 15 }); });
          },
          "instance 15 ends at byte 248" },
        { "IndicesBeyondTheEnd",
          [](C& to) { inPass(to, [](C& in) { in.record(CmdDrawIndexed{ .indexCount = 30, .firstIndex = 1 }); }); },
          "indices 1..31 leave index buffer 'indices' of 60 bytes" },
        { "SamplesItsOwnAttachment",
          [](C& to) {
              recordGroupWith(to, [](auto& e) { e[1].texture = kDepth; });
              inPass(to, [](C& in) {
                  in.record(CmdBindGroup{ .group = BindGroupHandle::make(20, 1), .index = 1, .dynamicCount = 1 });
                  in.record(CmdDraw{ .vertexCount = 3 });
              });
          },
          "samples 'depth', an attachment of this pass", Outcome::Forwarded },
        { "SamplesTheLevelThatItAttaches",
          [](C& to) {
              to.record(textureWith([](auto& d) {
                  d.usage = TextureUsage::Sampled | TextureUsage::ColorAttachment, d.levels = 2,
                  d.width = d.height = 32;
              }));
              recordGroupWith(to, [](auto& e) { e[1].texture = TextureHandle::make(20, 1), e[1].range = oneLevel(1); });
              PassDesc desc = passDesc();
              desc.colors[0] = { .texture = TextureHandle::make(20, 1), .level = 1 };
              inPass(
                      to,
                      [](C& in) {
                          in.record(
                                  CmdBindGroup{ .group = BindGroupHandle::make(20, 1), .index = 1, .dynamicCount = 1 });
                          in.record(CmdDraw{ .vertexCount = 3 });
                      },
                      desc);
          },
          "an attachment of this pass", Outcome::Forwarded },
        { "GroupOfADestroyedTexture",
          [](C& to) {
              to.record(CmdDestroyTexture{ kImage });
              inPass(to, [](C& in) { in.record(CmdDraw{ .vertexCount = 3 }); });
          },
          "texture at binding 3 of group 1 'material' 0x100002 was destroyed" },
        { "GroupLostByAPipelineOfAnotherLayout",
          [](C& to) {
              CmdCreateProgram program = createProgram();
              program.handle = ProgramHandle::make(20, 1);
              program.desc.layout[0] = { .bindings = { BindingDesc{} }, .count = 1 };
              to.record(program);
              recordPipelineWith(to, [](auto& d) { d.program = ProgramHandle::make(20, 1); });
              inPass(to, [](C& in) {
                  in.record(CmdBindPipeline{ PipelineHandle::make(20, 1) }); // disagrees in group 0: group 1 is lost
                  in.record(CmdBindPipeline{ kPipeline });
                  in.record(CmdDraw{ .vertexCount = 3 });
              });
          },
          "group 1 is not bound, or was lost" },
        { "EmptyViewport", [](C& to) { inPass(to, [](C& in) { in.record(CmdSetViewport{}); }); },
          "finite and not empty" },
        { "NegativeScissor", [](C& to) { inPass(to, [](C& in) {
                                             in.record(CmdSetScissor{ { -1, 0, 4, 4 } });
                                         }); },
          "begins outside" },
    };
}

CmdCreateProgram countProgramWith(std::function<void(ProgramDesc&)> const& change) {
    CmdCreateProgram program = createCountProgram();
    program.handle = ProgramHandle::make(20, 1);
    change(program.desc);
    return program;
}

void recordCountGroupWith(C& to, std::function<void(BindGroupEntry&)> const& changeStorage) {
    std::vector<BindGroupEntry> entries = countEntries();
    changeStorage(entries[0]);
    to.record(CmdCreateBindGroup{ BindGroupHandle::make(20, 1), { .layout = countLayout(), .entries = entries } });
}

std::vector<Case> computeCases() {
    static const std::vector<std::byte> code = bytes(20);
    return {
        { "ComputeBesideOtherStages", [](C& to) { to.record(countProgramWith([](auto& d) { d.vertex = code; })); },
          "or a compute stage alone" },
        { "ProgramWithoutStages", [](C& to) { to.record(countProgramWith([](auto& d) { d.compute = {}; })); },
          "or a compute stage alone" },
        { "DispatchSeesBindingsOfDraws",
          [](C& to) {
              to.record(countProgramWith([](auto& d) { d.layout[0].bindings[1].stages = ShaderStage::Fragment; }));
          },
          "group 0: binding 1 names stages that the program lacks" },
        { "DrawSeesBindingsOfDispatches",
          [](C& to) {
              CmdCreateProgram program = createProgram();
              program.handle = ProgramHandle::make(20, 1);
              program.desc.layout[1].bindings[1].stages = ShaderStage::Compute;
              to.record(program);
          },
          "group 1: binding 3 names stages that the program lacks" },
        { "DispatchWithAnInputAttachment",
          [](C& to) {
              to.record(countProgramWith([](auto& d) { d.layout[0].bindings[1].type = BindingType::InputAttachment; }));
          },
          "a dispatch has none" },
        { "StorageInTheVertexStage",
          [](C& to) {
              CmdCreateProgram program = createProgram();
              program.handle = ProgramHandle::make(20, 1);
              program.desc.layout[1].bindings[1] = { .binding = 3, .type = BindingType::StorageBuffer };
              to.record(program);
          },
          "of draws only the fragment stage reads them" },
        { "TooManyStorageBuffers",
          [](C& to) {
              to.record(countProgramWith([](auto& d) {
                  for (auto* group : { &d.layout[0], &d.layout[1] }) {
                      group->count = kMaxBindings;
                      for (uint8_t i = 0; i < kMaxBindings; ++i) {
                          group->bindings[i] = { .binding = i,
                                                 .type = BindingType::StorageBuffer,
                                                 .stages = ShaderStage::Compute };
                      }
                  }
              }));
          },
          "50 storage buffers; this device has 16 blocks" },
        { "StorageWithoutUsage", [](C& to) { recordCountGroupWith(to, [](auto& e) { e.buffer = kUniforms; }); },
          "'uniforms' lacks BufferUsage::Storage" },
        { "UnalignedStorage", [](C& to) { recordCountGroupWith(to, [](auto& e) { e.offset = 16; }); },
          "offset 16 is no multiple of 256 (DeviceLimits::storageOffsetAlignment)" },
        { "StorageBeyondTheBuffer", [](C& to) { recordCountGroupWith(to, [](auto& e) { e.size = 257; }); },
          "bytes 256..513 of buffer 'bins'" },
        { "DispatchInAPass", [](C& to) { inPass(to, [](C& in) { in.record(CmdDispatch{}); }); },
          "only outside of passes" },
        { "DispatchWithoutAPipeline", [](C& to) { to.record(CmdDispatch{}); }, "no pipeline is bound" },
        { "DispatchWithoutItsGroup",
          [](C& to) {
              to.record(CmdBindPipeline{ kCount });
              to.record(CmdDispatch{});
          },
          "group 0 is not bound" },
        { "DispatchOfNothing",
          [](C& to) {
              recordDispatch(to, { 1, 0, 1 });
          },
          "0 work groups; 1..65535" },
        { "DispatchOfTooMany",
          [](C& to) {
              recordDispatch(to, { 65536, 1, 1 });
          },
          "65536 work groups; 1..65535" },
        { "DrawPipelineOutsideOfPasses", [](C& to) { to.record(CmdBindPipeline{ kPipeline }); },
          "the pipeline is for draws; bind it inside of a pass" },
        { "DispatchPipelineInAPass", [](C& to) { inPass(to, [](C& in) { in.record(CmdBindPipeline{ kCount }); }); },
          "the pipeline is for dispatches; bind it outside of passes" },
        { "BindingsEndWithAPass",
          [](C& to) {
              recordDispatch(to);
              inPass(to, [](C&) {});
              to.record(CmdDispatch{});
          },
          "no pipeline is bound" },
        { "PipelineDestroyedBeforeTheDispatch",
          [](C& to) {
              to.record(CmdBindPipeline{ kCount });
              to.record(CmdBindGroup{ .group = kCountGroup });
              to.record(CmdDestroyPipeline{ kCount });
              to.record(CmdDispatch{});
          },
          "the pipeline 0x100001 was destroyed" },
        { "ReadBufferWithoutUsage",
          [](C& to) { to.record(CmdReadBuffer{ .buffer = kUniforms, .size = 4, .ticket = { 90 } }); },
          "lacks BufferUsage::TransferSource" },
        { "ReadBufferBeyondTheEnd",
          [](C& to) { to.record(CmdReadBuffer{ .buffer = kBins, .offset = 500, .size = 13, .ticket = { 90 } }); },
          "bytes 500..513 of a buffer of 512" },
        { "ReadBufferOfNothing", [](C& to) { to.record(CmdReadBuffer{ .buffer = kBins, .ticket = { 90 } }); },
          "bytes 0..0 of a buffer of 512" },
        { "ReadBufferWithoutTicket", [](C& to) { to.record(CmdReadBuffer{ .buffer = kBins, .size = 4 }); }, "ticket",
          Outcome::Forwarded },
    };
}

class ValidatedRule : public testing::TestWithParam<Case> {};

TEST_P(ValidatedRule, IsReportedAndDropsTheStreamOnlyIfADriverCouldCrash) {
    Errors errors;
    const std::unique_ptr<Driver> driver = validate(createNullDriver(errors), errors);
    CommandBuffer objects, broken;
    recordObjects(objects);
    driver->execute(objects.view());
    ASSERT_THAT(errors.messages, IsEmpty());
    const uint64_t before = driver->statistics().commands;
    GetParam().breakOne(broken);
    driver->execute(broken.view());
    ASSERT_FALSE(errors.messages.empty());
    EXPECT_THAT(errors.messages.front(), HasSubstr(GetParam().expected));
    const bool forwarded = driver->statistics().commands > before;
    EXPECT_EQ(forwarded, GetParam().outcome == Outcome::Forwarded);
    EXPECT_EQ(errors.messages.back().find("was dropped") == std::string::npos, forwarded);
}

const auto kCaseName = [](auto const& one) { return std::string(one.param.name); };
INSTANTIATE_TEST_SUITE_P(Objects, ValidatedRule, testing::ValuesIn(objectCases()), kCaseName);
INSTANTIATE_TEST_SUITE_P(BindGroups, ValidatedRule, testing::ValuesIn(groupCases()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Contents, ValidatedRule, testing::ValuesIn(contentCases()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Passes, ValidatedRule, testing::ValuesIn(passCases()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Compute, ValidatedRule, testing::ValuesIn(computeCases()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Surfaces, ValidatedRule, testing::ValuesIn(surfaceCases()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Draws, ValidatedRule, testing::ValuesIn(drawCases()), kCaseName);

} // namespace
} // namespace filament_core::backend
