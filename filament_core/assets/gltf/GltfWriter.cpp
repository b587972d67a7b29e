// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfWriter.h"

#include "filament_core/assets/gltf/GltfWriterJson.h"

#include <nlohmann/json.hpp>
#include <png.h>

#include <algorithm>
#include <cstring>

namespace filament_core::assets {
namespace {

/// The buffer, and the JSON arrays that describe it.
class BufferWriter {
public:
    /// Adds a buffer view with a copy of the bytes.
    size_t addView(std::span<const std::byte> bytes, int target) {
        mBytes.resize((mBytes.size() + 3) & ~size_t{ 3 });
        Json view{ { "buffer", 0 }, { "byteOffset", mBytes.size() }, { "byteLength", bytes.size() } };
        if (target != 0) view["target"] = target;
        mBytes.insert(mBytes.end(), bytes.begin(), bytes.end());
        mViews.push_back(std::move(view));
        return mViews.size() - 1;
    }

    template <class T>
    size_t addVectors(std::vector<T> const& values, const char* type) {
        constexpr int kArrayBuffer = 34962, kFloat = 5126;
        const size_t view = addView(std::as_bytes(std::span(values)), kArrayBuffer);
        mAccessors.push_back(
                { { "bufferView", view }, { "componentType", kFloat }, { "count", values.size() }, { "type", type } });
        return mAccessors.size() - 1;
    }

    /// Accessors of positions state their bounds (section 3.7.2.1).
    size_t addPositions(std::vector<float3> const& positions) {
        float3 low = positions[0], high = positions[0];
        for (float3 const& position : positions) low = glm::min(low, position), high = glm::max(high, position);
        const size_t accessor = addVectors(positions, "VEC3");
        mAccessors[accessor]["min"] = { low.x, low.y, low.z };
        mAccessors[accessor]["max"] = { high.x, high.y, high.z };
        return accessor;
    }

    size_t addIndices(std::vector<uint32_t> const& indices, size_t vertexCount) {
        constexpr int kElementBuffer = 34963, kShort = 5123, kInt = 5125;
        const bool isShort = vertexCount < 65536;
        const std::vector<uint16_t> narrow(indices.begin(), isShort ? indices.end() : indices.begin());
        const auto bytes = isShort ? std::as_bytes(std::span(narrow)) : std::as_bytes(std::span(indices));
        const size_t view = addView(bytes, kElementBuffer);
        mAccessors.push_back({ { "bufferView", view },
                               { "componentType", isShort ? kShort : kInt },
                               { "count", indices.size() },
                               { "type", "SCALAR" } });
        return mAccessors.size() - 1;
    }

    void finish(Json& root) {
        mBytes.resize((mBytes.size() + 3) & ~size_t{ 3 });
        if (mBytes.empty()) return;
        root["accessors"] = mAccessors;
        root["bufferViews"] = mViews;
        root["buffers"] = Json::array({ { { "byteLength", mBytes.size() } } });
    }

