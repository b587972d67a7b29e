// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfParse.h"

#include "base/NumberText.h"
#include "filament_core/assets/files/JsonTree.h"
#include "filament_core/assets/gltf/GltfPointer.h"
#include "filament_core/assets/gltf/GltfUvSets.h"

#include <cmath>
#include <cstring>

namespace filament_core::assets {
namespace {

constexpr uint64_t kMaxElements = uint64_t{ 1 } << 28;
constexpr uint64_t kMaxStride = 4096;

/// The arrays of the file by name, so that an index can be checked before the array is read.
struct Counts {
    explicit Counts(JsonNode const& root)
            : buffers(root["buffers"].elementCount()), views(root["bufferViews"].elementCount()),
              accessors(root["accessors"].elementCount()), meshes(root["meshes"].elementCount()),
              nodes(root["nodes"].elementCount()), skins(root["skins"].elementCount()),
              materials(root["materials"].elementCount()), textures(root["textures"].elementCount()),
              samplers(root["samplers"].elementCount()), images(root["images"].elementCount()),
              cameras(root["cameras"].elementCount()),
              lights(root.extension("KHR_lights_punctual")["lights"].elementCount()),
              profiles(root.extension("EXT_lights_ies")["lights"].elementCount()),
              variants(root.extension("KHR_materials_variants")["variants"].elementCount()) {}

