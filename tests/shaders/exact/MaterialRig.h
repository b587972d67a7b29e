// SPDX-License-Identifier: Apache-2.0
/// MaterialRig: draws a grid of bumpy normals with one of the engine's materials on one device, without the engine.
///   In      a material, a variant, constants and parameters by name, frame uniforms and lights.
///   Out     the RGBA32F image as floats. Fails: the error of the driver.
#pragma once

#include "backend/create/CreateDriver.h"
#include "backend/stream/CommandStream.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/Package.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace filament_core::shader::test {

inline constexpr uint32_t kPictureSide = 64;

struct MaterialScene {
    std::string material = "gltf_lit_opaque";
    std::string source; ///< compiled instead of an engine material, unless empty
    uint16_t variant = 0;
    std::map<std::string, uint32_t> constants;            ///< bits by name
    std::map<std::string, std::vector<float>> parameters; ///< components by name; missing ones are 0
    FrameUniforms frame{};                                ///< matrices are filled in by the rig
    std::vector<PunctualLight> lights;
    bool removesUnusedTextures = false; ///< as the engine does when it loads the material
};

class MaterialRig {
public:
    /// Null where no such device is installed.
    static std::unique_ptr<MaterialRig> make(Backend type);
    Result<std::vector<float>> render(MaterialScene const& scene);

    /// The package of the scene's material, compiled once per source.
    Result<MaterialPackage> package(MaterialScene const& scene);

private:
    explicit MaterialRig(std::unique_ptr<backend::CommandStream> stream) : mStream(std::move(stream)) {}

    void createShared();
    backend::BufferHandle buffer(backend::CommandBuffer& commands, backend::BufferUsage usage,
                                 std::span<const std::byte> bytes);
    backend::TextureHandle pattern(backend::CommandBuffer& commands, uint8_t binding);
    backend::TextureHandle texture(backend::CommandBuffer& commands, backend::TextureKind type, backend::Format format,
                                   uint32_t side, std::span<const std::byte> texels);
    backend::BindGroupHandle viewGroup(backend::CommandBuffer& commands, MaterialScene const& scene);
    backend::BindGroupHandle passGroup(backend::CommandBuffer& commands, MaterialPackage const& package);
    backend::BindGroupHandle materialGroup(backend::CommandBuffer& commands, MaterialPackage const& package,
                                           MaterialScene const& scene);
    backend::PipelineHandle pipeline(backend::CommandBuffer& commands, MaterialPackage const& package,
                                     MaterialScene const& scene, backend::PassLayout const& pass);
    void draw(backend::CommandBuffer& commands, MaterialPackage const& package, MaterialScene const& scene);

    std::unique_ptr<backend::CommandStream> mStream;
    backend::TextureHandle mColor, mDepth, mWhiteCube, mDfg;
    std::map<uint8_t, backend::TextureHandle> mPatterns; ///< by binding: each of other colours
    backend::SamplerHandle mSampler;
    backend::BufferHandle mVertices, mIndices, mInstance, mObjects;
    uint32_t mIndexCount = 0;
};

} // namespace filament_core::shader::test
