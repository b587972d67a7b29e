// SPDX-License-Identifier: Apache-2.0
#include "tools/view/stage/StagedScene.h"

#include "filament_core/engine/gltf/ModelImpl.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::view {
namespace {

/// Lists of the same length whose elements agree as `isSame` says.
template <class T, class IsSame>
bool areSame(std::vector<T> const& a, std::vector<T> const& b, IsSame const& isSame) {
    return std::ranges::equal(a, b, isSame);
}

bool editsSameParameters(Document const& a, Document const& b) {
    return areSame(a.materials, b.materials, [](MaterialEdit const& x, MaterialEdit const& y) {
        return x.material == y.material && x.parameter == y.parameter && x.value.index() == y.value.index();
    });
}

bool hasSameLights(Document const& a, Document const& b) {
    return areSame(a.lights, b.lights, [](DocumentLight const& x, DocumentLight const& y) {
        return x.isOn == y.isOn && x.profileFile == y.profileFile && x.light.index() == y.light.index();
    });
}

/// Of probes and grids: the same ones are there.
bool hasSameProbes(Document const& a, Document const& b) {
    const auto isSame = [](auto const& x, auto const& y) { return x.isOn == y.isOn && x.file == y.file; };
    return areSame(a.probes, b.probes, isSame) && areSame(a.grids, b.grids, isSame);
}

std::vector<uint32_t> modelLightsOff(Document const& document) {
    std::vector<uint32_t> off;
    for (ModelLightEdit const& edit : document.modelLights) {
        if (!edit.isOn) off.push_back(edit.light);
    }
    std::ranges::sort(off);
    return off;
}

LightProfile profileOf(LightDesc const& any) {
    return std::visit(
            [](auto const& light) {
                if constexpr (requires { light.profile; })
                    return light.profile;
                else
                    return LightProfile{};
            },
            any);
}

LightDesc withProfileHandle(LightDesc any, LightProfile profile) {
    std::visit(
            [&](auto& light) {
                if constexpr (requires { light.profile; }) light.profile = profile;
            },
            any);
    return any;
}

/// Of a copy, parents first.
void addBelow(Scene const& scene, Node node, std::vector<Node>& nodes) {
    nodes.push_back(node);
    for (Node child = scene.firstChild(node); child; child = scene.nextSibling(child)) addBelow(scene, child, nodes);
}

} // namespace

StagedScene::StagedScene(Engine& engine, LoadedModel* model, Profiles const& profiles, LoadedTextures const& textures,
                         LoadedProbes const& probes, Document const& document, Messages& messages)
        : mEngine(engine), mModel(model), mLoadedProbes(probes), mScene(engine) {
    placeModel(document);
    if (mRoot) recordFile();
    if (mCopy && !document.model.variant.empty()) messages.addOnce(mCopy->setVariant(document.model.variant));
    setMaterials(document, messages);
    setTextures(document, textures, messages);
    setModelLights(document, messages);
    setVisibility(document, messages);
    setPose(document, messages);
    addLights(document, profiles);
    addProbes(document);
}

void StagedScene::placeModel(Document const& document) {
    if (!mModel) return;
    const double4x4 place = document.model.fit ? fitToUnitCube(mModel->bounds()) : double4x4(1.0);
    if (Model const* model = mModel->model()) {
        mRoot = mScene.add(*model, place);
        Result<ModelCopy> copy = ModelCopy::of(mScene, mRoot);
        if (copy) mCopy = std::move(*copy);
        if (model->animationCount() > 0) mAnimator.emplace(*model, mScene, mRoot);
    } else if (LoadedMaterial const* material = mModel->material()) {
        mRoot = material->stand.addTo(mScene, place);
    }
}

void StagedScene::recordFile() {
    if (mCopy)
        mNodes = mCopy->nodes();
    else
        addBelow(mScene, mRoot, mNodes);
    for (const Node node : mNodes) {
        mIndices.emplace(node, static_cast<uint32_t>(mIndices.size()));
        mNodesOfFile.push_back(mScene.parentFromNode(node));
    }
    if (!mCopy) return;
    mModelLights = mCopy->lights();
    for (Model::Impl::PartLight const& part : mModel->model()->share()->lights)
        std::visit([&](auto const& light) { mLightsOfFile.emplace_back(light); }, part.light);
    for (CopyMorphTarget const& target : mCopy->morphTargets()) {
        if (mMorphs.empty() || mMorphs.back().renderable != target.renderable)
            mMorphs.push_back({ .renderable = target.renderable, .weights = {} });
        mMorphs.back().weights.push_back(target.weight);
    }
}

