// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/TracedScene.h"

#include "filament_core/assets/gltf/ModelBounds.h"
#include "tools/reference/Material.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {
namespace {

using assets::kNone;
using assets::ModelData;
using assets::NodeData;
using assets::PrimitiveData;

/// One primitive at one node, before conversion.
struct Placement {
    ModelData const* model = nullptr;
    PrimitiveData const* primitive = nullptr;
    double4x4 worldFromObject{ 1.0 };
    SurfaceFinish const* finish = nullptr;
    double sceneFromMesh = 1, worldFromScene = 1; // lengths
};

/// The scale of lengths, averaged over all directions.
double scaleOf(double4x4 const& transform) {
    const double scale = std::cbrt(std::abs(glm::determinant(double3x3(transform))));
    return scale > 0 ? scale : 1; // a flat object encloses no volume
}

bool isFinite(double4x4 const& m) {
    bool finite = true;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) finite = finite && std::isfinite(m[column][row]);
    }
    return finite;
}

assets::MaterialData const& materialOf(ModelData const& model, PrimitiveData const& primitive) {
    static const assets::MaterialData sDefault{ .name = "glTF default" };
    return primitive.material == kNone ? sDefault : model.materials[primitive.material];
}

/// EXT_lights_ies: along -Z of the node, the profile's +X along +X.
void addProfile(PointLight& point, assets::IesFile const& file, float3 direction, double4x4 const& world,
                ReferenceScene& lights) {
    point.directionWorld = direction;
    point.upWorld = float3(glm::cross(double3(world[0]), double3(direction)));
    lights.pointProfiles.resize(lights.points.size());
    lights.pointProfiles.back() = std::make_shared<const assets::IesFile>(file);
}

void addLight(ModelData const& model, uint32_t index, double4x4 const& world, ReferenceScene& lights) {
    if (index == kNone) return;
    assets::LightData const& light = model.lights[index];
    const double3 position(world[3]);
    const double3 axis = -double3(world[2]); // KHR_lights_punctual: along -Z of the node
    const float3 direction = glm::length(axis) > 0 ? float3(glm::normalize(axis)) : float3(0, 0, -1);
    switch (light.type) {
    case assets::LightType::Directional:
        lights.suns.push_back({ direction, Lux{ light.intensity }, light.color });
        break;
    case assets::LightType::Point:
        lights.points.push_back({ position, Candela{ light.intensity }, light.color, light.rangeMeters });
        if (light.profile != kNone)
            addProfile(lights.points.back(), model.profiles[light.profile].file, direction, world, lights);
        break;
    case assets::LightType::Spot:
        lights.spots.push_back({ position, direction, Candela{ light.intensity }, light.color, light.rangeMeters,
                                 light.innerConeRadians, light.outerConeRadians });
        break;
    }
}

bool isLight(float intensity, LinearColor color) {
    const float sum = color.x + color.y + color.z;
    return std::isfinite(intensity) && intensity >= 0 && std::isfinite(sum) && color.x >= 0 && color.y >= 0 &&
           color.z >= 0;
}

bool isDirection(float3 direction) {
    const float length = glm::length(direction);
    return std::isfinite(length) && length > 0;
}

bool isPosition(double3 position) {
    return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
}

template <class AreaLight>
bool isArea(AreaLight const& light, float x, float y) {
    return isLight(light.luminance.value, light.color) && isPosition(light.positionWorld) && isPosition({ x, y, 0 }) &&
           x >= 0 && y >= 0;
}

