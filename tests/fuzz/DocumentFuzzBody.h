// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, reading a document of the viewer gives an error of one line
/// that names the file, or a document that is valid and the same again when it is written and read.
#pragma once

#include "base/Assert.h"
#include "tools/view/document/Document.h"

#include <cstdint>
#include <span>

namespace filament_core {

/// Returns whether it was a document.
inline bool fuzzDocumentOnce(std::span<const uint8_t> input) {
    const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
    const auto document = view::documentFromJson(text, "fuzz");
    if (!document) {
        FILAMENT_ASSERT(document.error().message.starts_with("fuzz: "), "an error names its file");
        FILAMENT_ASSERT(document.error().message.find('\n') == std::string::npos, "an error is one line");
        return false;
    }
    FILAMENT_ASSERT(view::check(*document).ok(), "what is read is valid");
    const auto again = view::documentFromJson(view::toJson(*document), "again");
    FILAMENT_ASSERT(again && *again == *document, "what is written is what was read");
    return true;
}

} // namespace filament_core
