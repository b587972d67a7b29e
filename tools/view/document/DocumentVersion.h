// SPDX-License-Identifier: Apache-2.0
/// The version of the files of documents, and how long they may be. The version grows when a field changes its
/// meaning or goes. New fields leave it: they have defaults.
#pragma once

#include <cstddef>
#include <cstdint>

namespace filament_core::view {

inline constexpr size_t kLongestText = size_t{ 64 } << 20; ///< of a document

inline constexpr uint32_t kDocumentVersion = 1;

} // namespace filament_core::view
