// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfScene.h"

#include "filament_core/assets/geometry/TangentFrame.h"
#include "filament_core/assets/gltf/Accessor.h"
#include "filament_core/assets/gltf/GltfGeometry.h"
#include "shaders/interface/ShaderInterface.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace filament_core::assets {
namespace {

// A scene and a device have 2^20 handles of a type. A primitive takes two buffers; if its positions are scaled, it
// takes a node.
constexpr size_t kMaxNodes = 500'000, kMaxPlacements = 500'000;

bool isFinite(double4x4 const& matrix) {
    double sum = 0; // inf and NaN survive multiplication by 0
    for (int column = 0; column < 4; ++column) sum += glm::dot(matrix[column], double4(0.0));
    return std::isfinite(sum);
}

/// World transforms of all nodes, including joints outside the scene. The parser ensured that the links form a forest.
std::vector<double4x4> worldTransforms(GltfDocument const& document, Diagnostics& diagnostics) {
    std::vector<double4x4> worldFromNode(document.nodes.size(), double4x4(1.0));
    std::vector<bool> isChild(document.nodes.size(), false);
    for (GltfNode const& node : document.nodes) {
        for (const uint32_t child : node.children) isChild[child] = true;
    }
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < document.nodes.size(); ++i) {
        worldFromNode[i] = document.nodes[i].parentFromNode;
        if (!isChild[i]) open.push_back(i);
    }
    while (!open.empty()) {
        const uint32_t parent = open.back();
        open.pop_back();
        if (!isFinite(worldFromNode[parent])) {
            Diagnostics found;
            found.refuse(ErrorCode::Corrupt, "nodes[{}]: its transform is not finite", parent);
            settle(std::move(found), document.use.has(GltfArray::Nodes, parent), diagnostics);
        }
        for (const uint32_t child : document.nodes[parent].children) {
            worldFromNode[child] = worldFromNode[parent] * document.nodes[child].parentFromNode;
            open.push_back(child);
        }
    }
    return worldFromNode;
}

/// One per joint, or none. A matrix that is not finite becomes the inverse of its joint's place in the rest pose, which
/// leaves the vertices where the mesh has them.
std::vector<float4x4> readInverseBind(GltfDocument const& document, uint32_t skinIndex,
                                      std::vector<double4x4> const& worldFromNode, Diagnostics& diagnostics) {
    GltfSkin const& skin = document.skins[skinIndex];
    std::vector<float4x4> matrices = readVectors<float4x4>(document, skin.inverseBindMatrices, "inverseBindMatrices",
                                                           diagnostics, NonFinite::IsKept);
    size_t broken = 0;
    for (size_t i = 0; i < std::min(matrices.size(), skin.joints.size()); ++i) {
        if (isFinite(double4x4(matrices[i]))) continue;
        const float4x4 atRest(glm::inverse(worldFromNode[skin.joints[i]]));
        matrices[i] = isFinite(double4x4(atRest)) ? atRest : float4x4(1.0f);
        ++broken;
    }
    if (broken > 0)
        diagnostics.warn("skins[{}]: {} of {} inverse bind matrices are not finite; they became those of the rest pose",
                         skinIndex, broken, skin.joints.size());
    return matrices;
}

/// Section 3.7.3.3: the transform of the mesh's node is ignored; only the joints count.
std::vector<float4x4> jointTransforms(GltfDocument const& document, uint32_t skinIndex,
                                      std::vector<double4x4> const& worldFromNode, Diagnostics& diagnostics) {
    GltfSkin const& skin = document.skins[skinIndex];
    const std::vector<float4x4> inverseBind = readInverseBind(document, skinIndex, worldFromNode, diagnostics);
    if (skin.joints.empty() || (!inverseBind.empty() && inverseBind.size() < skin.joints.size())) {
        diagnostics.refuse(ErrorCode::Corrupt, "skins[{}]: {} joints and {} inverse bind matrices do not match",
                           skinIndex, skin.joints.size(), inverseBind.size());
        return {};
    }
    std::vector<float4x4> transforms;
    for (size_t i = 0; i < skin.joints.size(); ++i) {
        const double4x4 bind = inverseBind.empty() ? double4x4(1.0) : double4x4(inverseBind[i]);
        transforms.emplace_back(worldFromNode[skin.joints[i]] * bind);
    }
    return transforms;
}

