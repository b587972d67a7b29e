// SPDX-License-Identifier: Apache-2.0
/// GltfUri: reads the bytes that a URI of a glTF file refers to.
///   In      "data:...;base64,..." (RFC 2397) or a relative reference (RFC 3986, percent-encoded) and the folder of the
///           model. Base64 may be wrapped, percent-encoded, without padding, or in the alphabet for URLs.
///   Safety  models are untrusted: only regular files inside the model's folder are opened, unless GltfFolder::from
///           allows more. Absolute paths, ".." and links that leave the folder, and URIs with a scheme (http:, file:)
///           are errors.
///   Thread  any.
///   Limits  2 GiB per file.
///   Fails   NotFound, Unreadable, Corrupt (bad encoding), Unsupported (scheme); the message does not name the element.
#pragma once

#include "filament_core/assets/files/PathInside.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core::assets {

/// Gives the bytes of a relative URI, percent-decoded; from any thread, also from several at once.
using GltfResolver = std::function<Result<std::vector<std::byte>>(std::string_view uri)>;

/// Where relative URIs start, and which files they may name.
struct GltfFolder {
    // NOLINTNEXTLINE(google-explicit-constructor): a folder alone is one that nothing leaves
    GltfFolder(std::filesystem::path folder, FilesFrom files = FilesFrom::Folder, GltfResolver resolver = {})
            : directory(std::move(folder)), from(files), resolve(std::move(resolver)) {}

    std::filesystem::path directory;
    FilesFrom from;
    GltfResolver resolve; ///< replaces the file system
};

/// Whether it holds its bytes itself. Schemes have no case (RFC 3986, 3.1).
bool isDataUri(std::string_view uri);

Result<std::vector<std::byte>> readGltfUri(std::string_view uri, GltfFolder const& folder);

/// A whole regular file.
Result<std::vector<std::byte>> readGltfFile(std::filesystem::path const& path);

} // namespace filament_core::assets
