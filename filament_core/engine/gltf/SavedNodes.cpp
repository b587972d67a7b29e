// SPDX-License-Identifier: Apache-2.0
// Nodes of a scene, and what is attached to them, for saveGltf().
#include "filament_core/engine/LightRecords.h"
#include "filament_core/engine/gltf/CopiesOfModels.h"
#include "filament_core/engine/gltf/SaveContext.h"
#include "filament_core/engine/gltf/SavedSources.h"
#include "filament_core/scene/SceneNodes.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace filament_core::engine {
namespace {

using assets::GltfMergeMesh;
using assets::GltfMergeNode;
using assets::GltfMergePrimitive;
using assets::kNone;

/// A copy of a model in the scene.
struct Copy {
    CopyOfModel const* parts = nullptr;
    uint32_t source = kNone; ///< into SaveContext::sources
};

/// A node of a copy.
struct PartOf {
    uint32_t copy = kNone, part = kNone; ///< kNone: its root
};

/// A primitive of a copy as the scene has it.
struct PrimitiveState {
    uint32_t renderable = kNone; ///< of the copy
    bool isThere = false, isHidden = false;
    std::optional<uint32_t> material{}, ofFile{}; ///< GltfMergePrimitive
    bool isPlain() const { return isThere && !isHidden && !material && !ofFile; }
};

class NodeSaver {
public:
    NodeSaver(SaveContext& context, GltfSaveOptions const& options)
            : mContext(context), mScene(context.scene), mData(context.scene.data), mOptions(options),
              mMaterials(context), mGeometry(context), mSkins(context) {}

    Result<void> run() {
        if (Result<void> found = findCopies(); !found) return found;
        sortAttached();
        if (Result<void> visited = visitAll(); !visited) return visited;
        if (Result<void> added = addLoose(); !added) return added;
        mSkins.finish();
        saveSurroundings(mContext, mOptions);
        warnAboutTheRest();
        return {};
    }

private:
    std::vector<GltfMergeNode>& nodes() { return mContext.merge.nodes; }
    Model::Impl const& modelOf(uint32_t copy) const { return *mCopies[copy].parts->model; }
    bool isThere(Node node) const { return mData.transforms.contains(node); }
    bool isThere(Renderable renderable) const { return mData.renderables.index.contains(renderable); }
    bool isThere(Light light) const { return mData.lights.index.contains(light); }

    // ---- models

    Result<void> findCopies() {
        std::vector<Node> open;
        pushChildren({}, open);
        while (!open.empty()) {
            const Node node = open.back();
            open.pop_back();
            pushChildren(node, open);
            CopyOfModel const* const parts = mScene.copies.find(node);
            if (!parts) continue;
            const Result<uint32_t> source = sourceOf(mContext, *parts->model, mOptions);
            if (!source) return source.error();
            const auto copy = static_cast<uint32_t>(mCopies.size());
            mCopies.push_back({ parts, *source });
            mContext.merge.copies.push_back(*source);
            mMaterials.know(*parts, *source);
            for (size_t i = 0; i < parts->model->vertexBuffers.size(); ++i) {
                const VertexBuffer buffer = parts->model->vertexBuffers[i];
                if (mContext.engine.vertexBuffers.isLive(buffer))
                    mVersions[mContext.engine.vertexBuffers.get(buffer).handle.index()] =
                            parts->model->vertexVersions[i];
            }
            mParts[node.index()] = { copy, kNone };
            for (uint32_t i = 0; i < parts->nodes.size(); ++i)
                if (isThere(parts->nodes[i])) mParts[parts->nodes[i].index()] = { copy, i };
            for (const Renderable renderable : parts->renderables)
                if (isThere(renderable)) mOfCopies.insert(renderable.index());
        }
        return {};
    }

    /// The first child comes from the stack first.
    void pushChildren(Node node, std::vector<Node>& open) const {
        const size_t before = open.size();
        for (Node child = mData.transforms.firstChild(node); child; child = mData.transforms.nextSibling(child))
            open.push_back(child);
        std::reverse(open.begin() + static_cast<std::ptrdiff_t>(before), open.end());
    }

