// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, reading a trace gives an error, or streams that write out
/// to a fixed point and that the validator can judge without a crash.
#pragma once

#include "backend/layers/Trace.h"
#include "backend/layers/Validator.h"
#include "base/Assert.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace filament_core::backend {

struct IgnoreResults final : ResultSink {
    void onReadback(Ticket, std::span<const std::byte>) override {}
    void onTimer(Ticket, uint64_t) override {}
    void onError(DriverErrorKind, std::string_view) override {}
};

inline TraceText writeAll(std::vector<CommandBuffer> const& streams) {
    TraceText out;
    out.text = traceHeader();
    for (CommandBuffer const& stream : streams) writeTrace(stream.view(), out);
    return out;
}

/// Input: the text up to the first zero byte, then the side file. Returns whether it was a trace.
inline bool fuzzTraceOnce(std::span<const uint8_t> input) {
    const auto zero = std::ranges::find(input, uint8_t{ 0 });
    const auto length = static_cast<size_t>(zero - input.begin());
    const std::string_view text(reinterpret_cast<const char*>(input.data()), length);
    const std::span<const uint8_t> blob = input.subspan(std::min(length + 1, input.size()));
    const Result<std::vector<CommandBuffer>> streams = readTrace(text, std::as_bytes(blob));
    if (!streams) {
        FILAMENT_ASSERT(streams.error().message.starts_with("line "), "an error names its line");
        return false;
    }
    const TraceText once = writeAll(*streams);
    const Result<std::vector<CommandBuffer>> again = readTrace(once.text, once.blob);
    FILAMENT_ASSERT(again.ok(), "what was written can be read");
    const TraceText twice = writeAll(*again);
    FILAMENT_ASSERT(once.text == twice.text && once.blob == twice.blob, "writing what was read changes nothing");

    IgnoreResults sink;
    DeviceInfo info;
    Validator validator(info, sink);
    for (CommandBuffer const& stream : *streams) validator.check(stream.view());
    return true;
}

} // namespace filament_core::backend
