// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/LoadScene.h"

#include "base/Hash.h"
#include "filament_core/assets/environment/Panorama.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/assets/gltf/ModelVariants.h"
#include "toolkit/program/Console.h"
#include "toolkit/program/SceneFiles.h"

#include <glm/trigonometric.hpp>

#include <span>

namespace filament_core::reference {
namespace {

using tools::showProgress;

/// Null: none.
Result<std::shared_ptr<const assets::HdrImage>> skyOf(Options const& options, showcase::Files const& files,
                                                      assets::ModelData const& model, jobs::JobSystem& jobs) {
    if (options.environment.empty() && model.imageBasedLight) return pictureOfLight(model, jobs);
    if (files.environment.empty()) return std::shared_ptr<const assets::HdrImage>();
    showProgress("loading the environment");
    Result<assets::HdrImage> image = assets::readPanorama(files.environment);
    if (!image) return image.error();
    return std::make_shared<const assets::HdrImage>(std::move(*image));
}

} // namespace

Result<ReferenceScene> loadScene(Options const& options, jobs::JobSystem& jobs, std::vector<std::string>& warnings) {
    const Result<showcase::Files> files = tools::chooseFiles(options);
    if (!files) return files.error();
    showProgress("loading the model");
    const assets::FilesFrom from =
            options.modelOptions.filesFromAnywhere ? assets::FilesFrom::Anywhere : assets::FilesFrom::Folder;
    Result<assets::ModelData> model = assets::loadGltf(files->model, jobs, { .files = from });
    if (!model) return model.error();
    if (const Result<void> done = assets::selectVariant(*model, options.variant); !done) return done.error();
    warnings = model->warnings;
    ReferenceScene scene;
    const double4x4 fit = options.fit ? fitToUnitCube(modelBounds(*model)) : double4x4(1.0);
    scene.models.push_back({ std::make_shared<assets::ModelData>(std::move(*model)), fit });
    const auto image = skyOf(options, *files, *scene.models.back().data, jobs);
    if (!image) return image.error();
    if (*image) {
        scene.environment = { .image = *image,
                              .illuminance = options.iblIntensity,
                              .rotationRadians = static_cast<float>(glm::radians(options.rotationDegrees)),
                              .skybox = options.skybox };
    }
    if (options.sun) scene.suns.push_back(*options.sun);
    return scene;
}

uint64_t contentsOf(Options const& options, ReferenceScene const& scene) {
    uint64_t hash = 0;
    const auto add = [&hash](auto const& values) { hash = hashBytes(std::as_bytes(std::span(values)), hash); };
    if (const auto file = assets::readFileBytes(options.model); file) add(*file); // without one it is the showcase
    for (ReferenceModel const& model : scene.models) {
        for (assets::MeshData const& mesh : model.data->meshes) {
            for (assets::PrimitiveData const& primitive : mesh.primitives)
                add(primitive.vertices), add(primitive.indices);
        }
        for (assets::Image const& image : model.data->images) add(image.data);
    }
    if (scene.environment) add(scene.environment->image->pixels);
    return hash;
}

} // namespace filament_core::reference
