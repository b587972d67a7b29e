// SPDX-License-Identifier: Apache-2.0
/// TextForms: a camera and a camera path as JSON of their own, for files and for the clipboard, beside that of a whole
/// Document. {"version": 1, "camera": {...}} and {"version": 1, "path": {...}}; the fields are those of documents.
///   Thread  any.
///   Fails   as documentFromJson(): one line with `name`, the place and what is expected there.
#pragma once

#include "tools/view/document/Document.h"

#include <variant>

namespace filament_core::view {

std::string toJson(Camera const& camera);
std::string toJson(CameraPath const& path);

using AnyText = std::variant<Document, Camera, CameraPath>;
/// Whichever of the three the text is. What is returned passes check().
Result<AnyText> anyFromJson(std::string_view text, std::string_view name);

/// Of a file. Unsupported: over 64 MiB; it is not read then.
Result<AnyText> loadAny(std::filesystem::path const& file);

/// InvalidArgument: as check(Document).
Result<void> check(CameraPath const& path);
/// As saveDocument().
Result<void> saveCameraPath(std::filesystem::path const& file, CameraPath const& path);
/// The path of a file, or the first one of a document. NotFound: the document has none.
Result<CameraPath> loadCameraPath(std::filesystem::path const& file);

} // namespace filament_core::view
