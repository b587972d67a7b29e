// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfMergeSource.h"

#include "filament_core/assets/gltf/GltfContainer.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace filament_core::assets {
namespace {

using Bytes = std::span<const std::byte>;

constexpr int kDeepest = 64; // values; deeper ones are no field of glTF
constexpr const char* kProfileMimeType = "application/x-ies-lm-63";

/// By the first bytes of an image; null: no format of glTF or its extensions.
const char* mimeTypeOf(Bytes image) {
    const auto begins = [&](std::string_view magic, size_t at = 0) {
        return image.size() >= at + magic.size() && std::memcmp(image.data() + at, magic.data(), magic.size()) == 0;
    };
    if (begins("\x89PNG")) return "image/png";
    if (begins("\xFF\xD8")) return "image/jpeg";
    if (begins("\xABKTX 20\xBB")) return "image/ktx2";
    if (begins("RIFF") && begins("WEBP", 8)) return "image/webp";
    if (begins("ftypavif", 4) || begins("ftypavis", 4)) return "image/avif";
    if (begins("DDS ")) return "image/vnd-ms.dds";
    return nullptr;
}

class SourceAppender {
public:
    SourceAppender(GltfMergeSource const& source, GltfMergeState& state) : mSource(source), mState(state) {}

    Result<GltfMergedSource> add() {
        const Result<GltfContainer> container = openGltfContainer(mSource.file);
        if (!container) return fail(container.error().code, "{}: {}", mSource.name, container.error().message);
        const char* const text = reinterpret_cast<const char*>(container->json.data());
        mJson = Json::parse(
                text, text + container->json.size(),
                [](int depth, Json::parse_event_t, Json&) { return depth < kDeepest; }, false);
        if (!mJson.is_object()) return fail(ErrorCode::Corrupt, "{}: its JSON is no object", mSource.name);
        if (Result<void> added = addBuffers(*container); !added) return added.error();
        addArrays();
        if (Result<void> added = addFiles(); !added) return added.error();
        addExtensions();
        return GltfMergedSource{ std::move(mJson), std::move(mOffsets) };
    }

private:
    /// Where the bytes of a buffer of the source are.
    struct Place {
        size_t buffer = 0, offset = 0;
    };

    Json& target(const char* key) { return gltfList(mState.root, key); }

    Result<void> addBuffers(GltfContainer const& container) {
        Json const* const buffers = memberOf(std::as_const(mJson), "buffers");
        if (!buffers || !buffers->is_array()) return {};
        for (size_t i = 0; i < buffers->size(); ++i) {
            Json const& buffer = (*buffers)[i];
            Json const* const uri = memberOf(buffer, "uri");
            std::vector<std::byte> owned;
            Bytes bytes;
            if (uri && uri->is_string()) {
                Result<std::vector<std::byte>> read = readGltfUri(uri->get<std::string>(), mSource.folder);
                if (!read) return fail(read.error().code, "{}: buffers[{}]: {}", mSource.name, i, read.error().message);
                owned = std::move(*read);
                bytes = owned;
            } else if (i == 0 && container.hasBinary) {
                bytes = container.binary;
            }
            if (Json const* const length = memberOf(buffer, "byteLength"); length && length->is_number_unsigned())
                bytes = bytes.first(std::min(bytes.size(), length->get<size_t>()));
            mPlaces.push_back(bytes.empty() ? placeOfFallback(buffer) : append(bytes));
        }
        return {};
    }

    Place append(Bytes bytes) {
        std::vector<std::byte>& all = mState.buffer;
        all.resize((all.size() + 7) & ~size_t{ 7 });
        const Place place{ 0, all.size() };
        all.insert(all.end(), bytes.begin(), bytes.end());
        return place;
    }

    /// Without data, beside a compressed one: stays a buffer. The first is that of all data.
    Place placeOfFallback(Json const& buffer) {
        Json& buffers = target("buffers");
        if (buffers.empty()) buffers.push_back(Json::object());
        buffers.push_back(buffer);
        return { buffers.size() - 1, 0 };
    }

