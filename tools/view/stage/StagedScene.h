// SPDX-License-Identifier: Apache-2.0
/// StagedScene: a scene with what a document shows: a copy of the model, the lights, the environment, and all edits.
///   In      what is loaded, which must outlive it and stay where it is, and the document.
///   Update  values change in place. What makes another list, or ends an edit of a material, needs a new StagedScene:
///           needsAnother(). So a scene is a function of the document alone, not of those before.
///   Thread  that of the engine.
///   Fails   edits of what is not there: a message, once.
#pragma once

#include "tools/view/document/Document.h"
#include "tools/view/stage/Loaded.h"
#include "tools/view/stage/LoadedProbes.h"
#include "tools/view/stage/LoadedTextures.h"
#include "tools/view/stage/Messages.h"

#include <filament_core/Animator.h>
#include <filament_core/ModelCopy.h>
#include <filament_core/Scene.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::view {

/// Light profiles by their file.
using Profiles = std::map<std::filesystem::path, Owned<LightProfile>>;

class StagedScene {
public:
    StagedScene(Engine& engine, LoadedModel* model, Profiles const& profiles, LoadedTextures const& textures,
                LoadedProbes const& probes, Document const& document, Messages& messages);
    ~StagedScene() = default;
    StagedScene(StagedScene const&) = delete;
    StagedScene& operator=(StagedScene const&) = delete;

    static bool needsAnother(Document const& from, Document const& to);
    /// `to` needs no other scene. Does only what differs.
    void update(Document const& from, Document const& to, Messages& messages);
    /// Null: none.
    void setEnvironment(Environment const* environment, EnvironmentSettings const& settings);

    Scene& scene() { return mScene; }
    ModelCopy const* copy() const { return mCopy ? &*mCopy : nullptr; }
    /// Of things with levels of detail: those of this view.
    void chooseLevels(View const& view) {
        if (mCopy) mCopy->chooseLevels(view);
    }
    Node root() const { return mRoot; }
    std::vector<Node> const& nodes() const { return mNodes; }
    std::optional<uint32_t> indexOf(Node node) const;
    double4x4 const& nodeOfFile(uint32_t node) const { return mNodesOfFile.at(node); }
    LightDesc const& lightOfFile(uint32_t light) const { return mLightsOfFile.at(light); }
    std::vector<CopyLight> const& modelLights() const { return mModelLights; }
    std::vector<Light> const& documentLights() const { return mLights; }
    std::vector<CopyMaterial> materials() const;

private:
    struct Morph {
        Renderable renderable;
        std::vector<float> weights; ///< of the file
    };

    void placeModel(Document const& document);
    void recordFile();
    void addLights(Document const& document, Profiles const& profiles);
    void addProbes(Document const& document);
    void moveProbes(Document const& from, Document const& to);
    void setMaterials(Document const& document, Messages& messages);
    void setModelLights(Document const& document, Messages& messages);
    void setVisibility(Document const& document, Messages& messages);
    void setPose(Document const& document, Messages& messages);
    Result<void> setMaterial(MaterialEdit const& edit);
    void setTextures(Document const& document, LoadedTextures const& textures, Messages& messages);
    Result<void> setTexture(TextureEdit const& edit, Texture texture);
    LightDesc withProfile(DocumentLight const& light, Profiles const& profiles) const;

    Engine& mEngine;
    LoadedModel* mModel; ///< null: nothing
    LoadedProbes const& mLoadedProbes;
    Scene mScene;
    Node mRoot{};
    std::optional<ModelCopy> mCopy;
    std::optional<Animator> mAnimator; ///< if the model has animations
    std::vector<Node> mNodes;
    std::map<Node, uint32_t> mIndices; ///< of mNodes
    std::vector<double4x4> mNodesOfFile;
    std::vector<CopyLight> mModelLights; ///< without a handle: off
    std::vector<LightDesc> mLightsOfFile;
    std::vector<Morph> mMorphs;
    std::vector<LightDesc> mDocumentLights; ///< with their profiles
    std::vector<Light> mLights;             ///< of them; none: off
    std::vector<ReflectionProbe> mProbes;   ///< of the document; none: off, or without light
    std::vector<IrradianceGrid> mGrids;
};

} // namespace filament_core::view
