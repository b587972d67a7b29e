// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfLoader.h"

#include "base/OutOfMemory.h"
#include "filament_core/assets/gltf/GltfAnimation.h"
#include "filament_core/assets/gltf/GltfBuffers.h"
#include "filament_core/assets/gltf/GltfContainer.h"
#include "filament_core/assets/gltf/GltfEnvironment.h"
#include "filament_core/assets/gltf/GltfImageStore.h"
#include "filament_core/assets/gltf/GltfMeshes.h"
#include "filament_core/assets/gltf/GltfParse.h"
#include "filament_core/assets/gltf/GltfPointer.h"
#include "filament_core/assets/gltf/GltfProfiles.h"
#include "filament_core/assets/gltf/GltfTextures.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "filament_core/assets/gltf/MeshFileModel.h"

#include <exception>
#include <mutex>

namespace filament_core::assets {
namespace {

/// Counts steps and reports them to the listener.
class Progress {
public:
    Progress(GltfOptions const& options, GltfStage stage, size_t total)
            : mOptions(options), mStage(stage), mTotal(total) {
        report();
    }

    void step() {
        const std::scoped_lock lock(mMutex);
        ++mDone;
        report();
    }

private:
    void report() const {
        if (mOptions.progress) mOptions.progress(mStage, mDone, mTotal);
    }

    GltfOptions const& mOptions;
    GltfStage mStage;
    size_t mTotal, mDone = 0;
    std::mutex mMutex;
};

bool isCancelled(GltfOptions const& options) { return options.cancellation && options.cancellation->isRequested(); }

/// Whether the load may go on.
bool goesOn(GltfOptions const& options, Diagnostics& diagnostics) {
    if (isCancelled(options)) diagnostics.refuse(ErrorCode::Cancelled, "loading was cancelled");
    return diagnostics.ok();
}

std::vector<bool> usedMaterials(GltfDocument const& document, GltfScene const& scene) {
    std::vector<bool> used(document.materials.size(), false);
    for (GltfMeshRequest const& request : scene.meshes) {
        for (GltfPrimitive const& primitive : document.meshes[request.mesh].primitives) {
            if (primitive.material != kNone) used[primitive.material] = true;
            for (VariantMaterial const& variant : primitive.variants) used[variant.material] = true;
        }
    }
    return used;
}

/// What is decoded: the jobs of the default scene.
struct Content {
    GltfTextures textures;
    GltfEnvironment environment;
    std::vector<GltfPrimitiveJob> primitives;

    size_t jobCount() const {
        return textures.jobs.size() + textures.lights.size() + textures.packs.size() + environment.faces.size() +
               primitives.size();
    }

