/* SPDX-License-Identifier: Apache-2.0 */
/* filament_core: the C interface. Physically based rendering with the same bits on Vulkan and OpenGL ES.
     Use       fc_engine* engine;
               if (fc_engine_create(NULL, &engine) != FC_OK) fprintf(stderr, "%s\n", fc_last_error());
     Errors    calls that may fail return a code and leave *result alone; fc_last_error() has the reason. Other calls do
               nothing if an argument is null that must not be, and set fc_last_error().
     Misuse    a handle of 0, one whose object ended, or one of another engine or scene ends the process with one line,
               as in C++ (Engine.h).
     Objects   pointers come from functions that create or load something, and end with their _destroy. What uses an
               object keeps it; an engine ends last. Handles are values, and end with their _destroy or _remove, with
               their scene or with their engine.
     Structs   fc_NAME_init() gives them the defaults; a null pointer stands for the defaults. Members are only ever
               added at the end: struct_bytes says which a program knows.
     Text      UTF-8. Text that is returned is valid until the next call on this thread that returns text.
     Thread    that of the engine (fc_engine_create(), fc_engine_use_on_this_thread()); meshes and images any.
     Bits      of pictures are those of C++, and the same on both APIs. */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a call that may fail returns. fc_last_error() has the reason in one line. */
typedef enum fc_code {
    FC_OK = 0,
    FC_INVALID_ARGUMENT = 1,
    FC_NOT_FOUND = 2,
    FC_UNREADABLE = 3,
    FC_CORRUPT = 4,
    FC_UNSUPPORTED = 5,
    FC_DEVICE_UNAVAILABLE = 6,
    FC_DEVICE_LOST = 7,
    FC_OUT_OF_MEMORY = 8,
    FC_TIMEOUT = 9,
    FC_CANCELLED = 10,
    FC_INTERNAL = 11,
    FC_CODE_MAX = 0x7fffffff
} fc_code;

typedef struct fc_float2 {
    float x, y;
} fc_float2;
typedef struct fc_float3 {
    float x, y, z;
} fc_float3;
typedef struct fc_float4 {
    float x, y, z, w;
} fc_float4;
typedef struct fc_uint2 {
    uint32_t x, y;
} fc_uint2;
typedef struct fc_double3 {
    double x, y, z;
} fc_double3;
/* Column by column: m[12], m[13] and m[14] are the translation. */
typedef struct fc_double4x4 {
    double m[16];
} fc_double4x4;
/* Empty: min.x > max.x. */
typedef struct fc_box {
    fc_double3 min, max;
} fc_box;

typedef enum fc_backend {
    FC_BACKEND_VULKAN = 0,
    FC_BACKEND_GLES = 1, /* OpenGL ES */
    FC_BACKEND_NULL = 2, /* draws nothing */
    FC_BACKEND_MAX = 0x7fffffff
} fc_backend;

typedef enum fc_format {
    FC_FORMAT_R8 = 1,
    FC_FORMAT_RG8 = 2,
    FC_FORMAT_RGBA8 = 3,
    FC_FORMAT_RGBA8_SRGB = 4,
    FC_FORMAT_RGB10A2 = 9,
    FC_FORMAT_R16F = 10,
    FC_FORMAT_RGBA16F = 12,
    FC_FORMAT_R32F = 13,
    FC_FORMAT_RGBA32F = 15,
    FC_FORMAT_MAX = 0x7fffffff
} fc_format;

typedef enum fc_wrap { FC_WRAP_REPEAT = 0, FC_WRAP_CLAMP = 2, FC_WRAP_MIRROR = 1, FC_WRAP_MAX = 0x7fffffff } fc_wrap;

typedef struct fc_texture {
    uint64_t bits;
} fc_texture; /* an image on the device; 0: none */
typedef struct fc_vertex_buffer {
    uint64_t bits;
} fc_vertex_buffer; /* vertices on the device; 0: none */
typedef struct fc_index_buffer {
    uint64_t bits;
} fc_index_buffer; /* indices on the device; 0: none */
typedef struct fc_material {
    uint64_t bits;
} fc_material; /* a compiled material; 0: none */
typedef struct fc_instance {
    uint64_t bits;
} fc_instance; /* a material with values for its parameters; 0: none */
typedef struct fc_target {
    uint64_t bits;
} fc_target; /* textures that views are drawn to; 0: none */
typedef struct fc_swap_chain {
    uint64_t bits;
} fc_swap_chain; /* a ring of images that frames are drawn to and read back from; 0: none */
typedef struct fc_renderable {
    uint64_t bits;
} fc_renderable; /* something that is drawn, of one scene; 0: none */
typedef struct fc_light {
    uint64_t bits;
} fc_light; /* a light of one scene; 0: none */
typedef struct fc_node {
    uint64_t bits;
} fc_node; /* a place that carries renderables and lights, of one scene; 0: none */