    size_t buffers, views, accessors, meshes, nodes, skins, materials, textures, samplers, images, cameras, lights,
            profiles, variants;
};

template <class Enum, size_t N>
std::optional<Enum> knownEnum(std::string_view text, std::array<const char*, N> const& names) {
    for (size_t i = 0; i < N; ++i) {
        if (text == names[i]) return static_cast<Enum>(i);
    }
    return std::nullopt;
}

template <class Enum, size_t N>
Enum enumFromText(JsonNode const& node, std::array<const char*, N> const& names, Enum fallback) {
    if (!node.exists()) return fallback;
    const std::string text = node.text();
    if (const std::optional<Enum> known = knownEnum<Enum>(text, names)) return *known;
    node.diagnostics().refuse(ErrorCode::Corrupt, "{}: '{}' is not a value that the format knows", node.path(), text);
    return fallback;
}

ComponentType componentTypeFromGl(JsonNode const& node) {
    switch (node.requiredInteger()) {
    case 5120:
        return ComponentType::Byte;
    case 5121:
        return ComponentType::UByte;
    case 5122:
        return ComponentType::Short;
    case 5123:
        return ComponentType::UShort;
    case 5125:
        return ComponentType::UInt;
    case 5126:
        return ComponentType::Float;
    default:
        node.diagnostics().refuse(ErrorCode::Corrupt, "{}: must be one of 5120..5123, 5125, 5126", node.path());
        return ComponentType::Float;
    }
}

uint8_t componentCount(JsonNode const& node) {
    constexpr std::array<std::pair<const char*, uint8_t>, 7> kTypes{
        { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 }, { "VEC4", 4 }, { "MAT2", 4 }, { "MAT3", 9 }, { "MAT4", 16 } }
    };
    const std::string text = node.text();
    for (auto const& [name, count] : kTypes) {
        if (text == name) return count;
    }
    node.diagnostics().refuse(ErrorCode::Corrupt, "{}: '{}' must be SCALAR, VEC2..VEC4 or MAT2..MAT4", node.path(),
                              text);
    return 1;
}

GltfBuffer parseBuffer(JsonNode const& node) {
    const bool isFallback = node.extension("EXT_meshopt_compression")["fallback"].boolean(false) ||
                            node.extension("KHR_meshopt_compression")["fallback"].boolean(false);
    return { .uri = node["uri"].text(), .byteLength = node["byteLength"].requiredInteger(), .isFallback = isFallback };
}

std::optional<MeshoptSource> parseMeshopt(JsonNode const& view, Counts const& counts) {
    const JsonNode khr = view.extension("KHR_meshopt_compression"), ext = view.extension("EXT_meshopt_compression");
    if (khr.exists() && ext.exists()) {
        view.diagnostics().warn("{}: EXT_meshopt_compression is ignored beside KHR_meshopt_compression", view.path());
    }
    JsonNode const& node = khr.exists() ? khr : ext;
    if (!node.exists()) return std::nullopt;
    return MeshoptSource{
        .buffer = node["buffer"].requiredIndex(counts.buffers, "buffers"),
        .byteOffset = node["byteOffset"].integer(0),
        .byteLength = node["byteLength"].requiredInteger(),
        .byteStride = node["byteStride"].requiredInteger(),
        .count = node["count"].requiredInteger(),
        .mode = enumFromText(node["mode"], std::array{ "ATTRIBUTES", "TRIANGLES", "INDICES" }, MeshoptMode::Attributes),
        .filter = enumFromText(node["filter"], std::array{ "NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR" },
                               MeshoptFilter::None),
        .isKhr = khr.exists(),
    };
}

GltfBufferView parseView(JsonNode const& node, Counts const& counts) {
    const uint64_t stride = node["byteStride"].integer(0);
    if (stride > kMaxStride) {
        node.diagnostics().refuse(ErrorCode::Corrupt, "{}.byteStride: {} is beyond {}", node.path(), stride,
                                  kMaxStride);
    }
    return { .buffer = node["buffer"].requiredIndex(counts.buffers, "buffers"),
             .byteOffset = node["byteOffset"].integer(0),
             .byteLength = node["byteLength"].requiredInteger(),
             .byteStride = static_cast<uint32_t>(stride),
             .meshopt = parseMeshopt(node, counts) };
}

std::optional<GltfSparse> parseSparse(JsonNode const& node, Counts const& counts) {
    if (!node.exists()) return std::nullopt;
    const JsonNode indices = node["indices"], values = node["values"];
    return GltfSparse{ .count = node["count"].requiredInteger(),
                       .indicesView = indices["bufferView"].requiredIndex(counts.views, "bufferViews"),
                       .valuesView = values["bufferView"].requiredIndex(counts.views, "bufferViews"),
                       .indicesOffset = indices["byteOffset"].integer(0),
                       .valuesOffset = values["byteOffset"].integer(0),
                       .indicesType = componentTypeFromGl(indices["componentType"]) };
}

GltfAccessor parseAccessor(JsonNode const& node, Counts const& counts) {
    const GltfAccessor accessor{ .view = node["bufferView"].index(counts.views, "bufferViews"),
                                 .byteOffset = node["byteOffset"].integer(0),
                                 .count = node["count"].requiredInteger(),
                                 .component = componentTypeFromGl(node["componentType"]),
                                 .components = componentCount(node["type"]),
                                 .normalized = node["normalized"].boolean(false),
                                 .sparse = parseSparse(node["sparse"], counts) };
    if (accessor.count > kMaxElements) {
        node.diagnostics().refuse(ErrorCode::Unsupported, "{}.count: {} elements are beyond the limit of {}",
                                  node.path(), accessor.count, kMaxElements);
    }
    return accessor;
}

/// Sets beyond the first two may be broken: most of them are not used.
std::vector<uint32_t> parseUvSets(JsonNode const& node, size_t count, const char* what) {
    constexpr std::string_view kPrefix = "TEXCOORD_";
    constexpr uint32_t kMaxSets = 256;
    std::vector<uint32_t> sets;
    node.forEachMember([&](std::string const& name, JsonNode const& value) {
        if (!name.starts_with(kPrefix)) return;
        const uint32_t set = numberOf<uint32_t>(std::string_view(name).substr(kPrefix.size())).value_or(kMaxSets);
        if (set >= kMaxSets) return;
        Diagnostics found;
        if (sets.size() <= set) sets.resize(set + 1, kNone);
        sets[set] = value.reportingTo(found).index(count, what);
        if (set < GltfAttributes::kFirstUvSets)
            node.diagnostics().merge(std::move(found));
        else if (!found.ok())
            node.diagnostics().warn("{}; the set is left out", found.error().message);
    });
    return sets;
}

GltfAttributes parseAttributes(JsonNode const& node, size_t count, const char* what) {
    GltfAttributes attributes;
    const auto read = [&](const char* name) { return node[name].index(count, what); };
    attributes.position = read("POSITION");
    attributes.normal = read("NORMAL");
    attributes.tangent = read("TANGENT");
    attributes.color = read("COLOR_0");
    attributes.frame = read("_FILAMENT_TANGENTS");
    attributes.uvSets = parseUvSets(node, count, what);
    attributes.joints = { read("JOINTS_0"), read("JOINTS_1") };
    attributes.weights = { read("WEIGHTS_0"), read("WEIGHTS_1") };
    return attributes;
}

GltfPrimitive parsePrimitive(JsonNode const& node, Counts const& counts) {
    GltfPrimitive primitive;
    primitive.attributes = parseAttributes(node["attributes"], counts.accessors, "accessors");
    primitive.indices = node["indices"].index(counts.accessors, "accessors");
    primitive.material = node["material"].index(counts.materials, "materials");
    primitive.variants = parseVariantMaterials(node, counts.materials, counts.variants);
    const uint64_t mode = node["mode"].integer(4);
    if (mode > 6) node.diagnostics().refuse(ErrorCode::Corrupt, "{}.mode: {} is not one of 0..6", node.path(), mode);
    primitive.mode = static_cast<GltfMode>(mode % 7);
    for (JsonNode const& target : node["targets"].elements()) {
        const GltfAttributes deltas = parseAttributes(target, counts.accessors, "accessors");
        primitive.targets.push_back({ deltas.position, deltas.normal, deltas.tangent });
    }
    if (const JsonNode draco = node.extension("KHR_draco_mesh_compression"); draco.exists()) {
        // any unsigned number may be an id; decoding shows whether the stream contains it
        primitive.draco = GltfDraco{ draco["bufferView"].requiredIndex(counts.views, "bufferViews"),
                                     parseAttributes(draco["attributes"], kNone, "ids") };
    }
    primitive.splats = parseGltfSplats(node, primitive.mode, counts.accessors);
    return primitive;
}

GltfMesh parseMesh(JsonNode const& node, Counts const& counts) {
    GltfMesh mesh{ .name = node["name"].label(),
                   .primitives = {},
                   .weights = node["weights"].numberList(),
                   .targetNames = node["extras"].textsOf("targetNames") };
    for (JsonNode const& primitive : node["primitives"].elements()) {
        mesh.primitives.push_back(parsePrimitive(primitive, counts));
    }
    return mesh;
}

/// Section 3.5.3: a matrix, or translation * rotation * scale.
void parseTransform(JsonNode const& node, GltfNode& parsed) {
    std::array<double, 16> m{};
    if (node["matrix"].numbers(m)) {
        double4x4 matrix;
        std::memcpy(&matrix[0][0], m.data(), sizeof m);
        const double4 lastRow(m[3], m[7], m[11], m[15]);
        if (glm::length(lastRow - double4(0, 0, 0, 1)) > 1e-6) {
            node.diagnostics().warn("{}.matrix: its last row is not 0 0 0 1 and was ignored", node.path());
        }
        for (int column = 0; column < 4; ++column) matrix[column].w = column == 3 ? 1 : 0;
        parsed.parentFromNode = matrix;
        parsed.pose = poseFrom(matrix);
        parsed.hasMatrix = true;
        return;
    }
    std::array<double, 3> t{ 0, 0, 0 }, s{ 1, 1, 1 };
    std::array<double, 4> r{ 0, 0, 0, 1 };
    node["translation"].numbers(t);
    node["rotation"].numbers(r);
    node["scale"].numbers(s);
    const double length2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3];
    if (!(length2 > 1e-12)) {
        node.diagnostics().warn("{}.rotation: has no length and was ignored", node.path());
        r = { 0, 0, 0, 1 };
    } else if (std::abs(length2 - 1) > 1e-3) {
        node.diagnostics().warn("{}.rotation: its length is not 1; it was normalised", node.path());
    }
    parsed.pose = { { t[0], t[1], t[2] }, { r[0], r[1], r[2], r[3] }, { s[0], s[1], s[2] } };
    parsed.parentFromNode = matrixFrom(parsed.pose);
}