Result<void> checkScene(ReferenceScene const& scene) {
    for (ReferenceModel const& model : scene.models) {
        if (!model.data || !isFinite(model.worldFromModel)) {
            return fail(ErrorCode::InvalidArgument, "a model without data or with a transform that is not finite");
        }
    }
    if (scene.environment) {
        const auto& image = scene.environment->image;
        if (!image || image->width == 0 || image->pixels.size() != size_t(image->width) * image->height) {
            return fail(ErrorCode::InvalidArgument, "an environment without width * height pixels");
        }
        if (!(scene.environment->illuminance.value >= 0) || !std::isfinite(scene.environment->illuminance.value)) {
            return fail(ErrorCode::InvalidArgument, "environment illuminance {} lux: give a finite value >= 0",
                        scene.environment->illuminance.value);
        }
    }
    bool isValid = true;
    for (SunLight const& sun : scene.suns) {
        isValid = isValid && isLight(sun.illuminance.value, sun.color) && isDirection(sun.directionWorld);
    }
    for (PointLight const& point : scene.points) {
        isValid = isValid && isLight(point.intensity.value, point.color) && isPosition(point.positionWorld) &&
                  isDirection(point.directionWorld) && isPosition(double3(point.upWorld));
    }
    for (SpotLight const& spot : scene.spots) {
        isValid = isValid && isLight(spot.intensity.value, spot.color) && isPosition(spot.positionWorld) &&
                  isDirection(spot.directionWorld) && isPosition(double3(spot.upWorld));
    }
    for (RectLight const& rect : scene.rects) {
        isValid = isValid && isArea(rect, rect.widthMeters, rect.heightMeters) && isDirection(rect.directionWorld) &&
                  isPosition(double3(rect.upWorld));
    }
    for (DiscLight const& disc : scene.discs) {
        isValid = isValid && isArea(disc, disc.radiusMeters, disc.radiusMeters) && isDirection(disc.directionWorld);
    }
    for (TubeLight const& tube : scene.tubes) {
        isValid = isValid && isArea(tube, tube.lengthMeters, tube.radiusMeters) && isDirection(tube.axisWorld);
    }
    if (isValid) return {};
    return fail(ErrorCode::InvalidArgument,
                "a light whose intensity, color, size, position or direction is not usable: "
                "finite, not negative, directions not zero");
}

/// Walks the nodes once: collects what to trace and what shines, and reports what cannot be traced.
class Collector {
public:
    Collector(ReferenceScene const& scene, std::vector<std::string>& warnings) : lights(scene), mWarnings(warnings) {
        for (ReferenceModel const& model : scene.models) add(*model.data, model.worldFromModel, model.finish);
    }

    std::vector<Placement> placements;
    ReferenceScene lights; // those of the scene and its models
    Box bounds;

private:
    void add(ModelData const& model, double4x4 const& worldFromModel, SurfaceFinish const& finish) {
        size_t skipped = 0;
        for (NodeData const& node : model.nodes) {
            const double4x4 world = worldFromModel * node.worldFromNode;
            if (!isFinite(world)) continue;
            if (node.mesh != kNone) {
                for (PrimitiveData const& primitive : model.meshes[node.mesh].primitives) {
                    const bool isSurface = primitive.topology == backend::PrimitiveType::Triangles;
                    skipped += !isSurface;
                    if (!isSurface || primitive.indexCount < 3) continue;
                    placements.push_back({ &model, &primitive, world, &finish, scaleOf(node.worldFromNode),
                                           scaleOf(worldFromModel) });
                    assets::growBounds(bounds, primitive, world);
                }
            }
            addLight(model, node.light, world, lights);
            addLight(model, node.profiledLight, world, lights);
        }
        if (skipped > 0) {
            mWarnings.push_back(fmt::format("{}: {} primitives of lines or points have no surface and are left out",
                                            model.name, skipped));
        }
    }

    std::vector<std::string>& mWarnings;
};

std::vector<Part> makeParts(std::vector<Placement> const& placements, double3 origin, jobs::JobSystem& jobs) {
    std::vector<Part> parts(placements.size());
    jobs::parallelFor<"parts">(jobs, parts.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Placement const& placement = placements[i];
            parts[i] = makePart(*placement.primitive, placement.worldFromObject, origin);
            parts[i].material = &materialOf(*placement.model, *placement.primitive);
            parts[i].images = &placement.model->images;
            parts[i].finish = *placement.finish;
            parts[i].sceneFromMesh = placement.sceneFromMesh;
            parts[i].worldFromScene = placement.worldFromScene;
        }
    });
    return parts;
}

void moveLights(ReferenceScene& lights, double3 origin) {
    for (PointLight& point : lights.points) point.positionWorld -= origin;
    for (SpotLight& spot : lights.spots) spot.positionWorld -= origin;
    for (RectLight& rect : lights.rects) rect.positionWorld -= origin;
    for (DiscLight& disc : lights.discs) disc.positionWorld -= origin;
    for (TubeLight& tube : lights.tubes) tube.positionWorld -= origin;
}

} // namespace