typedef struct fc_engine fc_engine;     /* a device, its driver thread, its workers and all objects created from them */
typedef struct fc_scene fc_scene;       /* what can be drawn */
typedef struct fc_renderer fc_renderer; /* draws a scene as seen by a view */
typedef struct fc_view fc_view;         /* a camera and the settings of its image */
typedef struct fc_image fc_image;       /* pixels in memory, row 0 at the top */
typedef struct fc_mesh fc_mesh;         /* triangles in memory */
typedef struct fc_model fc_model;       /* a glTF file */
typedef struct fc_animator fc_animator; /* plays the animations of one copy of a model */
typedef struct fc_environment fc_environment; /* light and background of a scene */

/* How an engine is created. */
typedef struct fc_engine_options {
    uint32_t struct_bytes;       /* set by the function below */
    fc_backend backend;          /* the API */
    const char* require_device;  /* case-insensitive part of the device's name; null: the first usable device */
    int32_t workers;             /* job threads besides the calling one; -1: one per remaining core */
    bool validation;             /* check every command and enable the validation layers of the API */
    const char* trace_file;      /* write every command as text; null: no trace */
    const char* cache_directory; /* baked environments; null: that of the user */
} fc_engine_options;
void fc_engine_options_init(fc_engine_options* engine_options); /* gives it the defaults */

/* A camera's lens and exposure; fc_view_look_at() places it. */
typedef struct fc_camera {
    uint32_t struct_bytes;      /* set by the function below */
    float vertical_fov_degrees; /* (0, 180); perspective only */
    float near_meters;          /* > 0 */
    float orthographic_height;  /* metres; 0: perspective */
    float far_meters;           /* orthographic only */
    float aperture;             /* f-stops, > 0 */
    float shutter_seconds;      /* > 0 */
    float iso;                  /* > 0 */
} fc_camera;
void fc_camera_init(fc_camera* camera); /* gives it the defaults */

/* Parallel light. */
typedef struct fc_sun {
    uint32_t struct_bytes;        /* set by the function below */
    fc_float3 direction;          /* in which the light travels; any length except zero */
    float lux;                    /* on a surface that faces it */
    fc_float3 color;              /* linear, >= 0 */
    float angular_radius_degrees; /* half of its diameter in the sky, [0, 20] */
    bool casts_shadows;
    uint32_t channels; /* bit n: channel n, [0, 7] */
} fc_sun;
void fc_sun_init(fc_sun* sun); /* gives it the defaults */

/* Light from a point in all directions. */
typedef struct fc_point {
    uint32_t struct_bytes; /* set by the function below */
    fc_double3 position;
    float candela;
    fc_float3 color;            /* linear, >= 0 */
    float range_meters;         /* beyond it the light is zero; 0: unlimited */
    float source_radius_meters; /* softness of its shadows */
    bool casts_shadows;
    uint32_t channels; /* bit n: channel n, [0, 7] */
} fc_point;
void fc_point_init(fc_point* point); /* gives it the defaults */

/* Light from a point in a cone. */
typedef struct fc_spot {
    uint32_t struct_bytes; /* set by the function below */
    fc_double3 position;
    fc_float3 direction;
    float candela;              /* of the inner cone */
    fc_float3 color;            /* linear, >= 0 */
    float range_meters;         /* 0: unlimited */
    float inner_cone_radians;   /* [0, outer) */
    float outer_cone_radians;   /* (inner, pi / 2] */
    float source_radius_meters; /* softness of its shadows */
    bool casts_shadows;
    uint32_t channels; /* bit n: channel n, [0, 7] */
} fc_spot;
void fc_spot_init(fc_spot* spot); /* gives it the defaults */

