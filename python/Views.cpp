// SPDX-License-Identifier: Apache-2.0
// The view: size, camera, and every option by the name that filament-render --set knows.
#include "base/Suggest.h"
#include "python/Bindings.h"

#include <filament_core/Look.h>
#include <filament_core/RenderPreset.h>

#include <fmt/ranges.h>

#include <array>
#include <utility>

namespace filament_core::python {
namespace {

constexpr uint32_t kMaxSide = 16384;

uint2 sizeOf(std::pair<int64_t, int64_t> const& size) {
    for (const int64_t side : { size.first, size.second })
        if (side < 1 || side > kMaxSide)
            raiseInvalid("size: ({}, {}) is not (width, height), each from 1 to {} pixels", size.first, size.second,
                         kMaxSide);
    return { static_cast<uint32_t>(size.first), static_cast<uint32_t>(size.second) };
}

/// A value of Python as the text of an option: True is "on", (1, 0.5) is "1,0.5".
std::string optionText(py::handle value, const char* name) {
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "on" : "off";
    if (PyIndex_Check(value.ptr())) { // true for arrays, too
        if (const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()))) return py::str(whole);
        PyErr_Clear();
    }
    if (PySequence_Check(value.ptr())) {
        const Py_ssize_t count = PySequence_Size(value.ptr());
        if (count < 0 || count > 16) raiseInvalid("{}: give a text, a bool, a number, or up to 16 numbers", name);
        return fmt::format("{}", fmt::join(numbersOf(value, name, static_cast<size_t>(count)), ","));
    }
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred()) {
        PyErr_Clear();
        raiseInvalid("{}: give a text, a bool, a number, or a sequence of numbers", name);
    }
    return fmt::format("{}", number);
}

/// What --set has besides the view, and where Python has it.
const char* elsewhere(std::string_view name) {
    if (name.starts_with("sun.")) return "Scene.add_sun() has it";
    if (name.starts_with("model.")) return "Engine.load_model() has it";
    if (name.starts_with("environment.")) return "Engine.load_environment() has it";
    if (name == "exact") return "Engine(exact_shaders=...) has it";
    if (name == "bloom.dirt") return "View.bloom_dirt has it";
    return nullptr;
}

[[noreturn]] void raiseUnknown(std::string const& name) {
    if (const char* place = elsewhere(name))
        raise(fail(ErrorCode::NotFound, "'{}' is no option of a view: {}", name, place));
    raise(fail(ErrorCode::NotFound, "there is no option '{}'{}; filament_core.options() lists all", name,
               suggestion(name, namesOf(optionsOf<View>()))));
}

void setOption(ViewObject& self, std::string const& name, py::handle given) {
    const std::string value = optionText(given, name.c_str());
    const Result<void> done = filament_core::setOption(self.view, name, value);
    if (!done && done.error().code == ErrorCode::NotFound) raiseUnknown(name);
    check(done);
}

std::string optionValue(ViewObject const& self, std::string const& name) {
    if (auto value = filament_core::optionValue(self.view, name)) return *value;
    raiseUnknown(name);
}

py::dict allOptions() {
    py::dict all;
    for (Option const& option : optionsOf<View>()) all[py::str(std::string(option.name))] = rangeOf(option);
    return all;
}

py::dict optionsOfView(ViewObject const& self) {
    py::dict values;
    for (Option const& option : optionsOf<View>())
        values[py::str(std::string(option.name))] = filament_core::optionValue(option, &self.view);
    return values;
}

void lookAt(ViewObject& self, py::object const& eye, py::object const& at, double fovDegrees, py::object const& up,
            double nearMeters) {
    const double3 from = double3Of(eye, "eye"), to = double3Of(at, "at");
    if (from == to) raiseInvalid("eye and at are the same point; look at another one");
    const Lens lens{ .verticalFovDegrees = static_cast<float>(numberIn(fovDegrees, "fov_degrees", 0.01, 179)),
                     .nearMeters = static_cast<float>(numberIn(nearMeters, "near", 1e-6, 1e6)) };
    self.view.camera = Camera::lookAt(from, to, lens, self.view.camera.exposure, double3(directionOf(up, "up")));
}

