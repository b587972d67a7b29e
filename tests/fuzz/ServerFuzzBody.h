// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, a request of the server and a message of its tools are a
/// request, or an error of one line.
#pragma once

#include "base/Assert.h"
#include "tools/server/Mcp.h"
#include "tools/server/RenderRequest.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace filament_core {

/// Returns whether it was a request.
inline bool fuzzServerOnce(server::RenderService& service, std::span<const uint8_t> input) {
    const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
    const Result<server::RenderRequest> request = server::parseRequest(text, {});
    if (!request) FILAMENT_ASSERT(request.error().message.find('\n') == std::string::npos, "an error is one line");
    // Messages that would draw need workers; every other one is answered at once.
    if (text.find("render_scene") == std::string_view::npos) {
        const std::optional<std::string> answer = server::answerMcp(service, text);
        FILAMENT_ASSERT(!answer || answer->find('\n') == std::string::npos, "an answer is one line");
    }
    return request.ok();
}

} // namespace filament_core
