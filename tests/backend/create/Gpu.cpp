// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/create/Gpu.h"

#include "backend/create/CreateDriver.h"
#include "backend/layers/Validated.h"

#include <chrono>
#include <map>
#include <thread>
#include <utility>

namespace filament_core::backend {

const std::string_view kFullScreenVertex = R"(#version 450
void main() {
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    gl_Position = vec4(corner * 4.0 - 1.0, 0.5, 1.0);
})";

const std::string_view kColorVertex = R"(#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 vertexColor;
void main() {
    vertexColor = color;
    gl_Position = position;
})";

const std::string_view kColorFragment = R"(#version 450
layout(location = 0) in vec4 vertexColor;
layout(location = 0) out vec4 result;
void main() { result = vertexColor; })";

std::string fragmentOf(std::string_view declarations, std::string_view body) {
    return "#version 450\nlayout(location = 0) out vec4 result;\n" + std::string(declarations) + "\nvoid main() {\n" +
           std::string(body) + "\n}\n";
}

namespace {

// ---------------------------------------------------------------------------------------------- streams of the process

struct StreamOrReason {
    std::unique_ptr<CommandStream> stream;
    std::string reason; ///< why there is none
};

StreamOrReason startStream(Backend type) {
    auto stream = CommandStream::start([type](ResultSink& sink) -> Result<std::unique_ptr<Driver>> {
        Result<std::unique_ptr<Driver>> driver = createDriver(type, { .requireDevice = {}, .validation = true }, sink);
        if (!driver) return driver.error();
        return validate(std::move(*driver), sink);
    });
    if (!stream) return { nullptr, stream.error().message };
    return { std::move(*stream), {} };
}

std::map<Backend, StreamOrReason>& streams() {
    static std::map<Backend, StreamOrReason> made;
    return made;
}

StreamOrReason& streamOf(Backend type) {
    const auto it = streams().find(type);
    return it != streams().end() ? it->second : streams().emplace(type, startStream(type)).first->second;
}

// Drivers must end before the libraries below them unload at exit; leaks of the drivers are errors of this program.
class CloseStreams final : public testing::Environment {
    void TearDown() override { streams().clear(); }
};
const auto* gCloseStreams = testing::AddGlobalTestEnvironment(new CloseStreams);

// ---------------------------------------------------------------------------------------------- compiled programs

using SourcePair = std::pair<std::string, std::string>;

shader::ProgramShaders const* compiled(std::string_view vertex, std::string_view fragment,
                                       std::vector<shader::SetBinding> const& dynamic) {
    static std::map<SourcePair, Result<shader::ProgramShaders>> cache;
    SourcePair key{ vertex, fragment };
    for (const shader::SetBinding at : dynamic) key.first += fmt::format("//{}.{}", at.set, at.binding);
    auto it = cache.find(key);
    if (it == cache.end()) {
        shader::ProgramCompileOptions options;
        options.dynamicUniformBuffers = dynamic;
        it = cache.emplace(std::move(key), shader::compileProgram(vertex, fragment, options)).first;
    }
    if (it->second) return &*it->second;
    ADD_FAILURE() << it->second.error().message;
    return nullptr;
}

shader::ComputeShader const* compiledCompute(std::string_view glsl, std::vector<shader::SetBinding> const& dynamic) {
    static std::map<std::string, Result<shader::ComputeShader>, std::less<>> cache;
    auto it = cache.find(glsl);
    if (it == cache.end()) {
        shader::ProgramCompileOptions options;
        options.dynamicUniformBuffers = dynamic;
        it = cache.emplace(std::string(glsl), shader::compileCompute(glsl, options)).first;
    }
    if (it->second) return &*it->second;
    ADD_FAILURE() << it->second.error().message;
    return nullptr;
}

template <class T>
std::span<const std::byte> codeBytes(T const& code) {
    return std::as_bytes(std::span(code.data(), code.size()));
}

} // namespace

// ---------------------------------------------------------------------------------------------- objects

Gpu::Gpu(CommandStream& stream) : mStream(stream), mHandlesBefore(stream.liveHandles()) {
    submit(); // an empty frame: afterwards the driver has allocated its own objects
    mStream.waitIdle();
    mBytesBefore = mStream.statistics().deviceBytes;
}

BufferHandle Gpu::buffer(BufferUsage usage, uint64_t size) {
    const BufferHandle handle = mStream.allocateBuffer();
    record(CmdCreateBuffer{ handle, { .size = size, .usage = usage, .debugName = "test buffer" } });
    mDestroy.push_back([this, handle] { record(CmdDestroyBuffer{ handle }), mStream.free(handle); });
    return handle;
}

