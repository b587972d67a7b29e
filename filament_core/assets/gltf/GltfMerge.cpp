// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfMerge.h"

#include "filament_core/assets/gltf/GltfMergeSource.h"
#include "filament_core/assets/gltf/NodePose.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace filament_core::assets {
namespace {

constexpr int kVertexTarget = 34962, kIndexTarget = 34963, kFloatComponent = 5126, kShortComponent = 5123,
              kIntComponent = 5125;
constexpr std::array kLists{ "extensionsUsed", "extensionsRequired", "scenes",    "nodes",       "meshes",
                             "materials",      "textures",           "samplers",  "images",      "cameras",
                             "skins",          "animations",         "accessors", "bufferViews", "buffers" };

Json matrixJson(double4x4 const& matrix) {
    Json list = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) list.push_back(matrix[column][row]);
    return list;
}

void setPose(Json& node, double4x4 const& transform) {
    const NodePose pose = poseFrom(transform);
    node["translation"] = { pose.translation.x, pose.translation.y, pose.translation.z };
    node["rotation"] = { pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w };
    node["scale"] = { pose.scale.x, pose.scale.y, pose.scale.z };
}

/// A matrix keeps every bit of a transform, but nothing can animate it.
void setTransform(Json& node, double4x4 const& transform, bool isAnimated) {
    for (const char* const key : { "matrix", "translation", "rotation", "scale" }) node.erase(key);
    if (isAnimated)
        setPose(node, transform);
    else if (transform != double4x4(1.0))
        node["matrix"] = matrixJson(transform);
}

/// Whether a translation, a rotation and a scale give the matrix, as glTF 2.0 wants it (3.5.3).
bool isDecomposable(double4x4 const& matrix) {
    const double4x4 again = matrixFrom(poseFrom(matrix));
    for (int column = 0; column < 3; ++column) {
        const double size = glm::length(double3(matrix[column]));
        if (glm::length(double3(matrix[column] - again[column])) > 1e-4 * std::max(size, 1e-30)) return false;
    }
    return true;
}

class Merger {
public:
    Merger(GltfMerge const& merge, std::string_view bufferUri) : mMerge(merge), mBufferUri(bufferUri) {
        mRoot["asset"] = { { "version", "2.0" }, { "generator", merge.generator } };
        mRoot["scene"] = 0;
        mRoot["extensions"] = Json::object();
        // All at once: a new member would move the others.
        for (const char* const list : kLists) mRoot[list] = Json::array();
        mState.warnings = merge.warnings;
    }

    Result<GltfMerged> run() {
        for (GltfMergeSource const& source : mMerge.sources) {
            Result<GltfMergedSource> added = addGltfSource(source, mState);
            if (!added) return added.error();
            mSources.push_back(std::move(*added));
        }
        for (uint32_t copy = 0; copy < mMerge.copies.size(); ++copy) addCopy(copy);
        for (uint32_t source = 0; source < mSources.size(); ++source) addAnimations(source);
        addImages();
        for (GltfMergeMaterial const& material : mMerge.materials) addMaterial(material);
        for (GltfMergeMesh const& mesh : mMerge.meshes) addMesh(mesh);
        addLights();
        addNodes();
        addScene();
        addCopyrights();
        return finish();
    }

private:
    Json& list(const char* key) { return gltfList(mRoot, key); }
    void use(const char* extension) { useGltfExtension(extension, mRoot); }

    void addCopy(uint32_t copy) {
        GltfMergedSource& source = mSources[mMerge.copies[copy]];
        GltfCopyOffsets& offsets = mCopies.emplace_back();
        Json &nodes = list("nodes"), &skins = list("skins");
        offsets = { nodes.size(), skins.size() };
        if (Json const* const of = memberOf(std::as_const(source.json), "nodes"); of && of->is_array())
            for (Json node : *of) {
                shiftNode(node, source.offsets, offsets);
                nodes.push_back(std::move(node));
            }
        if (Json const* const of = memberOf(std::as_const(source.json), "skins"); of && of->is_array())
            for (Json skin : *of) {
                shiftSkin(skin, source.offsets, offsets);
                skins.push_back(std::move(skin));
            }
    }