/// Finds or adds the mesh requests of a scene.
class RequestList {
public:
    RequestList(GltfDocument const& document, std::vector<double4x4> const& worldFromNode, GltfDeformation deformation,
                GltfScene& scene, Diagnostics& diagnostics)
            : mDocument(document), mWorldFromNode(worldFromNode), mDeformation(deformation), mScene(scene),
              mDiagnostics(diagnostics) {}

    uint32_t requestFor(GltfNode const& node) {
        std::vector<float> const& weights = node.weights.empty() ? mDocument.meshes[node.mesh].weights : node.weights;
        const auto next = static_cast<uint32_t>(mScene.meshes.size());
        const auto [entry, isNew] = mKnown.try_emplace({ node.mesh, node.skin, weights }, next);
        if (!isNew) return entry->second;
        GltfMeshRequest request{ node.mesh, node.skin, weights, {} };
        request.keepsTargets = mDeformation == GltfDeformation::Kept;
        if (node.skin != kNone) {
            request.worldFromBind = jointTransforms(mDocument, node.skin, mWorldFromNode, mDiagnostics);
            request.keepsSkin = mDeformation == GltfDeformation::Kept;
        }
        mScene.meshes.push_back(std::move(request));
        return next;
    }

private:
    GltfDocument const& mDocument;
    std::vector<double4x4> const& mWorldFromNode;
    GltfDeformation mDeformation;
    GltfScene& mScene;
    Diagnostics& mDiagnostics;
    std::map<std::tuple<uint32_t, uint32_t, std::vector<float>>, uint32_t> mKnown;
};

double4x4 transformOf(float3 translation, float4 rotation, float3 scale) {
    const glm::dquat q(static_cast<double>(rotation.w), static_cast<double>(rotation.x),
                       static_cast<double>(rotation.y), static_cast<double>(rotation.z));
    const double length = std::sqrt(glm::dot(q, q));
    double4x4 matrix = length > 1e-6 ? double4x4(glm::mat3_cast(q * (1.0 / length))) : double4x4(1.0);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= static_cast<double>(scale[axis]);
    matrix[3] = double4(double3(translation), 1.0);
    return matrix;
}

/// EXT_mesh_gpu_instancing: the transforms of the instances. Those that are not finite are left out, with a warning.
std::vector<double4x4> instanceTransforms(GltfInstancing const& source, GltfDocument const& document, uint32_t index,
                                          Diagnostics& diagnostics) {
    constexpr NonFinite kKept = NonFinite::IsKept;
    const auto translations = readVectors<float3>(document, source.translation, "TRANSLATION", diagnostics, kKept);
    const auto rotations = readVectors<float4>(document, source.rotation, "ROTATION", diagnostics, kKept);
    const auto scales = readVectors<float3>(document, source.scale, "SCALE", diagnostics, kKept);
    const size_t count = std::max({ translations.size(), rotations.size(), scales.size() });
    const auto fits = [&](size_t size) { return size == 0 || size == count; };
    if (!fits(translations.size()) || !fits(rotations.size()) || !fits(scales.size()) || count > kMaxNodes) {
        diagnostics.refuse(ErrorCode::Corrupt,
                           "nodes[{}]: the instance attributes differ in length, or are more than {}", index,
                           kMaxNodes);
        return {};
    }
    std::vector<double4x4> transforms;
    for (size_t i = 0; i < count; ++i) {
        const float3 translation = translations.empty() ? float3(0.0f) : translations[i];
        const float4 rotation = rotations.empty() ? float4(0, 0, 0, 1) : rotations[i];
        const float3 scale = scales.empty() ? float3(1.0f) : scales[i];
        if (allFinite(translation) && allFinite(float3(rotation)) && std::isfinite(rotation.w) && allFinite(scale))
            transforms.push_back(transformOf(translation, rotation, scale));
    }
    if (transforms.size() < count)
        diagnostics.warn("nodes[{}]: {} of {} instances are not drawn: their transforms are not finite", index,
                         count - transforms.size(), count);
    return transforms;
}

