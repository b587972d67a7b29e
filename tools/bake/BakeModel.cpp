// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/BakeModel.h"

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfBuffers.h"
#include "filament_core/assets/gltf/GltfContainer.h"
#include "filament_core/assets/gltf/GltfParse.h"
#include "filament_core/assets/gltf/GltfScene.h"
#include "filament_core/assets/gltf/GltfUri.h"

#include <algorithm>
#include <set>

namespace filament_core::bake {
namespace {

using assets::Diagnostics;
using assets::GltfDocument;
using assets::GltfNode;
using assets::GltfPrimitive;
using assets::kNone;

constexpr uint32_t kUvSets = assets::GltfAttributes::kUvSets;

/// Nodes that an animation moves, with all below them.
std::vector<bool> movingNodes(GltfDocument const& document) {
    std::vector<bool> isMoving(document.nodes.size(), false);
    std::vector<uint32_t> next;
    for (assets::GltfAnimation const& animation : document.animations) {
        for (assets::GltfAnimationChannel const& channel : animation.channels) {
            if (channel.node != kNone) next.push_back(channel.node);
        }
    }
    while (!next.empty()) {
        const uint32_t node = next.back();
        next.pop_back();
        if (isMoving[node]) continue;
        isMoving[node] = true;
        for (const uint32_t child : document.nodes[node].children) next.push_back(child);
    }
    return isMoving;
}

class Reader {
public:
    Reader(BakeModel& model, assets::GltfScene const& scene, Diagnostics& diagnostics)
            : mModel(model), mDocument(*model.document), mScene(scene), mDiagnostics(diagnostics),
              mIsMoving(movingNodes(mDocument)) {}

    void read() {
        for (uint32_t node = 0; node < mDocument.nodes.size(); ++node) {
            if (mScene.nodeOf[node] == kNone || mDocument.nodes[node].mesh == kNone) continue;
            if (mScene.nodes[mScene.nodeOf[node]].mesh == kNone && mScene.meshNodes[node].empty()) continue;
            readNode(node);
        }
        for (auto const& [reason, node] : mSkipped)
            mModel.warnings.push_back(fmt::format("node '{}' is not baked: {}", node, reason));
    }

private:
    void skip(std::string const& reason, uint32_t node) {
        if (mReasons.insert(reason).second) mSkipped.emplace_back(reason, nameOf(node));
    }
    std::string nameOf(uint32_t node) const {
        std::string const& name = mDocument.nodes[node].name;
        return name.empty() ? fmt::format("nodes[{}]", node) : name;
    }

    void readNode(uint32_t index) {
        GltfNode const& node = mDocument.nodes[index];
        if (node.skin != kNone) return skip("it has a skin", index);
        if (node.instancing) return skip("it is drawn as instances", index);
        if (mIsMoving[index]) return skip("it moves", index);
        const double4x4 world = mScene.nodes[mScene.nodeOf[index]].worldFromNode;
        auto const& primitives = mDocument.meshes[node.mesh].primitives;
        for (uint32_t i = 0; i < primitives.size(); ++i) readPrimitive(index, node.mesh, i, primitives[i], world);
    }

    void readPrimitive(uint32_t node, uint32_t mesh, uint32_t index, GltfPrimitive const& primitive,
                       double4x4 const& world) {
        const bool isUnlit = primitive.material != kNone && mDocument.materials[primitive.material].values.unlit;
        if (primitive.mode != assets::GltfMode::Triangles) return skip("it is no list of triangles", node);
        if (!primitive.targets.empty()) return skip("it has morph targets", node);
        if (isUnlit) return skip("its material is unlit", node);
        const std::string path = fmt::format("meshes[{}].primitives[{}]", mesh, index);
        BakeModel::Source source{ .node = node, .mesh = mesh, .primitive = index, .name = nameOf(node) };
        source.geometry = assets::gatherGeometry(mDocument, primitive, path, mDiagnostics);
        if (!mDiagnostics.ok() || source.geometry.positions.empty()) return;
        assets::makeList(primitive, path, source.geometry, mDiagnostics);
        assets::repairDirections(path, source.geometry, mDiagnostics);
        assets::dropNonFinite(path, source.geometry, mDiagnostics);
        if (!mDiagnostics.ok() || source.geometry.indices.size() < 3) return;
        auto const& kept = primitive.draco ? primitive.draco->ids.keptSets : primitive.attributes.keptSets;
        for (uint32_t i = 0; i < kUvSets; ++i) source.uvSets.push_back(kept[i]);
        source.surface = static_cast<uint32_t>(mModel.surfaces.size());
        if (glm::determinant(double3x3(world)) != 0) source.meshFromWorld = glm::inverse(double3x3(world));
        mModel.surfaces.push_back(placed(source.geometry, world));
        mModel.sources.push_back(std::move(source));
    }

