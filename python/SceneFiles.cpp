// SPDX-License-Identifier: Apache-2.0
// Scene files: read, edited by key, saved, and built as a scene and a view.
#include "python/SceneFiles.h"

#include <filament_core/BuildScene.h>

namespace filament_core::python {
namespace {

py::object jsonOf(std::string const& text) { return py::module_::import("json").attr("loads")(text); }

/// A text is JSON or words, as on command lines; anything else becomes JSON.
std::string textOf(py::handle value) {
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    return py::module_::import("json").attr("dumps")(value).cast<std::string>();
}

/// Scene and view, as Scene() and View() make them.
py::tuple build(SceneFile const& self, EngineObject const& engine, std::optional<std::filesystem::path> const& assets) {
    const Owner::Call call(*engine.owner);
    SceneBuildOptions options;
    if (assets) options.assets = *assets;
    Result<BuiltScene> built = released([&] { return buildScene(call.engine(), self, options); });
    if (!built) raise(built.error());
    auto view = std::make_shared<ViewObject>();
    view->view = built->view;
    view->view.debugDraw = nullptr; // ends here
    view->view.postProcess = {};    // the same
    if (built->dirt.get()) view->dirt = std::make_shared<TextureObject>(engine.owner, std::move(built->dirt));
    view->view.effects.bloom.dirt = {};
    // the scene keeps what it uses of models and environments
    return py::make_tuple(std::make_shared<SceneObject>(engine.owner, std::move(built->scene)), view);
}

/// All frames with passes and overlays, as render() of a Renderer returns one.
py::array render(SceneFile const& self, EngineObject const& engine,
                 std::optional<std::filesystem::path> const& assets) {
    const Owner::Call call(*engine.owner);
    SceneBuildOptions options;
    if (assets) options.assets = *assets;
    Result<Image> image = released([&]() -> Result<Image> {
        Result<BuiltScene> built = buildScene(call.engine(), self, options);
        if (!built) return built.error();
        return renderFrames(call.engine(), *built);
    });
    return arrayOf(valueOf(std::move(image)));
}

} // namespace

void bindSceneFiles(py::module_& module) {
    py::class_<SceneFile>(module, "SceneFile",
                          "A scene as a JSON file: models, environment, lights, camera, view and options. Keys are "
                          "\"camera.eye\", \"points[0].candela\", \"effects.fog.density\".")
            .def(py::init<>())
            .def_static(
                    "load", [](std::filesystem::path const& path) { return valueOf(SceneFile::load(path)); },
                    py::arg("path"), "Reads a file. What the format does not know is an error.")
            .def_static(
                    "parse",
                    [](std::string const& text, std::string const& name, std::filesystem::path const& folder) {
                        return valueOf(SceneFile::parse(text, name, folder));
                    },
                    py::arg("text"), py::arg("name") = "scene", py::arg("folder") = "",
                    "Reads a text; relative paths start at `folder`.")
            .def_static(
                    "schema", [] { return jsonOf(SceneFile::schema()); }, "The JSON schema of scene files, as a dict.")
            .def(
                    "save", [](SceneFile const& self, std::filesystem::path const& path) { check(self.save(path)); },
                    py::arg("path"), "Replaces the file in one step.")
            .def_property_readonly("text", &SceneFile::text, "What save() writes.")
            .def_property_readonly("name", &SceneFile::name, "Of the file, without its ending.")
            .def(
                    "get",
                    [](SceneFile const& self, std::string const& key) -> py::object {
                        const std::optional<std::string> value = self.get(key);
                        return value ? jsonOf(*value) : py::none();
                    },
                    py::arg("key"), "The value of a key; None if the file does not have it.")
            .def(
                    "set",
                    [](SceneFile& self, std::string const& key, py::handle value) {
                        check(self.set(key, textOf(value)));
                    },
                    py::arg("key"), py::arg("value"),
                    "Sets a key to a value of JSON, or to words as on command lines. What would make the file invalid "
                    "is an error, and changes nothing.")
            .def(
                    "erase", [](SceneFile& self, std::string const& key) { check(self.erase(key)); }, py::arg("key"),
                    "Removes a key or an element of a list.")
            .def_property_readonly("feature_names", &SceneFile::featureNames, "The named changes of the scene.")
            .def(
                    "feature",
                    [](SceneFile const& self, std::string const& name) { return valueOf(self.feature(name)); },
                    py::arg("name"), "The scene with one of them.")
            .def("build", &build, py::arg("engine"), py::kw_only(), py::arg("assets") = py::none(),
                 "Loads what the file names: a Scene and a View. `assets` is the folder of names that begin with "
                 "\"asset:\".")
            .def("render", &render, py::arg("engine"), py::kw_only(), py::arg("assets") = py::none(),
                 "Draws the file: its frames with what moves, its passes (compiled packages), its overlays. An array "
                 "of "
                 "height x width x 4: bytes, or half floats if the file is linear.");
}

} // namespace filament_core::python
