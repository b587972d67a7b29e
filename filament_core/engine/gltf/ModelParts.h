// SPDX-License-Identifier: Apache-2.0
/// ModelParts: animated properties of a copy of a model other than its nodes (KHR_animation_pointer), and its visible
/// parts are shown, which levels of detail decide as well (MSFT_lod).
///   In      values of the model's animated properties.
///   Out     materials that the copy shares with no other one, lights, cameras, and which parts are shown.
///   Thread  app.   Fails: std::bad_alloc.
///   Memory  the data of the materials of a model that has animated properties. Lights, cameras and what is shown are
///           kept with the copy, for all animators and for levels of detail.
///   Cost    a change of a material: its parameters are derived again, as at loading, so that a copy at some time has
///           the bits of a file with these values. Once all properties have moved, nothing is allocated.
#pragma once

#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/gltf/GltfMaterialSettings.h"
#include "filament_core/engine/gltf/ModelImpl.h"
#include "filament_core/prepare/ScreenCoverage.h"

#include <span>
#include <vector>

namespace filament_core::engine {

class ModelParts {
public:
    /// `model` and `scene` outlive it. `root`: of a copy of the model.
    ModelParts(Model::Impl const& model, Scene::Impl& scene, Node root);

    /// Shows the values of the properties with a mark; both parallel to Model::Impl::properties. The copy is left alone
    /// where the program removed parts of it.
    void write(std::span<const float4> values, std::span<const uint8_t> isMoved);

private:
    void writeMaterial(size_t animated, std::span<const float4> values, std::span<const uint8_t> isMoved);
    void writeLights(std::span<const uint8_t> isMoved);

    Model::Impl const& mModel;
    Scene::Impl& mScene;
    Node mRoot;
    std::vector<assets::MaterialData> mMaterials; // parallel to the animated materials of the model
    GltfParameters mParameters;                   // of the material that is written
};

/// Whether a material has what the property changes: maps can be left out.
bool hasTarget(GltfMaterialSettings const& settings, assets::AnimatedProperty const& property);

/// Model::Impl::mayChange, from what else the model has.
void findChangingNodes(Model::Impl& model);

/// Renderables and lights of nodes that ShownParts shows are shown, those of others are not; the program keeps what no
/// animation and no level of detail changes.
void showParts(Model::Impl const& model, Scene::Impl& scene, CopyOfModel& copy);

/// Which nodes of a new copy picks pass through: as in the file. Skinned meshes follow the nodes of the file.
void setPickRules(Model::Impl const& model, Scene::Impl& scene, std::span<const Node> nodes);

/// Hides parts of a new copy that are invisible at rest.
void hideAsInFile(Model::Impl const& model, Scene::Impl& scene, Node root);

/// ModelCopy::chooseLevels().
void chooseLevels(Model::Impl const& model, Scene::Impl& scene, CopyOfModel& copy, prepare::CoverageLens const& lens,
                  double bias);

} // namespace filament_core::engine