    std::vector<std::byte> const& bytes() const { return mBytes; }

private:
    std::vector<std::byte> mBytes;
    Json mViews = Json::array(), mAccessors = Json::array();
};

Result<void> checkPrimitive(GlbScene const& scene, GlbPrimitive const& primitive, std::string const& path) {
    const size_t count = primitive.positions.size();
    const auto fits = [&](size_t size) { return size == 0 || size == count; };
    if (count == 0) return fail(ErrorCode::InvalidArgument, "{}: has no positions", path);
    if (!fits(primitive.normals.size()) || !fits(primitive.tangents.size()) || !fits(primitive.colors.size()) ||
        !fits(primitive.uvs.size())) {
        return fail(ErrorCode::InvalidArgument, "{}: its attributes differ in length", path);
    }
    const bool isInRange =
            std::all_of(primitive.indices.begin(), primitive.indices.end(), [&](uint32_t i) { return i < count; });
    if (!isInRange) return fail(ErrorCode::InvalidArgument, "{}: an index is out of range", path);
    if (primitive.material != kNone && primitive.material >= scene.materials.size()) {
        return fail(ErrorCode::InvalidArgument, "{}: its material is out of range", path);
    }
    return {};
}

Result<void> checkMaterial(GlbScene const& scene, size_t index) {
    MaterialData const& material = scene.materials[index];
    for (TextureRef const* texture : { &material.baseColor, &material.metallicRoughness, &material.normal,
                                       &material.occlusion, &material.emissive, &material.bump.map }) {
        if (texture->image != kNone && texture->image >= scene.images.size()) {
            return fail(ErrorCode::InvalidArgument, "materials[{}]: an image is out of range", index);
        }
    }
    return {};
}

Result<void> checkNodes(GlbScene const& scene) {
    std::vector<bool> hasParent(scene.nodes.size(), false);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        GlbNode const& node = scene.nodes[i];
        const bool isValid = (node.mesh == kNone || node.mesh < scene.meshes.size()) &&
                             (node.light == kNone || node.light < scene.lights.size());
        if (!isValid) return fail(ErrorCode::InvalidArgument, "nodes[{}]: its mesh or light is out of range", i);
        for (const uint32_t child : node.children) {
            if (child >= scene.nodes.size() || child == i || hasParent[child]) {
                return fail(ErrorCode::InvalidArgument, "nodes[{}]: child {} is out of range or has a parent", i,
                            child);
            }
            hasParent[child] = true;
        }
    }
    return {};
}

Result<void> checkScene(GlbScene const& scene) {
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        if (scene.meshes[m].primitives.empty()) {
            return fail(ErrorCode::InvalidArgument, "meshes[{}]: has no primitives", m);
        }
        for (size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
            const std::string path = fmt::format("meshes[{}].primitives[{}]", m, p);
            if (auto checked = checkPrimitive(scene, scene.meshes[m].primitives[p], path); !checked) return checked;
        }
    }
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        if (auto checked = checkMaterial(scene, i); !checked) return checked;
    }
    for (auto const& level :
         scene.imageBasedLight ? scene.imageBasedLight->levels : std::vector<std::array<uint32_t, 6>>()) {
        if (std::ranges::any_of(level, [&](uint32_t image) { return image >= scene.images.size(); }))
            return fail(ErrorCode::InvalidArgument, "imageBasedLight: an image is out of range");
    }
    return checkNodes(scene);
}

Json primitiveJson(GlbPrimitive const& primitive, BufferWriter& buffer) {
    Json attributes{ { "POSITION", buffer.addPositions(primitive.positions) } };
    if (!primitive.normals.empty()) attributes["NORMAL"] = buffer.addVectors(primitive.normals, "VEC3");
    if (!primitive.tangents.empty()) attributes["TANGENT"] = buffer.addVectors(primitive.tangents, "VEC4");
    if (!primitive.colors.empty()) attributes["COLOR_0"] = buffer.addVectors(primitive.colors, "VEC4");
    if (!primitive.uvs.empty()) attributes["TEXCOORD_0"] = buffer.addVectors(primitive.uvs, "VEC2");
    Json json{ { "attributes", std::move(attributes) } };
    if (primitive.arePoints) json["mode"] = 0;
    if (!primitive.indices.empty()) json["indices"] = buffer.addIndices(primitive.indices, primitive.positions.size());
    if (primitive.material != kNone) json["material"] = primitive.material;
    return json;
}

Json meshesJson(GlbScene const& scene, BufferWriter& buffer) {
    Json meshes = Json::array();
    for (GlbMesh const& mesh : scene.meshes) {
        Json primitives = Json::array();
        for (GlbPrimitive const& primitive : mesh.primitives) primitives.push_back(primitiveJson(primitive, buffer));
        meshes.push_back({ { "name", mesh.name }, { "primitives", std::move(primitives) } });
    }
    return meshes;
}

