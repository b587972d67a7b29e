// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfBuffers.h"

#include "filament_core/assets/gltf/Meshopt.h"

namespace filament_core::assets {
namespace {

using Bytes = std::span<const std::byte>;

/// Where the bytes of a buffer are; empty for a fallback.
Bytes bufferBytes(GltfDocument& document, size_t index, GltfContainer const& container, GltfFolder const& folder,
                  Diagnostics& diagnostics) {
    GltfBuffer const& buffer = document.buffers[index];
    Bytes bytes;
    if (!buffer.uri.empty()) {
        Result<std::vector<std::byte>> read = readGltfUri(buffer.uri, folder);
        if (!read) {
            diagnostics.refuse(read.error().code, "buffers[{}]: {}", index, read.error().message);
            return {};
        }
        document.ownedBytes.push_back(std::move(*read));
        bytes = document.ownedBytes.back();
    } else if (index == 0 && container.hasBinary && !buffer.isFallback) {
        bytes = container.binary;
    } else {
        return {}; // views report it, unless they read another buffer through meshopt
    }
    if (bytes.size() < buffer.byteLength) {
        diagnostics.refuse(ErrorCode::Corrupt, "buffers[{}]: only {} of {} bytes are present", index, bytes.size(),
                           buffer.byteLength);
        return {};
    }
    return bytes.first(buffer.byteLength);
}

/// [offset, offset + length) of a buffer; all numbers are below 2^53, so sums do not overflow.
Bytes rangeOf(std::vector<Bytes> const& buffers, uint32_t buffer, uint64_t offset, uint64_t length,
              std::string const& path, Diagnostics& diagnostics) {
    const uint64_t size = buffers[buffer].size();
    if (offset + length <= size) return buffers[buffer].subspan(offset, length);
    if (size == 0) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: buffers[{}] has no data, neither a uri nor the binary chunk", path,
                           buffer);
    } else {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: ends at byte {}, buffers[{}] has {}", path, offset + length, buffer,
                           size);
    }
    return {};
}

struct CompressedView {
    size_t view = 0;
    Bytes source;
    std::vector<std::byte> bytes;
    Diagnostics diagnostics;
};

void decompressViews(GltfDocument& document, std::vector<CompressedView>& compressed, jobs::JobSystem& jobs,
                     Diagnostics& diagnostics) {
    jobs::parallelFor<"decompress">(jobs, compressed.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            CompressedView& item = compressed[i];
            item.bytes = decodeMeshopt(*document.views[item.view].meshopt, item.source,
                                       fmt::format("bufferViews[{}]", item.view), item.diagnostics);
        }
    });
    // On one thread and in the order of the views, for the same reports with any number of workers.
    for (CompressedView& item : compressed) {
        settle(std::move(item.diagnostics), document.use.has(GltfArray::Views, static_cast<uint32_t>(item.view)),
               diagnostics);
        document.ownedBytes.push_back(std::move(item.bytes));
        document.viewBytes[item.view] = document.ownedBytes.back();
    }
}

} // namespace

void loadGltfBuffers(GltfDocument& document, GltfContainer const& container, GltfFolder const& folder,
                     jobs::JobSystem& jobs, Diagnostics& diagnostics) {
    std::vector<Bytes> buffers(document.buffers.size());
    for (uint32_t i = 0; i < buffers.size() && diagnostics.ok(); ++i) {
        Diagnostics found;
        buffers[i] = bufferBytes(document, i, container, folder, found);
        settle(std::move(found), document.use.has(GltfArray::Buffers, i), diagnostics);
    }
    std::vector<CompressedView> compressed;
    document.viewBytes.resize(document.views.size());
    for (uint32_t i = 0; i < document.views.size() && diagnostics.ok(); ++i) {
        GltfBufferView const& view = document.views[i];
        if (view.buffer == kNone) continue; // left out
        const std::string path = fmt::format("bufferViews[{}]", i);
        Diagnostics found;
        const Bytes bytes = view.meshopt ? rangeOf(buffers, view.meshopt->buffer, view.meshopt->byteOffset,
                                                   view.meshopt->byteLength, path, found)
                                         : rangeOf(buffers, view.buffer, view.byteOffset, view.byteLength, path, found);
        if (!view.meshopt)
            document.viewBytes[i] = bytes;
        else if (found.ok())
            compressed.push_back({ i, bytes, {}, {} });
        settle(std::move(found), document.use.has(GltfArray::Views, i), diagnostics);
    }
    if (diagnostics.ok()) decompressViews(document, compressed, jobs, diagnostics);
}

} // namespace filament_core::assets