GltfNode parseNode(JsonNode const& node, Counts const& counts) {
    GltfNode parsed{ .name = node["name"].label(),
                     .children = {},
                     .mesh = node["mesh"].index(counts.meshes, "meshes"),
                     .skin = node["skin"].index(counts.skins, "skins"),
                     .light = node.extension("KHR_lights_punctual")["light"].index(counts.lights, "lights"),
                     .camera = node["camera"].index(counts.cameras, "cameras"),
                     .isVisible = node.extension("KHR_node_visibility")["visible"].boolean(true),
                     .isSelectable = node.extension("KHR_node_selectability")["selectable"].boolean(true),
                     .isHoverable = node.extension("KHR_node_hoverability")["hoverable"].boolean(true),
                     .levels = parseGltfLevels(node, counts.nodes),
                     .coverage = parseGltfCoverage(node),
                     .weights = node["weights"].numberList(),
                     .instancing = {},
                     .profiledLight = parseGltfProfiledLight(node.extension("EXT_lights_ies"), counts.profiles) };
    parseTransform(node, parsed);
    for (JsonNode const& child : node["children"].elements()) {
        parsed.children.push_back(child.requiredIndex(counts.nodes, "nodes"));
    }
    if (const JsonNode instancing = node.extension("EXT_mesh_gpu_instancing"); instancing.exists()) {
        const JsonNode attributes = instancing["attributes"];
        parsed.instancing = GltfInstancing{ attributes["TRANSLATION"].index(counts.accessors, "accessors"),
                                            attributes["ROTATION"].index(counts.accessors, "accessors"),
                                            attributes["SCALE"].index(counts.accessors, "accessors") };
    }
    return parsed;
}