void setOrthographic(ViewObject& self, double height, double nearMeters, double farMeters) {
    Lens& lens = self.view.camera.lens;
    const double n = numberIn(nearMeters, "near", 0, 1e9), f = numberIn(farMeters, "far", 1e-6, 1e12);
    if (static_cast<float>(f) <= static_cast<float>(n)) raiseInvalid("far: {} is not beyond near, {}", f, n);
    lens.orthographicHeight = static_cast<float>(numberIn(height, "height", 1e-6, 1e9));
    lens.nearMeters = static_cast<float>(n);
    lens.farMeters = static_cast<float>(f);
}

void setExposure(ViewObject& self, double aperture, double shutter, double iso) {
    self.view.camera.exposure = { static_cast<float>(numberIn(aperture, "aperture", 1e-6, 1e6)),
                                  static_cast<float>(numberIn(shutter, "shutter_seconds", 1e-6, 1e6)),
                                  static_cast<float>(numberIn(iso, "iso", 1e-6, 1e6)) };
}

void setPreset(ViewObject& self, std::string const& name) {
    const auto preset = enumFromName<RenderPreset>(name);
    if (!preset) raiseInvalid("preset: '{}' is not {}", name, listed(enumNames<RenderPreset>()));
    applyPreset(self.view, *preset);
}

void setQualityPreset(ViewObject& self, std::string const& name) {
    const auto preset = enumFromName<QualityPreset>(name);
    if (!preset) raiseInvalid("quality: '{}' is not {}", name, listed(enumNames<QualityPreset>()));
    self.view.quality = qualityPreset(*preset);
}

void setCamera(ViewObject& self, py::object const& worldFromView) {
    const double4x4 matrix = transformOf(worldFromView, "world_from_view");
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b <= a; ++b) {
            double dot = 0;
            for (int i = 0; i < 3; ++i) dot += matrix[a][i] * matrix[b][i];
            if (!(std::abs(dot - (a == b)) < 1e-4)) raiseInvalid("world_from_view: a camera is a rotation and a place");
        }
    }
    self.view.camera.worldFromView = matrix;
}

std::vector<std::pair<std::shared_ptr<InstanceObject>, std::string>> passesOf(ViewObject const& self) {
    std::vector<std::pair<std::shared_ptr<InstanceObject>, std::string>> passes;
    for (auto const& [instance, place] : self.passes) passes.emplace_back(instance, toString(place));
    return passes;
}

void setPasses(ViewObject& self, std::vector<std::pair<std::shared_ptr<InstanceObject>, std::string>> const& passes) {
    decltype(self.passes) read;
    for (auto const& [instance, name] : passes) {
        const std::optional<PassPlace> place = enumFromName<PassPlace>(name);
        if (!place) raiseInvalid("post_process: '{}' is not {}", name, listed(enumNames<PassPlace>()));
        if (!instance) raiseInvalid("post_process: a pass has a MaterialInstance, not None");
        read.emplace_back(instance, *place);
    }
    self.passes = std::move(read);
}

std::array<float, 4> clearColorOf(ViewObject const& self) {
    const float4 c = self.view.clearColor;
    return { c.x, c.y, c.z, c.w };
}

