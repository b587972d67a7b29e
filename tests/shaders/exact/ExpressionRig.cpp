// SPDX-License-Identifier: Apache-2.0
#include "tests/shaders/exact/ExpressionRig.h"

#include <cstring>
#include <random>

namespace filament_core::shader::test {
namespace {

using namespace backend;

constexpr std::string_view kVertex = R"(#version 450
void main() {
    gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.5, 1.0);
}
)";

constexpr std::string_view kPrelude = R"(#version 450
layout(set = 0, binding = 0, std140) uniform Matrices { mat4 m; mat4 n; };
layout(set = 0, binding = 1) uniform sampler2D inputA;
layout(set = 0, binding = 2) uniform sampler2D inputB;
layout(set = 0, binding = 3) uniform sampler2D inputC;
layout(set = 0, binding = 4) uniform sampler2D inputP;
layout(set = 0, binding = 5) uniform sampler2D smooth_;
layout(set = 0, binding = 6) uniform samplerCube cube;
layout(constant_id = 0) const float kSpec = 3.0;
layout(location = 0) out vec4 color;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 a = texelFetch(inputA, at, 0), b = texelFetch(inputB, at, 0), c = texelFetch(inputC, at, 0), p = texelFetch(inputP, at, 0);
)";

std::vector<float> randomFloats(size_t count, uint32_t seed, float low, float high) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> distribution(low, high);
    std::vector<float> values(count);
    for (float& value : values) value = distribution(random);
    return values;
}

std::span<const std::byte> bytesOf(std::vector<float> const& values) { return std::as_bytes(std::span(values)); }

} // namespace

std::unique_ptr<ExpressionRig> ExpressionRig::make(Backend type) {
    auto stream = CommandStream::start([type](ResultSink& sink) { return createDriver(type, {}, sink); });
    if (!stream) return nullptr;
    std::unique_ptr<ExpressionRig> rig(new ExpressionRig(std::move(*stream)));
    rig->createInputs();
    return rig;
}

TextureHandle ExpressionRig::randomTexture(CommandBuffer& commands, uint32_t seed, float low, float high) {
    const TextureHandle handle = mStream->allocateTexture();
    commands.record(CmdCreateTexture{ handle,
                                      { .format = Format::RGBA32F,
                                        .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                        .width = kSide,
                                        .height = kSide,
                                        .debugName = "input" } });
    const std::vector<float> texels = randomFloats(kSide * kSide * 4, seed, low, high);
    commands.record(CmdUploadTexture{ .texture = handle, .rect = { 0, 0, kSide, kSide }, .bytes = bytesOf(texels) });
    return handle;
}

TextureHandle ExpressionRig::mippedTexture(CommandBuffer& commands, TextureKind type, uint32_t seed) {
    const TextureHandle handle = mStream->allocateTexture();
    const auto layers = static_cast<uint16_t>(type == TextureKind::Cube ? 6 : 1);
    constexpr uint8_t kLevels = 4;
    commands.record(CmdCreateTexture{ handle,
                                      { .type = type,
                                        .format = Format::RGBA8,
                                        .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                        .levels = kLevels,
                                        .layers = layers,
                                        .width = 32,
                                        .height = 32,
                                        .debugName = "mipped" } });
    std::mt19937 random(seed);
    for (uint8_t level = 0; level < kLevels; ++level) { // uploaded, not generated: only the sampling is under test
        const uint32_t side = 32u >> level;
        std::vector<std::byte> texels(static_cast<size_t>(side) * side * 4 * layers);
        for (std::byte& texel : texels) texel = static_cast<std::byte>(random());
        commands.record(CmdUploadTexture{ .texture = handle,
                                          .level = level,
                                          .layerCount = layers,
                                          .rect = { 0, 0, side, side },
                                          .bytes = texels });
    }
    return handle;
}

