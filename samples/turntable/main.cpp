// SPDX-License-Identifier: Apache-2.0
// turntable MODEL.gltf [vulkan|gles] [OUT.png] [FRAMES] [FOLDER]: turns a model once around, on a ground that is
// nothing but its shadow. OUT.png has four of the frames; FOLDER gets all of them, with alpha, as 000.png, 001.png, ...
//   ffmpeg -framerate 24 -i FOLDER/%03d.png turntable.webm
#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <system_error>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "turntable: error: %s\n", error.message.c_str());
    return 1;
}

struct Table {
    double4x4 worldFromModel{ 1.0 }; ///< its middle above the origin, its lowest point on the ground
    double radius = 0, height = 0;   ///< of the cylinder that the model stays in
};

Table tableOf(Box const& box) {
    const double4x4 fitted = fitToUnitCube(box);
    const double3 half = 0.5 * (box.max - box.min) * fitted[0][0];
    return { .worldFromModel = glm::translate(double4x4(1), double3(0, half.y, 0)) * fitted,
             .radius = std::hypot(half.x, half.z),
             .height = 2 * half.y };
}

/// Keeps the cylinder in view at any angle of the table.
Camera fittedCamera(Table const& table, float aspect) {
    constexpr double kFov = 0.5;
    const double3 middle(0, 0.5 * table.height, 0), towards = glm::normalize(double3(0, 0.35, 1));
    const double radius = std::hypot(table.radius, 0.5 * table.height);
    const double half = std::atan(std::tan(0.5 * kFov) * std::min(1.0, double{ aspect }));
    return Camera::lookAt(middle + towards * (radius / std::sin(half)), middle,
                          { .verticalFovDegrees = static_cast<float>(glm::degrees(kFov)) });
}

/// Frame FRAMES is frame 0: not the last one of a film, which starts again with the first.
double4x4 turned(Table const& table, int frame, int frames) {
    const double angle = 2 * std::numbers::pi * (frame % frames) / frames;
    return glm::rotate(double4x4(1), angle, double3(0, 1, 0)) * table.worldFromModel;
}

/// The light of a pixel, multiplied by alpha as the engine leaves it, and alpha.
float4 lightOf(std::byte const* texel) {
    const auto code = [&](size_t channel) { return static_cast<float>(std::to_integer<int>(texel[channel])) / 255; };
    return { color::linearFromSrgb(float3(code(0), code(1), code(2))), code(3) };
}

void store(std::byte* texel, float3 light, float alpha) {
    const float4 codes(color::srgbFromLinear(glm::clamp(light, 0.0f, 1.0f)), alpha);
    for (int i = 0; i < 4; ++i) texel[i] = static_cast<std::byte>(std::lround(255 * codes[i]));
}

/// Over light grey.
void copyTo(Image& strip, Image const& image, uint32_t place) {
    constexpr float kGrey = 0.65f;
    for (size_t y = 0; y < image.height; ++y) {
        for (size_t x = 0; x < image.width; ++x) {
            const float4 light = lightOf(&image.pixels[(y * image.width + x) * 4]);
            const size_t to = y * strip.width + size_t{ place } * image.width + x;
            store(&strip.pixels[to * 4], float3(light) + kGrey * (1 - light.w), 1);
        }
    }
}

} // namespace

int main(int argc, char** argv) {
    int frames = 24;
    const std::string_view count = argc > 4 ? argv[4] : "24";
    const auto [end, failure] = std::from_chars(count.data(), count.data() + count.size(), frames);
    if (argc < 2 || failure != std::errc() || end != count.data() + count.size() || frames < 4 || frames > 1000)
        return fail({ ErrorCode::InvalidArgument,
                      "usage: turntable MODEL.gltf [vulkan|gles] [OUT.png] [FRAMES, 4 to 1000] [FOLDER]" });
    const bool isVulkan = argc > 2 && std::string_view(argv[2]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    const Result<Model> model = loadGltf(*engine, argv[1]);
    if (!model) return fail(model.error());
    const Result<Material> catcher = createBuiltInMaterial(*engine, "litShadowCatcher");
    if (!catcher) return fail(catcher.error());
    const Owned<Material> shadows = engine->own(*catcher);
    const Owned<MaterialInstance> ground = engine->own(engine->createInstance(shadows));
    const Result<Mesh> plane = makePlane({ .width = 8, .depth = 8 });
    if (!plane) return fail(plane.error());
    const Owned<VertexBuffer> vertices = engine->own(engine->create(plane->vertexBuffer()));
    const Owned<IndexBuffer> indices = engine->own(engine->create(plane->indexBuffer()));

    const Table table = tableOf(model->bounds());
    Scene scene(*engine);
    const Node root = scene.add(*model, table.worldFromModel);
    scene.add({ .vertices = vertices, .indices = indices, .material = ground, .castsShadows = false });
    scene.add(SunLight{ .directionWorld = { -0.8f, -1.4f, -0.6f } });
    scene.add(SunLight{ .directionWorld = { 1, -0.5f, -0.4f }, .illuminance = Lux{ 25'000 }, .castsShadows = false });
    constexpr uint2 kSize{ 160, 160 };
    const View view{
        .camera = fittedCamera(table, 1), .size = kSize, .clearColor = { 0, 0, 0, 0 }, .samples = 4 // transparent
    };

    Renderer renderer(*engine);
    Image strip{ .width = kSize.x * 4, .height = kSize.y, .pixels = std::vector<std::byte>(kSize.x * kSize.y * 16) };
    Image first;
    for (int frame = 0; frame <= frames; ++frame) {
        scene.setTransform(root, turned(table, frame, frames));
        Result<Image> image = renderer.renderToImage(scene, view);
        if (!image) return fail(image.error());
        for (uint32_t quarter = 0; quarter < 4; ++quarter)
            if (frame == frames * static_cast<int>(quarter) / 4) copyTo(strip, *image, quarter);
        if (argc > 5 && frame < frames) {
            const std::string number = std::to_string(frame);
            const std::filesystem::path file =
                    std::filesystem::path(argv[5]) / (std::string(3 - number.size(), '0') + number + ".png");
            if (const Result<void> saved = savePng(file, straightAlpha(*image)); !saved) return fail(saved.error());
        }
        if (frame == frames && image->pixels != first.pixels)
            return fail({ ErrorCode::Internal, "the last frame does not lead to the first" });
        if (frame == 0) first = std::move(*image);
    }
    std::printf("%d frames, and the first one again\n", frames);
    const Result<void> saved = savePng(argc > 3 ? argv[3] : "turntable.png", strip);
    return saved ? 0 : fail(saved.error());
}
