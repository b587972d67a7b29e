// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfExtensions.h"

#include <algorithm>
#include <array>

namespace filament_core::assets {
namespace {

constexpr auto kRatified = GltfExtensionState::Ratified, kReleaseCandidate = GltfExtensionState::ReleaseCandidate,
               kVendor = GltfExtensionState::Vendor, kDraft = GltfExtensionState::Draft,
               kArchived = GltfExtensionState::Archived;

constexpr std::array kExtensions{
    GltfExtension{ "KHR_draco_mesh_compression", kRatified, "meshes compressed by Draco" },
    GltfExtension{ "EXT_meshopt_compression", kRatified, "buffers compressed by meshoptimizer, codec version 0" },
    GltfExtension{ "KHR_meshopt_compression", kReleaseCandidate,
                   "buffers compressed by meshoptimizer, codec versions 0 and 1, with filtered colours" },
    GltfExtension{ "KHR_mesh_quantization", kRatified,
                   "positions, normals and texture coordinates as 8- and 16-bit integers" },
    GltfExtension{ "KHR_gaussian_splatting", kRatified,
                   "splats, 3D Gaussians, of the kernel `ellipse` with spherical harmonics up to degree 3" },
    GltfExtension{ "EXT_mesh_primitive_restart", kDraft, "strips, loops and fans that are drawn as one" },
    GltfExtension{ "KHR_texture_transform", kRatified, "textures are moved, turned and scaled, each on its own" },
    GltfExtension{ "KHR_texture_basisu", kRatified, "textures in KTX 2.0 files, compressed by Basis Universal" },
    GltfExtension{ "EXT_texture_astc", kDraft, "textures in KTX 2.0 files, compressed as ASTC of any block size" },
    GltfExtension{ "EXT_texture_avif", kVendor, "textures in AVIF files" },
    GltfExtension{ "EXT_texture_webp", kRatified, "textures in WebP files" },
    GltfExtension{ "MSFT_texture_dds", kVendor, "textures in DDS files, as BC1 to BC7 or plain" },
    GltfExtension{ "KHR_node_visibility", kRatified, "nodes that are not visible hide what is below them" },
    GltfExtension{ "KHR_node_selectability", kRatified,
                   "picks for selection pass through nodes that are not selectable, and what is below them" },
    GltfExtension{ "KHR_node_hoverability", kDraft, "the same for picks that follow the pointer" },
    GltfExtension{ "KHR_animation_pointer", kRatified,
                   "animations of materials, texture transforms, lights, cameras, visibility and what picks hit" },
    GltfExtension{ "MSFT_lod", kVendor,
                   "nodes in levels of detail, chosen by the program for each view; of materials, the finest level" },
    GltfExtension{ "EXT_mesh_gpu_instancing", kRatified, "a mesh at many places, as instances" },
    GltfExtension{ "KHR_lights_punctual", kRatified, "suns, points and spots in lux and candela" },
    GltfExtension{ "EXT_lights_ies", kVendor, "points with a photometric profile" },
    GltfExtension{ "EXT_lights_image_based", kVendor,
                   "the environment of the file lights the scene if the program gives no other" },
    GltfExtension{ "EXT_materials_bump", kDraft, "a map of heights that tilts the normal" },
    GltfExtension{ "KHR_materials_anisotropy", kRatified, "highlights stretched along a direction" },
    GltfExtension{ "KHR_materials_clearcoat", kRatified,
                   "a clear layer over the material, with a roughness and a normal of its own" },
    GltfExtension{ "KHR_materials_diffuse_transmission", kReleaseCandidate,
                   "light through thin surfaces, scattered, in a colour" },
    GltfExtension{ "KHR_materials_dispersion", kRatified, "refraction that depends on the wavelength" },
    GltfExtension{ "KHR_materials_emissive_strength", kRatified, "emission beyond 1: in nits" },
    GltfExtension{ "KHR_materials_ior", kRatified, "the index of refraction, and with it the reflectance" },
    GltfExtension{ "KHR_materials_iridescence", kRatified, "thin-film interference" },
    GltfExtension{ "KHR_materials_pbrSpecularGlossiness", kArchived,
                   "the older model of specular colour and glossiness" },
    GltfExtension{ "KHR_materials_sheen", kRatified, "a layer of fibres" },
    GltfExtension{ "KHR_materials_specular", kRatified, "the strength and colour of a dielectric's reflection" },
    GltfExtension{ "KHR_materials_transmission", kRatified,
                   "light through thin surfaces, refracted by roughness alone" },
    GltfExtension{ "KHR_materials_unlit", kRatified, "colours without light" },
    GltfExtension{ "KHR_materials_variants", kRatified, "sets of materials by name" },
    GltfExtension{ "KHR_materials_volume", kRatified, "refraction and absorption by a body of some thickness" },
    GltfExtension{ "KHR_materials_volume_scatter", kDraft,
                   "light scattered inside such a body, in a colour, forwards or backwards" },
    GltfExtension{ "FILAMENT_bent_normal", kVendor,
                   "the mean open direction in the occlusion texture ([baking](baking.md))" },
    GltfExtension{ "FILAMENT_light", kVendor,
                   "area lights, and what else lights of [saved scenes](#the-extension-filament_light) have" },
    GltfExtension{ "FILAMENT_lightmap", kVendor,
                   "baked light of surfaces, a float texture in a KTX 2.0 file ([baking](baking.md))" },
    GltfExtension{ "KHR_xmp", kArchived, "metadata, without effect" },
    GltfExtension{ "KHR_xmp_json_ld", kRatified, "metadata, without effect" },
};

} // namespace

std::span<const GltfExtension> gltfExtensions() { return kExtensions; }

bool isSupportedGltfExtension(std::string_view name) {
    return std::ranges::find(kExtensions, name, &GltfExtension::name) != kExtensions.end();
}

} // namespace filament_core::assets