void bindOptions(py::class_<ViewObject, std::shared_ptr<ViewObject>>& view) {
    view.def("set", &setOption, py::arg("name"), py::arg("value"),
             "Sets one option by its name, as filament-render --set does. True and False are on and off, a sequence of "
             "numbers is a vector.")
            .def("__setitem__", &setOption, py::arg("name"), py::arg("value"))
            .def("get", &optionValue, py::arg("name"), "The value of an option, as text that set() accepts.")
            .def("__getitem__", &optionValue, py::arg("name"))
            .def("options", &optionsOfView, "All options and their values.")
            .def("preset", &setPreset, py::arg("name"),
                 "Approximations and effects by one name: fast, balanced, fine or cinematic.")
            .def("quality", &setQualityPreset, py::arg("name"),
                 "All approximations of shading by one name: low, medium, high or reference.")
            .def(
                    "load_look",
                    [](ViewObject& self, std::filesystem::path const& path) {
                        self.view.display.look = valueOf(loadLook(path));
                    },
                    py::arg("path"), "A table of display values, a .cube file, applied after the tone mapper.")
            .def(
                    "remove_look", [](ViewObject& self) { self.view.display.look = nullptr; },
                    "No table after the tone mapper any more.")
            .def_property(
                    "bloom_dirt", [](ViewObject const& self) { return self.dirt; },
                    [](ViewObject& self, std::shared_ptr<TextureObject> dirt) { self.dirt = std::move(dirt); },
                    "The dirt of the lens that bloom shows: a Texture with mip levels, or None.")
            .def_property("post_process", &passesOf, &setPasses,
                          "Passes over the picture: a list of (MaterialInstance of domain postprocess, place), where "
                          "the place is afterOpaque, beforeToneMapping, afterToneMapping or last.");
}

void bindCamera(py::class_<ViewObject, std::shared_ptr<ViewObject>>& view) {
    view.def("look_at", &lookAt, py::arg("eye"), py::arg("at"), py::kw_only(), py::arg("fov_degrees") = 40.0,
             py::arg("up") = py::make_tuple(0, 1, 0), py::arg("near") = 0.01,
             "A perspective camera at `eye` that looks at `at`; metres, vertical field of view in degrees.")
            .def("orthographic", &setOrthographic, py::arg("height"), py::kw_only(), py::arg("near") = 0.0,
                 py::arg("far") = 1000.0,
                 "An orthographic lens that shows `height` metres; the camera stays where it is.")
            .def("exposure", &setExposure, py::arg("aperture") = 16.0, py::arg("shutter_seconds") = 1.0 / 125,
                 py::arg("iso") = 100.0, "How the camera is exposed.")
            .def_property_readonly(
                    "exposure_factor", [](ViewObject const& self) { return self.view.camera.exposure.factor(); },
                    "What luminance in cd/m^2 is multiplied by: 1 / (1.2 * 2^EV100).")
            .def_property(
                    "world_from_view", [](ViewObject const& self) { return arrayOf(self.view.camera.worldFromView); },
                    &setCamera, "Where the camera is: a 4 x 4 matrix of a rotation and a place. It looks down -z.");
}

} // namespace

void bindView(py::module_& module) {
    module.def("options", &allOptions,
               "The options of a view by name, with the values that they take: those of filament-render --set.");
    py::class_<ViewObject, std::shared_ptr<ViewObject>> view(
            module, "View", "A camera and the settings of its picture. A plain value: any engine and any thread.");
    view.def(py::init([](std::pair<int64_t, int64_t> size) {
                 ViewObject made;
                 made.view.size = sizeOf(size);
                 return made;
             }),
             py::arg("size") = std::pair<int64_t, int64_t>(1280, 720))
            .def(
                    "copy", [](ViewObject const& self) { return ViewObject(self); }, "Another view of the same values.")
            .def("__copy__", [](ViewObject const& self) { return ViewObject(self); })
            .def_property(
                    "size", [](ViewObject const& self) { return std::pair(self.view.size.x, self.view.size.y); },
                    [](ViewObject& self, std::pair<int64_t, int64_t> size) { self.view.size = sizeOf(size); },
                    "Width and height in pixels, each from 1 to 16384.")
            .def_property(
                    "time_seconds", [](ViewObject const& self) { return self.view.timeSeconds; },
                    [](ViewObject& self, double seconds) {
                        self.view.timeSeconds = numberIn(seconds, "time_seconds", -1e12, 1e12);
                    },
                    "The time that materials see.")
            .def_property(
                    "clear_color", &clearColorOf,
                    [](ViewObject& self, py::object const& color) {
                        const std::vector<double> v = numbersOf(color, "clear_color", 4, 0);
                        self.view.clearColor = float4(double4(v[0], v[1], v[2], v[3]));
                    },
                    "The background without a sky: linear light, already exposed, and alpha.");
    bindOptions(view);
    bindCamera(view);
}

} // namespace filament_core::python
