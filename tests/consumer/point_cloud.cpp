// SPDX-License-Identifier: Apache-2.0
// Writes a ball of points as .ply, far from the origin as surveys are, loads it, and draws it cut open by a plane, with
// each API that there is.
#include <filament_core/Points.h>
#include <filament_core/Renderer.h>
#include <materials/cut_points.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>

namespace {

using namespace filament_core;

constexpr double3 kCenter{ 4'500'000.5, 120.25, -700'000.75 }; // metres
constexpr int kPoints = 20'000;
constexpr uint32_t kSide = 96;

int fail(Error const& error) {
    std::fprintf(stderr, "point_cloud: error: %s\n", error.message.c_str());
    return 1;
}

/// A spiral over a sphere of 1 m with equal distances: the upper half is red, the lower one green.
void writeBall(const char* path) {
    std::ofstream file(path);
    file.precision(12);
    file << "ply\nformat ascii 1.0\nelement vertex " << kPoints
         << "\nproperty double x\nproperty double y\nproperty double z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    for (int i = 0; i < kPoints; ++i) {
        const double y = 1 - (2.0 * i + 1) / kPoints, r = std::sqrt(1 - y * y), angle = 2.39996322972865 * i;
        const double3 at = kCenter + double3(r * std::cos(angle), y, r * std::sin(angle));
        file << at.x << ' ' << at.y << ' ' << at.z << (y > 0 ? " 255 0 0\n" : " 0 255 0\n");
    }
}

Result<Image> draw(Backend backend, PointCloudData const& data) {
    Result<Engine> engine = Engine::create({ .backend = backend });
    if (!engine) return engine.error();
    const Result<Material> found = engine->create(MaterialDesc{ .package = materials::cut_points() });
    if (!found) return found.error();
    const Owned<Material> material = engine->own(*found);
    const Owned<MaterialInstance> points = engine->own(engine->createInstance(material));
    if (const Result<void> set = engine->set(points, "meters", 0.04f); !set) return set.error();

    Scene scene(*engine);
    PointCloud::create(*engine, makePointQuads(data.positions, data.colors)).addTo(scene, points, {}, 0.02);
    View view{ .camera = Camera::lookAt(kCenter + double3(0, 0, 4), kCenter), .size = { kSide, kSide } };
    // The plane of the section, relative to the camera: what is right of the middle of the ball goes.
    view.materialGlobals[0] = { -1, 0, 0, static_cast<float>(kCenter.x - view.camera.position().x) };
    return Renderer(*engine).renderToImage(scene, view);
}

/// A component of a pixel, [0, 255].
int component(Image const& image, uint32_t x, uint32_t y, uint32_t channel) {
    return static_cast<int>(image.pixels[(size_t{ y } * kSide + x) * 4 + channel]);
}

bool isHalfABall(Image const& image) {
    const uint32_t middle = kSide / 2, quarter = kSide / 4;
    const bool hasLeft = component(image, middle - 10, middle - 10, 0) > 100 && // red above
                         component(image, middle - 10, middle + 10, 1) > 100;   // green below
    const bool hasRight = component(image, middle + 10, middle - 10, 0) + component(image, middle + 10, middle, 1) > 0;
    return hasLeft && !hasRight && component(image, 1, quarter, 0) == 0;
}

} // namespace

int main() {
    writeBall("ball.ply");
    const Result<PointCloudData> data = loadPointCloud("ball.ply");
    if (!data) return fail(data.error());
    if (data->positions.size() != kPoints) return fail({ ErrorCode::Internal, "points are missing" });
    std::optional<Image> first;
    for (DeviceDescription const& device : listDevices()) {
        if (device.backend == Backend::Null) continue;
        Result<Image> image = draw(device.backend, *data);
        if (!image) return fail(image.error());
        if (!isHalfABall(*image)) return fail({ ErrorCode::Internal, device.device + " draws something else" });
        if (first && first->pixels != image->pixels) return fail({ ErrorCode::Internal, "the APIs differ" });
        first = std::move(*image);
    }
    std::printf("point_cloud: %zu points\n", data->positions.size());
    return 0;
}