Json imagesJson(GlbScene const& scene, BufferWriter& buffer) {
    Json images = Json::array();
    for (GlbImage const& image : scene.images) {
        const bool isPng = !image.file.empty() && image.file[0] == std::byte{ 0x89 };
        images.push_back({ { "name", image.name },
                           { "bufferView", buffer.addView(image.file, 0) },
                           { "mimeType", isPng ? "image/png" : "image/jpeg" } });
    }
    return images;
}

void append(std::vector<std::byte>& file, uint32_t word) {
    std::byte bytes[4];
    std::memcpy(bytes, &word, 4);
    file.insert(file.end(), bytes, bytes + 4);
}

/// Section 4.4: header, JSON chunk padded with spaces, BIN chunk padded with zeros.
Result<std::vector<std::byte>> assembleGlb(std::string text, std::vector<std::byte> const& binary) {
    text.resize((text.size() + 3) & ~size_t{ 3 }, ' ');
    const size_t total = 12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
    if (total > kNone) return fail(ErrorCode::OutOfMemory, "a .glb of {} bytes is beyond 4 GiB", total);
    std::vector<std::byte> file;
    file.reserve(total);
    for (const uint32_t word :
         { 0x46546C67u, 2u, static_cast<uint32_t>(total), static_cast<uint32_t>(text.size()), 0x4E4F534Au }) {
        append(file, word);
    }
    const auto json = std::as_bytes(std::span(text.data(), text.size()));
    file.insert(file.end(), json.begin(), json.end());
    if (binary.empty()) return file;
    append(file, static_cast<uint32_t>(binary.size()));
    append(file, 0x004E4942u);
    file.insert(file.end(), binary.begin(), binary.end());
    return file;
}

} // namespace

Result<std::vector<std::byte>> writeGlb(GlbScene const& scene) {
    if (const Result<void> checked = checkScene(scene); !checked) return checked.error();
    Json root{ { "asset", { { "version", "2.0" }, { "generator", "filament_core" } } } };
    if (!scene.copyright.empty()) root["asset"]["copyright"] = scene.copyright;
    BufferWriter buffer;
    addNodes(scene, root);
    if (!scene.meshes.empty()) root["meshes"] = meshesJson(scene, buffer);
    addMaterials(scene, root);
    if (!scene.images.empty()) root["images"] = imagesJson(scene, buffer);
    addLights(scene, root);
    buffer.finish(root);
    // replace instead of throwing: names may contain bytes that are not UTF-8
    return assembleGlb(root.dump(-1, ' ', false, Json::error_handler_t::replace), buffer.bytes());
}

Result<GlbImage> glbImageFromPixels(std::string name, uint32_t width, uint32_t height, std::span<const std::byte> rgba8,
                                    GlbAlpha alpha) {
    if (width == 0 || height == 0 || rgba8.size() != size_t{ width } * height * 4) {
        return fail(ErrorCode::InvalidArgument, "image '{}': {} bytes are not {} x {} RGBA pixels", name, rgba8.size(),
                    width, height);
    }
    bool isOpaque = alpha == GlbAlpha::IfUsed;
    for (size_t i = 3; i < rgba8.size(); i += 4) isOpaque = isOpaque && rgba8[i] == std::byte{ 255 };
    std::vector<std::byte> pixels(rgba8.begin(), rgba8.end());
    if (isOpaque) { // three bytes per pixel, in place
        for (size_t i = 0; i < size_t{ width } * height; ++i) std::copy_n(&rgba8[i * 4], 3, &pixels[i * 3]);
    }
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = width;
    png.height = height;
    png.format = isOpaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(png);
    GlbImage image{ std::move(name), std::vector<std::byte>(bytes) };
    if (!png_image_write_to_memory(&png, image.file.data(), &bytes, 0, pixels.data(), 0, nullptr)) {
        return fail(ErrorCode::Internal, "image '{}': {}", image.name, static_cast<const char*>(png.message));
    }
    image.file.resize(bytes);
    return image;
}

} // namespace filament_core::assets
