// SPDX-License-Identifier: Apache-2.0
/// A Vulkan driver with validation, and shortcuts for what the tests of this folder record.
///   Skips the test if the machine has no Vulkan device; fails it if validation reports anything.
#pragma once

#include "backend/stream/CommandBuffer.h"
#include "backend/vulkan/Executor.h"
#include "tests/backend/vulkan/ShaderText.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace filament_core::backend::vulkan {

/// Keeps every answer.
class CollectingSink final : public ResultSink {
public:
    void onReadback(Ticket ticket, std::span<const std::byte> bytes) override {
        readbacks[ticket.value].assign(bytes.begin(), bytes.end());
    }
    void onTimer(Ticket ticket, uint64_t nanoseconds) override { timers[ticket.value] = nanoseconds; }
    void onError(DriverErrorKind kind, std::string_view message) override {
        errors.push_back({ kind, std::string(message) });
    }

    uint32_t countErrors(DriverErrorKind kind) const {
        uint32_t count = 0;
        for (auto const& error : errors) count += error.kind == kind;
        return count;
    }

    struct Failure {
        DriverErrorKind kind;
        std::string message;
    };
    std::map<uint64_t, std::vector<std::byte>> readbacks;
    std::map<uint64_t, uint64_t> timers;
    std::vector<Failure> errors;
};

using Rgba8 = std::array<uint8_t, 4>;
inline constexpr Rgba8 kRed{ 255, 0, 0, 255 };
inline constexpr RasterState kNoCulling{ .cull = CullMode::None };

class DriverTest : public ::testing::Test {
protected:
    void SetUp() override { start(); }

    /// The driver, with the quirks of its device changed by `filter`.
    void start(QuirkFilter filter = nullptr) {
        auto made = Executor::create({ .validation = true }, sink, filter);
        if (!made && made.error().code == ErrorCode::DeviceUnavailable) GTEST_SKIP() << made.error().message;
        ASSERT_TRUE(made) << made.error().message;
        driver = std::move(*made);
    }

    void TearDown() override {
        driver.reset(); // validation also reports objects destroyed too late or never
        for (auto const& error : sink.errors) {
            const bool isValidation = error.kind == DriverErrorKind::Validation;
            EXPECT_TRUE(!isValidation) << error.message;
        }
    }

    /// Replays the recorded commands and starts over.
    void replay() {
        driver->execute(commands.view());
        commands.reset();
    }
    void finish() {
        replay();
        driver->waitIdle();
    }

    template <class H>
    H handle() {
        return H::make(mNextIndex++, 1);
    }
    Ticket ticket() { return { mNextTicket++ }; }

    BufferHandle makeBuffer(BufferUsage usage, std::span<const std::byte> bytes);
    template <class T>
    BufferHandle makeBuffer(BufferUsage usage, std::vector<T> const& values) {
        return makeBuffer(usage, std::as_bytes(std::span(values)));
    }
    TextureHandle makeTexture(DeviceTextureDesc const& desc);
    /// A renderable, readable, sampled 2D texture.
    TextureHandle makeTarget(uint32_t width, uint32_t height, Format format = Format::RGBA8);
    ProgramHandle makeProgram(std::string const& vertex, std::string const& fragment, ProgramLayout const& layout = {},
                              std::span<const ConstantValue> constants = {});
    PipelineHandle makePipeline(PipelineDesc const& desc);
    BindGroupHandle makeGroup(BindGroupLayout const& layout, std::vector<BindGroupEntry> const& entries);

    static PassLayout colorLayout(Format format = Format::RGBA8);
    /// One colour attachment, cleared.
    void beginPass(TextureHandle color, uint32_t width, uint32_t height, std::array<float, 4> clear = {},
                   Format format = Format::RGBA8);
    void endPass() { commands.record(CmdEndPass{}); }

    /// Records a read-back, finishes, and returns the bytes.
    std::vector<std::byte> read(TextureHandle texture, uint32_t width, uint32_t height, uint8_t level = 0,
                                uint16_t layer = 0);
    std::vector<Rgba8> readPixels(TextureHandle texture, uint32_t width, uint32_t height, uint8_t level = 0,
                                  uint16_t layer = 0);
    std::vector<float> readFloats(TextureHandle texture, uint32_t width, uint32_t height, uint8_t level = 0);

    CollectingSink sink;
    std::unique_ptr<Executor> driver;
    CommandBuffer commands;

private:
    uint32_t mNextIndex = 1;
    uint64_t mNextTicket = 1;
};

/// A triangle that covers the whole image, from the vertex index.
inline const std::string kFullScreenVertex = R"(
void main() {
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.5, 1.0);
})";

inline const std::string kRedFragment = R"(
layout(location = 0) out vec4 color;
void main() { color = vec4(1.0, 0.0, 0.0, 1.0); })";

} // namespace filament_core::backend::vulkan