/* Light from a rectangle. */
typedef struct fc_rect {
    uint32_t struct_bytes; /* set by the function below */
    fc_double3 position;   /* of its middle */
    fc_float3 direction;   /* in which it shines */
    fc_float3 up;          /* along its height */
    float width_meters;
    float height_meters;
    float nits;
    fc_float3 color;    /* linear, >= 0 */
    float range_meters; /* 0: unlimited */
    bool two_sided;
    bool casts_shadows;
    bool visible;      /* it is drawn as well */
    uint32_t channels; /* bit n: channel n, [0, 7] */
} fc_rect;
void fc_rect_init(fc_rect* rect); /* gives it the defaults */

/* What a renderable draws. */
typedef struct fc_renderable_desc {
    uint32_t struct_bytes;     /* set by the function below */
    fc_vertex_buffer vertices; /* of a mesh */
    fc_index_buffer indices;   /* of a mesh */
    fc_instance material;      /* what its surface is made of */
    uint32_t first_index;
    uint32_t index_count;           /* 0: all */
    fc_double4x4 world_from_object; /* affine; the identity if there is a node */
    fc_node node;                   /* gives the renderable its place; none: world_from_object */
    bool culled;                    /* false: drawn even when its box is out of view */
    bool casts_shadows;
    bool receives_shadows;
    uint32_t channels; /* lights of these channels shine on it */
    uint32_t layers;   /* views of these layers show it */
    const char* name;
} fc_renderable_desc;
void fc_renderable_desc_init(fc_renderable_desc* renderable_desc); /* gives it the defaults */

/* A vertex of a mesh. */
typedef struct fc_vertex {
    fc_float3 position; /* object space */
    fc_float3 normal;   /* unit length */
    fc_float4 tangents; /* frame as a quaternion: fc_mesh_compute_tangents() */
    fc_float2 uv;       /* u to the right and v upwards */
    fc_float4 color;    /* linear */
} fc_vertex;

/* What a pixel shows. */
typedef struct fc_hit {
    fc_renderable renderable; /* none and no light: nothing is drawn there */
    fc_light light;           /* a light that is drawn */
    fc_node node;             /* that carries it */
    uint32_t primitive;       /* which of the node's renderables it is */
    double distance_meters;   /* from the camera */
    fc_double3 position;
} fc_hit;

/* The reason of the last failure on this thread, in one line; "": none yet. Valid until the next failure. */
const char* fc_last_error(void);
/* "1.2.3", of the library. */
const char* fc_version(void);

void fc_engine_destroy(fc_engine* engine);                /* null: nothing happens */
void fc_scene_destroy(fc_scene* scene);                   /* null: nothing happens */
void fc_renderer_destroy(fc_renderer* renderer);          /* null: nothing happens */
void fc_view_destroy(fc_view* view);                      /* null: nothing happens */
void fc_image_destroy(fc_image* image);                   /* null: nothing happens */
void fc_mesh_destroy(fc_mesh* mesh);                      /* null: nothing happens */
void fc_model_destroy(fc_model* model);                   /* null: nothing happens */
void fc_animator_destroy(fc_animator* animator);          /* null: nothing happens */
void fc_environment_destroy(fc_environment* environment); /* null: nothing happens */

/* Waits for the device. The calling thread becomes the one that uses the engine. */
fc_code fc_engine_create(const fc_engine_options* options, fc_engine** result);
/* The device's name. */
const char* fc_engine_device(fc_engine* engine);
/* Name and version of the driver. */
const char* fc_engine_driver(fc_engine* engine);
/* The calling thread becomes the one that uses the engine and all that belongs to it. */
void fc_engine_use_on_this_thread(fc_engine* engine);
/* Waits until everything submitted has run. */
void fc_engine_wait_idle(fc_engine* engine);
/* Errors of the device and driver since the last call, a line each; empty: none. */
const char* fc_engine_take_errors(fc_engine* engine);
/* Triangles, counter-clockwise seen from the front. */
fc_code fc_mesh_create(const fc_vertex* vertices, size_t vertices_count, const uint32_t* indices, size_t indices_count,
                       fc_mesh** result);
