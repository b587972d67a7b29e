// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/TracedPicture.h"

#include "filament_core/assets/environment/Panorama.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "toolkit/scenes/MaterialModel.h"

#include <type_traits>

namespace filament_core::accuracy {
namespace {

using reference::ReferenceScene;
using tools::SceneSpec;

void add(ReferenceScene& scene, LightDesc const& light, reference::ProfilePtr const& profile,
         reference::LightPicturePtr const& image) {
    std::visit(
            [&](auto const& one) {
                using L = std::remove_cvref_t<decltype(one)>;
                if constexpr (std::is_same_v<L, SunLight>)
                    scene.suns.push_back(one), scene.sunImages.push_back(image);
                else if constexpr (std::is_same_v<L, PointLight>)
                    scene.points.push_back(one), scene.pointProfiles.push_back(profile),
                            scene.pointImages.push_back(image);
                else if constexpr (std::is_same_v<L, SpotLight>)
                    scene.spots.push_back(one), scene.spotProfiles.push_back(profile),
                            scene.spotImages.push_back(image);
                else if constexpr (std::is_same_v<L, RectLight>)
                    scene.rects.push_back(one), scene.rectImages.push_back(image);
                else if constexpr (std::is_same_v<L, DiscLight>)
                    scene.discs.push_back(one);
                else
                    scene.tubes.push_back(one);
            },
            light);
}

/// Null without a file.
Result<reference::ProfilePtr> profileOf(std::filesystem::path const& file) {
    if (file.empty()) return reference::ProfilePtr();
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    Result<assets::IesFile> profile = assets::readIes(*bytes, file.filename().string());
    if (!profile) return profile.error();
    return std::make_shared<const assets::IesFile>(std::move(*profile));
}

/// Null without a file.
Result<reference::LightPicturePtr> imageOf(tools::LightImageFile const& image) {
    if (image.file.empty()) return reference::LightPicturePtr();
    const Result<Image> loaded = loadImage(image.file);
    if (!loaded) return loaded.error();
    return reference::lightPictureOf(*loaded, image.shape);
}

/// Copies of a material may differ, those of a model do not.
Result<reference::ReferenceModel> modelOf(SceneSpec const& spec, size_t copy, tools::SceneFolders const& folders,
                                          jobs::JobSystem& jobs, MaterialFeatures* features) {
    if (tools::isMaterialModel(spec)) {
        Result<TracedMaterial> traced = tracedMaterialOf(spec, copy);
        if (!traced) return traced.error();
        if (features) *features = traced->features;
        return std::move(traced->model);
    }
    const Result<std::filesystem::path> path = modelFile(spec, folders);
    if (!path) return path.error();
    Result<assets::ModelData> model = assets::loadGltf(*path, jobs);
    if (!model) return model.error();
    return reference::ReferenceModel{ std::make_shared<assets::ModelData>(std::move(*model)) };
}

} // namespace

Result<ReferenceScene> referenceSceneOf(SceneSpec const& spec, tools::SceneFolders const& folders,
                                        jobs::JobSystem& jobs, MaterialFeatures* features) {
    Result<reference::ReferenceModel> model = modelOf(spec, 0, folders, jobs, features);
    if (!model) return model.error();
    ReferenceScene scene;
    const std::vector<double4x4> copies = placedCopies(spec);
    for (size_t i = 0; i < copies.size(); ++i) {
        const bool hasOwnValues = i > 0 && i < spec.copyValues.size() && spec.copyValues[i] != spec.copyValues[i - 1];
        if (hasOwnValues) model = modelOf(spec, i, folders, jobs, features);
        if (!model) return model.error();
        model->worldFromModel = copies[i];
        scene.models.push_back(*model);
    }
    const std::vector<LightDesc> lights = placedLights(spec);
    for (size_t i = 0; i < lights.size(); ++i) {
        Result<reference::ProfilePtr> profile = profileOf(profileFile(spec, i, folders));
        if (!profile) return profile.error();
        Result<reference::LightPicturePtr> image = imageOf(imageFile(spec, i, folders));
        if (!image) return image.error();
        add(scene, lights[i], *profile, *image);
    }

    const Result<std::filesystem::path> skyPath = environmentFile(spec, folders);
    if (!skyPath) return skyPath.error();
    std::shared_ptr<const assets::HdrImage> picture;
    if (skyPath->empty()) {
        picture = reference::pictureOfLight(*model->data, jobs);
    } else {
        Result<assets::HdrImage> sky = assets::readPanorama(*skyPath);
        if (!sky) return sky.error();
        picture = std::make_shared<const assets::HdrImage>(std::move(*sky));
    }
    if (!picture) return scene;
    scene.environment = { .image = std::move(picture),
                          .illuminance = spec.environmentSettings.illuminance,
                          .rotationRadians = spec.environmentSettings.rotationRadians,
                          .skybox = spec.environmentSettings.skybox };
    return scene;
}

reference::BsdfModel bsdfOf(Quality const& quality) {
    return { .visibility = quality.specularVisibility,
             .fresnel = quality.fresnel,
             .diffuse = quality.diffuse,
             .energy = quality.energyCompensation ? reference::EnergyTerm::Compensated
                                                  : reference::EnergyTerm::SingleScatter,
             .coupling =
                     quality.diffuseCoupling ? reference::CouplingTerm::Engine : reference::CouplingTerm::AmbientOnly };
}

Result<TracedPicture> trace(ReferenceScene const& scene, View const& view, uint32_t samplesPerPixel,
                            jobs::JobSystem& jobs, reference::Integrator integrator) {
    const bool isOccluded = view.effects.ambientOcclusion.enabled;
    const reference::ReferenceSettings settings{ .integrator = integrator,
                                                 .samplesPerPixel = samplesPerPixel,
                                                 .filter = reference::PixelFilter::Center,
                                                 .bsdf = bsdfOf(view.quality),
                                                 .lightsCastShadows = view.quality.shadows != ShadowFilter::Off,
                                                 .coloredShadows = view.quality.coloredShadows,
                                                 .occlusionRadius =
                                                         isOccluded ? view.effects.ambientOcclusion.radiusMeters : 0.0,
                                                 .occlusionBends = view.effects.ambientOcclusion.bentNormals };
    Result<reference::ReferenceImage> image = reference::render(
            scene, { view.camera, view.size, view.clearColor, view.effects.fog, view.timeSeconds }, settings, jobs);
    if (!image) return image.error();
    return TracedPicture{ { image->width, image->height, std::move(image->color) }, image->statistics.relativeError };
}

} // namespace filament_core::accuracy
