// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/RequiredAttributes.h"

#include "base/ApiCall.h"
#include "base/Assert.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>

namespace filament_core::engine {
namespace {

std::string nameOfLocation(uint32_t location) {
    constexpr const char* kNames[] = { "Position", "Tangents", "Color", "Uv0", "Uv1", "Joints", "Weights" };
    if (location < std::size(kNames)) return kNames[location];
    return fmt::format("Custom0 + {}", location - static_cast<uint32_t>(Attribute::Custom0));
}

std::string namesOf(uint32_t attributes) {
    std::string names;
    for (uint32_t location = 0; attributes >> location != 0; ++location)
        if (attributes >> location & 1) names += (names.empty() ? "" : ", ") + nameOfLocation(location);
    return names;
}

bool hasAttribute(backend::VertexLayout const& layout, Attribute attribute) {
    const auto attributes = std::span(layout.attributes).first(layout.attributeCount);
    return std::ranges::count(attributes, static_cast<uint8_t>(attribute), &backend::VertexAttribute::location) > 0;
}

} // namespace

std::string nameOf(Attribute attribute) { return nameOfLocation(static_cast<uint32_t>(attribute)); }

uint8_t jointSetsOf(backend::VertexLayout const& vertices) {
    FILAMENT_ASSERT(hasAttribute(vertices, Attribute::Joints) && hasAttribute(vertices, Attribute::Weights),
                    "the vertices of a renderable with a skin have joints and weights");
    return hasAttribute(vertices, Attribute::Joints1) && hasAttribute(vertices, Attribute::Weights1) ? 2 : 1;
}

std::string missingAttributes(scene::Material const& material, backend::VertexLayout const& vertices) {
    uint32_t missing = material.package.requiredAttributes & ~material.optionalAttributes;
    for (backend::VertexAttribute const& attribute : std::span(vertices.attributes).first(vertices.attributeCount))
        missing &= ~(1u << attribute.location);
    return namesOf(missing);
}

void requireAttributes(scene::Material const& material, backend::VertexLayout const& vertices) {
    if (const std::string missing = missingAttributes(material, vertices); !missing.empty())
        misused(fmt::format("the vertex buffer lacks what material '{}' reads: {}", material.name, missing));
}

} // namespace filament_core::engine
