// SPDX-License-Identifier: Apache-2.0
// Scene.add_reflection_probe(): light of its own in a box, given or captured.
#include "python/SceneParts.h"

#include <filament_core/ProbeCapture.h>
#include <filament_core/ReflectionProbe.h>

#include <cmath>
#include <numbers>

namespace filament_core::python {
namespace {

/// Around y, counter-clockwise seen from above.
float3x3 turned(double degrees) {
    const double angle = numberIn(degrees, "rotation_degrees", -1e6, 1e6) * std::numbers::pi / 180;
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    return { float3(c, 0, -s), float3(0, 1, 0), float3(s, 0, c) };
}

/// What the scene shows from the place of the probe.
Environment captured(Engine& engine, Scene const& scene, ReflectionProbeDesc& desc, int64_t faceSize) {
    ProbeCaptureOptions options;
    options.faceSize = static_cast<uint32_t>(numberIn(static_cast<double>(faceSize), "face_size", 16, 4096));
    const ProbeCapture capture = valueOf(released([&] { return captureProbe(engine, scene, desc, options); }));
    desc.intensity *= capture.intensity;
    return valueOf(released([&] { return loadEnvironment(engine, capture.ktx2, desc.name); }));
}

std::shared_ptr<ProbeObject> addProbe(std::shared_ptr<SceneObject> const& self, py::object const& center,
                                      py::object const& halfExtent, std::shared_ptr<EnvironmentObject> const& light,
                                      double rotationDegrees, double blend, py::object const& capture, double intensity,
                                      bool lightsDiffuse, int64_t faceSize, std::string const& name) {
    const Owner::Call call(*self->owner());
    ReflectionProbeDesc desc{ .centerWorld = double3Of(center, "center"),
                              .halfExtentMeters = float3(double3Of(halfExtent, "half_extent")),
                              .worldFromBox = turned(rotationDegrees),
                              .blendMeters = quantityOf(blend, "blend"),
                              .captureInBoxMeters = float3(double3Of(capture, "capture")),
                              .intensity = quantityOf(intensity, "intensity"),
                              .lightsDiffuse = lightsDiffuse,
                              .name = name };
    for (int axis = 0; axis < 3; ++axis) {
        if (!(desc.halfExtentMeters[axis] > 0 && desc.halfExtentMeters[axis] <= 1e9f))
            raiseInvalid("half_extent: {} is not above 0 and at most 1e9 metres", desc.halfExtentMeters[axis]);
        if (!(std::abs(desc.captureInBoxMeters[axis]) < desc.halfExtentMeters[axis]))
            raiseInvalid("capture: {} lies outside of the box, which ends at {}", desc.captureInBoxMeters[axis],
                         desc.halfExtentMeters[axis]);
    }
    std::optional<Environment> own;
    if (light) {
        requireSame(*self->owner(), *light, "environment");
        desc.light = (*light)->indirectLight();
    } else {
        own.emplace(captured(call.engine(), **self, desc, faceSize));
        desc.light = own->indirectLight();
    }
    const ReflectionProbe probe = (*self)->add(desc);
    return std::make_shared<ProbeObject>(ProbeObject{ self, probe, std::move(own), light });
}

} // namespace

void bindProbes(py::module_& module, SceneClass& scene) {
    py::class_<ProbeObject, std::shared_ptr<ProbeObject>>(
            module, "ReflectionProbe", "Light of its own in a box of a scene. From Scene.add_reflection_probe().")
            .def(
                    "remove",
                    [](ProbeObject& self) {
                        const Owner::Call call(*self.scene->owner());
                        (*self.scene)->remove(self.live());
                        self = { .scene = self.scene };
                    },
                    "Takes it out of the scene.");
    scene.def("add_reflection_probe", &addProbe, py::arg("center"), py::arg("half_extent"),
              py::arg("light") = py::none(), py::kw_only(), py::arg("rotation_degrees") = 0.0, py::arg("blend") = 0.25,
              py::arg("capture") = py::make_tuple(0, 0, 0), py::arg("intensity") = 1.0,
              py::arg("lights_diffuse") = true, py::arg("face_size") = 256, py::arg("name") = "",
              "Surfaces in a box, half_extent metres to each side of its center, reflect the light of an Environment "
              "of intensity nits, or, without one, what the scene shows from `capture`, a point in the box: drawn now, "
              "six faces of face_size pixels. Beyond `blend` metres outside of the box it has no effect.");
}

} // namespace filament_core::python