    static BakeSurface placed(assets::GltfGeometry const& geometry, double4x4 const& world) {
        const double3x3 linear(world);
        const bool isMirrored = glm::determinant(linear) < 0;
        const double3x3 cofactors{ glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                   glm::cross(linear[0], linear[1]) };
        BakeSurface surface;
        for (float3 const& position : geometry.positions)
            surface.positions.emplace_back(world * double4(double3(position), 1.0));
        for (float3 const& normal : geometry.normals) {
            const double3 turned = cofactors * double3(normal) * (isMirrored ? -1.0 : 1.0);
            const double length = glm::length(turned);
            surface.normals.push_back(length > 0 ? turned / length : double3(0.0));
        }
        surface.indices = geometry.indices;
        surface.indices.resize(surface.indices.size() / 3 * 3);
        if (!isMirrored) return surface;
        for (size_t i = 0; i < surface.indices.size(); i += 3)
            std::swap(surface.indices[i + 1], surface.indices[i + 2]);
        return surface;
    }

    BakeModel& mModel;
    GltfDocument const& mDocument;
    assets::GltfScene const& mScene;
    Diagnostics& mDiagnostics;
    std::vector<bool> mIsMoving;
    std::set<std::string> mReasons;
    std::vector<std::pair<std::string, std::string>> mSkipped;
};

/// The first set that no primitive of the baked meshes has.
uint32_t freeUvSet(BakeModel const& model) {
    uint32_t set = 1;
    for (BakeModel::Source const& source : model.sources) {
        GltfPrimitive const& primitive = model.document->meshes[source.mesh].primitives[source.primitive];
        auto const& attributes = primitive.draco ? primitive.draco->ids : primitive.attributes;
        for (uint32_t i = 0; i < attributes.uvSets.size(); ++i) {
            if (attributes.uvSets[i] != kNone) set = std::max(set, i + 1);
        }
    }
    return set;
}

} // namespace

Result<BakeModel> readBakeModel(std::filesystem::path const& path, jobs::JobSystem& jobs) {
    BakeModel model{ .folder = path.parent_path(), .document = std::make_shared<GltfDocument>() };
    Result<std::vector<std::byte>> file = assets::readGltfFile(path);
    if (!file) return file.error();
    model.file = std::move(*file);
    const auto refused = [&](Error error) {
        error.message = path.filename().string() + ": " + error.message;
        return error;
    };
    const Result<assets::GltfContainer> container = assets::openGltfContainer(model.file);
    if (!container) return refused(container.error());
    Diagnostics diagnostics;
    *model.document = assets::parseGltf(container->json, diagnostics);
    if (diagnostics.ok())
        assets::loadGltfBuffers(*model.document, *container, assets::GltfFolder(model.folder), jobs, diagnostics);
    if (!diagnostics.ok()) return refused(diagnostics.error());
    const assets::GltfScene scene = assets::planScene(*model.document, assets::GltfDeformation::AtRest,
                                                      assets::GltfLevels::Finest, diagnostics);
    if (diagnostics.ok()) Reader(model, scene, diagnostics).read();
    if (!diagnostics.ok()) return refused(diagnostics.error());
    for (std::string& line : diagnostics.takeWarnings()) model.warnings.push_back(std::move(line));
    if (model.surfaces.empty())
        return fail(ErrorCode::InvalidArgument, "{}: nothing in it can be baked{}", path.string(),
                    model.warnings.empty() ? std::string() : "; " + model.warnings.front());
    model.uvSet = freeUvSet(model);
    if (model.uvSet >= kUvSets)
        return fail(ErrorCode::Unsupported, "{}: has TEXCOORD_{} already; leave a set below {} free", path.string(),
                    model.uvSet - 1, kUvSets);
    return model;
}

} // namespace filament_core::bake
