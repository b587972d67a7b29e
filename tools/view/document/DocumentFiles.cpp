// SPDX-License-Identifier: Apache-2.0
#include "base/Result.h"
#include "filament_core/assets/files/FileBytes.h"
#include "tools/view/document/Document.h"

#include <fstream>

namespace filament::view {

Result<void> saveDocument(std::filesystem::path const& file, Document const& document) {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out << toJson(document);
    out.close();
    if (out) return {};
    return fail(ErrorCode::Unreadable, "'{}' cannot be written; give another path", file.string());
}

Result<Document> loadDocument(std::filesystem::path const& file) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    return documentFromJson({ reinterpret_cast<const char*>(bytes->data()), bytes->size() }, file.string());
}

} // namespace filament::view