bool StagedScene::needsAnother(Document const& from, Document const& to) {
    return from.model.fit != to.model.fit || from.model.variant != to.model.variant || !editsSameParameters(from, to) ||
           from.textures != to.textures || !hasSameLights(from, to) || !hasSameProbes(from, to) ||
           modelLightsOff(from) != modelLightsOff(to);
}

void StagedScene::update(Document const& from, Document const& to, Messages& messages) {
    if (from.materials != to.materials) setMaterials(to, messages);
    if (from.modelLights != to.modelLights) setModelLights(to, messages);
    if (from.nodes != to.nodes) setVisibility(to, messages);
    const bool isMoved = from.playback.animation != to.playback.animation ||
                         (to.playback.animation && from.playback.seconds != to.playback.seconds);
    if (isMoved || from.nodes != to.nodes || from.morphs != to.morphs) setPose(to, messages);
    for (size_t i = 0; i < mLights.size(); ++i) {
        if (!mLights[i] || from.lights[i] == to.lights[i]) continue;
        mDocumentLights[i] = withProfileHandle(to.lights[i].light, profileOf(mDocumentLights[i]));
        mScene.set(mLights[i], mDocumentLights[i]);
    }
    moveProbes(from, to);
}

// ---- lights

LightDesc StagedScene::withProfile(DocumentLight const& light, Profiles const& profiles) const {
    const auto profile = profiles.find(light.profileFile);
    return withProfileHandle(light.light, profile == profiles.end() ? LightProfile{} : profile->second.get());
}

void StagedScene::addLights(Document const& document, Profiles const& profiles) {
    for (DocumentLight const& light : document.lights) {
        mDocumentLights.push_back(withProfile(light, profiles));
        mLights.push_back(light.isOn ? mScene.add(mDocumentLights.back()) : Light{});
    }
}

void StagedScene::setModelLights(Document const& document, Messages& messages) {
    std::vector<ModelLightEdit const*> edits(mModelLights.size(), nullptr);
    for (ModelLightEdit const& edit : document.modelLights) {
        if (edit.light < edits.size())
            edits[edit.light] = &edit;
        else if (mRoot)
            messages.addOnce(
                    fmt::format("modelLights: there is no light {}; the model has {}", edit.light, edits.size()));
    }
    for (size_t i = 0; i < edits.size(); ++i) {
        CopyLight& light = mModelLights[i];
        if (edits[i] && !edits[i]->isOn) {
            if (light.light) mScene.remove(light.light);
            light.light = {};
        } else if (light.light) {
            const bool isReplaced = edits[i] && edits[i]->replacement;
            LightDesc const& ofFile = mLightsOfFile[i];
            mScene.set(light.light, isReplaced ? withProfileHandle(*edits[i]->replacement, profileOf(ofFile)) : ofFile);
        }
    }
}

// ---- probes and grids

void StagedScene::addProbes(Document const& document) {
    for (DocumentProbe const& probe : document.probes) {
        const std::optional<ReflectionProbeDesc> desc = mLoadedProbes.find(probe);
        mProbes.push_back(desc ? mScene.add(*desc) : ReflectionProbe{});
    }
    for (DocumentGrid const& grid : document.grids) {
        const std::optional<IrradianceGridDesc> desc = mLoadedProbes.find(grid);
        mGrids.push_back(desc ? mScene.add(*desc) : IrradianceGrid{});
    }
}

void StagedScene::moveProbes(Document const& from, Document const& to) {
    for (size_t i = 0; i < mProbes.size(); ++i) {
        if (!mProbes[i] || from.probes[i] == to.probes[i]) continue;
        if (const auto desc = mLoadedProbes.find(to.probes[i])) mScene.set(mProbes[i], *desc);
    }
    for (size_t i = 0; i < mGrids.size(); ++i) {
        if (!mGrids[i] || from.grids[i] == to.grids[i]) continue;
        if (const auto desc = mLoadedProbes.find(to.grids[i])) mScene.set(mGrids[i], *desc);
    }
}

// ---- materials

