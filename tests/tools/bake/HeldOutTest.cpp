// SPDX-License-Identifier: Apache-2.0
// The errors that reports state, beside light that is traced with many more paths at random places: at 95 % of them the
// difference is within what the report says of it.
#include "tools/bake/HeldOut.h"
#include "base/math/IrradianceSh.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/scene/SampleGrid.h"
#include "shaders/interface/ShaderInterface.h"
#include "tests/tools/bake/BakeRun.h"
#include "tests/tools/bake/GridRooms.h"
#include "toolkit/interiors/Interiors.h"
#include "toolkit/json/JsonFile.h"
#include "tools/bake/IrradianceProbes.h"
#include "tools/reference/SampleStream.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <random>

namespace filament_core::bake {
namespace {

using reference::makePart;
using reference::Part;

constexpr size_t kPlaces = 1000;
constexpr uint32_t kTimesPaths = 16; // of a texel: those of the truth

/// A room of GridRooms.h that a panel below its ceiling lights.
assets::GlbScene litRoom(uint32_t seed) {
    const test::GridRoom room = test::makeRoom(seed);
    assets::GlbScene scene{ .name = "room" };
    scene.materials.resize(2);
    scene.materials[0].baseColorFactor = { 0.7f, 0.6f, 0.5f, 1 };
    scene.materials[1].emissiveFactor = { 1, 0.9f, 0.8f };
    scene.materials[1].emissiveStrength = 20;
    for (assets::MaterialData& material : scene.materials) material.metallicFactor = 0, material.roughnessFactor = 1;
    const auto add = [&](const char* name, std::vector<test::RoomBox> const& boxes, uint32_t material) {
        const assets::PrimitiveData data = test::boxesPrimitive(boxes);
        assets::GlbPrimitive primitive{ .indices = reference::decodeIndices(data), .material = material };
        for (float4 const& position : reference::decodeAttribute(data, shader::kAttributePosition))
            primitive.positions.emplace_back(position);
        scene.nodes.push_back({ .name = name, .mesh = static_cast<uint32_t>(scene.meshes.size()) });
        scene.meshes.push_back({ name, { primitive } });
    };
    add("walls", room.boxes, 0);
    const float top = room.half.y;
    add("panel", { { { -0.7f * room.half.x, 0.9f * top, -0.5f * room.half.z }, { 0.2f, 0.02f, 0.3f } } }, 1);
    return scene;
}

/// The surfaces of a model in the world, each with the lightmap that its material names.
class LitSurfaces {
public:
    explicit LitSurfaces(assets::ModelData const& model) : mModel(model) {
        for (assets::NodeData const& node : model.nodes) {
            if (node.mesh == assets::kNone) continue;
            for (assets::PrimitiveData const& primitive : model.meshes[node.mesh].primitives) {
                Part part = makePart(primitive, node.worldFromNode, double3(0.0));
                for (uint32_t i = 0; i + 2 < part.indices.size(); i += 3) {
                    mArea += areaOf(part, i);
                    mEnds.push_back({ mArea, mParts.size(), i });
                }
                mMaterials.push_back(primitive.material);
                mParts.push_back(std::move(part));
            }
        }
    }

