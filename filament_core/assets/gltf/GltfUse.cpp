// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfUse.h"

#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfPointer.h"

namespace filament_core::assets {
namespace {

/// Marks what is reached. Every mark of an element marks what the element refers to, once.
class Reach {
public:
    explicit Reach(GltfDocument& document) : mDocument(document), mUse(document.use) {
        const std::array<size_t, kGltfArrays> counts{ document.buffers.size(),   document.views.size(),
                                                      document.accessors.size(), document.meshes.size(),
                                                      document.nodes.size(),     document.skins.size(),
                                                      document.images.size(),    document.samplers.size(),
                                                      document.materials.size(), document.textures.size(),
                                                      document.lights.size(),    document.cameras.size(),
                                                      document.profiles.size(),  document.imageBasedLights.size(),
                                                      document.variants.size(),  document.animations.size() };
        for (size_t i = 0; i < kGltfArrays; ++i) mUse.reached[i].assign(counts[i], false);
    }

    void scene() {
        mOpen = mDocument.roots;
        while (!mOpen.empty()) {
            const uint32_t index = mOpen.back();
            mOpen.pop_back();
            if (mark(GltfArray::Nodes, index)) node(mDocument.nodes[index]);
        }
        joints();
        if (mark(GltfArray::ImageBasedLights, mDocument.imageBasedLight)) {
            for (auto const& faces : mDocument.imageBasedLights[mDocument.imageBasedLight].levels) {
                for (const uint32_t face : faces) image(face);
            }
        }
        for (uint32_t i = 0; i < mDocument.animations.size(); ++i) animation(i);
    }

private:
    /// Whether the element is one, and was not marked before.
    bool mark(GltfArray array, uint32_t index) {
        if (index == kNone || mUse.has(array, index)) return false;
        mUse.of(array)[index] = true;
        return true;
    }

    bool isReached(GltfArray array, uint32_t index) const { return index != kNone && mUse.has(array, index); }

    void node(GltfNode const& node) {
        mOpen.insert(mOpen.end(), node.children.begin(), node.children.end());
        mOpen.insert(mOpen.end(), node.levels.begin(), node.levels.end());
        if (mark(GltfArray::Meshes, node.mesh)) mesh(mDocument.meshes[node.mesh]);
        if (mark(GltfArray::Skins, node.skin)) accessor(mDocument.skins[node.skin].inverseBindMatrices);
        mark(GltfArray::Lights, node.light);
        mark(GltfArray::Cameras, node.camera);
        if (node.instancing) {
            for (const uint32_t index :
                 { node.instancing->translation, node.instancing->rotation, node.instancing->scale })
                accessor(index);
        }
        if (node.profiledLight && mark(GltfArray::Profiles, node.profiledLight->profile))
            view(mDocument.profiles[node.profiledLight->profile].view);
    }

    void mesh(GltfMesh const& mesh) {
        for (GltfPrimitive const& primitive : mesh.primitives) {
            attributes(primitive.attributes);
            accessor(primitive.indices);
            material(primitive.material);
            for (VariantMaterial const& variant : primitive.variants) material(variant.material);
            for (GltfMorphTarget const& target : primitive.targets) {
                for (const uint32_t index : { target.position, target.normal, target.tangent }) accessor(index);
            }
            if (primitive.draco) view(primitive.draco->view);
            if (primitive.splats) splats(*primitive.splats);
        }
    }

    void splats(GltfSplats const& splats) {
        for (const uint32_t index : { splats.rotation, splats.scale, splats.opacity }) accessor(index);
        for (uint32_t i = 0; i < (splats.degree + 1) * (splats.degree + 1); ++i) accessor(splats.harmonics[i]);
    }

    void attributes(GltfAttributes const& attributes) {
        for (const uint32_t index :
             { attributes.position, attributes.normal, attributes.tangent, attributes.color, attributes.frame })
            accessor(index);
        for (const uint32_t index : attributes.uv) accessor(index);
        for (const uint32_t index : attributes.joints) accessor(index);
        for (const uint32_t index : attributes.weights) accessor(index);
    }

    void accessor(uint32_t index) {
        if (!mark(GltfArray::Accessors, index)) return;
        GltfAccessor const& accessor = mDocument.accessors[index];
        view(accessor.view);
        if (!accessor.sparse) return;
        view(accessor.sparse->indicesView);
        view(accessor.sparse->valuesView);
    }

    void view(uint32_t index) {
        if (!mark(GltfArray::Views, index)) return;
        GltfBufferView const& view = mDocument.views[index];
        mark(GltfArray::Buffers, view.meshopt ? view.meshopt->buffer : view.buffer);
    }

    void image(uint32_t index) {
        if (mark(GltfArray::Images, index)) view(mDocument.images[index].view);
    }

    void texture(GltfTextureInfo const& info) {
        if (!mark(GltfArray::Textures, info.texture)) return;
        mark(GltfArray::Samplers, mDocument.textures[info.texture].sampler);
        image(mDocument.textures[info.texture].image);
        image(mDocument.textures[info.texture].openness);
    }

