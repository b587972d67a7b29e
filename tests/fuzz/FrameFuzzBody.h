// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, the files of a saved frame give an error of one line, or
/// contents that can be written again, listed, and replayed without a device.
#pragma once

#include "base/Assert.h"
#include "toolkit/record/Replay.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace filament_core::test {

inline bool fuzzManifest(std::string_view text) {
    const Result<record::Manifest> read = record::parseManifest(text, "frame.json");
    if (!read) {
        FILAMENT_ASSERT(read.error().message.starts_with("frame.json"), "an error names the file");
        FILAMENT_ASSERT(read.error().message.find('\n') == std::string::npos, "an error is one line");
        return false;
    }
    const std::string once = record::toJson(*read);
    const Result<record::Manifest> again = record::parseManifest(once, "frame.json");
    FILAMENT_ASSERT(again.ok(), "what was written can be read");
    FILAMENT_ASSERT(record::toJson(*again) == once, "writing what was read changes nothing");
    return true;
}

/// The text up to the first zero byte, then the payloads.
inline bool fuzzFrameTrace(std::string_view input) {
    const size_t zero = std::min(input.find('\0'), input.size());
    record::TraceBytes bytes{ std::string(input.substr(0, zero)),
                              std::string(input.substr(std::min(zero + 1, input.size()))) };
    const Result<record::Trace> trace = record::parseTrace(bytes, Backend::Vulkan, "vulkan.trace");
    if (!trace) {
        FILAMENT_ASSERT(trace.error().message.starts_with("vulkan.trace: line "), "an error names file and line");
        return false;
    }
    record::ReplayRequest request{ .backend = Backend::Null };
    for (uint32_t i = 0; i < trace->frames.size(); ++i) {
        if (i == 0 || trace->frames[i].stream != trace->frames[i - 1].stream)
            request.inside.push_back({ .frame = i, .drawLimit = i % 3 == 2 ? i : backend::kAllDraws });
    }
    const Result<record::Replayed> replayed = record::replayTrace(*trace, request);
    FILAMENT_ASSERT(!replayed || replayed->inside.size() == request.inside.size(), "every cut has its frame");
    return true;
}

/// The first byte chooses the file.
inline bool fuzzFrame(std::string_view input) {
    if (input.empty()) return false;
    return input[0] % 2 == 0 ? fuzzManifest(input.substr(1)) : fuzzFrameTrace(input.substr(1));
}

} // namespace filament_core::test