GltfSkin parseSkin(JsonNode const& node, Counts const& counts) {
    GltfSkin skin{ node["name"].label(), node["inverseBindMatrices"].index(counts.accessors, "accessors"), {} };
    for (JsonNode const& joint : node["joints"].elements()) {
        skin.joints.push_back(joint.requiredIndex(counts.nodes, "nodes"));
    }
    return skin;
}

/// KHR_animation_pointer: what the pointer names, or nothing, with a warning.
GltfAnimationChannel parsePointer(JsonNode const& target, uint32_t sampler, GltfPointers& pointers) {
    const std::string pointer = target.extension("KHR_animation_pointer")["pointer"].text();
    std::optional<GltfAnimationChannel> channel = pointers.resolve(pointer);
    if (!channel) {
        target.diagnostics().warn("{}: '{}' names nothing in this file that an animation can change; the channel is "
                                  "left out",
                                  target.path(), pointer.substr(0, 160));
        channel.emplace();
    }
    channel->sampler = sampler;
    return *channel;
}

GltfAnimationChannel parseChannel(JsonNode const& channel, size_t samplers, Counts const& counts,
                                  GltfPointers& pointers) {
    const JsonNode target = channel["target"];
    GltfAnimationChannel parsed{ .sampler = channel["sampler"].requiredIndex(samplers, "samplers"),
                                 .node = target["node"].index(counts.nodes, "nodes") };
    if (target.extension("KHR_animation_pointer").exists()) return parsePointer(target, parsed.sampler, pointers);
    if (parsed.node == kNone) return parsed;
    const std::string path = target["path"].text();
    const auto known = knownEnum<AnimationPath>(path, std::array{ "translation", "rotation", "scale", "weights" });
    if (known) {
        parsed.path = *known;
        return parsed;
    }
    target.diagnostics().warn("{}.path: '{}' is not a value that the format knows; the channel is left out",
                              target.path(), path);
    return { .sampler = parsed.sampler };
}

Interpolation parseInterpolation(JsonNode const& node) {
    if (!node.exists()) return Interpolation::Linear;
    const std::string text = node.text();
    const auto known = knownEnum<Interpolation>(text, std::array{ "STEP", "LINEAR", "CUBICSPLINE" });
    if (!known)
        node.diagnostics().warn("{}: '{}' is not a value that the format knows; LINEAR is used", node.path(), text);
    return known.value_or(Interpolation::Linear);
}

GltfAnimation parseAnimation(JsonNode const& node, Counts const& counts, GltfPointers& pointers) {
    GltfAnimation animation{ .name = node["name"].label(), .samplers = {}, .channels = {} };
    for (JsonNode const& sampler : node["samplers"].elements()) {
        animation.samplers.push_back({ sampler["input"].requiredIndex(counts.accessors, "accessors"),
                                       sampler["output"].requiredIndex(counts.accessors, "accessors"),
                                       parseInterpolation(sampler["interpolation"]) });
    }
    for (JsonNode const& channel : node["channels"].elements()) {
        animation.channels.push_back(parseChannel(channel, animation.samplers.size(), counts, pointers));
    }
    return animation;
}

