// SPDX-License-Identifier: Apache-2.0
/// sharedBytes: takes the bytes out of a vector, without a copy, so that a command buffer can keep them alive until the
/// driver thread has read them (CommandBuffer::keep()).
///   Thread  any.  Memory: a control block; the vector is empty afterwards.  Fails: std::bad_alloc, and then the bytes
///           are lost.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace filament_core::engine {

using SharedBytes = std::shared_ptr<const std::vector<std::byte>>;

inline SharedBytes sharedBytes(std::vector<std::byte>& bytes) {
    return std::make_shared<const std::vector<std::byte>>(std::exchange(bytes, {}));
}

} // namespace filament_core::engine