/* In the plane y = 0, its front towards +y. */
fc_code fc_mesh_plane(float width, float depth, fc_mesh** result);
/* Around the origin. */
fc_code fc_mesh_box(fc_float3 size, fc_mesh** result);
/* Meridians and parallels around the origin. */
fc_code fc_mesh_sphere(float radius, uint32_t slices, uint32_t stacks, fc_mesh** result);
/* With caps, along y. */
fc_code fc_mesh_cylinder(float radius, float height, uint32_t slices, fc_mesh** result);
/* With its base at y = -height / 2. */
fc_code fc_mesh_cone(float radius, float height, uint32_t slices, fc_mesh** result);
/* Around the y axis. */
fc_code fc_mesh_torus(float radius, float tube_radius, fc_mesh** result);
/* Vertices. */
uint32_t fc_mesh_vertex_count(fc_mesh* mesh);
/* Indices, three a triangle. */
uint32_t fc_mesh_index_count(fc_mesh* mesh);
/* Copies vertices out of the mesh. */
fc_code fc_mesh_get_vertices(fc_mesh* mesh, uint32_t first, fc_vertex* out, size_t out_count);
/* New values; the number of vertices stays. */
fc_code fc_mesh_set_vertices(fc_mesh* mesh, uint32_t first, const fc_vertex* vertices, size_t vertices_count);
/* Of a smooth surface. */
fc_code fc_mesh_compute_normals(fc_mesh* mesh);
/* From positions, normals and uv, as MikkTSpace defines them; may split vertices. */
fc_code fc_mesh_compute_tangents(fc_mesh* mesh);
/* With any tangent: for materials without normal maps. */
void fc_mesh_tangents_from_normals(fc_mesh* mesh);
/* PNG, JPEG, WebP, AVIF, KTX2, DDS, HDR or EXR; its first bytes tell which. */
fc_code fc_image_load(const char* path, fc_image** result);
/* A copy of tightly packed rows, row 0 at the top. */
fc_code fc_image_create(uint32_t width, uint32_t height, fc_format format, const void* pixels, size_t pixels_size,
                        fc_image** result);
/* Pixels. */
uint32_t fc_image_width(fc_image* image);
/* Pixels. */
uint32_t fc_image_height(fc_image* image);
/* Of its pixels. */
fc_format fc_image_format(fc_image* image);
/* Tightly packed rows; valid until the image ends. */
const void* fc_image_pixels(fc_image* image, uint64_t* size);
/* RGBA8, RGBA8_SRGB or RGB10A2. */
fc_code fc_image_save_png(fc_image* image, const char* path);
/* RGBA16F, linear. */
fc_code fc_image_save_exr(fc_image* image, const char* path);
/* With all of its mip levels. */
fc_code fc_texture_create(fc_engine* engine, fc_image* image, fc_texture* result);
/* For a render target. */
fc_code fc_texture_renderable(fc_engine* engine, uint32_t width, uint32_t height, fc_format format, fc_texture* result);
/* What uses it keeps it. */
void fc_texture_destroy(fc_engine* engine, fc_texture texture);
/* A copy of the mesh's vertices. */
fc_code fc_vertex_buffer_create(fc_engine* engine, fc_mesh* mesh, fc_vertex_buffer* result);
/* From the next frame on; as many vertices as before. */
void fc_vertex_buffer_update(fc_engine* engine, fc_vertex_buffer buffer, fc_mesh* mesh);
/* What uses it keeps it. */
void fc_vertex_buffer_destroy(fc_engine* engine, fc_vertex_buffer buffer);
/* A copy of the mesh's indices. */
fc_code fc_index_buffer_create(fc_engine* engine, fc_mesh* mesh, fc_index_buffer* result);
/* What uses it keeps it. */
void fc_index_buffer_destroy(fc_engine* engine, fc_index_buffer buffer);
/* lit, unlit, litTextured and others: docs/built-in-materials.md. */
fc_code fc_material_built_in(fc_engine* engine, const char* name, fc_material* result);
/* A package that matc compiled. */
fc_code fc_material_load(fc_engine* engine, const char* path, fc_material* result);
/* What uses it keeps it. */
void fc_material_destroy(fc_engine* engine, fc_material material);
/* Parameters begin with zero, those of built-in materials with their defaults. */
fc_code fc_instance_create(fc_engine* engine, fc_material material, const char* name, fc_instance* result);
/* By the parameter's name. */
fc_code fc_instance_set_bool(fc_engine* engine, fc_instance instance, const char* parameter, bool value);
/* A float or an integer parameter. */
fc_code fc_instance_set_number(fc_engine* engine, fc_instance instance, const char* parameter, double value);
/* By the parameter's name. */
fc_code fc_instance_set_float2(fc_engine* engine, fc_instance instance, const char* parameter, fc_float2 value);
/* By the parameter's name. */
fc_code fc_instance_set_float3(fc_engine* engine, fc_instance instance, const char* parameter, fc_float3 value);
/* By the parameter's name. */
fc_code fc_instance_set_float4(fc_engine* engine, fc_instance instance, const char* parameter, fc_float4 value);
/* Filtered linearly between levels. */
fc_code fc_instance_set_texture(fc_engine* engine, fc_instance instance, const char* parameter, fc_texture texture,
                                fc_wrap wrap);