GltfImage parseImage(JsonNode const& node, Counts const& counts) {
    GltfImage image{ node["uri"].text(), node["bufferView"].index(counts.views, "bufferViews") };
    if (image.uri.empty() == (image.view == kNone)) {
        node.diagnostics().refuse(ErrorCode::Corrupt, "{}: needs a uri or a bufferView, and not both", node.path());
    }
    return image;
}

/// The image of an extension replaces the core one, which is a fallback for loaders without the extension.
GltfTexture parseTexture(JsonNode const& node, Counts const& counts) {
    GltfTexture texture{ node["sampler"].index(counts.samplers, "samplers"),
                         node["source"].index(counts.images, "images") };
    // the last one comes first
    for (const char* extension : { "MSFT_texture_dds", "EXT_texture_avif", "EXT_texture_webp", "EXT_texture_astc",
                                   "KHR_texture_basisu", "FILAMENT_lightmap" }) {
        const uint32_t image = node.extension(extension)["source"].index(counts.images, "images");
        if (image != kNone) texture.image = image;
    }
    texture.openness = node.extension("FILAMENT_lightmap")["openness"].index(counts.images, "images");
    return texture;
}

/// A node has at most one parent, and nodes in a cycle cannot be reached from a root (section 3.5.2). Links of nodes
/// that the scene does not reach give way, with a warning.
class ForestCheck {
public:
    ForestCheck(GltfDocument& document, Diagnostics& diagnostics)
            : mDocument(document), mDiagnostics(diagnostics), mParents(document.nodes.size(), kNone) {}

    void check() {
        for (const bool isReached : { true, false }) {
            for (uint32_t i = 0; i < mDocument.nodes.size() && mDiagnostics.ok(); ++i) {
                if (isUsed(i) == isReached) claimChildren(i);
            }
        }
        if (mDiagnostics.ok()) checkCycles();
    }

private:
    bool isUsed(uint32_t node) const { return mDocument.use.has(GltfArray::Nodes, node); }

    void claimChildren(uint32_t index) {
        std::erase_if(mDocument.nodes[index].children, [&](uint32_t child) {
            if (mParents[child] == kNone && child != index) {
                mParents[child] = index;
                return false;
            }
            Diagnostics found;
            found.refuse(ErrorCode::Corrupt, "nodes[{}].children: nodes[{}] has another parent already", index, child);
            settle(std::move(found), isUsed(index), mDiagnostics);
            return true;
        });
    }

    /// Nodes that cannot be reached from a parentless node are part of a cycle.
    void checkCycles() {
        std::vector<bool> isBelowRoot(mDocument.nodes.size(), false);
        std::vector<uint32_t> open;
        for (uint32_t i = 0; i < mParents.size(); ++i) {
            if (mParents[i] == kNone) open.push_back(i);
        }
        while (!open.empty()) {
            const uint32_t node = open.back();
            open.pop_back();
            isBelowRoot[node] = true;
            std::vector<uint32_t> const& children = mDocument.nodes[node].children;
            open.insert(open.end(), children.begin(), children.end());
        }
        for (uint32_t i = 0; i < mParents.size(); ++i) {
            if (isBelowRoot[i]) continue;
            Diagnostics found;
            found.refuse(ErrorCode::Corrupt, "nodes: the children links form a cycle");
            settle(std::move(found), isUsed(i), mDiagnostics);
            mDocument.nodes[i].children.clear();
        }
    }

    GltfDocument& mDocument;
    Diagnostics& mDiagnostics;
    std::vector<uint32_t> mParents;
};

/// The default scene: the first unless the file says otherwise; a node that does not exist if the file has none.
JsonNode findDefaultScene(JsonNode const& root) {
    const std::vector<JsonNode> scenes = root["scenes"].elements();
    const uint32_t scene = root["scene"].index(scenes.size(), "scenes");
    if (scenes.empty()) return JsonNode(nullptr, "scenes[0]", root.diagnostics());
    return scenes[scene == kNone ? 0 : scene];
}

