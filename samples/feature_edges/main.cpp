// SPDX-License-Identifier: Apache-2.0
// feature_edges [vulkan|gles] [OUT.png] [MODEL.gltf]: lines along silhouettes and creases, between objects, and around
// a selected object, by edges.mat, a pass of one's own over the picture.
#include <filament_core/filament_core.h>
#include <materials/edges.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "feature_edges: error: %s\n", error.message.c_str());
    return 1;
}

constexpr uint2 kSize{ 320, 180 };
constexpr Layers kSelected = 2; ///< the layer of what is selected, besides its others

/// What passes read besides the picture: depths and normals of a view, with several texels a pixel for finer lines.
struct Surfaces {
    Owned<Texture> numbers, depth;
    Owned<RenderTarget> target;

    Surfaces(Engine& engine, uint2 size)
            : numbers(engine.own(engine.create(TextureDesc{
                      .format = Format::RGBA32F, .width = size.x, .height = size.y, .renderable = true }))),
              depth(engine.own(engine.create(
                      TextureDesc{ .format = Format::R32F, .width = size.x, .height = size.y, .renderable = true }))),
              target(engine.own(engine.create(RenderTargetDesc{ .color = numbers, .depth = depth }))) {}
};

struct Line {
    float width = 1;
    float4 ink{ 0, 0, 0, 1 };
    bool surfaces = true;          ///< silhouettes and creases
    float4 channels{ 1, 0, 0, 0 }; ///< of the labels, where these differ
    float hidden = 1;              ///< opacity where something is in front
};

Result<void> set(Engine& engine, MaterialInstance line, Line const& look, Surfaces const& seen, Texture labels,
                 Texture front) {
    constexpr Sampler kTexels{ .magFilter = Filter::Nearest, .minFilter = Filter::Nearest };
    Result<void> done = engine.set(line, "width", look.width);
    if (done) done = engine.set(line, "ink", look.ink);
    if (done) done = engine.set(line, "surfaces", look.surfaces ? 1.0f : 0.0f);
    if (done) done = engine.set(line, "labelChannels", look.channels);
    if (done) done = engine.set(line, "selected", 0.0f);
    if (done) done = engine.set(line, "hidden", look.hidden);
    if (done) done = engine.set(line, "crease", std::cos(glm::radians(35.0f)));
    if (done) done = engine.set(line, "depth", seen.depth, kTexels);
    if (done) done = engine.set(line, "normals", seen.numbers, kTexels);
    if (done) done = engine.set(line, "front", front, kTexels);
    if (done) done = engine.set(line, "labels", labels, kTexels);
    return done;
}

struct Thing {
    Result<Mesh> mesh;
    double3 at;
    Owned<VertexBuffer> vertices{};
    Owned<IndexBuffer> indices{};
};

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    const Result<Material> lit = createBuiltInMaterial(*engine, "lit");
    const Result<Material> edges = engine->create(MaterialDesc{ .package = materials::edges(), .name = "edges" });
    if (!lit || !edges) return fail((lit ? edges : lit).error());
    const Owned<Material> surface = engine->own(*lit), drawn = engine->own(*edges);
    const Owned<MaterialInstance> clay = engine->own(engine->createInstance(surface)),
                                  lines = engine->own(engine->createInstance(drawn, "lines")),
                                  selection = engine->own(engine->createInstance(drawn, "selection"));
    if (const Result<void> done = engine->set(clay, "baseColor", float3(0.6f, 0.62f, 0.65f)); !done)
        return fail(done.error());

    Scene scene(*engine);
    std::array<Thing, 5> things{ Thing{ makePlane({ .width = 6, .depth = 6 }), { 0, -0.5, 0 } },
                                 Thing{ makeBox(), { -1.2, 0, -0.2 } }, Thing{ makeUvSphere(), { 0, 0, 0.2 } },
                                 Thing{ makeCone(), { 1.2, 0, -0.2 } },
                                 Thing{ makeTorus({ .radius = 0.35f, .tubeRadius = 0.12f }), { 0.72, -0.2, -0.45 } } };
    std::optional<Model> model;
    if (argc > 3) {
        Result<Model> loaded = loadGltf(*engine, argv[3]);
        if (!loaded) return fail(loaded.error());
        const Node root = scene.add(*loaded, fitToUnitCube(loaded->bounds()));
        const Result<ModelCopy> copy = ModelCopy::of(scene, root);
        if (!copy) return fail(copy.error());
        for (CopyRenderable const& part : copy->renderables()) scene.setMaterial(part.renderable, clay);
        scene.setLayers(copy->renderables().front().node, kSelected, kSelected);
        model = std::move(*loaded);
    } else {
        for (Thing& thing : things) {
            if (!thing.mesh) return fail(thing.mesh.error());
            thing.vertices = engine->own(engine->create(thing.mesh->vertexBuffer()));
            thing.indices = engine->own(engine->create(thing.mesh->indexBuffer()));
            const double4x4 place = glm::rotate(glm::translate(double4x4(1), thing.at), 0.5, double3(0, 1, 0));
            const Renderable added = scene.add({ .vertices = thing.vertices,
                                                 .indices = thing.indices,
                                                 .material = clay,
                                                 .worldFromObject = place });
            if (&thing == &things.back()) scene.setLayers(added, kSelected, kSelected);
        }
    }
    scene.add(SunLight{ .directionWorld = { -1, -2, -1.2f } });
    scene.add(SunLight{ .directionWorld = { 1, -1, -1 }, .illuminance = Lux{ 30'000 }, .castsShadows = false });

    const double3 eye = model ? double3(0.5, 0.35, 1.5) : double3(0.4, 1.3, 3.2);
    View view{ .camera = Camera::lookAt(eye, { 0, model ? 0 : -0.1, 0 }),
               .size = kSize,
               .clearColor = { 0.8f, 0.8f, 0.8f, 1 },
               .samples = 4 };
    const Surfaces all(*engine, kSize * 2u), ids(*engine, kSize * 2u), selected(*engine, kSize * 2u);
    Result<void> done =
            set(*engine, lines, { .width = 1.5f, .ink = { 0.05f, 0.05f, 0.1f, 1 } }, all, ids.numbers, all.depth);
    if (done)
        done = set(
                *engine, selection,
                { .width = 4, .ink = { 1, 0.5f, 0, 1 }, .surfaces = false, .channels = { 0, 0, 0, 1 }, .hidden = 0.4f },
                selected, selected.numbers, all.depth);
    if (!done) return fail(done.error());

    // Without normal maps, in which every dent would be a crease.
    View numbers{ .camera = view.camera, .size = kSize * 2u, .aov = Aov::GeometricNormal };
    Renderer renderer(*engine);
    renderer.render(scene, numbers, all.target);
    numbers.aov = Aov::ObjectId;
    renderer.render(scene, numbers, ids.target);
    numbers.visibleLayers = kSelected;
    renderer.render(scene, numbers, selected.target);
    const std::array passes{ PostProcessPass{ lines, PassPlace::AfterToneMapping },
                             PostProcessPass{ selection, PassPlace::AfterToneMapping } };
    view.postProcess = passes;
    const Result<Image> image = renderer.renderToImage(scene, view);
    if (!image) return fail(image.error());
    for (std::string const& error : engine->takeErrors()) return fail({ ErrorCode::Internal, error });
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "feature_edges.png", *image);
    return saved ? 0 : fail(saved.error());
}
