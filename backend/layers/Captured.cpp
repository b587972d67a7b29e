// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Captured.h"

#include "backend/stream/CommandBuffer.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace filament_core::backend {
namespace {

// Marks tickets of the layer's own read-backs; an application's tickets count up from one.
constexpr uint64_t kOwnTicket = uint64_t{ 1 } << 63;

bool isAttachment(TextureUsage usage) {
    return has(usage, TextureUsage::ColorAttachment) || has(usage, TextureUsage::DepthAttachment);
}

TextureUsage readable(TextureUsage usage) {
    const auto bits = static_cast<uint8_t>(usage | TextureUsage::TransferSource);
    return static_cast<TextureUsage>(bits & ~static_cast<uint8_t>(TextureUsage::Transient));
}

struct NamedTexture {
    DeviceTextureDesc desc;
    std::string name;
};

} // namespace

void FrameCapture::arm(CaptureRequest const& request) {
    const std::lock_guard lock(mMutex);
    mRequest = request;
    mFrame.reset();
}

std::optional<CapturedFrame> FrameCapture::take() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mFrame, std::nullopt);
}

std::optional<CaptureRequest> FrameCapture::takeRequest() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mRequest, std::nullopt);
}

void FrameCapture::begin(CapturedFrame frame, std::vector<Pending> pending, uint64_t firstTicket) {
    const std::lock_guard lock(mMutex);
    mFrame = std::move(frame);
    mPending = std::move(pending);
    mFirstTicket = firstTicket;
}

void FrameCapture::answer(uint64_t ticket, std::span<const std::byte> bytes) {
    const std::lock_guard lock(mMutex);
    if (!mFrame || ticket < mFirstTicket || ticket - mFirstTicket >= mPending.size()) return; // of an earlier frame
    const Pending at = mPending[ticket - mFirstTicket];
    mFrame->passes[at.pass].attachments[at.attachment].bytes.assign(bytes.begin(), bytes.end());
}

/// Sits between the driver and the stream's sink, and keeps the answers to the layer's own requests.
class CaptureSink final : public ResultSink {
public:
    CaptureSink(std::shared_ptr<FrameCapture> capture, ResultSink& outer)
            : mCapture(std::move(capture)), mOuter(outer) {}

    void onReadback(Ticket ticket, std::span<const std::byte> bytes) override {
        if (ticket.value & kOwnTicket)
            mCapture->answer(ticket.value & ~kOwnTicket, bytes);
        else
            mOuter.onReadback(ticket, bytes);
    }
    void onTimer(Ticket ticket, uint64_t nanoseconds) override { mOuter.onTimer(ticket, nanoseconds); }
    void onError(DriverErrorKind kind, std::string_view message) override { mOuter.onError(kind, message); }

private:
    const std::shared_ptr<FrameCapture> mCapture;
    ResultSink& mOuter;
};

/// Rewrites every stream with the changes of the request and the edit, and passes the result to the inner driver.
class CapturedDriver final : public Driver {
public:
    CapturedDriver(std::shared_ptr<FrameCapture> capture, std::unique_ptr<CaptureSink> sink)
            : mCapture(std::move(capture)), mSink(std::move(sink)) {}

    Result<void> open(DriverMaker const& make) {
        auto inner = make(*mSink);
        if (!inner) return inner.error();
        mInner = std::move(*inner);
        return {};
    }

    DeviceInfo const& info() const override { return mInner->info(); }
    void execute(CommandView commands) override {
        mWritten.reset();
        if (mCapture->mEdit) mCapture->mEdit->inspect(commands);
        replay(commands, *this);
        // Must be known before the driver can answer.
        if (mRequest) mCapture->begin(std::move(mFrame), std::move(mPending), mFirstTicket);
        mRequest.reset();
        mInner->execute(mWritten.view());
    }
    void waitIdle() override { mInner->waitIdle(); }
    DriverStatistics statistics() const override { return mInner->statistics(); }

    template <class C>
    void execute(C const& command) {
        C copy = command;
        // The edit first: what is noted, and perhaps dropped, is the command that the driver would get.
        if (mCapture->mEdit) change(copy);
        note(copy);
        if (runs(copy)) mWritten.recordAdopted(copy); // payloads need no copy: the stream outlives this call
        if constexpr (std::same_as<C, CmdEndPass>) readAttachments();
        ++mPosition;
    }

private:
    template <class C>
    void change(C& command) {
        if constexpr (requires { mCapture->mEdit->edit(command); }) mCapture->mEdit->edit(command);
    }

    template <class C>
    bool runs(C const&) const {
        if constexpr (std::same_as<C, CmdDraw> || std::same_as<C, CmdDrawIndexed>)
            return !mRequest || mFrame.draws.size() <= mRequest->drawLimit;
        else
            return true;
    }

