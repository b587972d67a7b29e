// SPDX-License-Identifier: Apache-2.0
#include "backend/create/SelfTest.h"

#include "backend/create/SelfTestShaders.h"
#include "backend/stream/CommandBuffer.h"
#include "base/BlobStore.h"
#include "base/Hash.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

namespace filament_core::backend {
namespace {

constexpr uint32_t kSide = 8;
constexpr uint32_t kColors = 4;  // in the storage buffer
constexpr uint8_t kStep = 16;    // from one of them to the next
constexpr uint64_t kVersion = 1; // of the test: drivers that passed another one are tested again
constexpr uint64_t kNoteBytes = 1 << 16;

using Pixel = std::array<uint8_t, 4>;
using Picture = std::array<Pixel, size_t{ kSide } * kSide>;
constexpr Pixel kBackground{ 51, 102, 51, 51 };

/// Results of a driver go to its user, and to the test while that runs.
class ForwardingSink final : public ResultSink {
public:
    void onReadback(Ticket ticket, std::span<const std::byte> bytes) override {
        if (target) return target->onReadback(ticket, bytes);
        readbacks[ticket.value].assign(bytes.begin(), bytes.end());
    }
    void onTimer(Ticket ticket, uint64_t nanoseconds) override {
        if (target) target->onTimer(ticket, nanoseconds);
    }
    void onError(DriverErrorKind kind, std::string_view message) override {
        if (target) return target->onError(kind, message);
        if (error.empty()) error = message;
    }

    ResultSink* target = nullptr; ///< null during the test
    std::map<uint64_t, std::vector<std::byte>> readbacks;
    std::string error;
};

/// What the test did is not the app's: its counts of commands, draws and pipelines begin at zero.
DriverStatistics without(DriverStatistics all, DriverStatistics const& part) {
    using Count = uint64_t DriverStatistics::*;
    for (const Count count : { &DriverStatistics::commands, &DriverStatistics::draws, &DriverStatistics::dispatches,
                               &DriverStatistics::pipelinesCreated, &DriverStatistics::programsCreated,
                               &DriverStatistics::programsFromCache, &DriverStatistics::pipelinesFromCache,
                               &DriverStatistics::passes, &DriverStatistics::pipelinesCreatedInPasses })
        all.*count -= part.*count;
    return all;
}

class TestedDriver final : public Driver {
public:
    TestedDriver(std::unique_ptr<ForwardingSink> sink, std::unique_ptr<Driver> driver)
            : mSink(std::move(sink)), mDriver(std::move(driver)), mOfTest(mDriver->statistics()) {}

    DeviceInfo const& info() const override { return mDriver->info(); }
    void execute(CommandView commands) override { mDriver->execute(commands); }
    void waitIdle() override { mDriver->waitIdle(); }
    DriverStatistics statistics() const override { return without(mDriver->statistics(), mOfTest); }

private:
    std::unique_ptr<ForwardingSink> mSink; // outlives the driver
    std::unique_ptr<Driver> mDriver;
    DriverStatistics mOfTest;
};

constexpr Ticket kLightTicket{ 1 }, kNegativeTicket{ 2 };

/// The commands of the frame. Handles are numbered here: all are destroyed before anybody else makes some.
class Frame {
public:
    explicit Frame(DeviceInfo const& info) : mInfo(info) { record(); }

    CommandView view() const { return mCommands.view(); }

private:
    template <class H>
    static H handle(uint32_t index) {
        return H::make(index, 1);
    }

    void record() {
        createObjects();
        // The light pass reads what these two write: that it sees it is part of the test.
        fillColors();
        drawDepth();
        drawLight();
        read(mLight, kLightTicket);
        if (mInfo.features.mergedPasses) read(mNegative, kNegativeTicket);
        // All objects exist before the first pass, inside of which nothing can be created.
        mCommands.append(std::move(mDraws));
        destroyObjects();
    }

