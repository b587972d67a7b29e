// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfMergeShift.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace filament_core::assets {
namespace {

void moveIndex(Json& index, size_t by) {
    if (index.is_number_unsigned()) index = index.get<size_t>() + by;
}

void shiftMember(Json& object, const char* key, size_t by) {
    if (Json* const index = memberOf(object, key)) moveIndex(*index, by);
}

void shiftElements(Json& object, const char* key, size_t by) {
    if (Json* const list = memberOf(object, key); list && list->is_array())
        for (Json& index : *list) moveIndex(index, by);
}

void shiftAll(Json& object, const char* key, size_t by) {
    if (Json* const map = memberOf(object, key); map && map->is_object())
        for (Json& index : *map) moveIndex(index, by);
}

/// Infos of textures: members "...Texture" with an "index", however deep.
void shiftInfos(Json& value, size_t by) {
    if (!value.is_object()) return;
    for (auto const& item : value.items()) {
        if (item.key() == "extras" || !item.value().is_object()) continue;
        if (item.key().ends_with("Texture")) shiftMember(item.value(), "index", by);
        shiftInfos(item.value(), by);
    }
}

void shiftVariants(Json& primitive, GltfOffsets const& by) {
    Json* const extension = extensionOf(primitive, "KHR_materials_variants");
    Json* const mappings = extension ? memberOf(*extension, "mappings") : nullptr;
    if (!mappings || !mappings->is_array()) return;
    for (Json& mapping : *mappings) {
        shiftMember(mapping, "material", by.materials);
        Json* const variants = memberOf(mapping, "variants");
        if (!variants || !variants->is_array()) continue;
        for (Json& variant : *variants)
            if (variant.is_number_unsigned() && variant.get<size_t>() < by.variants.size())
                variant = by.variants[variant.get<size_t>()];
    }
}

/// An array of a file by the beginning of the pointers to its elements.
struct PointedArray {
    std::string_view prefix;
    size_t by;
    bool isShared; ///< its elements are not of a copy
};

std::array<PointedArray, 7> pointedArrays(GltfOffsets const& by, GltfCopyOffsets const& copy) {
    return { { { "/nodes/", copy.nodes, false },
               { "/meshes/", by.meshes, true },
               { "/materials/", by.materials, true },
               { "/cameras/", by.cameras, true },
               { "/extensions/KHR_lights_punctual/lights/", by.lights, true },
               { "/extensions/EXT_lights_image_based/lights/", by.environments, true },
               { "/extensions/EXT_lights_ies/lights/", by.profiles, true } } };
}

/// The index that a pointer has behind its prefix, and where it ends.
struct PointerIndex {
    size_t value = 0, end = 0;
};

std::optional<PointerIndex> indexOf(std::string_view pointer, size_t begin) {
    uint32_t value = 0;
    const auto [at, failure] = std::from_chars(pointer.data() + begin, pointer.data() + pointer.size(), value);
    const auto end = static_cast<size_t>(at - pointer.data());
    if (failure != std::errc() || (end < pointer.size() && pointer[end] != '/')) return std::nullopt;
    return PointerIndex{ value, end };
}

/// "/nodes/3/..." with the index moved; `isShared`: what it names is not of a copy.
std::string shiftedPointer(std::string const& pointer, GltfOffsets const& by, GltfCopyOffsets const& copy,
                           bool& isShared) {
    for (PointedArray const& array : pointedArrays(by, copy)) {
        if (!pointer.starts_with(array.prefix)) continue;
        isShared = array.isShared;
        const std::optional<PointerIndex> index = indexOf(pointer, array.prefix.size());
        if (!index) return pointer;
        return fmt::format("{}{}{}", array.prefix, index->value + array.by,
                           std::string_view(pointer).substr(index->end));
    }
    return pointer;
}

bool hasElement(Json const& file, std::string_view prefix, size_t index) {
    const Json::json_pointer array(std::string(prefix, 0, prefix.size() - 1)); // without the last slash
    return file.contains(array) && file[array].is_array() && index < file[array].size();
}

bool isPointerInside(std::string_view pointer, Json const& file) {
    for (PointedArray const& array : pointedArrays({}, {})) {
        if (!pointer.starts_with(array.prefix)) continue;
        const std::optional<PointerIndex> index = indexOf(pointer, array.prefix.size());
        return !index || hasElement(file, array.prefix, index->value);
    }
    return true;
}

} // namespace

Json* memberOf(Json& value, const char* key) {
    if (!value.is_object()) return nullptr;
    const auto found = value.find(key);
    return found == value.end() ? nullptr : &*found;
}

Json const* memberOf(Json const& value, const char* key) { return memberOf(const_cast<Json&>(value), key); }

Json* extensionOf(Json& value, const char* name) {
    Json* const extensions = memberOf(value, "extensions");
    return extensions ? memberOf(*extensions, name) : nullptr;
}

Json const* extensionOf(Json const& value, const char* name) { return extensionOf(const_cast<Json&>(value), name); }