    /// The channels of all copies move at the same time.
    void addAnimations(uint32_t index) {
        GltfMergedSource& source = mSources[index];
        Json const* const animations = memberOf(std::as_const(source.json), "animations");
        if (!animations || !animations->is_array()) return;
        for (Json animation : *animations) {
            if (Json* const samplers = memberOf(animation, "samplers"); samplers && samplers->is_array())
                for (Json& sampler : *samplers) shiftSampler(sampler, source.offsets);
            Json const* const ofFile = memberOf(std::as_const(animation), "channels");
            Json channels = Json::array();
            bool isFirst = true;
            for (size_t copy = 0; copy < mCopies.size(); ++copy) {
                if (mMerge.copies[copy] != index || !ofFile || !ofFile->is_array()) continue;
                for (Json channel : *ofFile) {
                    if (!isChannelInside(channel, source.json)) continue;
                    if (!shiftChannel(channel, source.offsets, mCopies[copy], isFirst)) continue;
                    noteAnimated(channel);
                    channels.push_back(std::move(channel));
                }
                isFirst = false;
            }
            animation["channels"] = std::move(channels);
            list("animations").push_back(std::move(animation));
        }
    }

    void noteAnimated(Json const& channel) {
        Json const* const target = memberOf(channel, "target");
        Json const* const node = target ? memberOf(*target, "node") : nullptr;
        if (node && node->is_number_unsigned()) mAnimated.insert(node->get<size_t>());
    }

    void addImages() {
        mFirstImage = list("images").size();
        for (GlbImage const& image : mMerge.images) {
            const bool isPng = !image.file.empty() && image.file[0] == std::byte{ 0x89 };
            Json json{ { "bufferView", addGltfView(mState, image.file, 0) },
                       { "mimeType", isPng ? "image/png" : "image/jpeg" } };
            if (!image.name.empty()) json["name"] = image.name;
            list("images").push_back(std::move(json));
        }
    }

    TextureRef placed(TextureRef reference) const {
        if (reference.image != kNone) reference.image += static_cast<uint32_t>(mFirstImage);
        return reference;
    }

    void addMaterial(GltfMergeMaterial const& material) {
        Json json = Json::object();
        if (material.source == kNone) {
            MaterialData data = material.data;
            for (TextureRef* const map : { &data.baseColor, &data.metallicRoughness, &data.normal, &data.occlusion,
                                           &data.emissive, &data.bump.map })
                *map = placed(*map);
            json = materialJson(data, mRoot);
        } else if (material.material != kNone) {
            json = list("materials")[mSources[material.source].offsets.materials + material.material];
        }
        for (GltfMergeValue const& value : material.values) setValue(json, value);
        for (auto const& [pointer, reference] : material.textures) {
            // A material reads the maps of its file alone. Their coordinates and transforms stay.
            if (json.contains(Json::json_pointer("/" + pointer)))
                memberAt(json, pointer)["index"] = textureInfoJson(placed(reference), mRoot)["index"];
        }
        mMaterials.push_back(list("materials").size());
        list("materials").push_back(std::move(json));
    }

    void setValue(Json& material, GltfMergeValue const& value) {
        // A factor of a map, such as the scale of normals, means nothing without the map.
        if (const size_t end = value.pointer.find("Texture/"); end != std::string::npos) {
            const Json::json_pointer map(fmt::format("/{}", std::string_view(value.pointer).substr(0, end + 7)));
            if (!material.contains(map)) return;
        }
        Json& member = memberAt(material, value.pointer);
        if (value.isBoolean)
            member = value.numbers.at(0) != 0;
        else if (value.numbers.size() == 1)
            member = value.numbers[0];
        else
            member = value.numbers;
    }

    /// Made where it is missing, with the extension that it belongs to.
    Json& memberAt(Json& json, std::string_view pointer) {
        Json* at = &json;
        bool isExtension = false;
        while (true) {
            const size_t end = std::min(pointer.find('/'), pointer.size());
            const std::string key(pointer.substr(0, end));
            if (isExtension) use(key.c_str());
            isExtension = key == "extensions";
            at = &(*at)[key];
            if (end == pointer.size()) return *at;
            pointer.remove_prefix(end + 1);
        }
    }

