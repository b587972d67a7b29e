// SPDX-License-Identifier: Apache-2.0
/// GlesTest: a driver on this thread, its handles, and its results.
#pragma once

#include "backend/gles/Executor.h"
#include "backend/stream/CommandBuffer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace filament_core::backend::gles {

class CollectingSink final : public ResultSink {
public:
    struct Report {
        DriverErrorKind kind;
        std::string message;
    };

    void onReadback(Ticket ticket, std::span<const std::byte> bytes) override {
        readbacks[ticket.value].assign(bytes.begin(), bytes.end());
    }
    void onTimer(Ticket ticket, uint64_t nanoseconds) override { timers[ticket.value] = nanoseconds; }
    void onError(DriverErrorKind kind, std::string_view message) override {
        errors.push_back({ kind, std::string(message) });
    }

    std::map<uint64_t, std::vector<std::byte>> readbacks;
    std::map<uint64_t, uint64_t> timers;
    std::vector<Report> errors;
};

inline constexpr std::string_view kFullScreenVertex = R"(#version 310 es
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0);
}
)";

inline std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

template <class T>
std::span<const std::byte> bytesOf(std::vector<T> const& values) {
    return std::as_bytes(std::span(values));
}

/// One colour attachment that is cleared and kept.
inline PassDesc colorPass(TextureHandle texture, Format format, uint32_t width, uint32_t height,
                          std::array<float, 4> clear = {}) {
    PassDesc pass;
    pass.layout.colorCount = 1;
    pass.layout.colorFormats[0] = format;
    pass.colors[0].texture = texture;
    pass.colors[0].clear = clear;
    pass.area = { 0, 0, width, height };
    pass.debugName = "test pass";
    return pass;
}

class GlesTest : public testing::Test {
protected:
    void SetUp() override { start(nullptr); }
    void TearDown() override {
        driver.reset();
        for (auto const& error : sink.errors) ADD_FAILURE() << "unexpected: " << error.message;
    }

    void start(QuirkFilter filter) {
        driver.reset();
        auto made = Executor::create({ .validation = true }, sink, filter);
        ASSERT_TRUE(made) << made.error().message;
        driver = std::move(*made);
    }

    void run() {
        driver->execute(commands.view());
        commands.reset();
    }

    TextureHandle texture(DeviceTextureDesc const& desc) {
        const TextureHandle handle = textures.allocate();
        commands.record(CmdCreateTexture{ handle, desc });
        return handle;
    }

    /// A texture to draw into and read from.
    TextureHandle target(Format format, uint32_t width, uint32_t height) {
        const TextureUsage attachment =
                hasDepth(format) ? TextureUsage::DepthAttachment : TextureUsage::ColorAttachment;
        DeviceTextureDesc desc;
        desc.format = format;
        desc.usage = attachment | TextureUsage::TransferSource | TextureUsage::Sampled;
        desc.width = width;
        desc.height = height;
        return texture(desc);
    }

    template <class T>
    BufferHandle buffer(std::vector<T> const& values, BufferUsage usage) {
        const BufferHandle handle = buffers.allocate();
        BufferDesc desc;
        desc.size = values.size() * sizeof(T);
        desc.usage = usage;
        commands.record(CmdCreateBuffer{ handle, desc });
        commands.record(CmdUpdateBuffer{ handle, 0, bytesOf(values) });
        return handle;
    }

    ProgramHandle program(std::string_view vertex, std::string_view fragment, ProgramLayout const& layout = {},
                          std::span<const ConstantValue> constants = {}) {
        const ProgramHandle handle = programs.allocate();
        ProgramDesc desc;
        desc.vertex = bytesOf(vertex);
        desc.fragment = bytesOf(fragment);
        desc.constants = constants;
        desc.layout = layout;
        desc.debugName = "test program";
        commands.record(CmdCreateProgram{ handle, desc });
        return handle;
    }

    PipelineHandle pipeline(PipelineDesc const& desc) {
        const PipelineHandle handle = pipelines.allocate();
        commands.record(CmdCreatePipeline{ handle, desc });
        return handle;
    }

    /// Draws without vertex buffers and without any test.
    PipelineHandle simplePipeline(ProgramHandle shader, PassLayout const& pass) {
        PipelineDesc desc;
        desc.program = shader;
        desc.pass = pass;
        desc.raster.cull = CullMode::None;
        return pipeline(desc);
    }

    BindGroupHandle bindGroup(BindGroupLayout const& layout, std::vector<BindGroupEntry> const& entries) {
        const BindGroupHandle handle = groups.allocate();
        BindGroupDesc desc;
        desc.layout = layout;
        desc.entries = entries;
        commands.record(CmdCreateBindGroup{ handle, desc });
        return handle;
    }

    /// A pass with one draw of a full-screen triangle.
    void drawFullScreen(PassDesc const& pass, PipelineHandle with) {
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ with });
        commands.record(CmdDraw{ .vertexCount = 3 });
        commands.record(CmdEndPass{});
    }

    /// Runs the recorded commands, waits, and returns the texels.
    template <class T>
    std::vector<T> read(TextureHandle from, Rect rect, uint8_t level = 0, uint16_t layer = 0) {
        const Ticket ticket{ ++lastTicket };
        commands.record(CmdReadTexture{ from, level, layer, rect, ticket });
        commands.record(CmdEndFrame{});
        run();
        driver->waitIdle();
        std::vector<std::byte> const& bytes = sink.readbacks[ticket.value];
        std::vector<T> values(bytes.size() / sizeof(T));
        if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }

    /// Expects exactly one error, of this kind and with this name, which the test provokes.
    void expectError(DriverErrorKind kind, std::string_view naming) {
        ASSERT_EQ(sink.errors.size(), 1u);
        EXPECT_EQ(sink.errors[0].kind, kind);
        EXPECT_NE(sink.errors[0].message.find(naming), std::string::npos) << sink.errors[0].message;
        EXPECT_EQ(sink.errors[0].message.find('\n'), std::string::npos) << "an error is one line";
        sink.errors.clear();
    }

    CollectingSink sink;
    std::unique_ptr<Driver> driver;
    CommandBuffer commands;
    HandleAllocator<BufferTag> buffers;
    HandleAllocator<TextureTag> textures;
    HandleAllocator<SamplerTag> samplers;
    HandleAllocator<ProgramTag> programs;
    HandleAllocator<PipelineTag> pipelines;
    HandleAllocator<BindGroupTag> groups;
    uint64_t lastTicket = 0;
};

} // namespace filament_core::backend::gles