std::vector<bool> findChildren(std::vector<GltfNode> const& nodes) {
    std::vector<bool> isChild(nodes.size(), false);
    for (GltfNode const& node : nodes) {
        for (const uint32_t child : node.children) {
            if (child != kNone) isChild[child] = true;
        }
    }
    return isChild;
}

/// The roots of the default scene; a file without scenes shows all parentless nodes.
std::vector<uint32_t> parseRoots(JsonNode const& scene, std::vector<GltfNode> const& nodes) {
    std::vector<uint32_t> roots;
    for (JsonNode const& node : scene["nodes"].elements()) roots.push_back(node.requiredIndex(nodes.size(), "nodes"));
    if (scene.exists()) return roots;
    const std::vector<bool> isChild = findChildren(nodes);
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        if (!isChild[i]) roots.push_back(i);
    }
    return roots;
}

void checkRoots(GltfDocument const& document, Diagnostics& diagnostics) {
    const std::vector<bool> isChild = findChildren(document.nodes);
    std::vector<bool> isListed(document.nodes.size(), false);
    for (const uint32_t i : document.roots) {
        if (isChild[i] || isListed[i])
            diagnostics.refuse(ErrorCode::Corrupt, "scenes: nodes[{}] is not a root, or is listed twice", i);
        isListed[i] = true;
    }
}

/// Section 3.2: later minor versions may be read as 2.0 unless minVersion forbids it.
void checkVersion(JsonNode const& root) {
    const std::string version = root["asset"]["version"].text(), least = root["asset"]["minVersion"].text();
    if (!version.starts_with("2."))
        root.diagnostics().refuse(ErrorCode::Unsupported, "asset.version: '{}', this loader reads glTF 2.x", version);
    else if (!least.empty() && least != "2.0")
        root.diagnostics().refuse(ErrorCode::Unsupported, "asset.minVersion: '{}', this loader reads glTF 2.0", least);
}

/// Section 3.7.2.2: as many weights as morph targets; missing ones are 0.
void checkWeights(std::vector<GltfMesh> const& meshes, std::vector<GltfNode> const& nodes, Diagnostics& diagnostics) {
    const auto check = [&](const char* array, uint32_t index, std::vector<float> const& weights, GltfMesh const& mesh) {
        const size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
        if (!weights.empty() && weights.size() != targets)
            diagnostics.warn("{}[{}].weights: {} weights for {} morph targets", array, index, weights.size(), targets);
    };
    for (uint32_t i = 0; i < meshes.size(); ++i) check("meshes", i, meshes[i].weights, meshes[i]);
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].mesh != kNone) check("nodes", i, nodes[i].weights, meshes[nodes[i].mesh]);
    }
}

/// Parses all elements of the file, and collects those that are broken: their use decides what that means.
class ElementParser {
public:
    ElementParser(JsonNode const& root, GltfDocument& document, Diagnostics& diagnostics)
            : mRoot(root.reportingTo(mArrays)), mDocument(document), mDiagnostics(diagnostics), mCounts(mRoot) {}

    std::vector<GltfFault> parseFile() {
        parseGeometry();
        parseMaterials();
        parseSurroundings();
        if (!mArrays.ok()) mDiagnostics.warn("{}; it counts as empty", mArrays.error().message);
        dropUnknownLights();
        return std::move(mFaults);
    }

private:
    template <class T, class Parse>
    void parseAll(GltfArray kind, JsonNode const& array, std::vector<T>& elements, Parse const& parse) {
        for (JsonNode const& node : array.elements()) {
            Diagnostics own;
            elements.push_back(parse(node.reportingTo(own)));
            if (!own.ok())
                mFaults.push_back({ kind, static_cast<uint32_t>(elements.size() - 1), own.error() });
            else
                mDiagnostics.merge(std::move(own));
        }
    }

    auto with(auto parse) const {
        return [this, parse](JsonNode const& node) { return parse(node, mCounts); };
    }

