// SPDX-License-Identifier: Apache-2.0
/// The strict reader of scene files, for the files of the programs.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

namespace filament_core::tools {

using scenefile::Json;
using scenefile::JsonReader;

} // namespace filament_core::tools
