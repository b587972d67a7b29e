// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: any text behind "data:" gives bytes or an error, and no file is opened.
#pragma once

#include "base/Assert.h"
#include "filament_core/assets/gltf/GltfUri.h"

#include <string>
#include <string_view>

namespace filament_core::assets::test {

/// Returns whether the URI has contents.
inline bool fuzzDataUri(std::string_view text) {
    const std::string uri = "data:" + std::string(text);
    const Result<std::vector<std::byte>> bytes = readGltfUri(uri, GltfFolder("/nonexistent"));
    if (!bytes) {
        FILAMENT_ASSERT(bytes.error().code != ErrorCode::NotFound, "a data URI is no file");
        FILAMENT_ASSERT(!bytes.error().message.empty(), "a refusal says why");
        return false;
    }
    FILAMENT_ASSERT(bytes->size() <= uri.size(), "no encoding makes the data larger than its text");
    return true;
}

} // namespace filament_core::assets::test
