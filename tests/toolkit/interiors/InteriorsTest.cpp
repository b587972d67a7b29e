// SPDX-License-Identifier: Apache-2.0
// The generated rooms by rays: walls face inwards and have no gaps but the window.
#include "toolkit/interiors/Interiors.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/assets/image/HdrReader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <unistd.h>

namespace filament_core::interiors {
namespace {

struct Triangle {
    double3 a{ 0.0 }, b{ 0.0 }, c{ 0.0 };
    double3 normal() const { return glm::cross(b - a, c - a); } // twice the area long
};

std::vector<Triangle> trianglesOf(assets::GlbScene const& scene) {
    std::vector<Triangle> all;
    for (assets::GlbNode const& node : scene.nodes) {
        for (assets::GlbPrimitive const& primitive : scene.meshes[node.mesh].primitives) {
            const auto corner = [&](size_t i) {
                return double3(node.parentFromNode * double4(double3(primitive.positions[primitive.indices[i]]), 1));
            };
            for (size_t i = 0; i < primitive.indices.size(); i += 3)
                all.push_back({ corner(i), corner(i + 1), corner(i + 2) });
        }
    }
    return all;
}

struct Met {
    double distance = std::numeric_limits<double>::infinity();
    bool isFront = true;
};

/// The nearest triangle (Moeller and Trumbore 1997, "Fast, Minimum Storage Ray-Triangle Intersection").
Met trace(std::vector<Triangle> const& triangles, double3 from, double3 direction) {
    Met met;
    for (Triangle const& t : triangles) {
        const double3 ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(direction, ac), s = from - t.a;
        const double d = glm::dot(ab, p);
        if (d == 0) continue;
        const double3 q = glm::cross(s, ab);
        const double u = glm::dot(s, p) / d, v = glm::dot(direction, q) / d, distance = glm::dot(ac, q) / d;
        if (u < 0 || v < 0 || u + v > 1 || distance < 1e-9 || distance >= met.distance) continue;
        met = { distance, d > 0 };
    }
    return met;
}

/// Evenly spread directions (Fibonacci's lattice).
double3 direction(int i, int count) {
    const double y = 1 - (2 * i + 1.0) / count, radius = std::sqrt(1 - y * y);
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    return { radius * std::cos(turn), y, radius * std::sin(turn) };
}

constexpr int kDirections = 500;

template <class Leaves>
void expectClosed(Interior const& room, Leaves const& leaves) {
    const std::vector<Triangle> triangles = trianglesOf(room.model);
    int left = 0;
    for (InteriorCamera const& camera : room.cameras) {
        for (int i = 0; i < kDirections; ++i) {
            const double3 along = direction(i, kDirections);
            const Met met = trace(triangles, camera.eye, along);
            if (std::isfinite(met.distance)) {
                ASSERT_TRUE(met.isFront) << glm::length(camera.eye + along * met.distance);
            } else {
                ++left;
                ASSERT_TRUE(leaves(camera.eye, along)) << along.x << ' ' << along.y << ' ' << along.z;
            }
        }
    }
    EXPECT_GT(left, 50) << "the sky must light the room";
}

TEST(Interiors, TheCornellBoxIsOpenTowardsPositiveZAlone) {
    Interior box = cornellBox(0);
    ASSERT_EQ(box.cameras.size(), 5u);
    for (InteriorCamera& camera : box.cameras) camera.eye.z = std::min(camera.eye.z, 0.9); // inside
    box.cameras[0].eye = { -0.9, 1.9, 0.9 };                                               // above the blocks
    expectClosed(box, [](double3 eye, double3 along) {
        const double3 at = eye + along * ((1 - eye.z) / along.z);
        return along.z > 0 && std::abs(at.x) < 1.001 && at.y > -0.001 && at.y < 2.001;
    });
    EXPECT_EQ(trianglesOf(cornellBox(8).model).size(), trianglesOf(box.model).size() + 2) << "the lamp";
}

TEST(Interiors, LightComesIntoTheGalleryThroughItsWindowAlone) {
    for (const GalleryOptions& options : { GalleryOptions{}, GalleryOptions{ .panelMeters = 1.3 },
                                           GalleryOptions{ 8, 4, 3, 0, 0, 0 }, GalleryOptions{ 20, 9, 6, 7, 9, 2 } }) {
        const Interior room = gallery(options);
        ASSERT_EQ(room.cameras.size(), 5u);
        for (InteriorCamera const& camera : room.cameras) {
            const double3 inside = glm::abs(camera.eye - room.center) - room.halfExtent;
            EXPECT_LT(std::max({ inside.x, inside.y, inside.z }), 0);
        }
        expectClosed(room, [&](double3 eye, double3 along) {
            const double3 at = eye + along * ((options.widthMeters / 2 - eye.z) / along.z);
            return along.z > 0 && std::abs(at.x) < 0.301 * options.lengthMeters && at.y > 0.899 &&
                   at.y < options.heightMeters - 0.699;
        });
    }
}

TEST(Interiors, PanelsHaveTheAreaOfTheWallsAndAtMostTheirSize) {
    const auto areaOf = [](Interior const& room) {
        double area = 0;
        for (Triangle const& t : trianglesOf(room.model)) area += glm::length(t.normal()) / 2;
        return area;
    };
    const Interior whole = gallery(), cut = gallery({ .panelMeters = 1 });
    EXPECT_NEAR(areaOf(whole), areaOf(cut), 1e-3);
    EXPECT_GT(cut.model.meshes.size(), whole.model.meshes.size() + 200);
    std::set<std::string> names;
    for (assets::GlbNode const& node : cut.model.nodes) EXPECT_TRUE(names.insert(node.name).second) << node.name;
    for (assets::GlbMesh const& mesh : cut.model.meshes) {
        if (mesh.name.find("wall ") == std::string::npos && mesh.name.find("floor ") == std::string::npos) continue;
        for (float3 const& corner : mesh.primitives[0].positions)
            EXPECT_LE(glm::distance(corner, mesh.primitives[0].positions[0]), 1.4143f) << mesh.name;
    }
}

TEST(Interiors, FilesAreReadAsTheyWereMade) {
    const std::filesystem::path folder =
            std::filesystem::temp_directory_path() / ("interiors-" + std::to_string(::getpid()));
    jobs::JobSystem jobs({ .workers = 1 });
    for (const Interior& room : { cornellBox(), gallery() }) {
        const Result<InteriorFiles> files = writeInterior(room, folder);
        ASSERT_TRUE(files) << files.error().message;
        const auto first = assets::readFileBytes(files->model);
        const Result<assets::ModelData> model = assets::loadGltf(files->model, jobs);
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_TRUE(model->warnings.empty());
        EXPECT_EQ(model->nodes.size(), room.model.nodes.size());
        ASSERT_TRUE(writeInterior(room, folder));
        EXPECT_EQ(*first, *assets::readFileBytes(files->model));
        const Result<assets::HdrImage> sky = assets::readHdrImage(files->sky);
        ASSERT_TRUE(sky) << sky.error().message;
        EXPECT_EQ(sky->width, 2 * sky->height);
    }
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace filament_core::interiors
