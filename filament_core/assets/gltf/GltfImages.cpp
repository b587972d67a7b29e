// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfImages.h"

#include "filament_core/assets/image/ImageSize.h"

#include <exception>
#include <map>
#include <new>
#include <tuple>

namespace filament_core::assets {
namespace {

/// Equal for images with the same bytes: the URI, or the range of a buffer. Decompressed views have one of their own.
using ImageKey = std::tuple<std::string_view, uint32_t, uint64_t, uint64_t>;

ImageKey keyOf(GltfDocument const& document, GltfImage const& image) {
    if (image.view == kNone) return { image.uri, 0, 0, 0 };
    GltfBufferView const& view = document.views[image.view];
    if (view.meshopt) return { {}, kNone, image.view, 0 };
    return { {}, view.buffer, view.byteOffset, view.byteLength };
}

void read(GltfDocument const& document, GltfFolder const& folder, GltfImageSource& source) {
    GltfImage const& image = document.images[source.image];
    if (image.view != kNone) {
        source.bytes = document.viewBytes[image.view];
    } else {
        Result<std::vector<std::byte>> file = readGltfUri(image.uri, folder);
        if (!file)
            return source.diagnostics.refuse(file.error().code, "images[{}]: {}", source.image, file.error().message);
        source.owned = std::move(*file);
        source.bytes = source.owned;
    }
    source.size = imageSize(source.bytes);
}

} // namespace

std::vector<uint32_t> firstOfSameImages(GltfDocument const& document) {
    std::map<ImageKey, uint32_t> known;
    std::vector<uint32_t> first;
    for (uint32_t i = 0; i < document.images.size(); ++i)
        first.push_back(known.try_emplace(keyOf(document, document.images[i]), i).first->second);
    return first;
}

void readImage(GltfDocument const& document, GltfFolder const& folder, GltfImageSource& source) {
    source.isRead = true;
    try {
        read(document, folder, source);
    } catch (std::bad_alloc const&) {
        source.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: out of memory; free some and try again",
                                  source.image);
    } catch (std::exception const& exception) {
        source.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: {}", source.image, exception.what());
    }
}

std::string imageName(GltfDocument const& document, uint32_t image) {
    std::string const& uri = document.images[image].uri;
    const bool isFile = !uri.empty() && !isDataUri(uri);
    return isFile ? fmt::format("images[{}] {}", image, uri) : fmt::format("images[{}]", image);
}

} // namespace filament_core::assets