    void createObjects() {
        using enum TextureUsage;
        const TextureUsage read = ColorAttachment | TransferSource;
        createTexture(mDepth, Format::D32F, DepthAttachment);
        createTexture(mLight, Format::RGBA8, mInfo.features.mergedPasses ? read | InputAttachment : read);
        createTexture(mNegative, Format::RGBA8, read);
        mCommands.record(CmdCreateBuffer{
                mColors,
                { .size = kColors * 4 * sizeof(float), .usage = BufferUsage::Storage, .debugName = "self-test" } });
    }

    void createTexture(TextureHandle texture, Format format, TextureUsage usage) {
        mCommands.record(CmdCreateTexture{
                texture,
                { .format = format, .usage = usage, .width = kSide, .height = kSide, .debugName = "self-test" } });
    }

    void destroyObjects() {
        for (uint32_t i = 1; i <= mGroups; ++i) mCommands.record(CmdDestroyBindGroup{ handle<BindGroupHandle>(i) });
        for (uint32_t i = 1; i <= mPipelines; ++i) {
            mCommands.record(CmdDestroyPipeline{ handle<PipelineHandle>(i) });
            mCommands.record(CmdDestroyProgram{ handle<ProgramHandle>(i) });
        }
        for (const TextureHandle texture : { mDepth, mLight, mNegative })
            mCommands.record(CmdDestroyTexture{ texture });
        mCommands.record(CmdDestroyBuffer{ mColors });
    }

    /// Creates the pipeline with a program of its own, and binds it.
    void bindPipeline(PipelineDesc desc, ProgramDesc program) {
        ++mPipelines;
        desc.program = handle<ProgramHandle>(mPipelines);
        desc.debugName = program.debugName = "self-test";
        mCommands.record(CmdCreateProgram{ desc.program, program });
        const auto pipeline = handle<PipelineHandle>(mPipelines);
        mCommands.record(CmdCreatePipeline{ pipeline, desc });
        mDraws.record(CmdBindPipeline{ pipeline });
    }

    std::span<const std::byte> shader(std::string_view file) const {
        return selfTestShader(file, mInfo.shaderLanguage);
    }

    void bindGroup(BindGroupLayout const& layout, BindGroupEntry const& entry, uint8_t index) {
        const auto group = handle<BindGroupHandle>(++mGroups);
        mCommands.record(CmdCreateBindGroup{ group, { .layout = layout, .entries = { &entry, 1 } } });
        mDraws.record(CmdBindGroup{ .group = group, .index = index });
    }

    static BindGroupLayout colorsLayout(ShaderStage stage) {
        BindGroupLayout layout{ .count = 1 };
        layout.bindings[0] = { .type = BindingType::StorageBuffer, .stages = stage };
        return layout;
    }

    void bindColors(ShaderStage stage) {
        bindGroup(colorsLayout(stage), { .buffer = mColors, .size = kColors * 4 * sizeof(float) }, 0);
    }

    void fillColors() {
        ProgramDesc program{ .compute = shader("fill.comp") };
        program.layout[0] = colorsLayout(ShaderStage::Compute);
        bindPipeline({}, program);
        bindColors(ShaderStage::Compute);
        mDraws.record(CmdDispatch{});
    }

    void drawDepth() {
        PassDesc pass{ .layout = { .depthFormat = Format::D32F }, .area = kArea, .debugName = "self-test" };
        pass.depth = { .texture = mDepth, .clear = { 1.0f } };
        mDraws.record(CmdBeginPass{ pass });
        bindPipeline({ .pass = pass.layout,
                       .raster = kBothSides,
                       .depthStencil = { .depthCompare = CompareOp::Always, .depthWrite = true } },
                     { .vertex = shader("full_screen.vert"), .fragment = shader("depth.frag") });
        mDraws.record(CmdDraw{ .vertexCount = 3 });
        mDraws.record(CmdEndPass{});
    }