    // Records what the layer must know about a command; most commands need nothing.
    template <class C>
    void note(C&) {}
    void note(CmdCreateTexture& command) {
        // When the texture is made, no frame has been asked for yet: any attachment may be read later.
        if (isAttachment(command.desc.usage) && command.desc.samples == 1)
            command.desc.usage = readable(command.desc.usage);
        mTextures[command.handle] = { command.desc, std::string(command.desc.debugName) };
    }
    void note(CmdDestroyTexture& command) { mTextures.erase(command.handle); }
    void note(CmdCreatePipeline& command) { mPipelines[command.handle] = std::string(command.desc.debugName); }
    void note(CmdDestroyPipeline& command) { mPipelines.erase(command.handle); }
    void note(CmdBeginFrame& command) {
        mRequest = mCapture->takeRequest();
        mPosition = 0;
        mFrame = { .frame = command.frame };
        mPending.clear();
        mFirstTicket = mNextTicket;
    }
    void note(CmdBeginPass& command) {
        if (!mRequest) return;
        mFrame.passes.push_back({ .name = std::string(command.desc.debugName),
                                  .first = mPosition,
                                  .firstDraw = static_cast<uint32_t>(mFrame.draws.size()) });
        mPass = command.desc;
        mPipeline = {};
        if (!mRequest->attachments) return;
        // What a pass discards at its end could not be read after it.
        for (uint32_t i = 0; i < command.desc.layout.colorCount; ++i) command.desc.colors[i].store = StoreOp::Store;
        command.desc.depth.store = StoreOp::Store;
    }
    void note(CmdNextSubpass&) { mPipeline = {}; }
    void note(CmdBindPipeline& command) { mPipeline = command.pipeline; }
    void note(CmdDraw&) { noteDraw(); }
    void note(CmdDrawIndexed&) { noteDraw(); }

    void noteDraw() {
        if (!mRequest || mFrame.passes.empty()) return;
        const auto name = mPipelines.find(mPipeline);
        mFrame.draws.push_back({ .position = mPosition,
                                 .pass = static_cast<uint32_t>(mFrame.passes.size() - 1),
                                 .pipeline = name == mPipelines.end() ? std::string() : name->second });
        ++mFrame.passes.back().drawCount;
    }

    // After CmdEndPass: requests read-backs of everything that the pass has written.
    void readAttachments() {
        if (!mRequest || mFrame.passes.empty()) return;
        mFrame.passes.back().last = mPosition;
        if (!mRequest->attachments) return;
        for (uint32_t i = 0; i < mPass.layout.colorCount; ++i) {
            Attachment const& color = mPass.colors[i];
            if (color.resolve)
                read(i, false, color.resolve, 0, 0);
            else
                read(i, false, color.texture, color.level, color.layer);
        }
        if (mPass.layout.depthFormat == Format::None) return;
        if (mPass.layout.resolvesDepth)
            read(mPass.layout.colorCount, true, mPass.depth.resolve, 0, 0);
        else
            read(mPass.layout.colorCount, true, mPass.depth.texture, mPass.depth.level, mPass.depth.layer);
    }

    void read(uint32_t slot, bool isDepth, TextureHandle handle, uint8_t level, uint16_t layer) {
        const auto found = mTextures.find(handle);
        if (found == mTextures.end() || found->second.desc.samples != 1) return;
        CapturedPass& pass = mFrame.passes.back();
        DeviceTextureDesc const& desc = found->second.desc;
        const uint32_t width = std::max(1u, desc.width >> level), height = std::max(1u, desc.height >> level);
        // In the order of the tickets: an answer finds its attachment by the ticket's distance from the first.
        mPending.push_back(
                { static_cast<uint32_t>(mFrame.passes.size() - 1), static_cast<uint32_t>(pass.attachments.size()) });
        pass.attachments.push_back({ .name = found->second.name,
                                     .slot = slot,
                                     .isDepth = isDepth,
                                     .format = isDepth ? Format::D32F : desc.format,
                                     .width = width,
                                     .height = height });
        mWritten.record(
                CmdReadTexture{ handle, level, layer, { 0, 0, width, height }, { kOwnTicket | mNextTicket++ } });
    }

    const std::shared_ptr<FrameCapture> mCapture;
    const std::unique_ptr<CaptureSink> mSink; // must outlive mInner
    std::unique_ptr<Driver> mInner;
    CommandBuffer mWritten;
    std::unordered_map<TextureHandle, NamedTexture> mTextures;
    std::unordered_map<PipelineHandle, std::string> mPipelines;
    std::optional<CaptureRequest> mRequest; // for the frame being written
    CapturedFrame mFrame;
    std::vector<FrameCapture::Pending> mPending;
    PassDesc mPass;
    PipelineHandle mPipeline;
    uint32_t mPosition = 0;
    uint64_t mNextTicket = 1, mFirstTicket = 1;
};

Result<std::unique_ptr<Driver>> captured(std::shared_ptr<FrameCapture> capture, ResultSink& sink,
                                         DriverMaker const& make) {
    auto own = std::make_unique<CaptureSink>(capture, sink);
    auto driver = std::make_unique<CapturedDriver>(std::move(capture), std::move(own));
    if (const Result<void> opened = driver->open(make); !opened) return opened.error();
    return std::unique_ptr<Driver>(std::move(driver));
}

} // namespace filament_core::backend