    // ---- what the program added

    void sortAttached() {
        std::set<uint32_t> isShape;
        for (scene::LightShape const& shape : mData.lightShapes) isShape.insert(shape.renderable.index());
        scene::Renderables const& all = mData.renderables;
        for (uint32_t i = 0; i < all.count(); ++i) {
            const Renderable renderable = all.index.handleAt(i);
            if (isShape.contains(renderable.index())) continue;
            warnAboutProperties(renderable, i);
            if (mOfCopies.contains(renderable.index())) continue;
            const Node node = scene::nodeOf(mData, renderable);
            mOwn[node ? node.index() : kNone].push_back(renderable);
        }
        std::set<uint32_t> isOfEnvironment;
        for (const Light light : mScene.environmentLights) isOfEnvironment.insert(light.index());
        for (Copy const& copy : mCopies)
            for (size_t i = 0; i < copy.parts->lights.size(); ++i)
                if (isThere(copy.parts->lights[i])) mLightParts.insert(copy.parts->lights[i].index());
        for (uint32_t i = 0; i < mData.lights.index.size(); ++i) {
            const Light light = mData.lights.index.handleAt(i);
            if (isOfEnvironment.contains(light.index()) || mLightParts.contains(light.index())) continue;
            const Node node = scene::nodeOf(mData, light);
            mOwnLights[node ? node.index() : kNone].push_back(light);
        }
    }

    // ---- nodes

    struct Open {
        Node node;
        uint32_t parent = kNone; ///< into nodes(); kNone: the scene
    };

    Result<void> visitAll() {
        std::vector<Open> open;
        push({}, kNone, open);
        while (!open.empty()) {
            const Open next = open.back();
            open.pop_back();
            const Result<uint32_t> written = write(next.node, next.parent);
            if (!written) return written.error();
            mSkins.know(next.node, *written, *written != next.parent);
            push(next.node, *written, open);
        }
        return {};
    }

    void push(Node node, uint32_t parent, std::vector<Open>& open) const {
        std::vector<Node> children;
        pushChildren(node, children);
        for (const Node child : children) open.push_back({ child, parent });
    }

    uint32_t add(GltfMergeNode node, uint32_t parent) {
        const auto index = static_cast<uint32_t>(nodes().size());
        nodes().push_back(std::move(node));
        (parent == kNone ? mContext.merge.roots : nodes()[parent].children).push_back(index);
        return index;
    }

    /// Returns what the children of the node are below.
    Result<uint32_t> write(Node node, uint32_t parent) {
        const auto known = mParts.find(node.index());
        const double4x4 transform = mData.transforms.parentFromNode(node);
        const bool hasOwn = mOwn.contains(node.index()) || mOwnLights.contains(node.index());
        uint32_t written = parent;
        if (known == mParts.end() || known->second.part == kNone) {
            const bool isRoot = known != mParts.end();
            // So that a file that is loaded and saved again and again gets no deeper.
            if (isRoot && !hasOwn && transform == double4x4(1.0) && parent == kNone) return parent;
            GltfMergeNode own{ .name = mData.transforms.name(node) };
            if (transform != double4x4(1.0)) own.transform = transform;
            written = add(std::move(own), parent);
        } else {
            const Result<uint32_t> part = writePart(known->second, parent, transform);
            if (!part) return part;
            written = *part;
        }
        if (Result<void> added = addOwn(node.index(), written); !added) return added.error();
        return written;
    }

    Result<uint32_t> writePart(PartOf const& which, uint32_t parent, double4x4 const& transform) {
        Model::Impl::PartNode const& part = modelOf(which.copy).nodes[which.part];
        if (part.carriesMesh || part.ofFile == kNone) return parent; // is written with the node of the file
        GltfMergeNode node{ .copy = which.copy, .node = part.ofFile };
        if (transform != part.parentFromNode) node.transform = transform;
        // Levels of detail are named by their finest one; the loader gives those of no scene a place.
        if (part.isCoarserLevel && !isChildInFile(which)) return add(std::move(node), parent);
        const uint32_t written = add(std::move(node), parent);
        if (Result<void> done = writeMeshOf(which, written); !done) return done.error();
        writeLightsOf(which, written);
        return written;
    }