    struct Place {
        SurfacePoint point{};
        double2 texel{ 0.0 };
        double3 stored{ 0.0 }; ///< lux
    };
    Place random(std::minstd_rand& numbers) const {
        std::uniform_real_distribution<double> unit(0, 1);
        const auto end = std::ranges::lower_bound(mEnds, unit(numbers) * mArea, {}, &End::area);
        Part const& part = mParts[end->part];
        const double root = std::sqrt(unit(numbers)), share = unit(numbers);
        const std::array weights{ 1 - root, root * (1 - share), root * share };
        const auto corner = [&](size_t i) { return part.indices[end->first + i]; };
        Place place;
        double2 uv(0.0);
        for (size_t i = 0; i < 3; ++i) {
            place.point.position += weights[i] * double3(part.positions[corner(i)]);
            uv += weights[i] * double2(part.uvs[1][corner(i)]);
        }
        const double3 a(part.positions[corner(0)]), b(part.positions[corner(1)]), c(part.positions[corner(2)]);
        place.point.faceNormal = place.point.normal = glm::normalize(glm::cross(b - a, c - a));
        place.point.longestEdge = std::max(glm::distance(a, b), glm::distance(a, c));
        auto const& light = mModel.materials[mMaterials[end->part]].light;
        assets::Image const& image = mModel.images[light.map.image];
        place.texel = uv * double2(image.width, image.height);
        place.stored = double3(lookUp(image, place.texel)) * double(light.intensityLux);
        return place;
    }

private:
    struct End {
        double area = 0;
        size_t part = 0;
        uint32_t first = 0;
    };
    static double areaOf(Part const& part, uint32_t first) {
        const double3 a(part.positions[part.indices[first]]);
        return glm::length(glm::cross(double3(part.positions[part.indices[first + 1]]) - a,
                                      double3(part.positions[part.indices[first + 2]]) - a));
    }

    assets::ModelData const& mModel;
    std::vector<Part> mParts;
    std::vector<uint32_t> mMaterials;
    std::vector<End> mEnds;
    double mArea = 0;
};

struct Truth {
    double lux = 0, errorLux = 0;
    bool isHidden = false;
};

/// At each place, in parallel.
std::vector<Truth> traceMany(reference::TracedScene const& scene, std::span<const SurfacePoint> points, uint32_t paths,
                             jobs::JobSystem& jobs) {
    const LightSettings settings{ .samplesPerTexel = paths,
                                  .exposure = { .aperture = 16, .shutterSeconds = 0.008f, .iso = 100 } };
    const reference::ReferenceSettings tracing{ .seed = 4711 };
    const reference::PathTracer tracer(scene, tracing, double(settings.exposure.factor()), double3(0.0));
    std::vector<Truth> truths(points.size());
    jobs::parallelFor<"truth">(jobs, points.size(), 4, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const TexelLight light = lightOf(tracer, scene.origin(), points[i], reference::hashOf(99, i), settings);
            truths[i] = { luminanceOf(light.irradiance), luminanceOf(light.standardError), light.backs > kMostBacks };
        }
    });
    return truths;
}

/// The root mean square of the standard errors of the chart around a texel, as the report states it; of the charts
/// there on several pages, the largest.
double statedError(tools::Json const& charts, double2 texel) {
    double largest = -1;
    for (tools::Json const& chart : charts) {
        const auto box = chart["place"].get<std::array<double, 4>>();
        const bool isIn =
                texel.x >= box[0] && texel.y >= box[1] && texel.x < box[0] + box[2] && texel.y < box[1] + box[3];
        if (isIn) largest = std::max(largest, chart["relativeError"].get<double>() * chart["meanLux"].get<double>());
    }
    EXPECT_GE(largest, 0) << "no chart at " << texel.x << ", " << texel.y;
    return largest;
}

class HeldOut : public test::BakeRun {
protected:
    jobs::JobSystem jobs{ { .workers = 1 } };

    reference::TracedScenePtr traced(char const* file) {
        Result<assets::ModelData> model = assets::loadGltf(mFolder / file, jobs);
        EXPECT_TRUE(model) << model.error().message;
        reference::ReferenceScene scene;
        scene.models.push_back({ std::make_shared<assets::ModelData>(std::move(*model)) });
        Result<reference::TracedScenePtr> made = reference::prepare(scene, jobs);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }

