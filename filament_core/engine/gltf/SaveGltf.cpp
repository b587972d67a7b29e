// SPDX-License-Identifier: Apache-2.0
#include <filament_core/SaveGltf.h>

#include "base/OutOfMemory.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfContainer.h"
#include "filament_core/assets/gltf/GltfParse.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "filament_core/assets/gltf/MeshFileModel.h"
#include "filament_core/engine/gltf/ModelUpload.h"
#include "filament_core/engine/gltf/SavedSources.h"

#include <algorithm>
#include <cctype>

namespace filament_core {
namespace engine {
namespace {

/// An .obj, .ply or .stl becomes the .glb that the loader made of it.
Result<void> convert(assets::GltfMergeSource& source) {
    const std::optional<assets::MeshFormat> format = assets::meshFormatOf(source.name);
    if (!format) return {};
    assets::Diagnostics diagnostics;
    Result<std::vector<std::byte>> glb = assets::glbOfMeshFile(source.file, *format, source.folder, diagnostics);
    if (!glb) return fail(glb.error().code, "{}: {}", source.name, glb.error().message);
    source.file = std::move(*glb);
    return {};
}

Result<assets::GltfMergeSource> readFile(Model::Impl const& model) {
    Model::Impl::Source const& source = model.source;
    const Model::Impl::Source now = sourceAt(source.path, source.files);
    Result<std::vector<std::byte>> file = assets::readGltfFile(source.path);
    if (!file) return file.error();
    if (now.bytes != source.bytes || now.changedAt != source.changedAt)
        return fail(ErrorCode::InvalidArgument, "'{}' changed since it was loaded; load it again to save it",
                    source.path.native());
    return assets::GltfMergeSource{ model.name, std::move(*file),
                                    assets::GltfFolder(source.path.parent_path(), source.files) };
}

Result<assets::GltfMergeSource> readMemory(Model::Impl const& model, GltfSaveOptions const& options) {
    if (!options.source)
        return fail(ErrorCode::InvalidArgument,
                    "model '{}' was loaded from memory: give its bytes by GltfSaveOptions::source to save it",
                    model.name);
    const Result<GltfMemory> given = options.source(model.name);
    if (!given) return given.error();
    assets::GltfResolver resolve = given->resolve;
    if (!resolve) {
        resolve = [](std::string_view uri) -> Result<std::vector<std::byte>> {
            return fail(ErrorCode::NotFound, "'{}' is not in the file; give its bytes by GltfMemory::resolve",
                        uri.substr(0, 80));
        };
    }
    return assets::GltfMergeSource{ model.name,
                                    { given->file.begin(), given->file.end() },
                                    assets::GltfFolder({}, assets::FilesFrom::Folder, std::move(resolve)) };
}

std::string percentEncoded(std::string const& name) {
    std::string encoded;
    for (const char c : name) {
        const bool isPlain = (std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128) ||
                             c == '-' || c == '_' || c == '.' || c == '~';
        encoded += isPlain ? std::string(1, c)
                           : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
    return encoded;
}

Result<SavedGltf> writeFiles(assets::GltfMerge const& merge, std::filesystem::path const& path, bool isBinary) {
    std::filesystem::path data = path;
    data.replace_extension(".bin");
    Result<assets::GltfMerged> merged =
            assets::mergeGltf(merge, isBinary ? std::string() : percentEncoded(data.filename().string()));
    if (!merged) return merged.error();
    SavedGltf saved{ std::move(merged->warnings), 0 };
    if (isBinary) {
        const Result<std::vector<std::byte>> file = assets::glbOf(*merged);
        if (!file) return file.error();
        saved.bytes = file->size();
        if (Result<void> written = assets::replaceFile(path, *file); !written) return written.error();
        return saved;
    }
    saved.bytes = merged->buffer.size() + merged->json.size();
    // The data first: a file that names it is never without it.
    if (!merged->buffer.empty())
        if (Result<void> written = assets::replaceFile(data, merged->buffer); !written) return written.error();
    if (Result<void> written = assets::replaceFile(path, std::as_bytes(std::span(merged->json))); !written) {
        return written.error();
    }
    return saved;
}

} // namespace

Result<uint32_t> sourceOf(SaveContext& context, Model::Impl const& model, GltfSaveOptions const& options) {
    const auto known = std::ranges::find(context.sources, &model, &SavedSource::model);
    if (known != context.sources.end()) return static_cast<uint32_t>(known - context.sources.begin());
    Result<assets::GltfMergeSource> source = model.source.path.empty() ? readMemory(model, options) : readFile(model);
    if (!source) return source.error();
    if (Result<void> converted = convert(*source); !converted) return converted.error();
    const Result<assets::GltfContainer> container = assets::openGltfContainer(source->file);
    if (!container) return fail(container.error().code, "{}: {}", model.name, container.error().message);
    assets::Diagnostics diagnostics;
    SavedSource saved{ &model, assets::parseGltf(container->json, diagnostics) };
    if (!diagnostics.ok()) return fail(diagnostics.error().code, "{}: {}", model.name, diagnostics.error().message);
    context.sources.push_back(std::move(saved));
    context.merge.sources.push_back(std::move(*source));
    return static_cast<uint32_t>(context.sources.size() - 1);
}

} // namespace engine

Result<SavedGltf> saveGltf(Scene const& scene, std::filesystem::path const& path, GltfSaveOptions const& options) {
    const engine::PublicCall call(&scene.impl(), "saveGltf(Scene, path, GltfSaveOptions)", path.native());
    return orOutOfMemory("glTF", path.native(), [&]() -> Result<SavedGltf> {
        std::string ending = path.extension().string();
        for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (ending != ".glb" && ending != ".gltf")
            return fail(ErrorCode::InvalidArgument, "'{}': give the file the ending .glb or .gltf", path.native());
        scene.impl().upToDate();
        engine::SaveContext context(scene.impl());
        if (Result<void> saved = engine::saveNodes(context, options); !saved) return saved.error();
        return engine::writeFiles(context.merge, path, ending == ".glb");
    });
}

} // namespace filament_core