    bool isChildInFile(PartOf const& which) const {
        const uint32_t file = modelOf(which.copy).nodes[which.part].ofFile;
        assets::GltfDocument const& document = documentOf(which.copy);
        return std::ranges::any_of(document.nodes, [&](assets::GltfNode const& node) {
            return std::ranges::find(node.children, file) != node.children.end();
        });
    }

    assets::GltfDocument const& documentOf(uint32_t copy) const {
        return mContext.sources[mCopies[copy].source].document;
    }

    // ---- meshes of files

    /// Of the part that has them: the node, or one that carries its mesh.
    Result<std::vector<PrimitiveState>> primitivesAt(uint32_t copy, uint32_t part, assets::GltfMesh const& mesh) {
        Model::Impl const& model = modelOf(copy);
        CopyOfModel const& parts = *mCopies[copy].parts;
        std::vector<PrimitiveState> states;
        for (uint32_t r : renderablesOf(copy, part)) {
            PrimitiveState state{ .renderable = r, .isThere = isThere(parts.renderables[r]) };
            if (state.isThere && !model.renderables[r].desc.splats) {
                state.isHidden = mContext.isHidden(parts.renderables[r]) && !model.mayChange[part];
                if (states.size() < mesh.primitives.size())
                    if (Result<void> found = findMaterial(copy, mesh.primitives[states.size()].material,
                                                          parts.renderables[r], state);
                        !found)
                        return found.error();
            }
            states.push_back(state);
        }
        return states;
    }

    std::vector<uint32_t> const& renderablesOf(uint32_t copy, uint32_t part) {
        auto& [model, byPart] = mRenderables[mCopies[copy].source];
        if (!model) {
            model = &modelOf(copy);
            for (uint32_t r = 0; r < model->renderables.size(); ++r) byPart[model->renderables[r].ofNode].push_back(r);
        }
        return byPart[part];
    }

    Result<void> findMaterial(uint32_t copy, uint32_t expected, Renderable renderable, PrimitiveState& state) {
        scene::MaterialInstance const& shown = *mContext.drawableOf(renderable).material;
        const Result<SavedMaterial> saved = mMaterials.find(shown);
        if (!saved) return saved.error();
        if (!saved->isShown) state.isHidden = true;
        if (saved->changed != kNone) {
            state.material = saved->changed;
        } else if (saved->source != mCopies[copy].source) {
            const Result<uint32_t> entry = mMaterials.entryOf(shown);
            if (!entry) return entry.error();
            state.material = *entry;
        } else if (saved->material != expected) {
            state.ofFile = saved->material;
        }
        return {};
    }

    Result<void> writeMeshOf(PartOf const& which, uint32_t written) {
        Model::Impl const& model = modelOf(which.copy);
        const uint32_t file = model.nodes[which.part].ofFile;
        assets::GltfNode const& source = documentOf(which.copy).nodes[file];
        if (source.mesh == kNone) return {};
        assets::GltfMesh const& mesh = documentOf(which.copy).meshes[source.mesh];
        const std::vector<uint32_t> carriers = carriersOf(which.copy, file);
        if (source.instancing) return writeInstances(which.copy, carriers, mesh, source.mesh, written);
        const Result<std::vector<PrimitiveState>> states =
                primitivesAt(which.copy, carriers.empty() ? which.part : carriers.front(), mesh);
        if (!states) return states.error();
        setWeights(which.copy, *states, nodes()[written]);
        return setMesh(which.copy, *states, mesh, source.mesh, written);
    }

