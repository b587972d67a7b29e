// SPDX-License-Identifier: Apache-2.0
/// replayTrace: draws a trace again, on a driver of its own, and looks inside of its frames.
///   In      a trace, on the API that recorded it, or on the null driver, which draws nothing.
///   Out     hashes of everything that was read back, the bytes of what was asked for, the inside of frames.
///   Safe    every stream passes the validator first: what could crash a driver is dropped and reported. Shaders are
///           those of the trace; they run as any program's do.
///   Thread  one; the driver lives on it during the call.
///   Fails   DeviceUnavailable; Unsupported for the shaders of another API; NotFound for a frame that is not there;
///           Corrupt if a frame cannot be looked into. Errors of the device are in Replayed::errors.
///   Cost    a whole run of the trace: start of a driver, uploads, frames.
#pragma once

#include "backend/layers/Captured.h"
#include "toolkit/record/Bisect.h"
#include "toolkit/record/Trace.h"

#include <functional>
#include <map>

namespace filament_core::record {

/// What to see of a frame, and where to cut it off.
struct FrameCut {
    uint32_t frame = 0; ///< index into Trace::frames; ascending in a request, each in a stream of its own
    uint32_t drawLimit = backend::kAllDraws;
};

/// Makes an edit of the stream, for tests: a defect to be found. Empty: none.
using EditMaker = std::function<std::unique_ptr<backend::StreamEdit>()>;

struct ReplayRequest {
    Backend backend = Backend::Vulkan;
    std::string requireDevice; ///< part of the device's name; empty: the first usable one
    std::vector<FrameCut> inside;
    std::vector<uint64_t> keep; ///< tickets of read-backs whose bytes are wanted
    EditMaker edit;
};

struct Answer {
    uint64_t ticket = 0, hash = 0;
    size_t bytes = 0;
};

struct Replayed {
    std::string device, driver;
    std::vector<Answer> answers; ///< of all read-backs, in their order
    std::map<uint64_t, std::vector<std::byte>> kept;
    std::vector<backend::CapturedFrame> inside; ///< as requested
    std::vector<std::string> errors;            ///< of the device and the validator; at most kMaxErrors
};
inline constexpr size_t kMaxErrors = 16;

Result<Replayed> replayTrace(Trace const& trace, ReplayRequest const& request);

/// For bisect(): one frame of the trace. `trace` must outlive the result.
tools::FrameSource frameOf(Trace const& trace, ReplayRequest const& request, uint32_t frame);

/// Hashes of the attachments of every pass.
FrameRecord recordOf(backend::CapturedFrame const& frame, uint32_t index);

} // namespace filament_core::record