    void placeView(Json& view) const {
        Json* const buffer = memberOf(view, "buffer");
        if (!buffer || !buffer->is_number_unsigned() || buffer->get<size_t>() >= mPlaces.size()) return;
        const Place place = mPlaces[buffer->get<size_t>()];
        *buffer = place.buffer;
        Json const* const offset = memberOf(std::as_const(view), "byteOffset");
        const size_t begin = offset && offset->is_number_unsigned() ? offset->get<size_t>() : 0;
        view["byteOffset"] = begin + place.offset;
    }

    /// Appends the elements of an array. Returns where they begin.
    template <class Move>
    size_t addArray(Json& to, Json* from, Move const& move) {
        const size_t begin = to.size();
        if (!from || !from->is_array()) return begin;
        for (Json& element : *from) {
            to.push_back(element);
            move(to.back());
        }
        return begin;
    }
    template <class Move>
    size_t addArray(const char* key, Move const& move) {
        return addArray(target(key), memberOf(mJson, key), move);
    }

    void addArrays() {
        GltfOffsets& by = mOffsets;
        by.views = addArray("bufferViews", [&](Json& view) {
            placeView(view);
            for (const char* const name : { "KHR_meshopt_compression", "EXT_meshopt_compression" })
                if (Json* const compressed = extensionOf(view, name)) placeView(*compressed);
        });
        by.accessors = addArray("accessors", [&](Json& accessor) { shiftAccessor(accessor, by); });
        by.samplers = addArray("samplers", [](Json&) {});
        by.images = addArray("images", [&](Json& image) {
            if (Json* const view = memberOf(image, "bufferView"); view && view->is_number_unsigned())
                *view = view->get<size_t>() + by.views;
        });
        by.textures = addArray("textures", [&](Json& texture) { shiftTexture(texture, by); });
        by.materials = addArray("materials", [&](Json& material) { shiftMaterial(material, by); });
        by.cameras = addArray("cameras", [](Json&) {});
        addVariants();
        by.meshes = addArray("meshes", [&](Json& mesh) { shiftMesh(mesh, by); });
    }

    /// Files of images and profiles become parts of the buffer.
    Result<void> addFiles() {
        Json& images = target("images");
        for (size_t i = mOffsets.images; i < images.size(); ++i)
            if (Result<void> added = embed(images[i], fmt::format("images[{}]", i - mOffsets.images), nullptr); !added)
                return added;
        return {};
    }

    Result<void> embed(Json& element, std::string const& path, const char* mimeType) {
        Json const* const uri = memberOf(std::as_const(element), "uri");
        if (!uri || !uri->is_string()) return {};
        Result<std::vector<std::byte>> bytes = readGltfUri(uri->get<std::string>(), mSource.folder);
        if (!bytes) {
            // The loader leaves alone what the scene does not show; this file keeps its place, without the image.
            const std::array white{ std::byte{ 255 }, std::byte{ 255 }, std::byte{ 255 }, std::byte{ 255 } };
            mState.warnings.push_back(fmt::format("{}: {}: {}; a white texel was written in its place", mSource.name,
                                                  path, bytes.error().message));
            Result<GlbImage> texel = glbImageFromPixels("missing", 1, 1, white);
            if (!texel) return texel.error();
            bytes = std::move(texel->file);
        }
        const char* const found = mimeType ? mimeType : mimeTypeOf(*bytes);
        element["bufferView"] = addGltfView(mState, *bytes, 0);
        if (found) element["mimeType"] = found;
        element.erase("uri");
        return {};
    }

    void addVariants() {
        Json* const extension = extensionOf(mJson, "KHR_materials_variants");
        Json* const variants = extension ? memberOf(*extension, "variants") : nullptr;
        if (!variants || !variants->is_array()) return;
        Json& all = gltfList(mState.root["extensions"]["KHR_materials_variants"], "variants");
        for (Json const& variant : *variants) {
            const auto isSame = [&](Json const& other) { return other.value("name", "") == variant.value("name", ""); };
            const auto found = std::find_if(all.begin(), all.end(), isSame);
            mOffsets.variants.push_back(static_cast<size_t>(found - all.begin()));
            if (found == all.end()) all.push_back(variant);
        }
    }

