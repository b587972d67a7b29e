// SPDX-License-Identifier: Apache-2.0
/// The version of the files of documents: it grows when a field changes its meaning or goes. New fields leave it: they
/// have defaults.
#pragma once

#include <cstdint>

namespace filament::view {

inline constexpr uint32_t kDocumentVersion = 1;

} // namespace filament::view
