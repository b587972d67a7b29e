// SPDX-License-Identifier: Apache-2.0
// The scene: meshes, lights and the environment. Models are in ModelCopies.cpp.
#include "python/SceneParts.h"

#include <filament_core/SaveGltf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::python {
namespace {

std::shared_ptr<ShapeObject> addMesh(std::shared_ptr<SceneObject> const& self, std::shared_ptr<MeshObject> const& mesh,
                                     std::shared_ptr<InstanceObject> const& material, py::object const& transform,
                                     bool castsShadows, bool receivesShadows, std::string const& name) {
    const Owner::Call call(*self->owner());
    requireSame(*self->owner(), *mesh, "mesh");
    requireSame(*self->owner(), *material, "material instance");
    constexpr auto bit = [](Attribute attribute) { return 1u << static_cast<uint32_t>(attribute); };
    constexpr uint32_t kOfMeshes =
            bit(Attribute::Position) | bit(Attribute::Tangents) | bit(Attribute::Color) | bit(Attribute::Uv0);
    MaterialDescription const& description = (*material)->description;
    if ((description.requiredAttributes & ~kOfMeshes) != 0)
        raiseInvalid("material '{}' reads vertex attributes besides position, tangents, color and uv0, which meshes of "
                     "Python do not have",
                     description.name);
    if (description.domain != MaterialDomain::Surface)
        raiseInvalid("material '{}' is for post-processing and no surface", description.name);
    const RenderableDesc desc{ .vertices = (*mesh)->vertices,
                               .indices = (*mesh)->indices,
                               .material = (*material)->instance,
                               .worldFromObject = transformOf(transform, "transform"),
                               .castsShadows = castsShadows,
                               .receivesShadows = receivesShadows,
                               .name = name };
    const Renderable renderable = (*self)->add(desc);
    if (!renderable) raise({ ErrorCode::OutOfMemory, "there is no memory for another renderable" });
    auto shape = std::make_shared<ShapeObject>(ShapeObject{ self, mesh, name, renderable });
    (*self)->shapes[renderable.index()] = shape;
    return shape;
}

template <class Desc>
std::shared_ptr<LightObject> addLight(std::shared_ptr<SceneObject> const& self, Desc const& desc) {
    const Owner::Call call(*self->owner());
    const Light light = (*self)->add(desc);
    if (!light) raise({ ErrorCode::OutOfMemory, "there is no memory for another light" });
    auto added = std::make_shared<LightObject>(LightObject{ self, light });
    (*self)->lights[light.index()] = added;
    return added;
}

/// Null without one.
LightImage cookieOf(SceneObject const& self, std::shared_ptr<LightImageObject> const& cookie,
                    std::initializer_list<LightImageShape> shapes) {
    if (!cookie) return {};
    requireSame(*self.owner(), *cookie, "cookie");
    const LightImage image = (*cookie)->get();
    const Owner::Call call(*self.owner());
    const LightImageShape shape = call.engine().describe(image).shape;
    if (std::ranges::find(shapes, shape) == shapes.end())
        raiseInvalid("cookie: its shape is {}, which this kind of light does not have", toString(shape));
    return image;
}

std::shared_ptr<LightObject> addSun(std::shared_ptr<SceneObject> const& self, py::object const& direction,
                                    double illuminance, py::object const& color, double radiusDegrees, bool showsDisc,
                                    bool castsShadows, bool contactShadows,
                                    std::shared_ptr<LightImageObject> const& cookie, double cookieMeters,
                                    py::object const& up) {
    const auto radius = static_cast<float>(numberIn(radiusDegrees, "angular_radius_degrees", 0, 20));
    return addLight(self,
                    SunLight{ .directionWorld = directionOf(direction, "direction"),
                              .illuminance = Lux{ quantityOf(illuminance, "illuminance") },
                              .color = colorOf(color, "color"),
                              .angularRadiusDegrees = radius,
                              .showsDisc = showsDisc,
                              .castsShadows = castsShadows,
                              .contactShadows = contactShadows,
                              .cookie = cookieOf(*self, cookie, { LightImageShape::Tiled }),
                              .cookieMeters = static_cast<float>(numberIn(cookieMeters, "cookie_meters", 1e-3, 1e9)),
                              .upWorld = directionOf(up, "up") });
}

std::shared_ptr<LightObject> addPoint(std::shared_ptr<SceneObject> const& self, py::object const& position,
                                      double intensity, py::object const& color, double range, bool castsShadows,
                                      std::shared_ptr<LightImageObject> const& cookie, py::object const& direction,
                                      py::object const& up) {
    const LightImage image = cookieOf(*self, cookie, { LightImageShape::Octahedron, LightImageShape::Cube });
    return addLight(self, PointLight{ .positionWorld = double3Of(position, "position"),
                                      .intensity = Candela{ quantityOf(intensity, "intensity") },
                                      .color = colorOf(color, "color"),
                                      .rangeMeters = quantityOf(range, "range"),
                                      .castsShadows = castsShadows,
                                      .cookie = image,
                                      .directionWorld = directionOf(direction, "direction"),
                                      .upWorld = directionOf(up, "up") });
}

std::shared_ptr<LightObject> addSpot(std::shared_ptr<SceneObject> const& self, py::object const& position,
                                     py::object const& direction, double intensity, double innerDegrees,
                                     double outerDegrees, py::object const& color, double range, bool castsShadows,
                                     std::shared_ptr<LightImageObject> const& cookie, py::object const& up) {
    constexpr double kRadians = std::numbers::pi / 180;
    const auto outer = static_cast<float>(numberIn(outerDegrees, "outer_degrees", 0.01, 90) * kRadians);
    const auto inner = static_cast<float>(numberIn(innerDegrees, "inner_degrees", 0, 90) * kRadians);
    if (inner >= outer) raiseInvalid("inner_degrees: {} is not below outer_degrees, {}", innerDegrees, outerDegrees);
    return addLight(self, SpotLight{ .positionWorld = double3Of(position, "position"),
                                     .directionWorld = directionOf(direction, "direction"),
                                     .intensity = Candela{ quantityOf(intensity, "intensity") },
                                     .color = colorOf(color, "color"),
                                     .rangeMeters = quantityOf(range, "range"),
                                     .innerConeRadians = inner,
                                     .outerConeRadians = std::min(outer, 1.5707963f),
                                     .castsShadows = castsShadows,
                                     .cookie = cookieOf(*self, cookie, { LightImageShape::Projected }),
                                     .upWorld = directionOf(up, "up") });
}

void setEnvironment(SceneObject const& self, py::object const& source, double illuminance, double rotationDegrees,
                    bool skybox, double groundHeight, double groundLevel, double groundRadius) {
    const Owner::Call call(*self.owner());
    const double turn = numberIn(rotationDegrees, "rotation_degrees", -1e6, 1e6) * std::numbers::pi / 180;
    const EnvironmentSettings settings{ .illuminance = Lux{ quantityOf(illuminance, "illuminance") },
                                        .rotationRadians = static_cast<float>(turn),
                                        .skybox = skybox,
                                        .groundHeightMeters = quantityOf(groundHeight, "ground_height"),
                                        .groundLevelMeters =
                                                static_cast<float>(numberIn(groundLevel, "ground_level", -1e6, 1e6)),
                                        .groundRadiusMeters = quantityOf(groundRadius, "ground_radius") };
    if (source.is_none()) {
        self->setIndirectLight({}, settings.illuminance);
        self->setSkybox({}, settings.illuminance);
    } else if (py::isinstance<EnvironmentObject>(source)) {
        auto const& environment = source.cast<EnvironmentObject const&>();
        requireSame(*self.owner(), environment, "environment");
        self->setEnvironment(*environment, settings);
    } else if (py::isinstance<ModelObject>(source)) {
        auto const& model = source.cast<ModelObject const&>();
        requireSame(*self.owner(), model, "model");
        Environment const* environment = model->environment();
        if (!environment) raise(fail(ErrorCode::NotFound, "model '{}' brings no environment", model->name()));
        self->setEnvironment(*environment, settings);
    } else {
        raiseInvalid("set_environment() takes an Environment, a Model that has one, or None");
    }
}

void bindParts(py::module_& module) {
    py::class_<ShapeObject, std::shared_ptr<ShapeObject>>(module, "Shape", "A mesh in a scene. From Scene.add_mesh().")
            .def_readonly("mesh", &ShapeObject::mesh, "Its triangles.")
            .def_readonly("name", &ShapeObject::name, "As it was added.")
            .def(
                    "set_transform",
                    [](ShapeObject const& self, py::object const& transform) {
                        const Owner::Call call(*self.scene->owner());
                        const Renderable renderable = self.live();
                        (*self.scene)->setTransform(renderable, transformOf(transform, "transform"));
                    },
                    py::arg("transform"), "Moves it: a 4 x 4 matrix.")
            .def(
                    "set_material",
                    [](ShapeObject const& self, std::shared_ptr<InstanceObject> const& material) {
                        const Owner::Call call(*self.scene->owner());
                        requireSame(*self.scene->owner(), *material, "material instance");
                        if ((*material)->description.requiredAttributes >> 4 != 0 ||
                            (*material)->description.domain != MaterialDomain::Surface)
                            raiseInvalid("material '{}' does not fit meshes of Python: see Scene.add_mesh()",
                                         (*material)->description.name);
                        (*self.scene)->setMaterial(self.live(), (*material)->instance);
                    },
                    py::arg("material").none(false), "Draws it with another material.")
            .def(
                    "set_visible",
                    [](ShapeObject const& self, bool visible) {
                        const Owner::Call call(*self.scene->owner());
                        (*self.scene)->setVisible(self.live(), visible);
                    },
                    py::arg("visible"), "Hidden shapes are not drawn and cast no shadows.")
            .def(
                    "remove",
                    [](ShapeObject& self) {
                        const Owner::Call call(*self.scene->owner());
                        (*self.scene)->remove(self.live());
                        self.renderable = {};
                    },
                    "Takes it out of the scene.");
    py::class_<LightObject, std::shared_ptr<LightObject>>(
            module, "Light", "A light in a scene. From Scene.add_sun(), add_point_light(), add_spot_light().")
            .def(
                    "remove",
                    [](LightObject& self) {
                        const Owner::Call call(*self.scene->owner());
                        (*self.scene)->remove(self.live());
                        self.light = {};
                    },
                    "Takes it out of the scene.");
}

void bindLights(SceneClass& scene) {
    const py::tuple white = py::make_tuple(1, 1, 1), upwards = py::make_tuple(0, 1, 0);
    scene.def("add_sun", &addSun, py::arg("direction"), py::arg("illuminance") = 110'000.0, py::kw_only(),
              py::arg("color") = white, py::arg("angular_radius_degrees") = 0.2665, py::arg("shows_disc") = false,
              py::arg("casts_shadows") = true, py::arg("contact_shadows") = false, py::arg("cookie") = py::none(),
              py::arg("cookie_meters") = 10.0, py::arg("up") = upwards,
              "Parallel light that travels in `direction`; lux on a surface that faces it. A tiled `cookie` repeats "
              "every `cookie_meters`.")
            .def("add_point_light", &addPoint, py::arg("position"), py::arg("intensity") = 100.0, py::kw_only(),
                 py::arg("color") = white, py::arg("range") = 0.0, py::arg("casts_shadows") = true,
                 py::arg("cookie") = py::none(), py::arg("direction") = py::make_tuple(0, 0, -1),
                 py::arg("up") = upwards,
                 "A lamp of so many candela; beyond `range` metres it is dark, 0 is no limit. `direction` and `up` "
                 "turn "
                 "its `cookie`, an octahedron or a cube.")
            .def("add_spot_light", &addSpot, py::arg("position"), py::arg("direction"), py::arg("intensity") = 100.0,
                 py::kw_only(), py::arg("inner_degrees") = 0.0, py::arg("outer_degrees") = 45.0,
                 py::arg("color") = white, py::arg("range") = 0.0, py::arg("casts_shadows") = true,
                 py::arg("cookie") = py::none(), py::arg("up") = upwards,
                 "A lamp with a cone; the angles are those between its middle and its sides.");
}

} // namespace

