// SPDX-License-Identifier: Apache-2.0
/// RequiredAttributes: whether vertices have the attributes that a material reads.
///   Fails   requireAttributes(), jointSetsOf(): end the process, with the material and the names of what is
///           missing: shaders would read zeros.
///   Thread  any; pure.
#pragma once

#include "backend/api/Descriptions.h"
#include "filament_core/scene/Materials.h"

#include <filament_core/Objects.h>

#include <string>

namespace filament_core::engine {

/// 1 or 2; ends the process without any.
uint8_t jointSetsOf(backend::VertexLayout const& vertices);

/// As shaders call it.
std::string nameOf(Attribute attribute);

/// Their names; empty: none are.
std::string missingAttributes(scene::Material const& material, backend::VertexLayout const& vertices);
void requireAttributes(scene::Material const& material, backend::VertexLayout const& vertices);

} // namespace filament_core::engine
