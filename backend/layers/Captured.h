// SPDX-License-Identifier: Apache-2.0
/// Captured: a driver around a driver that shows what a frame did inside: every attachment of every pass, the frame cut
/// off after its N-th draw, and the same stream with one thing changed. An instrument for tools; without it nothing of
/// this runs.
///   In      FrameCapture::arm() before a frame is rendered.  Out: FrameCapture::take() once the device is idle.
///   Stores  while the layer is there, attachments are created readable and not in tile memory only; in an armed frame
///           all of them are stored. What they contain does not change by that.
///   Thread  arm(), take(): any. The layer and a StreamEdit: the driver thread.
///   Memory  descriptions of live textures and pipelines; the contents of one captured frame.
///   Limits  multisampled attachments are not read; their resolve targets are.
///   Fails   never; an attachment that the device did not answer has no bytes.
///   Cost    about 20 ns a command; an armed frame waits for its read-backs.
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

namespace filament::backend {

inline constexpr uint32_t kAllDraws = ~0u;

struct CaptureRequest {
    bool attachments = true;        ///< read every attachment back when its pass ends
    uint32_t drawLimit = kAllDraws; ///< draws of the frame after so many are left out; passes still begin and end
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
    std::vector<CapturedDraw> draws;  ///< all of the frame, those left out as well
};

/// Changes commands on their way to the driver: a mutation that a test must notice. inspect() sees each stream before
/// its commands are edited one by one. Spans in a command may be pointed to memory that lives until the next inspect().
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
};

/// The tool's end of the layer: EngineOptions::debug.capture. One engine each.
class FrameCapture {
public:
    explicit FrameCapture(std::unique_ptr<StreamEdit> edit = nullptr) : mEdit(std::move(edit)) {}

    /// The next frame that reaches the driver is captured. Replaces a request that no frame has met yet.
    void arm(CaptureRequest const& request);
    /// The captured frame, once; nothing while none was rendered since arm().
    std::optional<CapturedFrame> take();

private:
    friend class CapturedDriver; // the layer's end: takes requests, gives frames and answers
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

/// The driver of `make` with the layer around it; `make` gets a sink that keeps the layer's own answers from `sink`,
/// which must outlive the result.
Result<std::unique_ptr<Driver>> captured(std::shared_ptr<FrameCapture> capture, ResultSink& sink,
                                         DriverMaker const& make);

} // namespace filament::backend