void bindScene(py::module_& module) {
    bindParts(module);
    SceneClass scene(module, "Scene", "Everything that can be drawn. Keeps what was added to it.");
    scene.def(py::init([](EngineObject const& engine) {
                  const Owner::Call call(*engine.owner);
                  return std::make_shared<SceneObject>(engine.owner, Scene(call.engine()));
              }),
              py::arg("engine"))
            .def("add_mesh", &addMesh, py::arg("mesh").none(false), py::arg("material").none(false), py::kw_only(),
                 py::arg("transform") = py::none(), py::arg("casts_shadows") = true, py::arg("receives_shadows") = true,
                 py::arg("name") = "", "Adds a mesh with a material instance; the transform is a 4 x 4 matrix.")
            .def("set_environment", &setEnvironment, py::arg("source"), py::kw_only(),
                 py::arg("illuminance") = 30'000.0, py::arg("rotation_degrees") = 0.0, py::arg("skybox") = true,
                 py::arg("ground_height") = 0.0, py::arg("ground_level") = 0.0, py::arg("ground_radius") = 50.0,
                 "Lights the scene by an Environment, or by the one that a Model brings; None: not any more. "
                 "`illuminance` is what radiance 1 of it stands for, in lux. With a ground_height in metres its "
                 "background lies on the ground, so far below the panorama's camera.")
            .def(
                    "save_gltf",
                    [](SceneObject const& self, std::filesystem::path const& path, std::string const& environment,
                       std::string const& copyright) {
                        const Owner::Call call(*self.owner());
                        const GltfSaveOptions options{ .copyright = copyright, .environment = environment };
                        return valueOf(released([&] { return saveGltf(*self, path, options); })).warnings;
                    },
                    py::arg("path"), py::kw_only(), py::arg("environment") = "", py::arg("copyright") = "",
                    "Writes the scene as glTF: .glb, or .gltf with a .bin beside it. Returns what the file lacks, a "
                    "line each. `environment` names what lights the scene, for readers.")
            .def_property_readonly(
                    "bounds",
                    [](SceneObject const& self) {
                        const Owner::Call call(*self.owner());
                        return arrayOf(self->bounds());
                    },
                    "[[min], [max]] of everything in the scene, in metres; None if it is empty.")
            .def_property_readonly(
                    "counts",
                    [](SceneObject const& self) {
                        const Owner::Call call(*self.owner());
                        py::dict counts;
                        counts["renderables"] = self->renderableCount();
                        counts["lights"] = self->lightCount();
                        counts["nodes"] = self->nodeCount();
                        return counts;
                    },
                    "How many renderables, lights and nodes the scene has.");
    bindLights(scene);
    bindModelCopies(module, scene);
    bindProbes(module, scene);
    bindIds(module, scene);
}

} // namespace filament_core::python
