// SPDX-License-Identifier: Apache-2.0
// Copies of models in a scene: their materials, variants, animations and cameras.
#include "base/Suggest.h"
#include "python/SceneParts.h"

#include <utility>

namespace filament_core::python {
namespace {

std::shared_ptr<CopyObject> addModel(std::shared_ptr<SceneObject> const& self,
                                     std::shared_ptr<ModelObject> const& model, py::object const& transform, bool fit) {
    const Owner::Call call(*self->owner());
    requireSame(*self->owner(), *model, "model");
    double4x4 worldFromModel = transformOf(transform, "transform");
    if (fit) worldFromModel = worldFromModel * fitToUnitCube((*model)->bounds());
    const Node root = (*self)->add(**model, worldFromModel);
    if (!root) raise({ ErrorCode::OutOfMemory, "there is no memory for another copy" });
    auto animator = std::make_shared<Held<Animator>>(self->owner(), Animator(**model, **self, root));
    auto copy = std::make_shared<CopyObject>(CopyObject{ self, model, root, std::move(animator) });
    (*self)->copies[root.index()] = copy;
    return copy;
}

template <class Items>
py::list namesIn(Items const& items) {
    py::list names;
    for (auto const& item : items) names.append(item.name);
    return names;
}

/// What the material of that name declares.
MaterialDescription const& describe(Engine& engine, ModelCopy const& parts, std::string const& name) {
    const std::vector<CopyMaterial> materials = parts.materials();
    for (CopyMaterial const& material : materials)
        if (material.name == name) return engine.describe(material.material);
    const std::vector<std::string_view> names = namesOf(materials);
    raise(fail(ErrorCode::NotFound, "the copy is drawn with no material '{}'{}", name, suggestion(name, names)));
}

py::list parametersOf(CopyObject const& self, std::string const& material) {
    const Owner::Call call(*self.scene->owner());
    return listOf(describe(call.engine(), self.parts(), material).parameters);
}

void setParameter(CopyObject const& self, std::string const& material, std::string const& name,
                  py::object const& value) {
    const Owner::Call call(*self.scene->owner());
    ModelCopy parts = self.parts();
    if (py::isinstance<TextureObject>(value)) {
        auto const& texture = value.cast<TextureObject const&>();
        requireSame(*self.scene->owner(), texture, "texture");
        return check(parts.set(material, name, texture->get()));
    }
    ParameterDescription const* parameter = describe(call.engine(), parts, material).findParameter(name);
    if (!parameter) return check(parts.set(material, name, ParameterValue(0.0f))); // names what is near
    check(parts.set(material, name, parameterOf(*parameter, value)));
}

/// By its name or its number.
uint32_t animationOf(Model const& model, py::object const& given) {
    if (py::isinstance<py::str>(given)) return valueOf(model.findAnimation(given.cast<std::string>()));
    const Py_ssize_t number = PyNumber_AsSsize_t(given.ptr(), PyExc_OverflowError);
    if (number == -1 && PyErr_Occurred()) raiseInvalid("animation: give a name or a whole number");
    if (number < 0 || number >= static_cast<Py_ssize_t>(model.animationCount()))
        raiseInvalid("animation: {} is not below {}, the number of the model's", number, model.animationCount());
    return static_cast<uint32_t>(number);
}

void animate(CopyObject const& self, py::object const& animation, double seconds) {
    const Owner::Call call(*self.scene->owner());
    self.live();
    Model const& model = **self.model;
    (*self.animator)->apply(animationOf(model, animation), numberIn(seconds, "seconds", -1e12, 1e12));
}

void useCamera(CopyObject const& self, ViewObject& view, std::string const& name) {
    const Owner::Call call(*self.scene->owner());
    Camera camera = valueOf(self.parts().camera(name));
    camera.exposure = view.view.camera.exposure;
    view.view.camera = camera;
}

using CopyClass = py::class_<CopyObject, std::shared_ptr<CopyObject>>;

void bindLists(CopyClass& copy) {
    copy.def_property_readonly(
                "materials",
                [](CopyObject const& self) {
                    const Owner::Call call(*self.scene->owner());
                    return namesIn(self.parts().materials());
                },
                "The names of the materials that it is drawn with.")
            .def_property_readonly(
                    "cameras",
                    [](CopyObject const& self) {
                        const Owner::Call call(*self.scene->owner());
                        return namesIn(self.parts().cameras());
                    },
                    "The names of its cameras, for use_camera().")
            .def_property_readonly(
                    "morph_targets",
                    [](CopyObject const& self) {
                        const Owner::Call call(*self.scene->owner());
                        return namesIn(self.parts().morphTargets());
                    },
                    "The names of its morph targets, for set_morph_weight().")
            .def("parameters", &parametersOf, py::arg("material"),
                 "name, type and array_size of each parameter of a material.");
}

void bindChanges(CopyClass& copy) {
    copy.def("set", &setParameter, py::arg("material"), py::arg("parameter"), py::arg("value"),
             "Sets a parameter of a material, or one of its samplers to a Texture, for this copy only.")
            .def(
                    "set_variant",
                    [](CopyObject const& self, std::string const& variant) {
                        const Owner::Call call(*self.scene->owner());
                        check(self.parts().setVariant(variant));
                    },
                    py::arg("variant"), "A variant of KHR_materials_variants; '' for the materials of the file.")
            .def(
                    "set_morph_weight",
                    [](CopyObject const& self, std::string const& target, double weight) {
                        const Owner::Call call(*self.scene->owner());
                        const auto value = static_cast<float>(numberIn(weight, "weight", -1e6, 1e6));
                        check(self.parts().setMorphWeight(target, value));
                    },
                    py::arg("target"), py::arg("weight"), "The weight of the morph targets of that name.")
            .def(
                    "set_transform",
                    [](CopyObject const& self, py::object const& transform) {
                        const Owner::Call call(*self.scene->owner());
                        (*self.scene)->setTransform(self.live(), transformOf(transform, "transform"));
                    },
                    py::arg("transform"), "Moves the copy: a 4 x 4 matrix.")
            .def(
                    "set_visible",
                    [](CopyObject const& self, bool visible) {
                        const Owner::Call call(*self.scene->owner());
                        (*self.scene)->setVisible(self.live(), visible);
                    },
                    py::arg("visible"), "Hidden copies are not drawn and cast no shadows.")
            .def("animate", &animate, py::arg("animation"), py::arg("seconds"),
                 "Poses the copy as an animation, by name or number, is at that time.")
            .def("use_camera", &useCamera, py::arg("view").none(false), py::arg("name"),
                 "Gives a view the place and the lens of a camera of the file; the exposure stays.")
            .def(
                    "remove",
                    [](CopyObject& self) {
                        const Owner::Call call(*self.scene->owner());
                        (*self.scene)->remove(self.live());
                        self.root = {};
                        self.animator.reset();
                    },
                    "Takes the copy out of the scene.");
}

} // namespace

void bindModelCopies(py::module_& module, SceneClass& scene) {
    CopyClass copy(module, "ModelCopy", "A copy of a model in a scene. From Scene.add().");
    bindLists(copy);
    bindChanges(copy);
    scene.def(
            "add", &addModel, py::arg("model").none(false), py::kw_only(), py::arg("transform") = py::none(),
            py::arg("fit") = false,
            "Adds a copy of a model; the transform is a 4 x 4 matrix. With fit, its centre moves to the origin and its "
            "largest side becomes 1 first, as filament-render does.");
}

} // namespace filament_core::python
