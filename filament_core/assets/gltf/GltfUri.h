// SPDX-License-Identifier: Apache-2.0
/// GltfUri: reads the bytes that a URI of a glTF file refers to.
///   In      "data:...;base64,..." or a relative reference (RFC 3986, percent-encoded) and the folder of the model.
///   Safety  models are untrusted: only regular files inside the model's folder are opened. Absolute paths, ".." that
///           leaves the folder, and URIs with a scheme (http:, file:) are errors.
///   Thread  any.
///   Limits  2 GiB per file.
///   Fails   NotFound, Unreadable, Corrupt (bad encoding), Unsupported (scheme); the message does not name the element.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace filament::assets {

Result<std::vector<std::byte>> readGltfUri(std::string_view uri, std::filesystem::path const& baseDirectory);

/// A whole regular file.
Result<std::vector<std::byte>> readGltfFile(std::filesystem::path const& path);

} // namespace filament::assets
