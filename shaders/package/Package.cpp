// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/Package.h"

#include <algorithm>
#include <utility>

namespace filament_core::shader {
namespace {

template <class T, class Key>
T const* find(std::vector<T> const& things, Key const& key, auto member) {
    const auto found = std::ranges::find(things, key, member);
    return found == things.end() ? nullptr : &*found;
}

} // namespace

SharedStage sharedStage(StageCode code) {
    static const SharedStage none = std::make_shared<const StageCode>();
    return code == StageCode{} ? none : std::make_shared<const StageCode>(std::move(code));
}

std::array<backend::ConstantValue, kVariantConstants.size()> variantConstants(uint16_t key) {
    std::array<backend::ConstantValue, kVariantConstants.size()> values;
    std::ranges::transform(kVariantConstants, values.begin(), [&](VariantConstant const& constant) {
        return backend::ConstantValue{ .id = constant.id,
                                       .bits = (key & constant.bit) != 0 ? 1u : 0u,
                                       .type = backend::ConstantValue::Type::Int };
    });
    return values;
}

Variant const* MaterialPackage::findVariant(uint32_t key) const { return find(variants, key, &Variant::key); }

Parameter const* MaterialPackage::findParameter(std::string_view wanted) const {
    return find(parameters, wanted, &Parameter::name);
}

Constant const* MaterialPackage::findConstant(std::string_view wanted) const {
    return find(constants, wanted, &Constant::name);
}

bool MaterialPackage::hasTextures() const {
    return std::ranges::any_of(parameters, [](Parameter const& parameter) { return isTexture(parameter.type); });
}

} // namespace filament_core::shader