    void material(uint32_t index) {
        if (!mark(GltfArray::Materials, index)) return;
        GltfMaterial& material = mDocument.materials[index];
        for (TexturePath const& path : texturePaths()) texture(*textureInfoOf(material, path.map));
        texture(material.specularGlossiness);
    }

    /// Joints count with all that is above and below them, which poses them and comes with them.
    void joints() {
        std::vector<uint32_t> parents(mDocument.nodes.size(), kNone), tops;
        for (uint32_t i = 0; i < mDocument.nodes.size(); ++i) {
            for (const uint32_t child : mDocument.nodes[i].children) {
                if (child != kNone && parents[child] == kNone) parents[child] = i;
            }
        }
        std::vector<bool> isAbove(mDocument.nodes.size(), false);
        for (uint32_t i = 0; i < mDocument.skins.size(); ++i) {
            if (!mUse.has(GltfArray::Skins, i)) continue;
            for (uint32_t at : mDocument.skins[i].joints) {
                for (; at != kNone && !isAbove[at]; at = parents[at]) {
                    isAbove[at] = true;
                    if (parents[at] == kNone) tops.push_back(at);
                }
                if (at != kNone) tops.push_back(at); // of a cycle; of others it is marked already
            }
        }
        while (!tops.empty()) {
            const uint32_t top = tops.back();
            tops.pop_back();
            if (!mark(GltfArray::Nodes, top)) continue;
            std::vector<uint32_t> const& children = mDocument.nodes[top].children;
            tops.insert(tops.end(), children.begin(), children.end());
        }
    }

    bool moves(GltfAnimationChannel const& channel) const {
        if (channel.path != AnimationPath::Property)
            return isReached(GltfArray::Nodes, channel.node) || isReached(GltfArray::Meshes, channel.mesh);
        switch (channel.property.owner) {
        case PropertyOwner::Node:
            return isReached(GltfArray::Nodes, channel.property.object);
        case PropertyOwner::Material:
            return isReached(GltfArray::Materials, channel.property.object);
        case PropertyOwner::Light:
            return isReached(GltfArray::Lights, channel.property.object);
        case PropertyOwner::Camera:
            break;
        }
        return isReached(GltfArray::Cameras, channel.property.object);
    }

    void animation(uint32_t index) {
        GltfAnimation& animation = mDocument.animations[index];
        for (GltfAnimationChannel& channel : animation.channels) {
            channel.isReached = moves(channel);
            if (!channel.isReached) continue;
            mark(GltfArray::Animations, index);
            if (channel.sampler == kNone) continue;
            accessor(animation.samplers[channel.sampler].input);
            accessor(animation.samplers[channel.sampler].output);
        }
    }

    GltfDocument& mDocument;
    GltfUse& mUse;
    std::vector<uint32_t> mOpen;
};

void leaveOut(GltfFault const& fault, GltfDocument& document) {
    const auto clear = [&](auto& array) { array[fault.index] = {}; };
    switch (fault.array) {
    case GltfArray::Buffers:
        return clear(document.buffers);
    case GltfArray::Views:
        return clear(document.views);
    case GltfArray::Accessors:
        return clear(document.accessors);
    case GltfArray::Meshes:
        return clear(document.meshes);
    case GltfArray::Nodes:
        return clear(document.nodes);
    case GltfArray::Skins:
        return clear(document.skins);
    case GltfArray::Images:
        return clear(document.images);
    case GltfArray::Samplers:
        return clear(document.samplers);
    case GltfArray::Materials:
        return clear(document.materials);
    case GltfArray::Textures:
        return clear(document.textures);
    case GltfArray::Lights:
        return clear(document.lights);
    case GltfArray::Cameras:
        return clear(document.cameras);
    case GltfArray::Profiles:
        return clear(document.profiles);
    case GltfArray::ImageBasedLights:
        return clear(document.imageBasedLights);
    case GltfArray::Variants:
        return clear(document.variants);
    case GltfArray::Animations:
        return clear(document.animations);
    }
}

void warnUnused(Error const& error, Diagnostics& diagnostics) {
    diagnostics.warn("{}; nothing that is drawn uses it, and it is left out", error.message);
}

} // namespace

void findUse(GltfDocument& document) { Reach(document).scene(); }

void settleFaults(std::vector<GltfFault> const& faults, GltfDocument& document, Diagnostics& diagnostics) {
    for (GltfFault const& fault : faults) {
        if (document.use.has(fault.array, fault.index)) return diagnostics.refuse(fault.error);
    }
    for (GltfFault const& fault : faults) {
        warnUnused(fault.error, diagnostics);
        leaveOut(fault, document);
    }
}

void settle(Diagnostics found, bool isReached, Diagnostics& diagnostics) {
    if (isReached || found.ok()) return diagnostics.merge(std::move(found));
    warnUnused(found.error(), diagnostics);
}

} // namespace filament_core::assets
