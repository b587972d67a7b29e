// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfLoader.h"

#include "base/OutOfMemory.h"
#include "filament_core/assets/gltf/GltfAnimation.h"
#include "filament_core/assets/gltf/GltfBuffers.h"
#include "filament_core/assets/gltf/GltfContainer.h"
#include "filament_core/assets/gltf/GltfMeshes.h"
#include "filament_core/assets/gltf/GltfParse.h"
#include "filament_core/assets/gltf/GltfTextures.h"
#include "filament_core/assets/gltf/GltfUri.h"

#include <exception>
#include <mutex>

namespace filament::assets {
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

/// Images and primitives are independent: they are all jobs of one group.
void loadContent(GltfDocument const& document, GltfScene const& scene, GltfTextures& textures,
                 std::vector<GltfPrimitiveJob>& primitives, jobs::JobSystem& jobs, GltfOptions const& options) {
    Progress progress(options, GltfStage::Content, textures.jobs.size() + textures.packs.size() + primitives.size());
    const jobs::AdoptedThread seat(jobs);
    jobs::JobGroup group(jobs);
    for (GltfImageJob& job : textures.jobs) {
        group.run<"decode image">([&document, &textures, &options, &progress, &job] {
            decodeImageJob(document, textures, options.maxTextureSize, job);
            progress.step();
        });
    }
    for (GltfPackJob& job : textures.packs) {
        group.run<"pack images">([&document, &textures, &options, &progress, &job] {
            packImagesJob(document, textures, options.maxTextureSize, job);
            progress.step();
        });
    }
    for (GltfPrimitiveJob& job : primitives) {
        group.run<"build primitive">([&document, &scene, &options, &progress, &job] {
            buildPrimitive(document, scene, options.storage, job);
            progress.step();
        });
    }
    group.wait();
}

void readImages(GltfDocument const& document, GltfFolder const& folder, GltfTextures& textures, jobs::JobSystem& jobs,
                Diagnostics& diagnostics) {
    jobs::parallelFor<"read image">(jobs, textures.sources.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) readImage(document, folder, textures.sources[i]);
    });
    for (GltfImageSource& source : textures.sources) diagnostics.merge(std::move(source.diagnostics));
    if (diagnostics.ok()) checkImageBudget(textures, diagnostics);
}

void warnAboutAnimations(GltfDocument const& document, Diagnostics& diagnostics) {
    if (document.animations.empty()) return;
    diagnostics.warn("animations, also of skins and morph targets, are not played: the model is drawn at rest");
}

void mergeDiagnostics(GltfTextures& textures, std::vector<GltfPrimitiveJob>& primitives, Diagnostics& diagnostics) {
    for (GltfPrimitiveJob& job : primitives) diagnostics.merge(std::move(job.diagnostics));
    for (GltfImageJob& job : textures.jobs) diagnostics.merge(std::move(job.diagnostics));
    for (GltfPackJob& job : textures.packs) diagnostics.merge(std::move(job.diagnostics));
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

ModelData load(std::span<const std::byte> file, GltfFolder const& folder, jobs::JobSystem& jobs,
               GltfOptions const& options, Diagnostics& diagnostics) {
    Progress structure(options, GltfStage::Structure, 1);
    GltfDocument document = loadDocument(file, folder, jobs, diagnostics);
    if (!diagnostics.ok()) return {};
    GltfScene scene = planScene(document, options.deformation, diagnostics);
    std::vector<GltfPrimitiveJob> primitives = listPrimitives(document, scene, diagnostics);
    if (!diagnostics.ok()) return {};
    structure.step();

    std::vector<uint32_t> newMaterial;
    GltfTextures textures = planTextures(document, usedMaterials(document, scene), newMaterial, diagnostics);
    readImages(document, folder, textures, jobs, diagnostics);
    if (!diagnostics.ok()) return {};
    loadContent(document, scene, textures, primitives, jobs, options);
    mergeDiagnostics(textures, primitives, diagnostics);
    ModelData model;
    if (options.deformation == GltfDeformation::Kept)
        model.animations = readAnimations(document, scene, diagnostics);
    else
        warnAboutAnimations(document, diagnostics);
    if (!diagnostics.ok()) return {};

    model.name = options.name;
    model.images = collectImages(textures);
    model.materials = std::move(textures.materials);
    model.meshes = collectMeshes(document, scene, primitives);
    for (MeshData& mesh : model.meshes) {
        for (PrimitiveData& primitive : mesh.primitives) {
            if (primitive.material != kNone) primitive.material = newMaterial[primitive.material];
            for (VariantMaterial& variant : primitive.variants) variant.material = newMaterial[variant.material];
        }
    }
    model.nodes = std::move(scene.nodes);
    model.skins = std::move(scene.skins);
    model.lights = std::move(document.lights);
    model.variants = std::move(document.variants);
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
        ModelData model = load(file, GltfFolder(baseDirectory, options.files), jobs, options, diagnostics);
        if (!diagnostics.ok())
            return fail(diagnostics.error().code, "{}: {}", options.name, diagnostics.error().message);
        return model;
    } catch (std::bad_alloc const&) {
        return outOfMemory("glTF", options.name);
    } catch (std::exception const& exception) {
        return fail(ErrorCode::OutOfMemory, "{}: {}", options.name, exception.what());
    }
}

} // namespace filament::assets
