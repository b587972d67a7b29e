// SPDX-License-Identifier: Apache-2.0
// Materials: compiling them, loading packages, and setting parameters.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/files/PathInside.h"
#include "jobsystem/JobSystem.h"
#include "python/Bindings.h"
#include "shaders/compiler/MaterialCompiler.h"

#include <filament_core/BuiltInMaterials.h>

namespace filament_core::python {
namespace {

namespace fs = std::filesystem;
constexpr size_t kMaxTextBytes = 1 << 20; // as the compiler's limit for a material with its includes

/// Outside of the interpreter's lock. `folder`: of its includes; none: it has none but the engine's.
Result<std::vector<std::byte>> compiled(std::string const& text, std::string const& name,
                                        std::optional<fs::path> const& folder, bool exact) {
    jobs::JobSystem jobs;
    shader::CompileOptions options{ .exact = exact, .jobs = &jobs };
    if (folder) {
        options.includes = [&folder](std::string_view include) -> std::optional<std::string> {
            const Result<fs::path> file = assets::fileInside(*folder, include);
            if (!file) return std::nullopt;
            const Result<std::string> found = assets::readText(*file, kMaxTextBytes);
            return found ? std::optional(*found) : std::nullopt;
        };
    }
    const Result<shader::MaterialPackage> package = shader::compileMaterial(text, name, options);
    if (!package) return package.error();
    return shader::writePackage(*package);
}

py::bytes bytesOf(Result<std::vector<std::byte>>&& package) {
    const std::vector<std::byte> bytes = valueOf(std::move(package));
    return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

py::bytes compileFile(fs::path const& path, bool exact) {
    return bytesOf(released([&]() -> Result<std::vector<std::byte>> {
        const Result<std::string> text = assets::readText(path, kMaxTextBytes);
        if (!text) return text.error();
        return compiled(*text, path.filename().string(), path.parent_path(), exact);
    }));
}

py::bytes compileText(std::string const& text, std::string const& name, bool exact) {
    if (text.size() > kMaxTextBytes) raiseInvalid("text: a material has at most 1 MiB");
    return bytesOf(released([&] { return compiled(text, name, std::nullopt, exact); }));
}

std::vector<MaterialConstant> constantsOf(py::dict const& dict) {
    std::vector<MaterialConstant> constants;
    for (auto const& [key, value] : dict) {
        MaterialConstant constant{ .name = py::str(key) };
        if (py::isinstance<py::bool_>(value)) {
            constant.value = value.cast<bool>();
        } else if (PyIndex_Check(value.ptr())) {
            const double number = PyFloat_AsDouble(value.ptr());
            if (PyErr_Occurred()) PyErr_Clear(), raiseInvalid("constant '{}': the number is too large", constant.name);
            constant.value = static_cast<int32_t>(numberIn(number, constant.name.c_str(), -2147483648.0, 2147483647.0));
        } else {
            constant.value = static_cast<float>(numbersOf(py::make_tuple(value), constant.name.c_str(), 1)[0]);
        }
        constants.push_back(std::move(constant));
    }
    return constants;
}

std::shared_ptr<MaterialObject> made(std::shared_ptr<Owner> const& owner, Engine& engine, Result<Material>&& result) {
    Owned<Material> material = engine.own(valueOf(std::move(result)));
    MaterialDescription description = engine.describe(material);
    return std::make_shared<MaterialObject>(owner, OwnedMaterial{ std::move(material), std::move(description) });
}

std::shared_ptr<MaterialObject> loadMaterial(EngineObject const& self, py::object const& package,
                                             py::dict const& constants, std::string const& name) {
    std::vector<std::byte> read;
    std::string_view bytes;
    if (PyBytes_Check(package.ptr())) {
        bytes = package.cast<std::string_view>();
    } else {
        const auto path = package.cast<fs::path>();
        read = valueOf(released([&] { return assets::readFileBytes(path); }));
        bytes = { reinterpret_cast<const char*>(read.data()), read.size() };
    }
    const MaterialDesc desc{ .package = std::as_bytes(std::span(bytes)),
                             .constants = constantsOf(constants),
                             .name = name };
    const Owner::Call call(*self.owner);
    return made(self.owner, call.engine(), released([&] { return call.engine().create(desc); }));
}

std::shared_ptr<MaterialObject> builtIn(EngineObject const& self, std::string const& name) {
    const Owner::Call call(*self.owner);
    return made(self.owner, call.engine(), released([&] { return createBuiltInMaterial(call.engine(), name); }));
}

py::dict constantsOf(MaterialDescription const& description) {
    py::dict dict;
    for (ConstantDescription const& constant : description.constants) dict[py::str(constant.name)] = constant.value;
    return dict;
}

std::shared_ptr<InstanceObject> instanceOf(MaterialObject const& self, std::string const& name) {
    const Owner::Call call(*self.owner());
    Owned<MaterialInstance> instance = call.engine().own(call.engine().createInstance(self->material, name));
    if (!instance.get()) {
        self.owner()->raiseErrors();
        raise({ ErrorCode::OutOfMemory, "there is no memory for the instance" });
    }
    return std::make_shared<InstanceObject>(self.owner(), OwnedInstance{ std::move(instance), self->description });
}

ParameterDescription const& declared(MaterialDescription const& description, std::string const& name) {
    static const ParameterDescription kUnknown{};
    ParameterDescription const* found = description.findParameter(name);
    return found ? *found : kUnknown; // the engine refuses the name, and says what is near
}

void setParameter(InstanceObject const& self, std::string const& name, py::object const& value) {
    const Owner::Call call(*self.owner());
    OwnedInstance& instance = *self;
    ParameterDescription const& parameter = declared(instance.description, name);
    if (parameter.name.empty()) return check(call.engine().set(instance.instance, name, ParameterValue(0.0f)));
    if (parameter.arraySize == 0)
        return check(call.engine().set(instance.instance, name, parameterOf(parameter, value)));
    // Arrays: element by element.
    const py::sequence elements = py::isinstance<py::str>(value) || !PySequence_Check(value.ptr())
                                          ? py::sequence(py::tuple())
                                          : py::reinterpret_borrow<py::sequence>(value);
    const size_t count = elements.size();
    if (count == 0 || count > parameter.arraySize)
        raiseInvalid("{}: give a sequence of 1 to {} elements of {}", name, parameter.arraySize,
                     toString(parameter.type));
    for (size_t i = 0; i < count; ++i) {
        const ParameterValue element = parameterOf(parameter, py::object(elements[i]));
        check(std::visit(
                [&](auto const& one) {
                    return call.engine().set(instance.instance, name, ParameterArray(std::span(&one, 1)),
                                             static_cast<uint32_t>(i));
                },
                element));
    }
}

void setTexture(InstanceObject const& self, std::string const& name, std::shared_ptr<TextureObject> const& texture,
                std::string const& filter, std::string const& wrap, int64_t anisotropy) {
    const Owner::Call call(*self.owner());
    requireSame(*self.owner(), *texture, "texture");
    const auto most = static_cast<int>(numberIn(static_cast<double>(anisotropy), "anisotropy", 1, 16));
    check(call.engine().set(self->instance, name, (*texture)->get(), samplerOf(filter, wrap, most)));
}

void bindInstance(py::module_& module) {
    py::class_<InstanceObject, std::shared_ptr<InstanceObject>>(
            module, "MaterialInstance", "A material with values of its parameters. From Material.instance().")
            .def_property_readonly(
                    "parameters", [](InstanceObject const& self) { return listOf(self->description.parameters); },
                    "name, type and array_size of each parameter that set() takes.")
            .def("set", &setParameter, py::arg("name"), py::arg("value"),
                 "Sets a parameter: a bool, a number, a sequence of numbers, or for arrays a sequence of those. Starts "
                 "at "
                 "zero.")
            .def("set_texture", &setTexture, py::arg("name"), py::arg("texture").none(false), py::kw_only(),
                 py::arg("filter") = "trilinear", py::arg("wrap") = "repeat", py::arg("anisotropy") = 1,
                 "Sets a sampler; filter is nearest, bilinear or trilinear, wrap is repeat, mirror or clamp.")
            .def(
                    "set_double_sided",
                    [](InstanceObject const& self, bool doubleSided) {
                        const Owner::Call call(*self.owner());
                        check(call.engine().setDoubleSided(self->instance, doubleSided));
                    },
                    py::arg("double_sided"),
                    "Draws and shades both sides, for materials with the property doubleSided.")
            .def(
                    "set_mask_threshold",
                    [](InstanceObject const& self, double threshold) {
                        const Owner::Call call(*self.owner());
                        const auto value = static_cast<float>(numberIn(threshold, "threshold", 0, 1));
                        check(call.engine().setMaskThreshold(self->instance, value));
                    },
                    py::arg("threshold"), "Below which alpha a masked material leaves a hole, from 0 to 1.");
}

} // namespace

void bindMaterials(py::module_& module, EngineClass& engine) {
    module.def("compile_material", &compileFile, py::arg("path"), py::kw_only(), py::arg("exact") = true,
               "Compiles a .mat file to the bytes of a package, as matc does. Includes lie beside it.");
    module.def("compile_material_text", &compileText, py::arg("text"), py::kw_only(), py::arg("name") = "material.mat",
               py::arg("exact") = true, "Compiles the text of a material; `name` stands for the file in messages.");
    bindInstance(module);
    py::class_<MaterialObject, std::shared_ptr<MaterialObject>>(
            module, "Material", "A compiled material. From Engine.load_material() or Engine.built_in_material().")
            .def_property_readonly(
                    "name", [](MaterialObject const& self) { return self->description.name; },
                    "The name that it declares.")
            .def_property_readonly(
                    "parameters", [](MaterialObject const& self) { return listOf(self->description.parameters); },
                    "name, type and array_size of each parameter.")
            .def_property_readonly(
                    "constants", [](MaterialObject const& self) { return constantsOf(self->description); },
                    "The constants by name, with the values that it was loaded with.")
            .def("instance", &instanceOf, py::arg("name") = "", "The material with parameters of its own.");
    engine.def("load_material", &loadMaterial, py::arg("package"), py::kw_only(), py::arg("constants") = py::dict(),
               py::arg("name") = "",
               "A material from the bytes of compile_material(), or from the path of a .fmat file.")
            .def("built_in_material", &builtIn, py::arg("name"),
                 "A material of the library: lit, unlit, litTextured, unlitTextured, litVertexColors, vertexColors.");
}

} // namespace filament_core::python
