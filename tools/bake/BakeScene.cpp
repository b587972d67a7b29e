// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/BakeScene.h"

#include "base/Hash.h"
#include "filament_core/assets/environment/Panorama.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "toolkit/machine/Machine.h"
#include "tools/bake/Densities.h"

#include <glm/trigonometric.hpp>

#include <algorithm>

namespace filament_core::bake {
namespace {

Result<reference::ReferenceScene> loadScene(Options const& options, jobs::JobSystem& jobs,
                                            std::vector<std::string>& warnings) {
    Result<assets::ModelData> model = assets::loadGltf(options.model, jobs);
    if (!model) return model.error();
    warnings = model->warnings;
    reference::ReferenceScene scene;
    scene.models.push_back({ std::make_shared<assets::ModelData>(std::move(*model)) });
    std::shared_ptr<const assets::HdrImage> sky;
    if (options.environment.empty()) {
        sky = reference::pictureOfLight(*scene.models.front().data, jobs);
    } else if (options.environment != "none") {
        Result<assets::HdrImage> image = assets::readPanorama(options.environment);
        if (!image) return image.error();
        sky = std::make_shared<const assets::HdrImage>(std::move(*image));
    }
    if (sky) {
        scene.environment = { .image = sky,
                              .illuminance = options.iblIntensity,
                              .rotationRadians = static_cast<float>(glm::radians(options.rotationDegrees)),
                              .skybox = false }; // images of the report compare surfaces
    }
    if (options.sun) scene.suns.push_back(*options.sun);
    return scene;
}

class Hasher {
public:
    void add(auto const& values) { mHash = hashBytes(std::as_bytes(std::span(values)), mHash); }
    void addNumbers(std::initializer_list<double> values) { add(std::vector<double>(values)); }
    uint64_t hash() const { return mHash; }

private:
    uint64_t mHash = hashString(tools::builtCommit()); // the build computes the light
};

/// Everything that changes the light of the scene.
void addScene(Hasher& hasher, Options const& options, std::span<const std::byte> file,
              reference::ReferenceScene const& scene) {
    hasher.add(file);
    for (reference::ReferenceModel const& model : scene.models) {
        for (assets::MeshData const& mesh : model.data->meshes) {
            for (assets::PrimitiveData const& primitive : mesh.primitives)
                hasher.add(primitive.vertices), hasher.add(primitive.indices);
        }
        for (assets::Image const& image : model.data->images) hasher.add(image.data);
    }
    if (scene.environment) hasher.add(scene.environment->image->pixels);
    hasher.addNumbers(
            { double(options.light.exposure.factor()), double(options.iblIntensity.value), options.rotationDegrees });
    if (!options.sun) return;
    float3 const& direction = options.sun->directionWorld;
    hasher.addNumbers(
            { double(options.sun->illuminance.value), double(direction.x), double(direction.y), double(direction.z) });
}

uint64_t hashOf(Options const& options, BakeScene const& bake, reference::ReferenceScene const& scene) {
    Hasher hasher;
    addScene(hasher, options, bake.model.file, scene);
    for (BakeSurface const& surface : bake.model.surfaces) hasher.add(surface.positions), hasher.add(surface.indices);
    for (AtlasSurface const& surface : bake.atlas.surfaces) hasher.add(surface.uvs);
    LightSettings const& light = options.light;
    hasher.addNumbers({ double(bake.atlas.side), double(bake.atlas.pages), bake.atlas.texelsPerMeter,
                        double(light.samplesPerTexel), light.relativeError, double(light.directLight),
                        double(light.maxBounces), double(light.seed), double(options.heldOutPoints),
                        light.occlusionMeters.value_or(0) });
    return hasher.hash();
}

/// Each once.
void addWarnings(std::vector<std::string>& warnings, std::vector<std::string> const& lines) {
    for (std::string const& line : lines) {
        if (std::ranges::find(warnings, line) == warnings.end()) warnings.push_back(line);
    }
}

} // namespace

Result<reference::TracedScenePtr> traceScene(Options const& options, jobs::JobSystem& jobs,
                                             std::vector<std::string>& warnings, uint64_t& hash) {
    const Result<reference::ReferenceScene> scene = loadScene(options, jobs, warnings);
    if (!scene) return scene.error();
    const Result<std::vector<std::byte>> file = assets::readGltfFile(options.model);
    if (!file) return file.error();
    Hasher hasher;
    addScene(hasher, options, *file, *scene);
    hash = hasher.hash();
    Result<reference::TracedScenePtr> traced = reference::prepare(*scene, jobs);
    if (traced) addWarnings(warnings, reference::warnings(**traced));
    return traced;
}

Result<BakeScene> prepareBake(Options const& options, jobs::JobSystem& jobs) {
    BakeScene bake;
    Result<BakeModel> model = readBakeModel(options.model, jobs);
    if (!model) return model.error();
    bake.model = std::move(*model);
    const Result<reference::ReferenceScene> scene = loadScene(options, jobs, bake.warnings);
    if (!scene) return scene.error();
    Result<reference::TracedScenePtr> traced = reference::prepare(*scene, jobs);
    if (!traced) return traced.error();
    bake.scene = std::move(*traced);
    std::vector<BakeSurface> const& surfaces = bake.model.surfaces;
    Result<Atlas> atlas = options.texels > 0 ? makeBudgetAtlas(*bake.scene, surfaces, options.atlas, options.light,
                                                               options.texels, jobs)
                                             : makeAtlas(surfaces, options.atlas, jobs);
    if (!atlas) return atlas.error();
    bake.atlas = std::move(*atlas);
    bake.texels = findTexels(bake.atlas);
    bake.heldOut = heldOutPoints(surfaces, bake.atlas, options.heldOutPoints, options.light.seed);
    bake.hash = hashOf(options, bake, *scene);
    addWarnings(bake.warnings, bake.model.warnings);
    addWarnings(bake.warnings, reference::warnings(*bake.scene));
    return bake;
}

} // namespace filament_core::bake