/* For materials with the property doubleSided. */
fc_code fc_instance_set_double_sided(fc_engine* engine, fc_instance instance, bool double_sided);
/* What uses it keeps it. */
void fc_instance_destroy(fc_engine* engine, fc_instance instance);
/* `depth`: R32F, metres along the view; 0: none. */
fc_code fc_target_create(fc_engine* engine, fc_texture color, fc_texture depth, fc_target* result);
/* What uses it keeps it. */
void fc_target_destroy(fc_engine* engine, fc_target target);
/* Without a window. */
fc_code fc_swap_chain_create(fc_engine* engine, fc_uint2 size, uint32_t image_count, fc_swap_chain* result);
/* Pixels that were requested arrive. */
void fc_swap_chain_destroy(fc_engine* engine, fc_swap_chain swap_chain);
/* A .gltf or .glb file, decoded by the workers. */
fc_code fc_model_load(fc_engine* engine, const char* path, fc_model** result);
/* A file that holds everything; `name` is used in messages. */
fc_code fc_model_load_memory(fc_engine* engine, const void* file, size_t file_size, const char* name,
                             fc_model** result);
/* Of the file. */
const char* fc_model_name(fc_model* model);
/* In the rest pose, in model space. */
fc_box fc_model_bounds(fc_model* model);
/* Unsupported extensions and repaired values, a line each. */
const char* fc_model_warnings(fc_model* model);
/* Names of KHR_materials_variants, a line each. */
const char* fc_model_variants(fc_model* model);
/* Animations. */
uint32_t fc_model_animation_count(fc_model* model);
/* May be empty. */
const char* fc_model_animation_name(fc_model* model, uint32_t animation);
/* The time of its last key. */
double fc_model_animation_seconds(fc_model* model, uint32_t animation);
/* For the copy of the model below `root`. */
fc_code fc_animator_create(fc_model* model, fc_scene* scene, fc_node root, fc_animator** result);
/* Poses everything that the animation moves. */
void fc_animator_apply(fc_animator* animator, uint32_t animation, double seconds);
/* The pose of the file. */
void fc_animator_rest(fc_animator* animator);
/* A panorama (.hdr, .exr), a cube map (.ktx2) or a package of cmgen. */
fc_code fc_environment_load(fc_engine* engine, const char* path, fc_environment** result);
/* A clear sky and its sun, computed: turbidity in [1, 10]. Its radiance is in units of 1000 lux. */
fc_code fc_environment_sky(fc_engine* engine, float turbidity, fc_float3 to_sun, fc_environment** result);
/* Empty. */
fc_code fc_scene_create(fc_engine* engine, fc_scene** result);
/* Visible from the next frame on. */
fc_code fc_scene_add_renderable(fc_scene* scene, const fc_renderable_desc* desc, fc_renderable* result);
/* Copies of one renderable below a new node. */
fc_code fc_scene_add_instances(fc_scene* scene, const fc_renderable_desc* desc, const fc_double4x4* node_from_instance,
                               size_t node_from_instance_count, fc_node* result);
/* Parent 0: a root. */
fc_code fc_scene_add_node(fc_scene* scene, fc_node parent, const fc_double4x4* parent_from_node, const char* name,
                          fc_node* result);
