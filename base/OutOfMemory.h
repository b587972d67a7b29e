// SPDX-License-Identifier: Apache-2.0
/// Exhausted host memory, where a room ends: std::bad_alloc inside of a room is an Error outside of it.
///   Use     return orOutOfMemory("loading", path.native(), [&]() -> Result<Model> { ... });
///   Thread  any.
///   Memory  none that has to be there: where the text cannot be made, the error still says "out of memory".
///   Fails   never; other exceptions pass.  Cost: a try block.
#pragma once

#include <filament/Result.h>

#include <new>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace filament {

/// "loading 'a.glb': out of memory; free some and try again".
Error outOfMemory(std::string_view doing, std::string_view object = {}) noexcept;

/// function(), which returns a Result. A size that no memory can have (std::length_error) counts as too little of it.
template <class F>
auto orOutOfMemory(std::string_view doing, std::string_view object, F&& function) -> std::invoke_result_t<F&> {
    try {
        return function();
    } catch (std::bad_alloc const&) {
        return outOfMemory(doing, object);
    } catch (std::length_error const&) {
        return outOfMemory(doing, object);
    }
}

} // namespace filament