    template <class T>
    size_t addAccessor(std::vector<T> const& values, const char* type) {
        const size_t view = addGltfView(mState, std::as_bytes(std::span(values)), kVertexTarget);
        list("accessors")
                .push_back({ { "bufferView", view },
                             { "componentType", kFloatComponent },
                             { "count", values.size() },
                             { "type", type } });
        return list("accessors").size() - 1;
    }

    /// With the bounds that glTF wants of positions.
    size_t addPositions(std::vector<float3> const& positions) {
        float3 low = positions.at(0), high = low;
        for (float3 const& p : positions) low = glm::min(low, p), high = glm::max(high, p);
        const size_t accessor = addAccessor(positions, "VEC3");
        list("accessors")[accessor]["min"] = { low.x, low.y, low.z };
        list("accessors")[accessor]["max"] = { high.x, high.y, high.z };
        return accessor;
    }

    size_t addAttribute(GltfMergeAttribute const& attribute, size_t count) {
        Json json{ { "bufferView", addGltfView(mState, attribute.bytes, kVertexTarget) },
                   { "componentType", attribute.component },
                   { "count", count },
                   { "type", "VEC4" } };
        if (attribute.isNormalized) json["normalized"] = true;
        list("accessors").push_back(std::move(json));
        return list("accessors").size() - 1;
    }

    Json targetJson(MorphTargetData const& target) {
        Json json = Json::object();
        if (!target.positions.empty()) json["POSITION"] = addPositions(target.positions);
        if (!target.normals.empty()) json["NORMAL"] = addAccessor(target.normals, "VEC3");
        if (!target.tangents.empty()) json["TANGENT"] = addAccessor(target.tangents, "VEC3");
        return json;
    }

    Json ownPrimitive(GltfMergePrimitive const& primitive) {
        GlbPrimitive const& own = primitive.own;
        Json attributes = Json::object();
        attributes["POSITION"] = addPositions(own.positions);
        if (!own.normals.empty()) attributes["NORMAL"] = addAccessor(own.normals, "VEC3");
        if (!own.tangents.empty()) attributes["TANGENT"] = addAccessor(own.tangents, "VEC4");
        if (!own.colors.empty()) attributes["COLOR_0"] = addAccessor(own.colors, "VEC4");
        if (!own.uvs.empty()) attributes["TEXCOORD_0"] = addAccessor(own.uvs, "VEC2");
        for (GltfMergeAttribute const& attribute : primitive.attributes)
            attributes[attribute.name] = addAttribute(attribute, own.positions.size());
        Json json{ { "attributes", std::move(attributes) } };
        for (MorphTargetData const& target : primitive.targets) gltfList(json, "targets").push_back(targetJson(target));
        if (own.indices.empty()) return json;
        const bool isShort = own.positions.size() < 65536; // 65535 would restart primitives
        const std::vector<uint16_t> narrow(own.indices.begin(), isShort ? own.indices.end() : own.indices.begin());
        const auto bytes = isShort ? std::as_bytes(std::span(narrow)) : std::as_bytes(std::span(own.indices));
        json["indices"] = list("accessors").size();
        list("accessors")
                .push_back({ { "bufferView", addGltfView(mState, bytes, kIndexTarget) },
                             { "componentType", isShort ? kShortComponent : kIntComponent },
                             { "count", own.indices.size() },
                             { "type", "SCALAR" } });
        return json;
    }

    void addMesh(GltfMergeMesh const& mesh) {
        Json json = Json::object();
        if (mesh.source != kNone)
            json = list("meshes")[mSources[mesh.source].offsets.meshes + mesh.mesh];
        else if (!mesh.name.empty())
            json["name"] = mesh.name;
        const Json ofFile = json.contains("primitives") ? json["primitives"] : Json::array();
        const bool isDivisible = mesh.source == kNone || ofFile.size() == mesh.primitiveCount;
        if (!isDivisible)
            mState.warnings.push_back(fmt::format("mesh '{}': its primitives are drawn as one (primitive restart), so "
                                                  "changes of some of them are not written",
                                                  mesh.name));
        Json primitives = Json::array();
        for (GltfMergePrimitive const& primitive : mesh.primitives) {
            if (!isDivisible && primitive.primitive != kNone) continue;
            Json written = primitive.primitive == kNone ? ownPrimitive(primitive) : ofFile[primitive.primitive];
            if (primitive.primitive == kNone && primitive.mode != 4) written["mode"] = primitive.mode;
            if (primitive.material) written["material"] = mMaterials[*primitive.material];
            if (primitive.ofFile && *primitive.ofFile == kNone) written.erase("material");
            if (primitive.ofFile && *primitive.ofFile != kNone)
                written["material"] = mSources[mesh.source].offsets.materials + *primitive.ofFile;
            primitives.push_back(std::move(written));
        }
        if (isDivisible) {
            json["primitives"] = std::move(primitives);
            if (Json* const extensions = memberOf(json, "extensions")) extensions->erase("EXT_mesh_primitive_restart");
            eraseEmpty(json, "extensions");
        }
        mMeshes.push_back(list("meshes").size());
        list("meshes").push_back(std::move(json));
    }

