// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfMergeShift.h"

#include <nlohmann/json.hpp>

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

/// "/nodes/3/..." with the index moved; `isShared`: what it names is not of a copy.
std::string shiftedPointer(std::string const& pointer, GltfOffsets const& by, GltfCopyOffsets const& copy,
                           bool& isShared) {
    struct Row {
        std::string_view prefix;
        size_t by;
        bool isShared;
    };
    const Row rows[] = { { "/nodes/", copy.nodes, false },
                         { "/meshes/", by.meshes, true },
                         { "/materials/", by.materials, true },
                         { "/cameras/", by.cameras, true },
                         { "/extensions/KHR_lights_punctual/lights/", by.lights, true },
                         { "/extensions/EXT_lights_image_based/lights/", by.environments, true },
                         { "/extensions/EXT_lights_ies/lights/", by.profiles, true } };
    for (Row const& row : rows) {
        if (!pointer.starts_with(row.prefix)) continue;
        isShared = row.isShared;
        const size_t begin = row.prefix.size(), end = std::min(pointer.find('/', begin), pointer.size());
        const std::string digits = pointer.substr(begin, end - begin);
        if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
            return pointer;
        return std::string(row.prefix) + std::to_string(std::stoul(digits) + row.by) + pointer.substr(end);
    }
    return pointer;
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
