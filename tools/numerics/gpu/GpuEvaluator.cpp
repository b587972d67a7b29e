// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/gpu/GpuEvaluator.h"

#include "tools/numerics/gpu/ShaderText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace filament_core::shader::numerics {

using namespace backend;

namespace {

constexpr uint32_t kWidth = 512;
constexpr size_t kRowsPerProgram = 8;

/// The three inputs, padded to whole lines of pixels.
struct Texels {
    std::array<std::vector<glm::vec4>, 3> inputs;
    uint32_t height = 0;
};

Texels texelsOf(std::span<const Task> tasks) {
    Texels texels;
    for (size_t i = 0; i < tasks.size(); ++i) {
        for (Point const& point : tasks[i].points) {
            texels.inputs[0].push_back(point.s);
            texels.inputs[1].emplace_back(point.u, static_cast<float>(i));
            texels.inputs[2].emplace_back(point.v, 0.0f);
        }
    }
    texels.height = static_cast<uint32_t>((texels.inputs[0].size() + kWidth - 1) / kWidth);
    for (auto& input : texels.inputs) input.resize(size_t{ kWidth } * texels.height, glm::vec4(0.0f));
    return texels;
}

std::span<const std::byte> codeOf(std::vector<uint32_t> const& spirv, std::string const& essl,
                                  ShaderLanguage language) {
    return language == ShaderLanguage::SpirV ? std::as_bytes(std::span(spirv)) : std::as_bytes(std::span(essl));
}

} // namespace

struct GpuEvaluator::Group {
    uint32_t height = 0;
    std::array<TextureHandle, 3> inputs;
    TextureHandle target;
    ProgramHandle program;
    PipelineHandle pipeline;
    BindGroupHandle bindings;
};

Result<std::unique_ptr<GpuEvaluator>> GpuEvaluator::make(Backend type, std::string library) {
    auto stream = CommandStream::start([type](ResultSink& sink) { return createDriver(type, {}, sink); });
    if (!stream) return stream.error();
    std::unique_ptr<GpuEvaluator> evaluator(new GpuEvaluator(std::move(*stream), std::move(library)));
    CommandBuffer& commands = evaluator->mStream->acquire();
    evaluator->mNearest = evaluator->mStream->allocateSampler();
    commands.record(CmdCreateSampler{ evaluator->mNearest, {} });
    evaluator->mStream->submit(commands);
    return evaluator;
}

std::string GpuEvaluator::deviceName() const {
    return fmt::format("{}, {}", mStream->info().deviceName, mStream->info().driverName);
}

Result<std::vector<Results>> GpuEvaluator::evaluate(std::span<const Task> tasks, numerics::Format format) {
    std::vector<Results> results;
    for (size_t first = 0; first < tasks.size(); first += kRowsPerProgram) {
        const auto group = tasks.subspan(first, std::min(kRowsPerProgram, tasks.size() - first));
        if (const Result<void> done = evaluateGroup(group, format, results); !done) return done.error();
    }
    return results;
}

TextureHandle GpuEvaluator::createTexture(CommandBuffer& commands, Group const& group,
                                          std::span<const glm::vec4> texels) {
    const TextureHandle texture = mStream->allocateTexture();
    const bool input = !texels.empty();
    commands.record(CmdCreateTexture{ texture,
                                      { .format = backend::Format::RGBA32F,
                                        .usage = input ? TextureUsage::Sampled | TextureUsage::TransferTarget
                                                       : TextureUsage::ColorAttachment | TextureUsage::TransferSource,
                                        .width = kWidth,
                                        .height = group.height,
                                        .debugName = input ? "points" : "results" } });
    if (input)
        commands.record(CmdUploadTexture{
                .texture = texture, .rect = { 0, 0, kWidth, group.height }, .bytes = std::as_bytes(texels) });
    return texture;
}