    void addLights() {
        if (mMerge.lights.empty()) return;
        Json& lights = gltfList(mRoot["extensions"]["KHR_lights_punctual"], "lights");
        for (LightData const& light : mMerge.lights) {
            Json json = punctualLightJson(light);
            if (light.name.empty()) json.erase("name");
            if (json.contains("extensions")) use("FILAMENT_light");
            mLights.push_back(lights.size());
            lights.push_back(std::move(json));
        }
        use("KHR_lights_punctual");
    }

    static void setExtras(Json& json, std::string const& text) {
        if (text.empty()) return;
        const Json added = Json::parse(text, nullptr, false);
        if (!added.is_object()) return;
        Json& extras = json["extras"];
        if (!extras.is_object()) extras = Json::object();
        extras.update(added);
    }

    static void eraseEmpty(Json& json, const char* key) {
        if (Json const* const member = memberOf(json, key); member && member->empty()) json.erase(key);
    }

    void addNodes() {
        Json& nodes = list("nodes");
        size_t next = nodes.size();
        for (GltfMergeNode const& node : mMerge.nodes)
            mNodes.push_back(node.copy == kNone ? next++ : mCopies[node.copy].nodes + node.node);
        while (nodes.size() < next) nodes.push_back(Json::object());
        dropForeignChildren();
        addSkins();
        for (size_t i = 0; i < mMerge.nodes.size(); ++i) writeNode(mMerge.nodes[i], mNodes[i]);
    }

    void addSkins() {
        for (GltfMergeSkin const& skin : mMerge.skins) {
            Json joints = Json::array();
            for (const uint32_t joint : skin.joints) joints.push_back(mNodes[joint]);
            const size_t view = addGltfView(mState, std::as_bytes(std::span(skin.jointFromBind)), 0);
            Json json{ { "joints", std::move(joints) }, { "inverseBindMatrices", list("accessors").size() } };
            list("accessors")
                    .push_back({ { "bufferView", view },
                                 { "componentType", kFloatComponent },
                                 { "count", skin.jointFromBind.size() },
                                 { "type", "MAT4" } });
            mSkins.push_back(list("skins").size());
            list("skins").push_back(std::move(json));
        }
    }

    /// Nodes that the program removed stay, below none of the scene, for what names them. What is below them in the
    /// file may be elsewhere in the scene.
    void dropForeignChildren() {
        const std::set<size_t> placed(mNodes.begin(), mNodes.end());
        Json& nodes = list("nodes");
        for (size_t i = 0; i < nodes.size(); ++i) {
            Json* const children = memberOf(nodes[i], "children");
            if (placed.contains(i) || !children || !children->is_array()) continue;
            Json kept = Json::array();
            for (Json const& child : *children)
                if (!child.is_number_unsigned() || !placed.contains(child.get<size_t>())) kept.push_back(child);
            *children = std::move(kept);
            eraseEmpty(nodes[i], "children");
        }
    }