void shiftAccessor(Json& accessor, GltfOffsets const& by) {
    shiftMember(accessor, "bufferView", by.views);
    Json* const sparse = memberOf(accessor, "sparse");
    if (!sparse) return;
    for (const char* const part : { "indices", "values" })
        if (Json* const view = memberOf(*sparse, part)) shiftMember(*view, "bufferView", by.views);
}

void shiftTexture(Json& texture, GltfOffsets const& by) {
    shiftMember(texture, "sampler", by.samplers);
    shiftMember(texture, "source", by.images);
    Json* const extensions = memberOf(texture, "extensions");
    if (!extensions || !extensions->is_object()) return;
    for (Json& extension : *extensions) {
        shiftMember(extension, "source", by.images);
        shiftMember(extension, "openness", by.images); // FILAMENT_lightmap
    }
}

void shiftMaterial(Json& material, GltfOffsets const& by) {
    shiftInfos(material, by.textures);
    if (Json* const levels = extensionOf(material, "MSFT_lod")) shiftElements(*levels, "ids", by.materials);
}

void shiftMesh(Json& mesh, GltfOffsets const& by) {
    Json* const primitives = memberOf(mesh, "primitives");
    if (primitives && primitives->is_array()) {
        for (Json& primitive : *primitives) {
            shiftAll(primitive, "attributes", by.accessors);
            shiftMember(primitive, "indices", by.accessors);
            shiftMember(primitive, "material", by.materials);
            if (Json* const targets = memberOf(primitive, "targets"); targets && targets->is_array())
                for (Json& target : *targets)
                    if (target.is_object())
                        for (Json& index : target) moveIndex(index, by.accessors);
            if (Json* const draco = extensionOf(primitive, "KHR_draco_mesh_compression"))
                shiftMember(*draco, "bufferView", by.views); // its attributes are ids of the stream
            shiftVariants(primitive, by);
        }
    }
    Json* const restarts = extensionOf(mesh, "EXT_mesh_primitive_restart");
    Json* const groups = restarts ? memberOf(*restarts, "primitiveGroups") : nullptr;
    if (groups && groups->is_array())
        for (Json& group : *groups) shiftMember(group, "indices", by.accessors);
}

void shiftEnvironment(Json& light, GltfOffsets const& by) {
    Json* const levels = memberOf(light, "specularImages");
    if (!levels || !levels->is_array()) return;
    for (Json& level : *levels)
        if (level.is_array())
            for (Json& image : level) moveIndex(image, by.images);
}

void shiftNode(Json& node, GltfOffsets const& by, GltfCopyOffsets const& copy) {
    shiftElements(node, "children", copy.nodes);
    shiftMember(node, "mesh", by.meshes);
    shiftMember(node, "skin", copy.skins);
    shiftMember(node, "camera", by.cameras);
    if (Json* const light = extensionOf(node, "KHR_lights_punctual")) shiftMember(*light, "light", by.lights);
    if (Json* const light = extensionOf(node, "EXT_lights_ies")) shiftMember(*light, "light", by.profiles);
    if (Json* const instances = extensionOf(node, "EXT_mesh_gpu_instancing"))
        shiftAll(*instances, "attributes", by.accessors);
    if (Json* const levels = extensionOf(node, "MSFT_lod")) shiftElements(*levels, "ids", copy.nodes);
}

void shiftSkin(Json& skin, GltfOffsets const& by, GltfCopyOffsets const& copy) {
    shiftElements(skin, "joints", copy.nodes);
    shiftMember(skin, "skeleton", copy.nodes);
    shiftMember(skin, "inverseBindMatrices", by.accessors);
}

void shiftSampler(Json& sampler, GltfOffsets const& by) {
    shiftMember(sampler, "input", by.accessors);
    shiftMember(sampler, "output", by.accessors);
}

bool isChannelInside(Json const& channel, Json const& file) {
    Json const* const target = memberOf(channel, "target");
    if (!target) return false;
    Json const* const node = memberOf(*target, "node");
    if (node && node->is_number_unsigned() && !hasElement(file, "/nodes/", node->get<size_t>())) return false;
    Json const* const extension = extensionOf(*target, "KHR_animation_pointer");
    Json const* const pointer = extension ? memberOf(*extension, "pointer") : nullptr;
    return !pointer || !pointer->is_string() || isPointerInside(pointer->get_ref<std::string const&>(), file);
}

bool shiftChannel(Json& channel, GltfOffsets const& by, GltfCopyOffsets const& copy, bool isFirst) {
    Json* const target = memberOf(channel, "target");
    if (!target) return false;
    shiftMember(*target, "node", copy.nodes);
    Json* const extension = extensionOf(*target, "KHR_animation_pointer");
    Json* const pointer = extension ? memberOf(*extension, "pointer") : nullptr;
    if (!pointer || !pointer->is_string()) return memberOf(*target, "node") || isFirst;
    bool isShared = true;
    *pointer = shiftedPointer(pointer->get<std::string>(), by, copy, isShared);
    return !isShared || isFirst;
}

} // namespace filament_core::assets