    void mergeDiagnostics(Diagnostics& diagnostics) {
        // Every job has its own diagnostics, merged here in the order of the file: which fault is reported must not
        // depend on which worker was first.
        for (GltfPrimitiveJob& job : primitives) diagnostics.merge(std::move(job.diagnostics));
        for (GltfImageJob& job : textures.jobs) diagnostics.merge(std::move(job.diagnostics));
        for (GltfLightJob& job : textures.lights) diagnostics.merge(std::move(job.diagnostics));
        for (GltfPackJob& job : textures.packs) diagnostics.merge(std::move(job.diagnostics));
        for (GltfFaceJob& job : environment.faces) diagnostics.merge(std::move(job.diagnostics));
    }
};

/// The cube of a light, without texels: no job of a face reads another's.
void makeLevels(GltfDocument const& document, GltfEnvironment& environment) {
    if (environment.faces.empty()) return;
    GltfImageBasedLight const& light = document.imageBasedLights[document.imageBasedLight];
    for (size_t i = 0; i < light.levels.size(); ++i) environment.light.levels.emplace_back(light.size >> i);
}

/// Images and primitives are independent: they are all jobs of one group.
void loadContent(GltfDocument const& document, GltfScene const& scene, Content& content, jobs::JobSystem& jobs,
                 GltfOptions const& options) {
    Progress progress(options, GltfStage::Content, content.jobCount());
    makeLevels(document, content.environment);
    GltfTextures& textures = content.textures;
    // The calling thread forks one job for each image, so it takes a deque of its own instead of the shared queue.
    const jobs::AdoptedThread seat(jobs);
    jobs::JobGroup group(jobs);
    for (GltfImageJob& job : textures.jobs) {
        group.run<"decode image">([&document, &textures, &options, &progress, &job] {
            if (isCancelled(options)) return;
            decodeImageJob(document, textures, options.maxTextureSize, options.blocks, job);
            progress.step();
        });
    }
    for (GltfLightJob& job : textures.lights) {
        group.run<"decode light">([&document, &textures, &options, &progress, &job] {
            if (isCancelled(options)) return;
            decodeLightJob(document, textures, options.blocks, job);
            progress.step();
        });
    }
    for (GltfPackJob& job : textures.packs) {
        group.run<"pack images">([&document, &textures, &options, &progress, &job] {
            if (isCancelled(options)) return;
            packImagesJob(document, textures, options.maxTextureSize, job);
            progress.step();
        });
    }
    for (GltfFaceJob& job : content.environment.faces) {
        group.run<"decode face">([&document, &content, &options, &progress, &job] {
            if (isCancelled(options)) return;
            decodeFace(document, job, content.environment.light);
            progress.step();
        });
    }
    for (GltfPrimitiveJob& job : content.primitives) {
        group.run<"build primitive">([&document, &scene, &options, &progress, &job] {
            if (isCancelled(options)) return;
            buildPrimitive(document, scene, options.storage, job);
            progress.step();
        });
    }
    group.wait();
}

void readImages(GltfDocument const& document, GltfFolder const& folder, Content& content, jobs::JobSystem& jobs,
                GltfOptions const& options, Diagnostics& diagnostics) {
    std::vector<GltfImageSource*> sources;
    for (GltfImageSource& source : content.textures.sources) sources.push_back(&source);
    for (GltfFaceJob& job : content.environment.faces) sources.push_back(&job.source);
    jobs::parallelFor<"read image">(jobs, sources.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !isCancelled(options); ++i) {
            if (!sources[i]->isRead) readImage(document, folder, *sources[i]);
        }
    });
    if (!goesOn(options, diagnostics)) return;
    for (GltfImageSource* source : sources) diagnostics.merge(std::move(source->diagnostics));
    if (options.streams && diagnostics.ok()) options.streams->plan(document, content.textures, options.blocks);
    // The headers tell the sizes, so files that need too much memory are refused before anything is decoded.
    if (diagnostics.ok()) checkImageBudget(content.textures, diagnostics);
    if (diagnostics.ok()) checkFaces(document, content.environment, diagnostics);
}

void warnAboutAnimations(GltfDocument const& document, Diagnostics& diagnostics) {
    if (document.animations.empty()) return;
    diagnostics.warn("animations, also of skins and morph targets, are not played: the model is drawn at rest");
}

/// Properties of materials that the scene does not show keep their place, without an owner that it has: channels refer
/// to them by index.
void addAnimations(GltfAnimations animations, std::vector<uint32_t> const& newMaterial, ModelData& model) {
    model.animations = std::move(animations.animations);
    model.animatedProperties = std::move(animations.properties);
    for (AnimatedProperty& property : model.animatedProperties) {
        switch (property.owner) {
        case PropertyOwner::Node:
            property.rest = valueOf(model.nodes[property.object], property.name);
            break;
        case PropertyOwner::Material:
            property.object = newMaterial[property.object];
            if (property.object != kNone)
                property.rest = valueOf(model.materials[property.object], property.name, property.map);
            break;
        case PropertyOwner::Light:
            property.rest = valueOf(model.lights[property.object], property.name);
            break;
        case PropertyOwner::Camera:
            property.rest = valueOf(model.cameras[property.object], property.name);
            break;
        }
    }
}

GltfDocument loadDocument(std::span<const std::byte> file, GltfFolder const& folder, jobs::JobSystem& jobs,
                          Diagnostics& diagnostics) {
    const Result<GltfContainer> container = openGltfContainer(file);
    if (!container) {
        diagnostics.refuse(container.error());
        return {};
    }
    GltfDocument document = parseGltf(container->json, diagnostics);
    if (diagnostics.ok()) loadGltfBuffers(document, *container, folder, jobs, diagnostics);
    return document;
}

/// An .obj, .ply or .stl as a .glb, which the document refers to; empty: the file is another one.
std::vector<std::byte> convertMeshFile(std::span<const std::byte> file, GltfFolder const& folder,
                                       GltfOptions const& options, Diagnostics& diagnostics) {
    const std::optional<MeshFormat> format = meshFormatOf(options.name);
    if (!format) return {};
    Result<std::vector<std::byte>> glb = glbOfMeshFile(file, *format, folder, diagnostics);
    if (glb) return std::move(*glb);
    diagnostics.refuse(glb.error());
    return {};
}

