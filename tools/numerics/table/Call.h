// SPDX-License-Identifier: Apache-2.0
/// NUMERICS_CALL: one expression over s, u and v as text, as fp32 and as fp64 (Row.h). Only for the files of rows.
///   Rules   those of shaders/lib/LibCpp.h; literals must be exact in 16 bits, because the reference evaluation uses
///           them as written.
#pragma once

#include "shaders/lib/LibCpp.h"
#include "shaders/lib/LibCppDouble.h"
#include "tools/numerics/table/Row.h"

namespace filament_core::shader {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace lib {
namespace {
#include "tools/numerics/table/Wrappers.glsl"
} // namespace
} // namespace lib
namespace lib64 {
namespace {
#include "tools/numerics/table/Wrappers.glsl"
} // namespace
} // namespace lib64
#pragma GCC diagnostic pop

namespace numerics {

inline Packed pack(double x) { return { { x, 0, 0, 0 }, 1 }; }
inline Packed pack(glm::dvec2 x) { return { { x, 0, 0 }, 2 }; }
inline Packed pack(glm::dvec3 x) { return { { x, 0 }, 3 }; }
inline Packed pack(glm::vec2 x) { return pack(glm::dvec2(x)); }
inline Packed pack(glm::vec3 x) { return pack(glm::dvec3(x)); }

// The library's functions are internal to each file that includes them, and so are these two.
#define NUMERICS_CALL(...)                                                                                             \
    Call {                                                                                                             \
        .text = #__VA_ARGS__,                                                                                          \
        .single =                                                                                                      \
                [](glm::vec4 s, [[maybe_unused]] glm::vec3 u, [[maybe_unused]] glm::vec3 v) {                          \
                    using namespace lib;                                                                               \
                    (void)s;                                                                                           \
                    return pack(__VA_ARGS__);                                                                          \
                },                                                                                                     \
        .truth = [](glm::dvec4 s, [[maybe_unused]] glm::dvec3 u, [[maybe_unused]] glm::dvec3 v) {                      \
            using namespace lib64;                                                                                     \
            (void)s;                                                                                                   \
            return pack(__VA_ARGS__);                                                                                  \
        },                                                                                                             \
    }

} // namespace numerics
} // namespace filament_core::shader
