// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfExtensions.h"

#include <algorithm>
#include <array>

namespace filament_core::assets {
namespace {

constexpr std::array kExtensions{
    GltfExtension{ "KHR_draco_mesh_compression", "meshes compressed by Draco" },
    GltfExtension{ "EXT_meshopt_compression", "buffers compressed by meshoptimizer" },
    GltfExtension{ "KHR_meshopt_compression", "the same, as Khronos standardised it" },
    GltfExtension{ "KHR_mesh_quantization", "positions, normals and texture coordinates as 8- and 16-bit integers" },
    GltfExtension{ "KHR_texture_transform", "textures are moved, turned and scaled, each on its own" },
    GltfExtension{ "KHR_texture_basisu", "textures in KTX 2.0 files, compressed by Basis Universal" },
    GltfExtension{ "EXT_texture_avif", "textures in AVIF files" },
    GltfExtension{ "EXT_texture_webp", "textures in WebP files" },
    GltfExtension{ "KHR_node_visibility", "nodes that are not visible hide what is below them" },
    GltfExtension{ "KHR_animation_pointer",
                   "animations of materials, texture transforms, lights, cameras and visibility" },
    GltfExtension{ "MSFT_lod",
                   "nodes in levels of detail, chosen by the program for each view; of materials, the finest level" },
    GltfExtension{ "EXT_mesh_gpu_instancing", "a mesh at many places, as instances" },
    GltfExtension{ "KHR_lights_punctual", "suns, points and spots in lux and candela" },
    GltfExtension{ "EXT_lights_ies", "points with a photometric profile" },
    GltfExtension{ "EXT_lights_image_based",
                   "the environment of the file lights the scene if the program gives no other" },
    GltfExtension{ "EXT_materials_bump", "a map of heights that tilts the normal" },
    GltfExtension{ "KHR_materials_anisotropy", "highlights stretched along a direction" },
    GltfExtension{ "KHR_materials_clearcoat",
                   "a clear layer over the material, with a roughness and a normal of its own" },
    GltfExtension{ "KHR_materials_diffuse_transmission", "light through thin surfaces, scattered, in a colour" },
    GltfExtension{ "KHR_materials_dispersion", "refraction that depends on the wavelength" },
    GltfExtension{ "KHR_materials_emissive_strength", "emission beyond 1: in nits" },
    GltfExtension{ "KHR_materials_ior", "the index of refraction, and with it the reflectance" },
    GltfExtension{ "KHR_materials_iridescence", "thin-film interference" },
    GltfExtension{ "KHR_materials_pbrSpecularGlossiness", "the older model of specular colour and glossiness" },
    GltfExtension{ "KHR_materials_sheen", "a layer of fibres" },
    GltfExtension{ "KHR_materials_specular", "the strength and colour of a dielectric's reflection" },
    GltfExtension{ "KHR_materials_transmission", "light through thin surfaces, refracted by roughness alone" },
    GltfExtension{ "KHR_materials_unlit", "colours without light" },
    GltfExtension{ "KHR_materials_variants", "sets of materials by name" },
    GltfExtension{ "KHR_materials_volume", "refraction and absorption by a body of some thickness" },
    GltfExtension{ "KHR_xmp", "metadata, without effect" },
    GltfExtension{ "KHR_xmp_json_ld", "metadata, without effect" },
};

} // namespace

std::span<const GltfExtension> gltfExtensions() { return kExtensions; }

bool isSupportedGltfExtension(std::string_view name) {
    return std::ranges::find(kExtensions, name, &GltfExtension::name) != kExtensions.end();
}

} // namespace filament_core::assets