TextureHandle Gpu::texture(DeviceTextureDesc desc) {
    const TextureHandle handle = mStream.allocateTexture();
    if (desc.debugName.empty()) desc.debugName = "test texture";
    record(CmdCreateTexture{ handle, desc });
    mDestroy.push_back([this, handle] { record(CmdDestroyTexture{ handle }), mStream.free(handle); });
    return handle;
}

TextureHandle Gpu::target(Format format, uint32_t width, uint32_t height, uint8_t samples) {
    using enum TextureUsage;
    TextureUsage usage = hasDepth(format) ? DepthAttachment : ColorAttachment;
    if (samples == 1) usage = usage | Sampled | TransferSource;
    return texture({ .format = format,
                     .usage = usage,
                     .samples = samples,
                     .width = width,
                     .height = height,
                     .debugName = "target" });
}

TextureHandle Gpu::image(Format format, uint32_t width, uint32_t height, Bytes const& texels) {
    using enum TextureUsage;
    const TextureHandle handle =
            texture({ .format = format, .usage = Sampled | TransferTarget, .width = width, .height = height });
    upload(handle, { 0, 0, width, height }, texels);
    return handle;
}

SamplerHandle Gpu::sampler(SamplerDesc desc) {
    const SamplerHandle handle = mStream.allocateSampler();
    record(CmdCreateSampler{ handle, desc });
    mDestroy.push_back([this, handle] { record(CmdDestroySampler{ handle }), mStream.free(handle); });
    return handle;
}

Program Gpu::program(std::string_view vertex, std::string_view fragment, std::vector<ConstantValue> const& constants,
                     std::vector<shader::SetBinding> dynamic) {
    shader::ProgramShaders const* shaders = compiled(vertex, fragment, dynamic);
    const Program program{ mStream.allocateProgram(), shaders ? shaders->layout : ProgramLayout{} };
    mDestroy.push_back([this, handle = program.handle] { mStream.free(handle); });
    if (!shaders) return program;
    const bool spirv = info().shaderLanguage == ShaderLanguage::SpirV;
    ProgramDesc desc;
    desc.vertex = spirv ? codeBytes(shaders->vertexSpirv) : codeBytes(shaders->vertexEssl);
    desc.fragment = spirv ? codeBytes(shaders->fragmentSpirv) : codeBytes(shaders->fragmentEssl);
    desc.constants = constants;
    desc.layout = shaders->layout;
    desc.debugName = "test program";
    record(CmdCreateProgram{ program.handle, desc });
    mDestroy.push_back([this, handle = program.handle] {
        if (handle != mDestroyedEarly) record(CmdDestroyProgram{ handle });
    });
    return program;
}

Program Gpu::computeProgram(std::string_view glsl, std::vector<ConstantValue> const& constants,
                            std::vector<shader::SetBinding> dynamic) {
    shader::ComputeShader const* shader = compiledCompute(glsl, dynamic);
    const Program program{ mStream.allocateProgram(), shader ? shader->layout : ProgramLayout{} };
    mDestroy.push_back([this, handle = program.handle] { mStream.free(handle); });
    if (!shader) return program;
    ProgramDesc desc;
    desc.compute = info().shaderLanguage == ShaderLanguage::SpirV ? codeBytes(shader->spirv) : codeBytes(shader->essl);
    desc.constants = constants;
    desc.layout = shader->layout;
    desc.debugName = "test program";
    record(CmdCreateProgram{ program.handle, desc });
    mDestroy.push_back([this, handle = program.handle] { record(CmdDestroyProgram{ handle }); });
    return program;
}

PipelineHandle Gpu::computePipeline(Program const& program) { return pipeline({ .program = program.handle }); }

ProgramHandle Gpu::rawProgram(std::string_view vertex, std::string_view fragment) {
    return rawProgram({ .vertex = codeBytes(vertex), .fragment = codeBytes(fragment) });
}

ProgramHandle Gpu::rawComputeProgram(std::string_view text) { return rawProgram({ .compute = codeBytes(text) }); }

ProgramHandle Gpu::rawProgram(ProgramDesc desc) {
    const ProgramHandle handle = mStream.allocateProgram();
    desc.debugName = "broken program";
    record(CmdCreateProgram{ handle, desc });
    mDestroy.push_back([this, handle] { record(CmdDestroyProgram{ handle }), mStream.free(handle); });
    return handle;
}

