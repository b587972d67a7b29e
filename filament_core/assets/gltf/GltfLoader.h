// SPDX-License-Identifier: Apache-2.0
/// GltfLoader: loads a glTF 2.0 file, .gltf or .glb, as ModelData; by its ending also an .obj, .ply or .stl
/// (MeshFileModel.h).
///   In      any file; the content is untrusted. External buffers and images are beside or below it (see GltfUri.h).
///   Out     the default scene. Default morph weights and the skins' rest pose are applied, or, with
///           GltfOptions::deformation, skins, morph targets and animations are kept as data. Only what the scene shows
///           is loaded: unused meshes, materials and images are skipped.
///   Knows   the extensions of GltfExtensions.h. Another one is an error if the file requires it; otherwise it is named
///           in ModelData::warnings, once, and the material without it is drawn.
///   Images  PNG, JPEG, WebP, AVIF, KTX 2.0, DDS (image/TextureDecoder.h); their first bytes, not their MIME types, say
///           which.
///   Thread  any; images and primitives are decoded as jobs, and this thread takes part. The result does not depend on
///           the number of workers.
///   Memory  the file, and about twice the result while loading.
///   Fails   one line naming file, element and reason: "helmet.gltf: accessors[3]: 24 elements end at byte 300, ...".
///   Cost    bench/filament_core/assets/GltfBench.cpp
#pragma once

#include "base/Result.h"
#include "filament_core/assets/files/PathInside.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "filament_core/assets/gltf/ModelData.h"
#include "jobsystem/Cancellation.h"
#include "jobsystem/JobSystem.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace filament_core::assets {

enum class GltfStage : uint8_t {
    Structure, ///< JSON and buffers
    Content,   ///< images and primitives, one step each
};

class GltfImageStore;

struct GltfOptions {
    /// Called after every step, with `done` increasing from 0 to `total`; from any worker, but never from two at once.
    std::function<void(GltfStage stage, size_t done, size_t total)> progress = {};
    uint32_t maxTextureSize = 0; ///< texels; larger images start at a smaller mip level. 0: no limit
    GeometryStorage storage{};
    GltfDeformation deformation = GltfDeformation::AtRest;
    GltfLevels levels = GltfLevels::Finest;
    GltfNormals normals = GltfNormals::Plain;
    GltfBlocks blocks = GltfBlocks::None;
    bool simplifies = false;             ///< for who uploads the primitives: they get levels (DetailLevels.h)
    FilesFrom files = FilesFrom::Folder; ///< which buffers and images are opened
    GltfResolver resolve{};              ///< gives the bytes of buffers and images, instead of files
    /// Given: learns to decode textures again; those that can be streamed are loaded with their coarsest levels only.
    std::shared_ptr<GltfImageStore> streams{};
    /// Requested from any thread: the load ends before its next image or primitive, with Cancelled. Must outlive it.
    jobs::Cancellation const* cancellation = nullptr;
    std::string name = "model"; ///< name of a file in memory in messages; loadGltf() fills it in
};

Result<ModelData> loadGltf(std::filesystem::path const& path, jobs::JobSystem& jobs, GltfOptions options = {});

/// `baseDirectory` is where relative URIs start.
Result<ModelData> loadGltfFromMemory(std::span<const std::byte> file, std::filesystem::path const& baseDirectory,
                                     jobs::JobSystem& jobs, GltfOptions const& options = {});

} // namespace filament_core::assets