    /// Adds the colours to the background where the depth of before is greater: in the left half.
    void drawLight() {
        const PassDesc pass = lightPass();
        mDraws.record(CmdBeginPass{ pass });
        ProgramDesc program{ .vertex = shader("full_screen.vert"), .fragment = shader("light.frag") };
        program.layout[0] = colorsLayout(ShaderStage::Fragment);
        PipelineDesc desc{ .pass = pass.layout,
                           .raster = kBothSides,
                           .depthStencil = { .depthCompare = CompareOp::Less } };
        desc.blend[0] = { .enabled = true, .dstColor = BlendFactor::One, .writeMask = 0b0111 };
        bindPipeline(desc, program);
        bindColors(ShaderStage::Fragment);
        mDraws.record(CmdDraw{ .vertexCount = 3 });
        if (pass.layout.subpassCount > 1) drawNegative(pass);
        mDraws.record(CmdEndPass{});
    }

    PassDesc lightPass() const {
        PassDesc pass{ .area = kArea, .debugName = "self-test" };
        pass.layout = { .colorFormats = { Format::RGBA8, Format::RGBA8 },
                        .depthFormat = Format::D32F,
                        .colorCount = 1 };
        pass.colors[0] = { .texture = mLight };
        for (size_t i = 0; i < kBackground.size(); ++i)
            pass.colors[0].clear[i] = static_cast<float>(kBackground[i]) / 255.0f;
        pass.depth = { .texture = mDepth, .load = LoadOp::Load };
        if (mInfo.features.mergedPasses) {
            pass.layout.colorCount = 2;
            pass.layout.subpassCount = 2;
            pass.layout.subpasses[0] = { .colorMask = 1 };
            pass.layout.subpasses[1] = { .colorMask = 2, .inputMask = 1, .usesDepth = false };
            pass.colors[1] = { .texture = mNegative };
        }
        return pass;
    }

    void drawNegative(PassDesc const& pass) {
        mDraws.record(CmdNextSubpass{});
        ProgramDesc program{ .vertex = shader("full_screen.vert"), .fragment = shader("negative.frag") };
        BindGroupLayout layout{ .count = 1 };
        layout.bindings[0] = { .type = BindingType::InputAttachment, .stages = ShaderStage::Fragment };
        program.layout[1] = layout;
        bindPipeline({ .pass = pass.layout, .subpass = 1, .raster = kBothSides }, program);
        bindGroup(layout, { .texture = mLight }, 1);
        mDraws.record(CmdDraw{ .vertexCount = 3 });
    }

    void read(TextureHandle texture, Ticket ticket) {
        mDraws.record(CmdReadTexture{ .texture = texture, .rect = kArea, .ticket = ticket });
    }

    static constexpr Rect kArea{ 0, 0, kSide, kSide };
    static constexpr RasterState kBothSides{ .cull = CullMode::None };

