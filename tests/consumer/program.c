/* SPDX-License-Identifier: Apache-2.0 */
/* A program in C that knows the installed C interface alone: a ball, counted in the pixels of a picture. */
#include <filament_core.h>

#include <stdio.h>

static int failed(void) {
    fprintf(stderr, "%s\n", fc_last_error());
    return 1;
}

static int draw(fc_engine* engine, fc_scene* scene, fc_mesh* ball) {
    fc_renderable_desc desc;
    fc_renderable_desc_init(&desc);
    fc_material material;
    fc_renderable renderable;
    fc_view* view = NULL;
    fc_renderer* renderer = NULL;
    fc_image* image = NULL;
    if (fc_vertex_buffer_create(engine, ball, &desc.vertices) != FC_OK ||
        fc_index_buffer_create(engine, ball, &desc.indices) != FC_OK ||
        fc_material_built_in(engine, "unlit", &material) != FC_OK ||
        fc_instance_create(engine, material, "white", &desc.material) != FC_OK ||
        fc_scene_add_renderable(scene, &desc, &renderable) != FC_OK ||
        fc_view_create((fc_uint2) { 64, 64 }, &view) != FC_OK || fc_renderer_create(engine, &renderer) != FC_OK)
        return failed();
    const fc_double3 eye = { 0, 0, 2 }, at = { 0, 0, 0 }, up = { 0, 1, 0 };
    fc_view_look_at(view, eye, at, up, NULL);
    if (fc_renderer_render_to_image(renderer, scene, view, &image) != FC_OK) return failed();
    uint64_t size = 0, white = 0;
    const unsigned char* pixels = fc_image_pixels(image, &size);
    for (uint64_t i = 0; i < size; i += 4) white += pixels[i] > 100;
    printf("filament_core %s: %s, %d of %d pixels\n", fc_version(), fc_engine_device(engine), (int)white, (int)(size / 4));
    fc_image_destroy(image);
    fc_renderer_destroy(renderer);
    fc_view_destroy(view);
    fc_scene_remove_renderable(scene, renderable);
    fc_instance_destroy(engine, desc.material);
    fc_material_destroy(engine, material);
    fc_vertex_buffer_destroy(engine, desc.vertices);
    fc_index_buffer_destroy(engine, desc.indices);
    return white > 500 && white < 2000 ? 0 : 1;
}

int main(void) {
    fc_engine* engine;
    fc_scene* scene;
    fc_mesh* ball;
    fc_engine_options options;
    fc_engine_options_init(&options);
    options.backend = FC_BACKEND_GLES;
    if (fc_engine_create(&options, &engine) != FC_OK || fc_scene_create(engine, &scene) != FC_OK ||
        fc_mesh_sphere(0.5f, 32, 16, &ball) != FC_OK)
        return failed();
    const int status = draw(engine, scene, ball);
    fc_mesh_destroy(ball);
    fc_scene_destroy(scene);
    fc_engine_destroy(engine);
    return status;
}
