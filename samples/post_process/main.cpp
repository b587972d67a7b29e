// SPDX-License-Identifier: Apache-2.0
// post_process [vulkan|gles] [OUT.png]: two passes of one's own over the picture of a view. trail.mat reads what it
// made of the frame before; outline.mat reads depths and normals.
#include <filament_core/filament_core.h>
#include <materials/outline.h>
#include <materials/trail.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "post_process: error: %s\n", error.message.c_str());
    return 1;
}

double4x4 placeAt(double3 at) {
    double4x4 place(1.0);
    place[3] = double4(at, 1);
    return place;
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());

    const Result<Material> lit = createBuiltInMaterial(*engine, "lit");
    const Result<Material> trail = engine->create(MaterialDesc{ .package = materials::trail(), .name = "trail" });
    const Result<Material> outline = engine->create(MaterialDesc{ .package = materials::outline(), .name = "outline" });
    for (Result<Material> const* material : { &lit, &trail, &outline })
        if (!*material) return fail(material->error());
    const Owned<Material> surface = engine->own(*lit), fading = engine->own(*trail), drawn = engine->own(*outline);
    const Owned<MaterialInstance> lamp = engine->own(engine->createInstance(surface, "lamp")),
                                  floor = engine->own(engine->createInstance(surface, "floor")),
                                  glow = engine->own(engine->createInstance(fading, "glow")),
                                  lines = engine->own(engine->createInstance(drawn, "lines"));
    Result<void> set = engine->set(lamp, "baseColor", float3(1, 0.8f, 0.3f));
    if (set) set = engine->set(floor, "baseColor", float3(0.1f, 0.15f, 0.2f));
    if (set) set = engine->set(glow, "kept", float3(0.9f, 0.75f, 0.7f));
    if (set) set = engine->set(lines, "ink", float3(0.9f, 0.95f, 1));
    if (!set) return fail(set.error());

    const Result<Mesh> ball = makeUvSphere({ .radius = 0.18f }), sheet = makePlane({ .width = 4, .depth = 4 });
    if (!ball || !sheet) return fail((ball ? sheet : ball).error());
    const Owned<VertexBuffer> ballVertices = engine->own(engine->create(ball->vertexBuffer())),
                              sheetVertices = engine->own(engine->create(sheet->vertexBuffer()));
    const Owned<IndexBuffer> ballIndices = engine->own(engine->create(ball->indexBuffer())),
                             sheetIndices = engine->own(engine->create(sheet->indexBuffer()));
    Scene scene(*engine);
    const Renderable moving = scene.add({ .vertices = ballVertices, .indices = ballIndices, .material = lamp });
    scene.add({ .vertices = sheetVertices,
                .indices = sheetIndices,
                .material = floor,
                .worldFromObject = placeAt({ 0, -0.25, 0 }) });
    scene.add(SunLight{ .directionWorld = { -1, -2, -1 } });

    // The list is in the view's order of places: light first, then what the display shows, whose lines FXAA smooths.
    const std::array passes{ PostProcessPass{ glow, PassPlace::BeforeToneMapping },
                             PostProcessPass{ lines, PassPlace::AfterToneMapping } };
    View view{ .camera = Camera::lookAt({ 0, 1.1, 1.4 }, { 0, 0, 0 }), .size = { 320, 180 }, .postProcess = passes };
    view.quality.antiAliasing = AntiAliasing::Fxaa;

    Renderer renderer(*engine);
    Result<Image> image = Error{};
    for (int frame = 0; frame < 24; ++frame) {
        const double angle = 0.2 * frame;
        scene.setTransform(moving, placeAt({ 0.9 * std::cos(angle), 0, 0.6 * std::sin(angle) }));
        image = renderer.renderToImage(scene, view);
        if (!image) return fail(image.error());
    }
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "post_process.png", *image);
    return saved ? 0 : fail(saved.error());
}
