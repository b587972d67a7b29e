// SPDX-License-Identifier: Apache-2.0
/// MaterialStand: a material on the mesh and with the values that its file chooses.
///   In      a MaterialFile; values and a mesh given in addition override those of the file.
///   Life    the stand owns what it shows: it must outlive the scenes it was added to.
///   Thread  that of the engine.
///   Fails   NotFound or InvalidArgument naming file, parameter and cure; errors of the engine.
#pragma once

#include "toolkit/materials/MaterialFile.h"
#include "toolkit/materials/MaterialPictures.h"
#include "toolkit/materials/MaterialValues.h"

#include <filament_core/Box.h>
#include <filament_core/Scene.h>

#include <string>
#include <vector>

namespace filament_core::tools {

/// What make() would otherwise create, unpacking code for 20 to 100 ms.
struct StandMaterials {
    Owned<Material> shown; ///< of MaterialFile::bytes, with the constants of its values
    Owned<Material> slab;  ///< kSlabPackage, if MaterialShow::slab
};

class MaterialStand {
public:
    static constexpr const char* kSlabPackage = "gltf_lit_opaque";

    /// `made`: becomes the stand's.
    static Result<MaterialStand> make(Engine& engine, MaterialFile const& file, MaterialValues const& values = {},
                                      std::string const& mesh = {}, StandMaterials made = {});

    /// Changes the values of its parameters; constants cannot change.
    Result<void> set(Engine& engine, MaterialFile const& file, MaterialValues const& values);
    /// Another instance of the material, which lives as long as the stand; constants stay.
    Result<MaterialInstance> vary(Engine& engine, MaterialFile const& file, MaterialValues const& values);
    /// `instance`: none for that of the stand. Returns a node of its own, with which all that was added moves.
    Node addTo(Scene& scene, double4x4 const& worldFromObject = double4x4(1.0),
               LightChannels channels = kDefaultLightChannels, MaterialInstance instance = {}) const;
    Material material() const { return mMaterial; }
    MaterialInstance instance() const { return mInstance; }

private:
    Result<void> addSlab(Engine& engine);
    Result<void> setAll(Engine& engine, MaterialInstance instance, MaterialFile const& file,
                        MaterialValues const& values);
    Result<void> setOne(Engine& engine, MaterialInstance instance, MaterialFile const& file, std::string const& name,
                        std::string const& value);

    struct Geometry {
        Owned<VertexBuffer> vertices;
        Owned<IndexBuffer> indices;
    };
    std::string mName;
    Owned<Material> mMaterial, mSlabMaterial;
    Owned<MaterialInstance> mInstance, mSlabInstance;
    std::vector<Owned<MaterialInstance>> mVariations;
    Geometry mMesh, mBox;
    std::vector<MaterialPicture> mPictures;
    uint32_t mInstances = 1;
    bool mIsInObjectSpace = true;

    static Result<Geometry> makeGeometry(Engine& engine, std::string const& mesh);
};

} // namespace filament_core::tools