    void parseGeometry() {
        parseAll(GltfArray::Buffers, mRoot["buffers"], mDocument.buffers, parseBuffer);
        parseAll(GltfArray::Views, mRoot["bufferViews"], mDocument.views, with(parseView));
        parseAll(GltfArray::Accessors, mRoot["accessors"], mDocument.accessors, with(parseAccessor));
        parseAll(GltfArray::Meshes, mRoot["meshes"], mDocument.meshes, [&](JsonNode const& node) {
            GltfMesh mesh = parseMesh(node, mCounts);
            mergeRestartGroups(node.extension("EXT_mesh_primitive_restart"), mDocument.accessors, mesh);
            return mesh;
        });
        parseAll(GltfArray::Nodes, mRoot["nodes"], mDocument.nodes, with(parseNode));
        parseAll(GltfArray::Skins, mRoot["skins"], mDocument.skins, with(parseSkin));
    }

    void parseMaterials() {
        parseAll(GltfArray::Images, mRoot["images"], mDocument.images, with(parseImage));
        parseAll(GltfArray::Samplers, mRoot["samplers"], mDocument.samplers, parseGltfSampler);
        parseAll(GltfArray::Materials, mRoot["materials"], mDocument.materials,
                 [&](JsonNode const& node) { return parseGltfMaterial(node, mCounts.textures); });
        parseAll(GltfArray::Textures, mRoot["textures"], mDocument.textures, with(parseTexture));
        parseAll(GltfArray::Variants, mRoot.extension("KHR_materials_variants")["variants"], mDocument.variants,
                 [](JsonNode const& node) { return node["name"].label(); });
    }

    void parseSurroundings() {
        parseAll(GltfArray::Lights, mRoot.extension("KHR_lights_punctual")["lights"], mDocument.lights,
                 [&](JsonNode const& node) {
                     const std::optional<LightData> light = parseGltfLight(node);
                     mHasType.push_back(light || !node.diagnostics().ok()); // a broken one is a fault
                     return light.value_or(LightData{});
                 });
        parseAll(GltfArray::Cameras, mRoot["cameras"], mDocument.cameras, parseGltfCamera);
        parseAll(GltfArray::Profiles, mRoot.extension("EXT_lights_ies")["lights"], mDocument.profiles,
                 [&](JsonNode const& node) { return parseGltfProfile(node, mCounts.views); });
        parseAll(GltfArray::ImageBasedLights, mRoot.extension("EXT_lights_image_based")["lights"],
                 mDocument.imageBasedLights,
                 [&](JsonNode const& node) { return parseGltfImageBasedLight(node, mCounts.images); });
        Diagnostics ofPointers; // what is wrong with the objects on a path is their own fault
        GltfPointers pointers(mRoot.reportingTo(ofPointers));
        parseAll(GltfArray::Animations, mRoot["animations"], mDocument.animations,
                 [&](JsonNode const& node) { return parseAnimation(node, mCounts, pointers); });
    }

    void dropUnknownLights() {
        for (GltfNode& node : mDocument.nodes) {
            if (node.light != kNone && !mHasType[node.light]) node.light = kNone;
        }
    }

    Diagnostics mArrays; ///< what is wrong with whole arrays
    JsonNode mRoot;
    GltfDocument& mDocument;
    Diagnostics& mDiagnostics;
    Counts mCounts;
    std::vector<GltfFault> mFaults;
    std::vector<bool> mHasType; ///< by light
};

} // namespace

GltfDocument parseGltf(std::span<const std::byte> json, Diagnostics& diagnostics) {
    GltfDocument document;
    const JsonTree tree(json, diagnostics);
    if (!diagnostics.ok()) return document;
    const JsonNode root = tree.root(diagnostics);
    checkVersion(root);
    checkExtensions(root, diagnostics);
    const std::vector<GltfFault> faults = ElementParser(root, document, diagnostics).parseFile();
    const JsonNode scene = findDefaultScene(root);
    document.roots = parseRoots(scene, document.nodes);
    document.imageBasedLight = parseGltfSceneLight(scene, document.imageBasedLights.size());
    chooseUvSets(document);
    findUse(document);
    settleFaults(faults, document, diagnostics);
    warnAboutUvSets(document, diagnostics);
    if (diagnostics.ok()) ForestCheck(document, diagnostics).check();
    if (diagnostics.ok()) markCoarserLevels(document.nodes, diagnostics);
    if (diagnostics.ok()) checkWeights(document.meshes, document.nodes, diagnostics);
    if (diagnostics.ok()) checkRoots(document, diagnostics);
    return document;
}

} // namespace filament_core::assets
