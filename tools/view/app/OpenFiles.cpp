// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/OpenFiles.h"

#include "filament_core/assets/image/Ktx2File.h"
#include "tools/view/app/PictureFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <span>

namespace filament_core::view {
namespace {

void showModel(Document& document, std::filesystem::path const& file) {
    document.model.file = file;
    document.model.variant.clear();
    document.nodes.clear();
    document.materials.clear();
    document.textures.clear();
    document.modelLights.clear();
    document.morphs.clear();
    document.playback = {};
}

/// Of a KTX 2.0 file that cannot be read, too: loading it says why. A texture of one face is no sky.
FileKind kindOfKtx2(std::filesystem::path const& file) {
    constexpr size_t kFaceCount = 36; // KTX 2.0 Specification, 2: behind the identifier and six numbers
    std::array<char, kFaceCount + 1> header{};
    std::ifstream(file, std::ios::binary).read(header.data(), header.size());
    const bool isFlat = assets::isKtx2(std::as_bytes(std::span(header))) && header[kFaceCount] == 1;
    return isFlat ? FileKind::Picture : FileKind::Environment;
}

std::string endingInLowerCase(std::filesystem::path const& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

Result<void> showJson(Document& document, std::filesystem::path const& file) {
    Result<AnyText> text = loadAny(file);
    if (!text) return text.error();
    showText(document, std::move(*text));
    return {};
}

} // namespace

std::optional<PictureFormat> pictureFormatOf(std::filesystem::path const& file) {
    const std::string ending = endingInLowerCase(file);
    if (ending == endingOf(PictureFormat::Png)) return PictureFormat::Png;
    if (ending == endingOf(PictureFormat::Exr)) return PictureFormat::Exr;
    return std::nullopt;
}

FileKind kindOf(std::filesystem::path const& file) {
    const std::string ending = endingInLowerCase(file);
    const auto isOneOf = [&](auto... endings) { return ((ending == endings) || ...); };
    if (isOneOf(".gltf", ".glb", ".obj", ".ply", ".stl", ".mat", ".fmat")) return FileKind::Model;
    if (isOneOf(".hdr", ".exr", ".fenv")) return FileKind::Environment;
    if (isOneOf(".ktx2")) return kindOfKtx2(file);
    if (isOneOf(".png", ".jpg", ".jpeg", ".webp", ".avif")) return FileKind::Picture;
    return ending == ".json" ? FileKind::Document : FileKind::Unknown;
}

Result<void> showFile(Document& document, std::filesystem::path const& file) {
    switch (kindOf(file)) {
    case FileKind::Model:
        showModel(document, file);
        return {};
    case FileKind::Environment:
        document.environment.file = file;
        document.environment.prefersModels = false;
        return {};
    case FileKind::Document:
        return showJson(document, file);
    case FileKind::Picture:
    case FileKind::Unknown:
        break;
    }
    return fail(ErrorCode::Unsupported, "'{}' is nothing to show: open .glb, .gltf, .mat, .hdr, .exr, .ktx2 or .json",
                file.string());
}

void showText(Document& document, AnyText text) {
    const uint2 size = document.view.size;
    if (auto* whole = std::get_if<Document>(&text)) document = std::move(*whole);
    if (auto* camera = std::get_if<Camera>(&text)) document.view.camera = *camera;
    if (auto* path = std::get_if<CameraPath>(&text)) document.paths.push_back(std::move(*path));
    document.view.size = size;
}

} // namespace filament_core::view
