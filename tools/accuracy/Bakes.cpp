// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Bakes.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "tools/accuracy/TracedPicture.h"
#include "tools/bake/BakeModel.h"
#include "tools/bake/IrradianceBake.h"
#include "tools/bake/LightmapImage.h"
#include "tools/reference/TracedScene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::accuracy {
namespace {

namespace fs = std::filesystem;
using tools::SceneSpec;

constexpr double kIntoWalls = 0.05; // metres from the faces of the model to the box of its grid

/// What both kinds of bakes need.
struct Baker {
    SceneSpec const& spec;
    bake::BakeModel model;
    reference::TracedScenePtr scene;
    jobs::JobSystem& jobs;
};

Result<Baker> prepareBaker(SceneSpec const& spec, tools::SceneFolders const& folders, jobs::JobSystem& jobs) {
    if (spec.copies.size() != 1 || spec.copies.front() != double4x4(1.0) || spec.origin != double3(0.0))
        return fail(ErrorCode::InvalidArgument, "{}: a scene that is baked has its model at the origin, once",
                    spec.name);
    const Result<fs::path> path = modelFile(spec, folders);
    if (!path) return path.error();
    Result<bake::BakeModel> model = bake::readBakeModel(*path, jobs);
    if (!model) return model.error();
    const Result<reference::ReferenceScene> scene = referenceSceneOf(spec, folders, jobs);
    if (!scene) return scene.error();
    Result<reference::TracedScenePtr> traced = reference::prepare(*scene, jobs);
    if (!traced) return traced.error();
    return Baker{ spec, std::move(*model), std::move(*traced), jobs };
}

/// The file of the model with its lightmap.
Result<std::vector<std::byte>> bakeLightmap(Baker const& baker, double texelsPerMeter, uint32_t paths) {
    const Result<bake::Atlas> atlas =
            bake::makeAtlas(baker.model.surfaces, { .texelsPerMeter = texelsPerMeter }, baker.jobs);
    if (!atlas) return atlas.error();
    const std::vector<bake::AtlasTexel> texels = bake::findTexels(*atlas);
    const bake::LightSettings settings{ .samplesPerTexel = paths, .exposure = baker.spec.exposure };
    std::vector<bake::TexelLight> lights;
    bake::bakeTexels(*baker.scene, baker.model.surfaces, *atlas, texels, settings, baker.jobs,
                     [&](size_t, std::span<const bake::TexelLight> finished) {
                         lights.insert(lights.end(), finished.begin(), finished.end());
                         return true;
                     });
    const bake::LightmapImage image = bake::makeImage(*atlas, texels, lights);
    return bake::writeBakedModel(baker.model, *atlas,
                                 { { assets::encodeKtx2(halvesOf(image)) }, {}, image.intensity, false });
}

Result<IrradianceGridDesc> bakeGrid(Baker const& baker, double meters, uint32_t paths) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    double3 least(kFar), most(-kFar);
    for (bake::BakeSurface const& surface : baker.model.surfaces) {
        for (double3 const& position : surface.positions)
            least = glm::min(least, position), most = glm::max(most, position);
    }
    bake::GridSettings settings{ .spacingMeters = static_cast<float>(meters),
                                 .maxError = 1e6f,
                                 .leakPointsPerSide = 0 };
    settings.box.centerWorld = (least + most) * 0.5;
    settings.box.halfExtentMeters = float3(glm::max((most - least) * 0.5 - kIntoWalls, double3(1e-3)));
    settings.box.name = "baked";
    settings.maxProbes = 1; // the budget of exactly this grid: it is not refined
    for (int axis = 0; axis < 3; ++axis) {
        const float cells = std::ceil(2 * settings.box.halfExtentMeters[axis] / settings.spacingMeters);
        settings.maxProbes *= static_cast<uint32_t>(std::max(1.0f, cells)) + 1;
    }
    settings.probes.rays = paths;
    settings.probes.exposure = static_cast<double>(baker.spec.exposure.factor());
    Result<bake::BakedGrid> baked = bake::bakeIrradianceGrid(*baker.scene, settings, baker.jobs);
    return baked ? Result<IrradianceGridDesc>(std::move(baked->grid)) : baked.error();
}

} // namespace

Result<SceneSpec> Bakes::make(SceneSpec const& spec, BakeChoice const& choice, tools::SceneFolders const& folders) {
    if (!mJobs) mJobs.emplace();
    const Result<Baker> baker = prepareBaker(spec, folders, *mJobs);
    if (!baker) return baker.error();
    SceneSpec baked = spec;
    if (choice.gridMeters > 0) {
        Result<IrradianceGridDesc> grid = bakeGrid(*baker, choice.gridMeters, mGridPaths);
        if (!grid) return grid.error();
        baked.grids.push_back({ std::move(*grid), {} });
    }
    if (choice.texelsPerMeter > 0) {
        const Result<std::vector<std::byte>> file = bakeLightmap(*baker, choice.texelsPerMeter, mLightmapPaths);
        if (!file) return file.error();
        std::string name = fmt::format("{}-{}.glb", spec.name, choice.texelsPerMeter);
        std::ranges::replace(name, '/', '-');
        const fs::path path = fs::absolute(folders.work / "baked" / name);
        if (const Result<void> written = assets::replaceFile(path, *file); !written) return written.error();
        baked.modelObject = nullptr;
        baked.modelPath = path.string();
    }
    return baked;
}

Result<SceneSpec const*> Bakes::bake(SceneSpec const& spec, BakeChoice const& choice,
                                     tools::SceneFolders const& folders) {
    if (choice == BakeChoice{}) return &spec;
    const std::string key = fmt::format("{} {} {}", spec.name, choice.gridMeters, choice.texelsPerMeter);
    if (const auto found = mScenes.find(key); found != mScenes.end()) return &found->second;
    Result<SceneSpec> made = make(spec, choice, folders);
    if (!made) return made.error();
    return &mScenes.emplace(key, std::move(*made)).first->second;
}

} // namespace filament_core::accuracy
