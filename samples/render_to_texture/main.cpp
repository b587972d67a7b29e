// SPDX-License-Identifier: Apache-2.0
// render_to_texture [vulkan|gles] [OUT.png]: a scene is drawn into a texture, which a screen in another scene shows.
#include <filament_core/filament_core.h>

#include <glm/ext/matrix_transform.hpp>

#include <cstdio>
#include <string_view>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "render_to_texture: error: %s\n", error.message.c_str());
    return 1;
}

/// A mesh with a built-in material of its own. Members end in the opposite order of this list: users before the used.
struct Object {
    Owned<VertexBuffer> vertices;
    Owned<IndexBuffer> indices;
    Owned<Material> material;
    Owned<MaterialInstance> instance;

    Object(Engine& engine, Mesh const& mesh, Material type)
            : vertices(engine.own(engine.create(mesh.vertexBuffer()))),
              indices(engine.own(engine.create(mesh.indexBuffer()))), material(engine.own(type)),
              instance(engine.own(engine.createInstance(type))) {}

    Renderable addTo(Scene& scene, double4x4 const& worldFromObject = double4x4(1)) const {
        return scene.add(
                { .vertices = vertices, .indices = indices, .material = instance, .worldFromObject = worldFromObject });
    }
};

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());

    const Result<Mesh> ring = makeTorus(), screen = makeBox({ .size = { 1.6f, 0.9f, 0.05f } });
    const Result<Material> lit = createBuiltInMaterial(*engine, "lit"),
                           shown = createBuiltInMaterial(*engine, "unlitTextured");
    for (Result<Mesh> const* mesh : { &ring, &screen }) {
        if (!*mesh) return fail(mesh->error());
    }
    for (Result<Material> const* material : { &lit, &shown }) {
        if (!*material) return fail(material->error());
    }

    // Light, before exposure and tone mapper of the view that shows it: RGBA16F.
    constexpr uint2 kFilm{ 320, 180 };
    const Owned<Texture> film = engine->own(engine->create(TextureDesc{
            .format = Format::RGBA16F, .width = kFilm.x, .height = kFilm.y, .renderable = true, .name = "film" }));
    const Owned<RenderTarget> target = engine->own(engine->create(RenderTargetDesc{ .color = film, .name = "film" }));

    const Object gold(*engine, *ring, *lit), monitor(*engine, *screen, *shown);
    Result<void> set = engine->set(gold.instance, "baseColor", float3(1, 0.7f, 0.3f));
    if (set) set = engine->set(gold.instance, "metallic", 0.6f);
    if (set) set = engine->set(monitor.instance, "baseColorMap", film);
    if (!set) return fail(set.error());

    Scene studio(*engine);
    gold.addTo(studio, glm::rotate(double4x4(1), 1.0, double3(1, 0, 0)));
    studio.add(SunLight{ .directionWorld = { -1, -1, -2 } });
    const View filmed{ .camera = Camera::lookAt({ 0, 0, 2 }, { 0, 0, 0 }),
                       .size = kFilm,
                       .clearColor = { 0.1f, 0.2f, 0.3f, 1 } };

    Scene room(*engine);
    for (const double turn : { 0.5, -0.5 })
        monitor.addTo(room,
                      glm::rotate(glm::translate(double4x4(1), double3(turn * -1.7, 0, 0)), turn, double3(0, 1, 0)));
    const View seen{ .camera = Camera::lookAt({ 0, 0.2, 2.4 }, { 0, 0, 0 }), .size = { 320, 180 }, .samples = 4 };

    Renderer camera(*engine), eye(*engine);
    camera.render(studio, filmed, target);
    const Result<Image> image = eye.renderToImage(room, seen);
    if (!image) return fail(image.error());
    const Result<void> saved = savePng(argc > 2 ? argv[2] : "render_to_texture.png", *image);
    return saved ? 0 : fail(saved.error());
}
