// SPDX-License-Identifier: Apache-2.0
// server [vulkan|gles]: renders the requests of standard input, one per line, and answers each with one line:
//     SHAPE RED GREEN BLUE ROUGHNESS OUT.png        box, ball, cone, capsule or ring; numbers in [0, 1]
// A request that it does not understand, or cannot serve, gives an error line, and the next one is served.
#include <filament_core/filament_core.h>

#include <cstdio>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

using namespace filament_core;

namespace {

struct Request {
    std::string shape, file;
    float3 color{ 0 };
    float roughness = 0;
};

Error wrong(std::string message) { return { ErrorCode::InvalidArgument, std::move(message) }; }

Result<Request> parse(std::string const& line) {
    Request request;
    std::istringstream words(line);
    words >> request.shape >> request.color.x >> request.color.y >> request.color.z >> request.roughness >>
            request.file;
    if (!words || !(words >> std::ws).eof()) return wrong("expected: SHAPE RED GREEN BLUE ROUGHNESS OUT.png");
    for (const float value : { request.color.x, request.color.y, request.color.z, request.roughness }) {
        if (!(value >= 0 && value <= 1)) return wrong("colours and roughness are in [0, 1]");
    }
    return request;
}

Result<Mesh> meshOf(std::string const& shape) {
    if (shape == "box") return makeBox({ .size = float3(0.8f) });
    if (shape == "ball") return makeUvSphere();
    if (shape == "cone") return makeCone();
    if (shape == "capsule") return makeCapsule();
    if (shape == "ring") return makeTorus({ .radius = 0.4f, .tubeRadius = 0.15f });
    return wrong("no shape '" + shape + "'; there are box, ball, cone, capsule and ring");
}

class Studio {
public:
    static Result<Studio> open(Backend backend) {
        Result<Engine> engine = Engine::create({ .backend = backend });
        if (!engine) return engine.error();
        const Result<Material> material = createBuiltInMaterial(*engine, "lit");
        if (!material) return material.error();
        return Studio(std::move(*engine), *material);
    }

    Result<void> serve(Request const& request) {
        const Result<Mesh> mesh = meshOf(request.shape);
        if (!mesh) return mesh.error();
        const Owned<VertexBuffer> vertices = mEngine.own(mEngine.create(mesh->vertexBuffer()));
        const Owned<IndexBuffer> indices = mEngine.own(mEngine.create(mesh->indexBuffer()));
        Result<void> set = mEngine.set(mInstance, "baseColor", request.color);
        if (set) set = mEngine.set(mInstance, "roughness", request.roughness);
        if (!set) return set;
        Scene scene(mEngine);
        scene.add({ .vertices = vertices, .indices = indices, .material = mInstance });
        scene.add(SunLight{ .directionWorld = { -1, -1.5f, -1 } });
        const View view{ .camera = Camera::lookAt({ 0.7, 0.9, 1.4 }, { 0, 0, 0 }), .size = { 320, 180 }, .samples = 4 };
        const Result<Image> image = mRenderer.renderToImage(scene, view);
        return image ? savePng(request.file, *image) : Result<void>(image.error());
    }

private:
    Studio(Engine engine, Material material)
            : mEngine(std::move(engine)), mMaterial(mEngine.own(material)),
              mInstance(mEngine.own(mEngine.createInstance(material))), mRenderer(mEngine) {}

    Engine mEngine;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    Renderer mRenderer;
};

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Studio> studio = Studio::open(isVulkan ? Backend::Vulkan : Backend::Gles);
    if (!studio) {
        std::fprintf(stderr, "server: error: %s\n", studio.error().message.c_str());
        return 1;
    }
    std::string line;
    for (int number = 1; std::getline(std::cin, line); ++number) {
        const Result<Request> request = parse(line);
        const Result<void> served = request ? studio->serve(*request) : Result<void>(request.error());
        if (served)
            std::printf("%d ok %s\n", number, request->file.c_str());
        else
            std::printf("%d error: %s\n", number, served.error().message.c_str());
        std::fflush(stdout);
    }
    return 0;
}