    void writeNode(GltfMergeNode const& node, size_t at) {
        Json& json = list("nodes")[at];
        if (!node.name.empty()) json["name"] = node.name;
        if (node.transform) {
            setTransform(json, *node.transform, mAnimated.contains(at));
            if (!isDecomposable(*node.transform))
                mState.warnings.push_back(fmt::format("node '{}': its transform shears, which glTF has no nodes for; "
                                                      "other programs may refuse its matrix",
                                                      json.value("name", "")));
        }
        json.erase("children");
        if (!node.children.empty()) {
            Json& children = gltfList(json, "children");
            for (const uint32_t child : node.children) children.push_back(mNodes[child]);
        }
        writeMesh(node, json);
        if (node.weights && json.contains("mesh")) json["weights"] = *node.weights;
        Json* extensions = memberOf(json, "extensions");
        if (extensions && node.losesLights)
            extensions->erase("KHR_lights_punctual"), extensions->erase("EXT_lights_ies");
        if (node.light != kNone) json["extensions"]["KHR_lights_punctual"] = { { "light", mLights[node.light] } };
        if (node.isHidden) {
            json["extensions"]["KHR_node_visibility"] = { { "visible", false } };
            use("KHR_node_visibility");
        }
        eraseEmpty(json, "extensions");
    }

    void writeMesh(GltfMergeNode const& node, Json& json) {
        if (node.losesMesh || node.mesh != kNone) {
            for (const char* const key : { "mesh", "skin", "weights" })
                if (node.losesMesh || key == std::string_view("mesh")) json.erase(key);
            if (Json* const extensions = memberOf(json, "extensions"); extensions && node.losesMesh)
                extensions->erase("EXT_mesh_gpu_instancing");
        }
        const auto copied = [&](uint32_t of, const char* key) {
            Json const& from = mSources[mMerge.copies[node.copy]].json["nodes"][of];
            Json const* const value = memberOf(from, key);
            if (value) json[key] = *value;
            return value != nullptr;
        };
        if (node.meshOf != kNone && copied(node.meshOf, "mesh"))
            json["mesh"] = json["mesh"].get<size_t>() + mSources[mMerge.copies[node.copy]].offsets.meshes;
        if (node.skinOf != kNone) {
            if (copied(node.skinOf, "skin")) json["skin"] = json["skin"].get<size_t>() + mCopies[node.copy].skins;
            copied(node.skinOf, "weights");
        }
        if (node.mesh != kNone) json["mesh"] = mMeshes[node.mesh];
        if (node.skin != kNone) json["skin"] = mSkins[node.skin];
    }

    void addScene() {
        for (GltfMergeCamera const& camera : mMerge.cameras) addCamera(camera);
        Json scene = Json::object();
        Json* const first = mSources.empty() ? nullptr : defaultSceneOf(mSources.front().json);
        if (Json const* const name = first ? memberOf(std::as_const(*first), "name") : nullptr) scene["name"] = *name;
        Json roots = Json::array();
        for (const uint32_t root : mMerge.roots) roots.push_back(mNodes[root]);
        for (const size_t camera : mCameraNodes) roots.push_back(camera);
        if (!roots.empty()) scene["nodes"] = std::move(roots);
        if (first && mMerge.keepsEnvironment)
            if (Json const* const light = extensionOf(*first, "EXT_lights_image_based"))
                scene["extensions"]["EXT_lights_image_based"] = *light; // of the first source: its index stays
        if (Json const* const extras = first ? memberOf(std::as_const(*first), "extras") : nullptr)
            scene["extras"] = *extras;
        setExtras(scene, mMerge.extras);
        list("scenes").push_back(std::move(scene));
    }

    void addCamera(GltfMergeCamera const& camera) {
        CameraData const& data = camera.data;
        Json json{ { "type", data.isParallel ? "orthographic" : "perspective" } };
        if (!data.name.empty()) json["name"] = data.name;
        const double aspect = data.aspect > 0 ? static_cast<double>(data.aspect) : 1.0;
        if (data.isParallel) {
            json["orthographic"] = { { "xmag", static_cast<double>(data.halfHeightMeters) * aspect },
                                     { "ymag", data.halfHeightMeters },
                                     { "znear", data.nearMeters },
                                     { "zfar", data.farMeters } };
        } else {
            json["perspective"] = { { "yfov", data.verticalFovRadians }, { "znear", data.nearMeters } };
            if (data.aspect > 0) json["perspective"]["aspectRatio"] = data.aspect;
        }
        Json node{ { "camera", list("cameras").size() } };
        if (!data.name.empty()) node["name"] = data.name;
        setTransform(node, camera.worldFromCamera, false);
        list("cameras").push_back(std::move(json));
        mCameraNodes.push_back(list("nodes").size());
        list("nodes").push_back(std::move(node));
    }

