// SPDX-License-Identifier: Apache-2.0
// The engine, and what it loads.
#include "python/Bindings.h"

#include "toolkit/materials/PlainMaterials.h"

#include <filament_core/Environment.h>
#include <filament_core/Options.h>
#include <filament_core/Sky.h>
#include <filament_core/Version.h>

namespace filament_core::python {
namespace {

constexpr int kMaxWorkers = 256;

Backend backendOf(std::string const& name) {
    for (const Backend backend : { Backend::Vulkan, Backend::Gles, Backend::Null })
        if (name == toString(backend)) return backend;
    raiseInvalid("backend: '{}' is not {}, {} or {}", name, toString(Backend::Vulkan), toString(Backend::Gles),
                 toString(Backend::Null));
}

EngineObject makeEngine(std::string const& backend, std::string const& requireDevice, int64_t workers,
                        bool exactShaders, bool validation, std::optional<std::filesystem::path> const& cacheDirectory,
                        bool cachePrograms, bool driverSelfTest) {
    EngineOptions options{ .backend = backendOf(backend), .requireDevice = requireDevice };
    if (workers < -1 || workers > kMaxWorkers)
        raiseInvalid("workers: {} is not from -1 (one for each other core) to {}", workers, kMaxWorkers);
    options.workers = static_cast<int>(workers);
    options.exactShaders = exactShaders;
    options.debug.plainMaterials = &tools::plainMaterial;
    options.validation = validation;
    if (cacheDirectory) options.cacheDirectory = *cacheDirectory;
    options.cachePrograms = cachePrograms;
    options.driverSelfTest = driverSelfTest;
    return { Owner::create(options) };
}

py::dict dictOf(DeviceDescription const& device) {
    py::dict dict;
    dict["backend"] = toString(device.backend);
    dict["device"] = device.device;
    dict["driver"] = device.driver;
    dict["max_texture_size"] = device.maxTextureSize;
    dict["max_3d_texture_size"] = device.max3DTextureSize;
    dict["max_samples"] = device.maxSamples;
    return dict;
}

py::list devices() {
    py::list list;
    for (DeviceDescription const& device : released([] { return listDevices(); })) list.append(dictOf(device));
    return list;
}

py::dict statisticsOf(EngineObject const& self) {
    const Owner::Call call(*self.owner);
    const EngineStatistics statistics = call.engine().statistics();
    return dictOfCounts({ { "draws", statistics.draws },
                          { "pipelines_created", statistics.pipelinesCreated },
                          { "programs_created", statistics.programsCreated },
                          { "programs_from_cache", statistics.programsFromCache },
                          { "commands", statistics.commands },
                          { "device_bytes", statistics.deviceBytes } });
}

/// Sets an option of loading by a keyword of the same name.
template <class T>
void setKeyword(T& options, std::string_view option, const char* keyword, std::string const& value) {
    if (!setOption(options, option, value))
        raiseInvalid("{}: '{}' is not {}", keyword, value, rangeOf(*findOption(optionsOf<T>(), option)));
}

std::shared_ptr<ModelObject> loadModel(EngineObject const& self, std::filesystem::path const& path,
                                       std::string const& positions, std::string const& tangents, bool deformable,
                                       bool simplified, bool filesFromAnywhere, bool sectionPlanes) {
    GltfLoadOptions options{ .deformable = deformable,
                             .simplified = simplified,
                             .sectionPlanes = sectionPlanes,
                             .filesFromAnywhere = filesFromAnywhere };
    setKeyword(options, "positions", "positions", positions);
    setKeyword(options, "tangents", "tangents", tangents);
    const Owner::Call call(*self.owner);
    Result<Model> model = released([&] { return loadGltf(call.engine(), path, options); });
    return std::make_shared<ModelObject>(self.owner, valueOf(std::move(model)));
}

std::shared_ptr<EnvironmentObject> loadFile(EngineObject const& self, std::filesystem::path const& path,
                                            int64_t faceSize, std::string const& format,
                                            std::string const& roughnessMapping, int64_t samples,
                                            std::string const& sun, int64_t lights) {
    EnvironmentLoadOptions options;
    setKeyword(options, "faceSize", "face_size", std::to_string(faceSize));
    setKeyword(options, "format", "format", format);
    setKeyword(options, "roughnessMapping", "roughness_mapping", roughnessMapping);
    setKeyword(options, "samples", "samples", std::to_string(samples));
    setKeyword(options, "sun", "sun", sun);
    setKeyword(options, "lights", "lights", std::to_string(lights));
    const Owner::Call call(*self.owner);
    Result<Environment> sky = released([&] { return loadEnvironment(call.engine(), path, options); });
    return std::make_shared<EnvironmentObject>(self.owner, valueOf(std::move(sky)));
}

std::shared_ptr<EnvironmentObject> computeSky(EngineObject const& self, py::object const& directionToSun,
                                              double turbidity, py::object const& groundAlbedo, double altitude,
                                              bool showsDisc, int64_t height, int64_t faceSize,
                                              std::string const& format, int64_t samples) {
    EnvironmentLoadOptions options;
    setKeyword(options, "faceSize", "face_size", std::to_string(faceSize));
    setKeyword(options, "format", "format", format);
    setKeyword(options, "samples", "samples", std::to_string(samples));
    if (height < 16 || height > 2048) raiseInvalid("height: {} is not a whole number from 16 to 2048", height);
    const SkyDesc desc{ .directionToSun = directionOf(directionToSun, "direction_to_sun"),
                        .turbidity = quantityOf(turbidity, "turbidity"),
                        .groundAlbedo = colorOf(groundAlbedo, "ground_albedo"),
                        .altitudeMeters = quantityOf(altitude, "altitude"),
                        .showsDisc = showsDisc,
                        .height = static_cast<uint32_t>(height) };
    const Owner::Call call(*self.owner);
    Result<Environment> sky = released([&] { return loadSky(call.engine(), desc, options); }); // it checks the ranges
    return std::make_shared<EnvironmentObject>(self.owner, valueOf(std::move(sky)));
}

py::list lightsOf(EnvironmentObject const& self) {
    const Owner::Call call(*self.owner());
    py::list lights;
    for (ExtractedLight const& light : self->lights().found()) {
        py::dict one;
        one["direction"] = py::make_tuple(light.direction.x, light.direction.y, light.direction.z);
        one["illuminance"] = py::make_tuple(light.illuminance.x, light.illuminance.y, light.illuminance.z);
        one["angular_radius_degrees"] = light.angularRadiusDegrees;
        one["share"] = light.share;
        lights.append(one);
    }
    return lights;
}

std::string explanationOf(EnvironmentObject const& self) {
    const Owner::Call call(*self.owner());
    return explain(self->lights(), {});
}

std::shared_ptr<TextureObject> makeTexture(EngineObject const& self, Image const& image, std::string const& name) {
    const Owner::Call call(*self.owner);
    const uint32_t most = self.owner->device().maxTextureSize;
    if (image.width > most || image.height > most)
        raiseInvalid("a texture of {} x {} texels: the device takes {} a side", image.width, image.height, most);
    Engine& engine = call.engine();
    Owned<Texture> texture = engine.own(released([&] { return engine.create(textureOf(image, name)); }));
    if (!texture.get()) {
        self.owner->raiseErrors();
        raise({ ErrorCode::OutOfMemory, "there is no memory for the texture" });
    }
    return std::make_shared<TextureObject>(self.owner, std::move(texture));
}

std::shared_ptr<TextureObject> textureOfArray(EngineObject const& self, py::object const& pixels, bool srgb,
                                              std::string const& name) {
    Image image = pictureOf(pixels, "pixels").image();
    if (srgb && image.format == Format::RGBA8) image.format = Format::RGBA8Srgb;
    return makeTexture(self, image, name);
}

std::shared_ptr<TextureObject> loadTexture(EngineObject const& self, std::filesystem::path const& path,
                                           std::string const& content) {
    if (content != "color" && content != "data") raiseInvalid("content: '{}' is not color or data", content);
    const ImageLoadOptions options{ .content = content == "color" ? ImageContent::Color : ImageContent::Data };
    Result<Image> image = released([&] { return loadImage(path, options); });
    return makeTexture(self, valueOf(std::move(image)), path.filename().string());
}

std::shared_ptr<LightImageObject> makeLightImage(EngineObject const& self, Image const& image, std::string const& shape,
                                                 std::string const& name) {
    const auto known = enumFromName<LightImageShape>(shape);
    if (!known) raiseInvalid("shape: '{}' is not {}", shape, listed(enumNames<LightImageShape>()));
    const Owner::Call call(*self.owner);
    Engine& engine = call.engine();
    Result<LightImage> made = released([&] {
        return engine.create(LightImageDesc{ .width = image.width,
                                             .height = image.height,
                                             .format = image.format,
                                             .pixels = image.pixels,
                                             .shape = *known,
                                             .name = name });
    });
    return std::make_shared<LightImageObject>(self.owner, engine.own(valueOf(std::move(made))));
}

std::shared_ptr<LightImageObject> lightImageOfArray(EngineObject const& self, py::object const& pixels,
                                                    std::string const& shape, bool srgb, std::string const& name) {
    Image image = pictureOf(pixels, "pixels").image();
    if (srgb && image.format == Format::RGBA8) image.format = Format::RGBA8Srgb;
    return makeLightImage(self, image, shape, name);
}

std::shared_ptr<LightImageObject> loadLightImageFile(EngineObject const& self, std::filesystem::path const& path,
                                                     std::string const& shape) {
    Result<Image> image = released([&] { return loadImage(path); });
    return makeLightImage(self, valueOf(std::move(image)), shape, path.filename().string());
}

py::list animationsOf(ModelObject const& self) {
    const Owner::Call call(*self.owner());
    py::list list;
    for (uint32_t i = 0; i < self->animationCount(); ++i)
        list.append(py::make_tuple(self->animationName(i), self->animationSeconds(i)));
    return list;
}

void bindLoaded(py::module_& module) {
    py::class_<ModelObject, std::shared_ptr<ModelObject>>(
            module, "Model", "A loaded glTF model: Scene.add() makes copies of it. From Engine.load_model().")
            .def_property_readonly(
                    "name", [](ModelObject const& self) { return self->name(); }, "The name of the file.")
            .def_property_readonly(
                    "bounds", [](ModelObject const& self) { return arrayOf(self->bounds()); },
                    "[[min], [max]] in metres, in the rest pose; None if there is nothing to see.")
            .def_property_readonly(
                    "variants", [](ModelObject const& self) { return self->variantNames(); },
                    "The names of KHR_materials_variants.")
            .def_property_readonly("animations", &animationsOf, "The name and the length in seconds of each animation.")
            .def_property_readonly(
                    "has_environment", [](ModelObject const& self) { return self->environment() != nullptr; },
                    "Whether the file brings an image-based light, for Scene.set_environment().")
            .def_property_readonly(
                    "warnings", [](ModelObject const& self) { return self->warnings(); },
                    "What was not supported, or repaired, one line each.");
    py::class_<EnvironmentObject, std::shared_ptr<EnvironmentObject>>(
            module, "Environment", "A loaded environment, for Scene.set_environment(). From Engine.load_environment().")
            .def_property_readonly("lights", &lightsOf,
                                   "What load_environment(sun=...) made lights, brightest first: direction towards it, "
                                   "illuminance (red, "
                                   "green, blue) in units of radiance, angular_radius_degrees, share of the light.")
            .def_property_readonly("explanation", &explanationOf,
                                   "The same as text, or why there is none; empty with sun='keep'.");
    py::class_<TextureObject, std::shared_ptr<TextureObject>>(
            module, "Texture", "A picture on the device, for parameters of materials. From Engine.texture().");
    py::class_<LightImageObject, std::shared_ptr<LightImageObject>>(
            module, "LightImage", "A picture that lights project, their cookie. From Engine.light_image().");
}

void bindLoading(EngineClass& engine) {
    engine.def("load_model", &loadModel, py::arg("path"), py::kw_only(), py::arg("positions") = "asAuthored",
               py::arg("tangents") = "snorm16", py::arg("deformable") = true, py::arg("simplified") = false,
               py::arg("files_from_anywhere") = false, py::arg("section_planes") = false,
               "Loads a .gltf or .glb file. The keywords are those of --set model.positions, model.tangents, "
               "model.simplified, model.filesFromAnywhere and model.sectionPlanes.")
            .def("load_environment", &loadFile, py::arg("path"), py::kw_only(), py::arg("face_size") = 256,
                 py::arg("format") = "RGBA16F", py::arg("roughness_mapping") = "quadratic", py::arg("samples") = 512,
                 py::arg("sun") = "keep", py::arg("lights") = 1,
                 "Loads an equirectangular .hdr or .exr, a cube map in a .ktx2, or a package of cmgen, as light and "
                 "background. sun: keep, extract or fit, with up to `lights` lights: what casts shadows.")
            .def("load_sky", &computeSky, py::arg("direction_to_sun") = py::make_tuple(0.45, 0.55, 0.70), py::kw_only(),
                 py::arg("turbidity") = 2.5, py::arg("ground_albedo") = py::make_tuple(0.18, 0.17, 0.15),
                 py::arg("altitude") = 0.0, py::arg("shows_disc") = true, py::arg("height") = 256,
                 py::arg("face_size") = 256, py::arg("format") = "RGBA16F", py::arg("samples") = 512,
                 "Computes a clear sky and its sun from the physics of the air: turbidity 1 (no haze) to 10, altitude "
                 "in metres. Its radiances are in kcd/m2: scene.set_environment(sky, illuminance=1000).")
            .def("texture", &textureOfArray, py::arg("pixels"), py::kw_only(), py::arg("srgb") = true,
                 py::arg("name") = "",
                 "A texture with all mip levels from a picture: uint8 codes of sRGB (srgb=False: data), or floats.")
            .def("load_texture", &loadTexture, py::arg("path"), py::kw_only(), py::arg("content") = "color",
                 "A texture from a PNG, JPEG, HDR or EXR file; content is color or data (normals, roughness).")
            .def("light_image", &lightImageOfArray, py::arg("pixels"), py::kw_only(), py::arg("shape") = "projected",
                 py::arg("srgb") = true, py::arg("name") = "",
                 "A cookie of lights from a picture: projected (of spots), tiled (of suns), octahedron or cube (of "
                 "points).")
            .def("load_light_image", &loadLightImageFile, py::arg("path"), py::kw_only(),
                 py::arg("shape") = "projected", "A cookie of lights from an image file; see light_image().");
}

} // namespace

EngineClass bindEngine(py::module_& module) {
    module.attr("__version__") = versionText();
    module.def("list_devices", &devices, "Every device that Engine() could use now, as dictionaries.");
    EngineClass engine(
            module, "Engine",
            "One device and everything made from it. It belongs to the thread that creates it. A context manager: "
            "leaving it closes the engine.");
    bindLoaded(module);
    engine.def(py::init(&makeEngine), py::arg("backend") = "vulkan", py::kw_only(), py::arg("require_device") = "",
               py::arg("workers") = -1, py::arg("exact_shaders") = true, py::arg("validation") = false,
               py::arg("cache_directory") = py::none(), py::arg("cache_programs") = false,
               py::arg("driver_self_test") = true)
            .def_property_readonly(
                    "device", [](EngineObject const& self) { return dictOf(self.owner->device()); },
                    "backend, device, driver, max_texture_size and max_samples.")
            .def_property_readonly(
                    "closed", [](EngineObject const& self) { return !self.owner->isOpen(); },
                    "Whether close() was called.")
            .def(
                    "close", [](EngineObject const& self) { self.owner->close(); },
                    "Ends the engine and everything made from it. Using that raises ClosedError from now on.")
            .def("__enter__", [](py::object const& self) { return self; })
            .def("__exit__", [](EngineObject const& self, py::args const&) { self.owner->close(); })
            .def(
                    "use_on_this_thread", [](EngineObject const& self) { self.owner->useOnThisThread(); },
                    "The calling thread becomes the engine's. ThreadError while a call is at work on another one.")
            .def(
                    "take_errors",
                    [](EngineObject const& self) {
                        const Owner::Call call(*self.owner);
                        return call.engine().takeErrors();
                    },
                    "The errors of the device since the last call. Renderer.render() raises them by itself.")
            .def(
                    "wait_idle",
                    [](EngineObject const& self) {
                        const Owner::Call call(*self.owner);
                        released([&] { call.engine().waitIdle(); });
                    },
                    "Waits until everything submitted has run.")
            .def("statistics", &statisticsOf, "Running totals: draws, pipelines, programs, commands, memory.");
    bindLoading(engine);
    return engine;
}

} // namespace filament_core::python