    struct Holds {
        double within = 0;      ///< part of the places that lie within the stated error
        double withinNoise = 0; ///< and within two standard errors alone
        double bound = 0;       ///< the stated error of interpolation over the mean light of the places
    };
    /// Bakes a scene and compares the report with what is traced at random places.
    void bake(assets::GlbScene const& scene, uint32_t density, uint32_t paths, Holds& holds, char const* more = "") {
        write("scene.glb", scene);
        const Outcome outcome =
                run(fmt::format("scene.glb --out baked --density {} --samples {} {}", density, paths, more));
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        const Result<tools::Json> report = tools::readJson(mFolder / "baked/report.json");
        ASSERT_TRUE(report) << report.error().message;
        const Result<assets::ModelData> model = assets::loadGltf(mFolder / "baked/baked.glb", jobs);
        ASSERT_TRUE(model) << model.error().message;
        const LitSurfaces surfaces(*model);
        std::minstd_rand numbers(17);
        std::vector<LitSurfaces::Place> places;
        std::vector<SurfacePoint> points;
        for (size_t i = 0; i < kPlaces; ++i) {
            places.push_back(surfaces.random(numbers));
            points.push_back(places.back().point);
        }
        const std::vector<Truth> truths = traceMany(*traced("scene.glb"), points, kTimesPaths * paths, jobs);
        const double bound = (*report)["heldOut"]["interpolationLux"].get<double>();
        double seen = 0, lux = 0;
        for (size_t i = 0; i < kPlaces; ++i) {
            const bool isDark = truths[i].lux == 0 && places[i].stored == double3(0.0);
            if (truths[i].isHidden || isDark) continue;
            const double noise = 2 * statedError((*report)["charts"], places[i].texel);
            const double error = std::abs(luminanceOf(places[i].stored) - truths[i].lux);
            ++seen, lux += truths[i].lux;
            holds.within += error <= noise + bound;
            holds.withinNoise += error <= noise;
        }
        ASSERT_GT(seen, 0.3 * kPlaces);
        RecordProperty("within", std::to_string(holds.within / seen));
        holds = { holds.within / seen, holds.withinNoise / seen, bound * seen / lux };
    }
};

TEST_F(HeldOut, AFineLightmapOfACornellBoxIsWithinItsReportAt95Percent) {
    Holds holds;
    bake(interiors::cornellBox().model, 8, 64, holds);
    EXPECT_GE(holds.within, 0.95);
    EXPECT_LT(holds.bound, 0.25);
}

// Two texels a metre: most of the error is that of interpolation, which the standard errors of texels do not know.
TEST_F(HeldOut, ACoarseLightmapIsToo) {
    Holds holds;
    bake(interiors::cornellBox().model, 2, 128, holds);
    EXPECT_GE(holds.within, 0.95);
    EXPECT_LT(holds.withinNoise, 0.95) << "the bound says nothing";
    EXPECT_LT(holds.bound, 0.6);
}

// Each point is looked up on the page that the material of its triangle names.
TEST_F(HeldOut, SoIsOneOnSeveralPages) {
    Holds holds;
    bake(interiors::cornellBox().model, 6, 64, holds, "--max-size 40 --levels 3");
    EXPECT_GE(holds.within, 0.95);
    EXPECT_LT(holds.bound, 0.4);
}

// Stored in 1.5 bytes a texel, with an error that the bound knows, because it was found on what was stored.
TEST_F(HeldOut, SoIsOneOfBlocks) {
    Holds holds;
    bake(interiors::cornellBox().model, 6, 64, holds, "--store bc6h");
    EXPECT_GE(holds.within, 0.95);
    EXPECT_LT(holds.bound, 0.4);
}

TEST_F(HeldOut, LightmapsOfRoomsAreToo) {
    for (const uint32_t seed : { 1u, 2u }) {
        Holds holds;
        bake(litRoom(seed), 3, 64, holds);
        EXPECT_GE(holds.within, 0.95) << "room " << seed;
    }
}

/// Luminance of irradiance / pi in the six directions of the axes, from the definition of the coefficients.
std::array<double, 6> sixLights(scene::IrradianceSh const& sh) {
    std::array<double, 6> values{};
    for (size_t i = 0; i < 6; ++i) {
        double3 n(0.0);
        n[static_cast<int>(i / 2)] = i % 2 == 0 ? -1 : 1;
        const std::array<double, 9> basis{
            1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.z * n.x, n.x * n.x - n.y * n.y
        };
        for (size_t k = 0; k < 9; ++k) values[i] += luminanceOf(basis[k] * double3(sh[k]));
    }
    return values;
}