/// Places the mesh at scene node `at`, which is node `index` of the file, or at new nodes.
void placeMesh(GltfDocument const& document, uint32_t index, uint32_t at, RequestList& requests, GltfScene& scene,
               Diagnostics& diagnostics) {
    GltfNode const& source = document.nodes[index];
    const uint32_t mesh = requests.requestFor(source);
    NodeData own{ .name = source.name,
                  .mesh = mesh,
                  .morphWeights = scene.meshes[mesh].weights,
                  .ofFile = index,
                  .carriesMesh = true };
    std::vector<uint32_t>& meshNodes = scene.meshNodes[index];
    if (source.skin != kNone) {
        // Section 3.7.3.3: the node's own transform does not move a skinned mesh, so it gets a node without parents,
        // which only its visibility ties to the original.
        if (scene.meshes[mesh].keepsSkin) own.skin = source.skin; // an index of the file; see collectSkins()
        own.visibleWith = at;
        meshNodes.push_back(static_cast<uint32_t>(scene.nodes.size()));
        scene.nodes.push_back(std::move(own));
        return;
    }
    if (!source.instancing) {
        scene.nodes[at].mesh = mesh;
        scene.nodes[at].morphWeights = std::move(own.morphWeights);
        meshNodes.push_back(at);
        return;
    }
    own.parent = at;
    for (double4x4 const& nodeFromInstance : instanceTransforms(*source.instancing, document, index, diagnostics)) {
        own.parentFromNode = nodeFromInstance;
        own.pose = poseFrom(nodeFromInstance);
        own.worldFromNode = scene.nodes[at].worldFromNode * nodeFromInstance;
        meshNodes.push_back(static_cast<uint32_t>(scene.nodes.size()));
        scene.nodes.push_back(own);
    }
}

/// Adds nodes of the file together with their descendants.
class NodeList {
public:
    NodeList(GltfDocument const& document, std::vector<double4x4> const& worldFromNode, GltfLevels levels,
             GltfScene& scene, Diagnostics& diagnostics)
            : mDocument(document), mWorldFromNode(worldFromNode), mLevels(levels), mScene(scene),
              mDiagnostics(diagnostics) {}

    /// `requests` is null for nodes that are not shown and only serve as joints.
    void add(std::vector<uint32_t> const& roots, RequestList* requests) {
        push(roots, kNone, true);
        while (!mOpen.empty() && mDiagnostics.ok()) {
            const auto [node, parent, isAboveVisible] = mOpen.back();
            mOpen.pop_back();
            GltfNode const& source = mDocument.nodes[node];
            const bool isLeftOut = source.isCoarserLevel && mLevels == GltfLevels::Finest;
            const bool isVisible = isAboveVisible && !isLeftOut && (source.isVisible || source.isVisibilityAnimated);
            const bool isShown = requests && isVisible;
            const auto added = static_cast<uint32_t>(mScene.nodes.size());
            mScene.nodeOf[node] = added;
            mScene.nodes.push_back({ .name = source.name,
                                     .parent = parent,
                                     .parentFromNode = source.parentFromNode,
                                     .worldFromNode = mWorldFromNode[node],
                                     .light = isShown ? source.light : kNone,
                                     .camera = requests ? source.camera : kNone,
                                     .morphWeights = {},
                                     .pose = source.pose,
                                     .isVisible = source.isVisible || !source.isVisibilityAnimated,
                                     .isSelectable = source.isSelectable,
                                     .isHoverable = source.isHoverable,
                                     .isCoarserLevel = source.isCoarserLevel,
                                     .ofFile = node });
            if (isShown && source.profiledLight) addProfiledLight(*source.profiledLight, source.name, added);
            if (isShown && source.mesh != kNone) placeMesh(mDocument, node, added, *requests, mScene, mDiagnostics);
            push(source.children, added, isVisible);
            if (mScene.nodes.size() > kMaxNodes)
                mDiagnostics.refuse(ErrorCode::Unsupported, "the scene has more than {} nodes and instances",
                                    kMaxNodes);
        }
    }

private:
    void addProfiledLight(GltfProfiledLight const& light, std::string const& name, uint32_t node) {
        mScene.nodes[node].profiledLight = static_cast<uint32_t>(mScene.profiledLights.size());
        mScene.profiledLights.push_back(
                { .name = name, .color = light.color, .intensity = light.multiplier, .profile = light.profile });
    }

