// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfPointer.h"

#include "base/NumberText.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace filament_core::assets {
namespace {

constexpr size_t kLongestPointer = 256; // the longest of the object model has 130 bytes

/// RFC 6901, sections 3 and 4: what is between slashes, with ~1 for a slash and ~0 for a tilde. Empty: no pointer.
std::vector<std::string> tokensOf(std::string_view pointer) {
    std::vector<std::string> tokens;
    if (pointer.empty() || pointer.front() != '/' || pointer.size() > kLongestPointer) return tokens;
    for (size_t i = 0; i < pointer.size(); ++i) {
        if (pointer[i] == '/') {
            tokens.emplace_back();
        } else if (pointer[i] == '~') {
            ++i;
            if (i == pointer.size() || (pointer[i] != '0' && pointer[i] != '1')) return {};
            tokens.back() += pointer[i] == '0' ? '~' : '/';
        } else {
            tokens.back() += pointer[i];
        }
    }
    return tokens;
}

/// RFC 6901, section 4: digits without leading zeros. kNone: no index below `count`.
uint32_t indexFrom(std::string const& token, size_t count) {
    if (token.size() > 1 && token.front() == '0') return kNone;
    const uint32_t index = numberOf<uint32_t>(token).value_or(kNone);
    return index < count ? index : kNone;
}

/// Of the tables, split once: a file may have many pointers.
struct TableTokens {
    std::vector<std::vector<std::string>> rows, textures; ///< parallel to propertyRows() and texturePaths()

    TableTokens() {
        for (PropertyRow const& row : propertyRows()) rows.push_back(tokensOf(row.pointer));
        for (TexturePath const& path : texturePaths()) textures.push_back(tokensOf(fmt::format("/{}", path.path)));
    }
};

TableTokens const& tableTokens() {
    static const TableTokens tokens;
    return tokens;
}

/// The texture with whose path `tokens` begin; kNone: none.
size_t textureAt(std::span<const std::string> tokens) {
    auto const& textures = tableTokens().textures;
    const auto found = std::ranges::find_if(textures, [&](std::vector<std::string> const& own) {
        return own.size() <= tokens.size() && std::ranges::equal(own, tokens.first(own.size()));
    });
    return found == textures.end() ? kNone : static_cast<size_t>(found - textures.begin());
}

/// What a pointer has in the places of a row's {} and {texture}.
struct Match {
    std::string index;
    TexturePath const* texture = nullptr;
    size_t objectDepth = 0; ///< tokens up to the index
};

std::optional<Match> matched(PropertyRow const& row, std::vector<std::string> const& tokens) {
    Match match;
    size_t at = 0;
    for (std::string const& wanted : tableTokens().rows[static_cast<size_t>(&row - propertyRows().data())]) {
        if (at >= tokens.size()) return std::nullopt;
        if (wanted == "{texture}") {
            const size_t texture = textureAt(std::span(tokens).subspan(at));
            if (texture == kNone) return std::nullopt;
            match.texture = &texturePaths()[texture];
            at += tableTokens().textures[texture].size();
            continue;
        }
        if (wanted == "{}") {
            match.index = tokens[at];
            match.objectDepth = at + 1;
        } else if (wanted != tokens[at]) {
            return std::nullopt;
        }
        ++at;
    }
    return at == tokens.size() ? std::optional(match) : std::nullopt;
}

/// KHR_animation_pointer: a property is there if it is in the file, or has a default and its object is.
bool isDefined(JsonNode node, std::span<const std::string> path, bool hasDefault) {
    const std::span<const std::string> mustExist = hasDefault ? path.first(path.size() - 1) : path;
    for (std::string const& key : mustExist) {
        node = node[key.c_str()];
        if (!node.exists()) return false;
    }
    return true;
}

} // namespace

GltfPointers::Elements const& GltfPointers::elementsOf(PropertyOwner owner) {
    const auto listed = [](std::optional<Elements>& list, JsonNode const& array) -> Elements const& {
        if (!list) list = array.elements();
        return *list;
    };
    switch (owner) {
    case PropertyOwner::Node:
        return listed(mNodes, mRoot["nodes"]);
    case PropertyOwner::Material:
        return listed(mMaterials, mRoot["materials"]);
    case PropertyOwner::Light:
        return listed(mLights, mRoot.extension("KHR_lights_punctual")["lights"]);
    case PropertyOwner::Camera:
        break;
    }
    return listed(mCameras, mRoot["cameras"]);
}

GltfPointers::Elements const& GltfPointers::meshes() {
    if (!mMeshes) mMeshes = mRoot["meshes"].elements();
    return *mMeshes;
}