class HeldOutGrid : public HeldOut {
protected:
    /// As bake(), at random places in the air.
    void bakeGrid(assets::GlbScene const& scene, double3 at, float3 half, float spacing, uint32_t paths, Holds& holds) {
        write("scene.glb", scene);
        std::ofstream(mFolder / "grid.json")
                << fmt::format(R"({{"name": "air", "at": [{}, {}, {}], "halfExtent": [{}, {}, {}], "spacing": {},
                    "maxProbes": 300, "paths": {}, "leakPoints": 0}})",
                               at.x, at.y, at.z, half.x, half.y, half.z, spacing, paths);
        const Outcome outcome = run("scene.glb --grid grid.json --out baked");
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        const Result<tools::Json> report = tools::readJson(mFolder / "baked/air-report.json");
        ASSERT_TRUE(report) << report.error().message;
        const Result<std::vector<std::byte>> bytes = assets::readFileBytes(mFolder / "baked/air.grid");
        ASSERT_TRUE(bytes);
        const scene::GridRecord grid = scene::gridRecord(*readIrradianceGrid(*bytes));
        std::minstd_rand numbers(23);
        std::uniform_real_distribution<float> side(-1, 1);
        std::vector<float3> places;
        for (size_t i = 0; i < kPlaces; ++i) {
            const float x = side(numbers), y = side(numbers), z = side(numbers);
            places.push_back(half * float3(x, y, z));
        }
        const reference::TracedScenePtr traced = this->traced("scene.glb");
        const Exposure exposure{ .aperture = 16, .shutterSeconds = 0.008f, .iso = 100 };
        const ProbeSettings settings{
            .rays = kTimesPaths * paths, .depthSize = 0, .exposure = double(exposure.factor()), .seed = 4711
        };
        std::vector<IrradianceProbe> truths(kPlaces);
        jobs::parallelFor<"truth">(jobs, kPlaces, 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                truths[i] = traceProbe(*traced, at + double3(places[i]), i, float3x3(1.0f), settings).probe;
        });
        const double noise = 2 * (*report)["standardError"].get<double>() * (*report)["mean"].get<double>();
        const double bound = (*report)["judged"]["interpolation"].get<double>();
        double seen = 0, sum = 0;
        for (size_t i = 0; i < kPlaces; ++i) {
            if (truths[i].isInside) continue;
            const std::array<double, 6> given = sixLights(scene::sampleGrid(grid, places[i]).light),
                                        expected = sixLights(truths[i].irradianceSh);
            double error = 0;
            for (size_t k = 0; k < 6; ++k) error = std::max(error, std::abs(given[k] - expected[k]));
            if (error == 0) continue; // dark
            ++seen, sum += luminanceOf(double3(truths[i].irradianceSh[0]));
            holds.within += error <= noise + bound;
            holds.withinNoise += error <= noise;
        }
        ASSERT_GT(seen, 0.3 * kPlaces);
        RecordProperty("within", std::to_string(holds.within / seen));
        holds = { holds.within / seen, holds.withinNoise / seen, bound * seen / sum };
    }
};

TEST_F(HeldOutGrid, OfACornellBoxIsWithinItsReportAt95Percent) {
    Holds holds;
    bakeGrid(interiors::cornellBox().model, { 0, 1, 0 }, float3(0.95f), 0.5f, 256, holds);
    EXPECT_GE(holds.within, 0.95);
    EXPECT_LT(holds.withinNoise, 0.95) << "the bound says nothing";
    EXPECT_LT(holds.bound, 3);
}

TEST_F(HeldOutGrid, OfRoomsIsToo) {
    for (const uint32_t seed : { 2u, 3u }) {
        Holds holds;
        bakeGrid(litRoom(seed), double3(0.0), test::makeRoom(seed).half, 0.7f, 64, holds);
        EXPECT_GE(holds.within, 0.95) << "room " << seed;
    }
}

} // namespace
} // namespace filament_core::bake
