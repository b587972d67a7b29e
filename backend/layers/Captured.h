// SPDX-License-Identifier: Apache-2.0
/// Captured: a layer that shows what a frame did inside: it reads every attachment of every pass, cuts the frame off
/// after its N-th draw, or changes one thing in the stream. An instrument for tools; not used otherwise.
///   In      FrameCapture::arm() before a frame is rendered.  Out: FrameCapture::take() once the device is idle.
///   Stores  with the layer, attachments are created readable and not only in tile memory; in an armed frame all of
///           them are stored. This does not change their contents.
///   Thread  arm(), take(): any. The layer and a StreamEdit: the driver thread.
///   Memory  descriptions of live textures and pipelines; the contents of one captured frame.
///   Limits  multisampled attachments are not read; their resolve targets are.
///   Fails   never; an attachment without a result from the device has no bytes.
///   Cost    about 20 ns per command; an armed frame waits for its read-backs.
#pragma once

#include "backend/api/Driver.h"
#include "base/Result.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::backend {

inline constexpr uint32_t kAllDraws = ~0u;

struct CaptureRequest {
    bool attachments = true;        ///< read every attachment back when its pass ends
    uint32_t drawLimit = kAllDraws; ///< draws of the frame beyond this number are skipped; passes still begin and end
};

struct CapturedAttachment {
    std::string name;  ///< of the texture
    uint32_t slot = 0; ///< colour attachment, or its resolve target; depth: colorCount
    bool isDepth = false;
    Format format = Format::None; ///< depth reads back as D32F
    uint32_t width = 0, height = 0;
    std::vector<std::byte> bytes; ///< tightly packed, row 0 at the top
};

/// Positions count the commands of the frame: CmdBeginFrame is 0.
struct CapturedDraw {
    uint32_t position = 0;
    uint32_t pass = 0;    ///< into CapturedFrame::passes
    std::string pipeline; ///< debug name: the material's
};

struct CapturedPass {
    std::string name;
    uint32_t first = 0, last = 0;          ///< positions of CmdBeginPass and CmdEndPass
    uint32_t firstDraw = 0, drawCount = 0; ///< into CapturedFrame::draws
    std::vector<CapturedAttachment> attachments;
};

struct CapturedFrame {
    uint64_t frame = 0;
    std::vector<CapturedPass> passes; ///< in order
    std::vector<CapturedDraw> draws;  ///< all of the frame, including skipped ones
};

/// Changes commands on their way to the driver: a mutation that a test must detect. inspect() sees each stream before
/// its commands are edited one by one. Spans in a command may point to memory that lives until the next inspect().
class StreamEdit {
public:
    virtual ~StreamEdit() = default;
    virtual void inspect(CommandView) {}
    virtual void edit(CmdCreateTexture&) {}
    virtual void edit(CmdCreateSampler&) {}
    virtual void edit(CmdCreateProgram&) {}
    virtual void edit(CmdCreatePipeline&) {}
    virtual void edit(CmdUploadTexture&) {}
    virtual void edit(CmdUpdateBuffer&) {}
    virtual void edit(CmdBeginPass&) {}
    virtual void edit(CmdSetViewport&) {}
    virtual void edit(CmdDrawIndexed&) {}
};

/// The tool's interface to the layer: EngineOptions::debug.capture. One per engine.
class FrameCapture {
public:
    explicit FrameCapture(std::unique_ptr<StreamEdit> edit = nullptr) : mEdit(std::move(edit)) {}

    /// Captures the next frame that reaches the driver. Replaces a request that has not been served yet.
    void arm(CaptureRequest const& request);
    /// The captured frame, once; nothing if none was rendered since arm().
    std::optional<CapturedFrame> take();

private:
    friend class CapturedDriver; // the layer: takes requests, delivers frames and results
    friend class CaptureSink;

    struct Pending {
        uint32_t pass = 0, attachment = 0;
    };

    std::optional<CaptureRequest> takeRequest();
    void begin(CapturedFrame frame, std::vector<Pending> pending, uint64_t firstTicket);
    void answer(uint64_t ticket, std::span<const std::byte> bytes);

    const std::unique_ptr<StreamEdit> mEdit; // driver thread
    std::mutex mMutex;
    std::optional<CaptureRequest> mRequest;
    std::optional<CapturedFrame> mFrame;
    std::vector<Pending> mPending; // read-backs of mFrame, by ticket
    uint64_t mFirstTicket = 0;
};

using DriverMaker = std::function<Result<std::unique_ptr<Driver>>(ResultSink&)>;

/// The driver of `make` with the layer around it. `make` gets a sink that hides the layer's own results from `sink`,
/// which must outlive the returned driver.
Result<std::unique_ptr<Driver>> captured(std::shared_ptr<FrameCapture> capture, ResultSink& sink,
                                         DriverMaker const& make);

} // namespace filament_core::backend