    /// The nodes that carry the mesh of a node of the file.
    std::vector<uint32_t> const& carriersOf(uint32_t copy, uint32_t file) {
        auto& [model, byNode] = mCarriers[mCopies[copy].source];
        if (!model) {
            model = &modelOf(copy);
            for (uint32_t i = 0; i < model->nodes.size(); ++i)
                if (model->nodes[i].carriesMesh) byNode[model->nodes[i].ofFile].push_back(i);
        }
        return byNode[file];
    }

    /// Each instance, if one of them has changed; else nothing: they are those of the file.
    Result<void> writeInstances(uint32_t copy, std::vector<uint32_t> const& carriers, assets::GltfMesh const& mesh,
                                uint32_t meshOfFile, uint32_t written) {
        CopyOfModel const& parts = *mCopies[copy].parts;
        std::vector<std::vector<PrimitiveState>> all;
        bool isPlain = true;
        for (const uint32_t carrier : carriers) {
            Result<std::vector<PrimitiveState>> states = primitivesAt(copy, carrier, mesh);
            if (!states) return states.error();
            isPlain = isPlain && isThere(parts.nodes[carrier]) &&
                      std::ranges::all_of(*states, &PrimitiveState::isPlain) &&
                      mData.transforms.parentFromNode(parts.nodes[carrier]) ==
                              modelOf(copy).nodes[carrier].parentFromNode;
            all.push_back(std::move(*states));
        }
        if (isPlain) return {};
        nodes()[written].losesMesh = true;
        for (size_t i = 0; i < carriers.size(); ++i) {
            if (!isThere(parts.nodes[carriers[i]])) continue;
            GltfMergeNode instance{ .name = fmt::format("instance {}", i),
                                    .transform = mData.transforms.parentFromNode(parts.nodes[carriers[i]]) };
            const uint32_t child = add(std::move(instance), written);
            if (std::ranges::all_of(all[i], &PrimitiveState::isPlain))
                nodes()[child].mesh = wholeMesh(copy, mesh, meshOfFile);
            else if (Result<void> set = setMesh(copy, all[i], mesh, meshOfFile, child); !set)
                return set;
        }
        return {};
    }

    uint32_t wholeMesh(uint32_t copy, assets::GltfMesh const& mesh, uint32_t meshOfFile) {
        std::vector<PrimitiveState> plain(mesh.primitives.size(), { .isThere = true });
        return meshOf(copy, plain, mesh, meshOfFile, false);
    }

    Result<void> setMesh(uint32_t copy, std::vector<PrimitiveState> const& states, assets::GltfMesh const& mesh,
                         uint32_t meshOfFile, uint32_t written) {
        if (states.empty() || std::ranges::all_of(states, &PrimitiveState::isPlain)) return {}; // or hidden by the file
        if (states.size() != mesh.primitives.size()) {
            mContext.warn("mesh '{}': changes of its primitives are not written, because some are not drawn",
                          mesh.name);
            return {};
        }
        const bool isOfFile = nodes()[written].copy != kNone;
        const uint32_t file = nodes()[written].node;
        const uint32_t hidden = meshOf(copy, states, mesh, meshOfFile, true);
        const uint32_t shown = meshOf(copy, states, mesh, meshOfFile, false);
        if (shown != kNone)
            nodes()[written].mesh = shown;
        else
            nodes()[written].losesMesh = true;
        if (hidden == kNone) return {};
        GltfMergeNode node{ .name = mesh.name + " (hidden)", .mesh = hidden, .isHidden = true };
        if (isOfFile && documentOf(copy).nodes[file].skin != kNone)
            mContext.warn("mesh '{}': its hidden primitives have no skin in the file", mesh.name);
        add(std::move(node), written);
        return {};
    }

