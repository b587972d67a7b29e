// SPDX-License-Identifier: Apache-2.0
// The C interface: every function without its arguments, structs of older headers, errors as codes and text, and the
// same pictures as from C++.
#include "generated/NullCalls.h"

#include <filament_core.h>
#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace filament_core {
namespace {

constexpr fc_double4x4 kIdentity{ { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };

/// Ends what C created.
template <class T, void (*kDestroy)(T*)>
class Ended {
public:
    Ended() = default;
    Ended(Ended const&) = delete;
    ~Ended() { kDestroy(mObject); }
    T** out() { return &mObject; }
    operator T*() const { return mObject; }

private:
    T* mObject = nullptr;
};
using CEngine = Ended<fc_engine, fc_engine_destroy>;
using CScene = Ended<fc_scene, fc_scene_destroy>;
using CView = Ended<fc_view, fc_view_destroy>;
using CRenderer = Ended<fc_renderer, fc_renderer_destroy>;
using CImage = Ended<fc_image, fc_image_destroy>;
using CMesh = Ended<fc_mesh, fc_mesh_destroy>;

#define EXPECT_OK(call) EXPECT_EQ(call, FC_OK) << fc_last_error()
#define ASSERT_OK(call) ASSERT_EQ(call, FC_OK) << fc_last_error()

void createEngine(CEngine& engine, fc_backend backend) {
    fc_engine_options options;
    fc_engine_options_init(&options);
    options.backend = backend;
    options.validation = true;
    options.workers = 0;
    ASSERT_OK(fc_engine_create(&options, engine.out()));
}

TEST(CInterface, NamesTheFunctionAndTheArgumentThatIsNull) {
    EXPECT_GT(std::size(kNullCalls), 90u);
    for (NullCall const& call : kNullCalls) {
        const fc_code code = call.call();
        if (call.hasCode) {
            EXPECT_EQ(code, FC_INVALID_ARGUMENT) << call.name;
        }
        const std::string error = fc_last_error();
        EXPECT_EQ(error.find(std::string(call.name) + ": the argument '"), 0u) << call.name << " says " << error;
    }
    fc_engine_destroy(nullptr);
    fc_view_destroy(nullptr);
    fc_sun_init(nullptr);
}

TEST(CInterface, GivesStructsTheDefaultsOfCpp) {
    fc_sun sun;
    fc_sun_init(&sun);
    const SunLight defaults;
    EXPECT_EQ(sun.struct_bytes, sizeof sun);
    EXPECT_EQ(sun.direction.y, defaults.directionWorld.y);
    EXPECT_EQ(sun.lux, defaults.illuminance.value);
    EXPECT_EQ(sun.casts_shadows, defaults.castsShadows);
    EXPECT_EQ(sun.channels, defaults.lightChannels);
    fc_engine_options options;
    fc_engine_options_init(&options);
    EXPECT_EQ(options.workers, -1);
    EXPECT_EQ(options.backend, FC_BACKEND_VULKAN);
    EXPECT_EQ(options.require_device, nullptr);
}

TEST(CInterface, TakesStructsOfOlderHeadersAndRefusesOthers) {
    CEngine engine;
    createEngine(engine, FC_BACKEND_NULL);
    CScene scene;
    ASSERT_OK(fc_scene_create(engine, scene.out()));
    fc_light light{};
    fc_sun sun;
    fc_sun_init(&sun);
    sun.casts_shadows = false;
    sun.struct_bytes = offsetof(fc_sun, casts_shadows); // a header that did not know shadows: they have the default
    EXPECT_OK(fc_scene_add_sun(scene, &sun, {}, &light));
    EXPECT_NE(light.bits, 0u);
    for (const uint32_t bytes : { 0u, 4u, uint32_t{ sizeof sun } + 1, ~0u }) {
        sun.struct_bytes = bytes;
        light = {};
        EXPECT_EQ(fc_scene_add_sun(scene, &sun, {}, &light), FC_INVALID_ARGUMENT);
        EXPECT_EQ(light.bits, 0u);
        EXPECT_NE(std::string(fc_last_error()).find("call fc_sun_init() first"), std::string::npos) << fc_last_error();
    }
    EXPECT_OK(fc_scene_add_sun(scene, nullptr, {}, &light)) << "null: the defaults";
}

TEST(CInterface, PassesErrorsAsCodesWithTheirText) {
    CEngine engine;
    createEngine(engine, FC_BACKEND_NULL);
    fc_model* model = nullptr;
    EXPECT_EQ(fc_model_load(engine, "no/such.glb", &model), FC_NOT_FOUND);
    EXPECT_EQ(model, nullptr);
    EXPECT_NE(std::string(fc_last_error()).find("no/such.glb"), std::string::npos);
    EXPECT_EQ(fc_model_load_memory(engine, "glTF", 4, "four", &model), FC_CORRUPT);
    EXPECT_NE(std::string(fc_last_error()).find("four"), std::string::npos);
    fc_material material{};
    EXPECT_EQ(fc_material_load(engine, "no/such.fmat", &material), FC_NOT_FOUND);
    EXPECT_EQ(fc_material_built_in(engine, "lits", &material), FC_NOT_FOUND);
    EXPECT_NE(std::string(fc_last_error()).find("did you mean 'lit'?"), std::string::npos);
    ASSERT_OK(fc_material_built_in(engine, "lit", &material));
    fc_instance instance{};
    ASSERT_OK(fc_instance_create(engine, material, "grey", &instance));
    EXPECT_EQ(fc_instance_set_number(engine, instance, "roughnes", 1), FC_NOT_FOUND);
    fc_instance_destroy(engine, instance);
    fc_material_destroy(engine, material);
    CView view;
    ASSERT_OK(fc_view_create({ 4, 4 }, view.out()));
    EXPECT_OK(fc_view_set_option(view, "bloom.strength", "0.2"));
    EXPECT_EQ(fc_view_set_option(view, "bloom.strenght", "0.2"), FC_NOT_FOUND);
    EXPECT_EQ(fc_view_set_option(view, "bloom.strength", "-1"), FC_INVALID_ARGUMENT);
}

TEST(CInterface, CopiesVerticesInAndOut) {
    CMesh mesh;
    ASSERT_OK(fc_mesh_box({ 1, 2, 3 }, mesh.out()));
    const uint32_t count = fc_mesh_vertex_count(mesh);
    EXPECT_EQ(count, 24u);
    EXPECT_EQ(fc_mesh_index_count(mesh), 36u);
    std::vector<fc_vertex> vertices(count);
    ASSERT_OK(fc_mesh_get_vertices(mesh, 0, vertices.data(), count));
    float most = 0;
    for (fc_vertex const& vertex : vertices) most = std::max(most, vertex.position.z);
    EXPECT_EQ(most, 1.5f);
    vertices[5].position.x = 7;
    ASSERT_OK(fc_mesh_set_vertices(mesh, 0, vertices.data(), count));
    fc_vertex one{};
    ASSERT_OK(fc_mesh_get_vertices(mesh, 5, &one, 1));
    EXPECT_EQ(one.position.x, 7);
    EXPECT_EQ(fc_mesh_get_vertices(mesh, 24, &one, 1), FC_INVALID_ARGUMENT);
    EXPECT_EQ(fc_mesh_set_vertices(mesh, ~0u, vertices.data(), count), FC_INVALID_ARGUMENT);
    EXPECT_EQ(fc_mesh_box({ -1, 2, 3 }, mesh.out()), FC_INVALID_ARGUMENT);
    CImage image;
    EXPECT_EQ(fc_image_create(2, 2, FC_FORMAT_RGBA8, vertices.data(), 15, image.out()), FC_INVALID_ARGUMENT);
    ASSERT_OK(fc_image_create(2, 2, FC_FORMAT_RGBA8, vertices.data(), 16, image.out()));
    uint64_t size = 0;
    EXPECT_EQ(std::memcmp(fc_image_pixels(image, &size), vertices.data(), 16), 0);
    EXPECT_EQ(size, 16u);
    EXPECT_EQ(fc_image_format(image), FC_FORMAT_RGBA8);
}

/// A red ball in the sun, by C.
std::vector<std::byte> drawnByC(fc_backend backend, fc_hit& hit) {
    CEngine engine;
    createEngine(engine, backend);
    CScene scene;
    EXPECT_OK(fc_scene_create(engine, scene.out()));
    CMesh mesh;
    EXPECT_OK(fc_mesh_sphere(0.5f, 32, 16, mesh.out()));
    fc_renderable_desc desc;
    fc_renderable_desc_init(&desc);
    EXPECT_OK(fc_vertex_buffer_create(engine, mesh, &desc.vertices));
    EXPECT_OK(fc_index_buffer_create(engine, mesh, &desc.indices));
    fc_material material{};
    EXPECT_OK(fc_material_built_in(engine, "lit", &material));
    EXPECT_OK(fc_instance_create(engine, material, "red", &desc.material));
    EXPECT_OK(fc_instance_set_float3(engine, desc.material, "baseColor", { 0.8f, 0.1f, 0.1f }));
    EXPECT_OK(fc_instance_set_number(engine, desc.material, "roughness", 0.3));
    EXPECT_OK(fc_scene_add_node(scene, {}, &kIdentity, "ball", &desc.node));
    fc_renderable ball{};
    EXPECT_OK(fc_scene_add_renderable(scene, &desc, &ball));
    fc_sun sun;
    fc_sun_init(&sun);
    sun.direction = { -1, -2, -1.5f };
    fc_light light{};
    EXPECT_OK(fc_scene_add_sun(scene, &sun, {}, &light));
    CView view;
    EXPECT_OK(fc_view_create({ 64, 48 }, view.out()));
    EXPECT_OK(fc_view_set_option(view, "bloom", "on"));
    fc_view_look_at(view, { 0, 0.3, 2 }, { 0, 0, 0 }, { 0, 1, 0 }, nullptr);
    CRenderer renderer;
    EXPECT_OK(fc_renderer_create(engine, renderer.out()));
    CImage image;
    EXPECT_OK(fc_renderer_render_to_image(renderer, scene, view, image.out()));
    EXPECT_OK(fc_renderer_pick(renderer, scene, view, { 32, 24 }, &hit));
    EXPECT_STREQ(fc_scene_node_name(scene, hit.node), "ball");
    EXPECT_EQ(hit.renderable.bits, ball.bits);
    EXPECT_STREQ(fc_engine_take_errors(engine), "");
    EXPECT_NE(std::string(fc_renderer_explain(renderer)).find("bloom"), std::string::npos);
    uint64_t size = 0;
    const void* pixels = fc_image_pixels(image, &size);
    const auto first = static_cast<const std::byte*>(pixels);
    fc_instance_destroy(engine, desc.material);
    fc_material_destroy(engine, material);
    fc_vertex_buffer_destroy(engine, desc.vertices);
    fc_index_buffer_destroy(engine, desc.indices);
    return { first, first + size };
}

/// The same by C++.
std::vector<std::byte> drawnByCpp(Backend backend) {
    Result<Engine> engine = Engine::create({ .backend = backend, .workers = 0, .validation = true });
    EXPECT_TRUE(engine);
    Scene scene(*engine);
    const Result<Mesh> mesh = makeUvSphere();
    const Owned<VertexBuffer> vertices = engine->own(engine->create(mesh->vertexBuffer()));
    const Owned<IndexBuffer> indices = engine->own(engine->create(mesh->indexBuffer()));
    const Owned<Material> material = engine->own(*createBuiltInMaterial(*engine, "lit"));
    const Owned<MaterialInstance> red = engine->own(engine->createInstance(material));
    EXPECT_TRUE(engine->set(red, "baseColor", float3(0.8f, 0.1f, 0.1f)));
    EXPECT_TRUE(engine->set(red, "roughness", 0.3));
    scene.add({ .vertices = vertices, .indices = indices, .material = red });
    scene.add(SunLight{ .directionWorld = { -1, -2, -1.5f } });
    View view{ .camera = Camera::lookAt({ 0, 0.3, 2 }, { 0, 0, 0 }), .size = { 64, 48 } };
    view.effects.bloom.enabled = true;
    return Renderer(*engine).renderToImage(scene, view)->pixels;
}

TEST(CInterface, DrawsTheBitsOfCppOnBothApis) {
    fc_hit vulkan{}, gles{};
    const std::vector<std::byte> drawn = drawnByC(FC_BACKEND_VULKAN, vulkan);
    EXPECT_EQ(drawn.size(), 64u * 48 * 4);
    EXPECT_EQ(drawn, drawnByC(FC_BACKEND_GLES, gles));
    EXPECT_EQ(drawn, drawnByCpp(Backend::Vulkan));
    EXPECT_NEAR(vulkan.distance_meters, 1.5, 0.1);
    EXPECT_EQ(vulkan.distance_meters, gles.distance_meters);
}

} // namespace
} // namespace filament_core
