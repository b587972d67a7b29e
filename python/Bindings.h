// SPDX-License-Identifier: Apache-2.0
/// Bindings: the parts of the extension module, one file each, in the order in which Module.cpp adds them.
#pragma once

#include "python/Arrays.h"
#include "python/Owner.h"

#include <filament_core/Animator.h>
#include <filament_core/Gltf.h>
#include <filament_core/Mesh.h>
#include <filament_core/ModelCopy.h>
#include <filament_core/Renderer.h>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::python {

using ModelObject = Held<Model>;
using EnvironmentObject = Held<Environment>;
using TextureObject = Held<Owned<Texture>>;
using LightImageObject = Held<Owned<LightImage>>;

struct OwnedMaterial {
    Owned<Material> material;
    MaterialDescription description; ///< as it was loaded
};
using MaterialObject = Held<OwnedMaterial>;

struct OwnedInstance {
    Owned<MaterialInstance> instance;
    MaterialDescription description; ///< of its material
};
using InstanceObject = Held<OwnedInstance>;

/// Triangles on the device, and the arrays that they are of.
struct OwnedMesh {
    Owned<VertexBuffer> vertices;
    Owned<IndexBuffer> indices;
    Mesh given;                  ///< normals may be computed, tangents are not used
    bool hasNormals = true;      ///< that were given
    std::vector<uint32_t> drawn; ///< the indices on the device: vertices where mirrored textures meet are split
    uint32_t vertexCount = 0;    ///< on the device
};
using MeshObject = Held<OwnedMesh>;

struct ShapeObject;
struct LightObject;
struct CopyObject;

/// A scene, and what Python holds of its parts, by the index of each handle.
struct SceneContent : Scene {
    SceneContent(Scene&& scene) : Scene(std::move(scene)) {}

    std::map<uint32_t, std::weak_ptr<ShapeObject>> shapes;
    std::map<uint32_t, std::weak_ptr<LightObject>> lights;
    std::map<uint32_t, std::weak_ptr<CopyObject>> copies; ///< by their root
};
using SceneObject = Held<SceneContent>;

/// The engine as Python sees it. Nothing else of an engine refers to this object, only to its owner.
struct EngineObject {
    std::shared_ptr<Owner> owner;
};

/// The view of an image, and what it refers to.
struct ViewObject {
    View view;
    std::shared_ptr<TextureObject> dirt;                                       ///< of Effects::bloom; null: none
    std::vector<std::pair<std::shared_ptr<InstanceObject>, PassPlace>> passes; ///< View::postProcess
};

using EngineClass = py::class_<EngineObject>;

void bindView(py::module_& module);
EngineClass bindEngine(py::module_& module);
void bindMaterials(py::module_& module, EngineClass& engine);
void bindMeshes(py::module_& module, EngineClass& engine);
void bindScene(py::module_& module);
void bindRenderer(py::module_& module);
void bindCompare(py::module_& module);

/// Counts under their names.
py::dict dictOfCounts(std::initializer_list<std::pair<const char*, uint64_t>> counts);
/// name, type and array_size of each.
py::list listOf(std::span<const ParameterDescription> parameters);

/// A value of a parameter of this type from a bool, a number, or a (nested) sequence of numbers.
ParameterValue parameterOf(ParameterDescription const& parameter, py::handle value);
/// Of samplers by name: filter "nearest", "bilinear" or "trilinear"; wrap "repeat", "mirror" or "clamp".
Sampler samplerOf(std::string const& filter, std::string const& wrap, int anisotropy);

} // namespace filament_core::python
