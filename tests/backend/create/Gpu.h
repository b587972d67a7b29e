// SPDX-License-Identifier: Apache-2.0
/// Gpu: describes what a test of the driver contract draws. One per test and API; it destroys what it created.
///   Stream  everything goes through CommandStream, the Validated layer and the API's own validation. Each API has one
///           stream per process, so that start-up is paid once.
///   Checks  finish() fails the test if the driver reported anything that the test did not take, or leaked device
///           memory.
#pragma once

#include "backend/stream/CommandStream.h"
#include "shaders/compiler/CompileProgram.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace filament_core::backend {

using Bytes = std::vector<std::byte>;
using Rgba = std::array<float, 4>;
inline constexpr Rgba kRed{ 1, 0, 0, 1 };
using Rgba8 = std::array<uint8_t, 4>;

template <class T>
Bytes bytesOf(std::vector<T> const& values) {
    Bytes bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// A triangle that covers the target; gl_Position.z = 0.5.
extern const std::string_view kFullScreenVertex;
/// Passes vertices through: location 0 vec4 position (clip space), location 1 vec4 color.
extern const std::string_view kColorVertex;
/// location 0 of the fragment stage: the color of kColorVertex.
extern const std::string_view kColorFragment;

/// A fragment stage of version 450 with `body` as main(); `declarations` come before it; it writes `vec4 result`.
std::string fragmentOf(std::string_view declarations, std::string_view body);

struct Program {
    ProgramHandle handle;
    ProgramLayout layout{};
};

/// What a full-screen draw into a new target needs; the rest has defaults.
struct Paint {
    uint32_t width = 4, height = 4;
    Format format = Format::RGBA32F;
    BindGroupHandle group{}; ///< at index 1
};

class Gpu {
public:
    explicit Gpu(CommandStream& stream);
    Gpu(Gpu const&) = delete;
    Gpu& operator=(Gpu const&) = delete;

    DeviceInfo const& info() const { return mStream.info(); }
    DriverStatistics statistics() const { return mStream.statistics(); }
    Backend backend() const { return info().backend; }
    /// A second one on the same stream; this one must have nothing open.
    Gpu another() { return Gpu(mStream); }

    // ---- objects
    BufferHandle buffer(BufferUsage usage, uint64_t size);
    template <class T>
    BufferHandle buffer(BufferUsage usage, std::vector<T> const& contents) {
        const BufferHandle handle = buffer(usage, contents.size() * sizeof(T));
        update(handle, contents);
        return handle;
    }
    TextureHandle texture(DeviceTextureDesc desc);
    /// A target that can also be sampled and read back.
    TextureHandle target(Format format, uint32_t width, uint32_t height, uint8_t samples = 1);
    /// A sampled 2D texture of one level.
    TextureHandle image(Format format, uint32_t width, uint32_t height, Bytes const& texels);
    SamplerHandle sampler(SamplerDesc desc = {});
    /// Compiles GLSL 450 for this API (once per process and text). Only listed uniform buffers are dynamic.
    Program program(std::string_view vertex, std::string_view fragment,
                    std::vector<ConstantValue> const& constants = {}, std::vector<shader::SetBinding> dynamic = {});
    /// The same for a compute stage.
    Program computeProgram(std::string_view glsl, std::vector<ConstantValue> const& constants = {},
                           std::vector<shader::SetBinding> dynamic = {});
    PipelineHandle computePipeline(Program const& program);
    /// Uses the code unchanged, for programs that must fail.
    ProgramHandle rawProgram(std::string_view vertex, std::string_view fragment);
    ProgramHandle rawComputeProgram(std::string_view text);
    PipelineHandle pipeline(PipelineDesc desc);
    BindGroupHandle group(Program const& program, uint32_t index, std::vector<BindGroupEntry> const& entries);
    BindGroupHandle imageGroup(Program const& program, TextureHandle texture, SamplerHandle sampler,
                               uint32_t index = 1);

    CommandStream& stream() { return mStream; }

    // ---- commands
    CommandBuffer& commands(); ///< of the open submission
    template <class C>
    void record(C const& command) {
        commands().record(command);
    }
    template <class T>
    void update(BufferHandle handle, std::vector<T> const& contents, uint64_t offset = 0) {
        record(CmdUpdateBuffer{ handle, offset, std::as_bytes(std::span(contents)) });
    }
    void upload(TextureHandle texture, Rect rect, Bytes const& texels, uint8_t level = 0, uint16_t layer = 0,
                uint16_t layers = 1);
    /// A full-screen draw into a new target of paint.format; returns the target.
    TextureHandle paint(Program const& program, Paint const& paint = {});
    /// groups[i] at index i + firstGroup.
    void dispatch(PipelineHandle pipeline, std::vector<BindGroupHandle> const& groups, CmdDispatch const& size,
                  uint8_t firstGroup = 0);
    void submit();
    Ticket nextTicket() { return mStream.nextTicket(); }
    uint64_t timerOf(Ticket ticket); ///< waits for it
    void destroyAll();               ///< records it; more may follow in the same submission
    void destroyEarly(ProgramHandle program);

    // ---- answers
    /// Waits. The texels are also compared between the two APIs.
    Bytes read(TextureHandle texture, Rect rect, uint8_t level = 0, uint16_t layer = 0);
    template <class T>
    std::vector<T> readAs(TextureHandle texture, Rect rect, uint8_t level = 0, uint16_t layer = 0) {
        const Bytes bytes = read(texture, rect, level, layer);
        std::vector<T> values(bytes.size() / sizeof(T));
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
        EXPECT_EQ(bytes.size(), size_t{ rect.width } * rect.height * sizeof(T));
        values.resize(size_t{ rect.width } * rect.height);
        return values;
    }
    template <class T>
    std::vector<T> readBuffer(BufferHandle buffer, size_t count, uint64_t offset = 0) {
        const Bytes bytes = readBytes(buffer, offset, count * sizeof(T));
        std::vector<T> values(count);
        EXPECT_EQ(bytes.size(), count * sizeof(T));
        if (bytes.size() == count * sizeof(T)) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    Bytes readBytes(BufferHandle buffer, uint64_t offset, uint64_t size);
    Bytes wait(Ticket ticket); ///< of a CmdReadTexture that the test recorded
    /// Errors so far; a test that provokes errors takes them.
    std::vector<DriverError> takeErrors();

    /// Destroys everything and checks for errors. Returns all read-backs in order.
    std::vector<Bytes> finish();

private:
    ProgramHandle rawProgram(ProgramDesc desc);

    CommandStream& mStream;
    uint32_t mHandlesBefore = 0;
    CommandBuffer* mOpen = nullptr;
    uint64_t mFrame = 0;
    uint64_t mBytesBefore = 0;
    std::vector<std::function<void()>> mDestroy;
    std::vector<Bytes> mReadbacks;
    ProgramHandle mDestroyedEarly;
};

/// A pass over these textures of these formats, all cleared to 0 and stored.
PassDesc passOver(std::initializer_list<std::pair<TextureHandle, Format>> colors, uint32_t width, uint32_t height);
/// No culling, no depth, triangles without vertex buffers.
PipelineDesc pipelineFor(Program const& program, PassLayout const& pass);
/// Adds the vertex layout of kColorVertex: buffer 0, stride 32.
void useColorVertices(PipelineDesc& desc);

struct ColorVertex {
    Rgba position, color;
};

// ---------------------------------------------------------------------------------------------- one test, three runs

enum class Run : uint8_t { Vulkan, Gles, SameBits };
std::string nameOf(Run run);

class DriverContract : public testing::TestWithParam<Run> {
protected:
    /// Runs the body on one API, or on both to compare all that they read back.
    void runOn(void (*body)(Gpu&));

private:
    static void skipReason(Backend backend);
};

} // namespace filament_core::backend

/// DRIVER_SUITE once a file, then DRIVER_TEST(Suite, Name) { ... gpu ... }: runs on each API, then compares both.
#define DRIVER_SUITE(Suite)                                                                                            \
    class Suite : public DriverContract {};                                                                            \
    INSTANTIATE_TEST_SUITE_P(Driver, Suite, testing::Values(Run::Vulkan, Run::Gles, Run::SameBits),                    \
                             [](auto const& run) { return nameOf(run.param); })

#define DRIVER_TEST(Suite, Name)                                                                                       \
    static void Suite##Name(Gpu& gpu);                                                                                 \
    TEST_P(Suite, Name) { runOn(&Suite##Name); }                                                                       \
    static void Suite##Name([[maybe_unused]] Gpu& gpu)
