// SPDX-License-Identifier: Apache-2.0
// Builds a scene of two squares, writes all AOVs of a view into one OpenEXR file, and looks for their layers in it.
//   aovs OUT.exr
#include <filament_core/BuiltInMaterials.h>
#include <filament_core/RenderAovs.h>
#include <filament_core/Scene.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace filament_core;

int fail(Error const& error) {
    std::fprintf(stderr, "aovs: error: %s\n", error.message.c_str());
    return 1;
}

struct Square {
    Owned<VertexBuffer> vertices;
    Owned<IndexBuffer> indices;

    explicit Square(Engine& engine) {
        constexpr std::array<float, 12> kPlaces{ -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0 };
        constexpr std::array<uint16_t, 6> kIndices{ 0, 1, 2, 0, 2, 3 };
        vertices = engine.own(
                engine.create(VertexBufferDesc{ .vertexCount = 4,
                                                .stride = 3 * sizeof(float),
                                                .attributes = { { Attribute::Position, VertexFormat::Float3, 0 } },
                                                .data = std::as_bytes(std::span(kPlaces)) }));
        indices = engine.own(
                engine.create(IndexBufferDesc{ .indexCount = 6, .data = std::as_bytes(std::span(kIndices)) }));
    }

    Renderable add(Scene& scene, MaterialInstance material, double3 at) const {
        double4x4 world(1);
        world[3] = double4(at, 1);
        return scene.add({ .vertices = vertices, .indices = indices, .material = material, .worldFromObject = world });
    }
};

/// The names of channels stand in the header as they are.
size_t missingLayers(const char* file, std::vector<ExrLayer> const& layers) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{ std::istreambuf_iterator<char>(in), {} };
    const auto isMissing = [&](ExrLayer const& layer) {
        const std::string channel = std::string(layer.name) + '.' + std::string(layer.channels.front());
        return bytes.find(channel + '\0') == std::string::npos;
    };
    return static_cast<size_t>(std::ranges::count_if(layers, isMissing));
}

} // namespace

int main(int argc, char** argv) {
    const char* const file = argc > 1 ? argv[1] : "aovs.exr";
    Result<Engine> engine = Engine::create({ .backend = Backend::Null });
    if (!engine) return fail(engine.error());
    const Result<Material> paint = createBuiltInMaterial(*engine, "unlit");
    if (!paint) return fail(paint.error());
    const Owned<Material> owner = engine->own(*paint);
    const Owned<MaterialInstance> instance = engine->own(engine->createInstance(*paint));
    const Square square(*engine);
    Scene scene(*engine);
    square.add(scene, instance, { -1.2, 0, -3 });
    const Renderable right = square.add(scene, instance, { 1.2, 0, -3 });

    std::array<Aov, kAovCount - 1> aovs{};
    for (size_t i = 0; i < aovs.size(); ++i) aovs[i] = static_cast<Aov>(i + 1);
    const View view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }), .size = { 64, 48 } };
    const Result<std::vector<Image>> images = renderAovs(*engine, scene, view, aovs);
    if (!images) return fail(images.error());
    std::vector<ExrLayer> layers;
    for (size_t i = 0; i < aovs.size(); ++i) layers.push_back(layerOf(aovs[i], (*images)[i]));
    if (Result<void> saved = saveExr(file, layers); !saved) return fail(saved.error());

    const size_t missing = missingLayers(file, layers);
    const bool isFound = objectOf(scene, right.index() + 1).renderable == right;
    std::printf("aovs: %zu layers, %zu of them missing in %s\n", layers.size(), missing, file);
    return missing == 0 && isFound ? 0 : 1;
}