    /// The primitives that are there and hidden or not, as a mesh of the file; kNone: there are none.
    uint32_t meshOf(uint32_t copy, std::vector<PrimitiveState> const& states, assets::GltfMesh const& mesh,
                    uint32_t meshOfFile, bool areHidden) {
        GltfMergeMesh merged{ .name = mesh.name,
                              .source = mCopies[copy].source,
                              .mesh = meshOfFile,
                              .primitiveCount = static_cast<uint32_t>(mesh.primitives.size()),
                              .primitives = {} };
        std::vector<uint32_t> key{ merged.source, meshOfFile };
        for (uint32_t i = 0; i < states.size(); ++i) {
            if (!states[i].isThere || states[i].isHidden != areHidden) continue;
            merged.primitives.push_back({ .primitive = i, .material = states[i].material, .ofFile = states[i].ofFile });
            key.insert(key.end(), { i, states[i].material.value_or(kNone), states[i].ofFile.value_or(kNone - 1) });
        }
        if (merged.primitives.empty()) return kNone;
        const auto [entry, isNew] = mMeshes.try_emplace(key, static_cast<uint32_t>(mContext.merge.meshes.size()));
        if (isNew) mContext.merge.meshes.push_back(std::move(merged));
        return entry->second;
    }

    void setWeights(uint32_t copy, std::vector<PrimitiveState> const& states, GltfMergeNode& node) const {
        for (PrimitiveState const& state : states) {
            Model::Impl::PartRenderable const& part = modelOf(copy).renderables[state.renderable];
            if (!state.isThere || !part.desc.morphTargets) continue;
            const uint32_t at = mData.renderables.index.at(mCopies[copy].parts->renderables[state.renderable]);
            const uint32_t slot = scene::deformationAt(mData.renderables, at);
            if (slot == scene::kNotDeformed) continue;
            std::vector<float> const& weights = mData.deformations.all()[slot].weights;
            std::vector<float> rest = part.desc.morphWeights;
            rest.resize(weights.size(), 0.0f);
            if (weights != rest) node.weights = weights;
            return;
        }
    }

    // ---- lights of files

    void writeLightsOf(PartOf const& which, uint32_t written) {
        Model::Impl const& model = modelOf(which.copy);
        CopyOfModel const& parts = *mCopies[which.copy].parts;
        std::vector<size_t> here;
        bool isPlain = true;
        for (size_t i = 0; i < model.lights.size(); ++i) {
            if (model.lights[i].node != which.part) continue;
            here.push_back(i);
            isPlain = isPlain && isThere(parts.lights[i]) &&
                      (model.mayChange[which.part] || isAsLoaded(model.lights[i], parts.lights[i]));
        }
        if (isPlain) return;
        nodes()[written].losesLights = true;
        for (const size_t i : here)
            if (isThere(parts.lights[i]))
                add(savedLight(mContext, localRecord(parts.lights[i]), model.lights[i].name), written);
    }

    bool isAsLoaded(Model::Impl::PartLight const& part, Light light) const {
        return isSameLight(localRecord(light), recordOf(mContext.engine, part.light));
    }

    /// In the space of its node; else in the world.
    scene::LightRecord localRecord(Light light) const {
        scene::LightRecord record = mData.lights.records[mData.lights.index.at(light)];
        if (!mData.atNodes.lights.isAttached(light)) return record;
        scene::LightPose const& pose = mData.atNodes.lightPoses[light.index()];
        record.positionWorld = pose.position;
        record.directionWorld = pose.direction;
        record.sideWorld = pose.side;
        return record;
    }

    // ---- objects of the program

    Result<void> addLoose() {
        for (const Renderable renderable : mOwn.contains(kNone) ? mOwn[kNone] : std::vector<Renderable>()) {
            const uint32_t at = mData.renderables.index.at(renderable);
            GltfMergeNode node;
            node.transform = scene::matrixFrom(scene::worldFromObject(mData.renderables, at));
            mOwn[kNone - 1] = { renderable };
            if (Result<void> added = addRenderables(kNone - 1, add(std::move(node), kNone)); !added) return added;
        }
        if (mOwnLights.contains(kNone))
            for (const Light light : mOwnLights[kNone]) add(savedLight(mContext, localRecord(light), ""), kNone);
        return {};
    }

