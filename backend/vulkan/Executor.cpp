// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Executor.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace filament_core::backend::vulkan {
namespace {

/// Counts commands, and drops the rest of the stream once the device is lost.
struct Dispatch {
    Executor& executor;
    uint64_t& count;
    bool const& isLost;

    template <class C>
    void execute(C const& command) {
        ++count;
        if (!isLost) [[likely]]
            executor.execute(command);
    }
};

} // namespace

// ---------------------------------------------------------------------------------------------- life time

Result<std::unique_ptr<Executor>> Executor::create(DriverOptions const& options, ResultSink& sink, QuirkFilter filter) {
    auto instance = Instance::create(options.validation ? &sink : nullptr, options.display);
    if (!instance) return instance.error();
    std::vector<PhysicalDevice> devices = surveyDevices(**instance);
    const Result<size_t> choice = chooseDevice(devices, options.requireDevice);
    if (!choice) return choice.error();
    if (filter) filter(devices[*choice].quirks);
    auto device = Device::create(std::move(*instance), std::move(devices[*choice]));
    if (!device) return device.error();
    return create(std::move(*device), sink, options.cacheDirectory);
}

Result<std::unique_ptr<Executor>> Executor::create(std::unique_ptr<Device> device, ResultSink& sink,
                                                   std::filesystem::path const& cacheDirectory) {
    std::unique_ptr<Executor> executor(new Executor(std::move(device), sink));
    if (Result<void> ready = executor->initialize(cacheDirectory); !ready) return ready.error();
    return executor;
}

Executor::Executor(std::unique_ptr<Device> device, ResultSink& sink) : mDevice(std::move(device)), mSink(sink) {
    mRenderPasses.emplace(*mDevice);
    mFramebuffers.emplace(*mDevice);
    mPass.emplace(*mDevice, mTextures, mBarriers, *mRenderPasses, *mFramebuffers);
    mLayouts.emplace(*mDevice);
    mTimers.emplace(*mDevice);
    mReadbacks.emplace(*mDevice);
    mSubmissions.emplace(*mDevice);
    mUpload.emplace(*mDevice, *mSubmissions);
}

Result<void> Executor::initialize(std::filesystem::path const& cacheDirectory) {
    if (const VkResult result = mSubmissions->initialize(); result != VK_SUCCESS) {
        return errorFromResult(result, "Vulkan: command buffers");
    }
    mProgramCache.emplace(*mDevice, cacheDirectory);
    constexpr uint64_t kZeroBytes = 256;
    auto zeros =
            Buffer::create(*mDevice, { kZeroBytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, MemoryPurpose::Upload, "zeros" });
    if (!zeros) return zeros.error();
    mZeros = std::move(*zeros);
    if (!mZeros->mapped()) return fail(ErrorCode::OutOfMemory, "Vulkan: no host-visible memory can be mapped");
    std::memset(mZeros->mapped(), 0, kZeroBytes);
    mDraws.emplace(mDevice->fn(), mZeros->handle());
    return {};
}

Executor::~Executor() {
    // A command buffer cannot be ended inside of a render pass.
    if (!mIsLost && !mPass->isOpen()) submitAtEnd();
    mDevice->fn().vkDeviceWaitIdle(mDevice->handle()); // fails at once if the device is lost
    if (mProgramCache && !mIsLost) mProgramCache->save();
}

void Executor::submitAtEnd() {
    try {
        submit();
    } catch (std::bad_alloc const&) { // then nothing is submitted
    }
}

DriverStatistics Executor::statistics() const {
    const std::lock_guard lock(mPublishedMutex);
    return mPublished;
}

void Executor::publishStatistics() {
    // The staging ring belongs to the driver, not to an object of the stream.
    mStatistics.deviceBytes = mDevice->memory().statistics().usedBytes - mUpload->ringBytes();
    const std::lock_guard lock(mPublishedMutex);
    mPublished = mStatistics;
}

// ---------------------------------------------------------------------------------------------- streams

void Executor::execute(CommandView commands) {
    if (mIsLost) return;
    // Before the new commands: they find the memory of the staging ring that finished work gives back.
    if (check(mSubmissions->poll(), "poll")) answer();
    Dispatch dispatch{ *this, mStatistics.commands, mIsLost };
    try {
        replay(commands, dispatch);
        if (!mIsLost && !mPass->isOpen()) submit();
    } catch (std::bad_alloc const&) {
        mIsLost = true; // inside a frame or pass: the recorded commands are never submitted
        throw;
    }
    publishStatistics();
}

void Executor::waitIdle() {
    if (mIsLost) return;
    submit();
    if (!mIsLost && check(mSubmissions->wait(mSubmissions->recordingSerial() - 1), "wait")) answer();
    if (!mIsLost) publishStatistics();
}

VkCommandBuffer Executor::commands() {
    if (!mSubmissions->isOpen() && check(mSubmissions->open(), "begin")) {
        mDraws->beginCommands(mSubmissions->commands());
    }
    return mSubmissions->commands();
}

void Executor::submit() {
    if (!mSubmissions->isOpen()) return;
    // Barriers that wait for a next command, such as those for reads by the host, must be part of this submission.
    flushBarriers();
    check(mSubmissions->submit(), "submit");
}

void Executor::answer() {
    // Timers first: a thread that waits for a read-back may ask for them as soon as it wakes.
    mTimers->answer(mSubmissions->finishedSerial(), mSink);
    mReadbacks->answer(mSubmissions->finishedSerial(), mSink);
}

bool Executor::check(VkResult result, std::string_view what) {
    if (result == VK_SUCCESS) return true;
    if (!mIsLost) {
        mIsLost = true;
        mSink.onError(DriverErrorKind::DeviceLost, fmt::format("Vulkan: '{}' is lost ({} at {}); make a new engine",
                                                               info().deviceName, toString(result), what));
    }
    return false;
}

void Executor::report(Error const& error, DriverErrorKind kind) {
    mSink.onError(error.code == ErrorCode::OutOfMemory ? DriverErrorKind::OutOfMemory : kind, error.message);
}

// ---------------------------------------------------------------------------------------------- frames

void Executor::execute(CmdBeginFrame const&) {}

void Executor::execute(CmdEndFrame const&) {
    submit();
    if (mIsLost) return;
    // Frame n starts recording when frame n - 2 has finished on the GPU.
    uint64_t& serial = mFrameSerials[mFrameIndex];
    if (!check(mSubmissions->wait(serial), "frame wait") || !check(mSubmissions->poll(), "poll")) return;
    serial = mSubmissions->recordingSerial() - 1;
    mFrameIndex = (mFrameIndex + 1) % kFramesInFlight;
    answer();
    publishStatistics();
}

void Executor::execute(CmdBeginTimer const& command) { mTimers->begin(commands(), command.ticket); }

void Executor::execute(CmdEndTimer const& command) {
    mTimers->end(commands(), command.ticket, mSubmissions->recordingSerial());
}

void Executor::execute(CmdPushGroup const& command) { label(command.name); }

void Executor::execute(CmdPopGroup const&) { endLabel(); }

void Executor::label(std::string_view name) {
    if (!mDevice->instance().hasValidation()) return;
    const std::string text(name);
    auto info = make<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    info.pLabelName = text.c_str();
    mDevice->instance().fn().vkCmdBeginDebugUtilsLabelEXT(commands(), &info);
}

void Executor::endLabel() {
    if (mDevice->instance().hasValidation()) mDevice->instance().fn().vkCmdEndDebugUtilsLabelEXT(commands());
}

} // namespace filament_core::backend::vulkan