    DeviceInfo const& mInfo;
    CommandBuffer mCommands, mDraws; // objects are created outside of passes: before all of them
    const TextureHandle mDepth = handle<TextureHandle>(1), mLight = handle<TextureHandle>(2),
                        mNegative = handle<TextureHandle>(3);
    const BufferHandle mColors = handle<BufferHandle>(1);
    uint32_t mPipelines = 0, mGroups = 0; // numbered from 1
};

Picture expectedLight() {
    Picture picture;
    for (size_t i = 0; i < picture.size(); ++i) {
        picture[i] = kBackground;
        const size_t x = i % kSide;
        for (size_t c = 0; c < 3 && x < kSide / 2; ++c)
            picture[i][c] = static_cast<uint8_t>(kBackground[c] + kStep * (x % kColors + 1) * (c + 1));
    }
    return picture;
}

Picture negativeOf(Picture picture) {
    for (Pixel& pixel : picture) {
        for (size_t c = 0; c < 3; ++c) pixel[c] = static_cast<uint8_t>(255 - pixel[c]);
    }
    return picture;
}

/// What is wrong with the bytes of a read-back; empty: nothing.
std::string mistakeOf(std::vector<std::byte> const& bytes, Picture const& expected, std::string_view what) {
    if (bytes.size() != sizeof(Picture)) return fmt::format("{} was not read back", what);
    Picture seen;
    std::memcpy(seen.data(), bytes.data(), sizeof(seen));
    const auto [at, wanted] = std::ranges::mismatch(seen, expected);
    if (at == seen.end()) return {};
    const auto index = static_cast<size_t>(at - seen.begin());
    return fmt::format("{} is ({}) at pixel {}, {} instead of ({})", what, fmt::join(*at, ", "), index % kSide,
                       index / kSide, fmt::join(*wanted, ", "));
}

/// Empty: the driver draws what it should.
std::string mistakeOf(Driver& driver, ForwardingSink& results) {
    driver.execute(Frame(driver.info()).view());
    driver.waitIdle();
    // The error says more than a wrong pixel.
    if (!results.error.empty()) return results.error;
    const Picture light = expectedLight();
    std::string mistake = mistakeOf(results.readbacks[kLightTicket.value], light, "what is blended");
    if (mistake.empty() && driver.info().features.mergedPasses)
        mistake = mistakeOf(results.readbacks[kNegativeTicket.value], negativeOf(light),
                            "what reads an input attachment");
    return mistake;
}

uint64_t keyOf(DeviceInfo const& info) {
    return hashString(toString(info.backend), hashString(info.driverName, hashString(info.deviceName, kVersion)));
}

Error refusal(DeviceInfo const& info, std::string const& mistake) {
    return fail(ErrorCode::Unsupported,
                "{} with {} draws wrong pictures: in a test of {} x {} pixels {}. Install another version of this "
                "driver, or choose another device (EngineOptions::requireDevice); EngineOptions::driverSelfTest = "
                "false uses it as it is",
                info.deviceName, info.driverName, kSide, kSide, mistake);
}

/// Devices without storage buffers for fragment shaders are none of the engine's.
bool canBeTested(DeviceInfo const& info) {
    return info.backend != Backend::Null && info.limits.maxFragmentStorageBuffers > 0;
}

Result<void> testDriver(Driver& driver, ForwardingSink& results) {
    ResultSink* const user = std::exchange(results.target, nullptr);
    const std::string mistake = mistakeOf(driver, results);
    results.target = user;
    results.readbacks.clear();
    return mistake.empty() ? Result<void>{} : refusal(driver.info(), mistake);
}

/// Once for each driver: those that passed are noted in a file.
Result<void> testOnce(Driver& driver, ForwardingSink& results, std::filesystem::path const& notes) {
    BlobStore passed(notes / "tested-drivers", 0, kNoteBytes);
    const uint64_t key = keyOf(driver.info());
    if (!passed.find(key).empty()) return {};
    if (const Result<void> right = testDriver(driver, results); !right) return right;
    passed.put(key, std::as_bytes(std::span(driver.info().driverName)));
    passed.save();
    return {};
}

} // namespace

Result<std::unique_ptr<Driver>> makeTestedDriver(MakeDriver const& make, ResultSink& sink,
                                                 std::filesystem::path const& notes) {
    auto results = std::make_unique<ForwardingSink>();
    results->target = &sink;
    Result<std::unique_ptr<Driver>> driver = make(*results);
    if (!driver) return driver;
    if (canBeTested((*driver)->info())) {
        const Result<void> right = notes.empty() ? testDriver(**driver, *results) : testOnce(**driver, *results, notes);
        if (!right) return right.error();
    }
    return std::unique_ptr<Driver>(std::make_unique<TestedDriver>(std::move(results), std::move(*driver)));
}

} // namespace filament_core::backend