/// "/nodes/{}/translation", rotation, scale: they have defaults, but a matrix takes their place (glTF 2.0, 3.5.2).
std::optional<GltfAnimationChannel> GltfPointers::poseOf(Tokens const& tokens) {
    constexpr std::array kPaths{ "translation", "rotation", "scale" };
    if (tokens.size() != 3 || tokens[0] != "nodes") return std::nullopt;
    auto const* path = std::ranges::find(kPaths, tokens[2]);
    Elements const& nodes = elementsOf(PropertyOwner::Node);
    const uint32_t node = indexFrom(tokens[1], nodes.size());
    if (path == kPaths.end() || node == kNone || nodes[node]["matrix"].exists()) return std::nullopt;
    return GltfAnimationChannel{ .node = node, .path = static_cast<AnimationPath>(path - kPaths.begin()) };
}

/// "/nodes/{}/weights", "/meshes/{}/weights", or one of them: "/meshes/{}/weights/{}".
std::optional<GltfAnimationChannel> GltfPointers::weightsOf(Tokens const& tokens) {
    if (tokens.size() < 3 || tokens.size() > 4 || tokens[2] != "weights") return std::nullopt;
    const bool isNode = tokens[0] == "nodes";
    if (!isNode && tokens[0] != "meshes") return std::nullopt;
    Elements const& objects = isNode ? elementsOf(PropertyOwner::Node) : meshes();
    const uint32_t object = indexFrom(tokens[1], objects.size());
    if (object == kNone) return std::nullopt;
    GltfAnimationChannel channel{ .path = AnimationPath::Weights };
    (isNode ? channel.node : channel.mesh) = object;
    if (tokens.size() == 3) return channel;
    channel.weight = indexFrom(tokens[3], kNone);
    return channel.weight == kNone ? std::nullopt : std::optional(channel);
}

std::optional<GltfAnimationChannel> GltfPointers::propertyOf(PropertyRow const& row, Tokens const& tokens) {
    const std::optional<Match> match = matched(row, tokens);
    if (!match) return std::nullopt;
    Elements const& objects = elementsOf(row.owner);
    const uint32_t object = indexFrom(match->index, objects.size());
    if (object == kNone) return std::nullopt;
    if (!isDefined(objects[object], std::span(tokens).subspan(match->objectDepth), row.isDefinedAlways))
        return std::nullopt;
    GltfAnimationChannel channel{ .path = AnimationPath::Property };
    channel.property = { .owner = row.owner, .name = row.name, .object = object };
    if (match->texture) channel.property.map = match->texture->map;
    return channel;
}

std::optional<GltfAnimationChannel> GltfPointers::resolve(std::string_view pointer) {
    const Tokens tokens = tokensOf(pointer);
    if (tokens.empty()) return std::nullopt;
    if (auto pose = poseOf(tokens)) return pose;
    if (auto weights = weightsOf(tokens)) return weights;
    for (PropertyRow const& row : propertyRows()) {
        if (auto property = propertyOf(row, tokens)) return property;
    }
    return std::nullopt;
}

GltfTextureInfo* textureInfoOf(GltfMaterial& m, MapName map) {
    switch (map) {
    case MapName::None:
        return nullptr;
    case MapName::BaseColor:
        return &m.baseColor;
    case MapName::MetallicRoughness:
        return &m.metallicRoughness;
    case MapName::Normal:
        return &m.normal;
    case MapName::Occlusion:
        return &m.occlusion;
    case MapName::Emissive:
        return &m.emissive;
    case MapName::Bump:
        return &m.bump;
    case MapName::ClearCoat:
        return &m.clearCoat.first;
    case MapName::ClearCoatRoughness:
        return &m.clearCoat.second;
    case MapName::ClearCoatNormal:
        return &m.clearCoatNormal;
    case MapName::Sheen:
        return &m.sheen.first;
    case MapName::SheenRoughness:
        return &m.sheen.second;
    case MapName::Specular:
        return &m.specular.first;
    case MapName::SpecularFactor:
        return &m.specular.second;
    case MapName::Anisotropy:
        return &m.anisotropy;
    case MapName::Iridescence:
        return &m.iridescence.first;
    case MapName::IridescenceThickness:
        return &m.iridescence.second;
    case MapName::Transmission:
        return &m.transmission.first;
    case MapName::Thickness:
        return &m.transmission.second;
    case MapName::DiffuseTransmission:
        return &m.diffuseTransmission.first;
    case MapName::DiffuseTransmissionFactor:
        return &m.diffuseTransmission.second;
    case MapName::Multiscatter:
        return &m.multiscatter;
    case MapName::Light:
        return &m.light;
    }
    return nullptr;
}

void keepAnimated(GltfDocument& document) {
    for (GltfAnimation const& animation : document.animations) {
        for (GltfAnimationChannel const& channel : animation.channels) {
            if (channel.path != AnimationPath::Property) continue;
            AnimatedProperty const& property = channel.property;
            if (property.name == PropertyName::NodeVisible) document.nodes[property.object].isVisibilityAnimated = true;
            if (property.owner != PropertyOwner::Material) continue;
            GltfMaterial& material = document.materials[property.object];
            keepProperty(material.values, property.name);
            if (GltfTextureInfo* info = textureInfoOf(material, property.map)) info->isAnimated = true;
        }
    }
}

} // namespace filament_core::assets