/* The root of a copy of the model. */
fc_code fc_scene_add_model(fc_scene* scene, fc_model* model, const fc_double4x4* world_from_model, fc_node* result);
/* Node 0: none. */
fc_code fc_scene_add_sun(fc_scene* scene, const fc_sun* light, fc_node node, fc_light* result);
/* Node 0: none. */
fc_code fc_scene_add_point(fc_scene* scene, const fc_point* light, fc_node node, fc_light* result);
/* Node 0: none. */
fc_code fc_scene_add_spot(fc_scene* scene, const fc_spot* light, fc_node node, fc_light* result);
/* Node 0: none. */
fc_code fc_scene_add_rect(fc_scene* scene, const fc_rect* light, fc_node node, fc_light* result);
/* Light, background and sun; `lux`: what radiance 1 stands for. */
void fc_scene_set_environment(fc_scene* scene, fc_environment* environment, float lux, float rotation_radians);
/* Of KHR_materials_variants; "": the file's own materials. */
fc_code fc_scene_set_variant(fc_scene* scene, fc_node copy, const char* variant);
/* What is below it follows. */
void fc_scene_set_node_transform(fc_scene* scene, fc_node node, const fc_double4x4* parent_from_node);
/* For one without a node. */
void fc_scene_set_renderable_transform(fc_scene* scene, fc_renderable renderable,
                                       const fc_double4x4* world_from_object);
/* All renderables at or below it. */
void fc_scene_set_node_visible(fc_scene* scene, fc_node node, bool visible);
/* Hidden ones cast no shadows. */
void fc_scene_set_renderable_visible(fc_scene* scene, fc_renderable renderable, bool visible);
/* From the next frame on. */
void fc_scene_set_renderable_material(fc_scene* scene, fc_renderable renderable, fc_instance material);
/* With all nodes above. */
fc_double4x4 fc_scene_world_from_node(fc_scene* scene, fc_node node);
/* May be empty. */
const char* fc_scene_node_name(fc_scene* scene, fc_node node);
/* The first at or below `root` (0: in the scene); 0: none. */
fc_node fc_scene_find_node(fc_scene* scene, const char* name, fc_node root);
/* Its handle ends. */
void fc_scene_remove_renderable(fc_scene* scene, fc_renderable renderable);
/* Its handle ends. */
void fc_scene_remove_light(fc_scene* scene, fc_light light);
/* With everything below it. */
void fc_scene_remove_node(fc_scene* scene, fc_node node);
/* Of all renderables, in world space. */
fc_box fc_scene_bounds(fc_scene* scene);
/* With the defaults of every option. */
fc_code fc_view_create(fc_uint2 size, fc_view** result);
/* Pixels, >= 1. */
void fc_view_set_size(fc_view* view, fc_uint2 size);
/* Metres. */
void fc_view_look_at(fc_view* view, fc_double3 eye, fc_double3 at, fc_double3 up, const fc_camera* camera);
/* Rigid: it looks along -z, +y is up. */
void fc_view_set_camera(fc_view* view, const fc_double4x4* world_from_view, const fc_camera* camera);
/* Of the background without an environment; linear. */
void fc_view_set_clear_color(fc_view* view, fc_float4 color);
/* Any option of docs/options.md: "ambientOcclusion" "on", "bloom.strength" "0.2", "shadows" "pcf3". */
fc_code fc_view_set_option(fc_view* view, const char* name, const char* value);
/* The part of a target that it is drawn to. */
void fc_view_set_viewport(fc_view* view, fc_uint2 offset, bool clears);
/* For any scene and view of the engine. */
fc_code fc_renderer_create(fc_engine* engine, fc_renderer** result);
/* Draws one frame and waits for its pixels: RGBA8. */
fc_code fc_renderer_render_to_image(fc_renderer* renderer, fc_scene* scene, fc_view* view, fc_image** result);
/* Into the next image. Returns at once. */
void fc_renderer_render(fc_renderer* renderer, fc_scene* scene, fc_view* view, fc_swap_chain swap_chain);
/* Returns at once. */
void fc_renderer_render_to_target(fc_renderer* renderer, fc_scene* scene, fc_view* view, fc_target target);
/* Requests those rendered last; 0: out of memory. */
uint64_t fc_renderer_read_pixels(fc_renderer* renderer, fc_swap_chain swap_chain);
/* Requests those rendered last; 0: out of memory. */
uint64_t fc_renderer_read_target_pixels(fc_renderer* renderer, fc_target target);
/* Those of a request. */
fc_code fc_renderer_wait_pixels(fc_renderer* renderer, uint64_t ticket, fc_image** result);
/* What a pixel shows, from the left and the top; waits. */
fc_code fc_renderer_pick(fc_renderer* renderer, fc_scene* scene, fc_view* view, fc_uint2 pixel, fc_hit* hit);
/* What the last frame ran, what it left out, and why. */
const char* fc_renderer_explain(fc_renderer* renderer);

#ifdef __cplusplus
}
#endif