    struct Open {
        uint32_t node, parent; // in the document; in the scene
        bool isAboveVisible;   // all nodes above
    };
    void push(std::vector<uint32_t> const& nodes, uint32_t parent, bool isVisible) {
        // Backwards onto a stack, so that nodes come out in the order of the file and parents before their children.
        for (size_t i = nodes.size(); i-- > 0;) mOpen.push_back({ nodes[i], parent, isVisible });
    }

    GltfDocument const& mDocument;
    std::vector<double4x4> const& mWorldFromNode;
    GltfLevels mLevels;
    GltfScene& mScene;
    Diagnostics& mDiagnostics;
    std::vector<Open> mOpen;
};

std::vector<uint32_t> parentsOf(GltfDocument const& document) {
    std::vector<uint32_t> parents(document.nodes.size(), kNone);
    for (uint32_t i = 0; i < document.nodes.size(); ++i) {
        for (const uint32_t child : document.nodes[i].children) parents[child] = i;
    }
    return parents;
}

/// Calls visit(finest level, another level) for each thing with levels, its levels in order; those that levels list
/// themselves follow them.
template <class Visit>
void visitLevels(GltfDocument const& document, Visit const& visit) {
    std::vector<uint32_t> open;
    const auto push = [&](uint32_t node) {
        std::vector<uint32_t> const& levels = document.nodes[node].levels;
        open.insert(open.end(), levels.rbegin(), levels.rend());
    };
    for (uint32_t i = 0; i < document.nodes.size(); ++i) {
        if (document.nodes[i].isCoarserLevel) continue;
        push(i);
        while (!open.empty()) {
            const uint32_t level = open.back();
            open.pop_back();
            visit(i, level);
            push(level);
        }
    }
}

/// Where the file says nothing: a quarter of the area of the level before, half as wide and high. The last level is
/// then shown however small the thing is.
std::vector<double> leastCoverageOf(std::vector<double> const& given, uint32_t node, size_t count,
                                    Diagnostics& diagnostics) {
    std::vector<double> least;
    bool isMended = false;
    for (size_t i = 0; i < count; ++i) {
        const double most = i == 0 ? 1e30 : least.back();
        const double usual = i + 1 == count ? 0 : 0.25 * std::min(most, 1.0);
        const double value = i < given.size() ? given[i] : usual;
        least.push_back(std::clamp(value, 0.0, most));
        isMended |= value != least.back();
    }
    if (isMended)
        diagnostics.warn(
                "nodes[{}].extras.MSFT_screencoverage: must be 0 or more and not increase from level to level; "
                "it was limited to that",
                node);
    return least;
}

void collectLevels(GltfDocument const& document, GltfScene& scene, Diagnostics& diagnostics) {
    uint32_t finest = kNone; // of the last entry
    std::vector<uint32_t> sources;
    visitLevels(document, [&](uint32_t node, uint32_t level) {
        if (scene.nodeOf[node] == kNone || scene.nodeOf[level] == kNone) return;
        if (std::exchange(finest, node) != node) {
            scene.levels.push_back({ { scene.nodeOf[node] }, {} });
            sources.push_back(node);
        }
        scene.levels.back().nodes.push_back(scene.nodeOf[level]);
    });
    for (size_t i = 0; i < sources.size(); ++i)
        scene.levels[i].leastCoverage = leastCoverageOf(document.nodes[sources[i]].coverage, sources[i],
                                                        scene.levels[i].nodes.size(), diagnostics);
}

