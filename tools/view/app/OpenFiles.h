// SPDX-License-Identifier: Apache-2.0
/// OpenFiles: what a file is to a viewer, and how a document shows it.
///   Thread  any.
///   Fails   one line that names the file.
#pragma once

#include "base/Result.h"
#include "tools/view/document/TextForms.h"

#include <filesystem>

namespace filament_core::view {

/// By its ending, in any case; a .ktx2 is an environment or an image, as its first bytes say.
enum class FileKind : uint8_t { Model, Environment, Document, Picture, Unknown };
FileKind kindOf(std::filesystem::path const& file);

/// A model loses the edits of the last one; a camera path is added. The size of the image stays. An image is nothing
/// to show by itself: it is a texture's.
Result<void> showFile(Document& document, std::filesystem::path const& file);
/// A document, a camera (with the exposure of the text), or a path that is added.
void showText(Document& document, AnyText text);

} // namespace filament_core::view
