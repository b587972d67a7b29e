// SPDX-License-Identifier: Apache-2.0
#include "backend/null/NullDriver.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <unordered_map>
#include <vector>

namespace filament_core::backend {
namespace {

// Depth formats read back as D32F floats, whatever their format.
uint64_t readbackBytes(Format format, Rect const& rect) {
    return imageBytes(hasDepth(format) ? Format::D32F : format, rect.width, rect.height);
}

DeviceInfo describeNullDevice() {
    DeviceInfo info;
    info.backend = Backend::Null;
    info.shaderLanguage = ShaderLanguage::SpirV;
    info.deviceName = "no device";
    info.driverName = "null driver";
    info.limits = { .maxTextureSize = 16384,
                    .max3DTextureSize = 2048,
                    .maxColorAttachments = kMaxColorAttachments,
                    .maxUniformBlockBytes = 65536,
                    .uniformOffsetAlignment = 256,
                    .maxTextureUnits = 32,
                    .maxStorageBuffers = 16,
                    .maxFragmentStorageBuffers = 16,
                    .maxStorageBlockBytes = 1u << 27,
                    .storageOffsetAlignment = 256,
                    .maxDispatchGroups = 65535,
                    .maxGroupInvocations = 1024,
                    .maxGroupBytes = 32768,
                    .maxVertexAttributes = kMaxVertexAttributes,
                    .maxSamples = 4,
                    .maxAnisotropy = 16 };
    info.features = { .mergedPasses = true,
                      .timers = true,
                      .blockCompression = true,
                      .depthClamp = true,
                      .lastVertexProvokes = true,
                      .depthResolve = true,
                      .textureViews = true,
                      .cubeArrays = true,
                      .sharedMemory = true,
                      .srgbAttachments = true,
                      .primitiveIds = true,
                      .halfFloatShaders = true };
    return info;
}

class NullDriver final : public Driver {
public:
    explicit NullDriver(ResultSink& sink) : mSink(sink), mInfo(describeNullDevice()) {}

    DeviceInfo const& info() const override { return mInfo; }

    void execute(CommandView commands) override {
        replay(commands, *this);
        publish();
    }

    void waitIdle() override { answer(); }

    DriverStatistics statistics() const override {
        DriverStatistics copy;
        copy.commands = mPublished.commands.load(std::memory_order_relaxed);
        copy.draws = mPublished.draws.load(std::memory_order_relaxed);
        copy.dispatches = mPublished.dispatches.load(std::memory_order_relaxed);
        copy.pipelinesCreated = mPublished.pipelines.load(std::memory_order_relaxed);
        copy.programsCreated = mPublished.programs.load(std::memory_order_relaxed);
        copy.passes = mPublished.passes.load(std::memory_order_relaxed);
        copy.deviceBytes = mPublished.bytes.load(std::memory_order_relaxed);
        copy.presents = mPublished.presents.load(std::memory_order_relaxed);
        return copy;
    }

    /// Everything that the null driver ignores: state, contents, names.
    template <class C>
    void execute(C const&) {
        ++mCount.commands;
    }

    void execute(CmdCreateBuffer const& command) {
        ++mCount.commands;
        if (mBuffers.try_emplace(command.handle, command.desc.size).second) mCount.deviceBytes += command.desc.size;
    }
    void execute(CmdDestroyBuffer const& command) {
        ++mCount.commands;
        const auto it = mBuffers.find(command.handle);
        if (it == mBuffers.end()) return;
        mCount.deviceBytes -= it->second;
        mBuffers.erase(it);
    }
    void execute(CmdCreateTexture const& command) {
        ++mCount.commands;
        const Texture texture{ command.desc.format, textureBytes(command.desc) };
        if (mTextures.try_emplace(command.handle, texture).second) mCount.deviceBytes += texture.bytes;
    }
    void execute(CmdDestroyTexture const& command) {
        ++mCount.commands;
        const auto it = mTextures.find(command.handle);
        if (it == mTextures.end()) return;
        mCount.deviceBytes -= it->second.bytes;
        mTextures.erase(it);
    }
    void execute(CmdCreateProgram const&) { ++mCount.commands, ++mCount.programsCreated; }
    void execute(CmdCreatePipeline const&) { ++mCount.commands, ++mCount.pipelinesCreated; }
    void execute(CmdBeginPass const&) { ++mCount.commands, ++mCount.passes; }
    void execute(CmdDraw const&) { ++mCount.commands, ++mCount.draws; }
    void execute(CmdDrawIndexed const&) { ++mCount.commands, ++mCount.draws; }

