// SPDX-License-Identifier: Apache-2.0
// What the numbers in AOVs of ids name: objects, materials, material instances.
#include "filament_core/engine/WhatIsShown.h"
#include "python/SceneParts.h"

#include <filament_core/RenderAovs.h>

#include <algorithm>

namespace filament_core::python {
namespace {

/// What an id names, as Python sees it.
struct Identified {
    uint32_t id = 0;
    std::string name{};
    py::object part = py::none(); ///< that Python holds
    bool isLight = false;
    uint32_t primitive = 0;
    std::string material{}, instance{};
};

constexpr std::array kIdAovs{ Aov::ObjectId, Aov::MaterialId, Aov::MaterialInstanceId };

Aov idAovOf(std::string const& name) {
    const std::optional<Aov> aov = enumFromName<Aov>(name);
    if (!aov || std::ranges::find(kIdAovs, *aov) == kIdAovs.end())
        raiseInvalid("aov: '{}' is not objectId, materialId or materialInstanceId", name);
    return *aov;
}

/// None if Python holds it no more.
template <class Part, class Handle>
std::shared_ptr<Part> heldPart(std::map<uint32_t, std::weak_ptr<Part>> const& parts, Handle handle,
                               Handle Part::*member) {
    const auto found = parts.find(handle.index());
    std::shared_ptr<Part> part = found == parts.end() ? nullptr : found->second.lock();
    return part && (*part).*member == handle ? part : nullptr;
}

/// The copy of a model that the node belongs to.
std::shared_ptr<CopyObject> copyAbove(SceneContent const& scene, Node node) {
    for (; node; node = scene.parent(node))
        if (std::shared_ptr<CopyObject> copy = heldPart(scene.copies, node, &CopyObject::root)) return copy;
    return nullptr;
}

std::optional<Identified> objectAt(SceneContent const& scene, uint32_t id) {
    const PickHit hit = objectOf(scene, id);
    if (!hit) return std::nullopt;
    Identified found{ .id = id,
                      .name = engine::nameAbove(scene, hit.node),
                      .isLight = static_cast<bool>(hit.light),
                      .primitive = hit.primitive };
    if (scene::MaterialInstance const* const shown = engine::shownInstance(scene, hit.renderable)) {
        found.material = shown->material->name;
        found.instance = shown->name;
    }
    if (hit.light) {
        if (auto light = heldPart(scene.lights, hit.light, &LightObject::light)) found.part = py::cast(light);
    } else if (auto shape = heldPart(scene.shapes, hit.renderable, &ShapeObject::renderable)) {
        found.name = shape->name;
        found.part = py::cast(shape);
    } else if (auto copy = copyAbove(scene, hit.node)) {
        found.part = py::cast(copy);
    }
    return found;
}

std::optional<Identified> materialAt(SceneObject const& scene, uint32_t id) {
    scene::Material const* const state = engine::materialAt(*scene, id);
    if (!state) return std::nullopt;
    Identified found{ .id = id, .name = state->name, .material = state->name };
    const auto is = [&](OwnedMaterial const& held) {
        return &scene->impl().engine.materials.get(held.material) == state;
    };
    if (auto part = scene.owner()->find<MaterialObject>(is)) found.part = py::cast(part);
    return found;
}

std::optional<Identified> instanceAt(SceneObject const& scene, uint32_t id) {
    scene::MaterialInstance const* const state = engine::instanceAt(*scene, id);
    if (!state) return std::nullopt;
    Identified found{ .id = id, .name = state->name, .material = state->material->name, .instance = state->name };
    const auto is = [&](OwnedInstance const& held) {
        return &scene->impl().engine.instances.get(held.instance) == state;
    };
    if (auto part = scene.owner()->find<InstanceObject>(is)) found.part = py::cast(part);
    return found;
}

std::optional<Identified> identified(SceneObject const& scene, Aov aov, uint32_t id) {
    if (aov == Aov::MaterialId) return materialAt(scene, id);
    return aov == Aov::MaterialInstanceId ? instanceAt(scene, id) : objectAt(*scene, id);
}

std::optional<Identified> identifiedOne(SceneObject const& scene, Aov aov, int64_t id) {
    const Owner::Call call(*scene.owner());
    if (id < 0 || id > (1 << 24)) raiseInvalid("id: {} is not from 0 to 2^24", id);
    return identified(scene, aov, static_cast<uint32_t>(id));
}

/// Each once, in order.
std::vector<uint32_t> distinct(std::vector<uint32_t> ids) {
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end()); // neighbours are mostly of one object
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

py::dict identify(SceneObject const& scene, py::object const& image, std::string const& aov) {
    const Owner::Call call(*scene.owner());
    const Aov kind = idAovOf(aov);
    py::dict found;
    for (const uint32_t id : distinct(idsOf(image, "image").ids))
        if (std::optional<Identified> one = identified(scene, kind, id)) found[py::int_(id)] = py::cast(*one);
    return found;
}

/// Raises for what images of this kind do not have.
void checkPart(py::object const& part, Aov aov) {
    const bool fits = aov == Aov::ObjectId ? py::isinstance<ShapeObject>(part) || py::isinstance<CopyObject>(part) ||
                                                     py::isinstance<LightObject>(part)
                      : aov == Aov::MaterialId ? py::isinstance<MaterialObject>(part)
                                               : py::isinstance<InstanceObject>(part);
    if (!fits)
        raiseInvalid("part: give a number, a name, or {}, which images of {} show",
                     aov == Aov::ObjectId     ? "a Shape, a ModelCopy or a Light"
                     : aov == Aov::MaterialId ? "a Material"
                                              : "a MaterialInstance",
                     toString(aov));
}

/// Whether an id is of the part.
class PartFilter {
public:
    PartFilter(py::object const& part, Aov aov) : mPart(part) {
        if (py::isinstance<py::str>(part)) {
            mName = part.cast<std::string>();
        } else if (PyIndex_Check(part.ptr()) && !py::isinstance<py::bool_>(part) && !py::isinstance<py::array>(part)) {
            const long long id = PyLong_AsLongLong(py::int_(part).ptr());
            if (PyErr_Occurred()) PyErr_Clear(), raiseInvalid("part: the number is too large");
            mId = id;
        } else {
            checkPart(part, aov);
        }
    }
    bool has(Identified const& found) const {
        if (mId) return found.id == *mId;
        return mName ? found.name == *mName : found.part.is(mPart);
    }

private:
    py::object mPart;
    std::optional<std::string> mName;
    std::optional<int64_t> mId;
};

py::array_t<bool> mask(SceneObject const& scene, py::object const& image, py::object const& part,
                       std::string const& aov) {
    const Owner::Call call(*scene.owner());
    const Aov kind = idAovOf(aov);
    const PartFilter filter(part, kind);
    const IdArray numbers = idsOf(image, "image");
    std::vector<uint32_t> shown;
    for (const uint32_t id : distinct(numbers.ids))
        if (const std::optional<Identified> one = identified(scene, kind, id); one && filter.has(*one))
            shown.push_back(id);
    py::array_t<bool> pixels({ py::ssize_t{ numbers.height }, py::ssize_t{ numbers.width } });
    for (size_t i = 0; i < numbers.ids.size(); ++i)
        pixels.mutable_data()[i] = std::ranges::binary_search(shown, numbers.ids[i]);
    return pixels;
}

void bindIdentified(py::module_& module) {
    py::class_<Identified>(module, "Identified",
                           "What a number of an AOV of ids names. From Scene.identify(), object_of(), material_of(), "
                           "material_instance_of().")
            .def_readonly("id", &Identified::id, "The number that names it.")
            .def_readonly("name", &Identified::name,
                          "Of the shape, or of the nearest node with a name; of the material or the instance.")
            .def_readonly("part", &Identified::part,
                          "The Shape, ModelCopy, Light, Material or MaterialInstance itself; None if the program holds "
                          "none: of what a file brought, for example.")
            .def_readonly("is_light", &Identified::isLight, "An area light that is drawn.")
            .def_readonly("primitive", &Identified::primitive, "Which of its node's primitives an object is.")
            .def_readonly("material", &Identified::material, "Name of the material; of a light ''.")
            .def_readonly("material_instance", &Identified::instance,
                          "Name of the material instance: what files call a material.")
            .def("__repr__", [](Identified const& self) {
                return fmt::format("<filament_core.Identified {} '{}'>", self.id, self.name);
            });
}

} // namespace

void bindIds(py::module_& module, SceneClass& scene) {
    bindIdentified(module);
    scene.def(
                 "object_of",
                 [](SceneObject const& self, int64_t id) { return identifiedOne(self, Aov::ObjectId, id); },
                 py::arg("id"), "What a number of objectId names now; None: nothing, or nothing any more.")
            .def(
                    "material_of",
                    [](SceneObject const& self, int64_t id) { return identifiedOne(self, Aov::MaterialId, id); },
                    py::arg("id"), "What a number of materialId names now; None: nothing.")
            .def(
                    "material_instance_of",
                    [](SceneObject const& self, int64_t id) {
                        return identifiedOne(self, Aov::MaterialInstanceId, id);
                    },
                    py::arg("id"), "What a number of materialInstanceId names now; None: nothing.")
            .def("identify", &identify, py::arg("image"), py::kw_only(), py::arg("aov") = "objectId",
                 "All that an image of ids shows: a dict of Identified by number. `image` is an array of "
                 "render_aovs(), "
                 "or whole numbers (height, width).")
            .def("mask", &mask, py::arg("image"), py::arg("part"), py::kw_only(), py::arg("aov") = "objectId",
                 "Where an image of ids shows a part: bools (height, width). `part` is what Identified.part gives, a "
                 "name or a number.");
}

} // namespace filament_core::python
