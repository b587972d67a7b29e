// SPDX-License-Identifier: Apache-2.0
/// Turns std::bad_alloc inside a room into an Error at the boundary of the room.
///   Use     return orOutOfMemory("loading", path.native(), [&]() -> Result<Model> { ... });
///   Thread  any.
///   Memory  needs none: without memory for its text, the error still says "out of memory".
///   Fails   never; other exceptions pass through.  Cost: a try block.
#pragma once

#include <filament_core/Result.h>

#include <new>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace filament_core {

/// "loading 'a.glb': out of memory; free some and try again". If `cause` is OutOfHandles, the text names that instead.
Error outOfMemory(std::string_view doing, std::string_view object = {}, std::bad_alloc const& cause = {}) noexcept;

/// Returns function(), which returns a Result. A size that is too large for any memory (std::length_error) also counts
/// as out of memory.
template <class F>
auto orOutOfMemory(std::string_view doing, std::string_view object, F&& function) -> std::invoke_result_t<F&> {
    try {
        return function();
    } catch (std::bad_alloc const& cause) {
        return outOfMemory(doing, object, cause);
    } catch (std::length_error const&) {
        return outOfMemory(doing, object);
    }
}

} // namespace filament_core
