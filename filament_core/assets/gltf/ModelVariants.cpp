// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/ModelVariants.h"

#include "base/Suggest.h"

#include <algorithm>

namespace filament_core::assets {

Result<uint32_t> findVariant(std::span<const std::string> variants, std::string_view name, std::string_view model) {
    if (variants.empty())
        return fail(ErrorCode::InvalidArgument, "{} has no variants, so there is no '{}'", model, name);
    const auto found = std::ranges::find(variants, name);
    if (found != variants.end()) return static_cast<uint32_t>(found - variants.begin());
    const std::vector<std::string_view> known(variants.begin(), variants.end());
    return fail(ErrorCode::InvalidArgument, "{} has no variant '{}'{}", model, name, suggestion(name, known));
}

Result<void> selectVariant(ModelData& model, std::string_view name) {
    if (name.empty()) return {};
    const Result<uint32_t> variant = findVariant(model.variants, name, model.name);
    if (!variant) return variant.error();
    for (MeshData& mesh : model.meshes) {
        for (PrimitiveData& primitive : mesh.primitives) {
            const auto found = std::ranges::find(primitive.variants, *variant, &VariantMaterial::variant);
            if (found != primitive.variants.end()) primitive.material = found->material;
        }
    }
    return {};
}

} // namespace filament_core::assets