    /// Those of the sources, which their authors may require.
    void addCopyrights() {
        std::vector<std::string> all;
        const auto add = [&](std::string const& text) {
            if (!text.empty() && std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
        };
        add(mMerge.copyright);
        for (GltfMergedSource const& source : mSources) {
            Json const* const asset = memberOf(source.json, "asset");
            Json const* const text = asset ? memberOf(*asset, "copyright") : nullptr;
            if (text && text->is_string()) add(text->get<std::string>());
        }
        std::string joined;
        for (std::string const& text : all) joined += (joined.empty() ? "" : "; ") + text;
        if (!joined.empty()) mRoot["asset"]["copyright"] = joined;
    }

    Result<GltfMerged> finish() {
        GltfMerged merged;
        merged.buffer = std::move(mState.buffer);
        Json& buffers = list("buffers");
        if (merged.buffer.empty() && !buffers.empty()) merged.buffer.resize(4);
        if (!merged.buffer.empty()) {
            Json first{ { "byteLength", merged.buffer.size() } };
            if (!mBufferUri.empty()) first["uri"] = mBufferUri;
            if (buffers.empty()) buffers.push_back(Json::object());
            buffers[0] = std::move(first);
        }
        if (Json* const lights = extensionOf(mRoot, "EXT_lights_image_based"); lights && lights->empty())
            mRoot["extensions"].erase("EXT_lights_image_based");
        for (const char* const key : kLists) eraseEmpty(mRoot, key);
        eraseEmpty(mRoot, "extensions");
        // replace instead of throwing: names may contain bytes that are not UTF-8
        merged.json = mRoot.dump(-1, ' ', false, Json::error_handler_t::replace);
        merged.warnings = std::move(mState.warnings);
        return merged;
    }

    GltfMerge const& mMerge;
    std::string mBufferUri;
    GltfMergeState mState{ Json::object(), {}, {} };
    Json& mRoot = mState.root;
    std::vector<GltfMergedSource> mSources;
    std::vector<GltfCopyOffsets> mCopies;
    std::set<size_t> mAnimated; // nodes
    size_t mFirstImage = 0;
    std::vector<size_t> mMaterials, mMeshes, mLights, mSkins, mNodes, mCameraNodes; // in the file, of those in mMerge
};

void appendWord(std::vector<std::byte>& file, uint32_t word) {
    std::byte bytes[4];
    std::memcpy(bytes, &word, 4);
    file.insert(file.end(), bytes, bytes + 4);
}

} // namespace

Result<GltfMerged> mergeGltf(GltfMerge const& merge, std::string_view bufferUri) {
    // What the scene does not show of a file may be anything.
    try {
        return Merger(merge, bufferUri).run();
    } catch (Json::exception const& exception) {
        return fail(ErrorCode::Corrupt, "a model's file has an element of another kind than glTF says: {}",
                    exception.what());
    }
}

Result<std::vector<std::byte>> glbOf(GltfMerged const& merged) {
    const auto padded = [](size_t size) { return (size + 3) & ~size_t{ 3 }; };
    const size_t text = padded(merged.json.size()), binary = padded(merged.buffer.size());
    const size_t total = 12 + 8 + text + (binary > 0 ? 8 + binary : 0);
    if (total > kNone)
        return fail(ErrorCode::Unsupported, "a .glb of {} bytes is beyond 4 GiB; give the file the ending .gltf",
                    total);
    std::vector<std::byte> file;
    file.reserve(total);
    for (const uint32_t word :
         { 0x46546C67u, 2u, static_cast<uint32_t>(total), static_cast<uint32_t>(text), 0x4E4F534Au })
        appendWord(file, word);
    const auto json = std::as_bytes(std::span(merged.json));
    file.insert(file.end(), json.begin(), json.end());
    file.resize(20 + text, std::byte{ ' ' });
    if (binary == 0) return file;
    appendWord(file, static_cast<uint32_t>(binary));
    appendWord(file, 0x004E4942u);
    file.insert(file.end(), merged.buffer.begin(), merged.buffer.end());
    file.resize(total);
    return file;
}

} // namespace filament_core::assets
