// SPDX-License-Identifier: Apache-2.0
// picking [vulkan|gles] [OUT.png]: picks a few pixels, prints the hits, and frames them.
#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "picking: error: %s\n", error.message.c_str());
    return 1;
}

struct Thing {
    const char* name;
    float3 color;
    Result<Mesh> mesh;
    Owned<VertexBuffer> vertices{};
    Owned<IndexBuffer> indices{};
    Owned<MaterialInstance> instance{};
};

void frame(DebugDraw& lines, Scene const& scene, Thing const& thing, Node node) {
    lines.box(thing.mesh->bounds(), scene.worldFromNode(node),
              { .color = { 1, 0.8f, 0.1f, 1 }, .widthPixels = 2, .depth = DebugDepth::Through });
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    const Result<Material> found = createBuiltInMaterial(*engine, "lit");
    if (!found) return fail(found.error());
    const Owned<Material> material = engine->own(*found);

    std::array<Thing, 5> things{
        Thing{ "ball", { 0.8f, 0.1f, 0.1f }, makeUvSphere() },
        Thing{ "box", { 0.1f, 0.6f, 0.2f }, makeBox({ .size = { 0.8f, 0.7f, 0.6f } }) },
        Thing{ "cone", { 0.1f, 0.3f, 0.9f }, makeCone() }, Thing{ "capsule", { 0.8f, 0.6f, 0.1f }, makeCapsule() },
        Thing{ "ring", { 0.6f, 0.2f, 0.7f }, makeTorus({ .radius = 0.35f, .tubeRadius = 0.12f }) }
    };
    Scene scene(*engine);
    for (size_t i = 0; i < things.size(); ++i) {
        Thing& thing = things[i];
        if (!thing.mesh) return fail(thing.mesh.error());
        thing.vertices = engine->own(engine->create(thing.mesh->vertexBuffer()));
        thing.indices = engine->own(engine->create(thing.mesh->indexBuffer()));
        thing.instance = engine->own(engine->createInstance(material, thing.name));
        if (const Result<void> set = engine->set(thing.instance, "baseColor", thing.color); !set)
            return fail(set.error());
        const double x = (static_cast<double>(i) - 2) * 1.1;
        const double4x4 place = glm::rotate(glm::translate(double4x4(1), double3(x, 0, 0)), 0.6, double3(1, 0.5, 0));
        const Node node = scene.add(NodeDesc{ .parentFromNode = place, .name = thing.name });
        scene.add({ .vertices = thing.vertices, .indices = thing.indices, .material = thing.instance, .node = node });
    }
    scene.add(SunLight{ .directionWorld = { -1, -1.5f, -2 } });

    View view{ .camera = Camera::lookAt({ 0, 0.4, 4 }, { 0, 0, 0 }), .size = { 320, 180 }, .samples = 4 };
    Renderer renderer(*engine);
    DebugDraw lines;
    for (const uint2 pixel : { uint2(53, 90), uint2(160, 90), uint2(267, 90), uint2(160, 10) }) {
        const Result<PickHit> hit = renderer.waitPick(renderer.pick(scene, view, pixel));
        if (!hit) return fail(hit.error());
        if (!*hit) {
            std::printf("%u %u: nothing\n", pixel.x, pixel.y);
            continue;
        }
        const std::string& name = scene.name(hit->node);
        std::printf("%u %u: %s, %.3f m away\n", pixel.x, pixel.y, name.c_str(), hit->distanceMeters);
        for (Thing const& thing : things) {
            if (name == thing.name) frame(lines, scene, thing, hit->node);
        }
    }
    view.debugDraw = &lines;
    const Result<Image> image = renderer.renderToImage(scene, view);
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "picking.png", *image);
    return saved ? 0 : fail(saved.error());
}