ModelData load(std::span<const std::byte> file, GltfFolder const& folder, jobs::JobSystem& jobs,
               GltfOptions const& options, Diagnostics& diagnostics) {
    Progress structure(options, GltfStage::Structure, 1);
    if (!goesOn(options, diagnostics)) return {};
    const std::vector<std::byte> converted = convertMeshFile(file, folder, options, diagnostics);
    if (!converted.empty()) file = converted;
    if (!goesOn(options, diagnostics)) return {};
    GltfDocument document = loadDocument(file, folder, jobs, diagnostics);
    if (!goesOn(options, diagnostics)) return {};
    // The plan of the scene depends on both: nodes that an animation shows are needed even if they are hidden at rest,
    // and levels that are in no scene become siblings of their finest one.
    if (options.deformation == GltfDeformation::Kept) keepAnimated(document);
    if (options.levels == GltfLevels::All) adoptLevels(document);
    GltfScene scene = planScene(document, options.deformation, options.levels, diagnostics);
    Content content;
    content.primitives = listPrimitives(document, scene, diagnostics);
    if (!diagnostics.ok()) return {};
    structure.step();

    std::vector<uint32_t> newMaterial;
    // After the list of meshes: only materials that the scene shows are resolved, and only their images decoded.
    content.textures =
            planTextures(document, folder, usedMaterials(document, scene), options.normals, newMaterial, diagnostics);
    content.environment = planEnvironment(document);
    readImages(document, folder, content, jobs, options, diagnostics);
    GltfProfiles profiles;
    if (diagnostics.ok()) profiles = readProfiles(document, folder, scene.profiledLights, diagnostics);
    if (!diagnostics.ok()) return {};
    loadContent(document, scene, content, jobs, options);
    if (!goesOn(options, diagnostics)) return {};
    content.mergeDiagnostics(diagnostics);
    ModelData model;
    GltfAnimations animations;
    if (options.deformation == GltfDeformation::Kept)
        animations = readAnimations(document, scene, options.name, diagnostics);
    else
        warnAboutAnimations(document, diagnostics);
    if (!diagnostics.ok()) return {};

    model.name = options.name;
    model.images = collectImages(content.textures);
    model.materials = std::move(content.textures.materials);
    model.materialsOfFile.resize(model.materials.size(), kNone);
    for (uint32_t i = 0; i < newMaterial.size(); ++i)
        if (newMaterial[i] != kNone) model.materialsOfFile[newMaterial[i]] = i;
    model.imageBasedLight = finishEnvironment(document, std::move(content.environment));
    model.meshes = collectMeshes(document, scene, content.primitives);
    for (MeshData& mesh : model.meshes) {
        for (PrimitiveData& primitive : mesh.primitives) {
            if (primitive.material != kNone) primitive.material = newMaterial[primitive.material];
            for (VariantMaterial& variant : primitive.variants) variant.material = newMaterial[variant.material];
        }
    }
    model.nodes = std::move(scene.nodes);
    model.levels = std::move(scene.levels);
    model.cameras = std::move(document.cameras);
    model.skins = std::move(scene.skins);
    addProfiledLights(std::move(scene.profiledLights), std::move(profiles), document.lights, model);
    model.variants = std::move(document.variants);
    // Last, because the value at rest of an animated property is read from the finished nodes, materials, lights and
    // cameras.
    addAnimations(std::move(animations), newMaterial, model);
    model.warnings = diagnostics.takeWarnings();
    return model;
}

} // namespace

Result<ModelData> loadGltf(std::filesystem::path const& path, jobs::JobSystem& jobs, GltfOptions options) {
    try {
        options.name = path.filename().string();
        const Result<std::vector<std::byte>> file = readGltfFile(path);
        if (!file) return file.error();
        return loadGltfFromMemory(*file, path.parent_path(), jobs, options);
    } catch (std::bad_alloc const&) {
        return outOfMemory("glTF", options.name);
    } catch (std::exception const& exception) {
        return fail(ErrorCode::OutOfMemory, "{}: {}", options.name, exception.what());
    }
}

Result<ModelData> loadGltfFromMemory(std::span<const std::byte> file, std::filesystem::path const& baseDirectory,
                                     jobs::JobSystem& jobs, GltfOptions const& options) {
    try {
        Diagnostics diagnostics;
        ModelData model =
                load(file, GltfFolder(baseDirectory, options.files, options.resolve), jobs, options, diagnostics);
        if (!diagnostics.ok())
            return fail(diagnostics.error().code, "{}: {}", options.name, diagnostics.error().message);
        return model;
    } catch (std::bad_alloc const&) {
        return outOfMemory("glTF", options.name);
    } catch (std::exception const& exception) {
        return fail(ErrorCode::OutOfMemory, "{}: {}", options.name, exception.what());
    }
}

} // namespace filament_core::assets