PipelineHandle Gpu::pipeline(PipelineDesc desc) {
    const PipelineHandle handle = mStream.allocatePipeline();
    if (desc.debugName.empty()) desc.debugName = "test pipeline";
    record(CmdCreatePipeline{ handle, desc });
    mDestroy.push_back([this, handle] { record(CmdDestroyPipeline{ handle }), mStream.free(handle); });
    return handle;
}

BindGroupHandle Gpu::group(Program const& program, uint32_t index, std::vector<BindGroupEntry> const& entries) {
    const BindGroupHandle handle = mStream.allocateBindGroup();
    record(CmdCreateBindGroup{ handle,
                               { .layout = program.layout[index], .entries = entries, .debugName = "test group" } });
    mDestroy.push_back([this, handle] { record(CmdDestroyBindGroup{ handle }), mStream.free(handle); });
    return handle;
}

BindGroupHandle Gpu::imageGroup(Program const& program, TextureHandle texture, SamplerHandle sampler, uint32_t index) {
    const uint8_t binding = program.layout[index].bindings[0].binding;
    return group(program, index, { { .binding = binding, .texture = texture, .sampler = sampler } });
}

// ---------------------------------------------------------------------------------------------- commands

CommandBuffer& Gpu::commands() {
    if (!mOpen) {
        mOpen = &mStream.acquire();
        mOpen->record(CmdBeginFrame{ ++mFrame });
    }
    return *mOpen;
}

void Gpu::submit() {
    static_cast<void>(commands());
    record(CmdEndFrame{ mFrame });
    mStream.submit(*std::exchange(mOpen, nullptr));
}

void Gpu::upload(TextureHandle texture, Rect rect, Bytes const& texels, uint8_t level, uint16_t layer,
                 uint16_t layers) {
    record(CmdUploadTexture{
            .texture = texture, .level = level, .layer = layer, .layerCount = layers, .rect = rect, .bytes = texels });
}

TextureHandle Gpu::paint(Program const& program, Paint const& paint) {
    const TextureHandle texture = target(paint.format, paint.width, paint.height);
    const PassDesc pass = passOver({ { texture, paint.format } }, paint.width, paint.height);
    const PipelineHandle painter = pipeline(pipelineFor(program, pass.layout));
    record(CmdBeginPass{ pass });
    record(CmdBindPipeline{ painter });
    if (paint.group) record(CmdBindGroup{ .group = paint.group, .index = 1 });
    record(CmdDraw{ .vertexCount = 3 });
    record(CmdEndPass{});
    return texture;
}

void Gpu::dispatch(PipelineHandle pipeline, std::vector<BindGroupHandle> const& groups, CmdDispatch const& size,
                   uint8_t firstGroup) {
    record(CmdBindPipeline{ pipeline });
    for (size_t i = 0; i < groups.size(); ++i) {
        record(CmdBindGroup{ .group = groups[i], .index = static_cast<uint8_t>(firstGroup + i) });
    }
    record(size);
}

// ---------------------------------------------------------------------------------------------- answers

Bytes Gpu::read(TextureHandle texture, Rect rect, uint8_t level, uint16_t layer) {
    const Ticket ticket = mStream.nextTicket();
    record(CmdReadTexture{ .texture = texture, .level = level, .layer = layer, .rect = rect, .ticket = ticket });
    return wait(ticket);
}

Bytes Gpu::readBytes(BufferHandle buffer, uint64_t offset, uint64_t size) {
    const Ticket ticket = mStream.nextTicket();
    record(CmdReadBuffer{ .buffer = buffer, .offset = offset, .size = size, .ticket = ticket });
    return wait(ticket);
}

Bytes Gpu::wait(Ticket ticket) {
    if (mOpen) submit();
    Result<Bytes> bytes = mStream.waitReadback(ticket);
    EXPECT_TRUE(bytes.ok()) << bytes.error().message;
    mReadbacks.push_back(bytes.ok() ? std::move(*bytes) : Bytes{});
    return mReadbacks.back();
}

uint64_t Gpu::timerOf(Ticket ticket) {
    if (mOpen) submit();
    mStream.waitIdle();
    const std::optional<uint64_t> nanoseconds = mStream.takeTimer(ticket);
    EXPECT_TRUE(nanoseconds.has_value()) << "timer " << ticket.value << " was not answered by an idle device";
    return nanoseconds.value_or(0);
}

