// SPDX-License-Identifier: Apache-2.0
// section [vulkan|gles] [OUT.png] [MODEL.gltf]: cuts a model, or a few solids that lie inside of each other, open.
#include <filament_core/filament_core.h>
#include <materials/cut.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "section: error: %s\n", error.message.c_str());
    return 1;
}

struct Part {
    Result<Mesh> mesh;
    double4x4 place{ 1 };
    float3 color;
    float metallic = 0;
};

double4x4 at(double3 position, double degrees = 0) {
    return glm::rotate(glm::translate(double4x4(1), position), glm::radians(degrees), double3(1, 0, 0));
}

/// The inner side of a wall: its triangles face inwards, so that a ray leaves the wall through it.
Result<Mesh> cavity(Result<Mesh> mesh) {
    if (!mesh) return mesh;
    for (size_t i = 0; i + 2 < mesh->indices.size(); i += 3) std::swap(mesh->indices[i], mesh->indices[i + 1]);
    for (MeshVertex& vertex : mesh->vertices) {
        vertex.normal = -vertex.normal;
        vertex.tangents = tangentsFromNormal(vertex.normal);
    }
    return mesh;
}

struct Solids {
    std::vector<Owned<VertexBuffer>> vertices;
    std::vector<Owned<IndexBuffer>> indices;
    std::vector<Owned<MaterialInstance>> paints;

    Result<void> add(Engine& engine, Scene& scene, Material material, Part const& part) {
        if (!part.mesh) return part.mesh.error();
        vertices.push_back(engine.own(engine.create(part.mesh->vertexBuffer())));
        indices.push_back(engine.own(engine.create(part.mesh->indexBuffer())));
        paints.push_back(engine.own(engine.createInstance(material)));
        if (Result<void> set = engine.set(paints.back(), "baseColor", part.color); !set) return set;
        if (Result<void> set = engine.set(paints.back(), "metallic", part.metallic); !set) return set;
        scene.add({ .vertices = vertices.back(),
                    .indices = indices.back(),
                    .material = paints.back(),
                    .bounds = part.mesh->bounds(),
                    .worldFromObject = part.place });
        return {};
    }
};

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    Scene scene(*engine);
    Solids solids;
    Result<Material> cut = engine->create(MaterialDesc{ .package = materials::cut() });
    if (!cut) return fail(cut.error());
    const Owned<Material> material = engine->own(*cut);
    std::optional<Model> model;
    Box bounds{ double3(-1), double3(1) };
    if (argc > 3) {
        Result<Model> loaded = loadGltf(*engine, argv[3], { .sectionPlanes = true });
        if (!loaded) return fail(loaded.error());
        model.emplace(std::move(*loaded));
        bounds = model->bounds();
        scene.add(*model);
    } else {
        // A hollow ball, a shaft through it, a ring around it: closed meshes, each with a cap of its own.
        const std::array<Part, 5> parts{
            Part{ makeUvSphere({ .radius = 1, .slices = 96, .stacks = 48 }), at({ 0, 0, 0 }), { 0.7f, 0.12f, 0.08f } },
            Part{ cavity(makeUvSphere({ .radius = 0.8f, .slices = 96, .stacks = 48 })),
                  at({ 0, 0, 0 }),
                  { 0.7f, 0.12f, 0.08f } },
            Part{ makeUvSphere({ .radius = 0.45f, .slices = 64, .stacks = 32 }),
                  at({ 0, 0, 0 }),
                  { 0.9f, 0.65f, 0.25f },
                  1 },
            Part{ makeTorus({ .radius = 1.25f, .tubeRadius = 0.16f, .slices = 96 }),
                  at({ 0, 0, 0 }, 20),
                  { 0.15f, 0.35f, 0.7f } },
            Part{ makeBox({ .size = { 3.6f, 0.1f, 3.2f } }), at({ 0, -1.5, 0 }), { 0.5f, 0.5f, 0.5f } }
        };
        for (Part const& part : parts)
            if (const Result<void> added = solids.add(*engine, scene, material, part); !added)
                return fail(added.error());
    }
    scene.add(SunLight{ .directionWorld = { -0.5f, -1, -0.7f } });
    scene.add(SunLight{ .directionWorld = { 1, -0.6f, -0.8f }, .illuminance = Lux{ 25'000 }, .castsShadows = false });

    const double3 center = bounds.center();
    const double size = glm::length(bounds.max - bounds.min);
    View view{ .camera = Camera::lookAt(center + double3(0.55, 0.45, 0.95) * size, center),
               .size = { 320, 240 },
               .clearColor = { 0.25f, 0.3f, 0.35f, 1 },
               .samples = 4 };
    // A quarter is cut out: what lies behind both planes.
    view.section.planes[0] = sectionPlane(center, { 0, 0, -1 });
    view.section.planes[1] = sectionPlane(center, { -1, 0, 0 });
    view.section.cut = SectionCut::Corner;
    view.section.hatchMeters = static_cast<float>(size) / 40;
    view.section.capColor = { 0.8f, 0.8f, 0.75f, 0.5f };

    Renderer renderer(*engine);
    const Result<Image> image = renderer.renderToImage(scene, view);
    if (!image) return fail(image.error());
    const Result<PickHit> hit = renderer.waitPick(renderer.pick(scene, view, view.size / 2u));
    if (!hit) return fail(hit.error());
    std::printf("the middle shows what is %.3f m away\n", hit->distanceMeters);
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "section.png", *image);
    return saved ? 0 : fail(saved.error());
}