    template <class Move>
    size_t addLights(const char* name, Move const& move) {
        Json* const extension = extensionOf(mJson, name);
        Json* const lights = extension ? memberOf(*extension, "lights") : nullptr;
        Json* known = extensionOf(mState.root, name);
        if (!lights || lights->empty()) return known && known->contains("lights") ? (*known)["lights"].size() : 0;
        return addArray(gltfList(mState.root["extensions"][name], "lights"), lights, move);
    }

    void addExtensions() {
        mOffsets.lights = addLights("KHR_lights_punctual", [](Json&) {});
        mOffsets.environments =
                addLights("EXT_lights_image_based", [&](Json& light) { shiftEnvironment(light, mOffsets); });
        mOffsets.profiles = addLights("EXT_lights_ies", [&](Json& light) {
            if (Json* const view = memberOf(light, "bufferView"); view && view->is_number_unsigned())
                *view = view->get<size_t>() + mOffsets.views;
            if (Result<void> added = embed(light, "extensions.EXT_lights_ies.lights", kProfileMimeType); !added)
                mState.warnings.push_back(added.error().message);
        });
        addOthers();
        for (const char* const key : { "extensionsUsed", "extensionsRequired" }) {
            Json const* const names = memberOf(std::as_const(mJson), key);
            if (!names || !names->is_array()) continue;
            Json& all = target(key);
            for (Json const& name : *names)
                if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
        }
    }

    /// Extensions of the root that this program does not know: only one file can have each.
    void addOthers() {
        constexpr std::array kMoved{ "KHR_lights_punctual", "EXT_lights_image_based", "EXT_lights_ies",
                                     "KHR_materials_variants" };
        Json const* const extensions = memberOf(std::as_const(mJson), "extensions");
        if (!extensions || !extensions->is_object()) return;
        for (auto const& [name, value] : extensions->items()) {
            if (std::find(kMoved.begin(), kMoved.end(), name) != kMoved.end()) continue;
            Json& all = mState.root["extensions"];
            if (all.contains(name))
                mState.warnings.push_back(fmt::format(
                        "{}: extensions.{} is not written, because another file has it, too; save them one by one",
                        mSource.name, name));
            else
                all[name] = value;
        }
    }

    GltfMergeSource const& mSource;
    GltfMergeState& mState;
    Json mJson;
    GltfOffsets mOffsets;
    std::vector<Place> mPlaces;
};

} // namespace

Json& gltfList(Json& object, const char* key) {
    Json& list = object[key];
    if (!list.is_array()) list = Json::array();
    return list;
}

void useGltfExtension(const char* name, Json& root) {
    Json& used = gltfList(root, "extensionsUsed");
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

size_t addGltfView(GltfMergeState& state, std::span<const std::byte> bytes, int target) {
    state.buffer.resize((state.buffer.size() + 7) & ~size_t{ 7 });
    Json view{ { "buffer", 0 }, { "byteOffset", state.buffer.size() }, { "byteLength", bytes.size() } };
    if (target != 0) view["target"] = target;
    state.buffer.insert(state.buffer.end(), bytes.begin(), bytes.end());
    Json& views = gltfList(state.root, "bufferViews");
    views.push_back(std::move(view));
    return views.size() - 1;
}

Result<GltfMergedSource> addGltfSource(GltfMergeSource const& source, GltfMergeState& state) {
    return SourceAppender(source, state).add();
}

Json* defaultSceneOf(Json& json) {
    Json* const scenes = memberOf(json, "scenes");
    if (!scenes || !scenes->is_array() || scenes->empty()) return nullptr;
    Json const* const index = memberOf(std::as_const(json), "scene");
    const size_t wanted = index && index->is_number_unsigned() ? index->get<size_t>() : 0;
    return wanted < scenes->size() ? &(*scenes)[wanted] : nullptr;
}

} // namespace filament_core::assets
