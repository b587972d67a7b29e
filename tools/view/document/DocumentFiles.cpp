// SPDX-License-Identifier: Apache-2.0
#include "base/Result.h"
#include "filament_core/assets/files/FileBytes.h"
#include "tools/view/document/DocumentVersion.h"
#include "tools/view/document/SceneDocument.h"
#include "tools/view/document/TextForms.h"

#include <span>

namespace filament_core::view {
namespace {

Result<void> saveText(std::filesystem::path const& file, std::string const& text) {
    return assets::replaceFile(file, std::as_bytes(std::span(text)));
}

/// What a file holds that is no longer than a document may be: a longer one is not even read.
template <class T>
Result<T> parsedFile(std::filesystem::path const& file, Result<T> (*parse)(std::string_view, std::string_view)) {
    std::error_code ignored;
    const uintmax_t size = std::filesystem::file_size(file, ignored);
    if (!ignored && size > kLongestText)
        return fail(ErrorCode::Unsupported, "'{}' is longer than 64 MiB: it is no document", file.string());
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    return parse({ reinterpret_cast<const char*>(bytes->data()), bytes->size() }, file.string());
}

/// The scene file, if it is one; otherwise what was wrong with the document.
template <class T>
Result<T> orSceneFile(std::filesystem::path const& file, Result<T> refused) {
    const Result<SceneFile> scene = SceneFile::load(file);
    if (!scene) return refused;
    Result<Document> document = documentOf(*scene);
    if (!document) return document.error();
    return T(std::move(*document));
}

} // namespace

Result<void> saveDocument(std::filesystem::path const& file, Document const& document) {
    return saveText(file, toJson(document));
}
Result<void> saveCameraPath(std::filesystem::path const& file, CameraPath const& path) {
    return saveText(file, toJson(path));
}

Result<Document> loadDocument(std::filesystem::path const& file) {
    Result<Document> document = parsedFile<Document>(file, documentFromJson);
    return document ? document : orSceneFile(file, std::move(document));
}

Result<AnyText> loadAny(std::filesystem::path const& file) {
    Result<AnyText> any = parsedFile<AnyText>(file, anyFromJson);
    return any ? any : orSceneFile(file, std::move(any));
}

Result<CameraPath> loadCameraPath(std::filesystem::path const& file) {
    Result<AnyText> any = loadAny(file);
    if (!any) return any.error();
    if (auto* path = std::get_if<CameraPath>(&*any)) return std::move(*path);
    if (auto* document = std::get_if<Document>(&*any); document && !document->paths.empty())
        return std::move(document->paths.front());
    return fail(ErrorCode::NotFound, "'{}' has no camera path; give a file that a viewer saved one in", file.string());
}

} // namespace filament_core::view
