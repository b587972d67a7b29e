// SPDX-License-Identifier: Apache-2.0
#include "base/OutOfMemory.h"

#include "base/Result.h"

namespace filament {

Error outOfMemory(std::string_view doing, std::string_view object) noexcept {
    try {
        if (object.empty()) return fail(ErrorCode::OutOfMemory, "{}: out of memory; free some and try again", doing);
        return fail(ErrorCode::OutOfMemory, "{} '{}': out of memory; free some and try again", doing, object);
    } catch (std::bad_alloc const&) {
        return { ErrorCode::OutOfMemory, "out of memory" }; // fits the string's internal buffer: no allocation
    }
}

} // namespace filament
