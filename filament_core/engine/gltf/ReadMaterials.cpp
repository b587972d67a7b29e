// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/ReadMaterials.h"

#include "base/Assert.h"
#include "base/Log.h"
#include "filament_core/engine/materials/LoadMaterial.h"

#include <optional>
#include <vector>

namespace filament_core {
namespace {

using assets::kNone;

/// The engine's own packages are well formed: a failure is a defect of GltfMaterialSettings.
template <class T>
T required(Result<T> result) {
    if (!result) log(Severity::Error, "{}", result.error().message);
    FILAMENT_ASSERT(result.ok(), "the glTF materials have the constants that GltfMaterialSettings names");
    return std::move(*result);
}

/// The materials of one package.
struct OfPackage {
    std::vector<std::string> keys;
    std::vector<GltfMaterialSettings> settings;
    std::vector<std::optional<scene::Material>> materials;
};

class Collector {
public:
    Collector(assets::ModelData const& model, GltfMaterialChoice const& choice) : mModel(model), mChoice(choice) {}

    void add(assets::PrimitiveData const& primitive) {
        const GltfVertices vertices = verticesOf(primitive);
        add(primitive.material, vertices);
        for (assets::VariantMaterial const& variant : primitive.variants) add(variant.material, vertices);
    }
    std::map<std::string, OfPackage> take() { return std::move(mPackages); }

private:
    void add(uint32_t index, GltfVertices const& vertices) {
        if (!mSeen.try_emplace({ index, vertices }).second) return;
        GltfMaterialSettings settings = settingsOf(materialOf(mModel, index), vertices, 1, mChoice.maxMaps);
        if (mChoice.sectionPlanes) useSections(settings);
        std::string key = materialKey(settings);
        if (!mKeys.try_emplace(key).second) return;
        OfPackage& package = mPackages[settings.package];
        package.keys.push_back(std::move(key));
        package.settings.push_back(std::move(settings));
        package.materials.emplace_back();
    }

    assets::ModelData const& mModel;
    GltfMaterialChoice mChoice;
    std::map<std::pair<uint32_t, GltfVertices>, std::monostate> mSeen;
    std::map<std::string, std::monostate> mKeys;
    std::map<std::string, OfPackage> mPackages;
};

void read(OfPackage& package, GltfMaterialChoice const& choice) {
    // Once for each package: unpacking takes far longer than the copies for its other materials.
    shader::MaterialPackage unpacked = required(engine::unpackMaterial(materialDesc(package.settings.front(), choice)));
    for (size_t i = 0; i < package.settings.size(); ++i) {
        const bool isLast = i + 1 == package.settings.size();
        shader::MaterialPackage own = isLast ? std::move(unpacked) : unpacked;
        package.materials[i] =
                required(engine::specialiseMaterial(std::move(own), materialDesc(package.settings[i], choice)));
    }
}

} // namespace

std::string materialKey(GltfMaterialSettings const& settings) {
    std::string key = settings.package;
    for (MaterialConstant const& constant : settings.constants) {
        key += '|' + constant.name + '=';
        key += std::visit([](auto value) { return std::to_string(value); }, constant.value);
    }
    return key;
}

MaterialDesc materialDesc(GltfMaterialSettings const& settings, GltfMaterialChoice const& choice) {
    return { choice.package(settings.package), settings.constants, settings.package };
}

assets::MaterialData const& materialOf(assets::ModelData const& model, uint32_t index) {
    static const assets::MaterialData defaultMaterial{ .name = "glTF default" };
    return index == kNone ? defaultMaterial : model.materials[index];
}

GltfReadyMaterials readMaterials(assets::ModelData const& model, GltfMaterialChoice const& choice,
                                 jobs::JobSystem& jobs) {
    Collector collector(model, choice);
    for (assets::MeshData const& mesh : model.meshes)
        for (assets::PrimitiveData const& primitive : mesh.primitives)
            if (!primitive.splats) collector.add(primitive);
    std::map<std::string, OfPackage> packages = collector.take();
    {
        const jobs::AdoptedThread seat(jobs);
        jobs::JobGroup group(jobs);
        for (auto& [name, package] : packages)
            group.run<"unpack material">([&package = package, &choice] { read(package, choice); });
        group.wait();
    }
    GltfReadyMaterials ready;
    for (auto& [name, package] : packages)
        for (size_t i = 0; i < package.keys.size(); ++i)
            ready.emplace(std::move(package.keys[i]), std::move(*package.materials[i]));
    return ready;
}

} // namespace filament_core