std::vector<DriverError> Gpu::takeErrors() {
    if (mOpen) submit();
    mStream.waitIdle();
    return mStream.takeErrors();
}

void Gpu::destroyAll() {
    for (; !mDestroy.empty(); mDestroy.pop_back()) mDestroy.back()();
}

void Gpu::destroyEarly(ProgramHandle program) {
    record(CmdDestroyProgram{ program });
    mDestroyedEarly = program;
}

std::vector<Bytes> Gpu::finish() {
    destroyAll();
    for (DriverError const& error : takeErrors()) ADD_FAILURE() << error.message;
    EXPECT_EQ(mStream.liveHandles(), mHandlesBefore);
    EXPECT_EQ(mStream.statistics().deviceBytes, mBytesBefore) << "device memory is kept after everything was destroyed";
    return std::move(mReadbacks);
}

PassDesc passOver(std::initializer_list<std::pair<TextureHandle, Format>> colors, uint32_t width, uint32_t height) {
    PassDesc desc;
    for (auto const& [texture, format] : colors) {
        desc.layout.colorFormats[desc.layout.colorCount] = attachmentFormat(format);
        desc.colors[desc.layout.colorCount++].texture = texture;
    }
    desc.area = { 0, 0, width, height };
    desc.debugName = "test pass";
    return desc;
}

PipelineDesc pipelineFor(Program const& program, PassLayout const& pass) {
    PipelineDesc desc;
    desc.program = program.handle;
    desc.pass = pass;
    desc.raster.cull = CullMode::None;
    return desc;
}

void useColorVertices(PipelineDesc& desc) {
    desc.vertices.attributes[0] = { .location = 0, .buffer = 0, .format = VertexFormat::Float4, .offset = 0 };
    desc.vertices.attributes[1] = { .location = 1, .buffer = 0, .format = VertexFormat::Float4, .offset = 16 };
    desc.vertices.attributeCount = 2;
    desc.vertices.buffers[0].stride = sizeof(ColorVertex);
    desc.vertices.bufferCount = 1;
}

// ---------------------------------------------------------------------------------------------- one test, three runs

namespace {

/// What a test read back on one API; kept to compare both.
using Answers = std::vector<Bytes>;

Answers const* runOnce(std::string const& test, Backend backend, void (*body)(Gpu&)) {
    static std::map<std::pair<std::string, Backend>, Answers> done;
    const auto key = std::pair(test, backend);
    if (const auto it = done.find(key); it != done.end()) return &it->second;
    StreamOrReason& stream = streamOf(backend);
    if (!stream.stream) return nullptr;
    Gpu gpu(*stream.stream);
    body(gpu);
    return &(done[key] = gpu.finish());
}

void expectSameBits(Answers const& a, Answers const& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].size(), b[i].size()) << "read-back " << i;
        size_t different = 0, first = a[i].size();
        for (size_t at = a[i].size(); at-- > 0;) {
            if (a[i][at] == b[i][at]) continue;
            ++different;
            first = at;
        }
        EXPECT_EQ(different, 0u) << "read-back " << i << ": " << different << " of " << a[i].size()
                                 << " bytes differ between Vulkan and OpenGL ES, first at byte " << first;
    }
}

} // namespace

std::string nameOf(Run run) { return run == Run::Vulkan ? "Vulkan" : run == Run::Gles ? "Gles" : "SameBits"; }

void DriverContract::runOn(void (*body)(Gpu&)) {
    testing::TestInfo const& info = *testing::UnitTest::GetInstance()->current_test_info();
    const std::string full = std::string(info.test_suite_name()) + "." + info.name();
    const std::string test = full.substr(0, full.rfind('/'));
    const auto run = [&](Backend backend) -> Answers const* {
        Answers const* answers = runOnce(test, backend, body);
        if (!answers) skipReason(backend);
        return answers;
    };
    if (GetParam() == Run::Vulkan) static_cast<void>(run(Backend::Vulkan));
    if (GetParam() == Run::Gles) static_cast<void>(run(Backend::Gles));
    if (GetParam() != Run::SameBits) return;
    Answers const* vulkan = run(Backend::Vulkan);
    Answers const* gles = vulkan ? run(Backend::Gles) : nullptr;
    if (gles) expectSameBits(*vulkan, *gles);
}

void DriverContract::skipReason(Backend backend) {
    GTEST_SKIP() << "no " << toString(backend) << " driver: " << streamOf(backend).reason;
}

} // namespace filament_core::backend