void ExpressionRig::createInputs() {
    CommandBuffer& commands = mStream->acquire();
    const BufferHandle matrices = mStream->allocateBuffer();
    const std::vector<float> elements = randomFloats(32, 7, -2.0f, 2.0f);
    commands.record(CmdCreateBuffer{ matrices, { elements.size() * sizeof(float), BufferUsage::Uniform, "matrices" } });
    commands.record(CmdUpdateBuffer{ .buffer = matrices, .bytes = bytesOf(elements) });
    const SamplerHandle nearest = mStream->allocateSampler(), trilinear = mStream->allocateSampler();
    commands.record(CmdCreateSampler{ nearest, {} });
    commands.record(CmdCreateSampler{ trilinear,
                                      { .magFilter = Filter::Linear,
                                        .minFilter = Filter::Linear,
                                        .mipFilter = MipFilter::Linear,
                                        .wrapU = WrapMode::Repeat,
                                        .wrapV = WrapMode::Repeat } });
    mEntries = { { .binding = 0, .buffer = matrices, .size = 128 },
                 { .binding = 1, .texture = randomTexture(commands, 1, -4.0f, 4.0f), .sampler = nearest },
                 { .binding = 2, .texture = randomTexture(commands, 2, -4.0f, 4.0f), .sampler = nearest },
                 { .binding = 3, .texture = randomTexture(commands, 3, -4.0f, 4.0f), .sampler = nearest },
                 { .binding = 4, .texture = randomTexture(commands, 4, 0.001f, 0.999f), .sampler = nearest },
                 { .binding = 5, .texture = mippedTexture(commands, TextureKind::Texture2D, 5), .sampler = trilinear },
                 { .binding = 6, .texture = mippedTexture(commands, TextureKind::Cube, 6), .sampler = trilinear } };
    mTarget = mStream->allocateTexture();
    commands.record(CmdCreateTexture{ mTarget,
                                      { .format = Format::RGBA32F,
                                        .usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource,
                                        .width = kSide,
                                        .height = kSide,
                                        .debugName = "target" } });
    mStream->submit(commands);
}

void ExpressionRig::draw(CommandBuffer& commands, ProgramShaders const& shaders, BindGroupHandle group) {
    const ProgramHandle program = mStream->allocateProgram();
    const PipelineHandle pipeline = mStream->allocatePipeline();
    const bool spirv = mStream->info().shaderLanguage == ShaderLanguage::SpirV;
    commands.record(CmdCreateProgram{ program,
                                      { .vertex = spirv ? std::as_bytes(std::span(shaders.vertexSpirv))
                                                        : std::as_bytes(std::span(shaders.vertexEssl)),
                                        .fragment = spirv ? std::as_bytes(std::span(shaders.fragmentSpirv))
                                                          : std::as_bytes(std::span(shaders.fragmentEssl)),
                                        .layout = shaders.layout,
                                        .debugName = "expression" } });
    PassLayout layout{ .colorCount = 1 };
    layout.colorFormats[0] = Format::RGBA32F;
    commands.record(CmdCreatePipeline{
            pipeline,
            { .program = program, .pass = layout, .raster = { .cull = CullMode::None }, .debugName = "expression" } });
    PassDesc pass{ .layout = layout, .area = { 0, 0, kSide, kSide }, .debugName = "expression" };
    pass.colors[0] = { .texture = mTarget };
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdBindGroup{ .group = group });
    commands.record(CmdDraw{ .vertexCount = 3 });
    commands.record(CmdEndPass{});
    commands.record(CmdDestroyPipeline{ pipeline });
    commands.record(CmdDestroyProgram{ program });
    mStream->free(pipeline);
    mStream->free(program);
}

Result<std::vector<uint32_t>> ExpressionRig::values(std::string const& expression, bool exact,
                                                    std::string const& statements) {
    // Every input is mentioned, so that all expressions share one layout.
    const std::string keep =
            "    if (a.x > 1e30) color = m[0] + n[0] + texture(smooth_, a.xy) + texture(cube, a.xyz);\n";
    const std::string fragment =
            std::string(kPrelude) + statements + "\n    color = " + expression + ";\n" + keep + "}\n";
    const Result<ProgramShaders> shaders = compileProgram(
            kVertex, fragment,
            { .exact = exact, .dynamicUniformBuffers = std::vector<SetBinding>{}, .fragmentName = expression });
    if (!shaders) return shaders.error();

    CommandBuffer& commands = mStream->acquire();
    const BindGroupHandle group = mStream->allocateBindGroup();
    commands.record(
            CmdCreateBindGroup{ group, { .layout = shaders->layout[0], .entries = mEntries, .debugName = "inputs" } });
    draw(commands, *shaders, group);
    const Ticket ticket = mStream->nextTicket();
    commands.record(CmdReadTexture{ .texture = mTarget, .rect = { 0, 0, kSide, kSide }, .ticket = ticket });
    commands.record(CmdDestroyBindGroup{ group });
    mStream->free(group);
    mStream->submit(commands);
    const Result<std::vector<std::byte>> bytes = mStream->waitReadback(ticket);
    for (DriverError const& error : mStream->takeErrors()) return fail(ErrorCode::Internal, "{}", error.message);
    if (!bytes) return bytes.error();
    std::vector<uint32_t> words(bytes->size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes->data(), bytes->size());
    return words;
}

} // namespace filament_core::shader::test
