// SPDX-License-Identifier: Apache-2.0
/// LightProfiles: photometric files as the reference renderer reads them: without a table, in double precision.
///   Thread  read-only.
#pragma once

#include "filament_core/assets/tables/IesFile.h"

#include <memory>

namespace filament_core::reference {

using ProfilePtr = std::shared_ptr<const assets::IesFile>;

} // namespace filament_core::reference