/// Collects the skins that nodes keep, and gives those nodes the new indices.
void collectSkins(GltfDocument const& document, std::vector<double4x4> const& worldFromNode, NodeList& nodes,
                  GltfScene& scene, Diagnostics& diagnostics) {
    std::map<uint32_t, uint32_t> known; // index in the file -> index in the scene
    const std::vector<uint32_t> parents = parentsOf(document);
    // The loop adds nodes that only serve as joints; they have no skins themselves.
    const size_t shown = scene.nodes.size();
    for (size_t i = 0; i < shown && diagnostics.ok(); ++i) {
        const uint32_t source = scene.nodes[i].skin;
        if (source == kNone) continue;
        const auto [entry, isNew] = known.try_emplace(source, static_cast<uint32_t>(scene.skins.size()));
        scene.nodes[i].skin = entry->second;
        if (!isNew) continue;
        GltfSkin const& skin = document.skins[source];
        SkinData data{ skin.name, {}, readInverseBind(document, source, worldFromNode, diagnostics) };
        data.jointFromBind.resize(skin.joints.size(), float4x4(1.0f));
        for (uint32_t joint : skin.joints) {
            uint32_t top = joint;
            while (parents[top] != kNone) top = parents[top];
            if (scene.nodeOf[joint] == kNone) nodes.add({ top }, nullptr);
            data.joints.push_back(scene.nodeOf[joint]);
        }
        scene.skins.push_back(std::move(data));
    }
}

/// Few bytes can place many primitives: every node places all those of its mesh, each with its variants.
void checkPlacements(GltfDocument const& document, GltfScene const& scene, Diagnostics& diagnostics) {
    std::vector<uint64_t> placements;
    for (GltfMeshRequest const& request : scene.meshes) {
        uint64_t& sum = placements.emplace_back(0);
        for (GltfPrimitive const& primitive : document.meshes[request.mesh].primitives)
            sum += 1 + primitive.variants.size();
    }
    uint64_t all = 0;
    for (NodeData const& node : scene.nodes) all += node.mesh == kNone ? 0 : placements[node.mesh];
    if (all > kMaxPlacements)
        diagnostics.refuse(ErrorCode::Unsupported,
                           "the scene places {} primitives and variants, more than {}; merge primitives", all,
                           kMaxPlacements);
}

} // namespace

void adoptLevels(GltfDocument& document) {
    std::vector<uint32_t> parents = parentsOf(document);
    std::vector<bool> isRoot(document.nodes.size(), false);
    for (const uint32_t root : document.roots) isRoot[root] = true;
    std::vector<std::pair<uint32_t, uint32_t>> adopted; // finest level, and the one that is in no scene
    visitLevels(document, [&](uint32_t node, uint32_t level) {
        if (parents[level] == kNone && !isRoot[level]) adopted.emplace_back(node, level);
    });
    for (auto const& [node, level] : adopted) {
        parents[level] = parents[node];
        if (parents[node] != kNone)
            document.nodes[parents[node]].children.push_back(level);
        else if (isRoot[node])
            document.roots.push_back(level);
    }
}

GltfScene planScene(GltfDocument const& document, GltfDeformation deformation, GltfLevels levels,
                    Diagnostics& diagnostics) {
    GltfScene scene;
    scene.nodeOf.resize(document.nodes.size(), kNone);
    scene.meshNodes.resize(document.nodes.size());
    const std::vector<double4x4> worldFromNode = worldTransforms(document, diagnostics);
    RequestList requests(document, worldFromNode, deformation, scene, diagnostics);
    NodeList nodes(document, worldFromNode, levels, scene, diagnostics);
    nodes.add(document.roots, &requests);
    if (levels == GltfLevels::All) collectLevels(document, scene, diagnostics);
    collectSkins(document, worldFromNode, nodes, scene, diagnostics);
    checkPlacements(document, scene, diagnostics);
    return scene;
}

} // namespace filament_core::assets
