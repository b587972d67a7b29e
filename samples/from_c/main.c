/* SPDX-License-Identifier: Apache-2.0 */
/* from_c MODEL [vulkan|gles] [OUT.png]: a glTF model under a clear sky, through the C interface. */
#include <filament_core.h>

#include <stdio.h>
#include <string.h>

static int failed(void) {
    fprintf(stderr, "from_c: error: %s\n", fc_last_error());
    return 1;
}

/* The model in the middle of a view from below. */
static int draw(fc_engine* engine, fc_scene* scene, fc_model* model, fc_environment* sky, const char* path) {
    const fc_double4x4 here = { { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
    fc_node root;
    if (fc_scene_add_model(scene, model, &here, &root) != FC_OK) return failed();
    fc_scene_set_environment(scene, sky, 1000, 0);

    const fc_box box = fc_scene_bounds(scene);
    const fc_double3 center = { (box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, (box.min.z + box.max.z) / 2 };
    const double height = box.max.y - box.min.y;
    const fc_double3 eye = { center.x + 0.6 * height, center.y - 0.2 * height, center.z + 1.5 * height };
    const fc_double3 up = { 0, 1, 0 };
    fc_camera camera;
    fc_camera_init(&camera);
    camera.vertical_fov_degrees = 40;

    fc_view* view = NULL;
    fc_renderer* renderer = NULL;
    fc_image* image = NULL;
    int done = fc_view_create((fc_uint2) { 320, 180 }, &view) == FC_OK &&
               fc_view_set_option(view, "ambientOcclusion", "on") == FC_OK && fc_renderer_create(engine, &renderer) == FC_OK;
    if (done) fc_view_look_at(view, eye, center, up, &camera);
    done = done && fc_renderer_render_to_image(renderer, scene, view, &image) == FC_OK &&
           fc_image_save_png(image, path) == FC_OK;
    const int status = done ? 0 : failed();
    fc_image_destroy(image);
    fc_renderer_destroy(renderer);
    fc_view_destroy(view);
    return status;
}

int main(int argc, char** argv) {
    if (argc < 2) {
        fprintf(stderr, "usage: from_c MODEL [vulkan|gles] [OUT.png]\n");
        return 1;
    }
    fc_engine_options options;
    fc_engine_options_init(&options);
    options.backend = argc > 2 && strcmp(argv[2], "vulkan") == 0 ? FC_BACKEND_VULKAN : FC_BACKEND_GLES;
    fc_engine* engine = NULL;
    if (fc_engine_create(&options, &engine) != FC_OK) return failed();
    fc_model* model = NULL;
    fc_environment* sky = NULL;
    fc_scene* scene = NULL;
    const fc_float3 to_sun = { 0.5f, 0.5f, 0.7f };
    const int loaded = fc_model_load(engine, argv[1], &model) == FC_OK &&
                       fc_environment_sky(engine, 3, to_sun, &sky) == FC_OK && fc_scene_create(engine, &scene) == FC_OK;
    const int status = loaded ? draw(engine, scene, model, sky, argc > 3 ? argv[3] : "from_c.png") : failed();
    fc_scene_destroy(scene);
    fc_environment_destroy(sky);
    fc_model_destroy(model);
    fc_engine_destroy(engine);
    return status;
}
