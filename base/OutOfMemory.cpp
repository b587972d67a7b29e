// SPDX-License-Identifier: Apache-2.0
#include "base/OutOfMemory.h"

#include "base/Handle.h"
#include "base/Result.h"

namespace filament_core {

Error outOfMemory(std::string_view doing, std::string_view object, std::bad_alloc const& cause) noexcept {
    const bool lacksHandles = dynamic_cast<OutOfHandles const*>(&cause) != nullptr;
    const char* const reason = lacksHandles ? "there are 2^20 objects of one type, as many as can be; destroy some"
                                            : "out of memory; free some and try again";
    try {
        if (object.empty()) return fail(ErrorCode::OutOfMemory, "{}: {}", doing, reason);
        return fail(ErrorCode::OutOfMemory, "{} '{}': {}", doing, object, reason);
    } catch (std::bad_alloc const&) {
        return { ErrorCode::OutOfMemory, "out of memory" }; // fits the string's internal buffer: no allocation
    }
}

} // namespace filament_core