Result<void> StagedScene::setMaterial(MaterialEdit const& edit) {
    if (mCopy) return mCopy->set(edit.material, edit.parameter, edit.value);
    LoadedMaterial const* material = mModel->material();
    if (edit.material != material->file->name)
        return fail(ErrorCode::NotFound, "there is no material '{}'; it is called '{}'", edit.material,
                    material->file->name);
    return mEngine.set(material->stand.instance(), edit.parameter, edit.value);
}

void StagedScene::setMaterials(Document const& document, Messages& messages) {
    if (!mRoot) return;
    if (LoadedMaterial const* material = mModel->material()) { // its instance outlives the scene
        for (auto const& [name, value] : material->values)
            messages.addOnce(mEngine.set(material->stand.instance(), name, value));
    }
    for (MaterialEdit const& edit : document.materials) messages.addOnce(setMaterial(edit));
}

Result<void> StagedScene::setTexture(TextureEdit const& edit, Texture texture) {
    if (mCopy) return mCopy->set(edit.material, edit.parameter, texture);
    LoadedMaterial const* material = mModel->material();
    if (edit.material != material->file->name)
        return fail(ErrorCode::NotFound, "there is no material '{}'; it is called '{}'", edit.material,
                    material->file->name);
    return mEngine.set(material->stand.instance(), edit.parameter, texture, Sampler{});
}

/// Those that are there: the others come with another scene.
void StagedScene::setTextures(Document const& document, LoadedTextures const& textures, Messages& messages) {
    if (!mRoot) return;
    if (LoadedMaterial const* material = mModel->material())
        view::setTextures(mEngine, material->stand.instance(), material->textures);
    for (TextureEdit const& edit : document.textures)
        if (const Texture texture = textures.find(edit)) messages.addOnce(setTexture(edit, texture));
}

std::vector<CopyMaterial> StagedScene::materials() const {
    if (mCopy) return mCopy->materials();
    LoadedMaterial const* material = mModel ? mModel->material() : nullptr;
    if (!material) return {};
    return { { .name = material->file->name,
               .instance = material->stand.instance(),
               .material = material->stand.material(),
               .isOwn = true,
               .renderables = 1 } };
}

// ---- nodes, animation, morph targets

void StagedScene::setVisibility(Document const& document, Messages& messages) {
    if (!mRoot) return;
    mScene.setVisible(mRoot, true);
    for (NodeEdit const& edit : document.nodes) {
        if (edit.node >= mNodes.size())
            messages.addOnce(fmt::format("nodes: there is no node {}; the model has {}", edit.node, mNodes.size()));
        else if (!edit.isVisible)
            mScene.setVisible(mNodes[edit.node], false);
    }
}

/// From the pose of the file on: first the animation, then the edits over it.
void StagedScene::setPose(Document const& document, Messages& messages) {
    if (!mRoot) return;
    if (mAnimator) mAnimator->rest();
    for (size_t i = 0; i < mNodes.size(); ++i) {
        if (mScene.parentFromNode(mNodes[i]) != mNodesOfFile[i]) mScene.setTransform(mNodes[i], mNodesOfFile[i]);
    }
    for (Morph const& morph : mMorphs) mScene.setMorphWeights(morph.renderable, morph.weights);
    Playback const& playback = document.playback;
    if (playback.animation) {
        const uint32_t count = mAnimator ? mModel->model()->animationCount() : 0;
        if (*playback.animation < count)
            mAnimator->apply(*playback.animation, playback.seconds);
        else
            messages.addOnce(
                    fmt::format("playback: there is no animation {}; the model has {}", *playback.animation, count));
    }
    for (NodeEdit const& edit : document.nodes) {
        if (edit.node < mNodes.size() && edit.parentFromNode)
            mScene.setTransform(mNodes[edit.node], *edit.parentFromNode);
    }
    for (MorphEdit const& edit : document.morphs) {
        if (mCopy) messages.addOnce(mCopy->setMorphWeight(edit.target, edit.weight));
    }
}

std::optional<uint32_t> StagedScene::indexOf(Node node) const {
    for (; node; node = mScene.parent(node)) {
        const auto found = mIndices.find(node);
        if (found != mIndices.end()) return found->second;
    }
    return std::nullopt;
}

// ---- environment

void StagedScene::setEnvironment(Environment const* environment, EnvironmentSettings const& settings) {
    if (environment) return mScene.setEnvironment(*environment, settings);
    mScene.setIndirectLight({}, Lux{ 0 });
    mScene.setSkybox({}, Lux{ 0 });
}

} // namespace filament_core::view