void GpuEvaluator::draw(CommandBuffer& commands, Group const& group) {
    PassLayout layout{ .colorCount = 1 };
    layout.colorFormats[0] = backend::Format::RGBA32F;
    commands.record(CmdCreatePipeline{ group.pipeline,
                                       { .program = group.program,
                                         .pass = layout,
                                         .raster = { .cull = CullMode::None },
                                         .debugName = "shader functions" } });
    PassDesc pass{ .layout = layout, .area = { 0, 0, kWidth, group.height }, .debugName = "shader functions" };
    pass.colors[0] = { .texture = group.target };
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ group.pipeline });
    commands.record(CmdBindGroup{ .group = group.bindings });
    commands.record(CmdDraw{ .vertexCount = 3 });
    commands.record(CmdEndPass{});
}

Result<std::vector<glm::vec4>> GpuEvaluator::read(Group const& group) {
    CommandBuffer& commands = mStream->acquire();
    const Ticket ticket = mStream->nextTicket();
    commands.record(
            CmdReadTexture{ .texture = group.target, .rect = { 0, 0, kWidth, group.height }, .ticket = ticket });
    commands.record(CmdDestroyBindGroup{ group.bindings });
    commands.record(CmdDestroyPipeline{ group.pipeline });
    commands.record(CmdDestroyProgram{ group.program });
    mStream->free(group.bindings);
    mStream->free(group.pipeline);
    mStream->free(group.program);
    for (const TextureHandle texture : { group.inputs[0], group.inputs[1], group.inputs[2], group.target }) {
        commands.record(CmdDestroyTexture{ texture });
        mStream->free(texture);
    }
    mStream->submit(commands);
    const Result<std::vector<std::byte>> bytes = mStream->waitReadback(ticket);
    for (DriverError const& error : mStream->takeErrors()) return fail(ErrorCode::Internal, "{}", error.message);
    if (!bytes) return bytes.error();
    std::vector<glm::vec4> texels(bytes->size() / sizeof(glm::vec4));
    std::memcpy(texels.data(), bytes->data(), bytes->size());
    return texels;
}

Result<void> GpuEvaluator::evaluateGroup(std::span<const Task> tasks, numerics::Format format,
                                         std::vector<Results>& results) {
    std::vector<Row const*> rows;
    for (Task const& task : tasks) rows.push_back(task.row);
    const ShaderLanguage language = mStream->info().shaderLanguage;
    const Result<ProgramShaders> shaders = groupProgram(mLibrary, rows, format);
    if (!shaders) return shaders.error();

    const Texels texels = texelsOf(tasks);
    Group group{ .height = texels.height,
                 .program = mStream->allocateProgram(),
                 .pipeline = mStream->allocatePipeline(),
                 .bindings = mStream->allocateBindGroup() };
    CommandBuffer& commands = mStream->acquire();
    std::vector<BindGroupEntry> entries;
    for (uint8_t i = 0; i < group.inputs.size(); ++i) {
        group.inputs[i] = createTexture(commands, group, texels.inputs[i]);
        entries.push_back({ .binding = i, .texture = group.inputs[i], .sampler = mNearest });
    }
    group.target = createTexture(commands, group, {});
    commands.record(CmdCreateProgram{ group.program,
                                      { .vertex = codeOf(shaders->vertexSpirv, shaders->vertexEssl, language),
                                        .fragment = codeOf(shaders->fragmentSpirv, shaders->fragmentEssl, language),
                                        .layout = shaders->layout,
                                        .debugName = "shader functions" } });
    commands.record(CmdCreateBindGroup{ group.bindings,
                                        { .layout = shaders->layout[0], .entries = entries, .debugName = "points" } });
    draw(commands, group);
    mStream->submit(commands);

    const Result<std::vector<glm::vec4>> all = read(group);
    if (!all) return all.error();
    auto next = all->begin();
    for (Task const& task : tasks) {
        const auto end = next + static_cast<std::ptrdiff_t>(task.points.size());
        results.emplace_back(next, end);
        next = end;
    }
    return {};
}

} // namespace filament_core::shader::numerics
