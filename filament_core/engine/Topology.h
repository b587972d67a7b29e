// SPDX-License-Identifier: Apache-2.0
/// The public name of how vertices form primitives -> the backend's.
#pragma once

#include "backend/api/Descriptions.h"

#include <filament/Objects.h>

namespace filament::engine {

inline backend::Topology topology(PrimitiveType primitive) {
    switch (primitive) {
    case PrimitiveType::Triangles:
        return backend::Topology::Triangles;
    case PrimitiveType::TriangleStrip:
        return backend::Topology::TriangleStrip;
    case PrimitiveType::Lines:
        return backend::Topology::Lines;
    case PrimitiveType::LineStrip:
        return backend::Topology::LineStrip;
    case PrimitiveType::Points:
        return backend::Topology::Points;
    }
    return backend::Topology::Triangles;
}

} // namespace filament::engine