Box modelBounds(ModelData const& model) { return assets::boundsOf(model); }

std::shared_ptr<const assets::HdrImage> pictureOfLight(ModelData const& model, jobs::JobSystem& jobs) {
    constexpr uint32_t kPixelsPerTexel = 4, kLeast = 128, kMost = 4096; // the horizon has four texels for one of a face
    if (!model.imageBasedLight) return nullptr;
    assets::CubeLight const& light = model.imageBasedLight->light;
    const uint32_t width = std::clamp(4 * kPixelsPerTexel * light.levels.front().size(), kLeast, kMost);
    return std::make_shared<const assets::HdrImage>(assets::pictureFromCube(light, width, jobs));
}

Result<TracedScenePtr> TracedScene::create(ReferenceScene const& scene, jobs::JobSystem& jobs) {
    if (const Result<void> checked = checkScene(scene); !checked) return checked.error();
    std::vector<std::string> warnings;
    Collector collected(scene, warnings);
    const double3 origin =
            collected.bounds.empty() ? double3(0.0) : (collected.bounds.min + collected.bounds.max) * 0.5;
    // About the centre of the scene: Embree computes in floats.
    std::vector<Part> parts = makeParts(collected.placements, origin, jobs);
    Result<Intersector> intersector = Intersector::build(parts);
    if (!intersector) return intersector.error();

    auto* const traced = new TracedScene(std::move(*intersector));
    TracedScenePtr result(traced);
    traced->mParts = std::move(parts); // moving the vector does not move its elements
    traced->mEmissiveLights = EmissiveLights(traced->mParts);
    traced->mOrigin = origin;
    traced->mWarnings = std::move(warnings);
    // Parts refer to materials and images of the models, which must live as long.
    for (ReferenceModel const& model : scene.models) traced->mModels.push_back(model.data);
    traced->mHasBlended = std::any_of(traced->mParts.begin(), traced->mParts.end(), [](Part const& part) {
        return part.material->alphaMode == assets::AlphaMode::Blend;
    });
    if (scene.environment && scene.environment->illuminance.value > 0) {
        traced->mEnvironment = EnvironmentLight(scene.environment->image, double(scene.environment->illuminance.value),
                                                double(scene.environment->rotationRadians));
    }
    if (scene.environment) traced->mEnvironmentLux = double(scene.environment->illuminance.value);
    traced->mSuns = collected.lights.suns;
    traced->mSkybox = scene.environment && scene.environment->skybox;
    // After the parts, about whose origin the lights stand as well.
    moveLights(collected.lights, origin);
    traced->mDirectLights = DirectLights({ collected.lights.suns, collected.lights.points, collected.lights.spots,
                                           collected.lights.rects, collected.lights.discs, collected.lights.tubes,
                                           collected.lights.pointProfiles, collected.lights.spotProfiles,
                                           collected.lights.sunImages, collected.lights.pointImages,
                                           collected.lights.spotImages, collected.lights.rectImages, origin },
                                         1.0);
    return result;
}

double3 TracedScene::transmittance(Ray const& ray, bool throughGlass) const {
    if (!mHasBlended && !throughGlass) return double3(mIntersector.isOccluded(ray) ? 0.0 : 1.0);
    Ray rest = ray;
    PassedTriangles passed;
    rest.passed = &passed;
    double3 share(1.0);
    while (share != double3(0.0) && !passed.isFull()) {
        const std::optional<Hit> hit = nearest(rest);
        if (!hit) return share;
        const double opacity = opacityAt(part(*hit), hit->point);
        share *= throughGlass ? 1.0 - opacity * (1.0 - passedAt(part(*hit), hit->point, ray.direction))
                              : double3(1.0 - opacity);
        passed.triangles[passed.count++] = { hit->part, hit->point.triangle };
        rest.nearest = hit->distance;
    }
    return double3(0.0);
}

void TracedSceneDeleter::operator()(TracedScene const* scene) const { delete scene; }

Result<TracedScenePtr> prepare(ReferenceScene const& scene, jobs::JobSystem& jobs) {
    return TracedScene::create(scene, jobs);
}

std::vector<std::string> const& warnings(TracedScene const& scene) { return scene.warnings(); }

} // namespace filament_core::reference