    void execute(CmdDispatch const&) { ++mCount.commands, ++mCount.dispatches; }

    void execute(CmdCreateSurface const& command) {
        ++mCount.commands;
        constexpr std::array kSpaces{ std::byte{ static_cast<uint8_t>(OutputSpace::Srgb) } };
        if (command.desc.spaces) mSink.onReadback(command.desc.spaces, kSpaces);
    }

    void execute(CmdPresent const&) { ++mCount.commands, ++mCount.presents; }

    void execute(CmdReadBuffer const& command) {
        ++mCount.commands;
        mReadbacks.push_back({ command.ticket, mBuffers.contains(command.buffer) ? command.size : 0 });
    }
    void execute(CmdReadTexture const& command) {
        ++mCount.commands;
        const auto it = mTextures.find(command.texture);
        const bool isKnown = it != mTextures.end();
        mReadbacks.push_back({ command.ticket, isKnown ? readbackBytes(it->second.format, command.rect) : 0 });
    }
    void execute(CmdEndTimer const& command) {
        ++mCount.commands;
        mTimers.push_back(command.ticket);
    }
    void execute(CmdEndFrame const&) {
        ++mCount.commands;
        answer();
    }

private:
    struct Texture {
        Format format;
        uint64_t bytes;
    };
    struct Readback {
        Ticket ticket;
        uint64_t bytes;
    };
    struct Published {
        std::atomic<uint64_t> commands{ 0 }, draws{ 0 }, dispatches{ 0 }, pipelines{ 0 }, programs{ 0 }, passes{ 0 },
                bytes{ 0 }, presents{ 0 };
    };

    void answer() {
        // As every driver does, timers first.
        for (const Ticket ticket : mTimers) mSink.onTimer(ticket, 0);
        for (Readback const& readback : mReadbacks) {
            mZeros.resize(std::max<size_t>(mZeros.size(), readback.bytes));
            mSink.onReadback(readback.ticket, std::span(mZeros).first(readback.bytes));
        }
        mReadbacks.clear();
        mTimers.clear();
    }

    // Once for each stream: an atomic addition for each command would show in measurements of the layers above.
    void publish() {
        mPublished.commands.store(mCount.commands, std::memory_order_relaxed);
        mPublished.draws.store(mCount.draws, std::memory_order_relaxed);
        mPublished.dispatches.store(mCount.dispatches, std::memory_order_relaxed);
        mPublished.pipelines.store(mCount.pipelinesCreated, std::memory_order_relaxed);
        mPublished.programs.store(mCount.programsCreated, std::memory_order_relaxed);
        mPublished.passes.store(mCount.passes, std::memory_order_relaxed);
        mPublished.bytes.store(mCount.deviceBytes, std::memory_order_relaxed);
        mPublished.presents.store(mCount.presents, std::memory_order_relaxed);
    }

    ResultSink& mSink;
    const DeviceInfo mInfo;
    DriverStatistics mCount; // driver thread
    Published mPublished;    // any thread
    std::unordered_map<BufferHandle, uint64_t> mBuffers;
    std::unordered_map<TextureHandle, Texture> mTextures;
    std::vector<Readback> mReadbacks;
    std::vector<Ticket> mTimers;
    std::vector<std::byte> mZeros;
};

} // namespace

std::unique_ptr<Driver> createNullDriver(ResultSink& sink) { return std::make_unique<NullDriver>(sink); }

} // namespace filament_core::backend