    Result<void> addOwn(uint32_t slot, uint32_t written) {
        if (mOwnLights.contains(slot))
            for (const Light light : mOwnLights[slot]) add(savedLight(mContext, localRecord(light), ""), written);
        return mOwn.contains(slot) ? addRenderables(slot, written) : Result<void>();
    }

    /// As a mesh of the node, or of one below it if that is one of a file, or if they are hidden. What is deformed has
    /// a node of its own: all primitives of a mesh have as many morph targets.
    Result<void> addRenderables(uint32_t slot, uint32_t written) {
        for (const bool areHidden : { false, true }) {
            std::vector<Renderable> plain;
            for (const Renderable renderable : mOwn[slot]) {
                if (mContext.isHidden(renderable) != areHidden || isSplats(renderable)) continue;
                if (!mContext.deformationOf(renderable))
                    plain.push_back(renderable);
                else if (Result<void> added = addDeformed(renderable, areHidden, written); !added)
                    return added;
            }
            const Result<uint32_t> mesh = ownMesh(plain);
            if (!mesh) return mesh.error();
            if (*mesh == kNone) continue;
            if (written != kNone && nodes()[written].copy == kNone && nodes()[written].mesh == kNone && !areHidden)
                nodes()[written].mesh = *mesh;
            else
                add({ .name = mContext.merge.meshes[*mesh].name, .mesh = *mesh, .isHidden = areHidden }, written);
        }
        return {};
    }

    Result<void> addDeformed(Renderable renderable, bool isHidden, uint32_t written) {
        const Result<uint32_t> mesh = ownMesh({ renderable });
        if (!mesh) return mesh.error();
        if (*mesh == kNone) return {};
        scene::Deformation const& by = *mContext.deformationOf(renderable);
        GltfMergeNode node{ .name = mContext.merge.meshes[*mesh].name, .mesh = *mesh, .isHidden = isHidden };
        if (by.morph && by.morph->targetCount > 0) node.weights = by.weights;
        const uint32_t at = add(std::move(node), written);
        if (by.skin) mSkins.use(by.skin, at, written);
        return {};
    }

    Result<uint32_t> ownMesh(std::vector<Renderable> const& renderables) {
        GltfMergeMesh mesh;
        std::vector<uint32_t> key;
        for (const Renderable renderable : renderables) {
            scene::Drawable const& drawable = mContext.drawableOf(renderable);
            const Result<SavedMaterial> saved = mMaterials.find(*drawable.material);
            if (!saved) return saved.error();
            if (!saved->isShown) continue;
            const Result<uint32_t> material = mMaterials.entryOf(*drawable.material);
            if (!material) return material.error();
            scene::Geometry const& geometry = drawable.geometry;
            key.insert(key.end(), { geometry.vertices.index(), geometry.indices.index(), geometry.firstIndex,
                                    geometry.indexCount, geometry.layout, *material });
            mesh.primitives.push_back({ .material = *material });
            if (scene::Deformation const* const by = mContext.deformationOf(renderable))
                key.insert(key.end(), { by->skin ? 1u : 0u, by->morph ? by->morph->deltas.index() : kNone });
            mToRead.push_back({ renderable, mesh.primitives.size() - 1 });
        }
        const std::vector<ToRead> reads = std::exchange(mToRead, {});
        if (mesh.primitives.empty()) return kNone;
        key.push_back(kNone); // no key of a mesh of a file
        if (const auto known = mOwnMeshes.find(key); known != mOwnMeshes.end()) return known->second;
        for (ToRead const& read : reads) {
            Result<GltfMergePrimitive> geometry = mGeometry.read(read.renderable);
            if (!geometry) return geometry.error();
            geometry->material = mesh.primitives[read.primitive].material;
            mesh.primitives[read.primitive] = std::move(*geometry);
            if (mesh.name.empty()) mesh.name = nameOf(mContext.drawableOf(read.renderable).geometry.vertices);
        }
        std::erase_if(mesh.primitives, [](GltfMergePrimitive const& each) { return each.own.positions.empty(); });
        if (mesh.primitives.empty()) return kNone;
        mContext.merge.meshes.push_back(std::move(mesh));
        return mOwnMeshes[key] = static_cast<uint32_t>(mContext.merge.meshes.size() - 1);
    }

    std::string nameOf(backend::BufferHandle vertices) const {
        VertexBufferState const* const state = stateBehind(mContext.engine.vertexBuffers, vertices);
        return state ? state->name : std::string();
    }

    bool isSplats(Renderable renderable) {
        const bool is = std::ranges::any_of(
                mData.splats, [&](scene::SplatRecord const& record) { return record.renderable == renderable; });
        if (is && mSplats++ == 0)
            mContext.warn("splats that the program made are not written; load them from a glTF file that has them");
        return is;
    }

    // ---- the scene

    /// Counted here, and told once each.
    void warnAboutProperties(Renderable, uint32_t at) {
        scene::Renderables const& all = mData.renderables;
        scene::Drawable const& drawable = all.drawables[all.drawable[at]];
        mOtherLayers += all.layers[at] != kDefaultLayers;
        mOtherChannels += drawable.properties.lightChannels != kDefaultLightChannels;
        mOtherShadows += !drawable.properties.receivesShadows || (all.flags[at] & scene::kCastsNoShadows) != 0;
        mOtherOrder += drawable.place != DrawOrder{};
        const auto loaded = mVersions.find(drawable.geometry.vertices.index());
        mChangedBuffers += mOfCopies.contains(all.index.handleAt(at).index()) && loaded != mVersions.end() &&
                           mContext.engine.contentVersions.of(drawable.geometry.vertices) != loaded->second;
    }

    void warnAboutTheRest() {
        const auto count = [&](size_t number, const char* what) {
            if (number > 0)
                mContext.warn("{} {} are not written: glTF has nothing like them; keep them in a scene file", number,
                              what);
        };
        count(mOtherLayers, "layers of renderables");
        count(mOtherChannels, "light channels of renderables");
        count(mOtherShadows, "renderables without shadows of their own or of others");
        count(mOtherOrder, "draw orders of renderables");
        count(mData.probes.index.size(), "reflection probes");
        count(mData.grids.index.size(), "irradiance grids");
        if (mChangedBuffers > 0)
            mContext.warn("vertices of {} renderables of models were updated by the program; the file has those of the "
                          "models. Create the meshes yourself to save them",
                          mChangedBuffers);
    }

    struct ToRead {
        Renderable renderable{};
        size_t primitive = 0;
    };

    template <class T>
    using BySource = std::map<uint32_t, std::pair<Model::Impl const*, std::map<uint32_t, T>>>;

    SaveContext& mContext;
    Scene::Impl const& mScene;
    scene::SceneData const& mData;
    GltfSaveOptions const& mOptions;
    SavedMaterials mMaterials;
    SavedGeometry mGeometry;
    SavedSkins mSkins;
    std::vector<Copy> mCopies;
    std::unordered_map<uint32_t, uint32_t> mVersions;        // of vertices of models, by buffer, as they were loaded
    std::unordered_map<uint32_t, PartOf> mParts;             // by slot of the node
    std::set<uint32_t> mOfCopies, mLightParts;               // renderables and lights, by index
    std::map<uint32_t, std::vector<Renderable>> mOwn;        // of the program, by slot; kNone: no node
    std::map<uint32_t, std::vector<Light>> mOwnLights;       // the same
    BySource<std::vector<uint32_t>> mRenderables, mCarriers; // of models, by part or node of the file
    std::map<std::vector<uint32_t>, uint32_t> mMeshes, mOwnMeshes; // into GltfMerge::meshes
    std::vector<ToRead> mToRead;
    size_t mSplats = 0, mOtherLayers = 0, mOtherChannels = 0, mOtherShadows = 0, mOtherOrder = 0, mChangedBuffers = 0;
};

} // namespace

Result<void> saveNodes(SaveContext& context, GltfSaveOptions const& options) {
    return NodeSaver(context, options).run();
}

} // namespace filament_core::engine
